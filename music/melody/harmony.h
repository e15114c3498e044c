// music/melody/harmony.h: chords of a scale.
#pragma once

#include "music/scale/scale.h"
#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Accompaniment of a melody: none; tonic and fifth; in each bar the triad that fits the melody best; the same curve
/// of a lower order in long notes; given chords, one a bar.
enum class Harmony { none, drone, triads, bass, progression };

/// A chord as pitches above the tonic.
struct Chord {
    int quality = -1;           ///< index in chord_qualities(); -1: a chord without a name
    double root = 0;            ///< cents above the tonic
    std::vector<double> cents;  ///< the root or the bass first, the others within a period of it
    std::vector<char> is_tone;  ///< for each degree of the scale
    /// The tone of the chord from `low` to `high` that is nearest to `degree`; of two, the lower. `degree` if there
    /// is none.
    std::int64_t nearest(std::int64_t degree, std::int64_t low = INT64_MIN, std::int64_t high = INT64_MAX) const;
    bool has(std::int64_t degree) const;
};

/// The sign of a chord: without a name if there is none, or the root is more than 30 cents from every key.
/// @param tonic  MIDI key of the scale's tonic
ChordSign sign_of(const Chord& chord, double tonic);

/// The chord on a degree of a scale: in scales of seven notes its first, third and fifth; in others the notes nearest
/// to a third and a fifth, if there are any.
Chord triad_on(const Scale& scale, std::int64_t root);

/// Triads in order of preference: I, IV, V, VI, II, III, VII; in scales without seven notes by degree.
std::vector<Chord> triads_of(const Scale& scale);

/// The degree that a numeral stands for: its number in scales of seven notes, in others the degree nearest to that of
/// the major scale.
/// @param number  0 for I, up to 6
std::int64_t degree_of_numeral(const Scale& scale, std::size_t number);

/// Marks the degrees of a scale within a quarter tone of a tone of the chord.
void mark_tones(Chord& chord, const Scale& scale);

/// Reads chords separated by hyphens, as in `I-IV-V7-I` and `C-Am-F-G7`, or `blues` for twelve bars.
/// @param tonic  MIDI key of the scale's tonic, possibly fractional
/// @param problem  receives the problem if the result is empty
std::vector<Chord> read_progression(std::string_view text, const Scale& scale, double tonic, std::string& problem);

/// The degree nearest to a just fifth above the tonic, falling.
std::int64_t fifth_degree(const Scale& scale);

/// The degree nearest to a just fifth; 0 if none is within a quarter tone of it or of a fourth.
std::int64_t drone_degree(const Scale& scale);

/// Semitones between two keys, rounded, within an octave: 0 to 11.
int interval_class(double a, double b);

/// True if two voices, both moving, continue in unisons, octaves or fifths.
/// @param low, high            keys before
/// @param next_low, next_high  keys after
bool is_parallel(double low, double high, double next_low, double next_high);

}  // namespace sikku
