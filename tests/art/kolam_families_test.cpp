// tests/art/kolam_families_test.cpp: compares kolams of polynomial growth with mirror curves traced around their
// dots.
#include "engine/measure/extent.h"
#include "engine/measure/fold.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::kolam_families_test {

// Dots lie on whole numbers. Nodes, where strands cross or turn back, lie between neighbouring dots and are counted
// in halves: a dot (x, y) has the nodes (2x + 1, 2y), (2x, 2y + 1), (2x - 1, 2y), (2x, 2y - 1). A strand runs from
// node to node, one step each, always at 45 degrees.

struct Point {
    int x = 0;
    int y = 0;
    auto operator<=>(const Point&) const = default;
};
using Edge = std::pair<Point, Point>;  // in order

Edge edge(Point a, Point b) {
    return a < b ? Edge{a, b} : Edge{b, a};
}

/// Dots, and the gaps between neighbouring dots that no strand passes.
struct Arrangement {
    std::set<Point> dots;
    std::set<Point> kept_apart;
};

constexpr std::array<Point, 4> around = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

Point node_of(Point dot, int side) {
    const Point& way = around[static_cast<std::size_t>(side & 3)];
    return {2 * dot.x + way.x, 2 * dot.y + way.y};
}
Point neighbour(Point dot, int side) {
    const Point& way = around[static_cast<std::size_t>(side & 3)];
    return {dot.x + way.x, dot.y + way.y};
}
bool is_crossed(const Arrangement& arrangement, Point dot, int side) {
    return arrangement.dots.contains(neighbour(dot, side)) && !arrangement.kept_apart.contains(node_of(dot, side));
}

/// The lines around the dots as lists of nodes: a strand goes on around the dot that it is at, and over to the next
/// where the gap is crossed.
std::vector<std::vector<Point>> traced(const Arrangement& arrangement) {
    std::vector<std::vector<Point>> lines;
    std::set<Edge> seen;
    for (const Point& first : arrangement.dots) {
        for (int side = 0; side < 4; ++side) {
            if (seen.contains(edge(node_of(first, side), node_of(first, side + 1)))) continue;
            std::vector<Point> line;
            Point dot = first;
            int at = side;
            int sense = 1;
            while (seen.insert(edge(node_of(dot, at), node_of(dot, at + sense))).second) {
                line.push_back(node_of(dot, at));
                at = (at + sense) & 3;
                if (is_crossed(arrangement, dot, at)) {
                    dot = neighbour(dot, at);
                    at = (at + 2) & 3;
                    sense = -sense;
                }
            }
            lines.push_back(line);
        }
    }
    return lines;
}

/// The number of lines without tracing any: the nullity over GF(2) of the Laplacian of the graph of dots whose edges
/// are the gaps that are crossed.
std::size_t lines_by_nullity(const Arrangement& arrangement) {
    std::map<Point, std::size_t> index;
    for (const Point& dot : arrangement.dots) index.emplace(dot, index.size());
    const std::size_t count = index.size();
    std::vector<std::vector<char>> matrix(count, std::vector<char>(count, 0));
    for (const auto& [dot, row] : index) {
        for (int side = 0; side < 4; ++side) {
            if (!is_crossed(arrangement, dot, side)) continue;
            matrix[row][row] ^= 1;
            matrix[row][index.at(neighbour(dot, side))] ^= 1;
        }
    }
    std::size_t rank = 0;
    for (std::size_t column = 0; column < count; ++column) {
        std::size_t pivot = rank;
        while (pivot < count && matrix[pivot][column] == 0) ++pivot;
        if (pivot == count) continue;
        std::swap(matrix[pivot], matrix[rank]);
        for (std::size_t row = rank + 1; row < count; ++row) {
            if (matrix[row][column] == 0) continue;
            for (std::size_t k = column; k < count; ++k) matrix[row][k] ^= matrix[rank][k];
        }
        ++rank;
    }
    return count - rank;
}

// --- the arrangements ----------------------------------------------------------------------------------------------

/// Puts `count` dots, an even number, in a row, x = -count / 2 + 1 to count / 2.
void add_row(Arrangement& arrangement, int count, int y) {
    for (int x = -count / 2 + 1; x <= count / 2; ++x) arrangement.dots.insert({x, y});
}
/// Keeps the dots of a row apart but for the pairs, the first of which begins at its left end.
void keep_in_pairs(Arrangement& arrangement, int count, int y) {
    for (int x = -count / 2 + 2; x < count / 2; x += 2) arrangement.kept_apart.insert({2 * x + 1, 2 * y});
}

/// Rows of 2, 4, ... 2n + 4, the last in pairs.
Arrangement mountain(int n) {
    Arrangement result;
    const int rows = n + 2;
    for (int i = 0; i < rows; ++i) add_row(result, 2 * (rows - i), i);
    keep_in_pairs(result, 2 * rows, 0);
    return result;
}

/// A square on its corner, a neck, a funnel and a foot. The two columns beside the axis are in pairs as well.
Arrangement kooja(int n) {
    Arrangement result;
    const int m = 2 * n + 4;
    for (int i = 0; i < m; ++i) {
        add_row(result, 2 * (m - i), 1 + i);
        add_row(result, 2 * (m - i), -i);
    }
    for (int y = -m + 2; y < m; y += 2) {
        result.kept_apart.insert({2, 2 * y + 1});
        result.kept_apart.insert({0, 2 * y + 1});
    }
    add_row(result, 2, m + 1);
    add_row(result, 2, m + 2);
    for (int i = 1; i <= n + 3; ++i) add_row(result, 2 * i, m + 2 + i);
    keep_in_pairs(result, 2 * (n + 3), m + 2 + n + 3);
    add_row(result, 2 * (n + 2), -m);
    result.kept_apart.insert({1, -2 * m});
    return result;
}

/// Two bands of four dots across that cross at right angles, each with a ring at its lower end; every gap is crossed.
Arrangement scissors(int n) {
    Arrangement result;
    const auto is_hole = [](int x, int y) {
        return std::abs(x) <= 2 && std::abs(y) <= 2 && std::abs(x) + std::abs(y) <= 3;
    };
    const auto is_ring = [](int x, int y) {
        return std::abs(x) <= 3 && std::abs(y) <= 3 && std::abs(x) + std::abs(y) <= 5;
    };
    for (int x = -12; x <= n + 8; ++x) {
        for (int y = -12; y <= n + 8; ++y) {
            const bool is_blade = x - y >= -2 && x - y <= 1 && x + y >= -8 && x + y <= 8 + 2 * n;
            if ((is_blade || is_ring(x + 6, y + 7)) && !is_hole(x + 6, y + 7)) {
                result.dots.insert({x, y});
                result.dots.insert({-1 - x, y});
            }
        }
    }
    return result;
}

struct Family {
    std::string file;
    Arrangement (*arrangement)(int n);
    std::array<std::int64_t, 3> steps;    ///< coefficients of 1, n, n^2
    std::array<std::int64_t, 2> kissing;  ///< nodes where two strands turn back at each other, of 1, n
};
std::vector<Family> families() {
    return {{"mountain-kolam", mountain, {24, 20, 4}, {1, 1}},
            {"kooja-kolam", kooja, {240, 180, 36}, {9, 5}},
            {"scissors", scissors, {424, 32, 0}, {0, 0}}};
}
std::int64_t value(const std::array<std::int64_t, 3>& c, std::int64_t n) {
    return c[0] + n * (c[1] + n * c[2]);
}

Grammar grammar_of(const Family& family, std::int64_t n) {
    const std::filesystem::path file =
        std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / "kolams" / (family.file + ".lsys");
    return reference::grammar_of(contents(file), {{"-n", "derivation length", std::to_string(n)}});
}

/// The nodes that the turtle visits, from (0, 0), the last equal to the first if the line is closed.
std::vector<Point> walked(const Grammar& grammar) {
    constexpr std::array<Point, 4> ways = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};  // 45, 135, 225, 315 degrees
    int way = static_cast<int>(std::lround((grammar.heading().degrees - 45.0) / 90.0)) & 3;
    EXPECT_EQ(std::fmod(grammar.heading().degrees, 90.0), 45.0);
    std::vector<Point> nodes = {{}};
    for (const char symbol : reference::derived_text(grammar, true)) {
        if (symbol == '+') way = (way + 3) & 3;
        if (symbol == '-') way = (way + 1) & 3;
        if (symbol != 'f') continue;
        const Point& step = ways[static_cast<std::size_t>(way)];
        nodes.push_back({nodes.back().x + step.x, nodes.back().y + step.y});
    }
    return nodes;
}

/// Edges with the lowest and leftmost node on the axes.
std::set<Edge> edges_of(const std::vector<Point>& nodes) {
    Point low = nodes.front();
    for (const Point& node : nodes) low = {std::min(low.x, node.x), std::min(low.y, node.y)};
    std::set<Edge> edges;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Point& a = nodes[i];
        const Point& b = nodes[(i + 1) % nodes.size()];
        if (a != b) edges.insert(edge({a.x - low.x, a.y - low.y}, {b.x - low.x, b.y - low.y}));
    }
    return edges;
}

class KolamFamilies : public ::testing::TestWithParam<Family> {};

TEST_P(KolamFamilies, AreOneClosedLineWithCleanCrossings) {
    for (int n = 0; n <= 12; ++n) {
        const std::vector<Point> nodes = walked(grammar_of(GetParam(), n));
        ASSERT_EQ(nodes.front(), nodes.back()) << n;
        const std::size_t steps = nodes.size() - 1;
        ASSERT_EQ(static_cast<std::int64_t>(steps), value(GetParam().steps, n)) << n;
        EXPECT_EQ(edges_of(nodes).size(), steps) << n << ": an edge is walked twice";

        struct Visit {
            Point in, out;
            bool is_straight() const { return in == out; }
        };
        std::map<Point, std::vector<Visit>> visits;
        for (std::size_t i = 0; i < steps; ++i) {
            const Point& before = nodes[i == 0 ? steps - 1 : i - 1];
            const Point& here = nodes[i];
            const Point& after = nodes[i + 1];
            visits[here].push_back({{here.x - before.x, here.y - before.y}, {after.x - here.x, after.y - here.y}});
        }
        std::int64_t kissing = 0;
        for (const auto& [node, list] : visits) {
            ASSERT_LE(list.size(), 2u) << n << ": " << node.x << ' ' << node.y;
            if (list.size() == 1) {
                EXPECT_FALSE(list[0].is_straight()) << n << ": a strand passes where no dots are";
                continue;
            }
            ASSERT_EQ(list[0].is_straight(), list[1].is_straight()) << n;
            if (list[0].is_straight()) {
                EXPECT_EQ(list[0].in.x * list[1].in.x + list[0].in.y * list[1].in.y, 0) << n;
                continue;
            }
            // Both turn by a right angle, away from each other: the bends point to opposite sides.
            ++kissing;
            for (const Visit& visit : list) EXPECT_EQ(visit.in.x * visit.out.x + visit.in.y * visit.out.y, 0) << n;
            EXPECT_EQ(list[0].in.x - list[0].out.x, list[1].out.x - list[1].in.x) << n;
            EXPECT_EQ(list[0].in.y - list[0].out.y, list[1].out.y - list[1].in.y) << n;
        }
        EXPECT_EQ(kissing, GetParam().kissing[0] + n * GetParam().kissing[1]) << n;
    }
}

TEST_P(KolamFamilies, AreTheMirrorCurvesAroundTheirDots) {
    for (int n = 0; n <= 12; ++n) {
        const Arrangement arrangement = GetParam().arrangement(n);
        const auto lines = traced(arrangement);
        ASSERT_EQ(lines.size(), 1u) << n;
        EXPECT_EQ(lines[0].size(), 4 * arrangement.dots.size()) << n;
        EXPECT_EQ(edges_of(walked(grammar_of(GetParam(), n))), edges_of(lines[0])) << n;
        if (n <= 4) {
            EXPECT_EQ(lines_by_nullity(arrangement), 1u) << n;
        }
    }
}

TEST_P(KolamFamilies, AreSymmetric) {
    for (int n = 0; n <= 12; ++n) {
        const std::vector<Point> nodes = walked(grammar_of(GetParam(), n));
        std::vector<Point> mirrored;
        for (const Point& node : nodes) mirrored.push_back({-node.x, node.y});
        EXPECT_EQ(edges_of(nodes), edges_of(mirrored)) << n;
    }
}

TEST_P(KolamFamilies, AreOneStroke) {
    class Strokes : public PolygonSink {
    public:
        void begin_stroke(glm::dvec2, const Pen&) override { ++begun; }
        void lines(std::span<const glm::dvec2> ends) override { points += ends.size(); }
        void end_stroke(bool is_closed) override { closed += is_closed ? 1 : 0; }
        void polygon(std::span<const glm::dvec2>, const Pen&) override { ADD_FAILURE(); }
        void disc(glm::dvec2, double, const Pen&) override { ADD_FAILURE(); }
        int begun = 0;
        int closed = 0;
        std::size_t points = 0;
    };
    for (int n = 0; n <= 20; ++n) {
        const Grammar grammar = grammar_of(GetParam(), n);
        Strokes strokes;
        const auto turtle = Turtle::drawing(grammar, strokes, true);
        derive(grammar, *turtle, {.interpreted = true});
        EXPECT_EQ(strokes.begun, 1) << n;
        EXPECT_EQ(strokes.closed, 1) << n;
        EXPECT_EQ(static_cast<std::int64_t>(strokes.points), value(GetParam().steps, n)) << n;
    }
}

TEST_P(KolamFamilies, GrowPolynomially) {
    // The fold tells without deriving; differences of the third order vanish, those of the second are constant.
    std::vector<double> steps;
    std::vector<double> width;
    std::vector<double> height;
    for (int n = 0; n <= 20; ++n) {
        const Measurement measured = measure(grammar_of(GetParam(), n), 1e7);
        EXPECT_FALSE(measured.derived);
        EXPECT_EQ(measured.moves.value, static_cast<double>(value(GetParam().steps, n))) << n;
        ASSERT_TRUE(measured.geometry);
        EXPECT_TRUE(measured.geometry->closed) << n;
        steps.push_back(measured.moves.value);
        width.push_back(measured.geometry->box[2].value - measured.geometry->box[0].value);
        height.push_back(measured.geometry->box[3].value - measured.geometry->box[1].value);
    }
    const auto differences = [](std::vector<double> values, int order) {
        for (; order > 0; --order) {
            for (std::size_t i = 0; i + 1 < values.size(); ++i) values[i] = values[i + 1] - values[i];
            values.pop_back();
        }
        return values;
    };
    for (const double difference : differences(steps, 2)) {
        EXPECT_EQ(difference, 2.0 * static_cast<double>(GetParam().steps[2]));
    }
    for (const double difference : differences(steps, 3)) EXPECT_EQ(difference, 0.0);
    // The sides of the box grow linearly; those of the scissors once their blades reach beyond their rings.
    const std::size_t from = 6;
    for (auto* side : {&width, &height}) {
        side->erase(side->begin(), side->begin() + from);
        for (const double difference : differences(*side, 2)) EXPECT_NEAR(difference, 0.0, 1e-9);
    }

    const auto far = fold(grammar_of(GetParam(), 1000));
    ASSERT_TRUE(far);
    EXPECT_TRUE(far->closed);
    EXPECT_EQ(measure(grammar_of(GetParam(), 1000), 1e7).moves.value,
              static_cast<double>(value(GetParam().steps, 1000)));
}

std::string name_of(const ::testing::TestParamInfo<Family>& info) {
    return info.param.file.substr(0, info.param.file.find('-'));
}
INSTANTIATE_TEST_SUITE_P(Patterns, KolamFamilies, ::testing::ValuesIn(families()), name_of);

}  // namespace sikku::kolam_families_test
