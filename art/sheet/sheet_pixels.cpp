#include "art/sheet/sheet_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace sikku {

Colour over(Colour upper, Colour lower) {
    const double a = upper.alpha / 255.0, b = lower.alpha / 255.0 * (1 - a);
    if (!(a + b > 0)) return lower;
    const auto mixed = [&](std::uint8_t u, std::uint8_t l) {
        return static_cast<std::uint8_t>(std::lround((u * a + l * b) / (a + b)));
    };
    return {mixed(upper.red, lower.red), mixed(upper.green, lower.green), mixed(upper.blue, lower.blue),
            static_cast<std::uint8_t>(std::lround((a + b) * 255))};
}

void render_part(const Rendering& raster, int left, int top, int height, int channels, std::size_t stride,
                 SheetBand& band) {
    constexpr int step = 128;  // as render_rows() requires
    const int first = std::max(0, band.top - top) / step * step;
    const int end = std::min(height, (band.bottom - top + step - 1) / step * step);
    if (first >= end) return;
    raster.render_rows(first, end, channels, [&](int from, int rows, std::span<const std::uint8_t> part) {
        const std::size_t bytes = part.size() / static_cast<std::size_t>(rows);
        for (int row = 0; row < rows; ++row) {
            const int at = top + from + row - band.top;
            if (at < 0 || at >= band.bottom - band.top) continue;
            std::memcpy(band.pixels.data() + static_cast<std::size_t>(at) * stride +
                            static_cast<std::size_t>(left) * static_cast<std::size_t>(channels),
                        part.data() + static_cast<std::size_t>(row) * bytes, bytes);
        }
    });
}

void keep_first_channel(std::vector<std::uint8_t>& pixels, int channels) {
    const std::size_t count = pixels.size() / static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < count; ++i) pixels[i] = pixels[i * static_cast<std::size_t>(channels)];
    pixels.resize(count);
}

}  // namespace sikku
