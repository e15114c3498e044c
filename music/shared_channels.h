// music/shared_channels.h: parts that share pan and controllers with others.
#pragma once

#include "music/ensemble.h"
#include "music/score/score.h"

#include <string>
#include <vector>

namespace sikku {

/// Names of the parts that share a MIDI channel on which a voice has pan or a controller of its own.
/// @param head            head of the ensemble, whose voices are numbered
/// @param share_channels  as in MidiOptions
std::vector<std::string> parts_controlled_together(const Ensemble& ensemble, const ScoreHead& head,
                                                   bool share_channels);

}  // namespace sikku
