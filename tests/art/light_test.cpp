// Light of drawings in space: against integrals over the sky, a second way to find points, and pictures.
#include "art/style/light.h"
#include "art/space/daylight.h"
#include "art/space/scene_bands.h"
#include "art/space/solid_raster.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace sikku::light_test {

using reference::grammar_of;

constexpr Colour white{255, 255, 255, 255}, green{90, 150, 60, 255};

Print lit_print(int side, Light light) {
    Print print;
    print.page = {static_cast<double>(side), static_cast<double>(side), 0};
    print.dpi = 25.4;
    print.style.ground = white;
    print.style.palette = {green};
    print.style.stroke = {1.0, true, 1.0};
    print.style.light = light;
    print.style.camera.elevation = 30;
    print.placement.to_page = {{1, 0}, {0, -1}, {side / 2.0, side / 2.0}};
    print.placement.step = 1;
    return print;
}

Scene scene_of(const std::string& axiom, const Style& style) {
    return Scene::of(grammar_of("turn: left\naxiom: " + axiom + "\n"), style, {.interpreted = true}, 1e6);
}

struct Picture {
    int side, channels;
    std::vector<std::uint8_t> bytes;
    const std::uint8_t* at(int x, int y) const { return bytes.data() + std::size_t((y * side + x) * channels); }
};

Picture picture_of(const Scene& scene, const Print& print, int threads = 2) {
    const auto raster = make_solid_raster(scene, print);
    Picture picture{static_cast<int>(print.page.width), raster->channels(), {}};
    raster->render(threads, [&](int, int, std::span<const std::uint8_t> rows) {
        picture.bytes.insert(picture.bytes.end(), rows.begin(), rows.end());
    });
    return picture;
}

/// A level square of 40 steps, 10 steps above a post that stands on the ground.
const std::string table = "F(10)[&(90)-(90)f(20)+(90)f(20)+(90){f(40)+(90)f(40)+(90)f(40)+(90)f(40)}]";

Light only_sun() {
    return *parse_light("0 90 1");
}

TEST(Light, ValuesOfTheKey) {
    EXPECT_TRUE(parse_light("flat")->is_flat);
    EXPECT_EQ(parse_light("SUN"), (Light{.is_flat = false}));
    EXPECT_EQ(parse_light("sky")->sun, 0);
    EXPECT_EQ(parse_light("-30,20"), (Light{.is_flat = false, .azimuth = -30, .elevation = 20}));
    EXPECT_EQ(parse_light("10 90 0.25"), (Light{.is_flat = false, .azimuth = 10, .elevation = 90, .sun = 0.25}));
    for (const char* wrong :
         {"", "moon", "10", "10 4", "10 91", "10 20 1.1", "10 20 0.5 1", "361 20", "nan 20", "10 inf"}) {
        EXPECT_FALSE(parse_light(wrong)) << wrong;
    }
}

glm::vec3 on_ground(const Daylight& daylight, const glm::vec3& point) {
    const std::array points = {point};
    return daylight.on_ground(daylight.sky_on_ground(points).front(), daylight.sun_on_ground(points).front());
}

Daylight::OnSurface on_surface(const Daylight& daylight, const glm::vec3& point, const glm::vec3& normal,
                               bool is_thin) {
    LitPlaces places;
    places.add(point, normal, is_thin);
    std::vector<Daylight::OnSurface> lights;
    daylight.on_surfaces(places, lights);
    return lights.front();
}

TEST(Daylight, TheGroundUnderATableIsInTheShadowOfTheSun) {
    const Print print = lit_print(64, only_sun());
    Daylight daylight(scene_of(table, print.style), print.style, 1, 1000);
    daylight.build(2, {});
    const float height = daylight.ground();
    EXPECT_NEAR(on_ground(daylight, {5, height, 5}).y, 0, 0.01);
    EXPECT_NEAR(on_ground(daylight, {60, height, 5}).y, 1, 1e-5);
    EXPECT_NEAR(on_ground(daylight, {1e6F, height, -1e6F}).y, 1, 1e-5);
}

/// Share of the light of an overcast sky that reaches a level place if all within `angle` of the zenith is covered.
double open_share(double angle) {
    const double c = std::cos(angle);
    // The integral of (1 + 2 cos) cos over the cone, by that over the half sphere.
    return 1 - ((1 - c * c) / 2 + 2 * (1 - c * c * c) / 3) / (1.0 / 2 + 2.0 / 3);
}

TEST(Daylight, ADiscCoversItsShareOfTheSky) {
    Light sky = *parse_light("sky");
    const Print print = lit_print(64, sky);
    // A polygon of 36 corners, 20 steps across, at three heights above a post.
    for (const double height : {3.0, 10.0, 30.0}) {
        std::string disc = "F(" + std::to_string(height) + ")[&(90){f(20)-(95)";
        for (int i = 0; i < 36; ++i) disc += "f(" + std::to_string(40 * std::sin(std::numbers::pi / 36)) + ")-(10)";
        // The first corner of a `{` is where it stands: the middle, from which the polygon goes to the rim.
        disc += "}]";
        Style style = print.style;
        style.stroke = {0.01, true, 1.0};
        Daylight daylight(scene_of(disc, style), style, 1, 1000);
        daylight.build(1, {});
        const double expected = open_share(std::atan(20 / height));
        EXPECT_NEAR(on_ground(daylight, {0.3F, daylight.ground(), 0.3F}).y, expected, 0.05) << height;
    }
}

TEST(Daylight, ThinSurfacesAreLitFromBehindAndSolidOnesNot) {
    const Print print = lit_print(64, only_sun());
    Daylight daylight(scene_of(table, print.style), print.style, 1, 1000);
    daylight.build(2, {});
    const glm::vec3 above(5, 10, 5), down(0, -1, 0);
    EXPECT_GT(on_surface(daylight, above, down, true).behind.y, 1);
    EXPECT_EQ(on_surface(daylight, above, down, false).behind, glm::vec3(0.0F));
    EXPECT_GT(on_surface(daylight, above, -down, true).front.y, 1);
    EXPECT_LT(on_surface(daylight, {5, 5, 5}, -down, true).front.y, 0.3) << "under the table";
}

TEST(Stage, PointsOfThePageAreThoseOfTheScene) {
    Print print = lit_print(64, *parse_light("sun"));
    const Scene scene = scene_of(table, print.style);
    for (const bool is_perspective : {false, true}) {
        print.style.camera.azimuth = 33;
        if (is_perspective) print.style.camera.distance = 3;
        const Stage stage = picture_stage(scene, print);
        for (const glm::vec3& point : {glm::vec3(0, 0, 0), glm::vec3(3, -4, 5), glm::vec3(-10, 2, 7)}) {
            EXPECT_LT(glm::distance(stage.point(stage.place(point)), glm::dvec3(point)), 1e-9);
            // A step to the eye changes the depth alone.
            const glm::dvec3 seen = stage.place(point);
            const glm::dvec3 nearer = stage.place(point + glm::vec3(stage.to_eye(point)));
            EXPECT_LT(glm::distance(glm::dvec2(seen), glm::dvec2(nearer)), 1e-5);
            EXPECT_GT(nearer.z, seen.z);
        }
    }
}

TEST(LitRaster, AShadowLiesOnTheGround) {
    const Print print = lit_print(256, *parse_light("-90 45 0.8"));
    const Scene scene = scene_of(table, print.style);
    const Picture picture = picture_of(scene, print);
    ASSERT_EQ(picture.channels, 3);
    // The sun is on the left: the shadow of the table, 10 steps up, lies 10 steps to the right of what is below it.
    const auto ground_at = [&](int x, int z) {  // at steps to the right and towards the eye
        const Stage stage = picture_stage(scene, print);
        const glm::dvec3 seen = stage.place(glm::vec3(x, 0, z)) / double(SceneBands::samples);
        return int{picture.at(static_cast<int>(seen.x), static_cast<int>(seen.y))[1]};
    };
    EXPECT_LT(ground_at(25, 15), 150) << "in the shadow, right of the table";
    EXPECT_GT(ground_at(-45, 15), 235) << "in the light, left of it";
    EXPECT_EQ(picture.at(0, 255)[0], picture.at(0, 255)[2]) << "open ground keeps its colour";
}

TEST(Daylight, WithoutASunOrWithoutASkyTheOtherShinesAlone) {
    const Print print = lit_print(64, {});
    const Scene scene = scene_of(table, print.style);
    const auto light_of = [&](const char* light, const glm::vec3& point) {
        Style style = print.style;
        style.light = *parse_light(light);
        Daylight daylight(scene, style, 1, 1000);
        daylight.build(2, {});
        return std::pair(on_surface(daylight, point, {0, 1, 0}, true).front.y,
                         on_ground(daylight, {point.x, daylight.ground(), point.z}).y);
    };
    for (const glm::vec3& point : {glm::vec3(5, 5, 5), glm::vec3(5, 10, 5), glm::vec3(25, 2, 3)}) {
        const auto [sun, sun_below] = light_of("20 60 1", point);
        const auto [sky, sky_below] = light_of("sky", point);
        const auto [both, both_below] = light_of("20 60 0.5", point);
        EXPECT_NEAR(both, (sun + sky) / 2, 1e-3);
        EXPECT_GE(both_below, std::min(sun_below, sky_below) - 1e-3);
        EXPECT_LE(both_below, std::max(sun_below, sky_below) + 1e-3);
    }
}

TEST(LitRaster, ThePictureDependsNeitherOnThreadsNorOnBands) {
    const Print print = lit_print(256, *parse_light("sun"));
    const Scene scene = scene_of(table, print.style);
    const Picture one = picture_of(scene, print, 1), three = picture_of(scene, print, 3);
    EXPECT_EQ(one.bytes, three.bytes);
    const auto raster = make_solid_raster(scene, print);
    std::vector<std::uint8_t> parts;
    for (const int first : {0, 128}) {
        raster->render_rows(first, first + 128, 3, [&](int, int, std::span<const std::uint8_t> rows) {
            parts.insert(parts.end(), rows.begin(), rows.end());
        });
    }
    EXPECT_EQ(parts, one.bytes);
}

TEST(LitRaster, ALeafHasOneToneWhereverItsPixelsAreTaken) {
    // A level leaf in the open, in one colour: each whole pixel of it is equal but for the resolution of the maps.
    Print print = lit_print(200, *parse_light("0 90 0.8"));
    print.style.camera.elevation = 70;
    print.style.light.has_ground = false;
    const Scene scene = scene_of("&(90)f(10)-(90)f(30)+(90){f(60)+(90)f(60)+(90)f(60)+(90)f(60)}", print.style);
    const Picture coarse = picture_of(scene, print);
    print.dpi = 254;
    print.page = {20, 20, 0};
    print.placement.to_page = {{0.1, 0}, {0, -0.1}, {10, 10}};
    Picture fine{200, 3, {}};
    make_solid_raster(scene, print)->render(2, [&](int, int, std::span<const std::uint8_t> rows) {
        fine.bytes.insert(fine.bytes.end(), rows.begin(), rows.end());
    });
    ASSERT_EQ(fine.bytes.size(), coarse.bytes.size());
    int covered = 0;
    for (std::size_t i = 0; i < fine.bytes.size(); ++i) {
        if (coarse.bytes[i] == 255) continue;
        ++covered;
        EXPECT_NEAR(coarse.bytes[i], fine.bytes[i], 3) << "blocks of 2 by 2 pixels, and pixels alone, at " << i;
    }
    EXPECT_GT(covered, 3000);
}

TEST(LitRaster, WithoutAGroundThereIsNoShadowBesideTheDrawing) {
    Light light = *parse_light("sun");
    light.has_ground = false;
    const Print print = lit_print(128, light);
    const Picture picture = picture_of(scene_of("F(5)", print.style), print);
    const Picture with = picture_of(scene_of("F(5)", print.style), lit_print(128, *parse_light("sun")));
    int darker = 0;
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
        const bool is_stem = picture.bytes[i] != 255 && picture.bytes[i] < picture.bytes[i + 1];
        EXPECT_TRUE(picture.bytes[i] == 255 || is_stem) << i;
        darker += with.bytes[i] < picture.bytes[i] ? 1 : 0;
    }
    EXPECT_GT(darker, 5) << "the shadow with a ground";
}

TEST(LitRaster, OnATransparentGroundTheShadowIsAVeil) {
    Print print = lit_print(256, *parse_light("0 90 0.8"));
    print.style.ground.reset();
    const Picture picture = picture_of(scene_of(table, print.style), print);
    ASSERT_EQ(picture.channels, 4);
    int veiled = 0, opaque = 0, clear = 0;
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4) {
        const int alpha = picture.bytes[i];
        (alpha == 0 ? clear : alpha == 255 ? opaque : veiled) += 1;
        if (alpha > 0 && alpha < 200) {
            EXPECT_LT(picture.bytes[i - 1], 100) << "dark, or the edge of a leaf";
        }
    }
    EXPECT_GT(veiled, 300);
    EXPECT_GT(opaque, 300);
    EXPECT_GT(clear, 1000);
}

TEST(LitRaster, APolygonThatCrossesItselfIsWhatItsOutlineRunsAround) {
    // A pentagram seen from above: its points and its middle are covered, what lies between two points is not.
    Print print = lit_print(200, *parse_light("sun"));
    print.style.light.has_ground = false;
    print.style.camera.elevation = 90;
    const std::string star = "&(90){f(100)+(144)f(100)+(144)f(100)+(144)f(100)+(144)f(100)}";
    for (const bool is_flat : {false, true}) {
        print.style.light.is_flat = is_flat;
        const Scene scene = scene_of(star, print.style);
        const SpaceBounds box = scene.bounds();
        const glm::dvec3 middle = (box.low + box.high) / 2.0;
        const Stage stage = picture_stage(scene, print);
        print.placement.to_page[2] +=
            glm::dvec2(100, 100) -
            glm::dvec2(stage.place(glm::vec3(middle - scene.at({})))) / double(SceneBands::samples);
        const Picture picture = picture_of(scene, print);
        int covered = 0;
        for (std::size_t i = 0; i < picture.bytes.size(); i += 3) covered += picture.bytes[i] < 250 ? 1 : 0;
        // The area of a pentagram whose lines are 100 long, with its middle, is 0.31027 of the square of the line;
        // its edges, 382 long, pass through pixels of which half lie outside.
        EXPECT_NEAR(covered, 3102.7 + 382 / 2, 40) << is_flat;
        print.placement.to_page[2] = {100, 100};
    }
}

TEST(LitRaster, BallsInPerspectiveDoNotShadeThemselves) {
    Print print = lit_print(128, *parse_light("0 20 1"));
    print.style.light.has_ground = false;
    print.style.camera = {.azimuth = 0, .elevation = 0, .distance = 1.3};
    print.style.palette = {white};
    print.style.stroke = {0.1, true, 1.0};
    print.style.ground = Colour{0, 0, 0, 255};
    const Picture picture = picture_of(scene_of("@O(30)", print.style), print);
    // The sun is behind the eye: the middle of the ball is bright everywhere.
    for (int y = 50; y < 64; ++y) {
        for (int x = 54; x < 74; ++x) EXPECT_GT(picture.at(x, y)[1], 200) << x << ' ' << y;
    }
}

TEST(LitRaster, ALeafThatStandsAloneIsArchedAndAFaceOfASolidIsNot) {
    const Print print = lit_print(64, *parse_light("sun"));
    const std::string leaf = "{f(4)+(60)f(4)+(120)f(4)}";
    const Scene alone = scene_of("f(1)" + leaf, print.style);
    ASSERT_EQ(alone.polygons().size(), 1u);
    EXPECT_TRUE(alone.polygons()[0].corners);
    const Scene solid = scene_of("f(1)[" + leaf + "][/(60)" + leaf + "]", print.style);
    ASSERT_EQ(solid.polygons().size(), 2u);
    EXPECT_FALSE(solid.polygons()[0].corners) << "they share an edge";
    Style flat = print.style;
    flat.light = {};
    EXPECT_FALSE(scene_of("f(1)" + leaf, flat).polygons()[0].corners);
}

TEST(Sway, TurnsBranchesByAtMostItsDegrees) {
    Print print = lit_print(64, {});
    const std::string tree = "F(10)[+(90)F(10)][-(90)F(10)]F(10)";
    const Scene exact = scene_of(tree, print.style);
    print.style.sway = 5;
    const Scene swayed = scene_of(tree, print.style);
    ASSERT_EQ(swayed.segments().size(), 4u);
    EXPECT_EQ(swayed.segments()[0].to, exact.segments()[0].to) << "the stem";
    EXPECT_EQ(swayed.segments()[3].to, exact.segments()[3].to) << "the stem";
    for (const std::size_t branch : {1U, 2U}) {
        const double moved = glm::distance(swayed.segments()[branch].to, exact.segments()[branch].to);
        EXPECT_GT(moved, 0.01);
        EXPECT_LE(moved, 10 * 2 * std::sin(5 * std::numbers::pi / 360) + 1e-5);
    }
    // A branch keeps its place when another one follows.
    const Scene more = scene_of(tree + "[&(40)F(3)]", print.style);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(more.segments()[i].to, swayed.segments()[i].to);
}

}  // namespace sikku::light_test
