// cli/link_argument.h: links as the argument PATTERN. Options on the command line replace the values and options of a
// link.
#pragma once

#include "art/link/link.h"
#include "cli/command.h"
#include "engine/base/option.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Reads a PATTERN that is a link; returns nothing for files, names and `-`. @throws UsageError for a damaged link
std::optional<SharedWork> read_link_argument(const std::string& pattern);

/// Returns the settings of a link that options on the command line do not replace.
std::vector<Setting> settings_of(const SharedWork& link, const PatternOptions& options);

/// Returns the options of a link that the command line does not replace, followed by those of the command line.
/// @param shared  draw or play options of the link  @param given  options on the command line
OptionValues options_with(const OptionValues& shared, const OptionValues& given, const PatternOptions& options);

/// Refuses links whose pattern names files of this machine by a key that the command line does not replace, unless
/// `options` trusts the link. @param variant  variant that will be used  @throws UsageError
void check_pattern_of_link(const SharedWork& link, const std::string& variant, const PatternOptions& options);

/// Refuses such links for commands without options: variants may not name files either. @throws UsageError
void check_text_of_link(const SharedWork& link);
/// The same for any text from outside. @param whole  what the text is  @param remedy  ends the message
void check_text(const SharedWork& work, const char* whole, const char* remedy);
/// True if the value of the key is the name of a file.
bool names_file(const Key& key);
/// @throws UsageError as check_text()
[[noreturn]] void refuse_key(const Key& key, const char* whole, const char* remedy);

/// Refuses links with draw or play options that name files or set commands for machines, in the same cases.
/// @param table  table of the options  @param shared  options of the link  @param given  options on the command line
void check_options_of_link(std::span<const OptionInfo* const> table, const OptionValues& shared,
                           const OptionValues& given, const PatternOptions& options);

/// True if the option has a value.
bool has_option(const OptionValues& values, std::string_view name);

/// Lists the values and options of a link, for messages: `n 4, seed 7; draw: size A3`. Empty if there are none.
std::string describe_settings(const SharedWork& link);

/// Calls `work`. Adds a note to a SettingError about an option that the link sets and the command line does not.
/// @throws exceptions of `work`
template <typename Work>
auto blaming_link(const OptionValues& shared, const OptionValues& given, Work&& work) {
    try {
        return work();
    } catch (const SettingError& error) {
        if (!has_option(shared, error.option()) || has_option(given, error.option())) throw;
        throw SettingError(error.option(), error.value(), error.message() + " (the link sets this option)");
    }
}

}  // namespace sikku
