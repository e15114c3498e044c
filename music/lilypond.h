// music/lilypond.h: scores for LilyPond, which prints them best.
#pragma once

#include "music/notation.h"
#include "music/score.h"

#include <string>
#include <string_view>

namespace sikku {

/// A string of LilyPond's language, with its quotation marks, that is one line of text and nothing else. Line and
/// paragraph separators, which LilyPond 2.24 aborts on, and marks that change the direction of writing, on which it
/// may hang, become blanks; what is no printable UTF-8 becomes `?`.
std::string lilypond_string(std::string_view text);

/// Writes a file for LilyPond 2.24 that makes a print and a MIDI file: the pattern and what made it as comments,
/// title and composer, for each part a staff or a piano staff with its instrument, a line for each bar. Pitches are
/// exact to the quarter tone, the tempo is to a whole number.
/// Texts are written as lilypond_string() has them.
/// Throws what `sink` throws.
void write_lilypond(const Notation& notation, const ScoreHead& head, ByteSink& sink);

}  // namespace sikku
