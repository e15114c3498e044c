#include "art/reading/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sikku {
namespace {

/// Averages over 2 r + 1 values along rows, and turns rows into columns.
void average_rows(const GreyPicture& from, GreyPicture& to, std::size_t r) {
    to.width = from.height;
    to.height = from.width;
    to.values.resize(from.values.size());
    const std::size_t last = from.width - 1;
    const float share = 1.0F / static_cast<float>(2 * r + 1);
    // Blocks of rows keep the writes to columns within the cache.
    constexpr std::size_t block = 16;
    std::vector<float> sums(block);
    for (std::size_t begin = 0; begin < from.height; begin += block) {
        const std::size_t end = std::min(begin + block, from.height);
        for (std::size_t y = begin; y < end; ++y) {
            const float* row = from.values.data() + y * from.width;
            double sum = static_cast<double>(r + 1) * row[0];
            for (std::size_t i = 1; i <= r; ++i) sum += row[std::min(i, last)];
            sums[y - begin] = static_cast<float>(sum);
        }
        for (std::size_t x = 0; x < from.width; ++x) {
            const std::size_t enters = std::min(x + r + 1, last);
            const std::size_t leaves = x > r ? x - r : 0;
            float* column = to.values.data() + x * to.width;
            for (std::size_t y = begin; y < end; ++y) {
                const float* row = from.values.data() + y * from.width;
                column[y] = sums[y - begin] * share;
                sums[y - begin] += row[enters] - row[leaves];
            }
        }
    }
}

/// Interpolates a line of pixels.
/// @param apart  bytes from pixel to pixel, in both
void stretch(const std::uint8_t* from, std::size_t length, std::size_t apart, std::uint8_t* to, std::size_t times) {
    for (std::size_t phase = 0; phase < times; ++phase) {
        const double at = (static_cast<double>(phase) + 0.5) / static_cast<double>(times) - 0.5;
        const double t = at - std::floor(at);
        const std::array<float, 4> weights = {
            static_cast<float>(0.5 * t * (-1 + t * (2 - t))), static_cast<float>(0.5 * (2 + t * t * (3 * t - 5))),
            static_cast<float>(0.5 * t * (1 + t * (4 - 3 * t))), static_cast<float>(0.5 * t * t * (t - 1))};
        for (std::size_t i = 0; i < length; ++i) {
            std::array<const std::uint8_t*, 4> pixels{};
            for (std::size_t k = 0; k < 4; ++k) {
                const std::ptrdiff_t index = static_cast<std::ptrdiff_t>(i + k) - (at < 0 ? 2 : 1);
                pixels[k] = from + apart * static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
                                               index, 0, static_cast<std::ptrdiff_t>(length) - 1));
            }
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.5F;
                for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * static_cast<float>(pixels[k][c]);
                to[apart * (i * times + phase) + c] = static_cast<std::uint8_t>(std::clamp(sum, 0.0F, 255.0F));
            }
        }
    }
}

}  // namespace

GreyPicture blurred(GreyPicture picture, double radius) {
    if (picture.values.empty()) return picture;
    // Each average of 2 r + 1 values adds ((2 r + 1)^2 - 1) / 12 to the variance.
    GreyPicture turned;
    // A wider average than the picture is that of its border.
    radius = std::min(radius, static_cast<double>(std::max(picture.width, picture.height)));
    double missing = radius * radius;
    for (int pass = 3; pass > 0; --pass) {
        const auto r = static_cast<std::size_t>(std::lround((std::sqrt(12 * missing / pass + 1) - 1) / 2));
        if (r == 0) break;
        const double side = 2.0 * static_cast<double>(r) + 1;
        missing = std::max(0.0, missing - (side * side - 1) / 12);
        average_rows(picture, turned, r);
        average_rows(turned, picture, r);
    }
    return picture;
}

DecodedPicture enlarged(const DecodedPicture& picture, int times) {
    DecodedPicture large = picture;
    large.width = picture.width * times;
    large.height = picture.height * times;
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    const auto factor = static_cast<std::size_t>(times);
    // Rows first, then columns.
    std::vector<std::uint8_t> wide(picture.pixels.size() * factor);
    for (std::size_t y = 0; y < height; ++y) {
        stretch(&picture.pixels[3 * width * y], width, 3, &wide[3 * width * factor * y], factor);
    }
    large.pixels.resize(wide.size() * factor);
    const std::size_t row = 3 * width * factor;
    for (std::size_t x = 0; x < width * factor; ++x) stretch(&wide[3 * x], height, row, &large.pixels[3 * x], factor);
    return large;
}

Ink find_ink(const DecodedPicture& picture, const Monitor& monitor) {
    GreyPicture grey(static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
    std::array<float, 256> logarithms{};
    for (std::size_t i = 0; i < logarithms.size(); ++i) logarithms[i] = std::log(static_cast<float>(i) + 12.0F);
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
        // Rec. 709 weights of sRGB values.
        const std::uint8_t* pixel = &picture.pixels[3 * i];
        grey.values[i] = logarithms[(54U * pixel[0] + 183U * pixel[1] + 19U * pixel[2]) >> 8U];
    }
    monitor.check();
    const double around = 0.06 * static_cast<double>(std::min(grey.width, grey.height));
    Ink ink{blurred(grey, around)};
    monitor.check();
    // Pictures are large: each step overwrites the data of the step before.
    GreyPicture& squares = grey;
    double sum = 0;
    double cubes = 0;
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
        const float value = ink.values.values[i] - grey.values[i];
        ink.values.values[i] = value;
        squares.values[i] = value * value;
        sum += squares.values[i];
        cubes += static_cast<double>(value) * squares.values[i];
    }
    const double deviation = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, grey.values.size())));
    ink.is_dark = cubes >= 0;
    squares = blurred(std::move(squares), 1.5 * around);
    monitor.check();
    const auto floor = static_cast<float>(0.6 * deviation * deviation + 1e-6);
    for (std::size_t i = 0; i < grey.values.size(); ++i) ink.values.values[i] /= std::sqrt(squares.values[i] + floor);
    return ink;
}

}  // namespace sikku
