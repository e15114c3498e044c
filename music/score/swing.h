// music/score/swing.h: how swing is printed.
#pragma once

#include "music/score/notation.h"

#include <optional>
#include <string>
#include <utility>

namespace sikku {

/// The swing of all printed parts, without accompaniments; nullopt if they differ, or none swings.
std::optional<Swing> common_swing(const Notation& notation);

/// The words above the first bar: `Light swing` up to 61 %, `Swing`, `Hard swing` from 71 %; of other notes than
/// eighths with their name.
std::string swing_words(const Swing& swing);

/// The words before the tempo: those of the score, then those of common_swing().
std::string words_of_tempo(const Notation& notation, const ScoreHead& head);

/// The ratio of the two notes in small numbers: 2 to 1 from 66 to 67 %, otherwise that of the percent.
std::pair<int, int> swing_ratio(const Swing& swing);

}  // namespace sikku
