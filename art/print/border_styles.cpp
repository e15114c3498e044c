// art/print/border_styles.cpp: the traditional borders. Lengths are in millimetres; `d` is the border's depth.
#include "art/print/border.h"
#include "art/print/border_ink.h"
#include "engine/geometry/bezier.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using Point = glm::dvec2;
using Sides = std::span<const BorderSide, 4>;

constexpr int flour = 0, earth = 1;

const BorderSide& next(Sides sides, std::size_t side) {
    return sides[(side + 1) % 4];
}

/// The repeats of both kinds of sides, whose corners take `corner` of each end; `multiple` of them belong together.
BorderRepeats repeats_of(Sides sides, double corner, double length, int multiple = 1) {
    BorderRepeats repeats =
        border_repeats(sides[0].length - 2 * corner, sides[1].length - 2 * corner, multiple * length);
    repeats.across *= multiple;
    repeats.down *= multiple;
    return repeats;
}

int count_of(const BorderRepeats& repeats, std::size_t side) {
    return side % 2 == 0 ? repeats.across : repeats.down;
}

/// A closed line at a distance from the outer edge.
void draw_rectangle(Sides sides, double inset, double width, int colour, BorderInk& ink) {
    ink.begin(sides[0].at({inset, inset}), width, colour);
    for (std::size_t i = 0; i < 4; ++i) ink.line(next(sides, i).at({inset, inset}));
    ink.end(true);
}

void draw_segment(Point from, Point to, double width, int colour, BorderInk& ink) {
    ink.begin(from, width, colour);
    ink.line(to);
    ink.end(false);
}

/// The curve without `start` of its beginning and `end` of its end, in millimetres.
Bezier trimmed_curve(const Bezier& curve, double start, double end) {
    constexpr int parts = 64;
    const auto parameter = [&](double length, bool from_end) {
        if (!(length > 0)) return from_end ? 1.0 : 0.0;
        const auto at = [&](int part) {
            const double t = static_cast<double>(part) / parts;
            return part_of(curve, from_end ? 1 - t : t, from_end ? 1 - t : t)[0];
        };
        Point last = at(0);
        for (int part = 1; part <= parts; ++part) {
            const Point here = at(part);
            const double step = glm::length(here - last);
            if (step >= length) {
                const double t = (part - 1 + length / step) / parts;
                return from_end ? 1 - t : t;
            }
            length -= step;
            last = here;
        }
        return from_end ? 0.0 : 1.0;
    };
    return part_of(curve, parameter(start, false), parameter(end, true));
}

}  // namespace

/// Two strands around a row of dots, each over and under the other in turn: a kolam of one row.
void draw_rope(Sides sides, double d, BorderInk& ink) {
    const double width = 0.125 * d;
    const double middle = 0.5 * d;
    // The strands cross between the dots; a corner has a dot. Two repeats bring a strand back to its side.
    const BorderRepeats repeats = repeats_of(sides, middle, 0.86 * d, 2);
    struct Link {
        std::vector<Bezier> outer, inner;  ///< past a dot, from the crossing before it to the one after it
    };
    std::vector<Link> links;
    std::vector<Point> dots;
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = count_of(repeats, i);
        const double q = (side.length - 2 * middle) / count;
        const auto bow = [&](double u, double height) {
            return Bezier{side.at({u - q / 2, middle}), side.at({u - q / 2 + 0.43 * q, middle + height}),
                          side.at({u + q / 2 - 0.43 * q, middle + height}), side.at({u + q / 2, middle})};
        };
        for (int k = 1; k < count; ++k) {
            const double u = middle + k * q;
            dots.push_back(side.at({u, middle}));
            links.push_back({{bow(u, -0.43 * q)}, {bow(u, 0.43 * q)}});
        }
        // Around the corner: the outer strand in a wide loop, the inner one straight across.
        const BorderSide& turn = next(sides, i);
        const double before = q, after = (turn.length - 2 * middle) / count_of(repeats, i + 1);
        const auto at = [&](double u, double v) {
            return turn.at({middle + u * (u > 0 ? after : before), middle + v * (v > 0 ? before : after)});
        };
        const Point in = at(0, 0.5), out = at(0.5, 0), apex = at(-0.31, -0.31);
        links.push_back(
            {{{in, at(-0.29, 0.21), at(-0.53, -0.09), apex}, {apex, at(-0.09, -0.53), at(0.21, -0.29), out}},
             {{in, in + (out - in) / 3.0, in + 2.0 * (out - in) / 3.0, out}}});
        dots.push_back(at(0, 0));
    }
    const std::size_t count = links.size();
    const auto strand = [&](std::size_t link, std::size_t which) -> const std::vector<Bezier>& {
        return (link + which) % 2 == 0 ? links[link % count].outer : links[link % count].inner;
    };
    // A piece begins where the strand comes out from under the other one, and passes over it once.
    const double gap = 1.15 * width;
    for (std::size_t which = 0; which < 2; ++which) {
        for (std::size_t first = which; first < count; first += 2) {
            std::vector<Bezier> piece = strand(first, which);
            for (const Bezier& curve : strand(first + 1, which)) piece.push_back(curve);
            piece.front() = trimmed_curve(piece.front(), gap, 0);
            piece.back() = trimmed_curve(piece.back(), 0, gap);
            ink.begin(piece.front()[0], width, which == 0 ? flour : earth);
            for (const Bezier& curve : piece) ink.curve(curve[1], curve[2], curve[3]);
            ink.end(false);
        }
    }
    for (const Point dot : dots) ink.disc(dot, 0.055 * d, flour);
}

/// A chain of diamonds between two lines, each with a smaller one of earth in it.
void draw_diamonds(Sides sides, double d, BorderInk& ink) {
    const double line = 0.055 * d;
    const double middle = 0.5 * d, high = 0.3 * d, corner_high = 0.36 * d;
    const double corner = middle + corner_high;
    const BorderRepeats repeats = repeats_of(sides, corner, 0.66 * d);
    draw_rectangle(sides, line / 2, line, flour, ink);
    draw_rectangle(sides, d - line / 2, line, flour, ink);
    const auto diamond = [](const BorderSide& side, Point centre, double wide, double tall) {
        return std::array{side.at(centre + Point(-wide, 0)), side.at(centre + Point(0, -tall)),
                          side.at(centre + Point(wide, 0)), side.at(centre + Point(0, tall))};
    };
    // The chain as two zigzags that cross, around the whole frame.
    for (const double sign : {-1.0, 1.0}) {
        double up = sign;
        ink.begin(sides[0].at({corner, middle}), line, flour);
        for (std::size_t i = 0; i < 4; ++i) {
            const int count = count_of(repeats, i);
            const double p = (sides[i].length - 2 * corner) / count;
            for (int k = 0; k < count; ++k, up = -up) {
                ink.line(sides[i].at({corner + (k + 0.5) * p, middle + up * high}));
                ink.line(sides[i].at({corner + (k + 1) * p, middle}));
            }
            const BorderSide& turn = next(sides, i);
            if (sign < 0) {
                ink.line(turn.at({middle - corner_high, middle}));
                ink.line(turn.at({middle, middle - corner_high}));
            }
            ink.line(turn.at({corner, middle}));
        }
        ink.end(true);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * corner) / count;
        for (int k = 0; k < count; ++k) {
            const Point centre(corner + (k + 0.5) * p, middle);
            ink.polygon(diamond(side, centre, 0.5 * 0.58 * p, 0.58 * high), earth);
            ink.disc(side.at(centre), 0.035 * d, flour);
            if (k == 0) continue;
            for (const double v : {-0.62, 0.62}) {
                ink.disc(side.at({corner + k * p, middle + v * high}), 0.035 * d, flour);
            }
        }
        const Point centre(middle, middle);
        ink.polygon(diamond(side, centre, 0.62 * corner_high, 0.62 * corner_high), earth);
        ink.disc(side.at(centre), 0.06 * d, flour);
        for (const double u : {-0.29, 0.29}) {
            for (const double v : {-0.29, 0.29}) ink.disc(side.at(centre + Point(u, v) * d), 0.035 * d, flour);
        }
    }
}

/// Three waves, one above the other, with dots in their bays; in the corners they loop around a dot.
void draw_waves(Sides sides, double d, BorderInk& ink) {
    const double line = 0.065 * d;
    const double low = 0.87 * d;     // depth of the troughs of the inner wave, which the corners continue
    const double rise = 0.135 * d;   // from one wave to the next
    const double swing = 0.44 * d;   // height of a wave
    const double centre = 0.46 * d;  // centre of the loops, from both edges
    const double corner = 1.1 * d;
    const BorderRepeats repeats = repeats_of(sides, corner, 1.3 * d);
    const double handle = 0.5522847498307936;
    for (const int wave : {0, 1, 2}) {
        const double trough = low - wave * rise, crest = trough - swing;
        const double radius = trough - centre;
        ink.begin(sides[0].at({corner, trough}), line, wave == 1 ? earth : flour);
        for (std::size_t i = 0; i < 4; ++i) {
            const BorderSide& side = sides[i];
            const int count = count_of(repeats, i);
            const double p = (side.length - 2 * corner) / count;
            for (int k = 0; k < count; ++k) {
                const double u = corner + k * p;
                const double reach = 0.2 * p;
                ink.curve(side.at({u + reach, trough}), side.at({u + p / 2 - reach, crest}),
                          side.at({u + p / 2, crest}));
                ink.curve(side.at({u + p / 2 + reach, crest}), side.at({u + p - reach, trough}),
                          side.at({u + p, trough}));
            }
            const BorderSide& turn = next(sides, i);
            const Point middle = turn.at({centre, centre});
            ink.line(middle + radius * side.inwards);
            Point from = side.inwards, heading = side.along;
            for (int quarter = 0; quarter < 3; ++quarter) {
                ink.curve(middle + radius * (from + handle * heading), middle + radius * (heading + handle * from),
                          middle + radius * heading);
                from = std::exchange(heading, -from);
            }
            ink.line(turn.at({corner, trough}));
        }
        ink.end(true);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * corner) / count;
        for (int k = 0; k < count; ++k) {
            const double u = corner + k * p;
            ink.disc(side.at({u + p / 2, low - 0.13 * d}), 0.05 * d, flour);
            if (k > 0) ink.disc(side.at({u, low - 2 * rise - swing + 0.13 * d}), 0.05 * d, flour);
        }
        ink.disc(side.at({centre, centre}), 0.06 * d, flour);
    }
}

namespace {

/// A petal that stands on a base: its outline from the left foot over the tip to the right foot.
struct Petal {
    std::array<Bezier, 2> sides;
};
/// @param foot  the middle of its base @param up  from there to its tip @param across  half its width, to the right
/// @param base  width of the base, as part of the widest
Petal petal(Point foot, Point up, Point across, double base) {
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
void draw_back_petal(const Petal& left, const Petal& right, Point tip, double width, BorderInk& ink) {
    const Point from = part_of(left.sides[1], 0.42, 0.42)[0], to = part_of(right.sides[0], 0.58, 0.58)[0];
    const Point between = (from + to) / 2.0;
    ink.begin(from, width, flour);
    ink.curve(from + 0.5 * (tip - between), tip + 0.3 * (from - tip), tip);
    ink.curve(tip + 0.3 * (to - tip), to + 0.5 * (tip - between), to);
    ink.end(false);
}

}  // namespace

/// Petals that open outwards from a double line, with others behind them, and one across each corner.
void draw_lotus(Sides sides, double d, BorderInk& ink) {
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
        const Point corner = turn.at({base, base});
        const Point diagonal = turn.at({0, 0}) - corner;
        const auto corner_petal = [&](double size) {
            const Point up = glm::normalize(diagonal) * high * 1.38;
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
            const Point foot = is_last ? corner : side.at({base + static_cast<double>(k + 1) * p, base});
            const Point up = is_last ? -high * turn.inwards : -high * side.inwards;
            // Beside the petal of the corner, halfway between its direction and that of the row.
            const bool is_corner = k + 3 >= row.size();
            const Point lean = is_corner ? high * glm::normalize(up / high + glm::normalize(diagonal)) : up;
            draw_back_petal(row[k], row[k + 1], foot + (is_corner ? 0.92 : 0.78) * lean, line, ink);
            ink.disc(foot + (is_corner ? 1.14 : 1.0) * lean, 0.035 * d, flour);
        }
    }
}

/// Straight lines that cross in the corners, earth with dots between them, and steps inwards.
void draw_padi(Sides sides, double d, BorderInk& ink) {
    const double line = 0.05 * d;
    const double gap = 0.035 * d;
    const std::array<double, 4> lines = {line / 2, 0.11 * d, 0.43 * d, 0.515 * d};
    const double step = 0.1 * d, foot = 0.625 * d;
    const double from = 0.16 * d, to = 0.38 * d;  // edges of the earth
    const double corner = lines[3];
    const BorderRepeats repeats = repeats_of(sides, corner, 0.34 * d);
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        for (const double v : lines) {
            draw_segment(side.at({line / 2, v}), side.at({side.length - line / 2, v}), line, flour, ink);
        }
        const double begin = corner + 0.05 * d, end = side.length - begin;
        ink.polygon(
            std::array{side.at({begin, from}), side.at({end, from}), side.at({end, to}), side.at({begin, to})},
            earth);
        const int count = count_of(repeats, i);
        const double p = (side.length - 2 * corner) / count;
        for (int k = 0; k < count; ++k) {
            ink.disc(side.at({corner + (k + 0.5) * p, (from + to) / 2}), 0.04 * d, flour);
        }
        const double centre = (from + to) / 2, half = (to - from) / 2;
        ink.polygon(std::array{side.at({centre - half, centre}), side.at({centre, centre - half}),
                               side.at({centre + half, centre}), side.at({centre, centre + half})},
                    earth);
        ink.disc(side.at({centre, centre}), 0.04 * d, flour);
    }
    const double low = lines[3] + line / 2 + gap, high = foot - line / 2 - gap;
    for (const BorderSide& side : sides) {
        // Within the stepped line below: the stairs of the corner, and the pyramid of the side.
        std::vector<Point> stairs = {side.at({low, low})}, pyramid;
        for (int k = 3; k >= 1; --k) {
            const double end = high + k * step, top = k == 3 ? low : high + (3 - k) * step;
            stairs.push_back(side.at({end, top}));
            stairs.push_back(side.at({end, high + (4 - k) * step}));
        }
        stairs.push_back(side.at({low, high + 3 * step}));
        ink.polygon(stairs, earth);
        for (int k = -3; k <= 3; ++k) {
            if (k == 0) continue;
            const double reach = k < 0 ? k * step + line / 2 + gap : k * step - line / 2 - gap;
            const int above = std::abs(k);
            const double inner = high + (4 - above) * step, outer = above == 3 ? low : high + (3 - above) * step;
            pyramid.push_back(side.at({side.length / 2 + reach, k < 0 ? outer : inner}));
            pyramid.push_back(side.at({side.length / 2 + reach, k < 0 ? inner : outer}));
        }
        ink.polygon(pyramid, earth);
    }
    // Steps in the corners and in the middle of the sides, on one closed line.
    ink.begin(sides[0].at({sides[0].length / 2, foot + 3 * step}), line, flour);
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const BorderSide& turn = next(sides, i);
        const double middle = side.length / 2;
        const auto to_point = [&](double u, double v) { ink.line(side.at({u, v})); };
        for (int k = 1; k <= 3; ++k) {
            to_point(middle + k * step, foot + (4 - k) * step);
            to_point(middle + k * step, foot + (3 - k) * step);
        }
        for (int k = 0; k < 3; ++k) {
            to_point(side.length - foot - (3 - k) * step, foot + k * step);
            to_point(side.length - foot - (3 - k) * step, foot + (k + 1) * step);
        }
        to_point(side.length - foot, foot + 3 * step);
        for (int k = 3; k >= 1; --k) {
            ink.line(turn.at({turn.length / 2 - k * step, foot + (3 - k) * step}));
            ink.line(turn.at({turn.length / 2 - k * step, foot + (4 - k) * step}));
        }
        ink.line(turn.at({turn.length / 2, foot + 3 * step}));
    }
    ink.end(true);
}

}  // namespace sikku
