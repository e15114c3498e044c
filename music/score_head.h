// music/score_head.h: the head of a score: its texts and parts.
#pragma once

#include "music/arrangement.h"
#include "music/ensemble.h"
#include "music/play_settings.h"
#include "music/score/score.h"

namespace sikku {

/// Number of MIDI channels besides the one of drums.
constexpr int most_channels = 15;

/// Describes a score and numbers the voices of its players.
/// @param arrangement  null for a single pattern
/// @param most         limit of voices of the format
/// @throws ScoreError for too many voices
ScoreHead head_of(const PlaySettings& settings, Ensemble& ensemble, const Arrangement* arrangement,
                  const PlayOptions& playing, int most);

/// Voices that need MIDI channels of their own.
int pitched_voices(const ScoreHead& head);

}  // namespace sikku
