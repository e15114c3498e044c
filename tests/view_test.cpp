// tests/view_test.cpp: what is seen of drawings too large to be read: edge for edge against another form of the
// curve, and pixel for pixel against drawings read in full.
#include "art/view.h"

#include "art/raster.h"
#include "engine/fold.h"
#include "engine/turtle.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using reference::grammar_of;

__extension__ using Whole = __int128;

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
Whole number_of(int order, Whole x, Whole y) {
    Whole number = 0;
    for (int bit = order - 1; bit >= 0; --bit) {
        const Whole side = Whole{1} << bit;
        const bool right = (x & side) != 0;
        const bool up = (y & side) != 0;
        number += side * side * ((right ? 3 : 0) ^ (up ? 1 : 0));
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
    std::vector<Whole> numbers;
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
                const Whole way = number(x + dx, y + dy) - number(x, y);
                if (way == 1 || way == -1) edges.insert(ordered({x, y}, {x + dx, y + dy}));
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
        picture.report = view->read(sight, *raster, 1e9, {});
    } else {
        const auto turtle = Turtle::drawing(grammar, *raster, false);
        DerivationOptions interpreted;
        interpreted.interpreted = true;
        derive(grammar, *turtle, interpreted);
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

}  // namespace
}  // namespace sikku
