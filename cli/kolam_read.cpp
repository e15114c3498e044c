// cli/kolam_read.cpp: `sikku kolam --read`.
#include "cli/kolam_read.h"

#include "art/image/image_file.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/dot_grid_symmetry.h"
#include "art/reading/kolam_file.h"
#include "art/reading/photograph.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/input_file.h"
#include "engine/base/json_text.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

/// Tables of a hundred large kolams have 30 MB.
constexpr std::size_t most_text = std::size_t{64} << 20U;
constexpr std::size_t most_listed = 20;

/// The largest of the named symmetries that the kolam has.
GridSymmetry symmetry_of(const ReadKolam& kolam) {
    GridSymmetry best = GridSymmetry::none;
    for (const GridSymmetry symmetry : grid_symmetry_list()) {
        if (is_symmetric(kolam.grid, kolam.states, symmetry)) best = symmetry;
    }
    return best;
}

struct Certificate {
    std::size_t lines = 0;
    std::string gaps;  ///< `12 of 20 gaps crossed`
    GridSymmetry symmetry = GridSymmetry::none;
};

Certificate certify(const ReadKolam& kolam) {
    Certificate certificate;
    certificate.lines = count_lines(kolam.grid, kolam.states, stop_monitor());
    // The second count takes seconds at most.
    const auto dots = static_cast<double>(kolam.grid.dots().size());
    if (dots * dots * dots < 1e10) {
        const std::size_t again = laplacian_nullity(kolam.grid, kolam.states, stop_monitor());
        if (again != certificate.lines) {
            throw std::logic_error(
                fmt::format("{} lines by following them, but {} by the Laplacian", certificate.lines, again));
        }
    }
    certificate.gaps = summary_of(kolam.states);
    certificate.symmetry = symmetry_of(kolam);
    return certificate;
}

std::string summary(const ReadKolam& kolam, const Certificate& certificate) {
    std::string text = fmt::format("{}, {}, {}", counted(kolam.grid.dots().size(), "dot"), certificate.gaps,
                                   counted(certificate.lines, "line"));
    if (certificate.symmetry != GridSymmetry::none) {
        text += fmt::format(", symmetry {}", grid_symmetry_name(certificate.symmetry));
    }
    return text;
}

std::string pattern_of(const ReadKolam& kolam, const Certificate& certificate, const std::string& source) {
    KolamPatternOptions options;
    options.title = kolam.title;
    if (options.title.empty()) options.title = fmt::format("Kolam on {} dots", printable(kolam.grid.text(), 80));
    options.description = fmt::format("{}; read from {}", summary(kolam, certificate), source);
    options.monitor = stop_monitor();
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

/// Findings in a photograph besides the kolam that was read.
JsonText photograph_json(const Photograph& photograph) {
    const auto pixels = [&](GridDot place) {
        const glm::dvec2 at = photograph.in_file(place);
        return JsonText::object("x", JsonText::raw(fmt::format("{:.1f}", at.x)), "y",
                                JsonText::raw(fmt::format("{:.1f}", at.y)));
    };
    return JsonText::object("kolams", photograph.kolams, "open_ends", JsonText::list(photograph.open_ends, pixels),
                            "missing", JsonText::list(photograph.missing, pixels));
}

std::string json_of(const ReadKolam& kolam, const Certificate& certificate, const Photograph* photograph) {
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
                         certificate.lines, "symmetry", grid_symmetry_name(certificate.symmetry), "doubtful",
                         JsonText::list(kolam.doubtful(), gap), "repaired", JsonText::list(kolam.repaired, gap));
    if (photograph != nullptr) found = found.and_members_of(photograph_json(*photograph));
    return found
        .and_members_of(
            JsonText::object("notes", kolam.notes, "crossings", gap_states_text(kolam.grid, kolam.states)))
        .line();
}

void report(const ReadKolam& kolam, const Certificate& certificate, const std::string& source, bool quiet) {
    tell_unless(quiet, "sikku: {}: {}: {}\n", printable(source), printable(kolam.grid.text(), 80),
                summary(kolam, certificate));
    for (const std::string& note : kolam.notes) tell_unless(quiet, "sikku: {}\n", note);
    const std::vector<std::uint32_t> doubts = kolam.doubtful();
    if (doubts.empty()) return;
    tell_unless(quiet, "sikku: warning: {} of {} doubtful:\n", doubts.size(),
                doubts.size() == 1 ? fmt::format("{} is", counted(kolam.states.size(), "gap"))
                                   : fmt::format("{} are", counted(kolam.states.size(), "gap")));
    const std::vector<GapPlace> places = gap_places(kolam.grid);
    for (std::size_t i = 0; i < std::min(doubts.size(), most_listed); ++i) {
        const std::uint32_t gap = doubts[i];
        tell_unless(quiet, "  row {}, gap {}: {}, certainty {:.2f}\n", places[gap].row, places[gap].number,
                    gap_state_name(kolam.states[gap]), kolam.certainty[gap]);
    }
    if (doubts.size() > most_listed) tell_unless(quiet, "  and {} more\n", doubts.size() - most_listed);
}

/// Reports places of possibly lost dots, and how to read other kolams.
void report_places(const Photograph& photograph, bool quiet) {
    const auto list = [&](const std::vector<GridDot>& places, std::string_view what) {
        if (places.empty()) return;
        std::string text;
        for (std::size_t i = 0; i < std::min(places.size(), most_listed); ++i) {
            const glm::dvec2 at = photograph.in_file(places[i]);
            text += fmt::format("{} {:.0f},{:.0f}", i > 0 ? ";" : "", at.x, at.y);
        }
        if (places.size() > most_listed) text += fmt::format("; and {} more", places.size() - most_listed);
        tell_unless(quiet, "sikku: warning: {}, at pixels{}\n", what, text);
    };
    list(photograph.open_ends, "open ends, where lines leave the kolam");
    list(photograph.missing, "places that may have a dot that was not seen");
    if (photograph.kolams > 1)
        tell_unless(quiet, "sikku: --number 1 to {} selects another kolam\n", photograph.readable);
}

/// Writes the pattern of gestures that meet in the middle of four dots, and reports it.
/// @return false if the file has other contents
bool write_gesture_drawing(const KolamReadOptions& options, const std::string& source, bool quiet) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(options.file, error) || is_picture(InputFile(options.file).read(0, 64))) {
        return false;
    }
    const std::string text = read_file(options.file, options.file, most_text, stop_monitor());
    if (text.size() > most_text) return false;
    const std::optional<GestureDrawing> drawing = read_gesture_drawing(text);
    if (!drawing) return false;
    const char* const reason = "lines meet in the middle of four dots, where a grid of gaps has no crossing";
    if (!is_pattern_file(options.output)) {
        throw std::runtime_error(fmt::format("{}; only a pattern can be written", reason));
    }
    if (!options.fixes.empty() || !options.overlay.empty()) {
        throw UsageError(fmt::format("{} needs gaps; {}", options.fixes.empty() ? "--overlay" : "--fix", reason));
    }
    KolamPatternOptions pattern;
    const std::string summary =
        fmt::format("{}, {}", counted(drawing->dots.size(), "dot"), counted(drawing->lines.size(), "line"));
    pattern.title = "Kolam on " + counted(drawing->dots.size(), "dot");
    pattern.description = fmt::format("{}; read from {}", summary, source);
    write_file(options.output, gesture_pattern(*drawing, kolam_head(pattern)));
    std::vector<std::string> notes = {fmt::format("{}: the pattern draws the lines and dots", reason)};
    if (drawing->decorated > 0) {
        notes.push_back(fmt::format("the decoration of {} was left out", counted(drawing->decorated, "gesture")));
    }
    if (options.as_json) {
        fmt::print("{}", JsonText::object("grid", nullptr, "dots", drawing->dots.size(), "lines",
                                          drawing->lines.size(), "notes", notes)
                             .line());
        return true;
    }
    tell_unless(quiet, "sikku: {}: {}\n", printable(source), summary);
    for (const std::string& note : notes) tell_unless(quiet, "sikku: {}\n", note);
    return true;
}

/// The kolam of a file, and the photograph if it is one.
struct FoundKolam {
    ReadKolam kolam;
    std::optional<Photograph> photograph;
};

FoundKolam read_file_as_kolam(const KolamReadOptions& options, bool quiet) {
    const std::filesystem::path path = options.file;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw UsageError(fmt::format("--read {}: no such file", options.file));
    std::optional<DotLattice> lattice;
    if (options.lattice == "square") lattice = DotLattice::square;
    if (options.lattice == "interlaced") lattice = DotLattice::triangular;
    Progress progress(quiet);
    std::string start;
    if (std::filesystem::is_regular_file(path, error)) start = InputFile(path).read(0, 64);
    if (is_picture(start)) {
        PhotographOptions picture;
        picture.lattice = lattice;
        picture.repair = !options.no_repair;
        picture.number = options.number;
        try {
            Photograph photograph = read_photograph(path, picture, progress.monitor());
            ReadKolam kolam = photograph.kolam;
            return {std::move(kolam), std::move(photograph)};
        } catch (const NoKolam& refused) {
            if (!options.overlay.empty()) {
                OutputFile file(options.overlay);
                write_overlay(refused.picture(), file.temporary());
                file.commit();
            }
            throw;
        }
    }
    const std::string text = read_file(path, options.file, most_text, progress.monitor());
    if (text.size() > most_text) {
        throw std::runtime_error(fmt::format("larger than {} MB", most_text >> 20U));
    }
    auto kolam = read_kolam_text(text, {options.number, lattice, !options.no_repair}, progress.monitor());
    const auto refuse = [](const std::string& why) {
        throw std::runtime_error(
            "unknown format; expected a photograph (JPEG, PNG, TIFF, WebP, HEIF), .kolam.json, a CSV "
            "of one-stroke kolams, an SVG, gestures or a pattern" +
            why);
    };
    if (!kolam && !states_axiom(text)) refuse("");
    if (!options.overlay.empty()) throw UsageError("--overlay applies only to photographs");
    if (kolam) return {std::move(*kolam), std::nullopt};
    PatternOptions pattern;
    pattern.pattern = options.file;
    try {
        return {read_kolam_document(load(pattern, quiet), options.budget, progress.monitor()), std::nullopt};
    } catch (const PatternError& damaged) {
        // Every text with a line `axiom:` looks like a pattern.
        if (options.file.ends_with(".lsys")) throw;
        const Diagnostic& first = damaged.diagnostics().front();
        refuse(fmt::format("; as a pattern it has errors, at line {}: {}", first.where.line, first.message));
        throw;
    }
}

void write(const ReadKolam& kolam, const Certificate& certificate, const std::string& output,
           const std::string& source) {
    const auto other = text_for(output, kolam.grid, kolam.states);
    write_file(output, other ? *other : pattern_of(kolam, certificate, source));
}

}  // namespace

std::optional<std::string> text_for(const std::string& output, const DotGrid& grid, const GapStates& states) {
    const std::string extension = extension_of(output);
    return kolam_file_text(extension.empty() ? "" : extension.substr(1), grid, states, stop_monitor());
}

bool is_pattern_file(const std::string& output) {
    const std::string extension = extension_of(output);
    return extension.empty() || extension == ".lsys";
}

void check_kolam_output(const std::string& output) {
    if (is_pattern_file(output)) return;
    const std::string extension = extension_of(output);
    for (const char* known : {".json", ".csv", ".yaml", ".yml"}) {
        if (extension == known) return;
    }
    for (const Interpreter* interpreter : interpreters()) {
        if (find_format(interpreter->formats(), extension.substr(1))) {
            throw UsageError(
                fmt::format("-o {}: expected a pattern file, NAME.lsys; `sikku {}` makes this format from it", output,
                            interpreter->owner() == KeyOwner::art ? "draw" : "play"));
        }
    }
    throw UsageError(
        fmt::format("-o {}: unknown extension; expected .lsys, .kolam.json, .csv or .yaml (gestures)", output));
}

void add_kolam_read_options(CLI::App& command, KolamReadOptions& options) {
    const OptionGroup group{command, read_heading};
    auto* read = group.add("--read", options.file, "FILE",
                           "read a kolam from a photograph (JPEG, PNG, TIFF, WebP, HEIF), a .kolam.json, a CSV of "
                           "one-stroke kolams, an SVG, gestures, or a pattern");
    group
        .add("--number", options.number, "N",
             "number of the kolam in a CSV, a list of .kolam.json or a photograph, from 1 (1)")
        ->check(whole_number(1, 1'000'000))
        ->needs(read);
    group
        .add("--lattice", options.lattice, "KIND",
             "square or interlaced dots of a photograph or SVG (whichever fits better)")
        ->check(one_of({"square", "interlaced"}))
        ->needs(read);
    group
        .add("--fix", options.fixes, "GAPS",
             "set gaps by hand: 'ROW,GAP: STATE', with row and number as in the report and the overlay, and cross, "
             "turn or join; separate several by semicolons; may be repeated")
        ->allow_extra_args(false)
        ->needs(read);
    group
        .add("--overlay", options.overlay, "FILE",
             "draw what was read over the photograph, as PNG: crossed gaps green, turned blue, joined magenta, "
             "doubtful ones ringed; lost dots in red rings; also if the photograph is refused")
        ->needs(read);
    group
        .flag("--no-repair", options.no_repair,
              "do not replace doubtful gaps of a photograph by their images under its symmetry")
        ->needs(read);
}

void kolam_read(const KolamReadOptions& options, bool quiet) {
    check_kolam_output(options.output);
    if (options.as_json && options.output.empty()) {
        throw UsageError("--json needs -o FILE for the pattern, because JSON goes to standard output");
    }
    if (!options.overlay.empty() && extension_of(options.overlay) != ".png") {
        throw UsageError(fmt::format("--overlay {}: expected a PNG, NAME.png", options.overlay));
    }
    keep_input("--overlay", options.overlay, options.file);
    keep_input("-o", options.output, options.file);
    const std::string source = std::filesystem::path(options.file).filename().string();
    std::optional<FoundKolam> read = [&]() -> std::optional<FoundKolam> {
        try {
            if (write_gesture_drawing(options, source, quiet)) return std::nullopt;
            return read_file_as_kolam(options, quiet);
        } catch (const UsageError&) {
            throw;
        } catch (const std::runtime_error& error) {
            const std::string message = error.what();
            throw std::runtime_error(
                message.starts_with(options.file) ? message : fmt::format("{}: {}", options.file, message));
        }
    }();
    if (!read) return;
    FoundKolam& found = *read;
    for (const std::string& fix : options.fixes) {
        try {
            fix_gaps(found.kolam, fix);
        } catch (const std::runtime_error& error) {
            throw UsageError(fmt::format("--fix {}", error.what()));
        }
    }
    const Certificate certificate = certify(found.kolam);
    write(found.kolam, certificate, options.output, source);
    if (!options.overlay.empty() && found.photograph) {
        found.photograph->kolam = found.kolam;
        OutputFile file(options.overlay);
        write_overlay(*found.photograph, file.temporary());
        file.commit();
    }
    const Photograph* photograph = found.photograph ? &*found.photograph : nullptr;
    if (options.as_json) fmt::print("{}", json_of(found.kolam, certificate, photograph));
    if (options.as_json) return;
    report(found.kolam, certificate, source, quiet);
    if (photograph != nullptr) report_places(*photograph, quiet);
}

void kolam_convert(const Document& document, const std::string& output, double budget, bool quiet) {
    check_kolam_output(output);
    Progress progress(quiet);
    const ReadKolam kolam = read_kolam_document(document, budget, progress.monitor());
    const Certificate certificate = certify(kolam);
    const std::string name = document.pattern().text("title");
    write(kolam, certificate, output, name.empty() ? "a pattern" : name);
    report(kolam, certificate, output, quiet);
}

}  // namespace sikku
