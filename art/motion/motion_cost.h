// art/motion/motion_cost.h: the costs of animations, of series of generations and of lessons.
#pragma once

#include "art/motion/division_file.h"
#include "art/motion/growth.h"
#include "engine/base/cost.h"

namespace sikku {

/// The cost of an animation or of one file for each generation.
Cost growth_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, const GrowthOptions& growth);

/// The cost of an animation of tiles that divide.
Cost division_cost(const Grammar& grammar, const Print& print, const DrawOptions& options,
                   const DivisionOptions& division);

/// The cost of a lesson, as an animation, as pages and as cells of a picture.
Cost lesson_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, bool is_animation);

}  // namespace sikku
