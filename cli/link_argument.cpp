#include "cli/link_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

namespace sikku {
namespace {

/// Names of the settings and options of a link that options on the command line replace.
std::set<std::string> replaced_names(const PatternOptions& options) {
    std::set<std::string> names;
    // A single derivation length and a list of generations exclude each other.
    if (!options.steps.empty()) names = {"derivation length", "generations"};
    if (!options.seed.empty()) names.insert("seed");
    for (const std::string& text : options.settings) names.insert(text.substr(0, text.find('=')));
    return names;
}

/// True for options that set the scale of a drawing, of which only one can be given.
bool sets_scale(const std::string& name) {
    return name == "fit" || name == "step" || name == "dot-spacing";
}

}  // namespace

bool has_option(const OptionValues& values, std::string_view name) {
    return std::any_of(values.begin(), values.end(), [&](const OptionValue& value) { return value.name == name; });
}

std::optional<SharedWork> read_link_argument(const std::string& pattern) {
    std::error_code error;
    if (!is_link(pattern) || std::filesystem::exists(pattern, error)) return std::nullopt;
    try {
        return read_link(pattern);
    } catch (const LinkError& damaged) {
        throw UsageError(damaged.what());
    }
}

std::vector<Setting> settings_of(const SharedWork& link, const PatternOptions& options) {
    const std::set<std::string> replaced = replaced_names(options);
    std::vector<Setting> settings;
    for (const OptionValue& value : link.settings) {
        if (replaced.contains(value.name)) continue;
        // Messages quote the origin; recipes recognise a seed by it.
        const char* origin = value.name == "derivation length" ? "-n"
                             : value.name == "seed"            ? "--seed"
                                                               : "link --set";
        settings.push_back({origin, value.name, value.text});
    }
    return settings;
}

OptionValues options_with(const OptionValues& shared, const OptionValues& given, const PatternOptions& options) {
    const std::set<std::string> replaced = replaced_names(options);
    OptionValues values;
    for (const OptionValue& value : shared) {
        const bool is_given = std::any_of(given.begin(), given.end(), [&](const OptionValue& other) {
            return other.name == value.name || (sets_scale(other.name) && sets_scale(value.name));
        });
        if (!is_given && !replaced.contains(value.name)) values.push_back(value);
    }
    values.insert(values.end(), given.begin(), given.end());
    return values;
}

std::string describe_settings(const SharedWork& link) {
    std::string text;
    const auto append = [&](const char* heading, const OptionValues& values) {
        if (values.empty()) return;
        text += fmt::format("{}{}", text.empty() ? "" : "; ", heading);
        const char* separator = "";
        for (const OptionValue& value : values) {
            text += fmt::format("{}{} {}", separator, value.name, value.text);
            separator = ", ";
        }
    };
    OptionValues settings = link.settings;
    if (!link.variant.empty()) settings.insert(settings.begin(), {"variant", link.variant});
    append("", settings);
    append("draw: ", link.draw);
    append("play: ", link.play);
    return text;
}

}  // namespace sikku
