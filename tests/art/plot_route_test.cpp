#include "art/plotter/plot_route.h"

#include "engine/base/threads.h"
#include "engine/geometry/curve_tree.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::plot_route_test {

using Points = std::vector<glm::dvec2>;

/// Strokes without common points, as a graph.
struct Drawing {
    explicit Drawing(const std::vector<Points>& lines) {
        for (const Points& line : lines) {
            const bool is_closed = line.front() == line.back() && line.size() > 2;
            const auto begin = static_cast<std::uint32_t>(graph.segments.size());
            const auto first = static_cast<std::uint32_t>(graph.points.size());
            graph.points.insert(graph.points.end(), line.begin(), line.end() - (is_closed ? 1 : 0));
            for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
                const bool returns = is_closed && i + 2 == line.size();
                given.order.push_back(2 * static_cast<PlotEnd>(graph.segments.size()));
                graph.segments.push_back({first + i, returns ? first : first + i + 1});
            }
            given.strokes.push_back({begin, static_cast<std::uint32_t>(line.size() - 1), is_closed});
        }
    }
    double travel(const PlotStrokes& strokes) const {
        double sum = 0;
        glm::dvec2 at(0.0);
        for (const PlotStroke& stroke : strokes.strokes) {
            const auto ends = strokes.ends(stroke);
            sum += glm::distance(at, graph.point(ends.front()));
            at = graph.point(ends.back() ^ 1U);
        }
        return sum;
    }
    PlotStrokes sorted() const { return sort_strokes(graph, given, {0, 0}, false, travel(given)); }

    /// Travel of a walk that always goes to the nearest end or corner, found by exhaustive search.
    double nearest_first() const {
        std::vector<bool> done(given.strokes.size());
        double sum = 0;
        glm::dvec2 at(0.0);
        for (std::size_t step = 0; step < done.size(); ++step) {
            double least = std::numeric_limits<double>::infinity();
            std::size_t next = 0;
            glm::dvec2 leave(0.0);
            const auto consider = [&](std::size_t i, PlotEnd enter, PlotEnd other) {
                if (const double way = glm::distance(at, graph.point(enter)); way < least) {
                    least = way;
                    next = i;
                    leave = graph.point(other);
                }
            };
            for (std::size_t i = 0; i < done.size(); ++i) {
                if (done[i]) continue;
                const auto ends = given.ends(given.strokes[i]);
                if (given.strokes[i].closed) {
                    for (const PlotEnd end : ends) consider(i, end, end);
                } else {
                    consider(i, ends.front(), ends.back() ^ 1U);
                    consider(i, ends.back() ^ 1U, ends.front());
                }
            }
            done[next] = true;
            sum += least;
            at = leave;
        }
        return sum;
    }

    PlotGraph graph;
    PlotStrokes given;
};

/// Lines of up to `length` along each axis, every third one closed if wanted.
std::vector<Points> scattered(std::size_t count, double length, bool closed, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(0.0, 100.0);
    std::uniform_real_distribution<double> near(-length, length);
    const auto vector = [&](auto& distribution) {
        const double x = distribution(random);
        return glm::dvec2(x, distribution(random));
    };
    std::vector<Points> lines;
    for (std::size_t i = 0; i < count; ++i) {
        Points& line = lines.emplace_back();
        line.push_back(vector(anywhere));
        line.push_back(line[0] + vector(near));
        if (!closed || i % 3 != 0) continue;
        line.push_back(line[0] + vector(near));
        line.push_back(line[0]);
    }
    return lines;
}

/// Short strokes in rows, or squares, in random order.
std::vector<Points> in_rows(int side, bool squares) {
    std::vector<Points> lines;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::dvec2 at(x, y);
            lines.push_back({at, at + glm::dvec2(0.6, 0.0)});
            if (!squares) continue;
            for (const glm::dvec2 corner : {glm::dvec2(0.6, 0.6), {0.0, 0.6}, {0.0, 0.0}}) {
                lines.back().push_back(at + corner);
            }
        }
    }
    std::shuffle(lines.begin(), lines.end(), std::mt19937(1));
    return lines;
}

/// Discs hatched in different directions.
std::vector<Points> hatched(int discs) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> anywhere(0.0, 100.0);
    std::vector<Points> lines;
    for (int i = 0; i < discs; ++i) {
        const double x = anywhere(random);
        const glm::dvec2 centre(x, anywhere(random));
        const double angle = anywhere(random);
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        for (double high = -2.9; high < 3; high += 0.2) {
            const glm::dvec2 middle = centre + high * glm::dvec2(-along.y, along.x);
            const double half = std::sqrt(9 - high * high);
            lines.push_back({middle - half * along, middle + half * along});
        }
    }
    return lines;
}

void expect_all_strokes(const Drawing& drawing, const PlotStrokes& sorted) {
    // Each stroke as its lowest segment, its length and its kind.
    const auto kinds = [](const PlotStrokes& strokes) {
        std::vector<std::tuple<std::uint32_t, std::uint32_t, bool>> list;
        for (const PlotStroke& stroke : strokes.strokes) {
            std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
            for (const PlotEnd end : strokes.ends(stroke)) least = std::min(least, end / 2);
            list.emplace_back(least, stroke.count, stroke.closed);
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    EXPECT_EQ(kinds(sorted), kinds(drawing.given));
    for (const PlotStroke& stroke : sorted.strokes) {
        const auto ends = sorted.ends(stroke);
        for (std::size_t i = 1; i < ends.size(); ++i) {
            EXPECT_EQ(drawing.graph.point(ends[i - 1] ^ 1U), drawing.graph.point(ends[i]));
        }
        if (stroke.closed) {
            EXPECT_EQ(drawing.graph.point(ends.front()), drawing.graph.point(ends.back() ^ 1U));
        }
    }
}

TEST(PlotRoute, IsMuchShorterThanAlwaysGoingToTheNearest) {
    const auto examine = [](const std::vector<Points>& lines, double most) {
        const Drawing drawing(lines);
        const PlotStrokes sorted = drawing.sorted();
        expect_all_strokes(drawing, sorted);
        const double nearest = drawing.nearest_first();
        EXPECT_LT(drawing.travel(sorted), most * nearest) << lines.size() << " strokes";
    };
    examine(scattered(2000, 0.01, false, 1), 0.87);
    examine(scattered(2000, 3.0, false, 2), 0.87);
    examine(scattered(800, 50.0, false, 3), 0.80);
    examine(scattered(2000, 3.0, true, 4), 0.90);
    examine(in_rows(40, true), 1.0);
    examine(hatched(60), 0.97);
    // These are perfect: each stroke begins where the nearest one ends.
    examine(in_rows(40, false), 1 + 1e-9);
}

/// Strokes in rows, numbered at random.
std::vector<Points> dashes(int side) {
    std::vector<Points> lines;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) lines.push_back({{x + 0.2, y}, {x + 0.8, y}});
    }
    std::shuffle(lines.begin(), lines.end(), std::mt19937(3));
    return lines;
}

TEST(PlotRoute, OfManyStrokesIsShortWhetherTheyAreRegularOrNot) {
    const auto examine = [](const std::vector<Points>& lines, double most) {
        const Drawing drawing(lines);
        const PlotStrokes sorted = drawing.sorted();
        expect_all_strokes(drawing, sorted);
        EXPECT_LT(drawing.travel(sorted), most) << lines.size() << " strokes";
    };
    // The shortest tour of n points scattered over an area A takes about 0.7124 sqrt(nA) (Johnson & McGeoch 1996);
    // strokes of almost no length are such points.
    constexpr int scattered_points = 30'000;
    examine(scattered(scattered_points, 1e-6, false, 6), 1.09 * 0.7124 * std::sqrt(scattered_points) * 100);
    // Travels within rows, and from row to row.
    examine(dashes(150), 1.03 * (150 * 149 * 0.4 + 149 * 1.0));
    examine(dashes(100), 1.03 * (100 * 99 * 0.4 + 99 * 1.0));
}

TEST(PlotRoute, IsTheShortestOfFewStrokes) {
    int longer = 0;
    constexpr int drawings = 60;
    for (std::uint32_t seed = 0; seed < drawings; ++seed) {
        const Drawing drawing(scattered(1 + seed % 6, seed % 2 == 0 ? 5.0 : 60.0, false, seed));
        const std::size_t count = drawing.given.strokes.size();
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t{0});
        double least = std::numeric_limits<double>::infinity();
        do {
            for (unsigned turned = 0; turned < 1U << count; ++turned) {
                double sum = 0;
                glm::dvec2 at(0.0);
                for (const std::size_t i : order) {
                    const PlotEnd end = drawing.given.order[i] ^ (turned >> i & 1U);
                    sum += glm::distance(at, drawing.graph.point(end));
                    at = drawing.graph.point(end ^ 1U);
                }
                least = std::min(least, sum);
            }
        } while (std::next_permutation(order.begin(), order.end()));
        const double found = drawing.travel(drawing.sorted());
        EXPECT_GE(found, least - 1e-9);
        EXPECT_LE(found, 1.1 * least);
        longer += found > least + 1e-9 ? 1 : 0;
    }
    EXPECT_LE(longer, 3);
}

TEST(PlotRoute, IsTheSameForAnyNumberOfThreads) {
    const Drawing drawing(scattered(60'000, 0.3, true, 5));
    std::vector<PlotEnd> first;
    for (const int threads : {1, 2, 3}) {
        on_threads(threads, [&] {
            const PlotStrokes sorted = drawing.sorted();
            if (first.empty()) {
                expect_all_strokes(drawing, sorted);
                first = sorted.order;
            }
            EXPECT_EQ(sorted.order, first) << threads << " threads";
        });
    }
}

TEST(CurveTree, FindsTheNearestOfOtherOwners) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto coordinate = [&](int kind) {
        if (kind == 0) return 100 * normal(random);
        if (kind == 1) return std::round(3 * normal(random));  // many are equal
        return std::pow(10.0, 8 * normal(random));             // clusters of clusters
    };
    for (int kind = 0; kind < 3; ++kind) {
        for (const std::uint32_t count : {1U, 2U, 7U, 9U, 70U, 700U}) {
            Points points;
            for (std::uint32_t i = 0; i < count; ++i) {
                const double x = coordinate(kind);
                points.emplace_back(x, coordinate(kind));
            }
            const auto owner = [](std::uint32_t i) { return i / 3; };
            const auto rank = [&](std::uint32_t i) { return count - i; };
            CurveTree tree(points, owner, rank);
            const auto by_distance = [&](glm::dvec2 from, const auto& takes) {
                std::vector<std::uint32_t> list;
                for (std::uint32_t i = 0; i < count; ++i) {
                    if (takes(i)) list.push_back(i);
                }
                const auto key = [&](std::uint32_t i) {
                    const glm::dvec2 gap = points[i] - from;
                    return std::pair(gap.x * gap.x + gap.y * gap.y, rank(i));
                };
                std::sort(list.begin(), list.end(), [&](auto a, auto b) { return key(a) < key(b); });
                return list;
            };
            std::uint32_t seen = 0;
            tree.nearest_of_each<5>(0, count, [&](std::uint32_t i, const auto& found) {
                auto expected = by_distance(points[i], [&](std::uint32_t k) { return owner(k) != owner(i); });
                expected.resize(5, CurveTree::none);
                EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin())) << kind << " " << count;
                ++seen;
            });
            EXPECT_EQ(seen, count);
            // Removes them one by one.
            std::vector<char> there(count, 1);
            for (std::uint32_t left = count; left > 0; --left) {
                const glm::dvec2 from(coordinate(kind), 1.0);
                const auto list = by_distance(from, [&](std::uint32_t k) { return there[k] != 0; });
                ASSERT_EQ(tree.nearest(from, left - 1), list.front());
                const std::uint32_t removed = list[random() % list.size()];
                tree.remove(removed);
                there[removed] = 0;
                EXPECT_FALSE(tree.is_there(removed));
            }
            EXPECT_EQ(tree.nearest({0, 0}, 0), CurveTree::none);
        }
    }
}

}  // namespace sikku::plot_route_test
