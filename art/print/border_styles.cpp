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
using namespace border;

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
