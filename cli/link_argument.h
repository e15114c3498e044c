// cli/link_argument.h: links in the place of PATTERN: their values and options, as far as the command line does not
// replace them.
#pragma once

#include "art/link/link.h"
#include "cli/command.h"
#include "engine/base/option.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The work in a PATTERN that is a link; nothing for files, names and `-`. @throws UsageError for a damaged link
std::optional<SharedWork> read_link_argument(const std::string& pattern);

/// The settings of a link that the options of the command line do not replace.
std::vector<Setting> settings_of(const SharedWork& link, const PatternOptions& options);

/// The options of a link that the command line does not replace, then those of the command line.
/// @param shared  the draw or play options of the link  @param given  the options of the command line
OptionValues options_with(const OptionValues& shared, const OptionValues& given, const PatternOptions& options);

/// True if there is a value of that option.
bool has_option(const OptionValues& values, std::string_view name);

/// What a link sets, for people: `n 4, seed 7; draw: size A3`. Empty if it sets nothing.
std::string describe_settings(const SharedWork& link);

/// Calls `work`. A SettingError about an option that the link sets, rather than the command line, says so.
/// @throws what `work` throws
template <typename Work>
auto blaming_link(const OptionValues& shared, const OptionValues& given, Work&& work) {
    try {
        return work();
    } catch (const SettingError& error) {
        if (!has_option(shared, error.option()) || has_option(given, error.option())) throw;
        throw SettingError(error.option(), error.value(), std::string(error.what()) + " (the link sets this option)");
    }
}

}  // namespace sikku
