// art/reading/picture_sampler.h: the colours of a picture between its pixels.
#pragma once

#include "art/image/image_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace sikku {

/// A picture that is sampled between its pixels; the top left corner is at 0, 0.
class PictureSampler {
public:
    explicit PictureSampler(const DecodedPicture& picture) : picture_(picture) {}

    /// Adds the colour at a point to some sums.
    void add(glm::dvec2 at, std::array<double, 3>& sums) const {
        const double x = std::clamp(at.x - 0.5, 0.0, static_cast<double>(picture_.width - 1));
        const double y = std::clamp(at.y - 0.5, 0.0, static_cast<double>(picture_.height - 1));
        const int left = static_cast<int>(x);
        const int top = static_cast<int>(y);
        const double u = x - left;
        const double v = y - top;
        const std::uint8_t* above = pixel(left, top);
        const std::uint8_t* below = pixel(left, std::min(top + 1, picture_.height - 1));
        const int next = left + 1 < picture_.width ? 3 : 0;
        for (int c = 0; c < 3; ++c) {
            sums[static_cast<std::size_t>(c)] +=
                (above[c] * (1 - u) + above[next + c] * u) * (1 - v) + (below[c] * (1 - u) + below[next + c] * u) * v;
        }
    }

private:
    const std::uint8_t* pixel(int x, int y) const {
        return &picture_.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                     static_cast<std::size_t>(x))];
    }
    const DecodedPicture& picture_;
};

}  // namespace sikku
