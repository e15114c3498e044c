#include "art/stroke.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#define SIKKU_X86 1
#endif

namespace sikku {
namespace {

using Capsule = Stroker::Capsule;
using Span = Stroker::Span;

// Every path below does the same IEEE operations on the same numbers in the same order (multiply, add, square
// root, minimum, maximum), so that the bytes do not depend on the processor. The scale of 255 is in the
// coordinates already, which leaves the clamping to saturating packs.

inline std::uint8_t coverage(const Capsule& c, float u_row, float v_row, int column) {
    const float x = static_cast<float>(column);
    const float u = u_row + x * c.ux;
    const float v = v_row - x * c.uy;
    const float along = std::max(std::fabs(u) - c.half, 0.0f);
    const float distance = std::sqrt(along * along + v * v);
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(c.reach - distance), 0, 255));
}

void block_scalar(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& c) {
    for (int row = 0; row < rows; ++row, pixels += stride) {
        const float u_row = c.u + static_cast<float>(row) * c.uy;
        const float v_row = c.v + static_cast<float>(row) * c.ux;
        for (int column = 0; column < columns; ++column) {
            pixels[column] = std::max(pixels[column], coverage(c, u_row, v_row, column));
        }
    }
}

void spans_scalar(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count,
                  const Capsule& c) {
    for (const Span* span = spans; span != spans + count; ++span) {
        std::uint8_t* line = pixels + span->row * stride;
        const float u_row = c.u + static_cast<float>(span->row) * c.uy;
        const float v_row = c.v + static_cast<float>(span->row) * c.ux;
        for (int column = span->first; column < span->end; ++column) {
            line[column] = std::max(line[column], coverage(c, u_row, v_row, column));
        }
    }
}

#ifdef SIKKU_X86

inline __m128i coverage_sse2(const Capsule& c, __m128 u_row, __m128 v_row, __m128 x) {
    const __m128 u = _mm_add_ps(u_row, _mm_mul_ps(x, _mm_set1_ps(c.ux)));
    const __m128 v = _mm_sub_ps(v_row, _mm_mul_ps(x, _mm_set1_ps(c.uy)));
    const __m128 size = _mm_andnot_ps(_mm_set1_ps(-0.0f), u);
    const __m128 along = _mm_max_ps(_mm_sub_ps(size, _mm_set1_ps(c.half)), _mm_setzero_ps());
    const __m128 distance = _mm_sqrt_ps(_mm_add_ps(_mm_mul_ps(along, along), _mm_mul_ps(v, v)));
    const __m128i value = _mm_cvttps_epi32(_mm_sub_ps(_mm_set1_ps(c.reach), distance));
    const __m128i words = _mm_packs_epi32(value, value);
    return _mm_packus_epi16(words, words);
}

// Writes four pixels at a time; what lies past the end is either nothing of this capsule or padding.
inline void row_sse2(std::uint8_t* line, int first, int end, const Capsule& c, float u_row, float v_row) {
    const __m128 u = _mm_set1_ps(u_row), v = _mm_set1_ps(v_row);
    for (int column = first; column < end; column += 4) {
        const __m128 x = _mm_add_ps(_mm_set1_ps(static_cast<float>(column)), _mm_setr_ps(0, 1, 2, 3));
        std::int32_t four;
        std::memcpy(&four, line + column, 4);
        four = _mm_cvtsi128_si32(_mm_max_epu8(_mm_cvtsi32_si128(four), coverage_sse2(c, u, v, x)));
        std::memcpy(line + column, &four, 4);
    }
}

void block_sse2(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& c) {
    for (int row = 0; row < rows; ++row, pixels += stride) {
        row_sse2(pixels, 0, columns, c, c.u + static_cast<float>(row) * c.uy, c.v + static_cast<float>(row) * c.ux);
    }
}

void spans_sse2(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count, const Capsule& c) {
    for (const Span* span = spans; span != spans + count; ++span) {
        const float row = static_cast<float>(span->row);
        row_sse2(pixels + span->row * stride, span->first, span->end, c, c.u + row * c.uy, c.v + row * c.ux);
    }
}

#define SIKKU_AVX2 __attribute__((target("avx2")))

SIKKU_AVX2 inline __m128i coverage_avx2(const Capsule& c, __m256 u_row, __m256 v_row, __m256 x) {
    const __m256 u = _mm256_add_ps(u_row, _mm256_mul_ps(x, _mm256_set1_ps(c.ux)));
    const __m256 v = _mm256_sub_ps(v_row, _mm256_mul_ps(x, _mm256_set1_ps(c.uy)));
    const __m256 size = _mm256_andnot_ps(_mm256_set1_ps(-0.0f), u);
    const __m256 along = _mm256_max_ps(_mm256_sub_ps(size, _mm256_set1_ps(c.half)), _mm256_setzero_ps());
    const __m256 distance = _mm256_sqrt_ps(_mm256_add_ps(_mm256_mul_ps(along, along), _mm256_mul_ps(v, v)));
    const __m256i value = _mm256_cvttps_epi32(_mm256_sub_ps(_mm256_set1_ps(c.reach), distance));
    const __m128i words = _mm_packs_epi32(_mm256_castsi256_si128(value), _mm256_extracti128_si256(value, 1));
    return _mm_packus_epi16(words, words);
}

SIKKU_AVX2 inline void row_avx2(std::uint8_t* line, int first, int end, const Capsule& c, float u_row, float v_row) {
    const __m256 u = _mm256_set1_ps(u_row), v = _mm256_set1_ps(v_row);
    for (int column = first; column < end; column += 8) {
        const __m256 x =
            _mm256_add_ps(_mm256_set1_ps(static_cast<float>(column)), _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7));
        __m128i* eight = reinterpret_cast<__m128i*>(line + column);
        _mm_storel_epi64(eight, _mm_max_epu8(_mm_loadl_epi64(eight), coverage_avx2(c, u, v, x)));
    }
}

SIKKU_AVX2 void block_avx2(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& c) {
    if (columns > 4) {
        for (int row = 0; row < rows; ++row, pixels += stride) {
            row_avx2(pixels, 0, columns, c, c.u + static_cast<float>(row) * c.uy,
                     c.v + static_cast<float>(row) * c.ux);
        }
        return;
    }
    // Narrow, as of upright lines: two rows of four pixels fill a vector. An odd last row takes the one below it
    // along, where this capsule has nothing, or which is padding.
    const __m256 x = _mm256_setr_ps(0, 1, 2, 3, 0, 1, 2, 3);
    const __m256 pair = _mm256_setr_ps(0, 0, 0, 0, 1, 1, 1, 1);
    for (int row = 0; row < rows; row += 2, pixels += 2 * stride) {
        const __m256 y = _mm256_add_ps(_mm256_set1_ps(static_cast<float>(row)), pair);
        const __m256 u = _mm256_add_ps(_mm256_set1_ps(c.u), _mm256_mul_ps(y, _mm256_set1_ps(c.uy)));
        const __m256 v = _mm256_add_ps(_mm256_set1_ps(c.v), _mm256_mul_ps(y, _mm256_set1_ps(c.ux)));
        std::int32_t upper, lower;
        std::memcpy(&upper, pixels, 4);
        std::memcpy(&lower, pixels + stride, 4);
        const __m128i old = _mm_insert_epi32(_mm_cvtsi32_si128(upper), lower, 1);
        const __m128i both = _mm_max_epu8(old, coverage_avx2(c, u, v, x));
        upper = _mm_cvtsi128_si32(both);
        lower = _mm_extract_epi32(both, 1);
        std::memcpy(pixels, &upper, 4);
        std::memcpy(pixels + stride, &lower, 4);
    }
}

SIKKU_AVX2 void spans_avx2(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count,
                           const Capsule& c) {
    for (const Span* span = spans; span != spans + count; ++span) {
        const float row = static_cast<float>(span->row);
        row_avx2(pixels + span->row * stride, span->first, span->end, c, c.u + row * c.uy, c.v + row * c.ux);
    }
}

#endif

Stroker::Kernels kernels(Simd simd) {
#ifdef SIKKU_X86
    if (simd == Simd::avx2) return {block_avx2, spans_avx2};
    if (simd == Simd::sse2) return {block_sse2, spans_sse2};
#endif
    static_cast<void>(simd);
    return {block_scalar, spans_scalar};
}

// Narrower pens are done by their bounding box, wider ones row by row.
constexpr float wide_radius = 2.5f;
constexpr int box_columns = 24;
constexpr int box_rows = 6;
// Shorter runs of covered pixels are computed like the others instead of being set.
constexpr int least_interior = 24;
// How much pixels, in geometry that is rounded, count on either side.
constexpr float slack = 0.02f;
// A line that departs less from an axis puts no limit on the columns.
constexpr float flat = 1e-3f;

// Columns of a row, as numbers of pixels from the middle of the line.
struct Interval {
    float low, high;
    void meet(float a, float b) {
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    bool empty() const { return low > high; }
    void join(const Interval& other) {
        if (other.empty()) return;
        if (empty()) {
            *this = other;
        } else {
            low = std::min(low, other.low);
            high = std::max(high, other.high);
        }
    }
};

}  // namespace

Simd best_simd() {
#ifdef SIKKU_X86
    static const Simd best = __builtin_cpu_supports("avx2") ? Simd::avx2 : Simd::sse2;
    return best;
#else
    return Simd::scalar;
#endif
}

Stroker::Stroker(const Mask& mask, int top, Simd simd)
    : mask_(mask), top_(top * subpixels), kernels_(kernels(simd)) {}

void Stroker::pen(float radius) {
    flush(true);
    radius_ = radius;
    reach_ = static_cast<std::int32_t>(std::ceil((radius + 0.5f) * subpixels));
    wide_ = radius > wide_radius;
}

void Stroker::move(SubPoint start) {
    flush(true);
    at_ = start;
}

void Stroker::line(SubPoint end) {
    Segment segment;
    segment.from = at_;
    segment.to = end;
    at_ = end;
    const float dx = static_cast<float>(segment.to.x - segment.from.x) * (1.0f / subpixels);
    const float dy = static_cast<float>(segment.to.y - segment.from.y) * (1.0f / subpixels);
    segment.length = std::sqrt(dx * dx + dy * dy);
    if (segment.length > 0) {
        segment.ux = dx / segment.length;
        segment.uy = dy / segment.length;
    }
    if (!wide_) {
        draw(segment);
        return;
    }
    // The maximum over the line does not change if each pixel is left to one of the segments whose distance it
    // takes: what lies before the start of a segment was done by the one before, but for the wedge outside the
    // bend, and what lies after its end is left to the next.
    segment.before = segment.after = radius_ + 0.5f;
    if (has_pending_) {
        const float cosine = pending_.ux * segment.ux + pending_.uy * segment.uy;
        const float sine = std::fabs(pending_.ux * segment.uy - pending_.uy * segment.ux);
        if (cosine > 0 && segment.length > 0 && pending_.length > 0) segment.before *= sine;
        flush(segment.length == 0);
    }
    pending_ = segment;
    has_pending_ = true;
}

void Stroker::flush(bool ends) {
    if (!has_pending_) return;
    if (!ends) pending_.after = 0;
    has_pending_ = false;
    draw(pending_);
}

void Stroker::draw(const Segment& segment) {
    const SubPoint a{segment.from.x, segment.from.y - top_}, b{segment.to.x, segment.to.y - top_};
    // Pixels whose centres lie nearer than reach to the line's box.
    constexpr std::int32_t half_pixel = subpixels / 2;
    const int x0 = std::max((std::min(a.x, b.x) - reach_ + half_pixel) >> subpixel_bits, 0);
    const int y0 = std::max((std::min(a.y, b.y) - reach_ + half_pixel) >> subpixel_bits, 0);
    const int x1 = std::min((std::max(a.x, b.x) + reach_ - half_pixel - 1) >> subpixel_bits, mask_.width - 1);
    const int y1 = std::min((std::max(a.y, b.y) + reach_ - half_pixel - 1) >> subpixel_bits, mask_.rows - 1);
    if (x0 > x1 || y0 > y1) return;

    // From the middle of the line to the centre of the first pixel.
    constexpr float unit = 1.0f / (2 * subpixels);
    const std::int64_t twice_x = std::int64_t{x0} * (2 * subpixels) + subpixels - a.x - b.x;
    const std::int64_t twice_y = std::int64_t{y0} * (2 * subpixels) + subpixels - a.y - b.y;
    const float px = static_cast<float>(twice_x) * unit, py = static_cast<float>(twice_y) * unit;
    const Capsule capsule{255 * (px * segment.ux + py * segment.uy),
                          255 * (py * segment.ux - px * segment.uy),
                          255 * segment.ux,
                          255 * segment.uy,
                          255 * 0.5f * segment.length,
                          255 * (radius_ + 0.5f) + 0.5f};
    const int columns = x1 - x0 + 1, rows = y1 - y0 + 1;
    if (!wide_ && (columns <= box_columns || rows <= box_rows)) {
        kernels_.block(mask_.pixels + y0 * mask_.stride + x0, mask_.stride, columns, rows, capsule);
        return;
    }
    draw_rows(segment, capsule, x0, y0, columns, rows);
}

void Stroker::draw_rows(const Segment& segment, const Capsule& capsule, int x0, int y0, int columns, int rows) {
    const float px = (capsule.u * segment.ux - capsule.v * segment.uy) * (1.0f / 255);
    const float py = (capsule.u * segment.uy + capsule.v * segment.ux) * (1.0f / 255);
    const float reach = radius_ + 0.5f + slack;
    const float full = radius_ - 0.5f - slack;
    const float half = 0.5f * segment.length;
    const bool limits_across = std::fabs(segment.uy) > flat, limits_along = std::fabs(segment.ux) > flat;
    const float per_uy = limits_across ? 1 / segment.uy : 0, per_ux = limits_along ? 1 / segment.ux : 0;
    const float first_along = -half - (wide_ ? segment.before : reach) - slack;
    const float last_along = half + (wide_ ? segment.after : reach) + slack;
    std::uint8_t* pixels = mask_.pixels + y0 * mask_.stride + x0;

    spans_.clear();
    // Whole vectors, so that every kernel touches the same pixels: those past the end belong to this capsule, too,
    // but the segment that answers for them may round its distance another way.
    const auto add = [&](int row, int from, int to) { spans_.push_back({row, from, from + ((to - from + 7) & ~7)}); };
    for (int row = 0; row < rows; ++row) {
        const float y = py + static_cast<float>(row);
        Interval outer{px, px + static_cast<float>(columns - 1)};
        if (limits_across) outer.meet((y * segment.ux - reach) * per_uy, (y * segment.ux + reach) * per_uy);
        if (limits_along) {
            outer.meet((first_along - y * segment.uy) * per_ux, (last_along - y * segment.uy) * per_ux);
        }
        if (outer.empty()) continue;
        const int first = std::max(static_cast<int>(outer.low - px), 0);
        const int end = std::min(static_cast<int>(outer.high - px) + 2, columns);
        if (end - first < least_interior || full <= 0) {
            add(row, first, end);
            continue;
        }
        // The part that is covered wholly is convex, and so an interval: of the bar between the ends, and of the
        // two discs.
        Interval inner{static_cast<float>(first) + px, static_cast<float>(end - 1) + px};
        const auto across = [&](float x) { return std::fabs(y * segment.ux - x * segment.uy); };
        const auto along = [&](float x) { return std::fabs(x * segment.ux + y * segment.uy); };
        if (limits_across) {
            inner.meet((y * segment.ux - full) * per_uy, (y * segment.ux + full) * per_uy);
        } else if (across(inner.low) > full || across(inner.high) > full) {
            inner = {1, 0};
        }
        if (limits_along) {
            inner.meet((-half - y * segment.uy) * per_ux, (half - y * segment.uy) * per_ux);
        } else if (along(inner.low) > half || along(inner.high) > half) {
            inner = {1, 0};
        }
        for (const float side : {-half, half}) {
            const float from_centre = y - side * segment.uy;
            const float square = full * full - from_centre * from_centre;
            if (square <= 0) continue;
            const float chord = std::sqrt(square);
            inner.join({side * segment.ux - chord, side * segment.ux + chord});
        }
        const int inner_first = std::max(static_cast<int>(std::ceil(inner.low - px + slack)), first);
        const int inner_end = std::min(static_cast<int>(std::floor(inner.high - px - slack)) + 1, end);
        if (inner.empty() || inner_end - inner_first < least_interior) {
            add(row, first, end);
            continue;
        }
        std::memset(pixels + row * mask_.stride + inner_first, 255,
                    static_cast<std::size_t>(inner_end - inner_first));
        if (first < inner_first) add(row, first, inner_first);
        if (inner_end < end) add(row, inner_end, end);
    }
    kernels_.spans(pixels, mask_.stride, spans_.data(), spans_.size(), capsule);
}

}  // namespace sikku
