#include "art/reading/kolam_report.h"

#include "art/kolam/dot_grid_pattern.h"
#include "art/reading/kolam_fixes.h"
#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// The largest of the named symmetries that the kolam has.
GridSymmetry symmetry_of(const ReadKolam& kolam) {
    GridSymmetry best = GridSymmetry::none;
    for (const GridSymmetry symmetry : grid_symmetry_list()) {
        if (is_symmetric(kolam.grid, kolam.states, symmetry)) best = symmetry;
    }
    return best;
}

/// Findings in a photograph besides the kolam that was read.
JsonText photograph_json(const Photograph& photograph) {
    const auto pixels = [&](GridDot place) {
        const glm::dvec2 at = photograph.in_file(place);
        const DotAddress address = address_of(photograph.kolam.grid, place);
        return JsonText::object("row", address.row, "place", address.number, "x",
                                JsonText::raw(fmt::format("{:.1f}", at.x)), "y",
                                JsonText::raw(fmt::format("{:.1f}", at.y)));
    };
    return JsonText::object("kolams", photograph.kolams, "open_ends", JsonText::list(photograph.open_ends, pixels),
                            "missing", JsonText::list(photograph.missing, pixels), "completed",
                            JsonText::list(photograph.completed, pixels));
}

}  // namespace

FoundKolam read_kolam_file(const std::filesystem::path& file, const std::string& name,
                           const KolamFileOptions& options, double budget, const Monitor& monitor) {
    const auto fail = [&](const std::string& why) { throw std::runtime_error(fmt::format("{}: {}", name, why)); };
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) fail("this is a folder");
    // Pipes can be read only once, and contain texts.
    const bool can_be_picture = std::filesystem::is_regular_file(file, error);
    if (can_be_picture && is_picture(InputFile(file).read(0, 64))) {
        const PhotographOptions picture{.lattice = options.lattice,
                                        .repair = options.repair,
                                        .number = options.number,
                                        .grid = options.grid,
                                        .region = options.region,
                                        .fixes = options.fixes};
        Photograph photograph = read_photograph(file, picture, monitor);
        ReadKolam kolam = photograph.kolam;
        return {std::move(kolam), std::move(photograph)};
    }
    if (options.grid || options.region) {
        fail(fmt::format("not a photograph, which {} needs", options.grid ? "an expected grid" : "a region"));
    }
    const auto fixed = [&](ReadKolam kolam) -> FoundKolam {
        for (const std::string& fix : options.fixes) fix_gaps(kolam, fix);
        return {std::move(kolam), std::nullopt};
    };
    std::string text = read_file(file, name, most_kolam_text, monitor);
    if (text.size() > most_kolam_text) fail(fmt::format("larger than {} MB", most_kolam_text >> 20U));
    if (auto kolam = read_kolam_text(text, options, monitor)) return fixed(std::move(*kolam));
    const std::string unknown =
        "unknown format; expected a photograph (JPEG, PNG, TIFF, WebP, HEIF), .kolam.json, a CSV of one-stroke "
        "kolams, an "
        "SVG, gestures or a pattern";
    if (!states_axiom(text)) fail(unknown);
    try {
        return fixed(read_kolam_document(parse(name, std::move(text)), budget, monitor));
    } catch (const PatternError& damaged) {
        // Every text with a line `axiom:` looks like a pattern.
        if (name.ends_with(".lsys")) throw;
        const Diagnostic& first = damaged.diagnostics().front();
        fail(fmt::format("{}; as a pattern it has errors, at line {}: {}", unknown, first.where.line, first.message));
        throw;
    }
}

KolamReport report_kolam(const ReadKolam& kolam, const Monitor& monitor) {
    KolamReport report;
    report.lines = count_lines(kolam.grid, kolam.states, monitor);
    // The second count takes seconds at most.
    const auto dots = static_cast<double>(kolam.grid.dots().size());
    if (dots * dots * dots < 1e10) {
        const std::size_t again = laplacian_nullity(kolam.grid, kolam.states, monitor);
        if (again != report.lines) {
            throw std::logic_error(
                fmt::format("{} lines by following them, but {} by the Laplacian", report.lines, again));
        }
    }
    report.gaps = summary_of(kolam.states);
    report.symmetry = symmetry_of(kolam);
    return report;
}

std::string kolam_summary(const ReadKolam& kolam, const KolamReport& report) {
    std::string text = fmt::format("{}, {}, {}", counted(kolam.grid.dots().size(), "dot"), report.gaps,
                                   counted(report.lines, "line"));
    if (report.symmetry != GridSymmetry::none) {
        text += fmt::format(", symmetry {}", grid_symmetry_name(report.symmetry));
    }
    return text;
}

std::string read_kolam_pattern(const ReadKolam& kolam, const KolamReport& report, const std::string& source,
                               const Monitor& monitor) {
    KolamPatternOptions options;
    options.title = kolam.title;
    if (options.title.empty()) options.title = fmt::format("Kolam on {} dots", printable(kolam.grid.text(), 80));
    options.description = fmt::format("{}; read from {}", kolam_summary(kolam, report), source);
    options.rim = kolam.rim;
    options.centred_dots = kolam.has_centred_dots;
    options.monitor = monitor;
    std::string text = kolam_pattern(kolam.grid, kolam.states, options).text;
    const std::vector<std::uint32_t> doubts = kolam.doubtful();
    if (!doubts.empty()) {
        text += "\n// doubtful gaps, as row,gap:";
        const std::vector<GapPlace> places = gap_places(kolam.grid);
        for (std::size_t i = 0; i < std::min<std::size_t>(doubts.size(), 200); ++i) {
            if (i % 16 == 0) text += "\n//";
            text += fmt::format(" {},{}", places[doubts[i]].row, places[doubts[i]].number);
        }
        text += doubts.size() > 200 ? " …\n" : "\n";
    }
    return text;
}

std::string read_kolam_json(const ReadKolam& kolam, const KolamReport& report, const Photograph* photograph) {
    const std::vector<GapPlace> places = gap_places(kolam.grid);
    const auto gap = [&](std::uint32_t number) {
        const float certainty = kolam.certainty.empty() ? 1.0F : kolam.certainty[number];
        return JsonText::object("row", places[number].row, "gap", places[number].number, "state",
                                gap_state_name(kolam.states[number]), "certainty",
                                JsonText::raw(fmt::format("{:.2f}", certainty)));
    };
    const auto count = [&](GapState state) { return std::count(kolam.states.begin(), kolam.states.end(), state); };
    JsonText found =
        JsonText::object("grid", kolam.grid.text(), "dots", kolam.grid.dots().size(), "gaps", kolam.states.size(),
                         "crossed", count(GapState::crossed), "joined", count(GapState::joined), "lines",
                         report.lines, "symmetry", grid_symmetry_name(report.symmetry), "doubtful",
                         JsonText::list(kolam.doubtful(), gap), "repaired", JsonText::list(kolam.repaired, gap));
    if (photograph != nullptr) found = found.and_members_of(photograph_json(*photograph));
    return found
        .and_members_of(
            JsonText::object("notes", kolam.notes, "crossings", gap_states_text(kolam.grid, kolam.states)))
        .line();
}

}  // namespace sikku
