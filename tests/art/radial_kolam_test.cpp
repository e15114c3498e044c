#include "art/kolam/radial_kolam.h"

#include "art/kolam/kolam.h"
#include "engine/geometry/spline.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace sikku::radial_kolam_test {

std::string error_of(const char* size, const char* order = "") {
    return sikku::error_of<std::runtime_error>([&] { parse_radial_kolam(size, order); });
}

struct Drawn {
    std::vector<reference::Line> strokes;  // those with a pen, as splines
    std::size_t discs = 0;
};
Drawn drawn(const std::string& text) {
    const Grammar grammar = reference::grammar_of(text);
    const auto walk = [&](PathSink& sink) { derive(grammar, *Turtle::drawing(grammar, sink, true)); };
    StrokeCensus census;
    walk(census);
    reference::Recorder recorder;
    SplineSink spline(recorder, census.closed);
    walk(spline);
    Drawn result;
    result.discs = recorder.discs.size();
    for (const reference::Line& line : recorder.strokes) {
        if (line.pens.at(0).colour == 0) result.strokes.push_back(line);
    }
    return result;
}

/// By following the dots, as a hand does: from arm to arm, to the next dot of the order.
std::size_t lines_by_hand(const RadialKolam& kolam) {
    std::set<std::pair<std::size_t, std::size_t>> visited;  // arm, and place in the order
    std::size_t lines = 0;
    for (std::size_t dot = 0; dot < kolam.dots(); ++dot) {
        if (visited.contains({0, dot})) continue;
        ++lines;
        for (std::pair<std::size_t, std::size_t> at = {0, dot}; visited.insert(at).second;) {
            at = {(at.first + 1) % kolam.arms, (at.second + 1) % kolam.dots()};
        }
    }
    return lines;
}

TEST(RadialKolam, LinesAreTheGreatestCommonDivisorAndVisitEveryDot) {
    for (const char* size : {"8x5", "8x4", "12x9", "5x1", "2x3", "7x7", "10×3"}) {
        const RadialKolam kolam = parse_radial_kolam(size);
        EXPECT_EQ(kolam.lines(), lines_by_hand(kolam)) << size;
        const KolamPattern pattern = radial_pattern(kolam, {.title = "A kolam", .dot_symbols = true});
        EXPECT_EQ(pattern.lines, kolam.lines());
        ASSERT_EQ(pattern.dots.size(), kolam.arms * kolam.dots());
        const Drawn found = drawn(pattern.text);
        EXPECT_EQ(found.discs, pattern.dots.size() + 1) << size;
        ASSERT_EQ(found.strokes.size(), kolam.lines()) << size;
        std::vector<int> visits(pattern.dots.size());
        for (const reference::Line& stroke : found.strokes) {
            EXPECT_TRUE(stroke.closed) << size;
            for (std::size_t i = 0; i + 1 < stroke.points.size(); i += 3) {  // the knots of the curve
                for (std::size_t dot = 0; dot < pattern.dots.size(); ++dot) {
                    const glm::dvec2 way = stroke.points[i] - pattern.dots[dot];
                    visits[dot] += std::hypot(way.x, way.y) < 1e-8;
                }
            }
        }
        EXPECT_EQ(visits, std::vector<int>(visits.size(), 1)) << size;
    }
}

/// Where a line goes at a dot: 1 outwards, -1 inwards, 0 where it turns back.
int way_at(const RadialKolam& kolam, std::uint32_t dot) {
    const auto at =
        static_cast<std::size_t>(std::find(kolam.order.begin(), kolam.order.end(), dot) - kolam.order.begin());
    const std::uint32_t before = kolam.order[(at + kolam.dots() - 1) % kolam.dots()];
    const std::uint32_t after = kolam.order[(at + 1) % kolam.dots()];
    return before < dot && dot < after ? 1 : before > dot && dot > after ? -1 : 0;
}

/// The tangent of a Bézier at its beginning leads to its next control. Lines turn back at right angles to the arm,
/// and run on through other dots.
TEST(RadialKolam, LinesTurnBackAtRightAnglesToTheArms) {
    for (const char* size : {"8x5", "5x4", "6x3", "12x7", "2x3"}) {
        const RadialKolam kolam = parse_radial_kolam(size);
        const KolamPattern pattern = radial_pattern(kolam);
        std::size_t crossed = 0;
        for (const reference::Line& stroke : drawn(pattern.text).strokes) {
            for (std::size_t i = 0; i + 1 < stroke.points.size(); i += 3) {
                const glm::dvec2 at = stroke.points[i], way = stroke.points[i + 1] - at;
                const bool is_dot = std::any_of(pattern.dots.begin(), pattern.dots.end(), [&](glm::dvec2 dot) {
                    return std::hypot(at.x - dot.x, at.y - dot.y) < 1e-8;
                });
                if (!is_dot) continue;
                ++crossed;
                const double along_arm = at.x * way.x + at.y * way.y;
                const double share = along_arm / (std::hypot(at.x, at.y) * std::hypot(way.x, way.y));
                const int wanted = way_at(kolam, static_cast<std::uint32_t>(std::lround(std::hypot(at.x, at.y))));
                if (wanted == 0) {
                    EXPECT_LT(std::fabs(share), 1e-7) << size;
                } else {
                    EXPECT_GT(wanted * share, 0.1) << size;
                }
            }
        }
        EXPECT_EQ(crossed, pattern.dots.size()) << size;
    }
}

TEST(RadialKolam, LinesRunThroughTheirOwnDotsAndAroundTheCentre) {
    for (const char* size : {"8x5", "5x4", "6x3", "12x7"}) {
        for (const bool is_drawn : {false, true}) {
            const KolamPattern pattern = radial_pattern(parse_radial_kolam(size), {.dot_symbols = is_drawn});
            const KolamExamination found =
                examine_kolam(reference::grammar_of(pattern.text),
                              {.spline = true, .draws = [](const Pen& pen) { return pen.colour == 0; }});
            EXPECT_TRUE(found.has_own_dots) << size;
            EXPECT_EQ(found.dots.size(), pattern.dots.size() + 1) << size << ": with the one in the middle";
            EXPECT_EQ(found.dots_on_lines(), pattern.dots.size()) << size;
            EXPECT_EQ(found.loose_dots(), 0u) << size;
        }
    }
}

TEST(RadialKolam, OwnDotsOutsideOfTheLineAreFaults) {
    // A square of 4 steps with a dot in it, one on its side, and two outside of it, one of which is drawn twice.
    const std::string text =
        "angle factor: 4\naxiom: [FFFF+FFFF+FFFF+FFFF][+f(1.5)-f(1)@.][f(2)@.][-f@.@.][f(9)@.]\n";
    const KolamExamination found = examine_kolam(reference::grammar_of(text), {});
    ASSERT_TRUE(found.has_own_dots);
    EXPECT_EQ(found.dots.size(), 4u);
    EXPECT_EQ(found.dots_on_lines(), 1u);
    EXPECT_EQ(
        std::count_if(found.dots.begin(), found.dots.end(), [](const KolamDot& dot) { return dot.is_enclosed; }), 1);
    EXPECT_EQ(found.faults(), (std::vector<std::string>{"no line runs around or through 2 of 4 dots"}));
}

TEST(RadialKolam, ReadsOrders) {
    EXPECT_EQ(parse_radial_kolam("8x5").order, (std::vector<std::uint32_t>{1, 3, 5, 2, 4}));
    EXPECT_EQ(parse_radial_kolam("8X5", "5-4-3-2-1").order, (std::vector<std::uint32_t>{5, 4, 3, 2, 1}));
    for (const char* size : {"", "8", "x5", "8x", "1x5", "0x5", "8x5x2", "-8x5", "eight"}) {
        EXPECT_TRUE(has(error_of(size), "expected ARMSxDOTS")) << size;
    }
    EXPECT_TRUE(has(error_of("100000x100000"), "at most 100000 dots"));
    for (const char* order : {"1-2-3", "1-2-3-4-4", "1-2-3-4-6", "a", "1,2,3,4,5"}) {
        EXPECT_TRUE(has(error_of("8x5", order), "each dot of an arm once")) << order;
    }
}

}  // namespace sikku::radial_kolam_test
