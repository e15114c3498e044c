// The densest lattices of convex shapes, against known densities and by a search of our own.
#include "art/print/packing.h"
#include "art/print/repeat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace sikku {
namespace {

using Hull = std::vector<glm::dvec2>;

double area_of(const Hull& hull) {
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 a = hull[i], b = hull[(i + 1) % hull.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::fabs(twice) / 2;
}

double cell_of(const PlaneLattice& lattice) {
    return std::fabs(lattice.across.x * lattice.up.y - lattice.across.y * lattice.up.x);
}

Hull regular(int sides, double turn = 0) {
    Hull hull;
    for (int i = 0; i < sides; ++i) {
        const double angle = turn + 2 * std::numbers::pi * i / sides;
        hull.emplace_back(std::cos(angle), std::sin(angle));
    }
    return hull;
}

/// The distance by which a shape and its copy are apart, negative if they overlap: by the sides of both.
double apart(const Hull& hull, glm::dvec2 step) {
    double most = -1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 side = glm::normalize(hull[(i + 1) % hull.size()] - hull[i]);
        for (const glm::dvec2 normal : {glm::dvec2(side.y, -side.x), glm::dvec2(-side.y, side.x)}) {
            double first = -1e300, second = 1e300;
            for (const glm::dvec2 point : hull) {
                first = std::max(first, glm::dot(point, normal));
                second = std::min(second, glm::dot(point + step, normal));
            }
            most = std::max(most, second - first);
        }
    }
    return most;
}

void expect_apart(const Hull& hull, const PlaneLattice& lattice, double gap) {
    for (int i = -6; i <= 6; ++i) {
        for (int j = -6; j <= 6; ++j) {
            if (i == 0 && j == 0) continue;
            const glm::dvec2 step = static_cast<double>(i) * lattice.across + static_cast<double>(j) * lattice.up;
            EXPECT_GE(apart(hull, step), gap - 1e-6) << i << ' ' << j;
        }
    }
}

/// Source: densities of the densest lattice packings: Fejes Toth, Regular Figures, 1964; a triangle packs with 2/3,
/// shapes that tile by translation with 1.
TEST(Packing, ReachesKnownDensities) {
    const struct {
        const char* name;
        Hull hull;
        double density, waste;
    } known[] = {
        {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, 0},
        {"diamond", {{0, 0}, {1, -1}, {2, 0}, {1, 1}}, 1, 0},
        {"oblong", {{0, 0}, {3, 0}, {3, 1}, {0, 1}}, 1, 0},
        {"hexagon", regular(6), 1, 0.01},
        {"upright hexagon", regular(6, std::numbers::pi / 2), 1, 0.01},
        {"triangle", {{0, 0}, {1, 0}, {0.5, 0.8}}, 2. / 3, 0.01},
        {"circle", regular(256), std::numbers::pi / std::sqrt(12.0), 0.01},
    };
    for (const auto& [name, hull, density, waste] : known) {
        SCOPED_TRACE(name);
        const PlaneLattice lattice = densest_lattice(hull, 0);
        expect_apart(hull, lattice, 0);
        EXPECT_LE(area_of(hull) / cell_of(lattice), density + 1e-6);
        EXPECT_GE(area_of(hull) / cell_of(lattice), density * (1 - waste) - 1e-6);
        // All of them are symmetric about an upright line, and so are their lattices.
        EXPECT_NEAR(lattice.across.y, 0, 1e-6);
        const double shift = 2 * lattice.up.x / lattice.across.x;
        EXPECT_NEAR(shift, std::round(shift), 0.01);
    }
}

TEST(Packing, KeepsTheGap) {
    const Hull odd = {{0, 0}, {4, -1}, {5, 1}, {3, 3}, {1, 2.5}};
    for (const double gap : {0.0, 0.2, 1.0}) expect_apart(odd, densest_lattice(odd, gap), gap);
    EXPECT_LT(cell_of(densest_lattice(odd, -0.5)), cell_of(densest_lattice(odd, 0)));
    // At most a tenth more than the best of a coarse search.
    double least = 1e300;
    const auto fits = [&](glm::dvec2 step) { return apart(odd, step) >= 0; };
    for (double x = 0; x < 7; x += 0.1) {
        for (double y = 0; y < 5; y += 0.1) {
            if (!fits({x, y})) continue;
            for (double u = -7; u < 7; u += 0.1) {
                for (double v = 0; v < 5; v += 0.1) {
                    const double cell = x * v - y * u;
                    if (cell < area_of(odd) || cell >= least || !fits({u, v})) continue;
                    bool all = true;
                    for (int i = -3; i <= 3 && all; ++i)
                        all = fits({u + i * x, v + i * y}) && fits({2 * u + i * x, 2 * v + i * y});
                    if (all) least = cell;
                }
            }
        }
    }
    EXPECT_LE(cell_of(densest_lattice(odd, 0)), 1.1 * least + 1e-6);
}

TEST(Packing, FlatAndTinyShapes) {
    for (const Hull& hull : {Hull{{2, 3}}, Hull{{0, 0}, {1, 0}}, Hull{{0, 0}, {0, 1}}, Hull{{0, 0}, {1, 1}},
                             Hull{{0, 0}, {1e200, 0}, {1e200, 1e200}}, Hull{{0, 0}, {1e150, 0}, {1e150, 1e150}}}) {
        const PlaneLattice lattice = densest_lattice(hull, 0.25);
        EXPECT_GT(lattice.across.x, 0);
        EXPECT_GT(lattice.up.y, 0);
        EXPECT_TRUE(std::isfinite(lattice.across.x) && std::isfinite(lattice.up.y));
        EXPECT_GT(cell_of(densest_lattice(hull, 0)), 0);
    }
    Repeat repeat = *parse_repeat("packed:4x5,gap=0");
    EXPECT_EQ(repeat.copies(), 20);
    EXPECT_NEAR(covered_share(repeat, Hull{{0, 0}, {1, -1}, {2, 0}, {1, 1}}), 1, 1e-6);
    EXPECT_EQ(copies_of(repeat, regular(6)).size(), 20u);
}

}  // namespace
}  // namespace sikku
