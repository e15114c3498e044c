// art/decoder/averager.h: makes pictures smaller while their rows are decoded. Part of the decoder.
#pragma once

#include "art/image/image_file.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// The order of the channels in a decoded row.
struct PixelLayout {
    int channels = 3;                   ///< 1 to 5, of which the first is grey, or the first three are RGB
    int alpha = -1;                     ///< channel of the opacity; -1: opaque
    bool is_colour_times_alpha = true;  ///< false: straight alpha
};

/// Averages rows of pixels over squares, with transparent parts on white, until no side is longer than
/// `longest_side`.
class Averager {
public:
    Averager(int width, int height, PixelLayout layout, int longest_side);
    /// Adds the next row: `width` pixels of 8 bits a channel.
    void row(const std::uint8_t* pixels);
    /// The picture, turned by its EXIF orientation (1 to 8). Call once, after the last row.
    DecodedPicture take(int orientation);

private:
    int width_, factor_;
    PixelLayout layout_;
    int rows_ = 0, next_ = 0;
    DecodedPicture picture_;
    std::vector<std::uint32_t> sums_;
};

}  // namespace sikku
