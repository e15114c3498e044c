// music/score/turns.h: parts that take turns, as sections of an arrangement do, share staves in print.
#pragma once

#include "music/score/bar_lines.h"
#include "music/score/pitch.h"
#include "music/score/score.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// A key signature, and how pitches are written, from a bar line on.
struct KeyOfBars {
    std::int64_t onset = 0;           ///< ticks
    std::optional<KeySignature> key;  ///< nullopt: no signs
    std::array<Spelling, 12> spelling{};
    Pitch tonic{};  ///< as written
};

/// A printed part: a part of the score, or several that take turns.
struct PrintedPart {
    Part part;                         ///< the first part that sounds, with the number of `voices`
    int first_voice = 0;               ///< number in the score
    std::vector<std::size_t> sources;  ///< indices of parts of the score
    std::vector<std::vector<Note>> voices;
    std::vector<KeyOfBars> keys;  ///< ascending, the first at 0; neighbours may have the same signs
    const KeyOfBars& key_at(std::int64_t onset) const;
};

/// Combines parts of the same instrument (and name, if it is set) that never sound in the same bar, each with those
/// of about its height. Two to four lines of one keyboard, of a voice each, become one part for two hands. Turns that
/// can be written in the previous key without signs keep that key. Keys of several parts change at one bar line if
/// their rests allow it. Cost: O(parts^2 + notes log notes).
/// @param voices  voices of all parts in order: notes by onset
std::vector<PrintedPart> share_parts(std::span<const Part> parts, std::span<const std::vector<Note>> voices,
                                     const BarLines& bars);

/// Gives parts on the same tonic the same key signature, so that the staves of a score agree: of their signatures,
/// the one with the fewest accidentals. A part on another tonic gets the signature of the first part if it then needs
/// no accidentals. Parts that change their key, and drums, are left alone.
/// @param others  further keys (pitches) of each printed part, those of its chords
void agree_on_keys(std::vector<PrintedPart>& printed, std::span<const std::vector<double>> others);

}  // namespace sikku
