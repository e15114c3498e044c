#include "art/print/ornaments.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace sikku {

double least_distance(std::span<const glm::dvec2> dots) {
    std::vector<glm::dvec2> sorted(dots.begin(), dots.end());
    std::sort(sorted.begin(), sorted.end(),
              [](glm::dvec2 a, glm::dvec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    double least = 1e300;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].y - sorted[i].y < least; ++j) {
            least = std::min(least, glm::length(sorted[j] - sorted[i]));
        }
    }
    return sorted.size() < 2 ? 0 : least;
}

std::vector<Colour> kolam_palette() {
    return parse_colours(kolam_colours);
}

}  // namespace sikku
