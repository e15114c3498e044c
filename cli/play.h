// cli/play.h: a score as `sikku play` makes it, for whoever else makes scores.
#pragma once

#include "cli/command.h"
#include "engine/base/keys.h"
#include "music/melody/melody.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Every option of `sikku play`, as it was given.
struct PlaySettings {
    PatternOptions pattern;  ///< but for its name
    std::vector<std::string> patterns;
    std::string output;
    /// Those of keys_of(KeyOwner::music), in their order.
    std::vector<std::optional<std::string>> keys =
        std::vector<std::optional<std::string>>(keys_of(KeyOwner::music).size());
    std::int64_t from_bar = 1;
    std::int64_t bars = 0;
    double seconds = 0;
    double transpose = 0;  ///< semitones
    double humanise = 0;   ///< 0 to 1
    std::uint64_t seed = 1;
    int format = 1;  ///< of MIDI
    std::string tuning = "bend";
    double budget = 200e6;         ///< most nodes of the derivation
    std::filesystem::path folder;  ///< where files that settings name are looked for; empty: the working directory
};

/// @throws UsageError for settings that no score can have, whatever the pattern
void check_score(const PlaySettings& settings);

/// Plays into `settings.output`, which appears whole or not at all; without it, what is known of the music goes to
/// standard output.
/// @throws UsageError, PatternError, ScoreError, BudgetError, WordError; std::runtime_error if the file cannot be
/// written
void play_score(const PlaySettings& settings, const Telling& telling);

/// The Scala files that the patterns or the settings name: each name, and what the file holds. Empty if they cannot
/// be read: playing tells why.
std::vector<std::pair<std::string, std::string>> scala_files(const PlaySettings& settings);

}  // namespace sikku
