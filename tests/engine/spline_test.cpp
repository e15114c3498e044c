#include "engine/geometry/spline.h"

#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sikku::spline_test {

using reference::Dice;
using reference::Line;
using reference::Recorder;
using Points = std::vector<glm::dvec2>;

/// Points of one stroke through a spline; pens, if given, of each segment.
Line splined(const Points& points, bool closed, const std::vector<Pen>& pens = {}, std::size_t block = 3) {
    Recorder recorder;
    const std::vector<bool> is_closed = {closed};
    SplineSink spline(recorder, is_closed);
    spline.begin_stroke(points[0], pens.empty() ? Pen() : pens[0]);
    for (std::size_t i = 1; i < points.size();) {
        std::size_t end = std::min(i + block, points.size());
        for (std::size_t k = i + 1; k < end && !pens.empty(); ++k) {
            if (!(pens[k - 1] == pens[i - 1])) end = k;
        }
        if (i > 1 && !pens.empty() && !(pens[i - 1] == pens[i - 2])) spline.change_pen(pens[i - 1]);
        spline.lines(std::span(points).subspan(i, end - i));
        i = end;
    }
    spline.end_stroke(closed);
    EXPECT_EQ(recorder.strokes.size(), 1u);
    EXPECT_EQ(recorder.strokes[0].closed, closed);
    return recorder.strokes[0];
}

glm::dvec2 bezier(const Line& line, std::size_t piece, double t) {
    const double s = 1 - t;
    const auto at = [&](std::size_t i) { return line.points[3 * piece + i]; };
    return s * s * s * at(0) + 3 * s * s * t * at(1) + 3 * s * t * t * at(2) + t * t * t * at(3);
}

/// A second way: de Boor's recurrence for the basis functions, straight from their definition.
double basis(const std::vector<double>& knots, std::size_t i, int degree, double u) {
    if (degree == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
    const auto d = static_cast<std::size_t>(degree);
    double sum = 0;
    if (knots[i + d] > knots[i]) {
        sum += (u - knots[i]) / (knots[i + d] - knots[i]) * basis(knots, i, degree - 1, u);
    }
    if (knots[i + d + 1] > knots[i + 1]) {
        sum += (knots[i + d + 1] - u) / (knots[i + d + 1] - knots[i + 1]) * basis(knots, i + 1, degree - 1, u);
    }
    return sum;
}
glm::dvec2 spline_at(const Points& controls, const std::vector<double>& knots, double u) {
    glm::dvec2 sum(0.0);
    for (std::size_t i = 0; i < controls.size(); ++i) sum += basis(knots, i, 3, u) * controls[i];
    return sum;
}

/// What the curve's control points and knots are, and the parameter where its first piece begins.
struct Spline {
    Points controls;
    std::vector<double> knots;
    double begin = 0;
    std::size_t pieces = 0;
};
Spline uniform(Points controls) {
    Spline spline{std::move(controls), {}, 3, 0};
    for (std::size_t i = 0; i < spline.controls.size() + 4; ++i) spline.knots.push_back(static_cast<double>(i));
    spline.pieces = spline.controls.size() - 3;
    return spline;
}
Spline open_spline(const Points& points) {
    if (points.size() < 5) {  // fewer than 4 segments: the end points three times
        Points controls(2, points.front());
        controls.insert(controls.end(), points.begin(), points.end());
        controls.insert(controls.end(), 2, points.back());
        return uniform(controls);
    }
    Spline spline{points, {}, 0, points.size() - 3};
    for (std::size_t i = 0; i < points.size() + 4; ++i) {
        spline.knots.push_back(std::clamp(static_cast<double>(i) - 3, 0.0, static_cast<double>(points.size() - 3)));
    }
    return spline;
}
Spline closed_spline(const Points& points) {
    Points controls(points.begin(), points.end() - 1);
    const std::size_t count = controls.size();
    for (std::size_t i = 0; i < 3; ++i) controls.push_back(controls[i % count]);
    return uniform(controls);
}

void expect_near(glm::dvec2 found, glm::dvec2 expected, const std::string& what) {
    EXPECT_NEAR(found.x, expected.x, 1e-12) << what;
    EXPECT_NEAR(found.y, expected.y, 1e-12) << what;
}
void expect_equal(const Line& found, const Spline& expected, const std::string& what) {
    ASSERT_EQ(found.pens.size(), expected.pieces) << what;
    for (std::size_t piece = 0; piece < expected.pieces; ++piece) {
        for (const double t : {0.0, 0.125, 0.5, 0.75, 0.999}) {
            const double u = expected.begin + static_cast<double>(piece) + t;
            expect_near(bezier(found, piece, t), spline_at(expected.controls, expected.knots, u),
                        what + " " + std::to_string(u));
        }
    }
}
/// From piece to piece, tangents and curvature go on.
void expect_smooth(const Line& line, bool closed, const std::string& what) {
    const std::size_t pieces = line.pens.size();
    for (std::size_t piece = 0; piece + (closed ? 0 : 1) < pieces; ++piece) {
        const auto before = [&](std::size_t i) { return line.points[3 * piece + i]; };
        const auto after = [&](std::size_t i) { return line.points[3 * ((piece + 1) % pieces) + i]; };
        expect_near(before(3), after(0), what);
        expect_near(before(3) - before(2), after(1) - after(0), what);
        expect_near(before(3) - 2.0 * before(2) + before(1), after(2) - 2.0 * after(1) + after(0), what);
    }
}
Points random_points(Dice& dice, std::size_t count) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.emplace_back(static_cast<double>(dice.below(1000)) / 100, static_cast<double>(dice.below(1000)) / 100);
    }
    return points;
}

TEST(Spline, OpenStrokesEqualDeBoors) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Dice dice(seed);
        for (std::size_t count = 2; count <= 12; ++count) {
            const Points points = random_points(dice, count);
            const std::string what = std::to_string(count);
            const Line found = splined(points, false, {}, 1 + dice.below(5));
            expect_equal(found, open_spline(points), what);
            expect_smooth(found, false, what);
            expect_near(found.points.front(), points.front(), what);
            expect_near(found.points.back(), points.back(), what);
        }
    }
}

TEST(Spline, ClosedStrokesEqualDeBoors) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Dice dice(seed);
        for (std::size_t count = 2; count <= 12; ++count) {
            Points points = random_points(dice, count);
            points.push_back(points.front());
            const std::string what = std::to_string(count);
            const Line found = splined(points, true, {}, 1 + dice.below(5));
            ASSERT_EQ(found.pens.size(), count);
            // The curve may begin at any of its pieces.
            const Spline expected = closed_spline(points);
            std::size_t shift = 0;
            const auto starts_at = [&](std::size_t piece) {
                const glm::dvec2 gap = bezier(found, 0, 0) -
                                       spline_at(expected.controls, expected.knots, 3 + static_cast<double>(piece));
                return std::hypot(gap.x, gap.y) < 1e-9;
            };
            while (shift < count && !starts_at(shift)) ++shift;
            ASSERT_LT(shift, count) << what;
            for (std::size_t piece = 0; piece < count; ++piece) {
                for (const double t : {0.0, 0.25, 0.5, 0.999}) {
                    const double u = 3 + static_cast<double>((piece + shift) % count) + t;
                    expect_near(bezier(found, piece, t), spline_at(expected.controls, expected.knots, u), what);
                }
            }
            expect_smooth(found, true, what);
        }
    }
}

TEST(Spline, BeginsAsTheFormulasSay) {
    // P0, P1, (P1+P2)/2, (3P1+7P2+2P3)/12, and mirrored at the end.
    const Points p = {{0, 0}, {1, 3}, {4, 2}, {5, 7}, {8, 8}, {9, 1}, {12, 0}};
    const Line found = splined(p, false);
    expect_near(found.points[1], p[1], "");
    expect_near(found.points[2], (p[1] + p[2]) / 2.0, "");
    expect_near(found.points[3], (3.0 * p[1] + 7.0 * p[2] + 2.0 * p[3]) / 12.0, "");
    const std::size_t last = found.points.size() - 1;
    expect_near(found.points[last - 1], p[5], "");
    expect_near(found.points[last - 2], (p[5] + p[4]) / 2.0, "");
    expect_near(found.points[last - 3], (3.0 * p[5] + 7.0 * p[4] + 2.0 * p[3]) / 12.0, "");
}

TEST(Spline, PensChangeInMidStroke) {
    // A piece lies between its two middle control points, and has the pen of the segment between them.
    for (unsigned seed = 0; seed < 50; ++seed) {
        Dice dice(seed);
        for (std::size_t count = 2; count <= 10; ++count) {
            for (const bool closed : {false, true}) {
                Points points = random_points(dice, count);
                if (closed) points.push_back(points.front());
                const std::size_t segments = points.size() - 1;
                std::vector<Pen> pens(segments);
                for (Pen& pen : pens) pen.colour = static_cast<int>(dice.below(3));
                const Line found = splined(points, closed, pens, 1 + dice.below(3));
                const std::string what = std::to_string(segments) + (closed ? " closed" : " open");
                for (std::size_t piece = 0; piece < found.pens.size(); ++piece) {
                    std::size_t segment = piece + 1;  // from control point `segment` on, counted from 0
                    if (closed) {
                        segment %= segments;
                    } else if (segments < 4) {
                        segment = std::clamp<std::size_t>(piece, 1, segments) - 1;
                    }
                    ASSERT_EQ(found.pens[piece].colour, pens[segment].colour) << what << ' ' << piece;
                }
            }
        }
    }
}

TEST(Spline, LongStrokesAreHandedOnInPieces) {
    Points points;
    for (int i = 0; i <= 20'000; ++i) points.emplace_back(i, i % 7);
    const Line open = splined(points, false, {}, 1000);
    EXPECT_EQ(open.pens.size(), points.size() - 3);
    points.push_back(points.front());
    EXPECT_EQ(splined(points, true, {}, 1000).pens.size(), points.size() - 1);
}

TEST(Spline, StrokesFollowOneAnother) {
    Recorder recorder;
    const std::vector<bool> closed = {false, true, false};
    SplineSink spline(recorder, closed);
    for (const bool is_closed : closed) {
        Points points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}};
        if (is_closed) points.push_back(points.front());
        spline.begin_stroke(points[0], {});
        spline.lines(std::span(points).subspan(1));
        spline.polygon(points, {});
        spline.disc({3, 4}, 2, {});
        spline.end_stroke(is_closed);
    }
    ASSERT_EQ(recorder.strokes.size(), 3u);
    EXPECT_FALSE(recorder.strokes[0].closed);
    EXPECT_TRUE(recorder.strokes[1].closed);
    EXPECT_EQ(recorder.strokes[0].points, recorder.strokes[2].points);
    EXPECT_EQ(recorder.polygons.size(), 3u);
    EXPECT_EQ(recorder.polygons[1].vertices.size(), 6u);
    ASSERT_EQ(recorder.discs.size(), 3u);
    EXPECT_EQ(recorder.discs[0].centre, glm::dvec2(3, 4));
    EXPECT_EQ(recorder.discs[0].radius, 2);
}

/// Strokes and areas of a spline, and the outlines of polygons as the turtle reports them.
class Areas : public Recorder {
public:
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        EXPECT_EQ(outline.size() % 3, 1u);
        outlines.emplace_back(outline.begin(), outline.end());
        pens.push_back(pen);
    }
    std::vector<Points> outlines;
    std::vector<Pen> pens;
};

Areas areas_of(const std::string& text, bool moves_draw = true) {
    Diagnostics diagnostics;
    const Grammar grammar = compile_grammar(parse_pattern("test.lsys", text, diagnostics), diagnostics);
    StrokeCensus census;
    derive(grammar, *Turtle::drawing(grammar, census, moves_draw), {});
    Areas areas;
    SplineSink spline(areas, census.closed);
    derive(grammar, *Turtle::outlining(grammar, spline, spline, moves_draw), {});
    return areas;
}

/// How far the curves of an outline are from those of the strokes at most; straight ones are counted.
double distance_to_strokes(const Points& outline, const Areas& areas, int& straight) {
    Points samples;
    for (const Line& stroke : areas.strokes) {
        for (std::size_t piece = 0; 3 * piece + 3 < stroke.points.size(); ++piece) {
            for (int k = 0; k <= 400; ++k) samples.push_back(bezier(stroke, piece, k / 400.0));
        }
    }
    const Line line{outline, {}, false};
    double farthest = 0;
    for (std::size_t piece = 0; 3 * piece + 3 < outline.size(); ++piece) {
        const glm::dvec2* p = &outline[3 * piece];
        const auto bend = glm::dvec2(p[0] - 2.0 * p[1] + p[2]);
        const auto other = glm::dvec2(p[1] - 2.0 * p[2] + p[3]);
        if (std::hypot(bend.x, bend.y) + std::hypot(other.x, other.y) < 1e-12) {
            ++straight;
            continue;
        }
        for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            double nearest = 1e300;
            for (const glm::dvec2 sample : samples) {
                const glm::dvec2 gap = sample - bezier(line, piece, t);
                nearest = std::min(nearest, std::hypot(gap.x, gap.y));
            }
            farthest = std::max(farthest, nearest);
        }
    }
    return farthest;
}

TEST(SplineOutlines, AClosedLineIsFilledToItsCurve) {
    const Areas areas = areas_of("axiom: {F+F+F+F}\n");
    ASSERT_EQ(areas.outlines.size(), 1u);
    ASSERT_EQ(areas.strokes.size(), 1u);
    EXPECT_TRUE(areas.polygons.empty());
    const Points& outline = areas.outlines[0];
    ASSERT_EQ(outline.size(), 13u);
    EXPECT_EQ(outline.front(), outline.back());
    int straight = 0;
    EXPECT_LT(distance_to_strokes(outline, areas, straight), 1e-3);
    EXPECT_EQ(straight, 0);
}

TEST(SplineOutlines, PiecesOfALineFollowItAndCloseWithAStraightLine) {
    for (const char* axiom :
         {"FF+F{F-F-F+F+F+F}F-FF", "{F+FF+F}FFFF", "FFFF{F+F+F}", "F{F+F}F", "{F+F+F}", "FFF{F+F-F{F+F+F}F+F}FF-F",
          "F{+F[-F+F]F}F", "FF{+F-F-F-F}F{F-F-F-F}FF", "{F+F+F+F}-F-F-F-F", "F+F{+F+F+F+F+F}+F", "F{f+f+F}FFF"}) {
        const Areas areas = areas_of(std::string("axiom: ") + axiom + "\n");
        const std::string_view word = axiom;
        EXPECT_EQ(areas.outlines.size() + areas.polygons.size(),
                  static_cast<std::size_t>(std::count(word.begin(), word.end(), '{')))
            << axiom;
        for (const Points& outline : areas.outlines) {
            int straight = 0;
            EXPECT_LT(distance_to_strokes(outline, areas, straight), 2e-3) << axiom;
            EXPECT_LE(straight, 3) << axiom;
        }
    }
}

TEST(SplineOutlines, WhatIsNotDrawnIsStraight) {
    // Of five edges two are drawn; the others are straight, and the last one closes the outline by itself.
    const Areas areas = areas_of("angle factor: 5\naxiom: {F+F+f+f+f}\n", false);
    ASSERT_EQ(areas.outlines.size(), 1u);
    EXPECT_EQ(areas.strokes.size(), 1u);
    int straight = 0;
    EXPECT_LT(distance_to_strokes(areas.outlines[0], areas, straight), 2e-3);
    EXPECT_GE(straight, 3);
    // None is drawn.
    const Areas bare = areas_of("axiom: {f+f+f+f}F\n", false);
    int all = 0;
    ASSERT_EQ(bare.outlines.size(), 1u);
    distance_to_strokes(bare.outlines[0], bare, all);
    EXPECT_EQ(all, 4);
}

TEST(SplineOutlines, KeepTheirOrderAndPensInLongLines) {
    std::string axiom;
    for (int i = 0; i < 3000; ++i) axiom += "{;F+F+F-}F";
    const Areas areas = areas_of("axiom: " + axiom + "\n");
    ASSERT_EQ(areas.outlines.size(), 3000u);
    for (std::size_t i = 0; i < areas.pens.size(); ++i) EXPECT_EQ(areas.pens[i].colour, static_cast<int>(i) + 1);
    // Far from the ends all are the same but for their place.
    const Points& one = areas.outlines[1000];
    const Points& other = areas.outlines[2000];
    ASSERT_EQ(one.size(), other.size());
    double turned = 0;
    for (std::size_t i = 1; i < one.size(); ++i) {
        turned = std::max(turned, std::fabs(std::hypot(one[i].x - one[0].x, one[i].y - one[0].y) -
                                            std::hypot(other[i].x - other[0].x, other[i].y - other[0].y)));
    }
    EXPECT_LT(turned, 1e-9);
}

TEST(SplineOutlines, SinksWithoutAreasReceivePolygons) {
    Recorder recorder;
    // A circle of four quarters.
    const double k = 0.5522847498307936;
    const Points outline = {{1, 0},   {1, k},   {k, 1},  {0, 1},  {-k, 1}, {-1, k}, {-1, 0},
                            {-1, -k}, {-k, -1}, {0, -1}, {k, -1}, {1, -k}, {1, 0}};
    recorder.area(outline, {});
    ASSERT_EQ(recorder.polygons.size(), 1u);
    const Points& vertices = recorder.polygons[0].vertices;
    double area = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 a = vertices[i], b = vertices[(i + 1) % vertices.size()];
        EXPECT_NEAR(std::hypot(a.x, a.y), 1, 3e-4);
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    EXPECT_NEAR(area, 3.14159265, 0.02);
}

TEST(StrokeCensus, NotesWhichStrokesAreClosed) {
    StrokeCensus census;
    for (const bool closed : {true, false, true}) {
        census.begin_stroke({0, 0}, {});
        census.end_stroke(closed);
    }
    EXPECT_EQ(census.closed, (std::vector{true, false, true}));
}

}  // namespace sikku::spline_test
