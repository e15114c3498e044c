// tests/art/plot_fills_test.cpp: fills, wide strokes and colours of plots: hatching, spirals, passes, merged pens.
#include "art/plotter/passes.h"
#include "art/plotter/pens.h"
#include "art/plotter/shading.h"
#include "tests/plot_tools.h"

#include <map>
#include <numbers>
#include <random>

namespace sikku::plot_fills_test {

using Points = std::vector<glm::dvec2>;
using reference::Line;
using reference::Recorder;

/// Winding number computed from angles, independently of the crossings that hatching uses.
bool is_inside(const Points& polygon, glm::dvec2 point) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point;
        sum += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return std::fabs(sum) > std::numbers::pi;
}

double distance_to(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = b - a;
    const double length = glm::dot(way, way);
    const double t = length > 0 ? std::clamp(glm::dot(point - a, way) / length, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + t * way);
}
double distance_to(glm::dvec2 point, const Points& line) {
    double least = glm::distance(point, line[0]);
    for (std::size_t i = 1; i < line.size(); ++i) least = std::min(least, distance_to(point, line[i - 1], line[i]));
    return least;
}

/// Records strokes of lines and curves as points.
class Flat : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { lines_drawn.push_back({start}); }
    void lines(std::span<const glm::dvec2> ends) override {
        lines_drawn.back().insert(lines_drawn.back().end(), ends.begin(), ends.end());
    }
    void curves(std::span<const glm::dvec2> controls) override {
        Samples samples(0.02);
        samples.start(lines_drawn.back().back());
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            samples.curve(controls[i], controls[i + 1], controls[i + 2]);
        }
        lines_drawn.back().insert(lines_drawn.back().end(), samples.points.begin() + 1, samples.points.end());
    }
    void change_pen(const Pen&) override { ADD_FAILURE() << "pens must change between strokes"; }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen&) override { ADD_FAILURE() << "a pen does not fill"; }
    void disc(glm::dvec2, double, const Pen&) override { ADD_FAILURE() << "a pen does not fill"; }

    std::vector<Points> lines_drawn;
};
std::vector<Points> drawn(const PlotPlan& plan) {
    Flat flat;
    plan.draw(flat);
    return flat.lines_drawn;
}

/// A raster of ink: the points of a grid that the pen covers.
struct Ink {
    std::size_t wanted = 0, missing = 0, outside = 0;
};
/// @param wanted  whether a point must be covered (1), must stay free (-1), or either (0)
template <typename Wanted>
Ink ink_of(const std::vector<Points>& lines, double pen, const Box& box, double spacing, const Wanted& wanted) {
    const glm::dvec2 size = (box.high - box.low) / spacing;
    const auto columns = static_cast<int>(size.x) + 1, rows = static_cast<int>(size.y) + 1;
    const auto at = [&](int x, int y) { return box.low + spacing * glm::dvec2(x, y); };
    std::vector<bool> is_inked(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * columns + x); };
    for (const Points& line : lines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            const glm::dvec2 low = (glm::min(line[i - 1], line[i]) - pen / 2 - box.low) / spacing;
            const glm::dvec2 high = (glm::max(line[i - 1], line[i]) + pen / 2 - box.low) / spacing;
            for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(rows, high.y + 1); ++y) {
                for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(columns, high.x + 1); ++x) {
                    if (distance_to(at(x, y), line[i - 1], line[i]) <= pen / 2) is_inked[index(x, y)] = true;
                }
            }
        }
    }
    Ink ink;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int want = wanted(at(x, y));
            if (want > 0) ++ink.wanted;
            if (want > 0 && !is_inked[index(x, y)]) ++ink.missing;
            if (want < 0 && is_inked[index(x, y)]) ++ink.outside;
        }
    }
    return ink;
}

Points star(glm::dvec2 centre, double radius) {
    Points points;
    for (int i = 0; i < 5; ++i) {
        const double angle = 0.3 + 4 * std::numbers::pi * i / 5;
        points.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

TEST(Shading, HatchLinesLieInsideAndAreEvenlySpaced) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 40);
    for (int round = 0; round < 30; ++round) {
        Points polygon;
        if (round == 0) polygon = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
        if (round == 1) polygon = star({20, 20}, 15);
        if (round == 2) polygon = {{0, 0}, {40, 0}, {40, 30}, {30, 30}, {30, 5}, {10, 5}, {10, 30}, {0, 30}};
        while (polygon.size() < 3 + static_cast<std::size_t>(round % 7)) {
            polygon.emplace_back(place(random), place(random));
        }
        const double angle = 0.37 * round, spacing = 0.5 + 0.05 * (round % 9), inset = 0.2;
        const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
        double length = 0;
        std::size_t stretches = 0;
        for (const Points& line : hatch_lines(polygon, along, spacing, inset)) {
            ASSERT_EQ(line.size() % 2, 0u);
            for (std::size_t i = 0; i < line.size(); i += 2) {
                // All polygons share the same evenly spaced lines.
                const double height = glm::dot(line[i], across) / spacing - 0.5;
                EXPECT_NEAR(height, std::round(height), 1e-6);
                EXPECT_NEAR(glm::dot(line[i + 1] - line[i], across), 0, 1e-9);
                EXPECT_TRUE(is_inside(polygon, line[i])) << round;
                EXPECT_TRUE(is_inside(polygon, line[i + 1]));
                EXPECT_TRUE(is_inside(polygon, 0.5 * (line[i] + line[i + 1])));
                length += glm::distance(line[i], line[i + 1]);
                ++stretches;
                if (i == 0) continue;
                EXPECT_NEAR(std::fabs(glm::dot(line[i] - line[i - 1], across)), spacing, 1e-9);
            }
        }
        // The length of the lines times their spacing is the area, except for the insets.
        double area = 0;
        for (double x = -0.1; x < 41; x += 0.4) {
            for (double y = -0.1; y < 41; y += 0.4) area += is_inside(polygon, {x, y}) ? 0.16 : 0;
        }
        const double hatched = (length + 2 * inset * static_cast<double>(stretches)) * spacing;
        EXPECT_NEAR(hatched, area, 0.06 * area + 3) << round;
    }
}

TEST(Shading, AConvexShapeIsOneZigzag) {
    Points circle;
    for (int i = 0; i < 200; ++i)
        circle.push_back(20.0 * glm::dvec2(std::cos(0.0314159 * i), std::sin(0.0314159 * i)));
    EXPECT_EQ(hatch_lines(circle, {0.8, 0.6}, 0.5, 0.2).size(), 1u);
    EXPECT_EQ(hatch_lines(Points{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {1, 0}, 0.5, 0.2).size(), 1u);
    // Two legs and the part between them.
    const Points arch = {{0, 0}, {40, 0}, {40, 30}, {30, 30}, {30, 5}, {10, 5}, {10, 30}, {0, 30}};
    EXPECT_LE(hatch_lines(arch, {1, 0}, 0.5, 0.2).size(), 3u);
    EXPECT_THROW(hatch_lines(arch, {1, 0}, 1e-6, 0), std::runtime_error);
    EXPECT_TRUE(hatch_lines(Points{{0, 0}, {0, 0}, {0, 0}}, {1, 0}, 0.5, 0.2).empty());
}

TEST(Shading, SpiralsCoverDiscs) {
    Print print = plain_print();
    for (const double pen : {0.3, 0.5, 2.0}) {
        print.style.stroke = {pen, false};
        for (const double radius : {0.1, 0.4, 1.0, 3.3, 8.0}) {
            const glm::dvec2 centre(50, 30);
            const auto plan = arranged(print, [&](PathSink& sink) { sink.disc(centre, radius, Pen{}); });
            EXPECT_EQ(plan->report().after.lifts, 1u) << radius;
            const auto lines = drawn(*plan);
            const Ink ink = ink_of(lines, pen, Box{centre - radius - 1.5, centre + radius + 1.5}, 0.05 + radius / 50,
                                   [&](glm::dvec2 point) {
                                       const double away = glm::distance(point, centre);
                                       const double edge = std::max(radius, pen / 2 + radius / 4);
                                       return away < radius - 0.005 ? 1 : away > edge + 0.005 ? -1 : 0;
                                   });
            EXPECT_GT(ink.wanted, 3u);
            EXPECT_EQ(ink.missing, 0u) << pen << " " << radius;
            EXPECT_EQ(ink.outside, 0u) << pen << " " << radius;
            // The ink does not exceed the area, except for the first and the last turn.
            const double area = std::numbers::pi * radius * radius / pen;
            EXPECT_LE(plan->report().after.drawn, 1.2 * area + 10 * radius);
        }
    }
}

TEST(Passes, CoverAStrokeAndNothingElse) {
    Print print = plain_print();
    print.style.stroke = {3.0, false};
    const double pen = 0.4;
    const Points corners = {{10, 10}, {40, 10}, {40, 30}, {25, 18}, {60, 50}, {60, 20}};
    const Points square = {{70, 10}, {90, 10}, {90, 30}, {70, 30}, {70, 10}};
    const auto plan = arranged(print,
                               [&](PathSink& sink) {
                                   for (const Points& line : {corners, square}) {
                                       sink.begin_stroke(line[0], Pen{});
                                       sink.lines(std::span(line).subspan(1));
                                       sink.end_stroke(line.front() == line.back());
                                   }
                               },
                               {{.pen_width = pen}});
    // Back and forth along the open stroke, rings along the closed one.
    EXPECT_EQ(pass_offsets(3.0, pen).size(), 8u);
    EXPECT_EQ(plan->report().after.lifts, 1u + 8u);
    const auto lines = drawn(*plan);
    const Ink ink = ink_of(lines, pen, Box{{5, 5}, {95, 55}}, 0.23, [&](glm::dvec2 point) {
        const double away = std::min(distance_to(point, corners), distance_to(point, square));
        return away < 1.5 - 0.02 ? 1 : away > 1.5 + 0.02 ? -1 : 0;
    });
    EXPECT_GT(ink.wanted, 5000u);
    EXPECT_EQ(ink.outside, 0u);
    // The rims of round ends are scalloped.
    EXPECT_LE(ink.missing, ink.wanted / 200);
}

TEST(Passes, FollowCurves) {
    Print print = plain_print();
    print.style.stroke = {2.0, false};
    const double pen = 0.5;
    const Points curve = {{10, 10}, {40, 60}, {50, -20}, {80, 40}, {90, 60}, {95, 50}, {90, 20}};
    const auto plan = arranged(print,
                               [&](PathSink& sink) {
                                   sink.begin_stroke(curve[0], Pen{});
                                   sink.curves(std::span(curve).subspan(1));
                                   sink.end_stroke(false);
                               },
                               {{.pen_width = pen}});
    Samples middle(0.05);
    middle.start(curve[0]);
    for (std::size_t i = 1; i + 2 < curve.size(); i += 3) middle.curve(curve[i], curve[i + 1], curve[i + 2]);
    double covered = 0;
    for (const Points& stroke : drawn(*plan)) {
        for (std::size_t i = 0; i < stroke.size(); i += 10) {
            covered = std::max(covered, distance_to(stroke[i], middle.points));
        }
    }
    EXPECT_NEAR(covered, 0.75, 0.01);
    const double length = plan->report().after.drawn / 4;
    double along = 0;
    for (std::size_t i = 1; i < middle.points.size(); ++i) {
        along += glm::distance(middle.points[i - 1], middle.points[i]);
    }
    EXPECT_NEAR(length, along, 0.02 * along);
}

TEST(Passes, ThinStrokesAndDots) {
    EXPECT_EQ(pass_offsets(0.4, 0.4), std::vector<double>{0.0});
    EXPECT_EQ(pass_offsets(0.1, 0.4), std::vector<double>{0.0});
    const std::vector<double> two = pass_offsets(0.7, 0.4);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(two[0], -0.15, 1e-12);
    EXPECT_NEAR(two[1], 0.15, 1e-12);
    const PenPath dot{{5, 5}, {{false, {}, {}, {5, 5}}}, true};
    const auto paths = pen_passes(dot, 2.0, 0.4, 0.01);
    ASSERT_EQ(paths.size(), 1u);
    EXPECT_GT(paths[0].pieces.size(), 8u);
}

TEST(Fills, OutlinesAreDrawnWhereNoLineIs) {
    Print print = plain_print();
    print.style.fill = Colour{0, 0, 255, 255};  // equals line colour index 2
    const Points square = {{10, 10}, {40, 10}, {40, 40}, {10, 40}};
    const auto plan = arranged(print, [&](PathSink& sink) {
        sink.begin_stroke(square[0], Pen{.colour = 1});
        sink.lines(Points{square[1], square[2]});
        sink.end_stroke(false);
        sink.polygon(square, Pen{});
    });
    Recorder recorder;
    plan->draw(recorder);
    std::map<int, std::size_t> edges;
    for (const Line& line : recorder.strokes) edges[line.pens[0].colour] += line.pens.size();
    EXPECT_EQ(edges, (std::map<int, std::size_t>{{1, 2}, {2, 2}}));
    // Edges of fills that a line draws are not lines drawn twice.
    EXPECT_EQ(plan->report().segments, 4u);
    EXPECT_EQ(plan->report().duplicates, 0u);
    print.style.fill = Colour{1, 2, 3, 255};
    EXPECT_EQ(with_fill_pens(print.style).palette.size(), 4u);
    EXPECT_EQ(fill_pens(with_fill_pens(print.style)), (std::vector<int>{3, 1, 2, 3}));
}

TEST(Fills, AreasAreHatchedInTheAngleOfThePage) {
    Print print = plain_print();
    const Points outline = {{10, 10}, {20, 10}, {30, 10}, {40, 10}, {40, 20}, {40, 30}, {40, 40}};
    for (const bool is_crossed : {false, true}) {
        const auto plan = arranged(print, [&](PathSink& sink) { sink.area(outline, Pen{}); },
                                   {{.pen_width = 0.3, .hatch = Hatch{1.0, 30.0, is_crossed}}});
        Recorder recorder;
        plan->draw(recorder);
        std::map<long, double> lengths;
        for (const Line& line : recorder.strokes) {
            for (std::size_t i = 1; i < line.points.size(); ++i) {
                if (line.points.size() != line.pens.size() + 1) continue;
                const glm::dvec2 way = line.points[i] - line.points[i - 1];
                const double angle = std::atan2(way.y, way.x) * 180 / std::numbers::pi;
                lengths[std::lround(angle < -1 ? angle + 180 : angle) % 180] += glm::length(way);
            }
        }
        EXPECT_NEAR(lengths[30], 450 - 30, 40) << "half a square of 30 mm";
        EXPECT_NEAR(lengths[120], is_crossed ? 450 - 30 : 0, 40);
    }
}

TEST(Pens, AreMergedIntoTheNearest) {
    const auto grey = [](int value) {
        const auto level = static_cast<std::uint8_t>(value);
        return Colour{level, level, level, 255};
    };
    const std::vector<PenColour> colours = {
        {grey(0), 10}, {grey(20), 500}, {grey(250), 30}, {grey(240), 20}, {Colour{255, 0, 0, 255}, 40}};
    EXPECT_EQ(merge_pens(colours, 5), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(merge_pens(colours, 3), (std::vector<std::size_t>{1, 1, 2, 2, 4}));
    EXPECT_EQ(merge_pens(colours, 1), (std::vector<std::size_t>{1, 1, 1, 1, 1}));
    // No other choice of two pens has a lower cost.
    const auto cost = [&](std::size_t a, std::size_t b) {
        double sum = 0;
        for (const PenColour& colour : colours) {
            sum += colour.drawn * std::min(colour_distance(colour.colour, colours[a].colour),
                                           colour_distance(colour.colour, colours[b].colour));
        }
        return sum;
    };
    double least = 1e300;
    for (std::size_t a = 0; a < 5; ++a) {
        for (std::size_t b = 0; b < a; ++b) least = std::min(least, cost(a, b));
    }
    const auto two = merge_pens(colours, 2);
    double found = 0;
    for (std::size_t i = 0; i < 5; ++i) {
        found += colours[i].drawn * colour_distance(colours[i].colour, colours[two[i]].colour);
    }
    EXPECT_NEAR(found, least, 1e-9);
}

TEST(Pens, APlanMergesAndReports) {
    Print print = plain_print();
    print.style.palette.push_back({30, 0, 0, 255});
    PlotOptions three;
    three.pens = 3;
    const auto plan = arranged(
        print,
        [](PathSink& sink) {
            for (int i = 0; i < 4; ++i) {
                sink.begin_stroke({10.0 + i, 10}, Pen{.colour = i});
                sink.lines(Points{{10.0 + i, 20.0 + i}});
                sink.end_stroke(false);
            }
        },
        three);
    ASSERT_EQ(plan->report().merged.size(), 1u);
    EXPECT_EQ(plan->report().colours, 4u);
    const MergedPen& merged = plan->report().merged[0];
    EXPECT_EQ(merged.colour, (Colour{0, 0, 0, 255}));
    EXPECT_EQ(merged.pen, (Colour{30, 0, 0, 255}));
    EXPECT_EQ(merged.number, 3);
    EXPECT_NEAR(merged.drawn, 10, 1e-9);
    Recorder recorder;
    plan->draw(recorder);
    std::map<int, int> strokes;
    for (const Line& line : recorder.strokes) ++strokes[line.pens[0].colour];
    EXPECT_EQ(strokes, (std::map<int, int>{{1, 1}, {2, 1}, {3, 2}}));
}

TEST(Home, IsPartOfTheTravel) {
    const Print print = plain_print();
    const auto stroke = [](PathSink& sink) {
        sink.begin_stroke({3, 4}, Pen{});
        sink.lines(Points{{30, 40}});
        sink.end_stroke(false);
    };
    EXPECT_NEAR(arranged(print, stroke)->report().after.travelled, 5, 1e-9);
    PlotOptions returning;
    returning.home = glm::dvec2(0, 0);
    const auto plan = arranged(print, stroke, returning);
    EXPECT_NEAR(plan->report().after.travelled, 55, 1e-9);
    EXPECT_NEAR(plan->report().before.travelled, 55, 1e-9);
    EXPECT_EQ(plan->travels().size(), 2u);
    EXPECT_TRUE(plan->report().returns);
    PlotOptions from_another_corner;
    from_another_corner.start = {0, 60};
    EXPECT_NEAR(arranged(print, stroke, from_another_corner)->report().after.travelled,
                glm::distance({30., 40.}, glm::dvec2(0, 60)), 1e-9);
}

}  // namespace sikku::plot_fills_test
