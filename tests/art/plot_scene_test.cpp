// tests/art/plot_scene_test.cpp: plots of drawings in space, with hidden lines removed.
#include "art/drawing/plot_scene.h"
#include "art/space/hidden_lines.h"
#include "tests/reference.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

namespace sikku::plot_scene_test {

using reference::Line;
using reference::Recorder;

constexpr Colour red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255};

/// A step is a millimetre long, stems are a millimetre wide.
Print flat_print() {
    Print print;
    print.page = {200, 200, 0};
    print.style.palette = {red, green, blue};
    print.style.stroke = {1.0, true, 1.0};
    print.placement.to_page = {{1, 0}, {0, -1}, {100, 100}};
    print.placement.step = 1;
    return print;
}

Recorder plotted(const std::string& axiom, const Print& print, const PlotPen& options = {}) {
    const Scene scene = Scene::of(reference::grammar_of("turn: left\naxiom: " + axiom + "\n"), print.style,
                                  {.interpreted = true}, 1e6);
    Recorder recorder;
    plot_scene(scene, print, options, recorder);
    return recorder;
}

/// True if there is ink of a colour at a position.
bool is_drawn(const Recorder& recorder, glm::dvec2 at, int colour, double radius = 0.01) {
    for (const Line& line : recorder.strokes) {
        const std::size_t stride = (line.points.size() - 1) / line.pens.size();
        if (line.pens[0].colour != colour || stride != 1) continue;
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            const glm::dvec2 a = line.points[i - 1], way = line.points[i] - a;
            const double square = glm::dot(way, way);
            const double t = square > 0 ? std::clamp(glm::dot(at - a, way) / square, 0.0, 1.0) : 0.0;
            if (glm::distance(at, a + t * way) < radius) return true;
        }
    }
    return false;
}

/// A square of 20 around the turtle, in the plane of the page, five steps in front of it or behind.
const std::string square = "[f(10)+f(10)|{f(20)-f(20)-f(20)-f(20)}]";
const std::string behind = "[&(90)f(5)^(90);" + square + "]";
const std::string front = "[^(90)f(5)&(90);" + square + "]";
/// A line from (0, -30) to (0, 30).
const std::string stem = "[f(30)|F(60)]";

TEST(PlotScene, ALeafHidesTheStemBehindIt) {
    for (const std::string& word : {front + stem, stem + front}) {
        const Recorder recorder = plotted(word, flat_print());
        EXPECT_TRUE(is_drawn(recorder, {0, 25}, 0)) << word;
        EXPECT_TRUE(is_drawn(recorder, {0, -25}, 0));
        EXPECT_TRUE(is_drawn(recorder, {0, 10.5}, 0));
        EXPECT_FALSE(is_drawn(recorder, {0, 9.5}, 0));
        EXPECT_FALSE(is_drawn(recorder, {0, 0}, 0));
        for (const glm::dvec2 at : {glm::dvec2(10, 0), {-10, 0}, {0, 10}, {0, -10}}) {
            EXPECT_TRUE(is_drawn(recorder, at, 1)) << "the outline";
        }
        EXPECT_EQ(recorder.polygons.size(), 0u);
    }
}

TEST(PlotScene, AStemHidesTheLeafBehindItWhereItIsWide) {
    Print print = flat_print();
    const Recorder wide = plotted(stem + behind, print);
    EXPECT_TRUE(is_drawn(wide, {0, 0}, 0));
    EXPECT_FALSE(is_drawn(wide, {0.4, 10}, 1)) << "the edge that crosses behind";
    EXPECT_TRUE(is_drawn(wide, {0.6, 10}, 1));
    EXPECT_TRUE(is_drawn(wide, {10, 0}, 1));
    print.style.stroke.value = 0.3;
    EXPECT_TRUE(is_drawn(plotted(stem + behind, print), {0.1, 10}, 1)) << "covered by the ink of the stem";
}

TEST(PlotScene, HatchingIsHiddenToo) {
    PlotPen options{.pen_width = 0.3, .hatch = Hatch{2.0, 45.0, false}};
    // A large square behind, a small one in front of its middle.
    const std::string large = "[&(90)f(5)^(90);;[f(30)+f(30)|{f(60)-f(60)-f(60)-f(60)}]]";
    const Recorder recorder = plotted(large + front, flat_print(), options);
    std::size_t outside = 0, inside = 0;
    for (double x = -29; x < 29; x += 0.5) {
        for (double y = -29; y < 29; y += 0.5) {
            if (!is_drawn(recorder, {x, y}, 2, 0.2)) continue;
            const double away = std::max(std::fabs(x), std::fabs(y));
            if (away < 9.7) ++inside;
            if (away > 10.3) ++outside;
        }
    }
    EXPECT_EQ(inside, 0u);
    EXPECT_GT(outside, 500u);
    EXPECT_TRUE(is_drawn(recorder, {0, 0}, 1, 1.5)) << "its own";
}

TEST(PlotScene, WideStemsTakeSeveralPasses) {
    PlotPen options{.pen_width = 0.3};
    Print print = flat_print();
    print.style.stroke.value = 4;
    const Recorder recorder = plotted("[f(30)|F(30)F(30)]" + behind, print, options);
    for (double x = -1.99; x < 2; x += 0.07) {
        for (const double y : {-29.0, -3.3, 0.0, 17.0, 29.9}) EXPECT_TRUE(is_drawn(recorder, {x, y}, 0, 0.151)) << x;
    }
    EXPECT_FALSE(is_drawn(recorder, {2.2, 3}, 0, 0.15));
    EXPECT_FALSE(is_drawn(recorder, {1.5, 10}, 1, 0.1)) << "hidden by the stem";
    EXPECT_TRUE(is_drawn(recorder, {2.5, 10}, 1, 0.1));
    EXPECT_EQ(std::count_if(recorder.strokes.begin(), recorder.strokes.end(),
                            [](const Line& line) { return line.pens[0].colour == 0; }),
              1);
}

TEST(PlotScene, SpheresAreSpiralsThatHide) {
    const Recorder recorder = plotted(stem + "[^(90)f(9);@O(8)]", flat_print());
    EXPECT_FALSE(is_drawn(recorder, {0, 0}, 0));
    EXPECT_FALSE(is_drawn(recorder, {0, 7.9}, 0));
    EXPECT_TRUE(is_drawn(recorder, {0, 8.1}, 0));
    std::size_t curves = 0;
    for (const Line& line : recorder.strokes) curves += line.pens[0].colour == 1 ? line.pens.size() : 0;
    EXPECT_GT(curves, 8u * 2);
    // In front of the sphere, and through it.
    EXPECT_TRUE(is_drawn(plotted(stem + "[&(90)f(9);@O(8)]", flat_print()), {0, 0}, 0));
    const Recorder through = plotted("[^(90)f(20)|F(40)]@O(8)", flat_print());
    EXPECT_TRUE(through.strokes.size() >= 1);
}

TEST(PlotScene, EdgesAreDrawnOnce) {
    // Two squares that share an edge, and a stem along another one.
    const std::string pair = "[f(10){;f(10)+f(10)+f(10)+f(10)}][f(10){;;f(10)-f(10)-f(10)-f(10)}][f(20)+F(10)]";
    const Recorder recorder = plotted("$" + pair, flat_print());
    double length = 0;
    for (const Line& line : recorder.strokes) {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            length += glm::distance(line.points[i - 1], line.points[i]);
        }
    }
    EXPECT_NEAR(length, 70, 1e-4);
}

// --- comparison with a brute-force method ------------------------------------------------------------------------

struct Triangle {
    std::array<glm::dvec3, 3> corners;
};
/// Distance of a point inside a triangle from its edges (negative outside), and the triangle's depth there.
std::pair<double, double> depth_at(const Triangle& triangle, glm::dvec2 at) {
    const auto& [a, b, c] = triangle.corners;
    const auto cross = [](glm::dvec2 p, glm::dvec2 q) { return p.x * q.y - p.y * q.x; };
    const double area = cross(glm::dvec2(b - a), glm::dvec2(c - a));
    const double v = cross(at - glm::dvec2(a), glm::dvec2(c - a)) / area;
    const double w = cross(glm::dvec2(b - a), at - glm::dvec2(a)) / area;
    const double u = 1 - v - w;
    return {std::min({u, v, w}), u * a.z + v * b.z + w * c.z};
}

TEST(HiddenLines, AgreeWithLookingAtEachPoint) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    const auto anywhere = [&](double size) {
        const double x = size * share(random), y = size * share(random);
        return glm::dvec3(x, y, size * share(random));
    };
    for (const int count : {1, 5, 60, 800}) {
        std::vector<Triangle> triangles;
        HiddenLines hidden;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 at = anywhere(100);
            const double size = count > 100 ? 12 : 50;
            triangles.push_back({{at, at + anywhere(size), at + anywhere(size)}});
            hidden.add_polygon(triangles.back().corners, static_cast<std::uint32_t>(i));
        }
        hidden.build({});
        std::size_t checked = 0, seen = 0;
        for (int k = 0; k < 200; ++k) {
            const glm::dvec3 from = anywhere(130) - 15.0, to = anywhere(130) - 15.0;
            const auto parts = hidden.visible(std::array{from, to}, 1'000'000, 0.0);
            for (double t = 0.0005; t < 1; t += 0.0101) {
                const glm::dvec3 at = from + t * (to - from);
                bool is_hidden = false, is_close = false;
                for (const Triangle& triangle : triangles) {
                    const auto [inside, depth] = depth_at(triangle, glm::dvec2(at));
                    is_close = is_close || std::fabs(inside) < 1e-3 || (inside > 0 && std::fabs(depth - at.z) < 1e-2);
                    is_hidden = is_hidden || (inside > 0 && depth > at.z);
                }
                if (is_close) continue;
                bool is_visible = false;
                for (const auto& part : parts) {
                    const double a = glm::distance(part.front(), glm::dvec2(from));
                    const double b = glm::distance(part.back(), glm::dvec2(from));
                    const double here = glm::distance(glm::dvec2(at), glm::dvec2(from));
                    is_visible = is_visible || (here >= a && here <= b);
                }
                EXPECT_EQ(is_visible, !is_hidden) << count << " " << k << " " << t;
                ++checked;
                seen += is_visible ? 1 : 0;
            }
        }
        EXPECT_GT(checked, 10'000u);
        EXPECT_GT(seen, 100u);
    }
}

TEST(HiddenLines, BallsHideWhatIsInsideAndBehind) {
    HiddenLines hidden;
    hidden.add_ball({0, 0, 0}, 5, 0);
    hidden.build({});
    const auto length = [&](glm::dvec3 from, glm::dvec3 to) {
        double sum = 0;
        for (const auto& part : hidden.visible(std::array{from, to}, 1, 0.0)) {
            sum += glm::distance(part.front(), part.back());
        }
        return sum;
    };
    EXPECT_NEAR(length({-10, 0, -7}, {10, 0, -7}), 10, 1e-3) << "behind";
    EXPECT_NEAR(length({-10, 0, 7}, {10, 0, 7}), 20, 1e-3) << "in front";
    EXPECT_NEAR(length({-10, 0, 0}, {10, 0, 0}), 10, 1e-3) << "through";
    EXPECT_NEAR(length({-10, 0, 4}, {10, 0, 4}), 14, 1e-3) << "through, above the middle";
    EXPECT_NEAR(length({-10, 6, -7}, {10, 6, -7}), 20, 1e-3) << "beside";
    // A gap and a remaining part that are too short to lift the pen.
    EXPECT_EQ(hidden.visible(std::array{glm::dvec3(-10, 0, -7), glm::dvec3(10, 0, -7)}, 1, 11.0).size(), 1u);
    EXPECT_EQ(hidden.visible(std::array{glm::dvec3(-6, 0, -7), glm::dvec3(10, 0, -7)}, 1, 2.0).size(), 1u);
}

}  // namespace sikku::plot_scene_test
