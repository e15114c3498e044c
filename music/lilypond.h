// music/lilypond.h: scores for LilyPond, which prints them best.
#pragma once

#include "music/notation.h"
#include "music/score.h"

namespace sikku {

/// Writes a file for LilyPond 2.24 that makes a print and a MIDI file: the pattern and what made it as comments,
/// title and composer, for each part a staff or a piano staff with its instrument, a line for each bar. Pitches are
/// exact to the quarter tone, the tempo is to a whole number.
/// In texts, what is no printable UTF-8 becomes `?`.
/// Throws what `sink` throws.
void write_lilypond(const Notation& notation, const ScoreHead& head, ByteSink& sink);

}  // namespace sikku
