// music/score/strudel.h: writes scores for the live-coding page Strudel.
#pragma once

#include "engine/base/output.h"
#include "music/score/score.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

/// Writes a program for Strudel: for each voice its notes in mini-notation, `c4@2 d4 ~`, whose weights are the
/// durations, slowed to the bars of the piece. It is preceded by a link that opens it, https://strudel.cc/#…, then
/// the recipe and the pattern as comments. Microtones are MIDI keys with fractions.
/// @throws ScoreError for a bar without length; exceptions of `out`
void write_strudel(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out);

/// The link that opens a program in Strudel.
std::string strudel_link(const std::string& program);

}  // namespace sikku
