// cli/kolam.cpp: `sikku kolam`: what there is to know of a drawing as a kolam.
#include "art/kolam/kolam.h"
#include "art/style/style.h"
#include "cli/command.h"
#include "cli/kolam_grid.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace sikku {
namespace {

/// In turtle steps, to a millionth of one.
std::string number(double value) {
    const double rounded = std::round(value * 1e6) / 1e6;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);  // never -0
}
std::string json(glm::dvec2 point) {
    return fmt::format("[{}, {}]", number(point.x), number(point.y));
}
std::string json(bool value) {
    return value ? "true" : "false";
}
std::string json(const std::vector<std::string>& texts) {
    std::string list = "[";
    for (const std::string& text : texts) list += (list.size() > 1 ? ", " : "") + json_string(text);
    return list + "]";
}

std::string json(const std::string& title, std::int64_t n, const KolamExamination& k) {
    std::string dots;
    for (const KolamDot& dot : k.dots) dots += (dots.empty() ? "" : ", ") + json(dot.at);
    std::string text = fmt::format("{{\"title\": {}, \"n\": {}, \"kolam\": {}, \"faults\": {}, \"remarks\": {}, ",
                                   json_string(title), n, json(k.is_kolam()), json(k.faults()), json(k.remarks()));
    text += fmt::format("\"exact\": {}, \"tolerance\": {}, \"spline\": {}, \"segments\": {}, \"strokes\": {}, ",
                        json(k.is_exact), k.tolerance, json(k.is_spline), k.segments, k.strokes);
    text += fmt::format("\"lines\": {}, \"open_lines\": {}, \"straight_lines\": {}, ", k.lines, k.open_lines,
                        k.straight_lines);
    text += fmt::format("\"vertices\": {}, \"edges\": {}, \"components\": {}, \"faces\": {}, \"reused_edges\": {}, ",
                        k.vertices, k.edges, k.components, k.faces, k.reused_edges);
    text += fmt::format("\"meetings\": {}, \"crossings\": {}, \"skew\": {}, \"mid_crossings\": {}, ", k.meetings,
                        k.crossings, k.skew, k.mid_crossings);
    text += fmt::format("\"touchings\": {}, \"multiple\": {}, ", k.touchings, k.multiple);
    text += fmt::format("\"symmetry\": \"{}\", \"rotations\": {}, \"mirrors\": {}, \"centre\": {}, ",
                        k.symmetry.name(), k.symmetry.rotations, k.symmetry.mirrors, json(k.centre));
    return text + fmt::format("\"loose_dots\": {}, \"dots\": [{}]}}\n", k.loose_dots(), dots);
}

std::string prose(const std::string& title, std::int64_t n, const KolamExamination& k) {
    std::string text = fmt::format("{}, n = {}\n", title.empty() ? "(untitled)" : printable(title), n);
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<11}{}\n", name, value);
    };
    const auto list = [](const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); };
    const auto plural = [](std::uint64_t count, std::string_view one, std::string_view many) {
        return fmt::format("{} {}", count, count == 1 ? one : many);
    };

    const std::vector<std::string> faults = k.faults();
    if (faults.empty()) {
        line("kolam", fmt::format("yes: {}, {}, all encircled",
                                  k.lines == 1 ? "a single line (anthathi)" : counted(k.lines, "closed line"),
                                  counted(k.dots.size(), "dot")));
    } else {
        line("kolam", "no: " + list(faults));
    }
    if (const auto remarks = k.remarks(); !remarks.empty()) line("remarks", list(remarks));

    std::string lines = fmt::format("{}", k.lines);
    if (k.open_lines > 0) lines += fmt::format(", {} of them open", k.open_lines);
    if (k.straight_lines != k.lines) {
        lines += fmt::format("; {} if one goes straight on where they meet", k.straight_lines);
    }
    line("lines", lines);
    line("strokes", fmt::format("{} of {}", k.strokes, plural(k.segments, "segment", "segments")));
    std::string crossings = fmt::format("{}", k.crossings);
    if (k.crossings > 0) {
        crossings +=
            k.skew == 0 ? ", all at right angles" : fmt::format(", {} at right angles", k.crossings - k.skew);
        if (k.mid_crossings > 0) crossings += fmt::format(", {} inside of segments", k.mid_crossings);
    }
    line("crossings", crossings);
    line("touching", fmt::format("{}{}", k.touchings,
                                 k.is_spline && k.touchings > 0 ? "; the spline keeps the strands apart there" : ""));
    if (k.multiple > 0) line("multiple", fmt::format("{}", k.multiple));
    line("meetings", fmt::format("{}", k.meetings));
    line("reused", plural(k.reused_edges, "edge", "edges"));
    line("faces", fmt::format("{} ({}, {}, {})", k.faces, plural(k.edges, "edge", "edges"),
                              plural(k.vertices, "vertex", "vertices"), plural(k.components, "piece", "pieces")));
    line("dots", fmt::format("{}", k.dots.size()));
    line("symmetry",
         fmt::format("{}: {}, {}, about {} {}", k.symmetry.name(),
                     k.symmetry.rotations == 1 ? "no rotation" : fmt::format("{} rotations", k.symmetry.rotations),
                     k.symmetry.mirrors == 0 ? "no mirror" : plural(k.symmetry.mirrors, "mirror", "mirrors"),
                     number(k.centre.x), number(k.centre.y)));
    line("exact", k.is_exact ? "yes"
                             : fmt::format("no: the angles have no lattice; points within {} steps of each other "
                                           "count as one",
                                           k.tolerance));
    return text;
}

}  // namespace

void add_kolam(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("kolam", "Examine a drawing as a kolam, or make a kolam on a grid of dots");
    auto options = std::make_shared<PatternOptions>();
    auto grid = std::make_shared<KolamGridOptions>();
    auto as_json = std::make_shared<bool>(false);
    auto budget = std::make_shared<double>(200e6);
    add_pattern_options(*command, *options);
    command->get_option("PATTERN")->required(false);
    add_kolam_grid_options(*command, *grid);
    command->add_option("-o,--output", grid->output, "pattern file (standard output)")
        ->needs("--grid")
        ->type_name("FILE")
        ->group(grid_heading);
    command->add_option("-j,--jobs", grid->threads, "threads of --enumerate; 0: one for each core (0)")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->group(grid_heading);
    command->add_flag("--json", *as_json, "print one line of JSON");
    add_budget_option(*command, *budget);
    command->footer(
        "In a kolam every dot is encircled, every line is closed, and nothing is drawn twice. Violations are "
        "reported, "
        "and unusual features are remarked on. Dots are where the tradition sets them: one in each loop, none in the "
        "gaps between. Places are in steps of the turtle, which starts at 0 0; the examination is exact where the "
        "angles allow it. With `line: spline`, the polygon that guides the spline is examined.\n\n"
        "With --grid a kolam is made instead, as a pattern file.\n\n"
        "The exit status is 0 whether it is a kolam or not. Keys of --json: title, n, kolam, faults, remarks, exact, "
        "tolerance, spline, segments, strokes, lines, open_lines, straight_lines (going straight on at every "
        "meeting), "
        "vertices, edges, components, faces (bounded), reused_edges, meetings (points visited more than once: "
        "crossings, touchings, multiple, or ends of reused edges), crossings, skew (crossings not at right angles), "
        "mid_crossings (crossings inside of segments), touchings, multiple, symmetry, rotations, mirrors, centre, "
        "loose_dots, dots.\n\n"
        "Examples:\n"
        "  sikku kolam snake-kolam\n"
        "  sikku kolam --grid 7x7 --symmetry C4 --single-line --seed 3 -o mine.lsys\n"
        "  sikku kolam --grid 3x3 --enumerate\n"
        "  sikku kolam anklets-of-krishna -n 4 --json");
    command->callback([options, grid, as_json, budget, &quiet] {
        if (!grid->grid.empty()) {
            if (!options->pattern.empty() || !options->steps.empty() || !options->settings.empty() ||
                !options->variant.empty()) {
                throw UsageError("--grid makes a kolam; it goes without PATTERN, -n, --set and --variant");
            }
            grid->as_json = *as_json;
            grid->seed = seed_of(*options);
            return kolam_grid(*grid, quiet);
        }
        if (options->pattern.empty()) throw UsageError("expected PATTERN, or --grid");
        const Document loaded = load(*options, quiet);
        Diagnostics diagnostics;
        KolamOptions examination;
        const Style style = read_style(loaded.pattern(), 300, diagnostics);
        examination.spline = style.line == Line::spline;
        examination.moves_lift = style.moves_lift;
        examination.draws = [&style](const Pen& pen) { return style.draws(pen); };
        examination.budget = *budget;
        Progress progress(quiet);
        examination.watch = progress.watch();
        examination.monitor = stop_monitor();
        const KolamExamination examined = examine_kolam(loaded.grammar(), examination);
        const std::string title = loaded.pattern().text("title");
        const std::int64_t n = loaded.grammar().steps();
        fmt::print("{}", *as_json ? json(title, n, examined) : prose(title, n, examined));
    });
}

}  // namespace sikku
