// music/score_remarks.h: remarks about a finished score.
#pragma once

#include "engine/interpreter.h"
#include "music/ensemble.h"
#include "music/score/notation.h"

namespace sikku {

/// Warns of voices whose controllers apply to others, too, because they share a channel of MIDI.
void report_shared_channels(const Ensemble& ensemble, const ScoreHead& head, bool share_channels, Made& made);

/// Reports notes, time and range, and what became of notes and symbols that could not be played as stated.
void report_notes(const Ensemble& ensemble, const PlayOptions& playing, const EnsembleReport& report, Made& made);

/// Reports notes that are not printed as they sound.
void report_notation(const Notation& notation, const Ensemble& ensemble, Made& made);

}  // namespace sikku
