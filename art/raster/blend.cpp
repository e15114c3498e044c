#include "art/raster/blend.h"

#include <algorithm>
#include <array>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#define SIKKU_X86 1
#endif

namespace sikku {
namespace {

// value / 255 to nearest, for value <= 255 * 255.
inline unsigned divide_by_255(unsigned value) {
    value += 128;
    return (value + (value >> 8)) >> 8;
}

inline std::uint8_t mix(unsigned below, unsigned above, unsigned alpha) {
    return static_cast<std::uint8_t>(divide_by_255(below * (255 - alpha) + above * alpha));
}

using Bytes = std::array<std::uint8_t, 4>;

Bytes bytes(Colour colour) {
    return {colour.red, colour.green, colour.blue, colour.alpha};
}

// Fills `size` bytes with whole pixels of one colour.
void fill(std::uint8_t* to, std::size_t size, const Bytes& colour, int channels) {
    if (std::all_of(colour.begin(), colour.begin() + channels, [&](auto byte) { return byte == colour[0]; })) {
        std::memset(to, colour[0], size);
        return;
    }
    if (size < 256) {
        for (std::uint8_t* end = to + size; to != end; to += channels) {
            for (int channel = 0; channel < channels; ++channel)
                to[channel] = colour[static_cast<std::size_t>(channel)];
        }
        return;
    }
    // A stretch of pixels, then copies of it, doubled up to the size of the first cache.
    const std::size_t start = std::min(size, static_cast<std::size_t>(16 * channels));
    for (std::size_t i = 0; i < start; ++i) to[i] = colour[i % static_cast<std::size_t>(channels)];
    for (std::size_t done = start; done < size;) {
        const std::size_t stretch = std::min({done, size - done, start << 8});
        std::memcpy(to + done, to, stretch);
        done += stretch;
    }
}

// Straight alpha, source over.
void over(std::uint8_t* pixel, const Bytes& colour, unsigned alpha) {
    if (alpha == 0) return;
    const unsigned below = pixel[3];
    if (alpha == 255 || below == 0) {
        std::copy_n(colour.begin(), 3, pixel);
        pixel[3] = static_cast<std::uint8_t>(alpha);
        return;
    }
    // Weights of the two colours in the sum, both times 255.
    const unsigned above_weight = alpha * 255, below_weight = below * (255 - alpha);
    const unsigned sum = above_weight + below_weight;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] = static_cast<std::uint8_t>(
            (colour[channel] * above_weight + pixel[channel] * below_weight + sum / 2) / sum);
    }
    pixel[3] = static_cast<std::uint8_t>(divide_by_255(sum));
}

template <int channels>
void blend_pixels(std::uint8_t* pixels, const std::uint8_t* mask, int count, Colour colour) {
    const Bytes paint = bytes(colour);
    for (int i = 0; i < count; ++i, pixels += channels) {
        if (mask[i] == 0) continue;
        const unsigned alpha = divide_by_255(unsigned{mask[i]} * colour.alpha);
        if constexpr (channels == 4) {
            over(pixels, paint, alpha);
        } else {
            for (int channel = 0; channel < channels; ++channel) {
                pixels[channel] = mix(pixels[channel], paint[static_cast<std::size_t>(channel)], alpha);
            }
        }
    }
}

// These functions clear the mask. Most of a page is bare: there they only read the mask.
template <int channels>
void blend_row(std::uint8_t* pixels, std::uint8_t* mask, int width, Colour colour) {
    for (int column = 0; column < width; column += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, mask + column, 8);
        if (eight == 0) continue;
        blend_pixels<channels>(pixels + column * channels, mask + column, std::min(8, width - column), colour);
        std::memset(mask + column, 0, 8);
    }
}

#ifdef SIKKU_X86
#define SIKKU_AVX2 __attribute__((target("avx2")))

SIKKU_AVX2 inline __m256i divide_by_255(__m256i value) {
    value = _mm256_add_epi16(value, _mm256_set1_epi16(128));
    return _mm256_srli_epi16(_mm256_add_epi16(value, _mm256_srli_epi16(value, 8)), 8);
}

SIKKU_AVX2 inline __m128i narrow(__m256i words) {
    return _mm_packus_epi16(_mm256_castsi256_si128(words), _mm256_extracti128_si256(words, 1));
}

SIKKU_AVX2 inline __m128i mix(__m128i below, __m256i above, __m128i alpha) {
    const __m256i wide_alpha = _mm256_cvtepu8_epi16(alpha);
    const __m256i rest = _mm256_sub_epi16(_mm256_set1_epi16(255), wide_alpha);
    return narrow(divide_by_255(_mm256_add_epi16(_mm256_mullo_epi16(_mm256_cvtepu8_epi16(below), rest),
                                                 _mm256_mullo_epi16(above, wide_alpha))));
}

SIKKU_AVX2 inline __m128i load(const std::uint8_t* from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

SIKKU_AVX2 inline void store(std::uint8_t* to, __m128i value) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), value);
}

SIKKU_AVX2 inline __m128i scaled(__m128i mask, unsigned alpha) {
    if (alpha == 255) return mask;
    const __m256i factor = _mm256_set1_epi16(static_cast<short>(alpha));
    return narrow(divide_by_255(_mm256_mullo_epi16(_mm256_cvtepu8_epi16(mask), factor)));
}

// Both return the first column that is not done.
SIKKU_AVX2 int blend_grey_avx2(std::uint8_t* pixels, std::uint8_t* mask, int width, Colour colour) {
    const __m256i above = _mm256_set1_epi16(colour.red);
    int column = 0;
    for (; column + 16 <= width; column += 16) {
        const __m128i coverage = load(mask + column);
        if (_mm_testz_si128(coverage, coverage)) continue;
        store(mask + column, _mm_setzero_si128());
        store(pixels + column, mix(load(pixels + column), above, scaled(coverage, colour.alpha)));
    }
    return column;
}

SIKKU_AVX2 int blend_rgb_avx2(std::uint8_t* pixels, std::uint8_t* mask, int width, Colour colour) {
    // 16 pixels are 48 bytes, three vectors: byte i belongs to pixel i / 3 and channel i % 3.
    alignas(16) std::uint8_t which[48];
    alignas(16) std::uint8_t paint[48];
    for (int i = 0; i < 48; ++i) {
        which[i] = static_cast<std::uint8_t>(i / 3);
        paint[i] = bytes(colour)[static_cast<std::size_t>(i % 3)];
    }
    const __m128i which0 = load(which), which1 = load(which + 16), which2 = load(which + 32);
    const __m256i above0 = _mm256_cvtepu8_epi16(load(paint));
    const __m256i above1 = _mm256_cvtepu8_epi16(load(paint + 16));
    const __m256i above2 = _mm256_cvtepu8_epi16(load(paint + 32));
    int column = 0;
    for (; column + 16 <= width; column += 16) {
        const __m128i coverage = load(mask + column);
        if (_mm_testz_si128(coverage, coverage)) continue;
        store(mask + column, _mm_setzero_si128());
        const __m128i alpha = scaled(coverage, colour.alpha);
        std::uint8_t* at = pixels + column * 3;
        store(at, mix(load(at), above0, _mm_shuffle_epi8(alpha, which0)));
        store(at + 16, mix(load(at + 16), above1, _mm_shuffle_epi8(alpha, which1)));
        store(at + 32, mix(load(at + 32), above2, _mm_shuffle_epi8(alpha, which2)));
    }
    return column;
}

#endif

}  // namespace

Canvas::Canvas(int width, int rows, int channels, Simd simd)
    : width_(width),
      rows_(rows),
      channels_(channels),
      simd_(simd),
      pixels_(static_cast<std::size_t>(width) * rows * channels) {}

void Canvas::clear(Colour ground, int rows) {
    ground_ = ground;
    rows_ = rows;
    bare_ready_ = has_floor_ = false;
    const Bytes colour = bytes(ground);
    fill(pixels_.data(), pixels().size(), colour, channels_);
}

void Canvas::lay_floor(const FloorPaint& floor, int top) {
    has_floor_ = true;
    for (int row = 0; row < rows_; ++row) {
        floor.paint(pixels_.data() + static_cast<std::ptrdiff_t>(row) * width_ * channels_, top + row, width_,
                    channels_);
    }
}

/// @param ground  its colour at the pixel
void Canvas::polygon_pixel(std::uint8_t* pixel, const std::uint8_t* ground, std::uint8_t& bare, int coverage,
                           Colour colour) {
    const Bytes paint = bytes(colour);
    const int bare_after = bare < coverage ? 0 : bare - coverage;
    if (channels_ < 4 && colour.alpha == 255 && (coverage <= bare || bare == 0)) {
        // The common cases: all of it on the bare share, which was ground; or all on painted parts.
        const bool on_ground = coverage <= bare;
        for (std::size_t channel = 0; channel < static_cast<std::size_t>(channels_); ++channel) {
            const int below = on_ground ? ground[channel] : pixel[channel];
            const int change = (paint[channel] - below) * coverage;
            pixel[channel] = static_cast<std::uint8_t>(
                std::clamp(pixel[channel] + (change + (change < 0 ? -127 : 127)) / 255, 0, 255));
        }
        bare = static_cast<std::uint8_t>(bare_after);
        return;
    }
    // Premultiplied, as fractions. `ground` fills the bare share of the pixel, painted parts the rest. The new piece
    // covers the bare share first and only then painted parts.
    const float bare_share = static_cast<float>(bare) / 255, share = static_cast<float>(coverage) / 255;
    const float on_bare = std::min(share, bare_share), on_painted = share - on_bare;
    const float alpha = static_cast<float>(colour.alpha) / 255;
    const float kept = bare_share < 1 ? 1 - on_painted / (1 - bare_share) * alpha : 1;
    const float ground_alpha = channels_ == 4 ? static_cast<float>(ground_.alpha) / 255 : 1;
    const float pixel_alpha = channels_ == 4 ? static_cast<float>(pixel[3]) / 255 : 1;
    const auto paint_over = [&](float of_paint, float of_ground, float of_pixel) {
        const float painted = of_pixel - bare_share * of_ground;
        return share * alpha * of_paint + (bare_share - on_bare * alpha) * of_ground + kept * painted;
    };
    const float alpha_after = channels_ == 4 ? paint_over(1, ground_alpha, pixel_alpha) : 1;
    for (std::size_t channel = 0; channel < static_cast<std::size_t>(std::min(channels_, 3)); ++channel) {
        const float sum = paint_over(paint[channel], ground[channel] * ground_alpha, pixel[channel] * pixel_alpha);
        const float value = alpha_after > 0 ? sum / alpha_after : 0;
        pixel[channel] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
    }
    if (channels_ == 4) pixel[3] = static_cast<std::uint8_t>(std::clamp(alpha_after, 0.0f, 1.0f) * 255 + 0.5f);
    bare = static_cast<std::uint8_t>(bare_after);
}

void Canvas::begin_polygons() {
    bare_.assign(static_cast<std::size_t>(width_) * rows_, 255);
    if (has_floor_) floor_.assign(pixels().begin(), pixels().end());
    bare_ready_ = true;
}

void Canvas::polygon_span(int row, int first, int end, int coverage, Colour colour) {
    // The last band of a page has fewer rows than a polygon that reaches below it.
    if (row >= rows_) return;
    if (!bare_ready_) begin_polygons();
    std::uint8_t* bare = bare_.data() + static_cast<std::ptrdiff_t>(row) * width_;
    const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(row) * width_ * channels_;
    std::uint8_t* pixels = pixels_.data() + start;
    if (coverage < 255 || colour.alpha < 255) {
        const Bytes plain = bytes(ground_);
        for (int column = first; column < end; ++column) {
            const std::uint8_t* ground = has_floor_ ? floor_.data() + start + column * channels_ : plain.data();
            polygon_pixel(pixels + column * channels_, ground, bare[column], coverage, colour);
        }
        return;
    }
    std::memset(bare + first, 0, static_cast<std::size_t>(end - first));
    const Bytes paint = bytes(colour);
    if (channels_ == 1) {
        std::memset(pixels + first, paint[0], static_cast<std::size_t>(end - first));
        return;
    }
    fill(pixels + first * channels_, static_cast<std::size_t>(end - first) * channels_, paint, channels_);
}

void Canvas::blend(Mask& mask, Colour colour) {
    for (int row = 0; row < rows_; ++row) {
        std::uint8_t* coverage = mask.pixels + row * mask.stride;
        std::uint8_t* pixels = pixels_.data() + static_cast<std::ptrdiff_t>(row) * width_ * channels_;
        int done = 0;
#ifdef SIKKU_X86
        if (simd_ == Simd::avx2 && channels_ == 1) done = blend_grey_avx2(pixels, coverage, width_, colour);
        if (simd_ == Simd::avx2 && channels_ == 3) done = blend_rgb_avx2(pixels, coverage, width_, colour);
#endif
        pixels += done * channels_;
        if (channels_ == 1) blend_row<1>(pixels, coverage + done, width_ - done, colour);
        if (channels_ == 3) blend_row<3>(pixels, coverage + done, width_ - done, colour);
        if (channels_ == 4) blend_row<4>(pixels, coverage + done, width_ - done, colour);
        std::memset(coverage + width_, 0, mask_padding);
    }
}

}  // namespace sikku
