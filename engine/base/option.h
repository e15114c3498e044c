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
#include <vector>

namespace sikku {

/// Syntax of an option's value, which is checked before the setter reads it.
enum class OptionKind : std::uint8_t { text, number, whole, flag };

/// Subject of an option. Lists group options by it, and products reject options by it.
enum class Scope : std::uint8_t {
    other,
    page,     ///< the sheet of paper
    framing,  ///< the part of the drawing that fills the page
    place,    ///< position of the drawing on the page
    scale,    ///< the length of a step
    tiling,   ///< part of a tiling that is drawn, and how it is cut
    look,     ///< lines and colours
    turn,     ///< rotation and reflection
    space,    ///< camera and light
    kolam,    ///< dots and strands
    extras,   ///< additions around the drawing
    copies,   ///< the same drawing many times
    time,     ///< several derivation lengths
    file,     ///< names and appearance of the elements of a file
    lesson,   ///< a drawing lesson
    sheets,   ///< a print that is cut into sheets
    solid,    ///< a relief
    plot,     ///< arrangement of lines for a pen
    strokes,  ///< lines that replace filled areas, and their length
    pens,     ///< the plotter and its pens
    gcode,    ///< arcs of G-code
    hpgl,     ///< paper of HP-GL
    machine,  ///< speeds, and lines of G-code around the plot
    press,    ///< inks and bits of a print shop
    trim,     ///< bleed and marks outside of the trimmed sheet
    pixels,   ///< resolution and files of pictures
    threads,  ///< use of the machine's cores
    cost      ///< limits of the work
};

/// The name of a scope, as in the enumeration.
std::string_view scope_name(Scope scope);

/// A row of the table, without its setter.
struct OptionInfo {
    std::string_view name;     ///< lower case, words joined by hyphens
    std::string_view help;     ///< a noun phrase or an imperative, with range and default
    std::string_view value{};  ///< placeholder of the value in help, `SIZE`; in brackets if the value is optional
    std::string_view group{};  ///< heading in help; empty: the first group
    Scope scope = Scope::other;
    std::string_view unit{};  ///< may follow the number: `40mm/s`
    OptionKind kind = OptionKind::text;
    double least = -1e300;  ///< minimum of numbers
    double most = 1e300;
    bool is_list = false;        ///< may be given several times
    std::string_view neutral{};  ///< value equivalent to an absent option: `0mm`; flags need none
    bool is_alone = false;    ///< not available in galleries, where each job makes one file of one derivation length
    bool is_on = false;       ///< a flag that is on by default
    char letter = 0;          ///< short form on the command line; 0: none
    bool sets_more = false;   ///< with `is_key`: accepts more values than the key
    bool is_key = false;      ///< overrides the key of the same name
    bool sets_scale = false;  ///< sets the scale of a drawing; excludes the other options that do
    bool moves_machine = false;  ///< commands or places for a machine, beyond the lines of the drawing
    /// True for values that name files of this machine; null: no value does.
    bool (*names_file)(std::string_view value) = nullptr;

    /// True for a value equivalent to an absent option: the default of a flag, and `neutral`, in any unit.
    bool is_neutral(std::string_view value_text) const;
    /// True for an option that a link must not set unless the user trusts it.
    bool is_local(std::string_view value_text) const {
        return moves_machine || (names_file && names_file(value_text));
    }
};

/// `set` reads the text of a value; numbers are in range, flags are `true` or `false`.
/// @throws SettingError (through refuse_option()) for a value that cannot be read
template <typename Settings>
struct Option {
    OptionInfo info;
    void (*set)(Settings& settings, const std::string& text);
    /// Used instead of `set` by rows that share one setter.
    void (*set_named)(Settings& settings, std::string_view name, const std::string& text) = nullptr;
};

/// An option by name and the text of its value.
struct OptionValue {
    std::string name;
    std::string text;
};
using OptionValues = std::vector<OptionValue>;

/// Reports an invalid value or an invalid combination of options. what() is `option value: message`; callers that
/// write options in another notation (`--size`) use the parts.
class SettingError : public std::runtime_error {
public:
    SettingError(std::string option, std::string value, std::string message);
    const std::string& option() const { return option_; }    ///< name in the table; empty if no option is at fault
    const std::string& value() const { return value_; }      ///< empty if a combination is invalid
    const std::string& message() const { return message_; }  ///< without option and value

private:
    std::string option_;
    std::string value_;
    std::string message_;
};

/// The text of a value without the unit of its option.
std::string without_unit(const OptionInfo& option, const std::string& text);

/// Checks a value against the kind and the range of its option. @throws SettingError
void check_option(const OptionInfo& option, const std::string& text);

/// Throws a SettingError.
[[noreturn]] void refuse_option(std::string_view option, const std::string& value, const std::string& message);

/// Converts a checked text to its number.
double to_number(const std::string& text);

/// Makes an option from a key of the language, with the help in the table of keys. The help text is never freed.
OptionInfo key_option(std::string_view key, std::string_view group, bool is_alone);

/// Reads a whole number. @throws SettingError if it does not fit
template <typename Whole>
void read_whole(std::string_view option, const std::string& text, Whole& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) refuse_option(option, text, "too large");
}

/// The option `budget`, which all interpreters have.
constexpr OptionInfo budget_option = {.name = "budget",
                                      .help = "maximum number of derivation nodes visited (2e8)",
                                      .value = "NODES",
                                      .scope = Scope::cost,
                                      .kind = OptionKind::number};
/// @throws SettingError
double read_budget(const std::string& text);

/// The row of that name, or null.
const OptionInfo* find_option(std::span<const OptionInfo* const> table, std::string_view name);

/// Formats an option and its value as arguments of a command line, with a leading blank: ` --dots='2mm white'`,
/// ` --no-icc`. Empty for a flag with its default value.
std::string on_command_line(const OptionInfo& option, const std::string& value);

/// The options of a recipe: those that affect an output.
struct RecipeOptions {
    std::string text;           ///< as arguments, each with a leading blank, in the order of the table
    bool sets_lengths = false;  ///< an option determines the derivation length, such as `generations`
    bool sets_seed = false;

    /// Omits neutral values, thread counts and limits, and the folders of absolute paths.
    void add(const OptionInfo& option, const std::string& value);
};

/// A value that names files, without the folders of absolute paths: they are private, and differ on each machine.
std::string without_folders(std::string_view value);

/// Throws SettingError for unknown and repeated names.
void check_names(std::span<const OptionInfo* const> table, const OptionValues& values);

/// Applies values in the order of the table, so that rows may build on those before them (lengths in px on `dpi`).
/// @throws SettingError for unknown names, repeated names of options that are not lists, and invalid values
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

template <typename Settings>
RecipeOptions recipe_options(std::span<const Option<Settings>> table, const OptionValues& values) {
    RecipeOptions options;
    for (const Option<Settings>& row : table) {
        for (const OptionValue& value : values) {
            if (value.name == row.info.name) options.add(row.info, value.text);
        }
    }
    return options;
}

}  // namespace sikku
