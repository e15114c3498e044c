// art/raster/powder.h: draws lines of powder: heaps with grain at their edges.
#pragma once

#include "art/raster/stroke.h"

#include <glm/mat3x2.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace sikku {

/// A piece of a heap whose middle runs from `a` to `b`, in pixels of the page. It covers `radius` on either side;
/// some grains lie beyond.
struct PowderSegment {
    float ax = 0, ay = 0, bx = 0, by = 0;
    float a_radius = 0, b_radius = 0;
    float before = 0, after = 0;       ///< pixels beyond the ends that this piece covers, too
    float a_height = 1, b_height = 1;  ///< 1 for a line; more where it is denser, less where it has gaps
};

/// Maximum distance of the grains of a heap from its middle, in radii.
constexpr double powder_reach = 1.35;

/// Turns the height of powder into coverage. Grains depend only on the place in the drawing.
class PowderGrain {
public:
    /// @param to_pixels  from the drawing to pixels  @param grain  size of a grain in the unit of the drawing
    PowderGrain(const glm::dmat3x2& to_pixels, double grain);

    /// Replaces heights in [first, end) of a row of the page by coverage.
    void settle(std::uint8_t* heights, int row, int first, int end) const;
    /// Thins coverage in [first, end) of a row of the page for powder strewn over an area: some ground shows between
    /// its grains.
    void strew(std::uint8_t* coverage, int row, int first, int end) const;

private:
    struct Texture;
    /// A size of the texture, placed on the page.
    struct Layer {
        const std::uint8_t* texels = nullptr;
        int bits = 0;  ///< binary logarithm of its side
        // In 1/65536 texel.
        std::int64_t origin_x = 0, origin_y = 0, column_x = 0, column_y = 0, row_x = 0, row_y = 0;

        int at(std::int64_t x, std::int64_t y) const;
    };
    static const Texture& texture();
    static Layer layer(const glm::dmat3x2& to_pixels, double grain);

    Layer grains_, clumps_;
    int contrast_;
};

/// Draws segments into a mask whose upper left corner is `top` rows below that of the page: the height of the heaps,
/// the maximum where they overlap, turned into coverage by `grain`.
/// Cost: about 10 ns for each pixel of powder.
void lay_powder(const std::vector<PowderSegment>& segments, const PowderGrain& grain, Mask& mask, int top,
                const std::function<void()>& watch);

}  // namespace sikku
