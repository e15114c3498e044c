// music/score/csound.h: writes scores for Csound.
#pragma once

#include "engine/base/output.h"
#include "music/score/curves.h"
#include "music/score/score.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Writes a numeric score (`.sco`): an `i` statement for each note, by onset, then by voice. Times are in quarters,
/// with the tempo as a `t` statement; p4 is the frequency in Hz (A4 = 440), p5 the amplitude from 0 to 1, p6 the
/// voice from 1, and, if the pan follows a curve or notes slide, p7 its value at the onset, 0 (left) to 1. If notes
/// slide, p8 is the frequency at the end and p9 the part of the duration after which the slide begins. Parts are
/// instruments 1, 2, … The recipe and the pattern come first, as comments. @throws exceptions of `out`
void write_csound_score(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                        const Curves& curves = {});

/// Writes a unified file (`.csd`), ready to play: the score and a plucked sound for every part.
void write_csound_file(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                       const Curves& curves = {});

}  // namespace sikku
