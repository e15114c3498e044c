// Depth maps: against rays cut with every triangle, and one instruction set against another.
#include "art/space/depth_map.h"
#include "art/space/casters.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace sikku::depth_map_test {

/// A map with its own memory.
struct Drawn {
    Drawn(const Casters& casters, const glm::vec3& towards, int side)
        : map(towards, casters.low(), casters.high(), side), heights(map.squares()) {
        map.heights = heights;
        casters.draw(map);
    }
    DepthMap map;
    std::vector<std::uint16_t> heights;
};

using Triangle = std::array<glm::vec3, 3>;

glm::vec3 random_direction(std::mt19937& random) {
    std::uniform_real_distribution<float> any(-1, 1);
    for (;;) {
        const glm::vec3 v(any(random), any(random), any(random));
        if (const float length = glm::length(v); length > 0.1F && length <= 1) return v / length;
    }
}

Style thin_lines() {
    Style style;
    style.palette = {Colour{90, 150, 60, 255}};
    style.stroke = {0.001, true, 1.0};
    return style;
}

/// Triangles of side 20 within some 60 steps.
Scene random_scene(unsigned seed) {
    std::mt19937 random(seed);
    std::string axiom = "f(1)";
    for (int i = 0; i < 25; ++i) {
        const auto angle = [&] { return "(" + std::to_string(random() % 360) + ")"; };
        axiom += "[+" + angle() + "&" + angle() + "f(" + std::to_string(random() % 30) + ")+" + angle() + "/" +
                 angle() + "{f(20)+(120)f(20)}]";
    }
    return Scene::of(reference::grammar_of("turn: left\naxiom: " + axiom + "\n"), thin_lines(), {.interpreted = true},
                     1e6);
}

std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> result;
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto vertices = scene.vertices(polygon);
        EXPECT_EQ(vertices.size(), 3U);
        result.push_back({vertices[0], vertices[1], vertices[2]});
    }
    return result;
}

/// How far along a ray it meets the triangle; 0 if it does not. @param wide  by this share beyond the edges, as a ray
/// from the front sees it
float meeting(const Triangle& triangle, const glm::vec3& from, const glm::vec3& ray, float wide) {
    const glm::vec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0], side = glm::cross(ray, ac);
    const float volume = glm::dot(ab, side);
    if (volume == 0) return 0;
    wide /= std::max(1e-4F, std::fabs(volume) / glm::length(glm::cross(ab, ac)));
    const glm::vec3 away = from - triangle[0], across = glm::cross(away, ab);
    const float p = glm::dot(away, side) / volume, q = glm::dot(ray, across) / volume;
    if (p < -wide || q < -wide || p + q > 1 + wide) return 0;
    return std::max(0.0F, glm::dot(ac, across) / volume);
}

TEST(DepthMap, LightReachesWhatNoTriangleCovers) {
    int lit = 0, dark = 0;
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        const Scene scene = random_scene(seed);
        const std::vector<Triangle> triangles = triangles_of(scene);
        const Casters casters(scene, thin_lines(), 1, 1024);
        std::mt19937 random(seed);
        for (int light = 0; light < 8; ++light) {
            const Drawn drawn(casters, random_direction(random), 1024);
            const DepthMap& map = drawn.map;
            std::uniform_real_distribution<float> share(0, 1);
            for (int i = 0; i < 500; ++i) {
                const glm::vec3 point =
                    glm::mix(casters.low(), casters.high(), glm::vec3(share(random), share(random), share(random)));
                // Only points that are clearly covered, or clearly are not.
                const auto covers = [&](const Triangle& triangle) {
                    return meeting(triangle, point, map.towards, -0.03F) > 2;
                };
                const auto may_cover = [&](const Triangle& triangle) {
                    return meeting(triangle, point - 8.0F * map.towards, map.towards, 0.03F) > 0;
                };
                if (std::any_of(triangles.begin(), triangles.end(), covers)) {
                    EXPECT_EQ(map.reaches(point), 0) << seed << ' ' << light << ' ' << i;
                    ++dark;
                } else if (std::none_of(triangles.begin(), triangles.end(), may_cover)) {
                    EXPECT_NEAR(map.reaches(point), 1, 1e-6) << seed << ' ' << light << ' ' << i;
                    ++lit;
                }
            }
        }
    }
    EXPECT_GT(lit, 3000);
    EXPECT_GT(dark, 2000);
}

TEST(DepthMap, LightFromOutsideTheMapReachesEverything) {
    const Scene scene = random_scene(5);
    const Casters casters(scene, thin_lines(), 1, 512);
    const Drawn drawn(casters, glm::normalize(glm::vec3(0.3F, 1, 0.2F)), 512);
    const DepthMap& map = drawn.map;
    for (const float far : {1e3F, 1e6F, 1e12F}) {
        for (const glm::vec3& away :
             {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
            EXPECT_NEAR(map.reaches(casters.low() + far * away), 1, 1e-6) << far;
        }
    }
}

TEST(DepthMap, ThePlacesOfAPacketHaveTheLightOfEachAlone) {
    const Scene scene = random_scene(6);
    const Casters casters(scene, thin_lines(), 1, 512);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> share(-0.2F, 1.2F);
    for (int light = 0; light < 10; ++light) {
        const Drawn drawn(casters, random_direction(random), 512);
        const DepthMap& map = drawn.map;
        LitPlaces places;
        std::vector<std::array<float, 2>> expected;
        for (int i = 0; i < 1003; ++i) {
            const glm::vec3 point =
                glm::mix(casters.low(), casters.high(), glm::vec3(share(random), share(random), share(random)));
            const glm::vec3 normal = random_direction(random);
            const bool is_thin = random() % 2 == 0;
            places.add(point, normal, is_thin);
            const float cosine = glm::dot(normal, map.towards);
            const glm::vec3 nudge = normal * map.nudge;
            expected.push_back({cosine > 0 ? cosine * map.reaches(point + nudge) : 0.0F,
                                cosine < 0 && is_thin ? -cosine * map.reaches(point - nudge) : 0.0F});
        }
        map.shine(0.25F, places, Simd::scalar);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_FLOAT_EQ(places.column(LitPlaces::front)[i], 0.25F * expected[i][0]);
            EXPECT_FLOAT_EQ(places.column(LitPlaces::behind)[i], 0.25F * expected[i][1]);
        }
    }
}

TEST(DepthMap, InstructionSetsGiveTheSameLight) {
    if (best_simd() != Simd::avx2) GTEST_SKIP() << "this processor has no AVX2";
    const Scene scene = random_scene(7);
    const Casters casters(scene, thin_lines(), 1, 512);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(-0.2F, 1.2F);
    for (int light = 0; light < 10; ++light) {
        const Drawn drawn(casters, random_direction(random), 512);
        LitPlaces slow, fast;
        for (int i = 0; i < 1003; ++i) {
            const float nan = std::numeric_limits<float>::quiet_NaN();
            const glm::vec3 point = i == 500 ? glm::vec3(nan)
                                             : glm::mix(casters.low(), casters.high(),
                                                        glm::vec3(share(random), share(random), share(random)));
            const glm::vec3 normal = random_direction(random);
            const bool is_thin = random() % 2 == 0;
            slow.add(point, normal, is_thin);
            fast.add(point, normal, is_thin);
        }
        drawn.map.shine(0.25F, slow, Simd::scalar);
        drawn.map.shine(0.25F, fast, best_simd());
        for (std::size_t i = 0; i < slow.size(); ++i) {
            EXPECT_EQ(fast.column(LitPlaces::front)[i], slow.column(LitPlaces::front)[i]);
            EXPECT_EQ(fast.column(LitPlaces::behind)[i], slow.column(LitPlaces::behind)[i]);
        }
    }
}

}  // namespace sikku::depth_map_test
