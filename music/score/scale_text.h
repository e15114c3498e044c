// music/score/scale_text.h: searches for scales by words, and formats them as text and as JSON.
#pragma once

#include "music/scale/scale.h"
#include "music/score/spelling.h"

#include <string>
#include <vector>

namespace sikku {

/// A JSON object on one line; intervals are in cents above the tonic.
std::string scale_json(const Scale& scale);
/// Steps, notes above `tonic` and cents, one on each line.
std::string scale_text(const Scale& scale, const Tonic& tonic);

/// All known scales, one on each line, under the names of their groups.
std::string scale_listing(const std::vector<const Scale*>& scales);

/// The known scales with all of the words in their id, names, group or sources.
std::vector<const Scale*> search_scales(const std::vector<std::string>& words);
/// The known scales of a group, by any spelling of its name.
std::vector<const Scale*> scales_of_group(const std::string& name);

}  // namespace sikku
