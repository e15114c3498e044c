// art/print/border_petals.cpp: borders of lotus petals, marigolds and lamps. Lengths are in millimetres; `d` is the
// border's depth.
#include "art/print/border_ink.h"
#include "engine/geometry/bezier.h"

#include <glm/geometric.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

using namespace border;

namespace {

/// A petal that stands on a base: its outline from the left foot over the tip to the right foot.
struct Petal {
    std::array<Bezier, 2> sides;
};
/// @param foot  the middle of its base @param up  from there to its tip @param across  half its width, to the right
/// @param base  width of the base, as part of the widest
Petal petal(glm::dvec2 foot, glm::dvec2 up, glm::dvec2 across, double base) {
    const auto at = [&](double x, double y) { return foot + x * across + y * up; };
    return {{{{at(-base, 0), at(-1.25, 0.42), at(-0.62, 0.72), at(0, 1)},
              {at(0, 1), at(0.62, 0.72), at(1.25, 0.42), at(base, 0)}}}};
}

void draw_petal(const Petal& drawn, double width, int colour, BorderInk& ink) {
    ink.begin(drawn.sides[0][0], width, colour);
    for (const Bezier& side : drawn.sides) ink.curve(side[1], side[2], side[3]);
    ink.end(false);
}

void fill_petal(const Petal& filled, int colour, BorderInk& ink) {
    const auto& [left, right] = filled.sides;
    const std::array outline = {left[0], left[1], left[2], left[3], right[1], right[2], right[3]};
    ink.area(outline, colour);
}

/// The visible part of a petal behind two others: from the side of the one to its tip, and down to the other's.
void draw_back_petal(const Petal& left, const Petal& right, glm::dvec2 tip, double width, BorderInk& ink) {
    const glm::dvec2 from = part_of(left.sides[1], 0.42, 0.42)[0], to = part_of(right.sides[0], 0.58, 0.58)[0];
    const glm::dvec2 between = (from + to) / 2.0;
    ink.begin(from, width, flour);
    ink.curve(from + 0.5 * (tip - between), tip + 0.3 * (from - tip), tip);
    ink.curve(tip + 0.3 * (to - tip), to + 0.5 * (tip - between), to);
    ink.end(false);
}

}  // namespace

/// Petals that open outwards from a double line, with others behind them, and one across each corner.
void draw_lotus(std::span<const BorderSide, 4> sides, double d, BorderInk& ink) {
    const double line = 0.045 * d;
    const double base = 0.84 * d, high = 0.66 * d;
    const BorderRepeats repeats = repeats_of(sides, base, 0.52 * d);
    draw_rectangle(sides, base, line, flour, ink);
    draw_rectangle(sides, d - line / 2, line, flour, ink);
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const BorderSide& turn = next(sides, i);
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * base) / count;
        const double after = (turn.length - 2 * base) / count_of(repeats, i + 1);
        const auto standing = [&](const BorderSide& on, double u, double pitch, double size) {
            return petal(on.at({u, base}), -size * high * on.inwards, 0.44 * size * pitch * on.along, 0.62);
        };
        const glm::dvec2 corner = turn.at({base, base});
        const glm::dvec2 diagonal = turn.at({0, 0}) - corner;
        const auto corner_petal = [&](double size) {
            const glm::dvec2 up = glm::normalize(diagonal) * high * 1.38;
            return petal(corner + (1 - size) * 0.3 * up, size * up,
                         size * 0.5 * p * glm::normalize(side.along + turn.along), 0.0);
        };
        std::vector<Petal> row;
        for (int k = 0; k < count; ++k) {
            const double u = base + (k + 0.5) * p;
            row.push_back(standing(side, u, p, 1));
            fill_petal(standing(side, u, p, 0.62), earth, ink);
        }
        row.push_back(corner_petal(1));
        fill_petal(corner_petal(0.62), earth, ink);
        for (const Petal& each : row) draw_petal(each, line, flour, ink);
        row.push_back(standing(turn, base + 0.5 * after, after, 1));
        for (std::size_t k = 0; k + 1 < row.size(); ++k) {
            const bool is_last = k + 2 == row.size();
            const glm::dvec2 foot = is_last ? corner : side.at({base + static_cast<double>(k + 1) * p, base});
            const glm::dvec2 up = is_last ? -high * turn.inwards : -high * side.inwards;
            // Beside the petal of the corner, halfway between its direction and that of the row.
            const bool is_corner = k + 3 >= row.size();
            const glm::dvec2 lean = is_corner ? high * glm::normalize(up / high + glm::normalize(diagonal)) : up;
            draw_back_petal(row[k], row[k + 1], foot + (is_corner ? 0.92 : 0.78) * lean, line, ink);
            ink.disc(foot + (is_corner ? 1.14 : 1.0) * lean, 0.035 * d, flour);
        }
    }
}

namespace {

/// A flower of eight petals around a disc, with dots between their tips.
void draw_flower(const BorderSide& side, glm::dvec2 centre, double radius, BorderInk& ink) {
    constexpr double half = 0.7071067811865476;                           // cosine of an eighth of a turn
    constexpr glm::dvec2 tilted(0.9238795325112867, 0.3826834323650898);  // of a sixteenth
    glm::dvec2 out = side.along, across = side.inwards;
    for (int petals = 0; petals < 8; ++petals) {
        const glm::dvec2 foot = centre + 0.36 * radius * out;
        fill_petal(petal(foot, 0.64 * radius * out, 0.25 * radius * across, 0.3), earth, ink);
        ink.disc(centre + 0.93 * radius * (tilted.x * out + tilted.y * across), 0.07 * radius, flour);
        const glm::dvec2 turned = half * (out + across);
        across = half * (across - out);
        out = turned;
    }
    ink.disc(centre, 0.26 * radius, flour);
}

/// An oil lamp with its flame. @param up, across  unit vectors
void draw_lamp(glm::dvec2 foot, glm::dvec2 up, glm::dvec2 across, double d, BorderInk& ink) {
    const auto at = [&](double x, double y) { return foot + d * (x * across + y * up); };
    constexpr double wide = 0.27, rim = 0.3, base = 0.09, low = 0.03;
    const std::array bowl = {at(-wide, rim), at(-wide, rim - 0.16),   at(-base - 0.08, low),
                             at(-base, low), at(-base / 3, low),      at(base / 3, low),
                             at(base, low),  at(base + 0.08, low),    at(wide, rim - 0.16),
                             at(wide, rim),  at(wide / 2, rim - 0.1), at(-wide / 2, rim - 0.1),
                             at(-wide, rim)};
    ink.area(bowl, earth);
    fill_petal(petal(at(0, rim), 0.36 * d * up, 0.085 * d * across, 0.0), flour, ink);
    for (const glm::dvec2 spark : {at(-0.17, 0.6), at(0, 0.76), at(0.17, 0.6)}) ink.disc(spark, 0.03 * d, flour);
}

}  // namespace

/// A garland between two lines: marigolds, with a pair of leaves between each and the next.
void draw_marigolds(std::span<const BorderSide, 4> sides, double d, BorderInk& ink) {
    const double line = 0.05 * d, middle = 0.5 * d, radius = 0.37 * d;
    const double corner = middle;
    const BorderRepeats repeats = repeats_of(sides, corner, 1.02 * d);
    draw_rectangle(sides, line / 2, line, flour, ink);
    draw_rectangle(sides, d - line / 2, line, flour, ink);
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * corner) / count;
        for (int k = 0; k < count; ++k) {
            draw_flower(side, side.at({corner + k * p, middle}), radius, ink);
            const glm::dvec2 between = side.at({corner + (k + 0.5) * p, middle});
            for (const double way : {-1.0, 1.0}) {
                const glm::dvec2 up = way * 0.32 * d * side.inwards;
                fill_petal(petal(between + 0.22 * up, up, 0.075 * d * side.along, 0.0), flour, ink);
            }
            ink.disc(between, 0.035 * d, earth);
        }
    }
}

/// Oil lamps in a row on a double line, one across each corner.
void draw_lamps(std::span<const BorderSide, 4> sides, double d, BorderInk& ink) {
    const double line = 0.045 * d, base = 0.87 * d;
    const BorderRepeats repeats = repeats_of(sides, base, 0.8 * d);
    draw_rectangle(sides, base, line, flour, ink);
    draw_rectangle(sides, d - line / 2, line, flour, ink);
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * base) / count;
        for (int k = 0; k < count; ++k) {
            draw_lamp(side.at({base + (k + 0.5) * p, base}), -side.inwards, side.along, d, ink);
            if (k > 0) ink.disc(side.at({base + k * p, base - 0.16 * d}), 0.045 * d, flour);
        }
        const glm::dvec2 out = -glm::normalize(side.along + side.inwards);
        draw_lamp(side.at({base, base}) + 0.08 * d * out, out, glm::normalize(side.along - side.inwards), 0.95 * d,
                  ink);
    }
}

}  // namespace sikku
