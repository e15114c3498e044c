// music/melody/melody.h: the settings of a melody, from the keys scale, tonic, anchor, unit, vertical, … of a
// pattern.
#pragma once

#include "engine/language/pattern.h"
#include "music/scale/scale.h"
#include "music/score/score.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Reading of the curve as a melody.
enum class Mapping {
    runs,          ///< a horizontal run is a note: pitch from y, duration from its length
    counterpoint,  ///< y and x are two voices; a note lasts while its coordinate stays the same
    symbols,       ///< the word itself: F a note, + and - a degree up and down, f a rest
};
/// The y that sounds the tonic; `piece`: that of the first note played.
enum class Anchor { first_note, piece, lowest_note, lowest_vertex, centre };
/// What a vertical run is: nothing, a rest of its length, more of the note before it (or, at the beginning, after
/// it), a note for each step, or a note in a voice of its own, with its pitch from x:
/// where the turtle starts sounds the tonic.
enum class Vertical { ignore, rest, extend, glissando, voice };
/// One note for a straight run, or for each step of it.
enum class Runs { merged, each_step };
/// What a run is that is neither horizontal nor vertical: a note as long as it is wide, at the height of its middle;
/// nothing; a mistake.
enum class Sloped { project, skip, refuse };
/// What becomes of a note beyond the lowest and the highest key: moved by whole periods; mirrored at the last degree
/// within; that degree; a mistake.
enum class Range { fold, reflect, clamp, refuse };
/// The property that determines how loud a note is.
enum class Loudness { fixed, by_turn, by_depth, by_length };

/// Settings of a melody.
struct Melody {
    Mapping mapping = Mapping::runs;
    Scale scale;                 ///< C major if the file names none
    std::optional<KeyMap> keys;  ///< of a Scala key map, which then gives all pitches
    double tonic = 60.0;         ///< MIDI key, perhaps with a fraction, of degree 0
    Spelling tonic_spelling;     ///< how it is written
    Anchor anchor = Anchor::first_note;
    std::int64_t unit = ticks_per_quarter / 2;  ///< ticks of a step: above 0
    Vertical vertical = Vertical::ignore;
    Runs runs = Runs::merged;
    Sloped sloped = Sloped::project;
    Range range = Range::fold;
    double lowest = 0.0;     ///< MIDI keys between which `range` keeps the melody
    double highest = 127.0;  ///< not below `lowest`
    Loudness loudness = Loudness::fixed;
    double tempo = 120.0;  ///< quarters a minute
    Meter meter;
    int program = 0;       ///< General MIDI, 0 to 127
    double transpose = 0;  ///< semitones, added to every key

    /// The MIDI key of a degree; may lie beyond 0 to 127. With a key map nullopt for a degree that it leaves out.
    std::optional<double> key(std::int64_t degree, bool falling) const;
    /// True if a degree of the scale is no whole number of semitones away from a key.
    bool is_microtonal() const;
};

/// Gives the text of a file that `scale:` or `keyboard:` names, or throws.
using FileReader = std::function<std::string(const std::string& path)>;

/// Reads and checks the keys that KeyOwner::music owns; an absent key keeps its default. Without `read_file`, files
/// of scales are not read.
Melody read_melody(const Pattern& pattern, const FileReader& read_file, Diagnostics& diagnostics);

/// Every note higher by `semitones`; whole ones move the tonic's name, and so key signature and spelling, too.
void transpose(Melody& melody, double semitones);

/// Names of the General MIDI programs, 0 to 127.
const std::vector<std::string_view>& instrument_names();

}  // namespace sikku
