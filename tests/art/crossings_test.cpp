// tests/art/crossings_test.cpp: the number of crossings of outlines, counted pair by pair.
#include "art/relief/crossings.h"
#include "art/prints.h"
#include "engine/derivation/derivation.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace sikku::crossings_test {

std::int64_t cross(Micrometres a, Micrometres b, Micrometres c) {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

/// Compares every pair.
std::size_t slowly_counted(const std::vector<OutlineEdge>& edges) {
    std::size_t count = 0;
    const auto sign = [](std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t k = i + 1; k < edges.size(); ++k) {
            const auto& [a, b] = std::pair(edges[i].from, edges[i].to);
            const auto& [c, d] = std::pair(edges[k].from, edges[k].to);
            if (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 && sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0)
                ++count;
        }
    }
    return count;
}

TEST(Crossings, AreThoseOfAllPairs) {
    std::mt19937 random(1);
    for (const int reach : {300'000, 3'000'000, 200'000'000}) {
        for (const double length : {0.02, 0.3, 1.0}) {
            std::vector<OutlineEdge> edges;
            const auto within = [&](double least, double most) {
                return std::uniform_real_distribution<>(least, most)(random);
            };
            for (int i = 0; i < 400; ++i) {
                const Micrometres from{static_cast<std::int32_t>(within(-reach, reach)),
                                       static_cast<std::int32_t>(within(-reach, reach))};
                const double angle = within(0, 6.3), far = within(0, length * reach);
                edges.push_back({from,
                                 {static_cast<std::int32_t>(from.x + far * std::cos(angle)),
                                  static_cast<std::int32_t>(from.y + far * std::sin(angle))}});
            }
            // Upright and level ones, too.
            for (int i = 0; i < 20; ++i) {
                edges.push_back({{i * (reach / 40), -reach}, {i * (reach / 40), reach}});
                edges.push_back({{-reach, i * (reach / 37) + 1}, {reach, i * (reach / 37) + 1}});
            }
            const std::size_t expected = slowly_counted(edges);
            const std::size_t found = count_crossings(edges, 0, 10'000'000, {});
            // Those at one place are one.
            EXPECT_LE(found, expected);
            EXPECT_GE(static_cast<double>(found), 0.98 * static_cast<double>(expected)) << reach << ' ' << length;
            if (expected > 200) {
                EXPECT_GT(count_crossings(edges, 0, 100, {}), 100u);
            }
        }
    }
}

TEST(Crossings, AFanHasOneCrossing) {
    std::vector<OutlineEdge> edges;
    for (int i = 1; i <= 100; ++i) edges.push_back({{-1000 * i, -1'000'000}, {1000 * i, 1'000'000}});
    EXPECT_EQ(count_crossings(edges, 1.5, 1000, {}), 1u);
    EXPECT_EQ(count_crossings({}, 1.5, 1000, {}), 0u);
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(Relief, TooManyCrossingsAreRefusedAtOnce) {
    // A star of 2,999 lines, each of which crosses a third of the others.
    const Document star = parse("star.lsys",
                                "axiom: X\nderivation length: 2999\nX --> F+X\nangle increment: 122.0906969\n"
                                "stroke: 0.2mm black\n");
    const double start = processor_seconds();
    EXPECT_THROW(draw(star, "stl", {{"relief", "2mm"}, {"size", "A3"}}), BudgetError);
    EXPECT_LT(processor_seconds() - start, sanitized ? 30 : 3) << "a release build takes a third of that";
}

}  // namespace sikku::crossings_test
