// art/raster/raster.h: renders a drawing as pixels, in reused bands.
#pragma once

#include "art/print/print.h"
#include "engine/geometry/path.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace sikku {

struct PixelSize {
    int width = 0, height = 0;
};
/// Size of a print in pixels: page times dpi, rounded to nearest, from 1 to 10^9 a side. Does not throw:
/// make_raster() refuses sizes that are too large.
PixelSize pixel_size(const Page& page, double dpi);

/// Receives finished rows, 8 bits a channel, top to bottom; called from one thread at a time, in order.
using RowSink = std::function<void(int first_row, int rows, std::span<const std::uint8_t> pixels)>;

/// A point of a line of powder: its place and half its width, in turtle steps, and its height: 1 for a line, up
/// to 1.5 where powder lies on powder, less where the hand runs dry.
struct PowderPoint {
    glm::dvec2 at{0.0};
    double half = 0;
    double height = 1;
};

/// A complete picture, which renders its pixels in bands.
class Rendering {
public:
    virtual ~Rendering() = default;
    /// Number of channels: 1 (grey), 3 (RGB) or 4 (RGBA, straight alpha, when the ground is transparent or partly
    /// so), the fewest that can show the ground and the colours used.
    virtual int channels() const = 0;
    /// Called from time to time while rows are rendered, also from several threads at once; may throw to stop.
    virtual void watch(std::function<void()> watch) = 0;
    /// Renders with `threads` threads (0: all cores); the pixels do not depend on their number or on the processor.
    /// May be called again. An exception of `rows` ends the rendering and is passed on.
    virtual void render(int threads, const RowSink& rows) = 0;
    /// Renders only the rows [first, end): multiples of 128, or the height of the print. `channels` is at least
    /// channels(). May be called from several threads at once.
    virtual void render_rows(int first, int end, int channels, const RowSink& rows) const = 0;
};

/// Collects a drawing in pixel coordinates, then renders it in bands. Its layers, from the ground up: polygons in
/// drawing order; strokes, one colour after the other in the order of the palette, each colour laid on once however
/// often its lines cross; discs likewise. Colours mix in 8-bit sRGB.
///
/// A stroke without length is a dot. Lines under one pixel wide keep their ink: they are paler, and crossings add up.
/// Curves are within 0.05 pixel of their chords. Coordinates are rounded to 1/1024 pixel.
/// Memory: 4 bytes a line of the flattened drawing (12 if longer than 32 pixels), whatever the page; and a band of 32
/// to 128 rows for each thread and one more, 2 to 10 bytes a pixel, at most 4 million pixels.
///
/// Blots are spread by their covariance, and add up with lines under one pixel; they are for pens of that width. They
/// take 4 bytes a pixel of the page. Query and render the raster once the drawing is complete.
class Raster : public BlotSink, public Rendering {
public:
    /// Counts the pen among the colours used.
    virtual void expect(const Pen& pen) = 0;

    /// Adds a line of powder in the colour of the pen, or a heap if it is one point. Powder lies over the strokes of
    /// its colour, or, with `fills`, over all discs, in the pen's colour of fills. Set the grain first.
    virtual void powder(std::span<const PowderPoint> line, const Pen& pen, bool fills) = 0;
    /// Sets the size of a grain of powder, in turtle steps.
    virtual void set_grain(double steps) = 0;
};

/// `print` is kept by reference and must outlive the raster. @throws std::runtime_error if a side is over 500,000
/// pixels
std::unique_ptr<Raster> make_raster(const Print& print);

}  // namespace sikku
