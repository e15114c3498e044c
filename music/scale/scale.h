// music/scale/scale.h: scales: the bundled ones, the melakarta by formula, and those of Scala files.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Pitches above a tonic that repeat with a period, in cents. A rising melody takes them from `ascent`, a falling one
/// from `descent`; in most scales both are the same.
struct Scale {
    std::string id;                  ///< `major`, `raga-bilahari`, `mela-29`, or a file's name
    std::string title;               ///< display name; may be empty
    std::string group;               ///< `western`, `pentatonic`, `raga`, `melakarta`, `maqam`, `scala`, …
    std::vector<double> ascent;      ///< degree 0 (0 cents) first; ascending, except in Scala files
    std::vector<double> descent;     ///< the same for falling melodies, also ascending
    double period = 1200.0;          ///< above 0; in a Scala file any value but 0
    std::vector<std::string> names;  ///< other names
    std::string sources;             ///< sources, as text

    /// Cents of a degree above the tonic; negative degrees lie below it. If ascent and descent have equally many
    /// notes, a degree is the same step in both. Otherwise degrees number the notes of the longer one, and a note
    /// missing from the other is replaced by its next note in the direction of the melody.
    double cents(std::int64_t degree, bool falling) const;
    /// Number of degrees in a period.
    std::size_t size() const;
};

/// The bundled scales in the order of the data file, then the 72 melakarta.
const std::vector<Scale>& known_scales();

/// Finds a scale by id, title or other name. Case, blanks, `-`, `_` and accents do not matter, except before and
/// within a leading number. `mela 29` and `melakarta 29` name a melakarta; `31-edo`, `31-equal` and `31-tet` divide
/// the octave into equal steps, 1 to 1200. Null if there is none. Thread-safe; the result stays valid.
const Scale* find_scale(std::string_view name);

/// Up to three ids and names nearest to `name`, for messages.
std::vector<std::string> similar_scales(std::string_view name);

/// Message that no scale has the name `name`, with similar names.
std::string unknown_scale(std::string_view name);

/// A Scala key map (.kbm), which assigns degrees to keys and a frequency to one of them.
struct KeyMap {
    int first = 0;
    int last = 127;
    int middle = 60;                          ///< the key of degree 0
    int reference = 69;                       ///< the key whose frequency is given
    double frequency = 440.0;                 ///< frequency of the reference key, in Hz
    int octave_degree = 0;                    ///< the degree of the formal octave; 0: the scale's period
    std::vector<std::optional<int>> degrees;  ///< for each key of the pattern, from the middle one; empty: linear
};

/// Reads a Scala scale: comments, a description, a count, and as many cents, ratios or whole numbers, each optionally
/// followed by text. The last is the period. Notes may be unsorted or negative, the period other than 2/1, the text
/// UTF-8 or Latin-1. Errors go to `diagnostics` with their place. Source: the Scala file format, as described by
/// Op de Coul.
std::optional<Scale> read_scl(const Source& source, Diagnostics& diagnostics);

/// Reads a Scala key map.
std::optional<KeyMap> read_kbm(const Source& source, Diagnostics& diagnostics);

/// The MIDI key, possibly fractional, at the pitch that `key` has under `map` with `scale`; nullopt if the map leaves
/// the key out.
std::optional<double> mapped_key(const Scale& scale, const KeyMap& map, int key);

}  // namespace sikku
