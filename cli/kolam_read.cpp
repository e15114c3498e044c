// cli/kolam_read.cpp: `sikku kolam --read`.
#include "cli/kolam_read.h"

#include "art/image/image_file.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/reading/kolam_file.h"
#include "art/reading/kolam_fixes.h"
#include "art/reading/kolam_report.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/input_file.h"
#include "engine/base/json_text.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

constexpr std::size_t most_listed = 20;

void report(const ReadKolam& kolam, const KolamReport& facts, const std::string& source, bool quiet) {
    tell_unless(quiet, "sikku: {}: {}: {}\n", printable(source), printable(kolam.grid.text(), 80),
                kolam_summary(kolam, facts));
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
            const DotAddress address = address_of(photograph.kolam.grid, places[i]);
            text += fmt::format("  row {}, place {}: pixel {:.0f},{:.0f}\n", address.row, address.number, at.x, at.y);
        }
        if (places.size() > most_listed) text += fmt::format("  and {} more\n", places.size() - most_listed);
        tell_unless(quiet, "sikku: {}:\n{}", what, text);
    };
    list(photograph.completed, "dots that were not seen, completed as in --grid");
    list(photograph.open_ends, "warning: open ends, where lines leave the kolam");
    list(photograph.missing, "warning: places that may have a dot that was not seen");
    if (!photograph.open_ends.empty() || !photograph.missing.empty()) {
        tell_unless(quiet, "sikku: --fix 'dot ROW,PLACE' adds a dot\n");
    }
    if (photograph.readable > 1) {
        tell_unless(quiet, "sikku: --part 1 to {} selects another kolam\n", photograph.readable);
    }
}

/// Writes the pattern of gestures that meet in the middle of four dots, and reports it.
/// @return false if the file has other contents
bool write_gesture_drawing(const KolamReadOptions& options, const std::string& source, bool quiet) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(options.file, error) || is_picture(InputFile(options.file).read(0, 64))) {
        return false;
    }
    const std::string text = read_file(options.file, options.file, most_kolam_text, stop_monitor());
    if (text.size() > most_kolam_text) return false;
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

/// Turns failures to read the value of an option into usage errors.
template <typename Work>
auto of_read_option(const char* option, const Work& work) {
    try {
        return work();
    } catch (const std::runtime_error& error) {
        throw UsageError(fmt::format("{} {}", option, error.what()));
    }
}

DotGrid expected_grid(const KolamReadOptions& options) {
    const std::string& given = options.grid;
    DotGrid grid = parse_dot_grid(given.starts_with('@') ? read_pattern_text(given.substr(1)).text : given);
    const std::string wanted = grid.lattice() == DotLattice::square ? "square" : "interlaced";
    if (options.lattice.empty() || options.lattice == wanted) return grid;
    throw std::runtime_error(fmt::format("'{}': {} dots; --lattice expects others", printable(given, 80), wanted));
}

/// Refuses options that other files than photographs have no use for.
void check_photograph_options(const KolamReadOptions& options) {
    std::error_code error;
    if (std::filesystem::is_regular_file(options.file, error) && is_picture(InputFile(options.file).read(0, 64))) {
        return;
    }
    const char* given = !options.grid.empty()      ? "--grid"
                        : !options.corners.empty() ? "--corners"
                        : !options.crop.empty()    ? "--crop"
                                                   : nullptr;
    if (given != nullptr) throw UsageError(fmt::format("{} with --read applies only to photographs", given));
}

FoundKolam read_file_as_kolam(const KolamReadOptions& options, bool quiet) {
    KolamFileOptions reading{.number = options.number, .repair = !options.no_repair, .fixes = options.fixes};
    if (options.lattice == "square") reading.lattice = DotLattice::square;
    if (options.lattice == "interlaced") reading.lattice = DotLattice::triangular;
    if (!options.grid.empty()) reading.grid = of_read_option("--grid", [&] { return expected_grid(options); });
    if (!options.crop.empty()) reading.region = of_read_option("--crop", [&] { return parse_crop(options.crop); });
    if (!options.corners.empty()) {
        const std::string corners = fmt::to_string(fmt::join(options.corners, " "));
        reading.region = of_read_option("--corners", [&] { return parse_corners(corners); });
    }
    Progress progress(quiet);
    try {
        FoundKolam found = read_kolam_file(options.file, options.file, reading, options.budget, progress.monitor());
        if (!found.photograph && !options.overlay.empty()) throw UsageError("--overlay applies only to photographs");
        return found;
    } catch (const NoKolam& refused) {
        if (!options.overlay.empty()) {
            OutputFile file(options.overlay);
            write_overlay(refused.picture(), file.temporary());
            file.commit();
        }
        throw;
    } catch (const FixError& wrong) {
        throw UsageError(fmt::format("--fix {}", wrong.what()));
    }
}

void write(const ReadKolam& kolam, const KolamReport& facts, const std::string& output, const std::string& source) {
    const auto other = text_for(output, kolam.grid, kolam.states);
    write_file(output, other ? *other : read_kolam_pattern(kolam, facts, source, stop_monitor()));
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
        .add("--number,--part", options.number, "N",
             "number of the kolam in a CSV, a list of .kolam.json or a photograph, from 1; the largest one of a "
             "photograph is the first (1)")
        ->check(whole_number(1, 1'000'000))
        ->needs(read);
    auto* corners =
        group
            .add("--corners", options.corners, "X,Y X,Y X,Y X,Y",
                 "corners of the part of a photograph that is read and straightened, in pixels, around it "
                 "from the top left one")
            ->expected(1, 4)
            ->needs(read);
    group
        .add("--lattice", options.lattice, "KIND",
             "square or interlaced dots of a photograph or SVG (whichever fits better)")
        ->check(one_of({"square", "interlaced"}))
        ->needs(read);
    group.add("--crop", options.crop, "X,Y,WIDTH,HEIGHT", "read only this part of a photograph, in pixels")
        ->excludes(corners)
        ->needs(read);
    group
        .add("--fix", options.fixes, "CHANGES",
             "change gaps and dots by hand: 'ROW,GAP: STATE', with row and number as in the report and the overlay, "
             "and cross, turn or join; 'dot ROW,PLACE' and 'no dot ROW,PLACE', with places from the left side of the "
             "grid; separate several by semicolons; may be repeated; each counts in the kolam that those before it "
             "made")
        ->allow_extra_args(false)
        ->needs(read);
    group
        .add(
            "--overlay", options.overlay, "FILE",
            "draw what was read over the photograph, as PNG: crossed gaps green, turned blue, joined magenta, "
            "doubtful ones ringed; lost dots in red rings, completed ones in cyan; also if the photograph is refused")
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
    std::error_code missing;
    if (!std::filesystem::exists(options.file, missing)) {
        throw UsageError(fmt::format("--read {}: no such file", options.file));
    }
    check_photograph_options(options);
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
    const KolamReport facts = report_kolam(found.kolam, stop_monitor());
    write(found.kolam, facts, options.output, source);
    if (!options.overlay.empty() && found.photograph) {
        OutputFile file(options.overlay);
        write_overlay(*found.photograph, file.temporary());
        file.commit();
    }
    const Photograph* photograph = found.photograph ? &*found.photograph : nullptr;
    if (options.as_json) fmt::print("{}", read_kolam_json(found.kolam, facts, photograph));
    if (options.as_json) return;
    report(found.kolam, facts, source, quiet);
    if (photograph != nullptr) report_places(*photograph, quiet);
}

void kolam_convert(const Document& document, const std::string& output, double budget, bool quiet) {
    check_kolam_output(output);
    Progress progress(quiet);
    const ReadKolam kolam = read_kolam_document(document, budget, progress.monitor());
    const KolamReport facts = report_kolam(kolam, stop_monitor());
    const std::string name = document.pattern().text("title");
    write(kolam, facts, output, name.empty() ? "a pattern" : name);
    report(kolam, facts, output, quiet);
}

}  // namespace sikku
