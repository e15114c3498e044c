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

/// The dynamics of notes (by onset). Notes that state theirs have it where it changes; of notes that begin together,
/// the loudest counts. Others, of which a few between those change nothing, have one for each stretch of bars whose
/// mean velocity stays within a level, and hairpins where it rises or falls steadily from one level to another.
/// General MIDI's levels are 16 steps of velocity apart, mf is 80; a bar has to leave the current level by 3 steps to
/// change it. Hairpins have at least two notes, and end where a rest comes before the new level.
std::vector<DynamicMark> dynamics_of(std::span<const Note> notes, std::int64_t bar_length);

/// Which of the notes are accented: those that the rhythm accents; or, if the pattern states neither accents nor
/// dynamics of them, those 14 steps louder than the mean of their bar, after a softer one; none if
/// they are more than a third.
std::vector<bool> accents_of(std::span<const Note> notes, std::int64_t bar_length);

}  // namespace sikku
