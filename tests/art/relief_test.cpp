// tests/art/relief_test.cpp: reliefs as files, read back and compared with areas, other writers and pixels.
#include "art/prints.h"
#include "art/provenance/provenance.h"
#include "engine/base/output.h"
#include "tests/files.h"
#include "tests/solid_reader.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sikku::relief_test {

constexpr double pi = std::numbers::pi;

Document document(const std::string& keys, const std::string& axiom) {
    return parse("relief.lsys",
                 "title: Relief\nangle increment: 90\nderivation length: 0\nstroke: 1mm #203060\n"
                 "palette: #203060 #c04020 #30a050\n" +
                     keys + "axiom: " + axiom + "\n");
}

/// On a page of 100 x 100 mm, with steps of 10 mm, unless `values` override these.
OptionValues with(OptionValues values) {
    for (const OptionValue& usual : OptionValues{{"size", "100x100mm"}, {"step", "10mm"}}) {
        const auto is_same = [&](const OptionValue& value) { return value.name == usual.name; };
        if (std::none_of(values.begin(), values.end(), is_same)) values.push_back(usual);
    }
    return values;
}

ReadMesh stl(const Document& drawn, const OptionValues& values) {
    ReadMesh mesh = read_stl(draw(drawn, "stl", with(values)));
    expect_closed(mesh);
    return mesh;
}

/// Volume above a base of 1 mm on the whole page.
double raised(const Document& drawn, OptionValues values) {
    values.push_back({"base", "1mm"});
    const ReadMesh mesh = stl(drawn, values);
    EXPECT_EQ(mesh.low(), glm::dvec3(0));
    EXPECT_EQ(glm::dvec2(mesh.high()), glm::dvec2(100));
    return mesh.volume() - 100 * 100;
}

const std::string square = "{F+F+F+F+}";
const std::string two_squares = "{F+F+F+F+;(1)}f{F+F+F+F+;(2)}";  // side by side

TEST(Relief, NormalsAreThoseOfTheWrittenCorners) {
    // Many small triangles: their normals change most if a compiler omits the rounding of corners.
    const Document kolam = load("snake-kolam", {"", {{"derivation length", "2"}}});
    const ReadMesh mesh = stl(kolam, {{"size", "90x90mm"}, {"step", "8mm"}});
    EXPECT_GT(mesh.triangles.size(), 5'000U);
}

TEST(Relief, RaisesShapesByTheirColours) {
    EXPECT_NEAR(raised(document("", square), {{"groove", "0mm"}}), 100 * 2, 0.02) << "by default, 2 mm";
    EXPECT_NEAR(raised(document("", square), {{"groove", "0mm"}, {"relief", "3mm"}}), 300, 0.02);
    const Document two = document("", two_squares);
    EXPECT_NEAR(raised(two, {{"groove", "0mm"}, {"relief", "3mm,5mm"}}), 800, 0.02);
    EXPECT_NEAR(raised(two, {{"groove", "0mm"}, {"relief", "3mm"}}), 600, 0.02);
    EXPECT_NEAR(raised(two, {{"groove", "1mm"}, {"relief", "3mm,5mm"}}), 8 * 9 * 9, 0.02);
    EXPECT_NEAR(raised(two, {{"groove", "0mm"}, {"relief", "-0.5mm,5mm"}}), 450, 0.02);
    EXPECT_NEAR(raised(two, {{"groove", "0mm"}, {"relief", "0mm,5mm"}}), 500, 0.02);
    // The rule of `tile colours` gives both the same colour.
    EXPECT_NEAR(raised(document("tile colours: by shape\n", two_squares), {{"groove", "0mm"}, {"relief", "3mm,5mm"}}),
                600, 0.02);
    EXPECT_NEAR(
        raised(document("tile colours: by neighbours\n", two_squares), {{"groove", "0mm"}, {"relief", "3mm,5mm"}}),
        800, 0.02);
}

TEST(Relief, NeighboursWithoutAGrooveShareTheirWalls) {
    const OptionValues flat = {{"groove", "0mm"}, {"relief", "3mm"}};
    const ReadMesh one = stl(document("", two_squares), flat);
    EXPECT_EQ(one.triangles.size(), 2u + 8u + 2u + 8u + 8u) << "a bar on a plate";
    const ReadMesh stairs = stl(document("", two_squares), {{"groove", "0mm"}, {"relief", "3mm,5mm"}});
    EXPECT_GT(stairs.triangles.size(), one.triangles.size());
}

TEST(Relief, RaisesLinesAsWideAsTheirPens) {
    // Chords are within 0.01 mm.
    EXPECT_NEAR(raised(document("", "FF"), {}), 2 * (20 * 1 + pi / 4), 0.05);
    EXPECT_NEAR(raised(document("", "FF"), {{"stroke", "4mm"}, {"relief", "1mm"}}), 80 + 4 * pi, 0.3);
    EXPECT_NEAR(raised(document("", "F+F"), {{"stroke", "2mm"}, {"relief", "1mm"}}), 40 - 1 + pi / 4 + pi, 0.1);
    EXPECT_NEAR(raised(document("", "FF"), {{"relief", "-0.25mm"}}), -0.25 * (20 + pi / 4), 0.02);
    EXPECT_NEAR(raised(document("", "#(3)F!(1)F"), {{"relief", "1mm"}}),
                10 * 3 + pi * 9 / 4 + 10 - 1.5 + 0.03 + pi / 8, 0.15)
        << "two pens in one line";
    EXPECT_NEAR(raised(document("fill: #203060\n", "@O(2)"), {{"relief", "1mm"}}), pi * 400, 1.5) << "a disc";
}

/// The area of black ink in a picture, in square millimetres.
double ink(const Document& drawn, OptionValues values) {
    values.push_back({"dpi", "254"});
    const DrawnPixels pixels = draw_pixels(drawn, values);
    double sum = 0;
    for (std::size_t i = 0; i < pixels.bytes.size(); i += 4) sum += 255 - pixels.bytes[i];
    return sum / 255 / 100;
}

/// The rasteriser computes the coverage of pixels from distances to lines, without any outlines.
TEST(Relief, CoversWhatPicturesCover) {
    const std::vector<std::pair<const char*, OptionValues>> cases = {
        {"snake-kolam", {{"n", "2"}, {"dots", "3mm black"}}},
        {"snake-kolam", {{"n", "2"}, {"parallel", "3"}}},
        {"mango-leaves", {{"n", "3"}, {"repeat", "p4m:2x2"}}},
        {"kolam-9x9-k9cp4nzt", {}},
        {"kolam-9x9-k9cp4nzt", {{"stroke", "2mm black"}}},
        {"kolam-radial-12x7", {{"title-line", "Radial"}, {"rotate", "20"}}},
        {"dragon", {{"n", "10"}}},
        {"hexagonal-gosper", {{"n", "3"}, {"stroke", "3mm black"}}},
        {"plant-d", {{"n", "4"}, {"mirror", "true"}}},
    };
    for (const auto& [pattern, own] : cases) {
        SCOPED_TRACE(pattern);
        OptionValues values = own;
        std::string n;
        std::erase_if(values, [&](const OptionValue& value) {
            if (value.name == "n") n = value.text;
            return value.name == "n";
        });
        const bool has_stroke =
            std::any_of(values.begin(), values.end(), [](const auto& v) { return v.name == "stroke"; });
        if (!has_stroke) values.push_back({"stroke", "1.2mm black"});
        values.insert(values.end(), {{"ground", "white"}, {"palette", "black"}, {"size", "100x100mm"}});
        const Document drawn = n.empty() ? load(pattern) : load(pattern, {"", {{"test", "derivation length", n}}});
        const double area = ink(drawn, values);
        values.insert(values.end(), {{"relief", "1mm"}, {"base", "1mm"}});
        const ReadMesh mesh = read_stl(draw(drawn, "stl", values));
        expect_closed(mesh);
        EXPECT_GT(area, 100);
        EXPECT_NEAR(mesh.volume() - 10'000, area, 0.004 * area);
    }
}

TEST(Relief, TilesHaveTheVolumeOfTheirPrisms) {
    const Document drawn = load("penrose-rhombs", {"", {{"test", "derivation length", "4"}}});
    const OptionValues size = {{"size", "150x150mm"}, {"step", "5mm"}};
    // In the pattern, the thin rhombs with angles of 36 degrees have the first colour, the thick ones of 72 the
    // second.
    OptionValues named = size;
    named.push_back({"name-tiles", "true"});
    const std::string svg = draw(drawn, "svg", named);
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (std::size_t at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1)) ++found;
        return static_cast<double>(found);
    };
    const double thin = count("colour-1\""), thick = count("colour-2\"");
    ASSERT_GT(thick + thin, 100);
    for (const double groove : {0.0, 0.4}) {
        const auto area = [&](double angle) {
            // What is left of a rhomb is a smaller one.
            const double height = 5 * std::sin(angle * pi / 180);
            return 25 * std::sin(angle * pi / 180) * std::pow((height - groove) / height, 2);
        };
        OptionValues values = size;
        values.insert(values.end(), {{"relief", "2mm,3mm"}, {"groove", groove > 0 ? "0.4mm" : "0mm"}});
        const ReadMesh mesh = read_stl(draw(drawn, "stl", values));
        expect_closed(mesh);
        const double base = 150 * 150 * 1.2;
        EXPECT_NEAR(mesh.volume(), base + thin * area(36) * 2 + thick * area(72) * 3, 1.5);
    }
}

TEST(Relief, LeavesOutLinesAlongTiles) {
    const std::string bare = draw(document("", two_squares), "stl", with({{"stroke", "none"}}));
    EXPECT_EQ(draw(document("", two_squares), "stl", with({})), bare);
    EXPECT_EQ(draw(document("tile edges: once\n", two_squares), "stl", with({})), bare);
    // Other lines lie over tiles: here across both.
    const Document crossed = document("", two_squares + "+f(0.5)-f(-2)F(4)");
    EXPECT_NEAR(raised(crossed, {{"relief", "2mm"}, {"ridge", "3mm"}, {"groove", "0mm"}}) - 400,
                20 * 1 + 3 * (20 + pi / 4), 0.2);
    // Fields end at the lines around them, which are kept.
    const Document kolam = load("snake-kolam", {"", {{"test", "derivation length", "1"}}});
    const OptionValues fields = {
        {"fields", "chessboard"}, {"relief", "1mm"}, {"ridge", "2mm"}, {"stroke", "2mm black"}};
    EXPECT_NEAR(stl(kolam, fields).high().z, 3.2, 1e-5);
}

TEST(Relief, TheBaseIsThePageOrFollowsTheDrawing) {
    const Document drawn = document("", square);
    const auto size = [&](const OptionValues& values) {
        const ReadMesh mesh = stl(drawn, values);
        return mesh.high() - mesh.low();
    };
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
        EXPECT_LT(glm::distance(a, b), 0.002) << a.x << ' ' << a.y << ' ' << a.z;
    };
    near(size({}), {100, 100, 3.2});
    near(size({{"base", "2mm,3mm"}}), {16, 16, 4});
    near(size({{"base", "2mm,0mm"}}), {10, 10, 4});
    near(size({{"base", "0mm"}}), {9.6, 9.6, 2});
    // Rounded at its corners.
    const ReadMesh around = stl(drawn, {{"base", "1mm,2mm"}, {"groove", "0mm"}, {"relief", "1mm"}});
    EXPECT_NEAR(around.volume(), 100 + 100 + 4 * 20 + pi * 4, 0.1);
    // It ends with the page.
    const ReadMesh cut = stl(drawn, {{"step", "90mm"}, {"margin", "0mm"}, {"base", "1mm,8mm"}});
    near(cut.high() - cut.low(), {100, 100, 3});
}

TEST(Relief, ShapesEndAtTheEdgeOfThePage) {
    const ReadMesh mesh = stl(document("", square), {{"step", "300mm"}, {"relief", "1mm"}, {"base", "1mm"}});
    EXPECT_EQ(mesh.high(), glm::dvec3(100, 100, 2));
    EXPECT_EQ(mesh.triangles.size(), 12u) << "a block";
    const Document tiling = load("penrose-rhombs");
    const ReadMesh filled =
        read_stl(draw(tiling, "stl", {{"size", "60x60mm"}, {"fill-page", "true"}, {"step", "8mm"}, {"groove", "0"}}));
    expect_closed(filled);
    EXPECT_NEAR(filled.volume(), 60 * 60 * 3.2, 0.5) << "tiles everywhere";
    // A swatch is not stretched to whole pixels.
    const ReadMesh swatch =
        read_stl(draw(load("honeycomb"), "stl", {{"swatch", ""}, {"step", "5mm"}, {"groove", "0"}}));
    expect_closed(swatch);
    EXPECT_NEAR(swatch.high().x, 15, 0.002);
    EXPECT_NEAR(swatch.high().y, 15 * std::sqrt(3.0), 0.002);
}

TEST(Relief, PrismsThatTouchAtACornerAreJoined) {
    // Squares that touch at a corner only, with and without a base.
    const Document touching = document("", square + "f-f+" + square);
    for (const char* base : {"1mm", "0mm", "1mm,0mm"}) {
        const ReadMesh mesh = stl(touching, {{"groove", "0mm"}, {"base", base}});
        EXPECT_NEAR(mesh.volume(),
                    std::string(base) == "1mm"   ? 10'400
                    : std::string(base) == "0mm" ? 400
                                                 : 600,
                    0.02);
    }
}

TEST(Relief, ModelsHaveAMaterialForEachColour) {
    const Document drawn = document("ground: #f0e0c0\n", two_squares);
    const OptionValues values = with({{"relief", "2mm,3mm"}});
    nlohmann::json json;
    const ReadMesh glb = read_glb_mesh(draw(drawn, "glb", values), &json);
    expect_closed(glb);
    ASSERT_EQ(json["materials"].size(), 3u);
    EXPECT_EQ(json["materials"][0]["name"], "relief-f0e0c0");
    EXPECT_EQ(json["materials"][1]["name"], "relief-c04020");
    EXPECT_EQ(json["materials"][2]["name"], "relief-30a050");
    // Metres, y up: z becomes y.
    EXPECT_EQ(json["nodes"][0]["scale"], nlohmann::json({0.001, 0.001, 0.001}));
    const auto turn = json["nodes"][0]["rotation"];
    EXPECT_NEAR(turn[0].get<double>(), -std::numbers::sqrt2 / 2, 1e-8);
    EXPECT_NEAR(turn[3].get<double>(), std::numbers::sqrt2 / 2, 1e-8);
    const ReadMesh solid = read_stl(draw(drawn, "stl", values));
    EXPECT_NEAR(glb.volume(), solid.volume(), 1e-3);
    for (std::size_t t = 0; t < glb.triangles.size(); ++t) {
        double top = 0;
        for (const std::uint32_t corner : glb.triangles[t]) top = std::max(top, glb.points[corner].z);
        EXPECT_LT(top, glb.materials[t] == 0 ? 1.201 : glb.materials[t] == 1 ? 3.201 : 4.201);
    }
    const auto files = made_work(prints(), drawn, "obj", values).outputs;
    const ReadMesh obj = read_obj_mesh(files.at("x.obj"));
    expect_closed(obj);
    EXPECT_EQ(obj.triangles, glb.triangles);
    EXPECT_EQ(std::set<std::size_t>(obj.materials.begin(), obj.materials.end()).size(), 3u);
    EXPECT_TRUE(has(files.at("x.mtl"), "newmtl relief-30a050"));
    EXPECT_FALSE(has(files.at("x.obj"), "vn "));
}

TEST(Relief, IsTheSameInEveryRun) {
    const Document drawn = load("snake-kolam", {"", {{"test", "derivation length", "2"}}});
    const std::string once = draw(drawn, "stl", with({{"dots", ""}}));
    EXPECT_EQ(draw(drawn, "stl", with({{"dots", ""}})), once);
    EXPECT_EQ(once.substr(0, 80).find_first_not_of("Binary STL in millimetres, sikku 0123456789."),
              std::string::npos);
}

TEST(Relief, FilesOtherThanStlContainTheirPattern) {
    const ScratchFolder folder;
    const Document drawn = document("", square);
    for (const char* name : {"r.stl", "r.glb", "r.obj"}) {
        const std::string format = std::string(name).substr(2);
        prints().plan(drawn, format, with({{"relief", ""}}))->make(file_system(), folder.file(name), {});
        ASSERT_TRUE(known_format(folder.file(name)));
        EXPECT_EQ(known_format(folder.file(name))->has_pattern, format != "stl");
    }
    EXPECT_EQ(read_provenance(folder.file("r.glb"))->pattern, drawn.source().text());
    EXPECT_EQ(read_provenance(folder.file("r.obj"))->pattern, drawn.source().text());
    EXPECT_TRUE(has(error_of<std::runtime_error>([&] { read_provenance(folder.file("r.stl")); }),
                    "r.stl: this STL file has no room for the pattern"));
}

std::string refusal(const Document& drawn, const std::string& format, const OptionValues& values) {
    return error_of([&] { remarks_about(prints(), drawn, format, values); }, "made");
}

TEST(Relief, SaysWhatItCannotDo) {
    const Document drawn = document("", square);
    const auto expect = [&](const std::string& format, const OptionValues& values, const char* text) {
        EXPECT_TRUE(has(refusal(drawn, format, values), text));
    };
    expect("svg", {{"relief", "2mm"}}, "a relief is STL, OBJ or glTF");
    expect("svg", {{"groove", "1mm"}}, "needs 'relief' or STL");
    expect("glb", {{"ridge", "1mm"}}, "needs 'relief' or STL");
    expect("stl", {{"relief", "2mm,,3mm"}}, "expected a length");
    expect("stl", {{"relief", "1001mm"}}, "at most 1 m");
    expect("stl", {{"relief", "-1.2mm"}}, "does not fit into a base of 1.2 mm");
    expect("stl", {{"relief", "-1.2mm"}, {"base", "1.5mm"}}, "made");
    expect("stl", {{"ridge", "-1mm"}, {"base", "0mm"}}, "does not fit into a base of 0 mm");
    expect("stl", {{"base", "1mm,2mm,3mm"}}, "expected a length");
    expect("stl", {{"base", "-1mm"}}, "from 0 to 1 m");
    expect("stl", {{"groove", "-1mm"}}, "from 0 to 10 m");
    expect("stl", {{"groove", "400mm"}}, "a groove of 400 mm leaves nothing");
    expect("stl", {{"relief", "0mm"}}, "as high as the base");
    expect("stl", {{"stroke", "none"}, {"fill", "none"}, {"palette", "#00000000"}}, "nothing");
    expect("stl", {{"view", "top"}}, "neither camera nor light");
    expect("stl", {{"generations", "0:2"}}, "'frames' makes one of each generation");
    EXPECT_TRUE(has(refusal(load("bush-3d"), "stl", {}), "only to drawings in the plane"));
    EXPECT_TRUE(has(refusal(load("hilbert", {"", {{"test", "derivation length", "11"}}}), "stl", {}),
                    "34 million triangles, more than the limit of 8 million"));
}

TEST(Relief, MakesEachGeneration) {
    const MadeWork made = made_work(prints(), load("penrose-rhombs"), "stl",
                                    {{"generations", "1:3"}, {"frames", "true"}, {"size", "80x80mm"}});
    ASSERT_EQ(made.outputs.size(), 3u);
    for (const auto& [name, bytes] : made.outputs) expect_closed(read_stl(bytes));
}

/// Every kind of pattern, at a small size.
TEST(Relief, IsClosedForTilingsAndKolams) {
    const std::vector<std::pair<const char*, OptionValues>> cases = {
        {"chair", {{"groove", "0"}, {"tile colours", "by neighbours"}}},
        {"pinwheel", {{"groove", "0"}, {"tile colours", "by direction"}}},
        {"sphinx", {{"groove", "0"}, {"base", "0"}}},
        {"square-triangle", {{"groove", "0.2mm"}, {"base", "1mm,1mm"}}},
        {"rauzy", {{"groove", "0"}}},
        {"spiral-tiling", {}},
        {"hat", {{"tile colours", "by hand"}}},
        {"penrose-kite-dart", {{"groove", "0"}, {"base", "1mm,0mm"}}},
        {"filled-fractal", {{"groove", "0"}}},
        {"cell-layer", {{"ridge", "2mm,0.5mm"}}},
        {"simple-leaf", {}},
        {"bag-of-candies", {{"border", "lotus"}, {"dots", ""}}},
        {"scissors", {{"fields", "by kind"}, {"ridge", "3mm"}}},
    };
    for (const auto& [pattern, own] : cases) {
        SCOPED_TRACE(pattern);
        OptionValues values = own;
        values.insert(values.end(), {{"size", "70x70mm"}, {"relief", "1mm,2mm,3mm"}});
        const ReadMesh mesh = read_stl(draw(load(pattern), "stl", values));
        ASSERT_NO_FATAL_FAILURE(expect_closed(mesh));
        EXPECT_GT(mesh.volume(), 0);
    }
}

}  // namespace sikku::relief_test
