#include "art/drawing/drawing_cost.h"

#include <algorithm>
#include <cmath>

namespace sikku {

double curve_lines(double pixels) {
    return std::clamp(1.6 * std::sqrt(pixels), 1.0, 100.0);
}

double band_bytes(PixelSize size) {
    constexpr double band_pixel_bytes = 10;
    const double rows = std::min({128.0, static_cast<double>(size.height), std::max(32.0, 4194304.0 / size.width)});
    return size.width * rows * band_pixel_bytes;
}

}  // namespace sikku
