// music/melody/harmony.h: chords of a scale.
#pragma once

#include "music/scale/scale.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// What sounds with a melody: nothing; tonic and fifth; in each bar the triad that fits the melody best; the same
/// curve of a lower order in long notes; given chords, one a bar.
enum class Harmony { none, drone, triads, bass, progression };

/// Pitches above the tonic.
struct Chord {
    std::vector<double> cents;  ///< the root first, within a period
    std::vector<char> is_tone;  ///< for each degree of the scale
    /// The degree nearest to `degree` that is a tone of the chord and lies from `low` to `high`; of two, the lower.
    /// If there is none, `degree`.
    std::int64_t nearest(std::int64_t degree, std::int64_t low = INT64_MIN, std::int64_t high = INT64_MAX) const;
    bool has(std::int64_t degree) const;
};

/// The chord on a degree of a scale: of seven notes its first, third and fifth; of other scales the notes nearest to
/// a third and a fifth, if there are any.
Chord triad_on(const Scale& scale, std::int64_t root);

/// A triad on each degree, in order of preference: I, IV, V, VI, II, III, VII.
std::vector<Chord> triads_of(const Scale& scale);

/// Reads `I-IV-V7-I`, or `blues` for twelve bars. A 7 makes a chord a dominant seventh.
/// @param problem  what is wrong, if the result is empty
std::vector<Chord> read_progression(std::string_view text, const Scale& scale, std::string& problem);

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
