// music/score/instruments.h: names of General MIDI instruments.
#pragma once

#include <optional>
#include <string_view>

namespace sikku {

/// The names of one program.
struct Instrument {
    std::string_view name;          ///< General MIDI name
    std::string_view printed;       ///< printed before the first system of a score; several programs may share one
    std::string_view abbreviation;  ///< printed before the other systems
    std::string_view lilypond;      ///< the only name that LilyPond accepts for MIDI files
};

/// @param program  counted from 0; values out of range are clamped
const Instrument& instrument_of(int program);

/// How much higher a transposing instrument is written than it sounds.
struct Transposition {
    int semitones = 0;
    int letters = 0;
    std::string_view key;       ///< of the note that sounds where C is written: `B♭`
    std::string_view lilypond;  ///< that note below c': `bes`
};
/// Nullopt for instruments that are written as they sound, or an octave or two away, which their clef says.
std::optional<Transposition> transposition_of(int program);

/// True for harpsichords and organs, whose loudness does not depend on the touch.
bool is_without_dynamics(int program);

/// True for instruments on which one note leads into the next: bowed strings, voices, winds, pianos and organs.
bool has_slurs(int program);

/// The keys that players of an instrument usually have, as they sound: without extensions and rare high notes.
struct KeyRange {
    int lowest = 0;
    int highest = 127;
};
/// Nullopt for instruments of any range, such as synthesizers, and for those of many sizes.
std::optional<KeyRange> range_of_instrument(int program);

}  // namespace sikku
