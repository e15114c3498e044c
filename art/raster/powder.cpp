#include "art/raster/powder.h"

#include "engine/base/chance.h"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

constexpr float line_peak = 165;  // height of a line in its middle
constexpr int edge_height = static_cast<int>(165 * (1 - 1 / powder_reach));
constexpr int texels_of_grain = 4;
constexpr double grains_of_clump = 4.7;
// Heights by which grains and clumps rise or fall; together rarely more than that of the edge.
constexpr int grain_relief = 24, clump_relief = 26;
constexpr int opaque_edge = 205;  // opacity at the edge
constexpr double most_contrast = 15;
constexpr int full_bits = 9;
constexpr int levels = 5;

}  // namespace

/// Grains on a surface, seen from above, as heights with a mean of about 128; at several sizes, each half of the one
/// before. The texture repeats.
struct PowderGrain::Texture {
    std::array<std::vector<std::uint8_t>, levels> level;

    Texture() {
        constexpr int side = 1 << full_bits;
        std::vector<float> heights(std::size_t{side} * side, 0.0f);
        constexpr int grains = side / texels_of_grain;
        for (int number = 0; number < grains * grains * 3 / 2; ++number) {
            const auto chance = [&](std::uint64_t channel) {
                return static_cast<float>(scrambled(4 * static_cast<std::uint64_t>(number) + channel + 77) >> 40) *
                       0x1p-24f;
            };
            const float x = chance(0) * side, y = chance(1) * side;
            const float size = chance(2);
            const float radius = texels_of_grain * (0.35f + 0.75f * size * size);
            const float peak = 0.35f + 0.65f * chance(3);
            const int reach = static_cast<int>(std::ceil(radius));
            for (int row = -reach; row <= reach; ++row) {
                for (int column = -reach; column <= reach; ++column) {
                    const int at_x = static_cast<int>(x) + column, at_y = static_cast<int>(y) + row;
                    const float dx = static_cast<float>(at_x) + 0.5f - x, dy = static_cast<float>(at_y) + 0.5f - y;
                    const float inside = 1 - (dx * dx + dy * dy) / (radius * radius);
                    if (inside <= 0) continue;
                    float& height = heights[static_cast<std::size_t>(at_y & (side - 1)) * side +
                                            static_cast<std::size_t>(at_x & (side - 1))];
                    height = std::max(height, peak * std::min(1.0f, 1.6f * inside));
                }
            }
        }
        // Ranks, so that all heights are equally frequent.
        std::vector<std::uint32_t> order(heights.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return heights[a] < heights[b]; });
        level[0].resize(heights.size());
        for (std::size_t rank = 0; rank < order.size(); ++rank) {
            level[0][order[rank]] = static_cast<std::uint8_t>(rank * 256 / order.size());
        }
        for (std::size_t k = 1; k < levels; ++k) {
            const int half = side >> k;
            const std::vector<std::uint8_t>& finer = level[k - 1];
            level[k].resize(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
            for (int y = 0; y < half; ++y) {
                for (int x = 0; x < half; ++x) {
                    const std::size_t at = static_cast<std::size_t>(4 * y * half + 2 * x);
                    const int sum = finer[at] + finer[at + 1] + finer[at + 2 * static_cast<std::size_t>(half)] +
                                    finer[at + 2 * static_cast<std::size_t>(half) + 1];
                    level[k][static_cast<std::size_t>(y * half + x)] = static_cast<std::uint8_t>((sum + 2) / 4);
                }
            }
        }
    }
};

const PowderGrain::Texture& PowderGrain::texture() {
    static const Texture made;
    return made;
}

/// @param grain  size of a grain in the unit of the drawing
PowderGrain::Layer PowderGrain::layer(const glm::dmat3x2& to_pixels, double grain) {
    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(to_pixels[0], to_pixels[1]));
    double texel = grain / texels_of_grain;
    const double pixel = glm::length(back[0]);
    std::size_t level = 0;
    while (level + 1 < levels && pixel > 1.4 * texel) {
        texel *= 2;
        ++level;
    }
    const auto fixed = [&](double value) {
        return static_cast<std::int64_t>(std::llround(std::clamp(value / texel, -1e12, 1e12) * 65536));
    };
    const glm::dvec2 origin = back * (glm::dvec2(0.5) - to_pixels[2]);
    return {texture().level[level].data(),
            full_bits - static_cast<int>(level),
            fixed(origin.x),
            fixed(origin.y),
            fixed(back[0].x),
            fixed(back[0].y),
            fixed(back[1].x),
            fixed(back[1].y)};
}

PowderGrain::PowderGrain(const glm::dmat3x2& to_pixels, double grain)
    : grains_(layer(to_pixels, grain)), clumps_(layer(to_pixels, grains_of_clump * grain)) {
    // Edges are not sharper than pixels: a line is about 14 grains wide.
    const double radius = 7 * grain * glm::length(to_pixels[0]);
    contrast_ = static_cast<int>(std::clamp(255 * powder_reach * radius / 165, 1.0, most_contrast) * 16);
}

/// Height of the grains at a place in 1/65536 texels, from -128 to 127.
inline int PowderGrain::Layer::at(std::int64_t x, std::int64_t y) const {
    const std::uint32_t mask = (1u << bits) - 1;
    const std::uint32_t x0 = static_cast<std::uint32_t>(x >> 16) & mask, x1 = (x0 + 1) & mask;
    const std::uint32_t y0 = (static_cast<std::uint32_t>(y >> 16) & mask) << bits;
    const std::uint32_t y1 = (y0 + mask + 1) & ((mask + 1) * (mask + 1) - 1);
    const int across = static_cast<int>(x >> 8) & 255, down = static_cast<int>(y >> 8) & 255;
    const int upper = (256 - across) * texels[y0 + x0] + across * texels[y0 + x1];
    const int lower = (256 - across) * texels[y1 + x0] + across * texels[y1 + x1];
    return (((256 - down) * upper + down * lower) >> 16) - 128;
}

namespace {

/// Fewer levels compress better, and nobody sees the difference.
std::uint8_t in_steps(int paint) {
    return static_cast<std::uint8_t>(paint >= 248 ? 255 : (paint + 4) & ~7);
}

}  // namespace

void PowderGrain::settle(std::uint8_t* heights, int row, int first, int end) const {
    const Layer &g = grains_, &c = clumps_;
    const std::int64_t gx = g.origin_x + g.row_x * row, gy = g.origin_y + g.row_y * row;
    const std::int64_t cx = c.origin_x + c.row_x * row, cy = c.origin_y + c.row_y * row;
    for (int column = first; column < end; ++column) {
        const int height = heights[column];
        if (height == 0) continue;
        const int grain = g.at(gx + g.column_x * column, gy + g.column_y * column);
        const int clump = c.at(cx + c.column_x * column, cy + c.column_y * column);
        // There is powder where the height with its grains is above that of the edge.
        const int above = height - edge_height + (grain * grain_relief + clump * clump_relief) / 128;
        const int cover = std::clamp(128 + above * contrast_ / 16, 0, 255);
        // It is opaque where it is high; near its edges, the ground shows between the grains.
        const int dense = std::clamp(opaque_edge + above + grain / 4, 96, 248 + (grain + clump) / 12);
        heights[column] = in_steps(cover * dense / 255);
    }
}

void PowderGrain::strew(std::uint8_t* coverage, int row, int first, int end) const {
    const Layer &g = grains_, &c = clumps_;
    const std::int64_t gx = g.origin_x + g.row_x * row, gy = g.origin_y + g.row_y * row;
    const std::int64_t cx = c.origin_x + c.row_x * row, cy = c.origin_y + c.row_y * row;
    for (int column = first; column < end; ++column) {
        const int grain = g.at(gx + g.column_x * column, gy + g.column_y * column);
        const int clump = c.at(cx + c.column_x * column, cy + c.column_y * column);
        const int dense = std::clamp(226 + grain * 5 / 8 + clump / 3, 0, 255);
        coverage[column] = in_steps(coverage[column] * dense / 255);
    }
}

namespace {

/// Adds the height of a segment to the mask, and its columns to those that are touched in each row.
void pile(const PowderSegment& s, Mask& mask, int top, std::vector<std::pair<int, int>>& touched) {
    const float ay = s.ay - static_cast<float>(top), by = s.by - static_cast<float>(top);
    const float dx = s.bx - s.ax, dy = by - ay;
    const float length = std::sqrt(dx * dx + dy * dy);
    const float ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
    const float half = length / 2;
    const float mx = (s.ax + s.bx) / 2, my = (ay + by) / 2;
    constexpr float reach_share = static_cast<float>(powder_reach);
    const float reach = reach_share * std::max(s.a_radius, s.b_radius);
    const float before = half + std::min(s.before, reach), after = half + std::min(s.after, reach);
    const float a_peak = line_peak * s.a_height, b_peak = line_peak * s.b_height;
    const float a_fall = a_peak / (reach_share * s.a_radius), b_fall = b_peak / (reach_share * s.b_radius);
    const float fall = (a_fall + b_fall) / 2, more_fall = length > 0 ? (b_fall - a_fall) / length : 0;
    const float peak = (a_peak + b_peak) / 2, more_peak = length > 0 ? (b_peak - a_peak) / length : 0;
    const int y0 = std::max(static_cast<int>(std::floor(std::min(ay, by) - reach)), 0);
    const int y1 = std::min(static_cast<int>(std::ceil(std::max(ay, by) + reach)), mask.rows);
    for (int row = y0; row < y1; ++row) {
        const float y = static_cast<float>(row) + 0.5f - my;
        // Columns, from the middle, that lie within the reach across the line and beside it.
        float low = std::min(s.ax, s.bx) - mx - reach, high = std::max(s.ax, s.bx) - mx + reach;
        const auto meet = [&](float a, float b) {
            low = std::max(low, std::min(a, b));
            high = std::min(high, std::max(a, b));
        };
        constexpr float flat = 1e-3f;
        if (std::fabs(uy) > flat) meet((y * ux - reach) / uy, (y * ux + reach) / uy);
        if (std::fabs(ux) > flat) meet((-before - y * uy) / ux, (after - y * uy) / ux);
        if (!(low <= high)) continue;
        const int first = std::max(static_cast<int>(std::floor(mx + low)), 0);
        const int end = std::min(static_cast<int>(std::ceil(mx + high)) + 1, mask.width);
        if (first >= end) continue;
        auto& [touched_first, touched_end] = touched[static_cast<std::size_t>(row)];
        touched_first = std::min(touched_first, first);
        touched_end = std::max(touched_end, end);
        std::uint8_t* line = mask.pixels + row * mask.stride;
        const float u_row = y * uy, v_row = y * ux;
        for (int column = first; column < end; ++column) {
            const float x = static_cast<float>(column) + 0.5f - mx;
            const float u = u_row + x * ux, v = v_row - x * uy;
            const float along = std::min(std::max(u, -half), half);
            const float off = u - along;
            const float distance = std::sqrt(off * off + v * v);
            const float height = peak + more_peak * along - distance * (fall + more_fall * along);
            const int level = static_cast<int>(std::min(std::max(height, 0.0f), 255.0f));
            line[column] = static_cast<std::uint8_t>(std::max(static_cast<int>(line[column]), level));
        }
    }
}

}  // namespace

void lay_powder(const std::vector<PowderSegment>& segments, const PowderGrain& grain, Mask& mask, int top,
                const std::function<void()>& watch) {
    std::vector<std::pair<int, int>> touched(static_cast<std::size_t>(mask.rows), {mask.width, 0});
    std::size_t count = 0;
    for (const PowderSegment& segment : segments) {
        pile(segment, mask, top, touched);
        if (watch && ++count % 4096 == 0) watch();
    }
    for (int row = 0; row < mask.rows; ++row) {
        const auto [first, end] = touched[static_cast<std::size_t>(row)];
        if (first < end) grain.settle(mask.pixels + row * mask.stride, top + row, first, end);
    }
}

}  // namespace sikku
