// engine/language/schedule.h: reads the schedule, which selects the table for each step.
#pragma once

#include "engine/language/defines.h"
#include "engine/language/grammar.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// An entry of the key `schedule:`.
struct ScheduleItem {
    std::uint32_t table = 0;
    Expression count;  ///< function of the derivation length n
};

/// Reads the key `schedule:` of `pattern`; nullopt after an error in it.
std::optional<std::vector<ScheduleItem>> read_schedule(const Key& key, const Pattern& pattern, const Defines& defines,
                                                       Diagnostics& diagnostics);

/// Returns the last `steps` steps that the items state; nullopt if they state fewer or a count is not a number.
/// @param problem  receives the error, unless null
std::optional<std::vector<ScheduleRun>> schedule_runs(std::span<const ScheduleItem> items, std::int64_t steps,
                                                      std::string* problem);

}  // namespace sikku
