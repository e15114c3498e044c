// music/score/instruments.h: names of General MIDI instruments.
#pragma once

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

}  // namespace sikku
