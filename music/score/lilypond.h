// music/score/lilypond.h: writes scores for the engraver LilyPond.
#pragma once

#include "music/score/notation.h"
#include "music/score/score.h"

#include <string>
#include <string_view>

namespace sikku {

/// Formats a LilyPond string with its quotation marks, on a single line. Line and paragraph separators, which make
/// LilyPond 2.24 abort, and direction marks, which may make it hang, become blanks; invalid or unprintable UTF-8
/// becomes `?`.
std::string lilypond_string(std::string_view text);

/// Writes a file for LilyPond 2.24 that makes a print and a MIDI file: the recipe and the pattern as comments,
/// title, composer and source, for each part its staves with the instrument, a line for each bar. Pitches are
/// exact to the quarter tone, the tempo is rounded to a whole number.
/// Texts are written with lilypond_string().
/// @throws exceptions of `sink`
void write_lilypond(const Notation& notation, const ScoreHead& head, Output& sink);

}  // namespace sikku
