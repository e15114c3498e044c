// cli/measure.cpp: `sikku measure`: what is known of a word without deriving it.
#include "cli/command.h"
#include "engine/base/text.h"
#include "engine/measure/extent.h"
#include "engine/measure/measurement_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace sikku {

void add_measure(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("measure", "Measure the word of a pattern: length, counts, box, end");
    auto options = std::make_shared<PatternOptions>();
    auto as_json = std::make_shared<bool>(false);
    auto budget = std::make_shared<double>(200e6);
    add_pattern_options(*command, *options);
    command->add_flag("--json", *as_json, "print one line of JSON");
    add_budget_option(*command, *budget);
    command->footer(
        "Lengths are in turtle steps; the turtle starts at 0 0. In space, positions have x, y and z. Systems without "
        "contexts are measured without deriving them: n = 60 costs as little as n = 6.\n\n"
        "Examples:\n"
        "  sikku measure snake-kolam\n"
        "  sikku measure hilbert -n 60 --json");
    command->callback([options, as_json, budget, &quiet] {
        const Document loaded = load(*options, quiet);
        Progress progress(quiet);
        const Measurement measured = measure(loaded.grammar(), *budget, progress.watch());
        const std::string title = loaded.pattern().text("title");
        fmt::print("{}", *as_json ? measurement_json(title, measured) : measurement_text(title, measured));
    });
}

}  // namespace sikku
