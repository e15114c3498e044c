// art/raster/floor_texture.h: textures of floors, made by computation.
#pragma once

#include "art/style/colour.h"
#include "art/style/floor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Layers of a floor: sand and pits of tenths of a millimetre, marks of the hand or of the stone, large stains.
constexpr std::size_t floor_layers = 3;

/// A square of heights around 128, which repeats, at several sizes, each half of the one before.
struct FloorLayer {
    int bits = 0;        ///< binary logarithm of its side
    double texel = 1.0;  ///< millimetres
    std::vector<std::vector<std::uint8_t>> level;
};

struct FloorTexture {
    static constexpr int tints = 32;

    std::array<FloorLayer, floor_layers> layers;
    int grain_share = 0, mark_share = 0;  ///< of the first two layers in a shade, in 1/128
    std::array<std::uint32_t, 256 * tints>
        colours{};  ///< by tint and shade: red, green and blue, from the lowest byte

    /// The colour of the heights of the three layers.
    std::uint32_t colour(int grain, int mark, int stain) const {
        const int shade = 128 + (((grain - 128) * grain_share + (mark - 128) * mark_share + 64) >> 7);
        const int inside = shade < 0 ? 0 : shade > 255 ? 255 : shade;
        return colours[static_cast<std::size_t>((stain >> 3) * 256 + inside)];
    }
};

/// The texture of a floor, made when it is first used, in about 0.1 s; the same on every machine.
const FloorTexture& floor_texture(Floor floor);

}  // namespace sikku
