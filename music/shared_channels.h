// music/shared_channels.h: parts that share pan and controllers with others.
#pragma once

#include "music/ensemble.h"
#include "music/score/score.h"

#include <string>
#include <vector>

namespace sikku {

/// The names of the parts whose voices meet others on a channel of MIDI where one of them has pan or a controller of
/// its own.
/// @param head            of the ensemble, whose voices are numbered
/// @param share_channels  as in MidiOptions
std::vector<std::string> parts_controlled_together(const Ensemble& ensemble, const ScoreHead& head,
                                                   bool share_channels);

}  // namespace sikku
