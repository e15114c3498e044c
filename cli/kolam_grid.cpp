// cli/kolam_grid.cpp: `sikku kolam --grid`.
#include "cli/kolam_grid.h"

#include "art/kolam/dot_grid_enumeration.h"
#include "art/kolam/grid_kolam.h"
#include "art/kolam/page_kolam.h"
#include "art/kolam/radial_kolam.h"
#include "art/print/border.h"
#include "art/product/border_files.h"
#include "art/product/draw_settings.h"
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
#include <tuple>
#include <utility>

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

/// Text of an option, or of the file that it names with `@`, without the line ends after it.
std::string text_of(const std::string& value) {
    if (!value.starts_with('@')) return value;
    std::string text = read_pattern_text(value.substr(1)).text;
    while (text.ends_with('\n') || text.ends_with('\r')) text.pop_back();
    return text;
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
    const char* look = options.colours   ? "--colours"
                       : options.dots    ? "--dots"
                       : options.centred ? "--centred"
                                         : "--rim";
    if (options.colours || options.dots || options.centred || rim_of(options) != RimStyle::round) {
        throw UsageError(
            fmt::format("{}: -o {} holds dots and gaps, not a drawing; expected NAME.lsys", look, options.output));
    }
}

GridKolamOptions request_of(const KolamGridOptions& options, std::optional<GridSymmetry> symmetry) {
    return {.seed = options.seed,
            .symmetry = symmetry,
            .density = options.density,
            .joined = options.joined,
            .period = options.period,
            .single_line = options.single_line,
            .attempts = options.attempts};
}

KolamPatternOptions look_of(const KolamGridOptions& options) {
    KolamPatternOptions look;
    look.coloured = options.colours;
    look.dot_symbols = options.dots;
    look.centred_dots = options.centred;
    look.rim = rim_of(options);
    look.monitor = stop_monitor();
    return look;
}

/// Refuses centred dots on interlaced rows.
void check_centred(const KolamGridOptions& options, DotLattice lattice) {
    if (!options.centred || lattice == DotLattice::square) return;
    throw UsageError("--centred: interlaced dots have no fields between four dots; expected straight rows");
}

/// Writes the kolam in the format of the output, and reports it.
/// @param pattern  makes the pattern, if the output is one
/// @param more     what else there is to say about it
template <typename MakePattern>
void write_kolam(const KolamGridOptions& options, const DotGrid& grid, const GridKolam& made,
                 const KolamPatternOptions& look, const std::string& more, bool quiet, MakePattern&& pattern) {
    bool has_rim = true, has_centres = true;
    if (const auto other = text_for(options.output, grid, made.states)) {
        write_file(options.output, *other);
    } else {
        const KolamPattern& drawn = pattern();
        has_rim = look.rim == RimStyle::round || drawn.shaped > 0;
        has_centres = !look.centred_dots || drawn.centred > 0;
        write_file(options.output, drawn.text);
    }
    const std::string title = options.is_fill() ? "" : dot_grid_title(text_of(options.grid));
    if (options.as_json) {
        fmt::print("{}", grid_kolam_json(grid, made));
    } else {
        std::string note;
        if (options.single_line) note += fmt::format("; {} changed to join the lines", counted(made.changed, "gap"));
        if (made.attempt > 1) note += fmt::format(", attempt {}", made.attempt);
        tell_unless(quiet, "sikku: {}: {}{}{}\n",
                    grid.is_solid() ? printable(grid.text(), 80)
                    : title.empty() ? "shape"
                                    : printable(title, 80),
                    look.description, note, more);
    }
    if (!has_rim) {
        tell_unless(quiet, "sikku: warning: --rim has no effect: no loop at the rim has enough room\n");
    }
    if (!has_centres) {
        tell_unless(quiet,
                    "sikku: warning: --centred has no effect: no field lies between four crossed gaps; try "
                    "--density 0.9\n");
    }
    if (made.same_seed) {
        tell_unless(
            quiet,
            "sikku: note: seed {} gives the same kolam as seed {}; only {} different kolams were found; try another "
            "--density or --symmetry\n",
            options.seed, *made.same_seed, made.different);
    }
}

void make_pattern(const KolamGridOptions& options, const DotGrid& grid, std::optional<GridSymmetry> symmetry,
                  bool quiet) {
    check_output(options);
    check_centred(options, grid.lattice());
    GridKolamOptions request = request_of(options, symmetry);
    if (options.crossings) {
        request.gaps = of_option("--crossings", [&] { return parse_gap_states(grid, text_of(*options.crossings)); });
    }
    const GridKolam made = make_grid_kolam(grid, request, stop_monitor());
    KolamPatternOptions look = look_of(options);
    const KolamPatternOptions described = describe_grid_kolam(grid, request, made);
    const std::string title = dot_grid_title(text_of(options.grid));
    look.title = title.empty() ? described.title : title;
    look.description = described.description;
    KolamPattern pattern;
    write_kolam(options, grid, made, look, "", quiet,
                [&]() -> const KolamPattern& { return pattern = kolam_pattern(grid, made.states, look); });
}

// --- pages --------------------------------------------------------------------------------------------------------

/// The command that makes a kolam for a page.
std::string command_of(const KolamGridOptions& options) {
    std::string command = "sikku kolam";
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) command += fmt::format(" --{} {}", name, shell_word(value));
    };
    const auto add_number = [&](const char* name, auto value, bool is_given) {
        if (is_given) command += fmt::format(" --{} {}", name, value);
    };
    const auto add_flag = [&](const char* name, bool is_given) {
        if (is_given) command += fmt::format(" --{}", name);
    };
    add("grid", std::string(trimmed(text_of(options.grid))));
    add("size", options.size);
    add_flag("landscape", options.landscape);
    add("margin", options.margin);
    add("dot-spacing", options.spacing);
    add("border", options.border);
    add("symmetry", options.symmetry.value_or(""));
    add_number("density", options.density.value_or(0), options.density.has_value());
    add_number("joined", options.joined, options.joined > 0);
    add_number("period", options.period, options.period > 0);
    add_flag("single-line", options.single_line);
    add_number("attempts", options.attempts, options.attempts != KolamGridOptions().attempts);
    add("rim", options.rim == KolamGridOptions().rim ? "" : options.rim);
    add_flag("colours", options.colours);
    add_flag("dots", options.dots);
    add_flag("centred", options.centred);
    add_number("seed", options.seed, true);
    return command;
}

/// The options of a page, as `sikku draw` reads them.
OptionValues page_values(const KolamGridOptions& options) {
    OptionValues values;
    const auto add = [&](const char* name, const std::string& text) {
        if (!text.empty()) values.push_back({name, text});
    };
    add("size", options.size);
    add("landscape", options.landscape ? "true" : "");
    add("margin", options.margin);
    add("dot-spacing", options.spacing);
    return values;
}

/// The page that a kolam fills.
struct FilledPage {
    PageFill fill;
    Page page;
    std::optional<Border> border = {};

    /// Leaves the room of the page within its margins and the border. @throws UsageError
    void find_room() {
        const double around = page.margin + (border ? border_room(*border, page) : 0);
        fill.room = {page.width - 2 * around, page.height - 2 * around};
        if (!(fill.room.x > 0 && fill.room.y > 0)) throw UsageError("--border leaves no room on this page");
    }
};

FilledPage page_of(const KolamGridOptions& options) {
    FilledPage filled{{.given = *of_option("--grid", [&] { return parse_fill(text_of(options.grid)); })}, {}};
    const DrawSettings settings = read_draw_settings(page_values(options));
    filled.page = settings.paper.page;
    const bool grows_both = filled.fill.given.rows == 0 && filled.fill.given.columns == 0;
    if (grows_both != settings.look.dot_spacing.has_value()) {
        throw UsageError(grows_both ? "--grid fill needs --dot-spacing"
                                    : "--dot-spacing needs --grid fill; a number of dots determines the spacing");
    }
    filled.fill.spacing = settings.look.dot_spacing;
    if (!options.border.empty() && options.border != "none") {
        const auto border = parse_border(options.border);
        if (!border) throw UsageError("--border: not a border; expected a name, PATTERN or PATTERN,CORNER");
        filled.border = Border{.kind = border->kind};
        // A pattern takes as much room as any other, but has to exist.
        Style style;
        style.border = border;
        DrawingOptions loaded;
        load_border(style, parse("-", "axiom: F\n"), settings, std::filesystem::current_path(), loaded);
    }
    return filled;
}

/// Makes the kolam for the room within a border, whose weight depends on the kolam.
PageKolam make_within(FilledPage& filled, const GridKolamOptions& options, const KolamPatternOptions& look) {
    constexpr int most_tries = 3;
    filled.find_room();
    PageKolam made = make_page_kolam(filled.fill, options, look, stop_monitor());
    for (int i = 1; i < most_tries && filled.border; ++i) {
        const double before = filled.border->weight;
        filled.border->weight = border_weight(
            filled.page, made.pattern.line * step_within_border(filled.page, made.pattern.size - made.pattern.line));
        if (filled.border->weight == before) break;
        filled.find_room();
        made = make_page_kolam(filled.fill, options, look, stop_monitor());
    }
    return made;
}

void fill_page(const KolamGridOptions& options, bool quiet) {
    check_output(options);
    if (options.crossings) {
        throw UsageError("--crossings needs a grid of fixed size; expected --density for a grid that fills a page");
    }
    if (options.enumerate) throw UsageError("--enumerate needs the numbers of rows and columns");
    FilledPage filled = page_of(options);
    check_centred(options, filled.fill.given.lattice);
    std::optional<GridSymmetry> symmetry;
    if (options.symmetry) symmetry = of_option("--symmetry", [&] { return parse_grid_symmetry(*options.symmetry); });
    KolamPatternOptions look = look_of(options);
    look.source = command_of(options);
    const PageKolam made = make_within(filled, request_of(options, symmetry), look);
    const std::string fitted = fmt::format("; fills {:.4g} x {:.4g} mm within {:.2f} of {:.3g} mm between dots",
                                           filled.fill.room.x, filled.fill.room.y, made.slack, made.spacing);
    write_kolam(options, made.grid, made.kolam, made.look, fitted, quiet,
                [&]() -> const KolamPattern& { return made.pattern; });
    if (!made.skipped.empty()) tell_unless(quiet, "sikku: note: another grid fits better, but {}\n", made.skipped);
}

/// Refuses the options of a page for grids of a given size.
void refuse_page(const KolamGridOptions& options) {
    for (const auto& [name, is_given] : {std::pair("--size", !options.size.empty()),
                                         {"--landscape", options.landscape},
                                         {"--margin", !options.margin.empty()},
                                         {"--dot-spacing", !options.spacing.empty()},
                                         {"--border", !options.border.empty()}}) {
        if (!is_given) continue;
        throw UsageError(
            fmt::format("{} needs a --grid that fills the page, such as 7xfill; 'sikku draw {}' sets the "
                        "page of a print",
                        name, name));
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

void add_page_options(const OptionGroup& group, KolamGridOptions& options, CLI::Option* grid) {
    for (const auto& [name, value, type, help] :
         {std::tuple("--size", &options.size, "SIZE",
                     "page that --grid 7xfill, fillx22 or fill is to fill, as in `sikku draw` (A4)"),
          {"--margin", &options.margin, "LENGTH", "margin of that page (10mm)"},
          {"--dot-spacing", &options.spacing, "LENGTH",
           "approximate distance between dots of --grid fill on the page"},
          {"--border", &options.border, "NAME", "leave room for this border of `sikku draw`"}}) {
        group.add(name, *value, type, help)->needs(grid);
    }
    group.flag("--landscape", options.landscape, "landscape page")->needs(grid);
}

}  // namespace

bool KolamGridOptions::is_fill() const {
    return of_option("--grid", [&] { return parse_fill(text_of(grid)).has_value(); });
}

void add_kolam_grid_options(CLI::App& command, KolamGridOptions& options) {
    const OptionGroup group{command, grid_heading};
    auto* grid = group.add(
        "--grid", options.grid, "DOTS",
        "make a kolam on this grid of dots, or with --read the dots that the kolam of a photograph has: 7x7, the "
        "dots "
        "of each row (1-3-5-3-1), the longest row and the last ('7 to 1 ner pulli', '15-8 idukku pulli'), blocks "
        "(15x9-9x3), letters (text:MEERA, 'text 18:MEERA' with 18 rows of dots), a shape of 'o' and '.' "
        "(oo./ooo/.oo), "
        "or rows or columns until the page (--size) is full (7xfill, 'fillx7 idukku', fill); @FILE reads it from a "
        "file");
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
    auto* period = group.add("--period", options.period, "COLUMNS",
                             "columns after which crossings repeat, as in a frieze: copies of a motif are joined by "
                             "their lines; with --single-line, gaps at the ends of rows differ where necessary");
    period->check(whole_number(1, 1'000'000));
    for (CLI::Option* option : {symmetry, density, joined, crossings, period, single}) option->needs(grid);
    for (CLI::Option* share : {density, joined}) share->check(number_between(0, 1));
    for (CLI::Option* option : {symmetry, density, joined, period}) crossings->excludes(option);
    group
        .add("--attempts", options.attempts, "N",
             "attempts to find a single line with a symmetry or a period, 1 to 1000000 (1000)")
        ->needs(single)
        ->check(whole_number(1, 1'000'000));
    add_page_options(group, options, grid);
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
    auto* centred = group.flag("--centred", options.centred,
                               "also set a dot in each field between four dots whose four gaps are crossed; needs "
                               "straight rows");
    centred->needs(grid);
    auto* rim = group.add("--rim", options.rim, "STYLE",
                          "shape of the loops at the rim: round, pointed, petal, horn or crescent (round)");
    rim->needs(grid);
    auto* enumerate = group.flag("--enumerate", options.enumerate,
                                 "count and list all single-line kolams; with --symmetry, only symmetric ones");
    enumerate->needs(grid);
    for (CLI::Option* option : {crossings, density, period, single, colours, dots, centred, rim})
        enumerate->excludes(option);
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
    if (options.is_fill()) return fill_page(options, quiet);
    refuse_page(options);
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
