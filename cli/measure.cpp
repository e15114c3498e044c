// cli/measure.cpp: `sikku measure`: quantities of words, without deriving them, and of maps.
#include "cli/command.h"
#include "engine/measurement.h"

#include <fmt/format.h>

namespace sikku {

void add_measure(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("measure", "Measure the word or the map of a pattern");
    auto options = std::make_shared<PatternOptions>();
    auto as_json = std::make_shared<bool>(false);
    auto budget = std::make_shared<double>(200e6);
    add_pattern_options(*command, *options);
    command->add_flag("--json", *as_json, "print one line of JSON");
    add_budget_option(*command, *budget);
    command->footer(
        "Lengths are in turtle steps; the turtle starts at 0 0. In space, positions have x, y and z. Systems without "
        "contexts are measured without deriving them: n = 60 costs as little as n = 6. "
        "Maps are derived: cells, edges, vertices, edges of the outline, edges by label, cells by number of "
        "edges.\n\n"
        "Examples:\n"
        "  sikku measure snake-kolam\n"
        "  sikku measure hilbert -n 60 --json");
    command->callback([options, as_json, budget, &quiet] {
        const Document loaded = load(*options, quiet);
        Progress progress(quiet);
        const Monitor monitor = progress.monitor();
        fmt::print("{}",
                   *as_json ? measure_as_json(loaded, *budget, monitor) : measure_as_text(loaded, *budget, monitor));
    });
}

}  // namespace sikku
