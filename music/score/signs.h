// music/score/signs.h: which accidentals and cents are printed.
#pragma once

#include "music/score/notation.h"

#include <cstdint>
#include <span>

namespace sikku {

/// Determines which notes need a printed sign: signs apply to the end of the bar, for their octave, in all voices of
/// the staff; a note tied over the bar line needs no sign and sets none. Deviations in cents are printed like signs,
/// once in a bar; in an accompaniment, which repeats its notes, once, and again after each entry.
/// @param keys  key signatures, ascending
/// @param entries  bar lines that are reached from several bars: ticks, ascending; see entries_of()
void set_signs(Staff& staff, std::span<const KeyChange> keys, bool is_accompaniment, const BarLines& bars,
               std::span<const std::int64_t> entries = {});

/// Sets accidentals only, without cents.
void set_accidentals(Staff& staff, std::span<const KeyChange> keys, const BarLines& bars);

}  // namespace sikku
