#include "cli/link_argument.h"

#include "art/prints.h"
#include "engine/base/keys.h"
#include "engine/language/pattern.h"

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
    const OptionInfo* row = find_option(prints().options(), name);
    return row && row->sets_scale;
}

constexpr const char* pattern_of_link = "the pattern of the link";

}  // namespace

bool names_file(const Key& key) {
    const KeyInfo* row = find_language_key(key.name);
    return row && row->names_file && row->names_file(key.value.view());
}

void refuse_key(const Key& key, const char* whole, const char* remedy) {
    throw UsageError(fmt::format("{} names a file of this machine: {} '{}'{}", whole, key.name,
                                 printable(key.value.view(), 80), remedy));
}

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
        const bool is_length = value.name == "derivation length";
        settings.push_back(is_length || value.name == "seed"
                               ? Setting(is_length ? "-n" : "--seed", value.name, value.text)
                               : Setting::assignment("link --set", value.name, value.text));
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

void check_pattern_of_link(const SharedWork& link, const std::string& variant, const PatternOptions& options) {
    if (options.trusts_link) return;
    Diagnostics diagnostics;  // reported when the pattern is compiled
    Pattern pattern = parse_pattern(link.name, link.text, diagnostics);
    apply_overrides(pattern, variant, settings_of(link, options), diagnostics);
    const std::set<std::string> replaced = replaced_names(options);
    for (const Key& key : pattern.keys) {
        if (!replaced.contains(key.name) && names_file(key))
            refuse_key(key, pattern_of_link, "; --trust-link allows it");
    }
}

void check_text(const SharedWork& work, const char* whole, const char* remedy) {
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern(work.name, work.text, diagnostics);
    const auto check = [&](const std::vector<Key>& keys) {
        for (const Key& key : keys) {
            if (names_file(key)) refuse_key(key, whole, remedy);
        }
    };
    check(pattern.keys);
    for (const Variant& variant : pattern.variants) check(variant.settings);
}

void check_text_of_link(const SharedWork& link) {
    check_text(link, pattern_of_link, "; `sikku show` prints the pattern");
}

void check_options_of_link(std::span<const OptionInfo* const> table, const OptionValues& shared,
                           const OptionValues& given, const PatternOptions& options) {
    if (options.trusts_link) return;
    for (const OptionValue& value : shared) {
        if (has_option(given, value.name)) continue;
        const OptionInfo* row = find_option(table, value.name);
        const KeyInfo* key = row ? nullptr : find_language_key(value.name);
        if (row ? !row->is_local(value.text) : !key || !key->names_file || !key->names_file(value.text)) continue;
        const bool is_file = !row || (row->names_file && row->names_file(value.text));
        throw UsageError(fmt::format("the link {}: {} '{}'; --trust-link allows it{}",
                                     is_file ? "names a file of this machine" : "sets commands for a plotter",
                                     value.name, printable(value.text, 80),
                                     row ? fmt::format(", and --{} replaces it", value.name) : ""));
    }
}

std::string describe_settings(const SharedWork& link) {
    std::string text;
    const auto append = [&](const char* heading, const OptionValues& values) {
        if (values.empty()) return;
        text += fmt::format("{}{}", text.empty() ? "" : "; ", heading);
        const char* separator = "";
        for (const OptionValue& value : values) {
            text += fmt::format("{}{} {}", separator, printable(value.name, 80), printable(value.text, 500));
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
