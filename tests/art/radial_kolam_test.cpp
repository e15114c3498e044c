#include "art/kolam/radial_kolam.h"

#include "engine/geometry/spline.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace sikku {
namespace {

std::string error_of(const char* size, const char* order = "") {
    try {
        parse_radial_kolam(size, order);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
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

TEST(RadialKolam, ReadsOrders) {
    EXPECT_EQ(parse_radial_kolam("8x5").order, (std::vector<std::uint32_t>{1, 3, 5, 2, 4}));
    EXPECT_EQ(parse_radial_kolam("8X5", "5-4-3-2-1").order, (std::vector<std::uint32_t>{5, 4, 3, 2, 1}));
    for (const char* size : {"", "8", "x5", "8x", "1x5", "0x5", "8x5x2", "-8x5", "eight"}) {
        EXPECT_NE(error_of(size).find("expected ARMSxDOTS"), std::string::npos) << size;
    }
    EXPECT_NE(error_of("100000x100000").find("at most 100000 dots"), std::string::npos);
    for (const char* order : {"1-2-3", "1-2-3-4-4", "1-2-3-4-6", "a", "1,2,3,4,5"}) {
        EXPECT_NE(error_of("8x5", order).find("each dot of an arm once"), std::string::npos) << order;
    }
}

}  // namespace
}  // namespace sikku
