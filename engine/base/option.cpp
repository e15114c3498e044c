#include "engine/base/option.h"

#include "engine/base/decimal.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>

namespace sikku {
namespace {

std::string whole_message(const std::string& option, const std::string& value, const std::string& message) {
    if (option.empty()) return message;
    return fmt::format("{}{}{}: {}", option, value.empty() ? "" : " ", printable(value, 80), message);
}

}  // namespace

bool OptionInfo::is_neutral(std::string_view value_text) const {
    if (kind == OptionKind::flag) return value_text == (is_on ? "true" : "false");
    if (neutral.empty()) return false;
    if (value_text == neutral) return true;
    // Lengths in other units.
    const auto is_zero = [](std::string_view text) {
        double number = 1;
        return parse_number(text, number).ec == std::errc() && number == 0;
    };
    return is_zero(value_text) && is_zero(neutral);
}

SettingError::SettingError(std::string option, std::string value, std::string message)
    : std::runtime_error(whole_message(option, value, message)),
      option_(std::move(option)),
      value_(std::move(value)),
      message_(std::move(message)) {}

void refuse_option(std::string_view option, const std::string& value, const std::string& message) {
    throw SettingError(std::string(option), value, message);
}

double to_number(const std::string& text) {
    double value = 0;
    read_number(text, value);
    return value;
}

std::string_view scope_name(Scope scope) {
    static constexpr std::array<std::string_view, 28> names = {
        "other",  "page",   "framing", "place", "scale",  "tiling", "look",    "turn", "space",   "kolam",
        "extras", "copies", "time",    "file",  "lesson", "sheets", "solid",   "plot", "strokes", "pens",
        "gcode",  "hpgl",   "machine", "press", "trim",   "pixels", "threads", "cost"};
    return names[static_cast<std::size_t>(scope)];
}

double read_budget(const std::string& text) {
    const double budget = to_number(text);
    if (!(budget > 0)) refuse_option(budget_option.name, text, "expected a number above 0");
    return budget;
}

OptionInfo key_option(std::string_view key, std::string_view group, bool is_alone) {
    static std::deque<std::string> texts;  // string_views point into it
    static std::mutex mutex;
    const std::lock_guard guard(mutex);
    const KeyInfo& row = *find_language_key(key);
    const std::string& help = texts.emplace_back(fmt::format("{}: {}", row.help, row.values));
    std::string& name = texts.emplace_back(key);
    std::replace(name.begin(), name.end(), ' ', '-');
    return {.name = name,
            .help = help,
            .value = "VALUE",
            .group = group,
            .is_alone = is_alone,
            .is_key = true,
            .names_file = row.names_file};
}

const OptionInfo* find_option(std::span<const OptionInfo* const> table, std::string_view name) {
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const OptionInfo* one) { return one->name == name; });
    return row == table.end() ? nullptr : *row;
}

std::string on_command_line(const OptionInfo& option, const std::string& value) {
    if (option.kind == OptionKind::flag) {
        if (option.is_neutral(value)) return "";
        return (value == "false" ? " --no-" : " --") + std::string(option.name);
    }
    const std::string text = fmt::format(" --{}", option.name);
    // An optional value: `--dots[=SIZE COLOUR]`.
    if (option.value.starts_with('[')) return value.empty() ? text : text + "=" + shell_word(value);
    return text + " " + shell_word(value);
}

std::string without_folders(std::string_view value) {
    std::string result;
    while (true) {
        const std::size_t comma = std::min(value.find(','), value.size());
        const std::string_view part = value.substr(0, comma);
        // A surface: `NAME = FILE`.
        const std::size_t equals = part.find('=');
        const std::size_t start = part.find_first_not_of(' ', equals == std::string_view::npos ? 0 : equals + 1);
        const bool is_absolute = start != std::string_view::npos && part[start] == '/';
        result += is_absolute ? part.substr(0, start) : part;
        // Without a slash, the name could be that of something bundled.
        if (is_absolute) result.append("./").append(part.substr(part.rfind('/') + 1));
        if (comma == value.size()) return result;
        result += ',';
        value.remove_prefix(comma + 1);
    }
}

void RecipeOptions::add(const OptionInfo& option, const std::string& value) {
    if (option.scope == Scope::threads || option.scope == Scope::cost) return;
    // The neutral value of a key replaces that of the pattern.
    if (!option.is_key && option.is_neutral(value)) return;
    text += on_command_line(option, option.names_file && option.names_file(value) ? without_folders(value) : value);
    for (const std::string_view name : {"generations", "fill-page", "swatch"}) {
        sets_lengths = sets_lengths || option.name == name;
    }
    sets_seed = sets_seed || option.name == "seed";
}

std::string without_unit(const OptionInfo& option, const std::string& text) {
    if (option.unit.empty() || text.size() <= option.unit.size() || !text.ends_with(option.unit)) return text;
    return std::string(trimmed(std::string_view(text).substr(0, text.size() - option.unit.size())));
}

void check_option(const OptionInfo& option, const std::string& given) {
    const auto refuse = [&](const std::string& message) { refuse_option(option.name, given, message); };
    const std::string text = without_unit(option, given);
    if (option.kind == OptionKind::text) return;
    if (option.kind == OptionKind::flag) {
        if (text != "true" && text != "false") refuse("expected true or false");
        return;
    }
    if (option.kind == OptionKind::whole) {
        std::uint64_t value = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc::invalid_argument || stop != text.data() + text.size()) {
            refuse("expected a whole number, 0 or more");
        }
        if (error != std::errc()) refuse("too large");
    }
    double number = 0;
    if (!read_number(text, number)) refuse("expected a number");
    const bool has_least = option.least > -1e300;
    const bool has_most = option.most < 1e300;
    if (number >= option.least && number <= option.most) return;
    if (has_least && has_most) refuse(fmt::format("expected {} to {}", option.least, option.most));
    refuse(has_least ? fmt::format("expected {} or more", option.least)
                     : fmt::format("expected at most {}", option.most));
}

void check_names(std::span<const OptionInfo* const> table, const OptionValues& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string& name = values[i].name;
        const OptionInfo* row = find_option(table, name);
        if (!row) {
            std::vector<std::string_view> names;
            for (const OptionInfo* one : table) names.push_back(one->name);
            refuse_option(name, "", "unknown option" + did_you_mean(nearest(name, names)));
        }
        if (row->is_list) continue;
        for (std::size_t j = 0; j < i; ++j) {
            if (values[j].name == name) refuse_option(name, "", "given twice");
        }
    }
}

}  // namespace sikku
