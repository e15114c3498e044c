#include "art/drawing/map_drawing.h"

#include "art/prints.h"
#include "art/style/style.h"
#include "engine/derivation/derivation.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/maps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <vector>

namespace sikku::map_drawing_test {

Document cell_layer(int steps, const std::string& keys = {}) {
    return parse("layer.lsys", fmt::format("derivation length: {}\n{}{}", steps, keys, maps::layer));
}

/// What a drawing hands to a writer.
class Recorder : public PolygonSink {
public:
    struct Stroke {
        std::vector<glm::dvec2> points;
        Pen pen;
        bool is_closed = false;
    };
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { strokes.push_back({{start}, pen}); }
    void lines(std::span<const glm::dvec2> ends) override {
        strokes.back().points.insert(strokes.back().points.end(), ends.begin(), ends.end());
    }
    void curves(std::span<const glm::dvec2> controls) override { lines(controls); }
    void end_stroke(bool closed) override { strokes.back().is_closed = closed; }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        polygons.push_back({{vertices.begin(), vertices.end()}, pen});
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        areas.push_back({{outline.begin(), outline.end()}, pen});
    }

    std::vector<Stroke> strokes, polygons, areas;
};

Recorder drawn(const Document& document, const std::shared_ptr<const MapFrame>& frame = nullptr) {
    Diagnostics diagnostics;
    const Style style = read_style(document.pattern(), 96, diagnostics);
    MapFrames frames(document.grammar(), 1e9, {}, KeptFrames::all);
    MapDrawing drawing(frame ? frame : frames.after(document.grammar().steps()), style, {}, {}, 100);
    drawing.seen();
    Recorder recorder;
    drawing.read({}, recorder);
    return recorder;
}

TEST(MapDrawing, DrawsEachWallOnceInLongStrokes) {
    const Document document = cell_layer(5);
    const Recorder recorder = drawn(document);
    std::size_t edges = 0;
    for (const Recorder::Stroke& stroke : recorder.strokes) edges += stroke.points.size() - 1;
    EXPECT_EQ(edges, 109U);
    // Edges that alone meet in a vertex share a stroke.
    EXPECT_LT(recorder.strokes.size(), 95U);
    EXPECT_TRUE(recorder.polygons.empty());
    // A triangle is one closed stroke.
    const Recorder triangle = drawn(cell_layer(0));
    ASSERT_EQ(triangle.strokes.size(), 1U);
    EXPECT_TRUE(triangle.strokes.front().is_closed);
    EXPECT_EQ(triangle.strokes.front().points.size(), 4U);
}

TEST(MapDrawing, OldWallsAreWiderAndComeLast) {
    const Recorder recorder = drawn(cell_layer(5, "wall width: age\n"));
    EXPECT_EQ(recorder.strokes.front().pen.width, 1);
    EXPECT_EQ(recorder.strokes.back().pen.width, 6);
    for (std::size_t i = 1; i < recorder.strokes.size(); ++i) {
        EXPECT_LE(recorder.strokes[i - 1].pen.width, recorder.strokes[i].pen.width);
    }
}

/// Cells by number of edges, layer n = 5: 4 with 4, 9 with 5, 9 with 6, 10 with 7.
TEST(MapDrawing, FillsCellsBySides) {
    const Recorder recorder = drawn(cell_layer(5, "fill: sides\npalette: red lime blue yellow cyan\n"));
    ASSERT_EQ(recorder.polygons.size(), 32U);
    std::map<int, int> count;
    for (const Recorder::Stroke& cell : recorder.polygons) ++count[cell.pen.colour];
    const int first = count.begin()->first;  // of quadrilaterals
    EXPECT_EQ(count, (std::map<int, int>{{first, 4}, {first + 1, 9}, {first + 2, 9}, {first + 3, 10}}));
}

/// In the layer all cells divide in each step; in the worked square of two letters some do not.
TEST(MapDrawing, FillsCellsByAge) {
    const Recorder young = drawn(cell_layer(4, "fill: age\n"));
    for (const Recorder::Stroke& cell : young.polygons) EXPECT_EQ(cell.pen.colour, young.polygons[0].pen.colour);
    const Document document = parse("square.lsys",
                                    "map: clockwise\nderivation length: 2\nfill: age\naxiom: ab~ab\na --> e\n"
                                    "b --> ~a[-c][-~c]b\nc --> b\ne --> a[+c][-d]e\n");
    std::map<int, int> count;
    const Recorder square = drawn(document);
    for (const Recorder::Stroke& cell : square.polygons) ++count[cell.pen.colour];
    ASSERT_EQ(count.size(), 2U);
    EXPECT_EQ(count.begin()->second, 2);             // came out of the second division
    EXPECT_EQ(std::next(count.begin())->second, 1);  // is one step old
}

TEST(MapDrawing, SplinesLieInTheirCellsAndInTheTissue) {
    const Recorder recorder = drawn(cell_layer(5, "cells: splines\nfill: #abc\ntissue: #def\ntension: 8\n"));
    EXPECT_EQ(recorder.strokes.size(), 32U);
    ASSERT_EQ(recorder.areas.size(), 33U);
    for (const Recorder::Stroke& stroke : recorder.strokes) {
        EXPECT_TRUE(stroke.is_closed);
        EXPECT_EQ(stroke.points.front(), stroke.points.back());
        EXPECT_EQ(stroke.points.size() % 3, 1U);
    }
}

/// A uniform B-spline of a square's corners passes (P + 4 Q + R) / 6, and its curvature is continuous.
TEST(MapDrawing, BetaSplinesWithoutTensionAreUniformBSplines) {
    const std::vector<glm::dvec2> square{{0, 0}, {6, 0}, {6, 6}, {0, 6}};
    const std::vector<glm::dvec2> spline = closed_beta_spline(square, 0);
    ASSERT_EQ(spline.size(), 13U);
    EXPECT_NEAR(glm::distance(spline[0], glm::dvec2(1, 1)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(spline[1], glm::dvec2(2, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(spline[2], glm::dvec2(4, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(spline[3], glm::dvec2(5, 1)), 0, 1e-12);
    // Tension pulls the curve to its corners.
    EXPECT_NEAR(glm::length(closed_beta_spline(square, 1e6)[0]), 0, 1e-4);
}

TEST(MapDrawing, GrowsFromTheStepBefore) {
    const Document document = cell_layer(4, "place: pressure\n");
    MapFrames frames(document.grammar(), 1e9, {}, KeptFrames::all);
    const auto before = frames.after(3);
    const auto after = frames.after(4);
    EXPECT_TRUE(after->has_growth());
    for (std::size_t i = 0; i < before->places.size(); ++i) EXPECT_EQ(after->starts[i], before->places[i]);
    const MapFrame half = after->at(0.5);
    for (std::size_t i = 0; i < half.places.size(); ++i) {
        EXPECT_NEAR(glm::distance(half.places[i], (after->starts[i] + after->places[i]) / 2.0), 0, 1e-12);
    }
    // New walls are half drawn, from both ends.
    const Recorder growing = drawn(document, std::make_shared<const MapFrame>(half));
    const Recorder whole = drawn(document, after);
    const auto ink = [](const Recorder& recorder) {
        double length = 0;
        for (const auto& stroke : recorder.strokes) {
            for (std::size_t i = 1; i < stroke.points.size(); ++i) {
                length += glm::distance(stroke.points[i - 1], stroke.points[i]);
            }
        }
        return length;
    };
    EXPECT_GT(growing.strokes.size(), whole.strokes.size());
    EXPECT_LT(ink(growing), ink(whole));
    EXPECT_FALSE(frames.after(0)->has_growth());
}

TEST(MapDrawing, ReportsWhenTheOutlineCrossesItself) {
    const Document document = parse(
        "leaf.lsys", maps::leaf,
        {.variant = {}, .settings = {{"growth", "growth", "1"}, {"derivation length", "derivation length", "11"}}});
    MapFrames frames(document.grammar(), 1e9, {}, KeptFrames::all);
    EXPECT_FALSE(frames.after(10)->outline_crosses);
    EXPECT_TRUE(frames.after(11)->outline_crosses);
}

/// Posters, sheets and generations hold maps as they hold other drawings.
TEST(MapDrawing, StandsOnSheets) {
    const std::string series = draw(cell_layer(3), "svg", {{"generations", "0:3"}, {"size", "A4"}});
    EXPECT_TRUE(has(series, "n = 3"));
    EXPECT_NE(draw(cell_layer(3), "svg", {{"repeat", "p6m"}, {"size", "A4"}}), "");
    EXPECT_NE(draw(cell_layer(3), "pdf", {{"hand", "0.5"}, {"border", "rope"}, {"size", "A4"}}), "");
}

/// Growth is forecast before anything is placed.
TEST(MapDrawing, RefusesWhatExceedsTheBudget) {
    for (const char* place : {"straight", "gravity", "pressure"}) {
        EXPECT_THROW(draw(cell_layer(60, fmt::format("place: {}\n", place)), "svg", {{"budget", "1e6"}}), BudgetError)
            << place;
    }
}

TEST(MapDrawing, RefusesWhatNeedsATurtle) {
    const auto error = [](const std::string& option, const std::string& value, const std::string& format) {
        return error_of([&] { draw(cell_layer(2), format, {{option, value}}); });
    };
    EXPECT_TRUE(has(error("dots", "", "svg"), "a map has none"));
    EXPECT_TRUE(has(error("size", "A5", "obj"), "a map has no turtle"));
    EXPECT_EQ(error("size", "A5", "svg"), "");
}

}  // namespace sikku::map_drawing_test
