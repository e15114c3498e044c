// art/reading/picture.h: grey pictures as numbers, and the ink of a drawing in them.
#pragma once

#include "art/image/image_file.h"
#include "engine/base/monitor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A picture of one number a pixel; the middle of the first pixel is at 0, 0, y points down.
struct GreyPicture {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values = {};

    GreyPicture() = default;
    GreyPicture(std::size_t columns, std::size_t rows) : width(columns), height(rows), values(columns * rows) {}
    /// Interpolates bilinearly; pixels outside continue the border.
    float at(glm::dvec2 point) const;
    /// True for points between the middles of four pixels.
    bool is_between_pixels(glm::dvec2 point) const {
        return point.x >= 0 && point.y >= 0 && point.x < static_cast<double>(width) - 1 &&
               point.y < static_cast<double>(height) - 1;
    }
    /// The same as at(), for points between pixels.
    float between(glm::dvec2 point) const;
};

inline float GreyPicture::between(glm::dvec2 point) const {
    const auto left = static_cast<std::int32_t>(point.x);
    const auto top = static_cast<std::int32_t>(point.y);
    const auto u = static_cast<float>(point.x - left);
    const auto v = static_cast<float>(point.y - top);
    const float* above = values.data() + static_cast<std::size_t>(top) * width + static_cast<std::size_t>(left);
    const float* below = above + width;
    return (above[0] * (1 - u) + above[1] * u) * (1 - v) + (below[0] * (1 - u) + below[1] * u) * v;
}

inline float GreyPicture::at(glm::dvec2 point) const {
    if (is_between_pixels(point)) return between(point);
    const double x = std::clamp(point.x, 0.0, static_cast<double>(width - 1));
    const double y = std::clamp(point.y, 0.0, static_cast<double>(height - 1));
    const auto left = std::min(static_cast<std::size_t>(x), width - 1);
    const auto top = std::min(static_cast<std::size_t>(y), height - 1);
    const std::size_t right = std::min(left + 1, width - 1);
    const std::size_t bottom = std::min(top + 1, height - 1);
    const auto u = static_cast<float>(x - static_cast<double>(left));
    const auto v = static_cast<float>(y - static_cast<double>(top));
    const float above = values[top * width + left] * (1 - u) + values[top * width + right] * u;
    const float below = values[bottom * width + left] * (1 - u) + values[bottom * width + right] * u;
    return above * (1 - v) + below * v;
}

/// Averages three times over squares: nearly a Gaussian of standard deviation `radius`, in pixels. Time: linear.
GreyPicture blurred(GreyPicture picture, double radius);

/// A picture made larger by a whole number, by cubic interpolation. Source: E. Catmull & R. Rom, 1974.
DecodedPicture enlarged(const DecodedPicture& picture, int times);

/// The logarithm of the brightness of a picture, less that of its surroundings, in units of its local deviation:
/// uneven light cancels out. Dark lines are above 0, light ones below.
struct Ink {
    GreyPicture values;   ///< positive where the picture is darker than its surroundings
    bool is_dark = true;  ///< lines are darker than the ground: the rarer side deviates more
};
/// Memory: 12 bytes a pixel besides the picture.
Ink find_ink(const DecodedPicture& picture, const Monitor& monitor = {});

}  // namespace sikku
