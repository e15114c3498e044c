// Drawings in space on paper: cameras, what hides what, light, and models.
#include "art/space/scene.h"
#include "art/space/model.h"
#include "art/space/solid_raster.h"
#include "art/space/solids.h"
#include "art/space/triangles.h"
#include "art/style/camera.h"
#include "art/writer/draw.h"
#include "engine/geometry/lettering.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::scene_test {

using reference::grammar_of;

constexpr Colour black{0, 0, 0, 255}, white{255, 255, 255, 255}, red{255, 0, 0, 255}, green{0, 255, 0, 255},
    blue{0, 0, 255, 255};

// --- cameras -----------------------------------------------------------------------------------------------------

TEST(Camera, IsReadFromWords) {
    EXPECT_EQ(parse_camera("30, -20"), (Camera{30, -20, {}}));
    EXPECT_EQ(parse_camera("  -400.5 90 "), (Camera{-400.5, 90, {}}));
    EXPECT_EQ(parse_camera("FRONT"), (Camera{0, 0, {}}));
    EXPECT_EQ(parse_camera("side"), (Camera{90, 0, {}}));
    EXPECT_EQ(parse_camera("top perspective 2.5"), (Camera{0, 90, 2.5}));
    EXPECT_EQ(parse_camera("10,20,perspective"), (Camera{10, 20, 4.0}));
    for (const char* wrong : {"", "30", "30 91", "30 -91", "30 x", "nan 0", "inf 0", "front 3", "30 20 orthographic",
                              "30 20 perspective 1", "30 20 perspective -3", "30 20 perspective 2 3",
                              "30 20 30 20 30", "30 20 perspective nan"}) {
        EXPECT_FALSE(parse_camera(wrong)) << wrong;
    }
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double tolerance = 1e-12) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], tolerance);
}

TEST(Camera, SeesFromWhereItStands) {
    const SpaceBounds box{{-1, -1, -1}, {1, 1, 1}};
    const glm::dvec3 point(1, 2, 3);
    EXPECT_EQ(Projection({0, 0, {}}, box)(point), point) << "from the front exactly as it is";
    expect_near(Projection({90, 0, {}}, box)(point), {-3, 2, 1});
    expect_near(Projection({0, 90, {}}, box)(point), {1, -3, 2});
    expect_near(Projection({180, 0, {}}, box)(point), {-1, 2, -3});
    // Of any camera: lengths are kept.
    for (const double azimuth : {0.0, 33.0, 200.0}) {
        for (const double elevation : {-90.0, -10.0, 45.0}) {
            EXPECT_NEAR(glm::length(Projection({azimuth, elevation, {}}, box)(point)), glm::length(point), 1e-12);
        }
    }
}

TEST(Camera, PerspectiveShortensWhatIsFar) {
    const SpaceBounds box{{-3, -3, -3}, {3, 3, 3}};
    const double radius = std::sqrt(27.0);
    const Projection eye({0, 0, 2.0}, box);
    expect_near(eye({1, 1, 0}), {1, 1, 0});
    EXPECT_NEAR(eye({1, 0, radius}).x, 2.0, 1e-12) << "half as far";
    EXPECT_NEAR(eye({1, 0, -2 * radius}).x, 0.5, 1e-12) << "twice as far";
    EXPECT_NEAR(eye.scale({1, 0, radius}), 2.0, 1e-12);
    // Lines stay straight, in depth as well.
    const glm::dvec3 a = eye({-1, 0, -2}), b = eye({0, 1, 0}), c = eye({1, 2, 2});
    expect_near(glm::cross(b - a, c - a), {0, 0, 0}, 1e-12);
}

// --- triangles ---------------------------------------------------------------------------------------------------

double area(const std::array<glm::vec3, 3>& t) {
    return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
}

TEST(Triangles, CoverConcavePolygonsInAnyPlane) {
    std::mt19937 random(3);
    for (int round = 0; round < 100; ++round) {
        // A star: radii at random, so that many corners are concave.
        const int corners = 5 + static_cast<int>(random() % 40);
        std::vector<glm::vec3> star;
        double expected = 0;
        std::vector<double> radii;
        for (int i = 0; i < corners; ++i) radii.push_back(std::uniform_real_distribution(0.2, 2.0)(random));
        const glm::dvec3 u = glm::normalize(glm::dvec3(1, round % 7 - 3, round % 5 - 2));
        const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0.3, round % 3 - 1.1, 1)));
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * M_PI * i / corners;
            star.emplace_back(radii[std::size_t(i)] * (std::cos(angle) * u + std::sin(angle) * v));
            expected +=
                radii[std::size_t(i)] * radii[std::size_t((i + 1) % corners)] * std::sin(2 * M_PI / corners) / 2;
        }
        const auto [triangles, is_whole] = triangulate(star);
        EXPECT_TRUE(is_whole);
        EXPECT_EQ(triangles.size(), star.size() - 2);
        double sum = 0;
        for (const auto& [a, b, c] : triangles) {
            sum += area({star[a], star[b], star[c]});
            EXPECT_GE(glm::dot(glm::cross(star[b] - star[a], star[c] - star[a]), glm::vec3(area_normal(star))),
                      -1e-4);
        }
        EXPECT_NEAR(sum, expected, 1e-4 * expected);
        EXPECT_NEAR(glm::length(area_normal(star)) / 2, expected, 1e-4 * expected);
    }
}

TEST(Triangles, OfWhatIsNoPolygonEnd) {
    EXPECT_TRUE(triangulate(std::vector<glm::vec3>(2)).triangles.empty());
    EXPECT_EQ(triangulate(std::vector<glm::vec3>(5)).triangles.size(), 3u) << "one point five times";
    const std::vector<glm::vec3> bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(triangulate(bow).triangles.size(), 2u);
    const Triangulation large = triangulate(std::vector<glm::vec3>(100'000));
    EXPECT_EQ(large.triangles.size(), 99'998u);
    EXPECT_FALSE(large.is_whole);
}

// --- pixels ------------------------------------------------------------------------------------------------------

/// Step = pixel, the turtle's start in the middle of the page.
Print pixel_print(int side) {
    Print print;
    print.page = {static_cast<double>(side), static_cast<double>(side), 0};
    print.dpi = 25.4;
    print.style.ground = white;
    print.style.palette = {red, green, blue, black};
    print.style.stroke = {1.0, true, 1.0};
    print.placement.to_page = {{1, 0}, {0, -1}, {side / 2.0, side / 2.0}};
    print.placement.step = 1;
    return print;
}

Scene scene_of(const std::string& text, const Style& style) {
    const Grammar grammar = grammar_of(text);
    return Scene::of(grammar, style, {.interpreted = true}, 1e6);
}

struct Picture {
    int side = 0;
    int channels = 0;
    std::vector<std::uint8_t> bytes;
    glm::ivec3 at(int x, int y) const {  // from the middle, y up
        const std::size_t i =
            (std::size_t(side / 2 - 1 - y) * std::size_t(side) + std::size_t(x + side / 2)) * std::size_t(channels);
        return {bytes[i], bytes[i + (channels > 1 ? 1 : 0)], bytes[i + (channels > 1 ? 2 : 0)]};
    }
};

Picture picture_of(const std::string& text, const Print& print, int threads = 2) {
    const Scene scene = scene_of(text, print.style);
    const auto raster = make_solid_raster(scene, print);
    Picture picture{static_cast<int>(print.page.width), raster->channels(), {}};
    raster->render(threads, [&](int, int, std::span<const std::uint8_t> rows) {
        picture.bytes.insert(picture.bytes.end(), rows.begin(), rows.end());
    });
    return picture;
}

/// w(hite), r(ed), g(reen), b(lue) or d(ark).
char hue(const glm::ivec3& c) {
    if (c.x > 240 && c.y > 240 && c.z > 240) return 'w';
    if (c.x > c.y + 60 && c.x > c.z + 60) return 'r';
    if (c.y > c.x + 60 && c.y > c.z + 60) return 'g';
    if (c.z > c.x + 60 && c.z > c.y + 60) return 'b';
    return 'd';
}

/// A square of 20 steps around where the turtle is, in its plane.
const std::string square = "[f(10)+f(10)|{f(20)-f(20)-f(20)-f(20)}]";

TEST(SolidRaster, WhatIsInFrontHidesWhatIsBehindWhateverComesFirst) {
    const Print print = pixel_print(64);
    // A red square at the back, a green one in front of it and half a step to the right.
    const std::string behind = "[&(90)f(5)^(90)" + square + "]";
    const std::string front = "[^(90)f(5)&(90)-(90)f(10)+(90);" + square + "]";
    for (const std::string& word : {behind + front, front + behind}) {
        const Picture picture = picture_of("turn: left\naxiom: " + word + "\n", print);
        EXPECT_EQ(hue(picture.at(-7, 0)), 'r') << word;
        EXPECT_EQ(hue(picture.at(5, 0)), 'g') << "in front";
        EXPECT_EQ(hue(picture.at(15, 0)), 'g');
        EXPECT_EQ(hue(picture.at(25, 0)), 'w');
    }
    // From behind it is the other way round.
    Print back = print;
    back.style.camera.azimuth = 180;
    const Picture picture = picture_of("turn: left\naxiom: " + behind + front + "\n", back);
    EXPECT_EQ(hue(picture.at(-5, 0)), 'r');
    EXPECT_EQ(hue(picture.at(-15, 0)), 'g');
}

/// A square of a framework, red on its left and blue on its right.
const std::string blend = "polygons: framework\nturn: left\naxiom: g(10)+g(20)-|{.G(20).;;+G(40).+G(20).}\n";

TEST(SolidRaster, ColoursOfVerticesBlend) {
    const Picture picture = picture_of(blend, pixel_print(64));
    EXPECT_EQ(hue(picture.at(-18, 0)), 'r');
    EXPECT_EQ(hue(picture.at(17, 0)), 'b');
    EXPECT_EQ(hue(picture.at(0, 15)), 'w');
    const glm::ivec3 left = picture.at(-10, 0), middle = picture.at(0, 0), right = picture.at(9, 0);
    EXPECT_GT(left.x, middle.x);
    EXPECT_GT(middle.x, right.x);
    EXPECT_LT(left.z, middle.z);
    EXPECT_LT(middle.z, right.z);
    EXPECT_NEAR(middle.x, middle.z, 12);
}

TEST(SolidRaster, AMeshIsLitSmoothly) {
    // A dome of one patch: neither of two neighbouring pixels is much brighter.
    const std::string dome =
        "patch p:\n-20 -20 0, -7 -20 7, 7 -20 7, 20 -20 0\n-20 -7 7, -7 -7 20, 7 -7 20, 20 -7 7\n"
        "-20 7 7, -7 7 20, 7 7 20, 20 7 7\n-20 20 0, -7 20 7, 7 20 7, 20 20 0\naxiom: ~p\n";
    const Picture picture = picture_of(dome, pixel_print(64));
    int changes = 0;
    for (int x = -18; x < 17; ++x) {
        const int change = picture.at(x + 1, 0).x - picture.at(x, 0).x;
        EXPECT_LE(std::abs(change), 14) << x;
        changes += change != 0 ? 1 : 0;
    }
    EXPECT_GT(changes, 20);
    EXPECT_EQ(hue(picture.at(25, 0)), 'w');
}

TEST(Model, ColoursOfVerticesAreKept) {
    const ScratchFolder folder;
    const Print print = pixel_print(64);
    const Scene scene = scene_of(blend, print.style);
    write_model(scene, print, PrintFormat::obj, folder.file("c.obj"));
    const std::string obj = contents(folder.file("c.obj"));
    EXPECT_TRUE(has(obj, " 1.0000 0.0000 0.0000\n"));
    EXPECT_TRUE(has(obj, " 0.0000 0.0000 1.0000\n"));
    EXPECT_TRUE(has(obj, "usemtl fill-blend\n"));
    write_model(scene, print, PrintFormat::glb, folder.file("c.glb"));
    const std::string glb = contents(folder.file("c.glb"));
    EXPECT_TRUE(has(glb, "\"COLOR_0\":"));
    EXPECT_EQ(glb.size() % 4, 0u);
}

/// The parts of a binary glTF file, read as its specification says.
struct GlbPart {
    std::vector<glm::vec3> positions, normals, colours;
    std::vector<std::uint32_t> corners;
    bool is_two_sided = false;
};
std::vector<GlbPart> read_glb(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2u);
    EXPECT_EQ(number(8), bytes.size());
    const std::size_t length = number(12);
    const auto json = nlohmann::json::parse(bytes.substr(20, length));
    const std::string binary = bytes.substr(28 + length);
    EXPECT_EQ(number(20 + length), binary.size());
    const auto values = [&](const nlohmann::json& index, const std::string& type, auto& list) {
        const auto& accessor = json["accessors"][index.get<std::size_t>()];
        const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        EXPECT_EQ(accessor["type"], type);
        list.resize(accessor["count"].get<std::size_t>());
        const std::size_t size = list.size() * sizeof(list[0]), offset = view["byteOffset"].get<std::size_t>();
        EXPECT_EQ(view["byteLength"].get<std::size_t>(), size);
        ASSERT_LE(offset + size, binary.size());
        std::memcpy(list.data(), binary.data() + offset, size);
    };
    std::vector<GlbPart> parts;
    for (const auto& primitive : json["meshes"][0]["primitives"]) {
        GlbPart& part = parts.emplace_back();
        const auto& attributes = primitive["attributes"];
        values(attributes["POSITION"], "VEC3", part.positions);
        values(attributes["NORMAL"], "VEC3", part.normals);
        values(primitive["indices"], "SCALAR", part.corners);
        if (attributes.contains("COLOR_0")) values(attributes["COLOR_0"], "VEC3", part.colours);
        part.is_two_sided = json["materials"][primitive["material"].get<std::size_t>()].value("doubleSided", false);
        EXPECT_EQ(part.normals.size(), part.positions.size());
        for (const glm::vec3& normal : part.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-5);
        for (const std::uint32_t corner : part.corners) EXPECT_LT(corner, part.positions.size());
    }
    return parts;
}

TEST(Model, VerticesHaveTheColoursOfTheirMarks) {
    const ScratchFolder folder;
    const Print print = pixel_print(64);
    write_model(scene_of(blend, print.style), print, PrintFormat::glb, folder.file("c.glb"));
    // Its sides are lines as well, of one colour each.
    auto parts = read_glb(contents(folder.file("c.glb")));
    std::erase_if(parts, [](const GlbPart& part) { return part.colours.empty(); });
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_TRUE(parts[0].is_two_sided);
    ASSERT_EQ(parts[0].colours.size(), 4u);
    float left = 1e9F, right = -1e9F;
    for (const glm::vec3& at : parts[0].positions) {
        left = std::min(left, at.x);
        right = std::max(right, at.x);
    }
    EXPECT_NEAR(right - left, 40, 1e-4);
    for (std::size_t i = 0; i < 4; ++i) {
        // Red and blue are the same in linear values.
        const bool is_left = parts[0].positions[i].x < (left + right) / 2;
        EXPECT_EQ(parts[0].colours[i], is_left ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
    }
    EXPECT_EQ(parts[0].corners.size(), 6u);
}

TEST(Model, SurfacesHaveTheirNormals) {
    // z = xy over a square of three steps, whose normal is (-y, -x, 1).
    std::string net = "patch p:\n";
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            net += std::to_string(column) + " " + std::to_string(row) + " " + std::to_string(row * column) + " ";
        }
        net += "\n";
    }
    const ScratchFolder folder;
    const Print print = pixel_print(64);
    write_model(scene_of(net + "axiom: ~p\n", print.style), print, PrintFormat::glb, folder.file("s.glb"));
    const auto parts = read_glb(contents(folder.file("s.glb")));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_TRUE(parts[0].colours.empty());
    EXPECT_TRUE(parts[0].is_two_sided);
    // n x n places and vertices that neighbours share.
    const std::size_t squares = parts[0].corners.size() / 6;
    const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(squares))));
    EXPECT_EQ(n * n, squares);
    EXPECT_EQ(parts[0].positions.size(), (n + 1) * (n + 1));
    for (std::size_t i = 0; i < parts[0].positions.size(); ++i) {
        const glm::vec3 at = parts[0].positions[i];  // the first point seen, a corner, is the origin
        EXPECT_NEAR(at.z, at.x * at.y, 1e-4);
        EXPECT_NEAR(std::fabs(glm::dot(parts[0].normals[i], glm::normalize(glm::vec3(-at.y, -at.x, 1)))), 1, 1e-4);
    }
}

TEST(SolidRaster, PolygonsThatCutEachOtherAreEachSeenInPart) {
    const Print print = pixel_print(64);
    // Both turned about the vertical, one to each side: left of the axis the one is in front, right of it the other.
    const Picture picture = picture_of("turn: left\naxiom: [/(30)" + square + "][;\\(30)" + square + "]\n", print);
    const char left = hue(picture.at(-6, 0)), right = hue(picture.at(5, 0));
    EXPECT_NE(left, right);
    EXPECT_EQ(std::set({left, right}), std::set({'r', 'g'}));
    EXPECT_EQ(left, hue(picture.at(-6, 8)));
}

TEST(SolidRaster, StemsAreRoundAndAsWideAsTheirPens) {
    Print print = pixel_print(64);
    print.style.palette = {white};
    print.style.ground = black;
    const Picture picture = picture_of("axiom: $!(12)f(-20)F(20)!(4)F(20)\n", print);
    const auto width = [&](int y) {
        int sum = 0;
        for (int x = -32; x < 32; ++x) sum += picture.at(x, y).x > 0 ? 1 : 0;
        return sum;
    };
    EXPECT_EQ(width(-10), 12);
    EXPECT_NEAR(width(10), 8, 1) << "it tapers";
    EXPECT_NEAR(width(18), 5, 1);
    // Lit from the left: brightest there, darker towards the right edge.
    EXPECT_GT(picture.at(-3, -10).x, picture.at(4, -10).x + 30);
    // Ends are round: below the start half a circle of radius 6.
    EXPECT_EQ(hue(picture.at(0, -24)), hue(picture.at(0, -20)));
    EXPECT_EQ(picture.at(5, -25).x, 0);
}

TEST(SolidRaster, PolygonsThatCrossThemselvesAreFilledByWinding) {
    const Print print = pixel_print(64);
    // A pentagram: its middle is inside, what lies between two tips is not.
    const std::string star =
        "turn: left\nangle increment: 144\naxiom: ^(0)[f(-15)+(90)f(15)-(90)-(18){f(30)-f(30)-f(30)-f(30)-f(30)}]\n";
    const Picture picture = picture_of(star, print);
    int covered = 0;
    for (int y = -32; y < 32; ++y) {
        for (int x = -32; x < 32; ++x) covered += picture.at(x, y).y < 128 ? 1 : 0;
    }
    // Of a pentagram with sides of 30 the area is 0.31 x 900, all it runs around.
    EXPECT_NEAR(covered, 279, 14);
}

TEST(SolidRaster, SpheresStandBeforeWhatTheyTouch) {
    const Print print = pixel_print(64);
    const Picture picture = picture_of("turn: left\naxiom: $" + square + ";@O(6)\n", print);
    EXPECT_EQ(hue(picture.at(0, 0)), 'g');
    EXPECT_EQ(hue(picture.at(8, 8)), 'r');
    int covered = 0;
    for (int y = -10; y < 10; ++y) {
        for (int x = -10; x < 10; ++x) covered += hue(picture.at(x, y)) == 'g' ? 1 : 0;
    }
    EXPECT_NEAR(covered, M_PI * 36, 12);
}

TEST(SolidRaster, ThreadsAndBandsDoNotShow) {
    Print print = pixel_print(300);
    const std::string text =
        "turn: left\nangle increment: 25\nderivation length: 4\naxiom: !(2)A\nA --> F(12)[&;A]////[&,A]//[^A]\n"
        "F --> F\n";
    const Picture one = picture_of(text, print, 1);
    for (const int threads : {2, 7}) EXPECT_EQ(picture_of(text, print, threads).bytes, one.bytes);
    const Scene scene = scene_of(text, print.style);
    const auto raster = make_solid_raster(scene, print);
    std::vector<std::uint8_t> rows;
    raster->render_rows(128, 300, raster->channels(), [&](int, int, std::span<const std::uint8_t> more) {
        rows.insert(rows.end(), more.begin(), more.end());
    });
    EXPECT_EQ(rows, std::vector<std::uint8_t>(one.bytes.begin() + 128 * 300 * one.channels, one.bytes.end()));
}

TEST(SolidRaster, GroundThatIsNoneIsTransparentAndGreyIsOneChannel) {
    Print print = pixel_print(64);
    print.style.ground.reset();
    EXPECT_EQ(picture_of("axiom: $F(10)\n", print).channels, 4);
    print.style.ground = white;
    EXPECT_EQ(picture_of("axiom: $F(10)\n", print).channels, 3);
    EXPECT_EQ(picture_of("axiom: $,F(10)\n", print).channels, 1) << "black on white";
}

TEST(Scene, LettersFaceTheEye) {
    for (const char* view : {"front", "side", "top", "30 20", "200 -50"}) {
        Style style;
        style.camera = *parse_camera(view);
        const Scene scene = scene_of("axiom: f(3)&N(358)\nlabel N: {1}\nlettering: 2\n", style);
        const Projection eye(style.camera, {});
        const glm::dvec3 middle = eye({0, 3, 0});
        glm::dvec3 low(1e9), high(-1e9);
        for (const SceneSegment& segment : scene.segments()) {
            const glm::dvec3 from = scene.at(segment.from), to = scene.at(segment.to);
            for (const glm::dvec3& end : {eye(from), eye(to)}) {
                EXPECT_NEAR(end.z, middle.z, 1e-5) << view;
                low = glm::min(low, end);
                high = glm::max(high, end);
            }
        }
        EXPECT_GT(scene.segments().size(), 20u) << view;
        // Upright, and as large as on a page.
        EXPECT_NEAR((low.y + high.y) / 2, middle.y, 0.05) << view;
        EXPECT_NEAR(high.y - low.y, 2, 0.05) << view;
        EXPECT_NEAR(high.x - low.x, text_width("358", 2), 0.6) << view;
    }
}

// --- vectors -----------------------------------------------------------------------------------------------------

/// Polygons in the order in which they come.
class Polygons : public PolygonSink {
public:
    void begin_stroke(glm::dvec2, const Pen&) override { ++strokes; }
    void lines(std::span<const glm::dvec2> ends) override { lines_drawn += ends.size(); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        shapes.emplace_back(vertices.begin(), vertices.end());
        colours.push_back(pen.colour);
    }
    void disc(glm::dvec2, double, const Pen&) override { ++discs; }

    std::vector<std::vector<glm::dvec2>> shapes;
    std::vector<int> colours;
    std::size_t strokes = 0, lines_drawn = 0, discs = 0;
};

TEST(Solids, ComeFromTheBackToTheFront) {
    Print print = pixel_print(64);
    const std::string behind = "[&(90)f(5)^(90)" + square + "]", front = "[;^(90)f(5)&(90)" + square + "]";
    for (const bool turned : {false, true}) {
        Style style = print.style;
        style.camera.azimuth = turned ? 180 : 0;
        const Scene scene = scene_of("turn: left\naxiom: " + front + behind + "\n", style);
        print.style = with_shades(style);
        Polygons polygons;
        draw_solids(scene, print, polygons);
        ASSERT_EQ(polygons.shapes.size(), 2u);
        const auto colour = [&](std::size_t i) {
            return hue(glm::ivec3(print.style.fill_colour(Pen{.colour = polygons.colours[i]}).red,
                                  print.style.fill_colour(Pen{.colour = polygons.colours[i]}).green, 0));
        };
        EXPECT_EQ(colour(0), turned ? 'g' : 'r');
        EXPECT_EQ(colour(1), turned ? 'r' : 'g');
    }
}

TEST(Solids, ShadesAreThePaletteUnderMoreOrLessLight) {
    Style style;
    style.palette = {red, white};
    style.stroke_colour = blue;
    const Style shaded = with_shades(style);
    EXPECT_EQ(shaded.line_colour(Pen{}), blue);
    EXPECT_EQ(shaded.palette[1], white);
    EXPECT_EQ((shaded.palette.size() - 2) % 4, 0u);
    const Colour brightest = shaded.palette[shaded.palette.size() - 4];
    EXPECT_EQ(brightest.blue, 255) << "of lines";
    EXPECT_EQ(brightest.red, 56) << "a sheen";
    EXPECT_EQ(shaded.palette[shaded.palette.size() - 1], white);
}

TEST(Solids, AStemIsAnOutline) {
    Print print = pixel_print(64);
    const Scene scene = scene_of("axiom: $!(0.1)F(10)F(10)[&F(5)]@O(2)\n", print.style);
    print.style = with_shades(print.style);
    Polygons polygons;
    draw_solids(scene, print, polygons);
    EXPECT_EQ(polygons.strokes, 0u);
    EXPECT_GE(polygons.shapes.size(), 4u);
}

TEST(Scene, HasALimitAndLeavesOutWhatIsNotSeen) {
    const Grammar grammar = grammar_of("axiom: $A\nA --> FA\nderivation length: 100\n");
    Style style;
    style.palette = {black};
    EXPECT_EQ(Scene::of(grammar, style, {.interpreted = true}, 100).segments().size(), 100u);
    EXPECT_THROW(Scene::of(grammar, style, {.interpreted = true}, 99), BudgetError);
    EXPECT_THROW(scene_of("axiom: $F(1e30)\n", style), BudgetError);
    style.palette = {black, {0, 0, 0, 0}};
    const Scene seen = scene_of("axiom: $F;F@O{F+F},F\n", style);
    EXPECT_EQ(seen.segments().size(), 2u);
    EXPECT_FALSE(seen.segments()[1].goes_on);
    EXPECT_TRUE(seen.polygons().empty() && seen.spheres().empty());
}

// --- models ------------------------------------------------------------------------------------------------------

struct Obj {
    std::vector<glm::dvec3> vertices, normals;
    std::vector<std::array<std::size_t, 3>> faces;
    std::vector<std::string> materials;
};

Obj read_obj(const std::string& text) {
    Obj obj;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v" || kind == "vn") {
            glm::dvec3 at;
            words >> at.x >> at.y >> at.z;
            (kind == "v" ? obj.vertices : obj.normals).push_back(at);
        } else if (kind == "usemtl") {
            words >> obj.materials.emplace_back();
        } else if (kind == "f") {
            std::array<std::size_t, 3> face{};
            for (std::size_t& corner : face) {
                std::string word;
                words >> word;
                corner = std::stoul(word) - 1;
                EXPECT_EQ(word, std::to_string(corner + 1) + "//" + std::to_string(corner + 1));
            }
            obj.faces.push_back(face);
        }
    }
    return obj;
}

TEST(Model, TubesAndSpheresAreClosedAndFaceOutwards) {
    const ScratchFolder folder;
    Print print = pixel_print(64);
    const auto volume_of = [&](const std::string& word) {
        const Scene scene = scene_of("turn: left\naxiom: " + word + "\n", print.style);
        write_model(scene, print, PrintFormat::obj, folder.file("a.obj"));
        const Obj obj = read_obj(contents(folder.file("a.obj")));
        EXPECT_EQ(obj.vertices.size(), obj.normals.size());
        // By place, as caps have corners of their own: each edge is walked once in each direction.
        std::map<std::array<long, 3>, int> places;
        const auto place = [&](std::size_t corner) {
            const glm::dvec3 at = obj.vertices.at(corner);
            const std::array<long, 3> key = {std::lround(at.x * 1e4), std::lround(at.y * 1e4),
                                             std::lround(at.z * 1e4)};
            return places.try_emplace(key, static_cast<int>(places.size())).first->second;
        };
        std::map<std::pair<int, int>, int> edges;
        double volume = 0;
        for (const auto& face : obj.faces) {
            for (std::size_t i = 0; i < 3; ++i) ++edges[{place(face[i]), place(face[(i + 1) % 3])}];
            volume += glm::dot(obj.vertices[face[0]], glm::cross(obj.vertices[face[1]], obj.vertices[face[2]])) / 6;
        }
        for (const auto& [edge, count] : edges) {
            EXPECT_EQ(count, 1) << word;
            EXPECT_TRUE(edges.contains({edge.second, edge.first})) << word;
        }
        return volume;
    };
    const double octagon = 2 * std::sqrt(2.0);  // of radius 1
    EXPECT_NEAR(volume_of("$!(2)F(10)"), octagon * 10, 1e-3);
    EXPECT_NEAR(volume_of("$!(2)F(10)&(20)F(10)&(20)F(10)"), octagon * 30, 3);
    // The second of these is the frustum between the radii 2 and 1.
    EXPECT_NEAR(volume_of("$!(4)F(10)!(2)F(10)"), octagon * 40 + octagon * 10 * (4 + 2 + 1) / 3.0, 1e-2);
    EXPECT_NEAR(volume_of("$@O(3)"), 4.0 / 3 * M_PI * 27, 10);
}

TEST(Model, GlbHoldsWhatObjHolds) {
    const ScratchFolder folder;
    Print print = pixel_print(64);
    print.title = "A \"plant\"";
    const Scene scene = scene_of("turn: left\naxiom: $F(10)[;&F(5)@O(2)][{f(3)+f(3)+f(3)}]\n", print.style);
    const ModelReport obj_report = write_model(scene, print, PrintFormat::obj, folder.file("b.obj"));
    const ModelReport glb_report = write_model(scene, print, PrintFormat::glb, folder.file("b.glb"));
    EXPECT_EQ(obj_report.triangles, glb_report.triangles);
    EXPECT_EQ(glb_report.materials, 4u) << "lines and fills in two colours";
    const Obj obj = read_obj(contents(folder.file("b.obj")));
    EXPECT_EQ(obj.faces.size(), obj_report.triangles);
    EXPECT_EQ(obj.materials.size(), 4u);
    const std::string materials = contents(folder.file("b.mtl"));
    for (const std::string& name : obj.materials) EXPECT_TRUE(has(materials, "newmtl " + name + "\n"));

    const std::string glb = contents(folder.file("b.glb"));
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, glb.data() + at, 4);
        return value;
    };
    ASSERT_GT(glb.size(), 28u);
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2u);
    EXPECT_EQ(number(8), glb.size());
    EXPECT_EQ(glb.substr(16, 4), "JSON");
    const std::size_t json = number(12), binary = 20 + json;
    EXPECT_EQ(glb.substr(binary + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(number(binary), glb.size() - binary - 8);
    EXPECT_TRUE(has(glb.substr(20, json), "\"A \\\"plant\\\"\""));
    // The first floats are those of the first vertex.
    float first[3];
    std::memcpy(first, glb.data() + binary + 8, sizeof(first));
    EXPECT_EQ(glm::dvec3(first[0], first[1], first[2]), obj.vertices.front());
}

TEST(Model, WhatHasNoWidthIsRefusedAndLeavesNothing) {
    const ScratchFolder folder;
    Print print = pixel_print(64);
    const Scene scene = scene_of("axiom: $F(0)\n", print.style);
    EXPECT_THROW(write_model(scene, print, PrintFormat::glb, folder.file("c.glb")), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder.file("c.glb")));
    EXPECT_EQ(print_format("x.GLB"), PrintFormat::glb);
    EXPECT_FALSE(print_format("x.gltf"));
}

}  // namespace sikku::scene_test
