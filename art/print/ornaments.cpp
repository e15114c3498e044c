#include "art/print/ornaments.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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
    constexpr std::size_t length = std::string_view("#rrggbb").size();
    std::vector<Colour> palette;
    for (std::size_t at = 0; at < kolam_colours.size(); at += length + 1) {
        palette.push_back(*parse_colour(kolam_colours.substr(at, length)));
    }
    return palette;
}

}  // namespace sikku
