#include "art/raster/stroke.h"

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

template <bool soft>
inline std::uint8_t coverage(const Capsule& c, float u_row, float v_row, int column) {
    const float x = static_cast<float>(column);
    const float u = u_row + x * c.ux;
    const float v = v_row - x * c.uy;
    const float along = std::max(std::fabs(u) - c.half, 0.0f);
    const float inside = c.radius - std::sqrt(along * along + v * v);
    float value = inside;
    if constexpr (soft) {
        value = inside * c.slope + 128.0f;
        const float bend = std::max(c.soft - std::fabs(std::fabs(inside) - c.middle), 0.0f);
        value = std::min(std::max(value, 0.5f), 255.5f) - std::copysign(bend * bend * c.parabola, inside);
    }
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(value), 0, 255));
}

template <bool soft>
inline void row_scalar(std::uint8_t* line, int first, int end, const Capsule& c, int row) {
    const float u_row = c.u + static_cast<float>(row) * c.uy;
    const float v_row = c.v + static_cast<float>(row) * c.ux;
    for (int column = first; column < end; ++column) {
        line[column] = std::max(line[column], coverage<soft>(c, u_row, v_row, column));
    }
}

// Both draw all rows by a function for one row.
template <auto row_of>
void block(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& c) {
    for (int row = 0; row < rows; ++row) row_of(pixels + row * stride, 0, columns, c, row);
}

template <auto row_of>
void spans_by(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count, const Capsule& c) {
    for (const Span* span = spans; span != spans + count; ++span) {
        row_of(pixels + span->row * stride, span->first, span->end, c, span->row);
    }
}

#ifdef SIKKU_X86

template <bool soft>
inline __m128i coverage_sse2(const Capsule& c, __m128 u_row, __m128 v_row, __m128 x) {
    const __m128 sign = _mm_set1_ps(-0.0f);
    const __m128 u = _mm_add_ps(u_row, _mm_mul_ps(x, _mm_set1_ps(c.ux)));
    const __m128 v = _mm_sub_ps(v_row, _mm_mul_ps(x, _mm_set1_ps(c.uy)));
    const __m128 along = _mm_max_ps(_mm_sub_ps(_mm_andnot_ps(sign, u), _mm_set1_ps(c.half)), _mm_setzero_ps());
    const __m128 distance = _mm_sqrt_ps(_mm_add_ps(_mm_mul_ps(along, along), _mm_mul_ps(v, v)));
    const __m128 inside = _mm_sub_ps(_mm_set1_ps(c.radius), distance);
    __m128 value = inside;
    if constexpr (soft) {
        value = _mm_add_ps(_mm_mul_ps(inside, _mm_set1_ps(c.slope)), _mm_set1_ps(128.0f));
        const __m128 off = _mm_andnot_ps(sign, _mm_sub_ps(_mm_andnot_ps(sign, inside), _mm_set1_ps(c.middle)));
        const __m128 bend = _mm_max_ps(_mm_sub_ps(_mm_set1_ps(c.soft), off), _mm_setzero_ps());
        const __m128 change = _mm_mul_ps(_mm_mul_ps(bend, bend), _mm_set1_ps(c.parabola));
        value = _mm_min_ps(_mm_max_ps(value, _mm_set1_ps(0.5f)), _mm_set1_ps(255.5f));
        value = _mm_sub_ps(value, _mm_or_ps(change, _mm_and_ps(inside, sign)));
    }
    const __m128i whole = _mm_cvttps_epi32(value);
    const __m128i words = _mm_packs_epi32(whole, whole);
    return _mm_packus_epi16(words, words);
}

// Writes four pixels at a time; those past the end are either outside this capsule or padding.
template <bool soft>
inline void row_sse2(std::uint8_t* line, int first, int end, const Capsule& c, int row) {
    const __m128 u = _mm_set1_ps(c.u + static_cast<float>(row) * c.uy);
    const __m128 v = _mm_set1_ps(c.v + static_cast<float>(row) * c.ux);
    for (int column = first; column < end; column += 4) {
        const __m128 x = _mm_add_ps(_mm_set1_ps(static_cast<float>(column)), _mm_setr_ps(0, 1, 2, 3));
        std::int32_t four;
        std::memcpy(&four, line + column, 4);
        four = _mm_cvtsi128_si32(_mm_max_epu8(_mm_cvtsi32_si128(four), coverage_sse2<soft>(c, u, v, x)));
        std::memcpy(line + column, &four, 4);
    }
}

#define SIKKU_AVX2 __attribute__((target("avx2")))

template <bool soft>
SIKKU_AVX2 inline __m128i coverage_avx2(const Capsule& c, __m256 u_row, __m256 v_row, __m256 x) {
    const __m256 sign = _mm256_set1_ps(-0.0f);
    const __m256 u = _mm256_add_ps(u_row, _mm256_mul_ps(x, _mm256_set1_ps(c.ux)));
    const __m256 v = _mm256_sub_ps(v_row, _mm256_mul_ps(x, _mm256_set1_ps(c.uy)));
    const __m256 along =
        _mm256_max_ps(_mm256_sub_ps(_mm256_andnot_ps(sign, u), _mm256_set1_ps(c.half)), _mm256_setzero_ps());
    const __m256 distance = _mm256_sqrt_ps(_mm256_add_ps(_mm256_mul_ps(along, along), _mm256_mul_ps(v, v)));
    const __m256 inside = _mm256_sub_ps(_mm256_set1_ps(c.radius), distance);
    __m256 value = inside;
    if constexpr (soft) {
        value = _mm256_add_ps(_mm256_mul_ps(inside, _mm256_set1_ps(c.slope)), _mm256_set1_ps(128.0f));
        const __m256 off =
            _mm256_andnot_ps(sign, _mm256_sub_ps(_mm256_andnot_ps(sign, inside), _mm256_set1_ps(c.middle)));
        const __m256 bend = _mm256_max_ps(_mm256_sub_ps(_mm256_set1_ps(c.soft), off), _mm256_setzero_ps());
        const __m256 change = _mm256_mul_ps(_mm256_mul_ps(bend, bend), _mm256_set1_ps(c.parabola));
        value = _mm256_min_ps(_mm256_max_ps(value, _mm256_set1_ps(0.5f)), _mm256_set1_ps(255.5f));
        value = _mm256_sub_ps(value, _mm256_or_ps(change, _mm256_and_ps(inside, sign)));
    }
    const __m256i whole = _mm256_cvttps_epi32(value);
    const __m128i words = _mm_packs_epi32(_mm256_castsi256_si128(whole), _mm256_extracti128_si256(whole, 1));
    return _mm_packus_epi16(words, words);
}

template <bool soft>
SIKKU_AVX2 inline void row_avx2(std::uint8_t* line, int first, int end, const Capsule& c, int row) {
    const __m256 u = _mm256_set1_ps(c.u + static_cast<float>(row) * c.uy);
    const __m256 v = _mm256_set1_ps(c.v + static_cast<float>(row) * c.ux);
    for (int column = first; column < end; column += 8) {
        const __m256 x =
            _mm256_add_ps(_mm256_set1_ps(static_cast<float>(column)), _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7));
        __m128i* eight = reinterpret_cast<__m128i*>(line + column);
        _mm_storel_epi64(eight, _mm_max_epu8(_mm_loadl_epi64(eight), coverage_avx2<soft>(c, u, v, x)));
    }
}

template <bool soft>
SIKKU_AVX2 void block_avx2(std::uint8_t* pixels, std::ptrdiff_t stride, int columns, int rows, const Capsule& c) {
    if (columns > 4) {
        for (int row = 0; row < rows; ++row) row_avx2<soft>(pixels + row * stride, 0, columns, c, row);
        return;
    }
    // Narrow, as for upright lines: two rows of four pixels fill a vector. An odd last row is paired with the one
    // below it, which is outside this capsule or padding.
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
        const __m128i both = _mm_max_epu8(old, coverage_avx2<soft>(c, u, v, x));
        upper = _mm_cvtsi128_si32(both);
        lower = _mm_extract_epi32(both, 1);
        std::memcpy(pixels, &upper, 4);
        std::memcpy(pixels + stride, &lower, 4);
    }
}

template <bool soft>
SIKKU_AVX2 void spans_avx2(std::uint8_t* pixels, std::ptrdiff_t stride, const Span* spans, std::size_t count,
                           const Capsule& c) {
    for (const Span* span = spans; span != spans + count; ++span) {
        row_avx2<soft>(pixels + span->row * stride, span->first, span->end, c, span->row);
    }
}

#endif

template <bool soft>
Stroker::Kernels kernels(Simd simd) {
#ifdef SIKKU_X86
    if (simd == Simd::avx2) return {block_avx2<soft>, spans_avx2<soft>};
    if (simd == Simd::sse2) return {block<row_sse2<soft>>, spans_by<row_sse2<soft>>};
#endif
    static_cast<void>(simd);
    return {block<row_scalar<soft>>, spans_by<row_scalar<soft>>};
}

// Narrower pens are drawn by their bounding box, wider ones row by row.
constexpr float wide_radius = 2.5f;
constexpr int box_columns = 24;
constexpr int box_rows = 6;
// Shorter runs of covered pixels are computed like the others instead of being set.
constexpr int least_interior = 24;
// Tolerance in pixels on either side, as the geometry is rounded.
constexpr float slack = 0.02f;
// A line that deviates less from an axis does not limit the columns.
constexpr float flat = 1e-3f;
// A line that deviates less from an axis is drawn without soft ends: they would amount to less than 1 of 255.
constexpr float upright = 4e-3f;

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
    : mask_(mask), top_(top * subpixels), hard_(kernels<false>(simd)), soft_(kernels<true>(simd)) {}

void Stroker::pen(float radius) {
    flush(true);
    radius_ = radius;
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
        segment.long_side = std::max(std::fabs(segment.ux), std::fabs(segment.uy));
        segment.short_side = std::min(std::fabs(segment.ux), std::fabs(segment.uy));
    } else {
        // A dot's edge has every direction; half way between the extremes is sufficiently exact.
        segment.long_side = 0.924f;
        segment.short_side = 0.383f;
    }
    if (segment.short_side < upright) {
        segment.long_side = 1;
        segment.short_side = 0;
    }
    segment.ramp = 0.5f * (segment.long_side + segment.short_side);
    if (!wide_) {
        draw(segment);
        return;
    }
    // The maximum over the line does not change if each pixel is drawn by one of its nearest segments: pixels before
    // the start of a segment by the one before, except the wedge outside the bend, and pixels after its end by the
    // next.
    segment.before = segment.after = radius_ + segment.ramp;
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
    // Rounding down loses less than half of 1 of 255.
    const std::int32_t reach = static_cast<std::int32_t>((radius_ + segment.ramp) * subpixels);
    // Pixels whose centres lie nearer than reach to the line's box.
    constexpr std::int32_t half_pixel = subpixels / 2;
    const int x0 = std::max((std::min(a.x, b.x) - reach + half_pixel) >> subpixel_bits, 0);
    const int y0 = std::max((std::min(a.y, b.y) - reach + half_pixel) >> subpixel_bits, 0);
    const int x1 = std::min((std::max(a.x, b.x) + reach - half_pixel - 1) >> subpixel_bits, mask_.width - 1);
    const int y1 = std::min((std::max(a.y, b.y) + reach - half_pixel - 1) >> subpixel_bits, mask_.rows - 1);
    if (x0 > x1 || y0 > y1) return;

    // From the middle of the line to the centre of the first pixel.
    constexpr float unit = 1.0f / (2 * subpixels);
    const std::int64_t twice_x = std::int64_t{x0} * (2 * subpixels) + subpixels - a.x - b.x;
    const std::int64_t twice_y = std::int64_t{y0} * (2 * subpixels) + subpixels - a.y - b.y;
    const float px = static_cast<float>(twice_x) * unit, py = static_cast<float>(twice_y) * unit;
    Capsule capsule;
    capsule.u = 255 * (px * segment.ux + py * segment.uy);
    capsule.v = 255 * (py * segment.ux - px * segment.uy);
    capsule.ux = 255 * segment.ux;
    capsule.uy = 255 * segment.uy;
    capsule.half = 255 * 0.5f * segment.length;
    // A disc's edge bends away from the straight one for which coverage is computed: this gives it the right area.
    capsule.radius = 255 * (segment.length > 0 ? radius_ : std::sqrt(radius_ * radius_ - 1.0f / 12));
    const bool soft = segment.short_side > 0;
    if (soft) {
        capsule.slope = 1 / segment.long_side;
        capsule.middle = 255 * 0.5f * segment.long_side;
        capsule.soft = 255 * 0.5f * segment.short_side;
        capsule.parabola = capsule.slope / (2 * 255 * segment.short_side);
    } else {
        capsule.radius += 128;
        capsule.slope = capsule.middle = capsule.soft = capsule.parabola = 0;
    }
    const Kernels& kernels = soft ? soft_ : hard_;
    const int columns = x1 - x0 + 1, rows = y1 - y0 + 1;
    if (!wide_ && (columns <= box_columns || rows <= box_rows)) {
        kernels.block(mask_.pixels + y0 * mask_.stride + x0, mask_.stride, columns, rows, capsule);
        return;
    }
    draw_rows(segment, capsule, x0, y0, columns, rows);
}

void Stroker::draw_rows(const Segment& segment, const Capsule& capsule, int x0, int y0, int columns, int rows) {
    const float px = (capsule.u * segment.ux - capsule.v * segment.uy) * (1.0f / 255);
    const float py = (capsule.u * segment.uy + capsule.v * segment.ux) * (1.0f / 255);
    const float reach = radius_ + segment.ramp + slack;
    const float full = radius_ - segment.ramp - slack;
    const float half = 0.5f * segment.length;
    const bool limits_across = std::fabs(segment.uy) > flat, limits_along = std::fabs(segment.ux) > flat;
    const float per_uy = limits_across ? 1 / segment.uy : 0, per_ux = limits_along ? 1 / segment.ux : 0;
    const float first_along = -half - (wide_ ? segment.before : reach) - slack;
    const float last_along = half + (wide_ ? segment.after : reach) + slack;
    std::uint8_t* pixels = mask_.pixels + y0 * mask_.stride + x0;

    spans_.clear();
    // Whole vectors, so that every kernel touches the same pixels: those past the end belong to this capsule, too,
    // but the segment that draws them may round its distance another way.
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
        // The fully covered part is convex, and therefore an interval: of the bar between the ends, and of the two
        // discs.
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
    (segment.short_side > 0 ? soft_ : hard_).spans(pixels, mask_.stride, spans_.data(), spans_.size(), capsule);
}

}  // namespace sikku
