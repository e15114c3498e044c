// art/raster/floor.h: paints floors as the ground of pictures.
#pragma once

#include "art/raster/floor_texture.h"
#include "art/style/floor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A floor at a resolution. Its colour depends only on the place on the floor, in millimetres, averaged over a pixel;
/// its mean is mean_colour(). It repeats after a metre, and finer details sooner.
/// Cost: about 6 ns a pixel. Memory: 2 MB for each kind of floor in use.
class FloorPaint {
public:
    /// @param pixel  side of a pixel in millimetres  @param corner  place of the picture's top left corner on the
    /// floor
    FloorPaint(Floor floor, double pixel, glm::dvec2 corner);

    /// Writes the colours of `count` pixels of a row of the picture, from its first column. @param channels  3 or 4
    void paint(std::uint8_t* pixels, int row, int count, int channels) const;

private:
    /// A layer of the texture at a resolution. Places are in 2^-24 texels.
    struct Layer {
        const std::uint8_t* texels = nullptr;
        int bits = 0;  ///< binary logarithm of its side
        std::int64_t x = 0, y = 0, step = 0;
    };
    /// A row of texels between two of a layer.
    class Row;

    const FloorTexture& texture_;
    std::array<Layer, floor_layers> layers_;
};

}  // namespace sikku
