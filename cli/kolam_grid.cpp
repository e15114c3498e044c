// cli/kolam_grid.cpp: `sikku kolam --grid`.
#include "cli/kolam_grid.h"

#include "art/kolam/dot_grid_enumeration.h"
#include "art/kolam/grid_kolam.h"
#include "art/kolam/radial_kolam.h"
#include "art/reading/kolam_file.h"
#include "cli/command.h"
#include "cli/kolam_read.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace sikku {
namespace {

/// Turns failures to read the value of an option into usage errors.
template <typename Work>
auto of_option(const char* option, Work&& work) {
    try {
        return work();
    } catch (const UsageError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
}

/// Text of an option, or of the file that it names with `@`.
std::string text_of(const std::string& value) {
    return value.starts_with('@') ? read_pattern_text(value.substr(1)).text : value;
}

RimStyle rim_of(const KolamGridOptions& options) {
    return of_option("--rim", [&] { return parse_rim_style(options.rim); });
}

/// Refuses outputs that cannot represent the kolam, and JSON on the output of the pattern.
void check_output(const KolamGridOptions& options) {
    if (options.as_json && options.output.empty()) {
        throw UsageError("--json needs -o FILE for the pattern, because JSON goes to standard output");
    }
    check_kolam_output(options.output);
    rim_of(options);
    if (is_pattern_file(options.output)) return;
    if (!options.radial.empty()) {
        throw UsageError(
            fmt::format("-o {}: this format holds the gaps of a grid, and a radial kolam has none; "
                        "expected NAME.lsys",
                        options.output));
    }
    const char* look = options.colours ? "--colours" : options.dots ? "--dots" : "--rim";
    if (options.colours || options.dots || rim_of(options) != RimStyle::round) {
        throw UsageError(
            fmt::format("{}: -o {} holds dots and gaps, not a drawing; expected NAME.lsys", look, options.output));
    }
}

void make_pattern(const KolamGridOptions& options, const DotGrid& grid, std::optional<GridSymmetry> symmetry,
                  bool quiet) {
    check_output(options);
    GridKolamOptions request{.seed = options.seed,
                             .symmetry = symmetry,
                             .density = options.density,
                             .joined = options.joined,
                             .single_line = options.single_line,
                             .attempts = options.attempts};
    if (options.crossings) {
        request.gaps = of_option("--crossings", [&] { return parse_gap_states(grid, text_of(*options.crossings)); });
    }
    const GridKolam made = make_grid_kolam(grid, request, stop_monitor());
    KolamPatternOptions pattern = describe_grid_kolam(grid, request, made);
    const std::string title = dot_grid_title(text_of(options.grid));
    if (!title.empty()) pattern.title = title;
    pattern.coloured = options.colours;
    pattern.dot_symbols = options.dots;
    pattern.rim = rim_of(options);
    pattern.monitor = stop_monitor();
    const auto other = text_for(options.output, grid, made.states);
    bool has_rim = true;
    if (other) {
        write_file(options.output, *other);
    } else {
        const KolamPattern drawn = kolam_pattern(grid, made.states, pattern);
        has_rim = pattern.rim == RimStyle::round || drawn.shaped > 0;
        write_file(options.output, drawn.text);
    }
    if (options.as_json) {
        fmt::print("{}", grid_kolam_json(grid, made));
    } else {
        std::string note;
        if (options.single_line) note += fmt::format("; {} changed to join the lines", counted(made.changed, "gap"));
        if (made.attempt > 1) note += fmt::format(", attempt {}", made.attempt);
        tell_unless(quiet, "sikku: {}: {}{}\n",
                    grid.is_solid() ? printable(grid.text(), 80)
                    : title.empty() ? "shape"
                                    : printable(title, 80),
                    pattern.description, note);
    }
    if (!has_rim) {
        tell_unless(quiet, "sikku: warning: --rim has no effect: no loop at the rim has enough room\n");
    }
    if (made.same_seed) {
        tell_unless(
            quiet,
            "sikku: note: seed {} gives the same kolam as seed {}; only {} different kolams were found; try another "
            "--density or --symmetry\n",
            options.seed, *made.same_seed, made.different);
    }
}

void enumerate(const KolamGridOptions& options, const DotGrid& grid, GridSymmetry symmetry) {
    EnumerationOptions enumeration;
    enumeration.symmetry = symmetry;
    enumeration.joined = options.joined > 0;
    enumeration.keep = options.limit;
    enumeration.threads = options.threads;
    enumeration.monitor = stop_monitor();
    const Enumeration found = of_option("--enumerate", [&] { return enumerate_single_lines(grid, enumeration); });
    std::string text =
        options.as_json ? enumeration_json(grid, symmetry, found) : enumeration_text(grid, symmetry, found);
    if (!options.as_json && found.kolams.size() < found.distinct && options.limit > 0) {
        text += fmt::format("and {} more (--limit)\n", found.distinct - found.kolams.size());
    }
    write_file(options.output, text);
}

}  // namespace

void add_kolam_grid_options(CLI::App& command, KolamGridOptions& options) {
    const OptionGroup group{command, grid_heading};
    auto* grid = group.add(
        "--grid", options.grid, "DOTS",
        "make a kolam on this grid of dots, or with --read the dots that the kolam of a photograph has: 7x7, the "
        "dots "
        "of each row (1-3-5-3-1), the longest row and the last ('7 to 1 ner pulli', '15-8 idukku pulli'), blocks "
        "(15x9-9x3), letters (text:MEERA, 'text 18:MEERA' with 18 rows of dots), or a shape of 'o' and '.' "
        "(oo./ooo/.oo); @FILE reads it from a file");
    auto* symmetry =
        group.add("--symmetry", options.symmetry, "GROUP",
                  "none, C2, C3, C4, C6 (rotations), mirror-x (left and right), mirror-y (top and "
                  "bottom), diagonal, mirrors (mirror-x and mirror-y), diagonals, D3, D3-y, D4 or D6 "
                  "(rotations and mirrors); excludes --crossings (the seed chooses one that the grid and "
                  "--single-line permit; with --enumerate none)");
    auto* density = group.add("--density", options.density, "SHARE",
                              "share of the gaps in which lines cross, 0 to 1 (chosen by the seed, and all dots are "
                              "connected; interlaced dots "
                              "get petals and stars instead)");
    auto* joined = group.add("--joined", options.joined, "SHARE",
                             "share of the other gaps in which lines run past both dots, 0 to 1; with --enumerate, "
                             "any share above 0 includes such kolams (0)");
    auto* crossings = group.add("--crossings", options.crossings, "GAPS",
                                "all, none, or a digit for each gap (0 turned back, 1 crossed, 2 joined): row by row "
                                "from the top, first the gaps within the row, then the gaps to the next row; @FILE "
                                "reads them from a file");
    auto* single = group.flag("--single-line", options.single_line,
                              "make a single line, changing as few gaps as possible; with C4 and C6 the grid needs a "
                              "dot in its middle, with C2 or mirrors a dot or a gap; with D4 at most one dot on each "
                              "diagonal");
    for (CLI::Option* option : {symmetry, density, joined, crossings, single}) option->needs(grid);
    for (CLI::Option* share : {density, joined}) share->check(number_between(0, 1));
    for (CLI::Option* option : {symmetry, density, joined}) crossings->excludes(option);
    group
        .add("--attempts", options.attempts, "N",
             "attempts to find a single line with a symmetry, 1 to 1000000 (1000)")
        ->needs(single)
        ->check(whole_number(1, 1'000'000));
    auto* radial = group.add("--radial", options.radial, "ARMSxDOTS",
                             "make a radial kolam (Hridaya kamalam) instead: arms and dots on each, such as 8x5; its "
                             "lines go through the dots, from arm to arm");
    radial->excludes(grid);
    group
        .add("--order", options.order, "DOTS",
             "order in which a line visits the dots of an arm, 1 next to the centre (1-3-5-…-2-4-…)")
        ->needs(radial);
    auto* colours = group.flag("--colours", options.colours,
                               "colour the lines; lines that are images of each other share a colour");
    auto* dots = group.flag("--dots", options.dots, "draw the dots in the pattern");
    auto* rim = group.add("--rim", options.rim, "STYLE",
                          "shape of the loops at the rim: round, pointed, petal, horn or crescent (round)");
    rim->needs(grid);
    auto* enumerate = group.flag("--enumerate", options.enumerate,
                                 "count and list all single-line kolams; with --symmetry, only symmetric ones");
    enumerate->needs(grid);
    for (CLI::Option* option : {crossings, density, single, colours, dots, rim}) enumerate->excludes(option);
    group.add("--limit", options.limit, "N", "maximum number of kolams that --enumerate lists, up to 10000000 (100)")
        ->needs(enumerate)
        ->check(whole_number(0, 10'000'000));
}

void kolam_radial(const KolamGridOptions& options, bool quiet) {
    check_output(options);
    const RadialKolam kolam =
        of_option("--radial", [&] { return parse_radial_kolam(options.radial, options.order); });
    KolamPatternOptions pattern = describe_radial_kolam(kolam);
    pattern.coloured = options.colours;
    pattern.dot_symbols = options.dots;
    pattern.monitor = stop_monitor();
    write_file(options.output, radial_pattern(kolam, pattern).text);
    if (options.as_json) {
        fmt::print("{}", JsonText::object("arms", kolam.arms, "dots", kolam.dots(), "lines", kolam.lines(), "order",
                                          kolam.order)
                             .line());
    } else {
        tell_unless(quiet, "sikku: {}: {}\n", pattern.title, pattern.description);
    }
}

void kolam_grid(const KolamGridOptions& options, bool quiet) {
    const DotGrid grid = of_option("--grid", [&] { return parse_dot_grid(text_of(options.grid)); });
    const std::string note = dot_grid_note(text_of(options.grid));
    if (!note.empty()) tell_unless(quiet, "sikku: note: {}\n", note);
    const std::optional<GridSymmetry> symmetry = of_option("--symmetry", [&]() -> std::optional<GridSymmetry> {
        if (!options.symmetry) return std::nullopt;
        const GridSymmetry wanted = parse_grid_symmetry(*options.symmetry);
        require_symmetry(grid, wanted);
        return wanted;
    });
    if (options.enumerate) return enumerate(options, grid, symmetry.value_or(GridSymmetry::none));
    make_pattern(options, grid, symmetry, quiet);
}

}  // namespace sikku
