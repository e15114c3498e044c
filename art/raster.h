// art/raster.h: a drawing as pixels, rendered in bands that are re-used.
#pragma once

#include "art/print.h"
#include "engine/path.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace sikku {

/// Size of the print in pixels: page times dpi, rounded to nearest.
struct PixelSize {
    int width = 0, height = 0;
};
PixelSize pixel_size(const Page& page, double dpi);

/// Receives finished rows, 8 bits a channel, top to bottom; called from one thread at a time, in order.
using RowSink = std::function<void(int first_row, int rows, std::span<const std::uint8_t> pixels)>;

/// Collects a drawing in pixel coordinates, then renders it in bands.
class Raster : public PathSink {
public:
    /// 1 (grey), 3 (RGB) or 4 (RGBA, straight alpha, when the ground is transparent): the fewest channels that can
    /// show the print's style.
    virtual int channels() const = 0;
    /// Renders with `threads` threads (0: all cores); the pixels do not depend on their number.
    virtual void render(int threads, const RowSink& rows) = 0;
};
std::unique_ptr<Raster> make_raster(const Print& print);

}  // namespace sikku
