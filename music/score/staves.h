// music/score/staves.h: distributes the voices of a part over staves, and chooses clefs and 8va lines.
#pragma once

#include "music/score/notation.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// The notes of one voice on one staff.
struct StaffVoice {
    int voice = 0;  ///< number in the score
    std::vector<Note> notes;
};
struct StaffPlan {
    std::vector<StaffVoice> voices;
    std::optional<Clef> clef;  ///< the only one, if phrases change hands instead of clefs
};
struct PartPlan {
    std::vector<StaffPlan> staves;  ///< from the highest; empty if no voice sounds
    Bracket bracket = Bracket::none;
    bool has_pedal = false;    ///< the last staff is for the pedal of an organ, below those of the hands
    std::uint64_t merged = 0;  ///< notes left out because another voice has the same note
};

/// True for pianos, organs, the celesta, the accordion and the harp, which are written for two hands.
bool is_keyboard(int program);

/// Distributes the voices of a part over staves.
///
/// Up to four voices of an accompaniment share one staff, except those of a keyboard.
/// Each voice has a staff of its own; up to four voices of a part are ordered by their height. Parts for keyboards
/// (pianos, organs, celesta, accordion, harp) of up to four voices have one staff for each hand, high voices above
/// low ones; the lowest of three and more voices of a pipe organ has a staff for the pedal, if it is within its
/// compass, C2 to F4. A single voice for a keyboard has one staff if one clef is enough; otherwise whole phrases
/// change hands, where that saves ledger lines. If more than twelve voices sound, notes that several voices share are
/// merged, and the rest is divided into as few lines as possible: up to twelve have staves of their own, more share
/// them in pairs.
/// @param first_voice  number of the first voice in the score
/// @throws ScoreError for more than 24 notes at once
PartPlan plan_staves(const Part& part, std::span<const std::vector<Note>> voices, int first_voice,
                     const BarLines& bars);

/// Chooses clefs and 8va lines for a staff so that ledger lines, changes and notes under 8va are fewest;
/// phrases and bars are the best places for changes. Only times at which every voice begins a symbol and none ties
/// one are used. Cost: O(notes).
std::vector<StaffChange> choose_clefs(const Part& part, std::optional<Clef> only,
                                      std::span<const NotatedVoice> voices, const BarLines& bars);

}  // namespace sikku
