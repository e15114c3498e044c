// art/motion/division_style.h: tiles that divide, as the style sheet and the attributes of an SVG.
#pragma once

#include "art/motion/division.h"
#include "art/print/print.h"

#include <cstddef>
#include <string>

namespace sikku {

/// Placement of a stage on the page. @param placement  placement of the last stage
Placement stage_placement(const DivisionStage& stage, const Placement& placement);

/// The attributes that animate a stage. The last stage is visible without animation.
PartMotion stage_motion(const Division& division, std::size_t stage, const Placement& placement);

/// Key frames of all stages, which are repeated for ever; none for readers who prefer reduced motion.
std::string division_style(const Division& division, const DivisionClock& clock, const Placement& placement);

}  // namespace sikku
