#include "art/decoder/averager.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sikku {
namespace {

/// Turns a picture by its EXIF orientation (1 to 8). Source: Exif 2.32, tag 274.
void turn(DecodedPicture& picture, int orientation) {
    if (orientation < 2 || orientation > 8) return;
    const bool is_transposed = orientation >= 5;
    DecodedPicture turned{
        is_transposed ? picture.height : picture.width, is_transposed ? picture.width : picture.height,
        std::vector<std::uint8_t>(picture.pixels.size()), is_transposed ? picture.file_height : picture.file_width,
        is_transposed ? picture.file_width : picture.file_height};
    for (int y = 0; y < turned.height; ++y) {
        for (int x = 0; x < turned.width; ++x) {
            int from_x = is_transposed ? y : x;
            int from_y = is_transposed ? x : y;
            if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) {
                from_x = picture.width - 1 - from_x;
            }
            if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) {
                from_y = picture.height - 1 - from_y;
            }
            const auto to = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(turned.width) +
                                 static_cast<std::size_t>(x));
            const auto from = 3 * (static_cast<std::size_t>(from_y) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(from_x));
            for (std::size_t c = 0; c < 3; ++c) turned.pixels[to + c] = picture.pixels[from + c];
        }
    }
    picture = std::move(turned);
}

}  // namespace

Averager::Averager(int width, int height, PixelLayout layout, int longest_side)
    : width_(width),
      factor_(std::max(1, (std::max(width, height) + longest_side - 1) / longest_side)),
      layout_(layout) {
    picture_.width = std::max(1, width / factor_);
    picture_.height = std::max(1, height / factor_);
    picture_.file_width = width;
    picture_.file_height = height;
    picture_.pixels.resize(3 * static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height));
    sums_.resize(3 * static_cast<std::size_t>(picture_.width));
}

void Averager::row(const std::uint8_t* pixels) {
    const int columns = std::min(width_, picture_.width * factor_);
    const bool is_grey = layout_.channels < 3;
    for (int x = 0; x < columns; ++x) {
        const std::uint8_t* pixel = pixels + static_cast<std::size_t>(x) * static_cast<std::size_t>(layout_.channels);
        const auto to = 3 * static_cast<std::size_t>(x / factor_);
        const std::uint32_t alpha = layout_.alpha >= 0 ? pixel[layout_.alpha] : 255U;
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint32_t value = pixel[is_grey ? 0 : c];
            if (!layout_.is_colour_times_alpha) value = (value * alpha + 127) / 255;
            sums_[to + c] += std::min(255U, value + 255U - alpha);
        }
    }
    ++rows_;
    const int in_square = std::min(factor_, picture_.file_height);
    if (rows_ % in_square != 0 || next_ >= picture_.height) return;
    const auto area = static_cast<std::uint32_t>(in_square * std::min(factor_, width_));
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        picture_.pixels[sums_.size() * static_cast<std::size_t>(next_) + i] =
            static_cast<std::uint8_t>((sums_[i] + area / 2) / area);
        sums_[i] = 0;
    }
    ++next_;
}

DecodedPicture Averager::take(int orientation) {
    turn(picture_, orientation);
    return std::move(picture_);
}

}  // namespace sikku
