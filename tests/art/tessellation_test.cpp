// Surfaces and meshes in space: where their corners lie, how finely they are divided, and their light.
#include "art/space/tessellation.h"

#include "art/space/solids.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <string>

namespace sikku::tessellation_test {

using reference::grammar_of;

Scene scene_of(const std::string& text) {
    Style style;
    style.palette = {Colour{0, 0, 0, 255}, Colour{255, 0, 0, 255}, Colour{0, 255, 0, 255}};
    return Scene::of(grammar_of(text), style, {.interpreted = true}, 1e6);
}

bool has_vertex(const Scene& scene, const glm::dvec3& wanted) {
    for (const ScenePolygon& polygon : scene.polygons()) {
        for (const glm::vec3& vertex : scene.vertices(polygon)) {
            if (glm::distance(scene.at(vertex), wanted) < 1e-5) return true;
        }
    }
    return false;
}

const std::string flat =
    "patch p:\n0 0 0, 1 0 0, 2 0 0, 3 0 0\n0 1 1, 1 1 1, 2 1 1, 3 1 1\n"
    "0 2 2, 1 2 2, 2 2 2, 3 2 2\n0 3 3, 1 3 3, 2 3 3, 3 3 3\naxiom: ~p\n";
const std::string dome =
    "patch p:\n0 0 0, 1 0 1, 2 0 1, 3 0 0\n0 1 1, 1 1 3, 2 1 3, 3 1 1\n"
    "0 2 1, 1 2 3, 2 2 3, 3 2 1\n0 3 0, 1 3 1, 2 3 1, 3 3 0\naxiom: ~p\n";

TEST(Tessellation, ALinearNetIsOnePlane) {
    const Scene scene = tessellated(scene_of(flat), {.deviation = 1e-6});
    ASSERT_EQ(scene.polygons().size(), 1u);
    EXPECT_TRUE(scene.surfaces().empty());
    for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), {3, 0, 0}, {3, 3, 3}, {0, 3, 3}}) {
        EXPECT_TRUE(has_vertex(scene, corner));
    }
    for (const SceneCorner& corner : scene.corners(scene.polygons()[0])) {
        EXPECT_NEAR(std::fabs(glm::dot(corner.normal, glm::normalize(glm::vec3(0, -1, 1)))), 1, 1e-6);
    }
}

TEST(Tessellation, ALinearNetIsTheBilinearSurface) {
    // Corners (0,0,0), (3,0,0), (0,3,0) and (3,3,9): z = xy, and the normal is (-y, -x, 1).
    std::string net = "patch p:\n";
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            net += std::to_string(column) + " " + std::to_string(row) + " " + std::to_string(row * column) + " ";
        }
        net += "\n";
    }
    const Scene scene = tessellated(scene_of(net + "axiom: ~p\n"), {.deviation = 0.01});
    EXPECT_GT(scene.polygons().size(), 9u);
    for (const ScenePolygon& polygon : scene.polygons()) {
        for (std::size_t i = 0; i < polygon.count; ++i) {
            const glm::dvec3 at = scene.at(scene.vertices(polygon)[i]);
            EXPECT_NEAR(at.z, at.x * at.y, 1e-5);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-at.y, -at.x, 1));
            EXPECT_NEAR(std::fabs(glm::dot(glm::dvec3(scene.corners(polygon)[i].normal), normal)), 1, 1e-5);
        }
    }
}

TEST(Tessellation, CornersLieOnTheCornersOfTheNet) {
    for (const double deviation : {1.0, 0.01, 0.001}) {
        const Scene scene = tessellated(scene_of(dome), {.deviation = deviation});
        for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}) {
            EXPECT_TRUE(has_vertex(scene, corner));
        }
        // The middle: weights 1/8 3/8 3/8 1/8 in both directions.
        EXPECT_TRUE(deviation == 1 || has_vertex(scene, {1.5, 1.5, 2.0625}));
    }
    // A quarter of the deviation: twice as many in each direction, as far as divisions are offered.
    const std::size_t coarse = tessellated(scene_of(dome), {.deviation = 0.1}).polygons().size();
    const std::size_t fine = tessellated(scene_of(dome), {.deviation = 0.025}).polygons().size();
    EXPECT_GT(fine, 2 * coarse);
    EXPECT_LE(fine, 8 * coarse);
    EXPECT_LE(tessellated(scene_of(dome), {.deviation = 1e-9}).polygons().size(), 48u * 48);
}

/// Height of the dome, whose points lie evenly in x and y.
double dome_height(double x, double y) {
    const auto weights = [](double t) {
        const double s = 1 - t;
        return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    };
    const double net[4][4] = {{0, 1, 1, 0}, {1, 3, 3, 1}, {1, 3, 3, 1}, {0, 1, 1, 0}};
    const auto rows = weights(y / 3), columns = weights(x / 3);
    double z = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k) z += net[i][k] * rows[i] * columns[k];
    }
    return z;
}

TEST(Tessellation, AMeasuredDeviationHoldsEverywhere) {
    for (const double deviation : {0.1, 0.01, 0.002}) {
        const Scene measured = tessellated(scene_of(dome), {.deviation = deviation, .is_measured = true});
        const Scene bounded = tessellated(scene_of(dome), {.deviation = deviation});
        EXPECT_LE(measured.polygons().size(), bounded.polygons().size()) << deviation;
        for (const ScenePolygon& polygon : measured.polygons()) {
            const auto vertices = measured.vertices(polygon);
            ASSERT_EQ(vertices.size(), 4U);
            // Points of the triangles on both sides of either diagonal.
            for (std::size_t first = 0; first < 4; ++first) {
                const auto corner = [&](std::size_t i) { return measured.at(vertices[(first + i) % 4]); };
                for (int p = 0; p <= 6; ++p) {
                    for (int q = 0; p + q <= 6; ++q) {
                        const glm::dvec3 at =
                            corner(0) + (corner(1) - corner(0)) * (p / 6.0) + (corner(2) - corner(0)) * (q / 6.0);
                        const double z = dome_height(at.x, at.y), step = 1e-4;
                        const double slope =
                            std::hypot(dome_height(at.x + step, at.y) - z, dome_height(at.x, at.y + step) - z) / step;
                        EXPECT_LT(std::fabs(at.z - z) / std::hypot(1.0, slope), 1.1 * deviation);
                    }
                }
            }
        }
    }
}

TEST(Tessellation, PointsThatLieUnevenlyInAPlaneNeedNoMeasuredDivisions) {
    // A flat rectangle whose inner points are spaced unevenly: a bound by differences of points requires divisions.
    const std::string uneven =
        "patch p:\n0 0 0, 2 0 0, 2.5 0 0, 3 0 0\n0 2 0, 2 2 0, 2.5 2 0, 3 2 0\n"
        "0 2.5 0, 2 2.5 0, 2.5 2.5 0, 3 2.5 0\n0 3 0, 2 3 0, 2.5 3 0, 3 3 0\naxiom: ~p\n";
    EXPECT_EQ(tessellated(scene_of(uneven), {.deviation = 0.001, .is_measured = true}).polygons().size(), 9U);
    EXPECT_GT(tessellated(scene_of(uneven), {.deviation = 0.001}).polygons().size(), 500U);
}

TEST(Tessellation, NormalsAreThoseOfTheSurface) {
    const Scene scene = tessellated(scene_of(dome), {.deviation = 0.01});
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto corners = scene.corners(polygon);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            EXPECT_NEAR(glm::length(corners[i].normal), 1, 1e-5);
            if (glm::distance(scene.at(scene.vertices(polygon)[i]), glm::dvec3(1.5, 1.5, 2.0625)) < 1e-5) {
                EXPECT_NEAR(std::fabs(corners[i].normal.z), 1, 1e-5);
            }
        }
    }
}

TEST(Tessellation, NeighboursAreSmoothWhereTheyMeet) {
    // A ridge of two flat patches.
    const std::string ridge =
        "patch p:\n0 0 0, 1 0 .5, 2 0 1, 3 0 1.5\n0 1 0, 1 1 .5, 2 1 1, 3 1 1.5\n"
        "0 2 0, 1 2 .5, 2 2 1, 3 2 1.5\n0 3 0, 1 3 .5, 2 3 1, 3 3 1.5\n"
        "patch p:\n3 0 1.5, 4 0 1, 5 0 .5, 6 0 0\n3 1 1.5, 4 1 1, 5 1 .5, 6 1 0\n"
        "3 2 1.5, 4 2 1, 5 2 .5, 6 2 0\n3 3 1.5, 4 3 1, 5 3 .5, 6 3 0\naxiom: ~p\n";
    const Scene scene = tessellated(scene_of(ridge), {.deviation = 0.01});
    ASSERT_EQ(scene.polygons().size(), 2u);
    int met = 0, inner = 0;
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto corners = scene.corners(polygon);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            inner += static_cast<int>(polygon.inner_edges >> i & 1U);
            if (std::fabs(scene.at(scene.vertices(polygon)[i]).x - 3) > 1e-5) continue;
            EXPECT_NEAR(std::fabs(corners[i].normal.z), 1, 1e-5);
            ++met;
        }
    }
    EXPECT_EQ(met, 4);
    EXPECT_EQ(inner, 2) << "the ridge is not an outline";
}

TEST(Tessellation, ManyPatchesInOnePlaceAreDividedInTime) {
    // 4,096 patches on each other: each could be the neighbour of every other.
    std::string text;
    for (int i = 0; i < 4096; ++i) {
        text +=
            "patch p:\n0 0 0, 1 0 1, 2 0 1, 3 0 0\n0 1 1, 1 1 3, 2 1 3, 3 1 1\n"
            "0 2 1, 1 2 3, 2 2 3, 3 2 1\n0 3 0, 1 3 1, 2 3 1, 3 3 0\n";
    }
    const Scene scene = tessellated(scene_of(text + "axiom: ~p\n"), {.deviation = 1e-9});
    EXPECT_GT(scene.polygons().size(), 4096u * 9);
    EXPECT_LE(scene.polygons().size(), 1'500'000u);
}

TEST(Tessellation, CollapsedEdgesMakeTriangles) {
    const std::string tip =
        "patch p:\n0 0 0, 0 0 0, 0 0 0, 0 0 0\n-1 1 0, 0 1 1, 0 1 1, 1 1 0\n"
        "-1 2 0, 0 2 1, 0 2 1, 1 2 0\n0 3 0, 0 3 0, 0 3 0, 0 3 0\naxiom: ~p\n";
    const Scene scene = tessellated(scene_of(tip), {.deviation = 0.01});
    std::size_t triangles = 0;
    for (const ScenePolygon& polygon : scene.polygons()) {
        triangles += polygon.count == 3 ? 1 : 0;
        for (const SceneCorner& corner : scene.corners(polygon)) EXPECT_NEAR(glm::length(corner.normal), 1, 1e-5);
    }
    EXPECT_GT(triangles, 0u);
    EXPECT_EQ(triangles * triangles, 4 * scene.polygons().size()) << "n at each tip of n x n";
}

TEST(Scene, PolygonsOfAFrameworkThatShareVerticesHaveCommonNormals) {
    // Two squares that meet at 40 degrees along a side of one step.
    const std::string bent = "polygons: framework\naxiom: [{.G.+G.+G.}][/(40){.G.-G.-G.}]\n";
    const Scene scene = scene_of(bent);
    ASSERT_EQ(scene.polygons().size(), 2u);
    int shared = 0;
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto points = scene.vertices(polygon);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 at = scene.at(points[i]);
            if (std::fabs(at.x) > 1e-5) continue;
            ++shared;
            EXPECT_NEAR(std::fabs(scene.corners(polygon)[i].normal.z), std::cos(20 * M_PI / 180), 1e-5);
        }
    }
    EXPECT_EQ(shared, 4);
}

TEST(Solids, ExtentsOfSurfacesAreThoseOfWhatIsSeen) {
    const Scene scene = scene_of(dome);
    Style style;
    style.camera = {0, 0, {}};
    const Box box = extent_of(scene, style, glm::dmat3x2({1, 0}, {0, 1}, {0, 0})).box;
    EXPECT_NEAR(box.high.x - box.low.x, 3, 1e-5);
    EXPECT_NEAR(box.high.y - box.low.y, 3, 1e-5);
}

}  // namespace sikku::tessellation_test
