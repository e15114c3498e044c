// music/score/musicxml.h: writes scores as MusicXML, for notation programs.
#pragma once

#include "music/score/notation.h"
#include "music/score/score.h"

namespace sikku {

/// The MIDI key of C0.
constexpr double lowest_in_musicxml = 12.0;

/// Writes MusicXML 4.0 (score-partwise, UTF-8, no date): work title, composer, the recipe and, as a miscellaneous
/// field, the pattern; for each part name and General MIDI program; the tempo; notes with ties, dots and accidentals.
/// Pitches are exact to the quarter tone. Beams and stems are left to the reader.
/// In texts, characters that XML does not allow become U+FFFD.
/// @throws ScoreError for a note below C0, which MusicXML cannot represent; exceptions of `sink`
/// Source: MusicXML 4.0, W3C Music Notation Community Group.
void write_musicxml(const Notation& notation, const ScoreHead& head, Output& sink);

}  // namespace sikku
