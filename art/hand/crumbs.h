// art/hand/crumbs.h: grains of flour that fall beside a line.
#pragma once

#include "art/hand/hand.h"

#include <vector>

namespace sikku {

/// A stray grain, in turtle steps.
struct HandCrumb {
    glm::dvec2 at{0.0};
    double radius = 0;
};

/// The crumbs beside a line: their number follows its flour, with more where a pinch begins, and falls off quickly
/// with the distance. They keep to the near side of the gap to the next line. Cost: about 0.2 µs a crumb; at full
/// strength some ten crumbs for each width of the line. @param least  radius of the smallest crumbs that are returned
std::vector<HandCrumb> crumbs_beside(const HandLine& line, double least, const HandOptions& options);
/// The crumbs around a dot. @param number  of the dot
std::vector<HandCrumb> crumbs_around(const HandDot& dot, std::uint64_t number, double least,
                                     const HandOptions& options);

}  // namespace sikku
