#include "art/reading/straightened.h"

#include "art/reading/picture_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {
namespace {

/// Pixels of the picture for each spacing.
double fineness(const Photograph& photograph, glm::dvec2 size, int longest_side) {
    return std::min(photograph.map.spacing({0, 0}), longest_side / std::max(size.x, size.y));
}

int whole_side(double pixels, int longest_side) {
    return std::clamp(static_cast<int>(std::lround(pixels)), 1, longest_side);
}

/// True if a point, in pixels from the top left corner, lies within a picture. False for points that are not numbers.
bool shows(const DecodedPicture& picture, glm::dvec2 at) {
    return at.x >= 0 && at.y >= 0 && at.x <= picture.width && at.y <= picture.height;
}

}  // namespace

StraightPicture straightened(const Photograph& photograph, const Box& box, int longest_side) {
    const auto [low, high] = box;
    const glm::dvec2 size = high - low;
    const double fine = fineness(photograph, size, longest_side);
    StraightPicture made{whole_side(fine * size.x, longest_side), whole_side(fine * size.y, longest_side)};
    made.pixels.reserve(4 * static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height));
    LatticeMap map = photograph.map;
    map.follow();  // dots that were seen lie where they are drawn
    const PictureSampler sampler(photograph.picture);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            const glm::dvec2 place(low.x + (x + 0.5) / made.width * size.x,
                                   high.y - (y + 0.5) / made.height * size.y);
            const glm::dvec2 at = map(place) + 0.5;
            std::array<double, 3> colour{};
            const bool is_shown = shows(photograph.picture, at);
            if (is_shown) sampler.add(at, colour);
            for (const double value : colour) made.pixels.push_back(static_cast<std::uint8_t>(std::lround(value)));
            made.pixels.push_back(is_shown ? 255 : 0);
        }
    }
    return made;
}

}  // namespace sikku
