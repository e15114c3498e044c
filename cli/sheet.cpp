// cli/sheet.cpp: `sikku sheet`: several drawings on one page.
#include "art/print/format.h"
#include "art/prints.h"
#include "art/sheets.h"
#include "cli/command.h"
#include "cli/link_argument.h"
#include "cli/options.h"
#include "cli/sheet_item.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

struct SheetCommand {
    std::vector<std::string> drawings;
    std::string output;
    PatternOptions pattern;  ///< for all drawings
    TableOptions options, prints;
};

std::string_view name_of(std::string_view setting) {
    return setting.substr(0, setting.find('='));
}

/// True if the text begins with the name of an option or key that a drawing can have.
bool begins_setting(std::string_view text) {
    const std::string_view name = trimmed(name_of(text.substr(0, text.find(','))));
    return find_option(place_options(), name) || find_option(prints().options(), name) || find_language_key(name) ||
           name == "n" || name == "variant" || (name != "gap" && text.find('=') < text.find(','));
}

/// Parses `KEY=VALUE,KEY=VALUE`. A comma separates settings only before the name of one.
OptionValues read_settings(std::string_view text) {
    OptionValues values;
    while (!text.empty()) {
        std::size_t end = text.find(',');
        while (end != std::string_view::npos && !begins_setting(text.substr(end + 1))) end = text.find(',', end + 1);
        const std::string_view setting = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        const std::string name(trimmed(name_of(setting)));
        const bool has_value = setting.size() > name_of(setting).size();
        const OptionInfo* row = find_option(prints().options(), name);
        const std::string value = has_value ? std::string(trimmed(setting.substr(setting.find('=') + 1)))
                                  : row && row->kind == OptionKind::flag ? "true"
                                                                         : "";
        values.push_back({name == "n" ? "derivation length" : name, value});
    }
    return values;
}

}  // namespace

SheetItem read_sheet_item(const std::string& text, const PatternOptions& shared, bool quiet) {
    std::error_code error;
    const std::size_t at = std::filesystem::exists(text, error) ? std::string::npos : text.rfind('@');
    PatternOptions pattern = shared;
    pattern.pattern = text.substr(0, at);
    OptionValues values =
        at == std::string::npos ? OptionValues() : read_settings(std::string_view(text).substr(at + 1));
    for (const OptionValue& value : values) {
        if (value.name == "variant") pattern.variant = value.text;
    }
    std::erase_if(values, [](const OptionValue& value) { return value.name == "variant"; });
    return {load(pattern, quiet), std::move(values)};
}

namespace {

void run(const SheetCommand& command, bool quiet) {
    const auto format = print_format(command.output);
    if (!format) {
        throw UsageError(
            fmt::format("-o {}: expected an SVG, PDF, PNG, TIFF, JPEG, EXR, HP-GL or G-code file such as "
                        "sheet.pdf",
                        command.output));
    }
    OptionValues values = command.options.values();
    for (OptionValue& value : command.prints.values()) values.push_back(std::move(value));
    const std::string name(info(*format).extension);
    check_sheet(name, values);
    std::vector<SheetItem> items;
    for (const std::string& drawing : command.drawings)
        items.push_back(read_sheet_item(drawing, command.pattern, quiet));
    const auto work = plan_sheet(items, name, values);
    make(*work, command.output, quiet);
    if (name != "png" && has_option(values, "compression")) {
        tell_unless(quiet, "sikku: warning: --compression has no effect: it applies only to PNG\n");
    }
}

}  // namespace

void add_sheet(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("sheet", "Draw several patterns on one page");
    auto options = std::make_shared<SheetCommand>();
    command
        ->add_option(
            "DRAWING", options->drawings,
            "pattern file, name of a bundled pattern or studio link; then, after @, options of this drawing: "
            "snake-kolam@n=3,dots,border=rope")
        ->required();
    command->add_option("-o,--output", options->output, "output file; its extension selects the format")
        ->type_name("FILE")
        ->required();
    add_trust_option(*command, options->pattern.trusts_link);
    options->options.add(*command, sheet_options());
    options->prints.add(*command, prints().options());
    command->footer(
        "Each drawing has its own ground, dots and border. Options of drawings (--dots, --border, --rotate, …) apply "
        "to all drawings. After @, a drawing can set these options, keys of its pattern, n, variant and title for "
        "itself, and its place by x, y, width and height; if one drawing has a place, all need one.\n\n"
        "Examples:\n"
        "  sikku sheet snake-kolam anklets-of-krishna --columns 2 --gutter 20mm -o two.pdf\n"
        "  sikku sheet a.lsys@dots,border=lotus b.lsys@rotate=90 --titles title -o page.svg\n"
        "  sikku sheet snake-kolam@n=2 snake-kolam@n=3 --same-scale --dots --border kaavi --size A2 -o pair.pdf\n"
        "  sikku sheet a.lsys@x=20mm,y=20mm,width=80mm,height=80mm b.lsys@x=110mm,y=20mm,rotate=90 -o slots.gcode");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
