#include "art/raster/floor.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr int place_bits = 24;
constexpr int most_side = 1024;

}  // namespace

/// Blends two rows of texels, and takes places along them.
class FloorPaint::Row {
public:
    Row(const Layer& layer, int row) : mask_((1u << layer.bits) - 1), at_(layer.x), step_(layer.step) {
        const std::int64_t y = layer.y + layer.step * row;
        const auto upper = static_cast<std::uint32_t>(y >> place_bits) & mask_, lower = (upper + 1) & mask_;
        const std::uint8_t *above = layer.texels + (std::size_t{upper} << layer.bits),
                           *below = layer.texels + (std::size_t{lower} << layer.bits);
        const int down = static_cast<int>(y >> (place_bits - 8)) & 255;
        for (std::uint32_t i = 0; i <= mask_; ++i) {
            blended_[i] = static_cast<std::uint16_t>((256 - down) * above[i] + down * below[i]);
        }
        blended_[mask_ + 1] = blended_[0];
    }
    /// The height at the next pixel, 0 to 255.
    int next() {
        const auto texel = static_cast<std::uint32_t>(at_ >> place_bits) & mask_;
        const int across = static_cast<int>(at_ >> (place_bits - 8)) & 255;
        at_ += step_;
        return ((256 - across) * blended_[texel] + across * blended_[texel + 1] + (1 << 15)) >> 16;
    }

private:
    std::array<std::uint16_t, most_side + 1> blended_;
    std::uint32_t mask_;
    std::int64_t at_, step_;
};

FloorPaint::FloorPaint(Floor floor, double pixel, glm::dvec2 corner) : texture_(floor_texture(floor)) {
    for (std::size_t i = 0; i < floor_layers; ++i) {
        const FloorLayer& from = texture_.layers[i];
        double texel = from.texel;
        std::size_t level = 0;
        while (level + 1 < from.level.size() && pixel > 1.4 * texel) {
            texel *= 2;
            ++level;
        }
        const auto fixed = [&](double length) {
            return static_cast<std::int64_t>(std::llround(std::clamp(length / texel, -1e9, 1e9) * (1 << place_bits)));
        };
        // Texels are centred half a texel from the corner.
        const glm::dvec2 first = corner + (pixel - texel) / 2;
        layers_[i] = {from.level[level].data(), from.bits - static_cast<int>(level), fixed(first.x), fixed(first.y),
                      fixed(pixel)};
    }
}

void FloorPaint::paint(std::uint8_t* pixels, int row, int count, int channels) const {
    Row grains(layers_[0], row), marks(layers_[1], row), stains(layers_[2], row);
    for (int column = 0; column < count; ++column, pixels += channels) {
        const int grain = grains.next(), mark = marks.next();
        const std::uint32_t colour = texture_.colour(grain, mark, stains.next());
        pixels[0] = static_cast<std::uint8_t>(colour);
        pixels[1] = static_cast<std::uint8_t>(colour >> 8);
        pixels[2] = static_cast<std::uint8_t>(colour >> 16);
        if (channels == 4) pixels[3] = 255;
    }
}

}  // namespace sikku
