// cli/measure.cpp: `sikku measure`: quantities of words, without deriving them, and of maps.
#include "cli/command.h"
#include "engine/measurement.h"

#include <fmt/format.h>

namespace sikku {

void add_measure(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("measure", "Measure the word or the map of a pattern");
    auto options = std::make_shared<ExaminationOptions>();
    add_pattern_options(*command, *options);
    command->add_flag("--json", options->as_json, "print one line of JSON");
    add_budget_option(*command, options->budget);
    command->footer(
        "Lengths are in turtle steps; the turtle starts at 0 0. In space, positions have x, y and z. Systems without "
        "contexts are measured without deriving them: n = 60 costs as little as n = 6. "
        "Maps are derived: cells, edges, vertices, edges of the outline, edges by label, cells by number of "
        "edges.\n\n"
        "Examples:\n"
        "  sikku measure snake-kolam\n"
        "  sikku measure hilbert -n 60 --json");
    command->callback([options, &quiet] {
        const Document loaded = load(*options, quiet);
        Progress progress(quiet);
        const auto measured = options->as_json ? measure_as_json : measure_as_text;
        fmt::print("{}", measured(loaded, options->budget, progress.monitor()));
    });
}

}  // namespace sikku
