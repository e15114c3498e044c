// cli/plotters.cpp: `sikku plotters`: the bundled profiles of plotters.
#include "art/plotter/profile.h"
#include "cli/command.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <vector>

namespace sikku {
namespace {

void print_profiles() {
    for (const BundledProfile& known : bundled_profiles()) {
        const PlotterProfile profile = bundled_profile(known.name).value();
        fmt::print("{:<12}{:<8}{}\n", known.name, language_name(profile.language), profile.title);
    }
}

void show(const std::string& name) {
    std::vector<std::string_view> names;
    names.reserve(bundled_profiles().size());
    for (const BundledProfile& known : bundled_profiles()) {
        if (known.name == name) return fmt::print("{}", known.text);
        names.push_back(known.name);
    }
    throw UsageError(fmt::format("unknown plotter '{}'; expected {}", printable(name), alternatives(names)));
}

}  // namespace

void add_plotters(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand("plotters", "List the bundled plotters, or print the file of one");
    auto name = std::make_shared<std::string>();
    command->add_option("NAME", *name, "plotter whose file is printed");
    command->footer(
        "To describe your own plotter, edit a copy of a bundled file and pass it to `sikku draw --profile`.\n\n"
        "Examples:\n  sikku plotters\n  sikku plotters marlin > mine.plotter\n"
        "  sikku draw snake-kolam --profile ./mine.plotter -o snake.gcode");
    command->callback([name] { name->empty() ? print_profiles() : show(*name); });
}

}  // namespace sikku
