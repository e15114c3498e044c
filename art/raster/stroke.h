// art/raster/stroke.h: computes the 8-bit coverage of pixels by lines of any width, from the distance to capsules.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Coordinates inside the rasteriser are whole numbers of 1/1024 pixel.
constexpr int subpixel_bits = 10;
constexpr int subpixels = 1 << subpixel_bits;

/// A point in 1/1024 pixel, y down.
struct SubPoint {
    std::int32_t x = 0, y = 0;
    bool operator==(const SubPoint&) const = default;
};

/// Coverage of a band of pixels, 0 to 255. Kernels write whole vectors: every row is followed by at least
/// `mask_padding` bytes, and the last row by one more row, whose contents are undefined.
struct Mask {
    std::uint8_t* pixels = nullptr;
    std::ptrdiff_t stride = 0;
    int width = 0, rows = 0;
};
constexpr int mask_padding = 32;

/// Instruction set of the kernels. The coverage is the same, bit for bit, for all.
enum class Simd { scalar, sse2, avx2 };

/// The best instruction set that this processor supports.
Simd best_simd();

/// Draws polylines with round caps and joins into a mask, combined by maximum, so that a line is not darker where it
/// crosses or touches itself. Coverage depends only on the distance to the line and its direction: along a straight
/// edge it is the exact area of the pixel on the inner side; at caps and joins that of an edge of the line's slant.
/// Pens under about 1.4 pixels, whose two edges share pixels, are up to 1/10 too dark in some.
///
/// Cost: the pixels of the line's bounding box for pens of a few pixels, about 30 ns for a segment of 8 pixels;
/// for wide pens the pixels along the two edges, and a memset between them.
class Stroker {
public:
    /// Draws into `mask`, whose upper left corner lies `top` rows below that of the page.
    Stroker(const Mask& mask, int top, Simd simd = best_simd());

    /// Sets the radius of the following lines, 1/2 to 250,000 pixels.
    void pen(float radius);
    void move(SubPoint start);
    /// Draws a line of at most 4096 pixels; one without length is a dot.
    void line(SubPoint end);
    /// Call it after the last line.
    void finish() { flush(true); }

    /// A capsule for the kernels, in units of 1/255 pixel: `u` along and `v` across the line, measured from its
    /// middle, at the centre of the first pixel; `ux` and `uy` the line's direction.
    struct Capsule {
        float u, v, ux, uy;
        float half;  ///< half the length
        float radius;
        // Area of a pixel on one side of the edge as a function of the distance of its centre: `slope` times the
        // distance, with a parabola at both ends, `soft` to either side of the end of the slope, `middle` from the
        // edge.
        float slope, middle, soft;
        float parabola;
        // Lines along rows or columns have a slope of 1 without soft ends: for them `radius` is larger by 128, half a
        // pixel and the rounding, and the other fields are unused.
    };
    /// Pixels [first, end) of a row, counted from the first pixel.
    struct Span {
        int row, first, end;
    };
    struct Kernels {
        void (*block)(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& capsule);
        void (*spans)(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count,
                      const Capsule& capsule);
    };

private:
    struct Segment {
        SubPoint from, to;
        float length = 0;                     ///< pixels
        float ux = 1, uy = 0;                 ///< direction
        float long_side = 1, short_side = 0;  ///< the larger and the smaller of |ux| and |uy|
        float ramp = 0.5f;  ///< pixels to either side of the edge over which coverage goes from full to none
        float before = 0;   ///< pixels before its start that this segment covers
        float after = 0;    ///< pixels after its end that it covers
    };
    void flush(bool ends);
    void draw(const Segment& segment);
    void draw_rows(const Segment& segment, const Capsule& capsule, int x0, int y0, int columns, int rows);

    Mask mask_;
    std::int32_t top_;
    Kernels hard_, soft_;  ///< for lines along rows and columns, and for all others
    float radius_ = 0.5f;
    bool wide_ = false;
    SubPoint at_;
    Segment pending_;
    bool has_pending_ = false;
    std::vector<Span> spans_;
};

}  // namespace sikku
