// music/score/dynamics.h: dynamics and accents from velocities.
#pragma once

#include "music/score/notation.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// `ppp` to `fff` for the levels of DynamicMark.
std::string_view dynamic_name(int level);

/// The level of DynamicMark whose velocity is nearest.
int dynamic_level(double velocity);

/// The dynamics of notes (by onset). Stated dynamics are marked where they change; of notes that begin together, the
/// loudest counts. If four or more bars repeat the same levels at the same places, only the first is marked. Other
/// notes, unless they are a few between those, have a dynamic for each stretch of bars whose mean velocity stays
/// within a level, and hairpins where it rises or falls steadily from one level to another. Levels are 16 steps of
/// velocity apart, as in General MIDI; mf is 80. A bar has to leave the current level by 3 steps to change it.
/// Hairpins have at least two notes, and end at a rest before the new level.
/// Hairpins do not cross borders of repeats. The beginning of a repeat states its level if its end has another level,
/// a second ending if the level before the first ending differs.
/// @param fresh_from  tick from which the print begins: nothing before it has been read
std::vector<DynamicMark> dynamics_of(std::span<const Note> notes, const BarLines& bars, std::int64_t fresh_from = 0,
                                     std::span<const PrintedRepeat> repeats = {});

/// True for each accented note: those that the rhythm accents; or, if the pattern states neither accents nor
/// dynamics, those 14 steps louder than the mean of their bar, after a softer one, if they are at most a third of the
/// notes.
std::vector<bool> accents_of(std::span<const Note> notes, const BarLines& bars);

}  // namespace sikku
