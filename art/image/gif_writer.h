// art/image/gif_writer.h: writes animated GIF; each frame stores only the difference from the previous picture.
#pragma once

#include "engine/base/output.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Shows the pictures in turn, in an endless loop. A frame contains the smallest rectangle with the pixels that
/// have changed; pixels within it that have not are transparent. Up to 255 changed colours are exact; more are
/// reduced to 255 (median cut) and dithered (Floyd & Steinberg 1976).
///
/// Cost: 1 ns for each pixel, 15 to 40 ns for each pixel of the rectangle. Memory: 7 bytes a pixel.
/// Source: GIF89a specification, 1990.
class GifWriter {
public:
    /// Writes the header. Keeps a reference. @throws std::runtime_error for sides over 65,535 pixels, and for more
    /// than 100 million pixels
    GifWriter(Output& output, int width, int height);

    /// Adds a picture: all rows from the top, 3 channels. @param seconds  display time, rounded to hundredths of a
    /// second, at least one and at most 655
    void frame(std::span<const std::uint8_t> pixels, double seconds);
    /// Adds a comment of pieces of at most 255 bytes.
    void comment(std::span<const std::string> pieces);
    /// Completes the file.
    void close();

private:
    struct Rectangle {
        int left = 0, top = 0, right = 0, bottom = 0;  ///< `right` and `bottom` are exclusive
    };
    using Colour = std::uint32_t;  ///< 0xrrggbb

    Rectangle changed(std::span<const std::uint8_t> pixels) const;
    bool is_changed(std::span<const std::uint8_t> pixels, std::size_t pixel) const;
    /// Return the index of the transparent colour.
    std::size_t index_exactly(std::span<const std::uint8_t> pixels, const Rectangle& area);
    std::size_t index_diffused(std::span<const std::uint8_t> pixels, const Rectangle& area);
    void write_picture(const Rectangle& area, std::size_t transparent, double seconds);
    void write_codes(int bits);
    void put(std::initializer_list<unsigned> bytes);
    void put_word(unsigned value) { put({value & 0xFFU, value >> 8U}); }

    Output& output_;
    int width_, height_;
    std::vector<std::uint8_t> shown_;  ///< the previous picture
    bool is_begun_ = false;
    std::vector<Colour> palette_;        ///< palette of the frame
    std::vector<std::uint8_t> indices_;  ///< indices of the pixels of the rectangle
};

}  // namespace sikku
