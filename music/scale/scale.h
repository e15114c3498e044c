// music/scale/scale.h: scales: the bundled ones, the melakarta by formula, and those of Scala files.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Pitches above a tonic that repeat with a period, in cents. A melody that rises takes them from `ascent`, one that
/// falls from `descent`; most scales have the same in both.
struct Scale {
    std::string id;                  ///< `major`, `raga-bilahari`, `mela-29`, or a file's name
    std::string title;               ///< as people write it; perhaps empty
    std::string group;               ///< `western`, `pentatonic`, `raga`, `melakarta`, `maqam`, `scala`, …
    std::vector<double> ascent;      ///< degree 0 (0 cents) first; of a Scala file in any order, else ascending
    std::vector<double> descent;     ///< likewise, listed upwards as well
    double period = 1200.0;          ///< above 0, or of a Scala file any but 0
    std::vector<std::string> names;  ///< other names it is known by
    std::string sources;             ///< who tells it, in words

    /// Cents of a degree above the tonic (below it for negative ones). Where ascent and descent have as many notes,
    /// a degree is the same step in both. Else degrees count the one with more notes, and a note that the other
    /// leaves out is replaced by the next that it has, in the direction of the melody.
    double cents(std::int64_t degree, bool falling) const;
    /// Notes in a period, as degrees count them.
    std::size_t size() const;
};

/// All that come along, in the order of the data file, then the 72 melakarta.
const std::vector<Scale>& known_scales();

/// By id, title or other name: case, blanks, `-`, `_` and accents do not matter but before and within a number at the
/// beginning; `mela 29` and `melakarta 29` are the formula's, and `31-edo`, `31-equal` or `31-tet` divides the octave
/// into 1 to 1200 equal steps. Null if there is none. Thread-safe; the result stays valid.
const Scale* find_scale(std::string_view name);

/// Ids and names nearest to `name`, at most three, for messages.
std::vector<std::string> similar_scales(std::string_view name);

/// Says that there is no scale of that name, and which may be meant.
std::string unknown_scale(std::string_view name);

/// A key map (.kbm) of Scala: which key sounds which degree, and at which frequency.
struct KeyMap {
    int first = 0;
    int last = 127;
    int middle = 60;                          ///< the key of degree 0
    int reference = 69;                       ///< the key whose frequency is given
    double frequency = 440.0;                 ///< of it, in Hz
    int octave_degree = 0;                    ///< the degree of the formal octave; 0: the scale's period
    std::vector<std::optional<int>> degrees;  ///< for each key of the pattern, from the middle one; empty: linear
};

/// Reads a Scala scale: comments, a description, a count, so many cents, ratios or whole numbers, each perhaps
/// followed by anything. The last is the period. Not sorted, negative cents, periods other than 2/1 and UTF-8 or
/// Latin-1 are fine. Mistakes go to `diagnostics` with their place. Source: the Scala file format, as Op de Coul
/// describes it.
std::optional<Scale> read_scl(const Source& source, Diagnostics& diagnostics);

/// Reads a Scala key map.
std::optional<KeyMap> read_kbm(const Source& source, Diagnostics& diagnostics);

/// The MIDI key, perhaps with a fraction, that sounds as the pitch of `key` under `map` with `scale`; nullopt for a
/// key that the map leaves out.
std::optional<double> mapped_key(const Scale& scale, const KeyMap& map, int key);

}  // namespace sikku
