// art/raster/blend.h: blends colours onto a band of pixels.
#pragma once

#include "art/raster/floor.h"
#include "art/raster/stroke.h"
#include "art/style/colour.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A band of 8-bit sRGB pixels. Colours are blended in sRGB and not in linear light, as print and web expect.
/// Channels: 1 (grey, from the red of each colour), 3, or 4 (straight alpha).
class Canvas {
public:
    Canvas(int width, int rows, int channels, Simd simd = best_simd());

    /// Starts a band of at most the rows of the constructor: all ground, nothing painted.
    void clear(Colour ground, int rows);
    /// Paints a floor as its ground, which begins `top` rows below the picture's top edge. Call after clear(), with
    /// at least three channels.
    void lay_floor(const FloorPaint& floor, int top);

    /// Paints a run of pixels of which a polygon covers `coverage` / 255. Polygons that share an edge do not leave a
    /// seam, whatever their colours: until a pixel is full, parts are taken to lie beside each other and not above
    /// each other.
    void polygon_span(int row, int first, int end, int coverage, Colour colour);

    /// Paints `colour` through the mask over the existing pixels, and clears the mask.
    void blend(Mask& mask, Colour colour);

    std::span<const std::uint8_t> pixels() const {
        return {pixels_.data(), static_cast<std::size_t>(width_) * channels_ * rows_};
    }

private:
    void polygon_pixel(std::uint8_t* pixel, const std::uint8_t* ground, std::uint8_t& bare, int coverage,
                       Colour colour);
    void begin_polygons();

    int width_, rows_, channels_;
    Simd simd_;
    Colour ground_;
    std::vector<std::uint8_t> pixels_;
    std::vector<std::uint8_t> bare_;  ///< share of each pixel not covered by polygons so far; made when needed
    bool bare_ready_ = false;
    bool has_floor_ = false;
    std::vector<std::uint8_t> floor_;  ///< the pixels before the first polygon, on a floor
};

}  // namespace sikku
