// Decorations of tiles: against facts about Ammann bars, mirror curves and circles.
#include "art/tiles/tile_decorator.h"
#include "art/plotter/plot_join.h"
#include "art/prints.h"
#include "engine/base/diagnostic.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sikku::tile_decorator_test {

struct Stroke {
    double length = 0;
    glm::dvec2 begin{0.0}, end{0.0};
    Pen pen;
    bool is_closed = false;
};

/// Collects strokes and discs.
struct Strokes : PathSink {
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { list.push_back({0, start, start, pen}); }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            list.back().length += glm::length(end - list.back().end);
            segments.emplace_back(list.back().end, end);
            list.back().end = end;
        }
    }
    void curves(std::span<const glm::dvec2> controls) override {
        Stroke& stroke = list.back();
        for (std::size_t i = 0; i < controls.size(); i += 3) {
            stroke.length += bezier_length({stroke.end, controls[i], controls[i + 1], controls[i + 2]});
            stroke.end = controls[i + 2];
        }
    }
    void change_pen(const Pen&) override {}
    void end_stroke(bool closed) override { list.back().is_closed = closed; }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2 centre, double, const Pen&) override { discs.push_back(centre); }

    std::vector<Stroke> list;
    std::vector<std::pair<glm::dvec2, glm::dvec2>> segments;  ///< straight parts of all strokes
    std::vector<glm::dvec2> discs;
};

/// Hands the polygons of a drawing to a decorator.
struct Tiles : PolygonSink {
    explicit Tiles(TileDecorator& given) : decorator(given) {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { decorator.add(vertices, pen); }
    TileDecorator& decorator;
};

Style style_of(const std::string& text) {
    Diagnostics diagnostics;
    const Style style = read_style(parse_pattern("x", text, diagnostics), 96, diagnostics);
    diagnostics.throw_if_errors();
    return style;
}

/// The decoration of a bundled tiling. @param variant  of the pattern
Strokes decorated(const std::string& tiling, const std::string& variant, const std::string& steps) {
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern(tiling, contents(bundled("tilings/" + tiling)), diagnostics);
    apply_overrides(pattern, variant, {{"-n", "derivation length", steps}}, diagnostics);
    const Style style = read_style(pattern, 96, diagnostics);
    diagnostics.throw_if_errors();
    const Grammar grammar =
        reference::grammar_of(contents(bundled("tilings/" + tiling)), {{"-n", "derivation length", steps}});
    TileDecorator decorator(style, 7, 1e7);
    Tiles tiles(decorator);
    derive(grammar, *Turtle::drawing(grammar, tiles, false), {.interpreted = true});
    Strokes strokes;
    decorator.draw(strokes, {});
    return strokes;
}

Strokes on_squares(const Style& style, int columns, int rows, int shift = 0) {
    TileDecorator decorator(style, 1, 1e7);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const glm::dvec2 at(2 * x + (y % 2) * shift, 2 * y);
            const std::vector<glm::dvec2> square = {at, at + glm::dvec2(2, 0), at + glm::dvec2(2, 2),
                                                    at + glm::dvec2(0, 2)};
            decorator.add(square, {});
        }
    }
    Strokes strokes;
    decorator.draw(strokes, {});
    return strokes;
}

std::string complaint(const std::string& value) {
    return error_of<PatternError>([&] { style_of("axiom: F\ndecorate: " + value + "\n"); });
}

/// Mirror curves: a by b squares have gcd(a, b) closed strands. Jablan 1996, "Mirror curves".
TEST(TileDecorator, KolamsOfSquaresHaveAsManyStrandsAsTheGreatestCommonDivisor) {
    const Style style = style_of("axiom: F\ndecorate: kolam dots\n");
    for (int columns = 1; columns <= 7; ++columns) {
        for (int rows = 1; rows <= 7; ++rows) {
            const Strokes strokes = on_squares(style, columns, rows);
            EXPECT_EQ(strokes.list.size(), static_cast<std::size_t>(std::gcd(columns, rows)))
                << columns << " by " << rows;
            for (const Stroke& stroke : strokes.list) EXPECT_TRUE(stroke.is_closed);
            EXPECT_EQ(strokes.discs.size(), static_cast<std::size_t>(columns * rows));
        }
    }
}

TEST(TileDecorator, KolamsCloseWhereTilesAreNotEdgeToEdge) {
    for (const Stroke& stroke : on_squares(style_of("axiom: F\ndecorate: kolam\n"), 4, 5, 1).list) {
        EXPECT_TRUE(stroke.is_closed);
    }
    for (const Stroke& stroke : decorated("penrose-kite-dart", "kolam", "4").list) EXPECT_TRUE(stroke.is_closed);
}

/// Grünbaum & Shephard 1987, 10.6: five families of parallel bars, at two distances of ratio τ in each.
TEST(TileDecorator, AmmannBarsLieAtTwoDistancesInFiveDirections) {
    const Strokes strokes = decorated("penrose-rhombs", "bars", "6");
    const double tau = (1 + std::sqrt(5.0)) / 2;
    std::map<int, std::vector<double>> families;
    // At the border, where two bars end in one place, a stroke passes from one to the other.
    for (const auto& [begin, end] : strokes.segments) {
        const glm::dvec2 along = end - begin;
        double degrees = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
        degrees = std::fmod(degrees + 360.5, 180) - 0.5;
        const int family = static_cast<int>(std::lround((degrees - 18) / 36));
        ASSERT_NEAR(degrees, 18 + 36 * family, 1e-6);
        const double angle = (108 + 36 * family) * std::numbers::pi / 180;
        families[family].push_back(glm::dot(begin, glm::dvec2(std::cos(angle), std::sin(angle))));
    }
    EXPECT_EQ(families.size(), 5U);
    for (auto& [family, places] : families) {
        std::sort(places.begin(), places.end());
        int bars = 0;
        for (std::size_t i = 1; i < places.size(); ++i) {
            const double distance = places[i] - places[i - 1];
            if (distance < 1e-6) continue;  // a bar that the ragged border interrupts
            ++bars;
            EXPECT_TRUE(std::fabs(distance - std::sqrt(5.0) / 2) < 1e-6 ||
                        std::fabs(distance - std::sqrt(5.0) / 2 * tau) < 1e-6)
                << distance;
        }
        EXPECT_GT(bars, 15);
    }
}

/// Each rhomb has two arcs around corners, of radii that its type gives; arcs of a colour never meet those of
/// another.
TEST(TileDecorator, PenroseArcsMatchAcrossEdges) {
    const double third = std::sqrt(5.0) - 2;  // τ^-3
    double expected = 0, length = 0;
    const double degree = std::numbers::pi / 180;
    expected += 170 * 144 * degree * (third + third) + 275 * 72 * degree * (1 - third + third);
    std::size_t open = 0;
    for (const Stroke& stroke : decorated("penrose-rhombs", "arcs", "5").list) {
        length += stroke.length;
        open += stroke.is_closed ? 0 : 1;
    }
    EXPECT_NEAR(length, expected, 1e-3 * expected);
    // Open strokes end on the 90 edges of the border.
    EXPECT_LE(2 * open, 90U);
}

TEST(TileDecorator, TruchetArcsDependOnTheSeedOnlyAndCrossEachInnerSideOnce) {
    const Style style = style_of("axiom: F\ndecorate: truchet\n");
    const Strokes strokes = on_squares(style, 6, 5);
    double length = 0;
    std::size_t open = 0;
    for (const Stroke& stroke : strokes.list) {
        length += stroke.length;
        open += stroke.is_closed ? 0 : 1;
    }
    EXPECT_NEAR(length, 30 * std::numbers::pi, 1e-3 * length);  // two quarters of a circle of radius 1 each
    EXPECT_EQ(open, 11U);                                       // 22 sides of the border
    EXPECT_EQ(on_squares(style, 6, 5).list.size(), strokes.list.size());
}

TEST(TileDecorator, StrandsOfOneLengthHaveOneColour) {
    const Strokes strokes = on_squares(style_of("axiom: F\ndecorate: kolam strands\n"), 3, 3);
    std::map<int, std::vector<double>> lengths;
    for (const Stroke& stroke : strokes.list) lengths[stroke.pen.colour].push_back(stroke.length);
    for (const auto& [colour, all] : lengths) {
        EXPECT_NEAR(*std::min_element(all.begin(), all.end()), *std::max_element(all.begin(), all.end()), 1e-6);
    }
}

TEST(TileDecorator, PlacesBehindTheLastSideAreErrors) {
    const Style style = style_of("axiom: F\ndecorate: tile 0 line 0.5 4.5\n");
    EXPECT_THROW(on_squares(style, 1, 1), std::runtime_error);
    EXPECT_NO_THROW(on_squares(style_of("axiom: F\ndecorate: tile 1 line 0.5 4.5\n"), 1, 1));
    TileDecorator full(style, 1, 3);
    const std::vector<glm::dvec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_THROW(full.add(square, {}), BudgetError);
}

TEST(TileDecorator, MistakesInTheKeyAreNamed) {
    EXPECT_TRUE(has(complaint(""), "is empty"));
    EXPECT_TRUE(has(complaint("kolan"), "did you mean 'kolam'"));
    EXPECT_TRUE(has(complaint("none kolam"), "must stand alone"));
    EXPECT_TRUE(has(complaint("arc 0.5 1.5"), "belongs to tiles"));
    EXPECT_TRUE(has(complaint("tile"), "colour numbers"));
    EXPECT_TRUE(has(complaint("tile 1 arc 0.5"), "two places"));
    EXPECT_TRUE(has(complaint("tile 1 arc 0.5 -1"), "two places"));
    EXPECT_TRUE(has(complaint("tile 1 arc 0.5 nan"), "two places"));
    EXPECT_TRUE(has(complaint("tile 1 line 1 1"), "different places"));
    EXPECT_TRUE(has(complaint("tile 1 colour 5000 dot"), "0 to 4095"));
    EXPECT_TRUE(has(complaint("strands"), "name lines too"));
    EXPECT_EQ(complaint("tile 1 2 arc 0.5 1.5; line 0 2 colour 3; dot tile 4 dot"), "");
}

}  // namespace sikku::tile_decorator_test
