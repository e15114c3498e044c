#include "art/space/depth_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#define SIKKU_AVX2 __attribute__((target("avx2")))
#endif

namespace sikku {
namespace {

/// A place of a map.
struct MapPlace {
    float x, y;    ///< squares from the middle of the first one, within the map
    float height;  ///< not above `highest`, so that it fits into an integer
};

/// The nearest value from 0 to `most`; 0 if it is not a number.
float within(float value, float most) {
    return value > 0 ? std::min(value, most) : 0.0F;
}

MapPlace place_in(const DepthMap& map, const glm::vec3& point) {
    const glm::vec3 at = map.seen(point);
    // What lies outside is as open as the rim; points below the scene are below its lowest height.
    return {within(at.x - 0.5F, static_cast<float>(map.width) - 1.5F),
            within(at.y - 0.5F, static_cast<float>(map.rows) - 1.5F), within(at.z + map.bias, DepthMap::highest)};
}

void shine_scalar(const DepthMap& map, float weight, LitPlaces& places) {
    const auto column = [&](LitPlaces::Column which) { return places.column(which); };
    const float *const x = column(LitPlaces::x), *const y = column(LitPlaces::y), *const z = column(LitPlaces::z);
    const float* const normal_x = column(LitPlaces::normal_x);
    const float* const normal_y = column(LitPlaces::normal_y);
    const float* const normal_z = column(LitPlaces::normal_z);
    const float* const is_thin = column(LitPlaces::is_thin);
    float *const front = column(LitPlaces::front), *const behind = column(LitPlaces::behind);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::vec3 normal(normal_x[i], normal_y[i], normal_z[i]);
        const float cosine = glm::dot(normal, map.towards);
        if (!(cosine > 0) && is_thin[i] == 0) continue;
        const float nudge = cosine < 0 ? -map.nudge : map.nudge;
        const float reached = map.reaches(glm::vec3(x[i], y[i], z[i]) + normal * nudge);
        (cosine < 0 ? behind : front)[i] += weight * std::fabs(cosine) * reached;
    }
}

#ifdef SIKKU_AVX2

/// Three numbers of each of eight places.
struct Eight {
    __m256 x, y, z;
};

SIKKU_AVX2 inline __m256 dot(const Eight& a, const glm::vec3& b) {
    return _mm256_add_ps(
        _mm256_add_ps(_mm256_mul_ps(a.x, _mm256_set1_ps(b.x)), _mm256_mul_ps(a.y, _mm256_set1_ps(b.y))),
        _mm256_mul_ps(a.z, _mm256_set1_ps(b.z)));
}

SIKKU_AVX2 inline __m256 clamped(__m256 value, float most) {
    return _mm256_min_ps(_mm256_max_ps(value, _mm256_setzero_ps()), _mm256_set1_ps(most));
}

/// Two neighbours in a row, from squares below `height` and their weights.
SIKKU_AVX2 inline __m256 passes(const std::uint16_t* row, __m256i square, __m256i height, __m256 left, __m256 right) {
    // Both squares at once, the left one in the lower half.
    const __m256i pair = _mm256_i32gather_epi32(reinterpret_cast<const int*>(row), square, 2);
    const __m256i left_dark = _mm256_cmpgt_epi32(_mm256_and_si256(pair, _mm256_set1_epi32(0xffff)), height);
    const __m256i right_dark = _mm256_cmpgt_epi32(_mm256_srli_epi32(pair, 16), height);
    return _mm256_add_ps(_mm256_andnot_ps(_mm256_castsi256_ps(left_dark), left),
                         _mm256_andnot_ps(_mm256_castsi256_ps(right_dark), right));
}

/// A coordinate in the map.
SIKKU_AVX2 inline __m256 seen(const Eight& point, const glm::vec3& axis, float offset) {
    return _mm256_add_ps(_mm256_set1_ps(offset), dot(point, axis));
}

SIKKU_AVX2 inline __m256 reaches(const DepthMap& map, const Eight& point) {
    const __m256 half = _mm256_set1_ps(0.5F), one = _mm256_set1_ps(1.0F);
    const float width = static_cast<float>(map.width), rows = static_cast<float>(map.rows);
    const __m256 x = clamped(_mm256_sub_ps(seen(point, map.across, map.offset.x), half), width - 1.5F);
    const __m256 y = clamped(_mm256_sub_ps(seen(point, map.along, map.offset.y), half), rows - 1.5F);
    const __m256 height =
        clamped(_mm256_add_ps(seen(point, map.depth, map.offset.z), _mm256_set1_ps(map.bias)), DepthMap::highest);
    const __m256 column = _mm256_floor_ps(x), line = _mm256_floor_ps(y);
    const __m256 right = _mm256_sub_ps(x, column), lower = _mm256_sub_ps(y, line);
    const __m256 left = _mm256_sub_ps(one, right);
    // Exact, as maps have fewer than 2^24 squares.
    const __m256i square = _mm256_cvttps_epi32(_mm256_add_ps(_mm256_mul_ps(line, _mm256_set1_ps(width)), column));
    const __m256i whole = _mm256_cvttps_epi32(height);
    const __m256 above = passes(map.heights.data(), square, whole, left, right);
    const __m256 below = passes(map.heights.data() + map.width, square, whole, left, right);
    return _mm256_add_ps(_mm256_mul_ps(above, _mm256_sub_ps(one, lower)), _mm256_mul_ps(below, lower));
}

SIKKU_AVX2 void shine_avx2(const DepthMap& map, float weight, LitPlaces& places) {
    const auto at = [&](LitPlaces::Column which, std::size_t i) { return places.column(which) + i; };
    const __m256 sign = _mm256_set1_ps(-0.0F), zero = _mm256_setzero_ps();
    for (std::size_t i = 0; i < places.size(); i += LitPlaces::together) {
        const Eight normal{_mm256_loadu_ps(at(LitPlaces::normal_x, i)), _mm256_loadu_ps(at(LitPlaces::normal_y, i)),
                           _mm256_loadu_ps(at(LitPlaces::normal_z, i))};
        const __m256 cosine = dot(normal, map.towards);
        const __m256 is_thin = _mm256_cmp_ps(_mm256_loadu_ps(at(LitPlaces::is_thin, i)), zero, _CMP_NEQ_OQ);
        const __m256 is_lit = _mm256_or_ps(_mm256_cmp_ps(cosine, zero, _CMP_GT_OQ), is_thin);
        if (_mm256_movemask_ps(is_lit) == 0) continue;
        const __m256 is_behind = _mm256_cmp_ps(cosine, zero, _CMP_LT_OQ);
        const __m256 nudge = _mm256_xor_ps(_mm256_set1_ps(map.nudge), _mm256_and_ps(is_behind, sign));
        const Eight point{_mm256_add_ps(_mm256_loadu_ps(at(LitPlaces::x, i)), _mm256_mul_ps(normal.x, nudge)),
                          _mm256_add_ps(_mm256_loadu_ps(at(LitPlaces::y, i)), _mm256_mul_ps(normal.y, nudge)),
                          _mm256_add_ps(_mm256_loadu_ps(at(LitPlaces::z, i)), _mm256_mul_ps(normal.z, nudge))};
        const __m256 share = _mm256_mul_ps(_mm256_set1_ps(weight), _mm256_andnot_ps(sign, cosine));
        const __m256 light = _mm256_and_ps(_mm256_mul_ps(share, reaches(map, point)), is_lit);
        float *const front = at(LitPlaces::front, i), *const behind = at(LitPlaces::behind, i);
        _mm256_storeu_ps(front, _mm256_add_ps(_mm256_loadu_ps(front), _mm256_andnot_ps(is_behind, light)));
        _mm256_storeu_ps(behind, _mm256_add_ps(_mm256_loadu_ps(behind), _mm256_and_ps(is_behind, light)));
    }
}

#endif

}  // namespace

std::pair<glm::vec3, glm::vec3> axes_across(const glm::vec3& towards) {
    const glm::vec3 reference = std::fabs(towards.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 across = glm::normalize(glm::cross(reference, towards));
    return {across, glm::cross(towards, across)};
}

DepthMap::DepthMap(const glm::vec3& light, const glm::vec3& low, const glm::vec3& high, int side) : towards(light) {
    const auto [right, up] = axes_across(towards);
    glm::vec3 least(1e30F), most(-1e30F);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
        const glm::vec3 place(glm::dot(corner, right), glm::dot(corner, up), glm::dot(corner, towards));
        least = glm::min(least, place);
        most = glm::max(most, place);
    }
    const glm::vec3 size = glm::max(most - least, glm::vec3(1e-20F));
    constexpr float rim = 2;
    scale = (static_cast<float>(side) - 2 * rim) / std::max(size.x, size.y);
    const float deep = (highest - 2) / size.z;
    across = right * scale;
    along = up * scale;
    depth = towards * deep;
    offset = {rim - least.x * scale, rim - least.y * scale, 1 - least.z * deep};
    bias = deep / scale;
    nudge = 1.5F / scale;
    width = static_cast<int>(size.x * scale + 2 * rim) + 1;
    rows = static_cast<int>(size.y * scale + 2 * rim) + 1;
}

glm::vec3 DepthMap::seen(const glm::vec3& point) const {
    return offset + glm::vec3(glm::dot(point, across), glm::dot(point, along), glm::dot(point, depth));
}

float DepthMap::reaches(const glm::vec3& point) const {
    const auto [x, y, height] = place_in(*this, point);
    const int column = static_cast<int>(x), line = static_cast<int>(y);
    const float right = x - static_cast<float>(column), lower = y - static_cast<float>(line);
    const std::uint16_t* const row = heights.data() + std::size_t(line) * std::size_t(width) + std::size_t(column);
    const auto passes = [&, height = height](std::uint16_t stored, float share) {
        return static_cast<float>(stored) <= height ? share : 0.0F;
    };
    const float above = passes(row[0], 1 - right) + passes(row[1], right);
    const float below = passes(row[width], 1 - right) + passes(row[width + 1], right);
    return above * (1 - lower) + below * lower;
}

void DepthMap::shine(float weight, LitPlaces& places, Simd simd) const {
#ifdef SIKKU_AVX2
    if (simd == Simd::avx2) return shine_avx2(*this, weight, places);
#endif
    static_cast<void>(simd);
    shine_scalar(*this, weight, places);
}

}  // namespace sikku
