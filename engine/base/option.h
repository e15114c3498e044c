// engine/base/option.h: options of an interpreter as rows of a table. The command line, gallery files, JSON and other
// languages all read the same rows.
#pragma once

#include <charconv>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {

/// What the value of an option may be before the option reads it.
enum class OptionKind : std::uint8_t { text, number, whole, flag };

/// One row without its setter.
struct OptionInfo {
    std::string_view name;     ///< lower case, words joined by hyphens
    std::string_view help;     ///< a noun phrase or an imperative, with range and default
    std::string_view value{};  ///< stands for the value in help, `SIZE`; in brackets if it may be left out
    std::string_view group{};  ///< heading in help; empty: the first
    std::string_view unit{};   ///< may follow the number: `40mm/s`
    OptionKind kind = OptionKind::text;
    double least = -1e300;  ///< of numbers
    double most = 1e300;
    bool is_list = false;    ///< may be given several times
    bool is_alone = false;   ///< not in galleries, whose jobs are one file of one derivation length each
    bool is_on = false;      ///< a flag that holds unless it is set to false
    char letter = 0;         ///< short form on the command line; 0: none
    bool sets_more = false;  ///< of `is_key`: accepts values that the key does not
    bool is_key = false;     ///< also a key of the language, which the option overrides
};

/// `set` reads the text of a value; numbers are in range, flags are `true` or `false`.
/// @throws SettingError (through refuse_option()) for a value that cannot be read
template <typename Settings>
struct Option {
    OptionInfo info;
    void (*set)(Settings& settings, const std::string& text);
    /// Instead of `set`, for rows that share one setter.
    void (*set_named)(Settings& settings, std::string_view name, const std::string& text) = nullptr;
};

/// An option by name and the text of its value.
struct OptionValue {
    std::string name;
    std::string text;
};
using OptionValues = std::vector<OptionValue>;

/// A value, or a combination of values, that is not possible. what() is the whole message without the name of the
/// option, so that each caller can name the option as its users write it.
class SettingError : public std::runtime_error {
public:
    SettingError(std::string option, std::string value, const std::string& message)
        : std::runtime_error(message), option_(std::move(option)), value_(std::move(value)) {}
    const std::string& option() const { return option_; }  ///< as in the table
    const std::string& value() const { return value_; }    ///< empty where the combination is at fault

private:
    std::string option_;
    std::string value_;
};

/// The text of a value without the unit of its option.
std::string without_unit(const OptionInfo& option, const std::string& text);

/// Checks a value against kind and range of its option. @throws SettingError
void check_option(const OptionInfo& option, const std::string& text);

/// @throws SettingError, always
[[noreturn]] void refuse_option(std::string_view option, const std::string& value, const std::string& message);

/// The number that a checked text holds.
double to_number(const std::string& text);

/// Reads a whole number. @throws SettingError if it does not fit
template <typename Whole>
void read_whole(std::string_view option, const std::string& text, Whole& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) refuse_option(option, text, "too large");
}

/// The option of every interpreter that derives words.
constexpr OptionInfo budget_option = {.name = "budget",
                                      .help = "maximum number of derivation nodes visited (2e8)",
                                      .value = "NODES",
                                      .kind = OptionKind::number};
/// @throws SettingError
double read_budget(const std::string& text);

/// The row of that name, or null.
const OptionInfo* find_option(std::span<const OptionInfo* const> table, std::string_view name);

/// Throws SettingError for unknown and repeated names.
void check_names(std::span<const OptionInfo* const> table, const OptionValues& values);

/// Applies values in the order of the table, so that rows may build on those before them (lengths in px on `dpi`).
/// @throws SettingError for an unknown name, a repeated one that is no list, and for what a row refuses
template <typename Settings>
void apply_options(std::span<const Option<Settings>> table, const OptionValues& values, Settings& settings) {
    std::vector<const OptionInfo*> known;
    for (const Option<Settings>& row : table) known.push_back(&row.info);
    check_names(known, values);
    for (const Option<Settings>& row : table) {
        for (const OptionValue& value : values) {
            if (value.name != row.info.name) continue;
            check_option(row.info, value.text);
            const std::string text = without_unit(row.info, value.text);
            if (row.set_named) {
                row.set_named(settings, row.info.name, text);
            } else {
                row.set(settings, text);
            }
        }
    }
}

}  // namespace sikku
