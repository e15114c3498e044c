// tests/art/view_test.cpp: visible parts of drawings too large to be read, edge for edge against another form of the
// curve, and pixel for pixel against drawings read in full.
#include "art/deep/view.h"

#include "art/deep/spline_pieces.h"
#include "art/raster/raster.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/fold.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::view_test {

using reference::grammar_of;

__extension__ using Whole = __int128;
__extension__ using Number = unsigned __int128;

const std::string hilbert = "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: ";

using Point = std::pair<std::int64_t, std::int64_t>;
using Edge = std::pair<Point, Point>;

Edge ordered(Point a, Point b) {
    return a < b ? Edge{a, b} : Edge{b, a};
}

/// The unit edges of a drawing on the square grid.
class EdgeSink : public BlotSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            EXPECT_EQ(std::hypot(end.x - at_.x, end.y - at_.y), 1.0);
            edges.insert(ordered(rounded(at_), rounded(end)));
            at_ = end;
        }
    }
    void curves(std::span<const glm::dvec2>) override { FAIL(); }
    void change_pen(const Pen&) override { FAIL(); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen&) override { FAIL(); }
    void disc(glm::dvec2, double, const Pen&) override { FAIL(); }
    std::size_t prepare(const Blot&, const Pen&) override {
        ADD_FAILURE();
        return 0;
    }
    void blot(std::size_t, glm::dvec2) override { FAIL(); }
    std::set<Edge> edges;

private:
    static Point rounded(glm::dvec2 point) {
        EXPECT_EQ(point.x, std::round(point.x));
        return {std::llround(point.x), std::llround(point.y)};
    }
    glm::dvec2 at_{0.0};
};

/// Number of the point along Hilbert's curve of that order, by bits.
Number number_of(int order, Whole x, Whole y) {
    Number number = 0;  // of orders above 63 what is left of it tells neighbours, too
    for (int bit = order - 1; bit >= 0; --bit) {
        const Whole side = Whole{1} << bit;
        const auto square = static_cast<Number>(side) * static_cast<Number>(side);
        const bool right = (x & side) != 0;
        const bool up = (y & side) != 0;
        number += square * static_cast<unsigned>((right ? 3 : 0) ^ (up ? 1 : 0));
        x &= side - 1;
        y &= side - 1;
        if (!up) {
            if (right) {
                x = side - 1 - x;
                y = side - 1 - y;
            }
            std::swap(x, y);
        }
    }
    return number;
}

/// The form's coordinates of a point of our curve, which is the same but for its attitude.
using Attitude = std::function<std::pair<Whole, Whole>(int order, Whole x, Whole y)>;

std::vector<Attitude> attitudes() {
    std::vector<Attitude> list;
    for (int i = 0; i < 32; ++i) {
        list.push_back([i](int order, Whole x, Whole y) {
            const Whole most = (Whole{1} << order) - 1;
            if (i & 8) x += most;
            if (i & 16) y += most;
            if (i & 1) x = most - x;
            if (i & 2) y = most - y;
            if (i & 4) std::swap(x, y);
            return std::pair(x, y);
        });
    }
    return list;
}

std::set<Edge> edges_seen(int order, Quad x0, Quad y0, int side) {
    const Grammar grammar = grammar_of(hilbert + std::to_string(order) + "\n");
    const auto view = View::make(grammar, ViewWindow{x0, y0, x0 + side, y0 + side});
    EXPECT_TRUE(view);
    Sight sight;
    sight.box.add({0, 0});
    sight.box.add({side, side});
    EdgeSink sink;
    view->read(sight, sink, 1e7, {});
    return sink.edges;
}

/// Edges with both ends within the window, from its lower left corner.
std::set<Edge> edges_expected(int order, Whole x0, Whole y0, int side, const Attitude& attitude) {
    std::set<Edge> edges;
    std::vector<Number> numbers;
    const int points = side + 1;
    for (int i = 0; i < points * points; ++i) {
        const auto [u, v] = attitude(order, x0 + i % points, y0 + i / points);
        numbers.push_back(number_of(order, u, v));
    }
    const auto number = [&](int x, int y) { return numbers[static_cast<std::size_t>(y * points + x)]; };
    for (int x = 0; x <= side; ++x) {
        for (int y = 0; y <= side; ++y) {
            for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
                if (x + dx > side || y + dy > side) continue;
                const Number one = number(x, y), other = number(x + dx, y + dy);
                if (one + 1 == other || other + 1 == one) edges.insert(ordered({x, y}, {x + dx, y + dy}));
            }
        }
    }
    return edges;
}

std::set<Edge> within(const std::set<Edge>& edges, int side) {
    std::set<Edge> inside;
    for (const Edge& edge : edges) {
        const auto holds = [&](const Point& p) {
            return p.first >= 0 && p.second >= 0 && p.first <= side && p.second <= side;
        };
        if (holds(edge.first) && holds(edge.second)) inside.insert(edge);
    }
    return inside;
}

TEST(View, WindowsOfHilbertAreThoseOfAnotherForm) {
    // The curve lies left of and above its beginning.
    const auto low_corner = [](int order) { return std::pair(1 - (Whole{1} << order), Whole{0}); };
    std::optional<Attitude> attitude;
    for (const Attitude& one : attitudes()) {
        const auto [x, y] = low_corner(4);
        if (edges_seen(4, static_cast<Quad>(x), static_cast<Quad>(y), 15) == edges_expected(4, x, y, 15, one)) {
            attitude = one;
        }
    }
    ASSERT_TRUE(attitude);
    // 2^53-fold and 2^52-fold enlargements of order 60, and order 100, where places take more than 64 bits.
    for (const auto& [order, side] : {std::pair(60, 1 << 7), std::pair(60, 1 << 8), std::pair(100, 1 << 6)}) {
        const auto [x, y] = low_corner(order);
        const Whole whole = Whole{1} << order;
        for (const auto& [right, up] :
             {std::pair(whole / 3, whole / 7), std::pair(whole / 2 - side / 2, whole / 2 - side / 2),
              std::pair(Whole{0}, whole - side - 1), std::pair(whole / 5 * 4, whole / 11 * 3)}) {
            const Whole x0 = x + right;
            const Whole y0 = y + up;
            const auto seen = within(edges_seen(order, static_cast<Quad>(x0), static_cast<Quad>(y0), side), side);
            EXPECT_GT(seen.size(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side) / 2);
            EXPECT_EQ(seen == edges_expected(order, x0, y0, side, *attitude), true) << order << " " << side;
        }
    }
}

/// Every Bézier of a drawing.
class BezierSink : public PolygonSink {
public:
    using Bezier = std::array<glm::dvec2, 4>;
    void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
    void lines(std::span<const glm::dvec2>) override { FAIL(); }
    void curves(std::span<const glm::dvec2> controls) override {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            beziers.push_back({at_, controls[i], controls[i + 1], controls[i + 2]});
            at_ = controls[i + 2];
        }
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}

    /// Those that touch a window, moved and rounded so that they can be compared.
    std::multiset<std::array<std::int64_t, 8>> within(glm::dvec2 low, double side, glm::dvec2 origin) const {
        std::multiset<std::array<std::int64_t, 8>> found;
        for (const Bezier& bezier : beziers) {
            Box box;
            for (const glm::dvec2 point : bezier) box.add(point - origin);
            const glm::dvec2 high = low + side;
            if (box.high.x < low.x || box.low.x > high.x || box.high.y < low.y || box.low.y > high.y) continue;
            std::array<std::int64_t, 8> rounded{};
            for (std::size_t i = 0; i < 4; ++i) {
                rounded[2 * i] = std::llround((bezier[i].x - origin.x) * 1e6);
                rounded[2 * i + 1] = std::llround((bezier[i].y - origin.y) * 1e6);
            }
            found.insert(rounded);
        }
        return found;
    }
    std::vector<Bezier> beziers;

private:
    glm::dvec2 at_{0.0};
};

TEST(View, SplinesThroughAWindowAreThoseOfTheWholeDrawing) {
    const std::vector<std::string> patterns = {
        "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 4\n",
        "angle factor: 8\nmove: f\naxiom: -X--X\nX --> XfX--XfX\nderivation length: 4\n",
        "angle increment: 25.7\naxiom: F\nF --> F[+F]F[-F]fF\nderivation length: 4\n",
        "angle factor: 6\naxiom: F++F++F\nF --> F-F++F-F\nderivation length: 4\n",
    };
    for (const std::string& pattern : patterns) {
        const Grammar grammar = grammar_of(pattern);
        StrokeCensus census;
        derive(grammar, *Turtle::drawing(grammar, census, true), {.interpreted = true});
        BezierSink whole;
        SplineSink spline(whole, census.closed);
        derive(grammar, *Turtle::drawing(grammar, spline, true), {.interpreted = true});
        const auto folded = fold(grammar);
        Box box;
        for (const glm::dvec2 corner : folded.value().box_hull) box.add(corner);
        const glm::dvec2 size = box.high - box.low;
        std::size_t compared = 0;
        // Around the beginning, and here and there; the last sees all.
        for (const glm::dvec2 middle :
             {glm::dvec2(0, 0), box.low + 0.3 * size, box.low + 0.5 * size, box.low + glm::dvec2(0.7, 0.2) * size,
              box.low + glm::dvec2(0.1, 0.9) * size}) {
            for (const double side : {3.5, 9.25, 3 * std::max(size.x, size.y)}) {
                SCOPED_TRACE(fmt::format("{} {} {} {}", pattern, middle.x, middle.y, side));
                const glm::dvec2 low = middle - glm::dvec2(side / 2 + 0.123, side / 2 - 0.217);
                const auto view =
                    View::make(grammar,
                               ViewWindow{static_cast<Quad>(low.x), static_cast<Quad>(low.y),
                                          static_cast<Quad>(low.x + side), static_cast<Quad>(low.y + side)},
                               true);
                ASSERT_TRUE(view);
                Sight sight;
                sight.box.add(glm::dvec2(-6));
                sight.box.add(glm::dvec2(side + 6));
                BezierSink seen;
                SplinePieces pieces(seen, 1e-6);
                view->read(sight, pieces, 1e7, {});
                const auto expected = whole.within({0, 0}, side, low);
                compared += expected.size();
                EXPECT_TRUE(seen.within({0, 0}, side, {0, 0}) == expected);
            }
        }
        EXPECT_GT(compared, whole.beziers.size());
    }
}

TEST(View, WindowsOfOtherAnglesAreWhereTheyShouldBe) {
    // Koch's curve of order 19 is 3^19 steps wide. The place of a step follows from its number in base 4, in whole
    // numbers a + b w, w = exp(i pi / 3).
    const int order = 19;
    const Grammar grammar = grammar_of(fmt::format(
        "angle factor: 6\nturn: left\nheading: 0\naxiom: F\nF --> F+F--F+F\nderivation length: {}\n", order));
    const Quad height = static_cast<Quad>(std::sqrt(0.75L));
    std::uint64_t number = 88172645463325252U;
    for (int i = 0; i < 20; ++i) {
        number ^= number << 13;
        number ^= number >> 7;
        number ^= number << 17;
        std::int64_t a = 0, b = 0;
        int heading = 0;  // in sixths
        std::int64_t length = 1;
        for (int level = 1; level < order; ++level) length *= 3;
        const auto go = [&](int direction, std::int64_t far) {
            constexpr std::array<std::array<int, 2>, 6> way = {{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
            a += way[static_cast<std::size_t>((direction + 6) % 6)][0] * far;
            b += way[static_cast<std::size_t>((direction + 6) % 6)][1] * far;
        };
        for (int level = 0; level < order; ++level) {
            const auto digit = (number >> (2 * level)) & 3U;
            constexpr std::array<int, 4> turned = {0, 1, -1, 0};
            for (std::uint64_t k = 0; k < digit; ++k) go(heading + turned[k], length);
            heading = (heading + turned[digit] + 6) % 6;
            length /= 3;
        }
        const Quad x = static_cast<Quad>(a) + static_cast<Quad>(b) / 2;
        const Quad y = static_cast<Quad>(b) * height;
        const std::int64_t a0 = a;
        const std::int64_t b0 = b;
        go(heading, 1);
        const glm::dvec2 step{static_cast<double>(a - a0) + static_cast<double>(b - b0) / 2,
                              static_cast<double>(b - b0) * std::sqrt(0.75)};

        const auto view = View::make(grammar, ViewWindow{x - 1, y - 1, x + 1, y + 1});
        ASSERT_TRUE(view);
        Sight sight;
        sight.box.add({0, 0});
        sight.box.add({2, 2});
        class Nearest : public WithoutStrokes<BlotSink> {
        public:
            explicit Nearest(glm::dvec2 end) : end_(end) {}
            void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
            void lines(std::span<const glm::dvec2> ends) override {
                for (const glm::dvec2 end : ends) {
                    off = std::min(off, std::max(glm::length(at_ - glm::dvec2(1)), glm::length(end - end_)));
                    at_ = end;
                }
            }
            void polygon(std::span<const glm::dvec2>, const Pen&) override {}
            void disc(glm::dvec2, double, const Pen&) override {}
            std::size_t prepare(const Blot&, const Pen&) override { return 0; }
            void blot(std::size_t, glm::dvec2) override {}
            double off = 1e300;

        private:
            glm::dvec2 end_;
            glm::dvec2 at_{0.0};
        } nearest(glm::dvec2(1) + step);
        view->read(sight, nearest, 1e6, {});
        // A hundredth of a pixel where the window is ten thousand pixels wide.
        EXPECT_LT(nearest.off, 2.0 / 10'000 / 100);
    }
}

TEST(View, ReadsWindows) {
    const auto window = parse_window("-1152921504606846975, 0.5,-1152921504606846974.25,1152921504606846976");
    ASSERT_TRUE(window);
    Quad far = 1;
    for (int i = 0; i < 60; ++i) far *= 2;
    EXPECT_TRUE(window->x0 == 1 - far);
    EXPECT_TRUE(window->y0 == Quad(0.5));
    EXPECT_TRUE(window->x1 == Quad(2.75) - far - 1);
    EXPECT_TRUE(window->y1 == far);
    for (const char* bad : {"", "1,2,3", "1,2,3,4,5", "1,2,1,4", "3,2,1,4", "a,2,3,4", "1,,3,4", "1e3,2,3,4",
                            "nan,1,2,3", "1.2.3,0,5,5", "-,0,1,1", ".,0,1,1"}) {
        EXPECT_FALSE(parse_window(bad)) << bad;
    }
}

struct Picture {
    std::string pixels;  ///< black on white
    ViewReport report;
};

/// @param pen  width in pixels, or below 0 the part of a step
/// @param look  through a view, else read in full
Picture picture_of(const Grammar& grammar, int side, double pen, bool look) {
    constexpr double pixel = 25.4 / 300;
    Print print;
    print.page = {side * pixel, side * pixel, 0};
    print.style.palette = {Colour{0, 0, 0, 255}};
    print.style.ground = Colour{255, 255, 255, 255};
    print.style.stroke = pen > 0 ? StrokeWidth{pen * pixel, false} : StrokeWidth{-pen, true};
    Box box;
    const auto folded = fold(grammar);
    for (const glm::dvec2 corner : folded.value().ink_hull) box.add(corner);
    print.placement = place(box, print.page, {}, pen < 0 ? -pen / 2 : 0, pen > 0 ? pen * pixel / 2 : 0);
    const double step = print.placement.step / pixel;
    const double width = pen > 0 ? pen : -pen * step;
    const auto raster = make_raster(print);
    raster->expect({});
    Picture picture;
    if (look) {
        const auto view = View::make(grammar, std::nullopt);
        Sight sight;
        sight.box.add(box.low - glm::dvec2(width / step + 1));
        sight.box.add(box.high + glm::dvec2(width / step + 1));
        (width < 1 ? sight.blot : sight.chord) = (width < 1 ? 0.5 : width / 4) / step;
        sight.least = (width < 1 ? 1e-5 / width : width / 256) / step;
        picture.report = view->read(sight, *raster, 1e9, {});
    } else {
        const auto turtle = Turtle::drawing(grammar, *raster, false);
        derive(grammar, *turtle, {.interpreted = true});
    }
    raster->render(
        1, [&](int, int, std::span<const std::uint8_t> rows) { picture.pixels.append(rows.begin(), rows.end()); });
    EXPECT_EQ(picture.pixels.size(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    return picture;
}

struct Errors {
    double pixel = 0;  ///< mean absolute difference of 255 over pixels with ink
    double block = 0;  ///< the same of means of 8 x 8
    double bias = 0;
};

Errors errors_of(const std::string& full, const std::string& seen, int side) {
    Errors errors;
    const auto at = [&](const std::string& pixels, int x, int y) {
        return static_cast<int>(static_cast<std::uint8_t>(pixels[static_cast<std::size_t>(y * side + x)]));
    };
    double inked = 0;
    double blocks = 0;
    for (int y = 0; y + 8 <= side; y += 8) {
        for (int x = 0; x + 8 <= side; x += 8) {
            int sum = 0;
            bool has_ink = false;
            for (int i = 0; i < 64; ++i) {
                const int a = at(full, x + i % 8, y + i / 8);
                const int b = at(seen, x + i % 8, y + i / 8);
                sum += b - a;
                if (a == 255 && b == 255) continue;
                has_ink = true;
                inked += 1;
                errors.pixel += std::abs(b - a);
            }
            if (!has_ink) continue;
            blocks += 1;
            errors.block += std::abs(sum) / 64.0;
            errors.bias += sum / 64.0;
        }
    }
    errors.pixel /= inked;
    errors.block /= blocks;
    errors.bias /= blocks;
    return errors;
}

struct Case {
    const char* name;
    std::string pattern;
    int side;
    double pen;
    double most_pixel, most_block;
};

TEST(View, SmallPartsLookAsTheyWouldIfTheyWereDrawn) {
    const std::string dragon = "axiom: FX\nX --> X+YF+\nY --> -FX-Y\nderivation length: ";
    const std::string koch = "axiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\nderivation length: ";
    const std::string plant = "axiom: F\nangle increment: 25.7\nF --> F[+F]F[-F]F\nderivation length: ";
    const std::vector<Case> cases = {
        {"Hilbert, a pen of the step", hilbert + "10\n", 333, -0.3, 5, 0.5},
        {"Hilbert, finer", hilbert + "11\n", 301, -0.3, 2.1, 0.5},
        {"Hilbert, 0.4 px", hilbert + "11\n", 417, 0.4, 5, 0.5},
        {"Hilbert, 2 px", hilbert + "11\n", 417, 2, 0.5, 0.5},
        {"Hilbert, 3 px", hilbert + "10\n", 417, 3, 0.5, 0.5},
        {"dragon, a pen of the step", dragon + "20\n", 333, -0.3, 5, 0.5},
        {"dragon, 3 px", dragon + "19\n", 333, 3, 2, 2},
        {"Koch island, a pen of the step", koch + "6\n", 777, -0.3, 5, 0.5},
        {"Koch island, 4 px", koch + "6\n", 777, 4, 2, 2},
        {"plant, a pen of the step", plant + "8\n", 555, -0.3, 5, 0.5},
        {"plant, 2 px", plant + "8\n", 555, 2, 2, 2},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        const Grammar grammar = grammar_of(one.pattern);
        const Picture full = picture_of(grammar, one.side, one.pen, false);
        const Picture seen = picture_of(grammar, one.side, one.pen, true);
        EXPECT_GT(seen.report.blots + seen.report.chords, 1000u) << "nothing was replaced";
        const Errors errors = errors_of(full.pixels, seen.pixels, one.side);
        EXPECT_LE(errors.pixel, one.most_pixel);
        EXPECT_LE(errors.block, one.most_block);
        if (one.pen < 1) {
            EXPECT_LE(std::fabs(errors.bias), 0.1);
        }
        if (std::getenv("SIKKU_TELL")) {
            fmt::print("{}: visited {}, pixel {:.3f}, block {:.3f}, bias {:.3f}\n", one.name, seen.report.visited,
                       errors.pixel, errors.block, errors.bias);
        }
    }
}

TEST(View, CostsWhatIsSeen) {
    // Twice the order, the same picture: as many nodes.
    std::array<std::uint64_t, 2> visited{};
    for (const int i : {0, 1}) {
        const Grammar grammar = grammar_of(hilbert + (i == 0 ? "30\n" : "60\n"));
        visited[static_cast<std::size_t>(i)] = picture_of(grammar, 200, 0.8, true).report.visited;
    }
    EXPECT_NEAR(static_cast<double>(visited[0]), static_cast<double>(visited[1]),
                0.1 * static_cast<double>(visited[0]));
    EXPECT_LT(visited[1], 3'000'000u);
    const Grammar grammar = grammar_of(hilbert + "60\n");
    const auto view = View::make(grammar, std::nullopt);
    Sight sight;
    sight.box.add({-2e18, -2e18});
    sight.box.add({2e18, 2e18});
    EdgeSink sink;
    EXPECT_THROW(view->read(sight, sink, 1e5, {}), BudgetError);
}

}  // namespace sikku::view_test
