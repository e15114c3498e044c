// music/form/counterpoint.h: moves notes of a part where they clash with the parts before it.
#pragma once

#include "music/form/block.h"
#include "music/score/bar_lines.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// True for the intervals that are consonant between two voices, in semitones rounded: unisons, thirds, fifths,
/// sixths and octaves. Fourths are dissonant, as between two voices.
bool is_consonant(double low, double high);

/// Moves notes of `part` by up to three degrees, so that on the strong beats of `meter` (see strong_beats()) no voice
/// of it is dissonant with a voice of `fixed`, and no fifths, octaves or unisons follow each other where both voices
/// move. A fourth above a lower voice is consonant. The voices of `part` are processed in order: each adapts to those
/// before it, and to chords and drones of the part. Notes without faults stay where they are; moves avoid repeating
/// the note before. Notes without degrees count as neighbours, but never move. Cost: O(notes x voices).
/// @param fixed  by onset; times as in `part`
/// @return number of notes moved
std::uint64_t make_strict(std::span<const FormNote> fixed, std::vector<FormNote>& part, const Melody& melody,
                          const BarLines& bars);

/// A voice as it sounds, by onset.
struct SoundingVoice {
    std::vector<Note> notes;
    bool is_led = false;  ///< it gives way to the voices before it
};

/// The faults of led voices with the voices before them: the onset of a note for each dissonance on a strong beat and
/// each parallel, as make_strict() counts them. Cost: O(notes x voices).
/// @param late  ticks by which a player may begin notes after their beat
std::vector<std::int64_t> sounding_faults(std::span<const SoundingVoice> voices, const BarLines& bars,
                                          std::int64_t late);

}  // namespace sikku
