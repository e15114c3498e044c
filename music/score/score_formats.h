// music/score/score_formats.h: writers of scores as text: ABC, Csound, LilyPond, MusicXML, Strudel.
#pragma once

#include "engine/base/output.h"
#include "music/score/curves.h"
#include "music/score/notation.h"
#include "music/score/score.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

// All of them throw exceptions of `out`, too.

/// Writes ABC 2.1: the recipe and the pattern as comments, then one tune with a voice for each voice of each staff.
/// Lengths are in eighths. Clefs with an octave are replaced by those without. Accidentals are written so that rules
/// by which they apply to one note or to its letter in the bar agree. Quarter tones are `^/` and `_/`.
/// @param notation  its passages are played at most twice: programs disagree on signs for more
void write_abc(const Notation& notation, const ScoreHead& head, Output& out);

/// Writes a numeric score for Csound (`.sco`): an `i` statement for each note, by onset, then by voice. Times are in
/// quarters, with the tempo as a `t` statement; p4 is the frequency in Hz (A4 = 440), p5 the amplitude from 0 to 1,
/// p6 the voice from 1, and, if the pan follows a curve or notes slide, p7 its value at the onset, 0 (left) to 1. If
/// notes slide, p8 is the frequency at the end and p9 the part of the duration after which the slide begins. Parts
/// are instruments 1, 2, … The recipe and the pattern come first, as comments.
void write_csound_score(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                        const Curves& curves = {});

/// Writes a unified file (`.csd`), ready to play: the score and a plucked sound for every part.
void write_csound_file(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                       const Curves& curves = {});

/// Writes a file for LilyPond 2.24 that makes a print and a MIDI file: the recipe and the pattern as comments,
/// title, composer and source, for each part its staves with the instrument, a line for each bar. Pitches are
/// exact to the quarter tone, the tempo is rounded to a whole number. Texts are written with lilypond_string().
void write_lilypond(const Notation& notation, const ScoreHead& head, Output& out);

/// Formats a LilyPond string with its quotation marks, on a single line. Line and paragraph separators, which make
/// LilyPond 2.24 abort, and direction marks, which may make it hang, become blanks; invalid or unprintable UTF-8
/// becomes `?`.
std::string lilypond_string(std::string_view text);

/// The MIDI key of C0.
constexpr double lowest_in_musicxml = 12.0;

/// Writes MusicXML 4.0 (score-partwise, UTF-8, no date): work title, composer, the recipe and, as a miscellaneous
/// field, the pattern; for each part name and General MIDI program; the tempo; notes with ties, dots and accidentals.
/// Pitches are exact to the quarter tone. Beams and stems are left to the reader.
/// In texts, characters that XML does not allow become U+FFFD.
/// @throws ScoreError for a note below C0, which MusicXML cannot represent
/// Source: MusicXML 4.0, W3C Music Notation Community Group.
void write_musicxml(const Notation& notation, const ScoreHead& head, Output& out);

/// Writes compressed MusicXML: a ZIP archive with the container file and `score.musicxml`, deflated. The pattern and
/// the recipe of the score come first, uncompressed, so that they can be read without unpacking. The bytes are the
/// same each time (entries are dated 1980-01-01).
/// @throws std::runtime_error for a score of more than 2 GB
void write_mxl(std::string_view musicxml, Output& out);

/// Writes a program for the live-coding page Strudel: for each voice its notes in mini-notation, `c4@2 d4 ~`, whose
/// weights are the durations, slowed to the bars of the piece. It is preceded by a link that opens it,
/// https://strudel.cc/#…, then the recipe and the pattern as comments. Microtones are MIDI keys with fractions.
/// @throws ScoreError for a bar without length
void write_strudel(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out);

/// The link that opens a program in Strudel.
std::string strudel_link(const std::string& program);

}  // namespace sikku
