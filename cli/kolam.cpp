// cli/kolam.cpp: `sikku kolam`: examines a drawing as a kolam.
#include "art/analysis.h"
#include "art/kolam/kolam_text.h"
#include "cli/command.h"
#include "cli/kolam_grid.h"
#include "cli/kolam_read.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/text.h"

#include <fmt/format.h>

namespace sikku {

namespace {

/// Refuses the options that make a kolam, except those that have a meaning for --read, too.
void refuse_options_of_grids(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || option->get_group() != grid_heading) continue;
        if (name != "--grid" && name != "--output" && name != "--jobs") {
            throw UsageError(fmt::format("--read excludes {}", name));
        }
    }
}

}  // namespace

void add_kolam(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("kolam",
                                       "Examine a drawing as a kolam, make one on a grid of dots, or read one from a "
                                       "photograph or another format");
    auto options = std::make_shared<ExaminationOptions>();
    auto grid = std::make_shared<KolamGridOptions>();
    auto read = std::make_shared<KolamReadOptions>();
    add_pattern_options(*command, *options);
    command->get_option("PATTERN")->required(false);
    add_kolam_grid_options(*command, *grid);
    const OptionGroup group{*command, grid_heading};
    group.add("-o,--output", grid->output, "FILE",
              "pattern file (standard output); without --radial also .kolam.json, .csv (single lines) or .yaml "
              "(gestures)");
    add_kolam_read_options(*command, *read);
    group.add("-j,--jobs", grid->threads, "N", "threads of --enumerate; 0: one per core (0)")
        ->check(whole_number(0, 1024));
    command->add_flag("--json", options->as_json, "print one line of JSON");
    add_budget_option(*command, options->budget);
    command->footer(
        "In a kolam every dot is encircled, every line is closed, and nothing is drawn twice. Violations of these "
        "rules and unusual features are reported. Dots are placed by tradition: one in each loop, none in the gaps "
        "between loops; a pattern that has dots elsewhere, such as a radial kolam, keeps its own, and lines may run "
        "through them. Positions are in turtle steps; the turtle starts at 0 0; the examination is exact where the "
        "angles allow it. With `line: spline`, the polygon that guides the spline is examined.\n\n"
        "With --grid or --radial, the command makes a kolam instead, as a pattern file. With --read, it reads one; "
        "with PATTERN and -o, it reads the kolam that the pattern draws. The report counts dots, gaps and lines, "
        "and lists doubtful gaps by row and number: rows of gaps count from the top, first the gaps within a row of "
        "dots, then those to the next row; numbers count from the left. Photographs need visible dots; where the "
        "certain gaps have a symmetry, doubtful ones take the state of their images.\n\n"
        "The exit status is 0 whether or not the drawing is a kolam. Keys of --json: title, n, kolam, faults, "
        "remarks, exact, tolerance, spline, segments, strokes, lines, open_lines, straight_lines (going straight on "
        "at every meeting), vertices, edges, components, faces (bounded), reused_edges, meetings (points visited "
        "more than once: crossings, touchings, multiple, or ends of reused edges), crossings, skew (crossings not "
        "at right angles), sixty_degrees (skew crossings at 60 degrees), mid_crossings (crossings inside segments), "
        "touchings, multiple, diagram (the lines as an alternating knot or link, or null: alternating, crossings, "
        "components, parts, nugatory, reduced, crossing_number, writhe, linked_pairs), symmetry, rotations, "
        "mirrors, centre, loose_dots, dots_on_lines, dots. With --read: grid, dots, gaps, crossed, joined, lines, "
        "symmetry, doubtful and repaired (row, gap, state, certainty), notes, crossings; of a photograph also "
        "kolams, "
        "open_ends, missing and completed (row, place, x, y).\n\n"
        "Examples:\n"
        "  sikku kolam snake-kolam\n"
        "  sikku kolam --grid 7x7 --symmetry C4 --single-line --seed 3 -o mine.lsys\n"
        "  sikku kolam --grid '15-8 idukku pulli' -o interlaced.lsys\n"
        "  sikku kolam --grid 5xfill --size 120x40cm --period 4 --single-line -o doorstep.lsys\n"
        "  sikku kolam --radial 8x5 --dots -o hridaya.lsys\n"
        "  sikku kolam --grid 3x3 --enumerate\n"
        "  sikku kolam --read photo.jpg -o mine.lsys --overlay found.png\n"
        "  sikku kolam --read photo.jpg -o mine.lsys --fix '3,4: cross; 5,1: turn'\n"
        "  sikku kolam --read photo.jpg --grid 9-5 --crop 200,100,1200,1200 -o mine.lsys --overlay found.png\n"
        "  sikku kolam mine.lsys -o mine.kolam.json\n"
        "  sikku kolam anklets-of-krishna -n 4 --json");
    command->callback([options, grid, read, command, &quiet] {
        const bool makes = !grid->grid.empty() || !grid->radial.empty();
        const bool has_pattern = !options->pattern.empty() || !options->steps.empty() || !options->settings.empty() ||
                                 !options->variant.empty();
        if (!read->file.empty()) {
            if (has_pattern) throw UsageError("--read excludes PATTERN, -n, --set and --variant");
            refuse_options_of_grids(*command);
            read->grid = grid->grid;
            read->output = grid->output;
            read->as_json = options->as_json;
            read->budget = options->budget;
            return kolam_read(*read, quiet);
        }
        if (makes) {
            if (has_pattern) {
                throw UsageError(fmt::format("{} makes a kolam; it excludes PATTERN, -n, --set and --variant",
                                             grid->radial.empty() ? "--grid" : "--radial"));
            }
            grid->as_json = options->as_json;
            grid->seed = seed_of(*options);
            return grid->radial.empty() ? kolam_grid(*grid, quiet) : kolam_radial(*grid, quiet);
        }
        if (grid->colours || grid->dots) throw UsageError("--colours and --dots need --grid or --radial");
        if (options->pattern.empty()) {
            throw UsageError(grid->output.empty() ? "expected PATTERN, --grid, --radial or --read"
                                                  : "-o needs PATTERN, --grid, --radial or --read");
        }
        if (!grid->output.empty() && options->as_json)
            throw UsageError("--json excludes -o: it prints the examination");
        const Document loaded = load(*options, quiet);
        keep_input("-o", grid->output, options->pattern);
        if (!grid->output.empty()) return kolam_convert(loaded, grid->output, options->budget, quiet);
        Progress progress(quiet);
        const KolamExamination examined = examine_kolam(loaded, options->budget, progress.monitor());
        const std::string title = loaded.pattern().text("title");
        const std::int64_t n = loaded.grammar().steps();
        fmt::print("{}", options->as_json ? kolam_json(title, n, examined) : kolam_text(title, n, examined));
    });
}

}  // namespace sikku
