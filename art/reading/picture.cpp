#include "art/reading/picture.h"

#include "engine/base/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sikku {
namespace {

/// Averages over 2 r + 1 values along columns, for strips of columns in parallel; values outside continue the border.
void average_columns(const GreyPicture& from, GreyPicture& to, std::size_t r) {
    to.width = from.width;
    to.height = from.height;
    to.values.resize(from.values.size());
    const std::size_t last = from.height - 1;
    const std::size_t width = from.width;
    const auto row = [&](std::size_t y) { return from.values.data() + y * width; };
    const float share = 1.0F / static_cast<float>(2 * r + 1);
    constexpr std::size_t strip = 512;
    for_each_index((width + strip - 1) / strip, [&](std::size_t number) {
        const std::size_t left = number * strip;
        const std::size_t columns = std::min(strip, width - left);
        std::array<float, strip> sums{};
        for (std::size_t x = 0; x < columns; ++x) {
            double sum = static_cast<double>(r + 1) * row(0)[left + x];
            for (std::size_t i = 1; i <= r; ++i) sum += row(std::min(i, last))[left + x];
            sums[x] = static_cast<float>(sum);
        }
        for (std::size_t y = 0; y <= last; ++y) {
            const float* enters = row(std::min(y + r + 1, last)) + left;
            const float* leaves = row(y > r ? y - r : 0) + left;
            float* here = to.values.data() + y * width + left;
            for (std::size_t x = 0; x < columns; ++x) {
                here[x] = sums[x] * share;
                sums[x] += enters[x] - leaves[x];
            }
        }
    });
}

/// Turns rows into columns, in blocks that fit into the cache, and in parallel.
void transpose(const GreyPicture& from, GreyPicture& to) {
    to.width = from.height;
    to.height = from.width;
    to.values.resize(from.values.size());
    constexpr std::size_t block = 32;
    for_each_index((from.height + block - 1) / block, [&](std::size_t number) {
        const std::size_t top = number * block;
        const std::size_t bottom = std::min(top + block, from.height);
        for (std::size_t left = 0; left < from.width; left += block) {
            const std::size_t right = std::min(left + block, from.width);
            for (std::size_t x = left; x < right; ++x) {
                float* column = to.values.data() + x * to.width;
                for (std::size_t y = top; y < bottom; ++y) column[y] = from.values[y * from.width + x];
            }
        }
    });
}

/// The half widths of three averages that are nearly a Gaussian of a standard deviation, without those of 0.
std::vector<std::size_t> averages_for(double radius) {
    // Each average of 2 r + 1 values adds ((2 r + 1)^2 - 1) / 12 to the variance.
    std::vector<std::size_t> halves;
    double missing = radius * radius;
    for (int pass = 3; pass > 0; --pass) {
        const auto r = static_cast<std::size_t>(std::lround((std::sqrt(12 * missing / pass + 1) - 1) / 2));
        if (r == 0) break;
        halves.push_back(r);
        const double side = 2.0 * static_cast<double>(r) + 1;
        missing = std::max(0.0, missing - (side * side - 1) / 12);
    }
    return halves;
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
    GreyPicture other;
    // A wider average than the picture is that of its border.
    radius = std::min(radius, static_cast<double>(std::max(picture.width, picture.height)));
    const std::vector<std::size_t> halves = averages_for(radius);
    for (int way = 0; way < 2 && !halves.empty(); ++way) {
        for (const std::size_t r : halves) {
            average_columns(picture, other, r);
            std::swap(picture, other);
        }
        transpose(picture, other);
        std::swap(picture, other);
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
