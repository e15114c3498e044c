// music/score/instruments.h: names of the instruments of General MIDI.
#pragma once

#include <string_view>

namespace sikku {

/// The names of one program.
struct Instrument {
    std::string_view name;          ///< that of General MIDI
    std::string_view printed;       ///< before the first system of a score; several programs may share one
    std::string_view abbreviation;  ///< before the others
    std::string_view lilypond;      ///< that of LilyPond's MIDI files, which accepts no other
};

/// @param program  counted from 0; others are taken for the nearest
const Instrument& instrument_of(int program);

}  // namespace sikku
