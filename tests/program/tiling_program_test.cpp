// tests/program/tiling_program_test.cpp: `sikku tiling` as text and as JSON.
#include "tests/maps.h"
#include "tests/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace sikku::tiling_program_test {

using Json = nlohmann::json;

Json tiling(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"tiling", "--json"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return Json::parse(outcome.output);
}

TEST(TilingCommand, ReportsTheCertificate) {
    const Outcome outcome = run({"tiling", "penrose-rhombs"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.output.starts_with("Penrose rhombs, n = 5\n"));
    EXPECT_TRUE(tiling({"penrose-rhombs"})["tiling"].get<bool>());
    const Outcome no = run({"tiling", "koch-island", "-n", "1"});
    EXPECT_EQ(no.status, 0);
    EXPECT_TRUE(has(no.output, "tiling     no: "));
}

TEST(TilingCommand, CountsWithoutDeriving) {
    const Outcome outcome = run({"tiling", "chair", "-n", "60", "--counts"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.output, "tiles      1329227995784915872903807060280344576\n"));
    EXPECT_EQ(tiling({"chair", "-n", "60", "--counts"})["growth"]["counts"].size(), 4U);
    EXPECT_LT(outcome.seconds, 1.0);
}

/// Rounded to a micrometre and read back, tilings have the same tiles.
TEST(TilingCommand, CertifiesItsOwnPicturesAndLists) {
    const ScratchFolder folder;
    const std::string picture = folder.file("tiles.svg");
    const Json exact = tiling({"danzer", "-n", "3"});
    ASSERT_EQ(run({"draw", "danzer", "-n", "3", "--name-tiles", "-o", picture}).status, 0);
    for (const std::string& file : {picture, folder.write("tiles.json", exact.dump())}) {
        EXPECT_EQ(tiling({file})["tiles"], exact["tiles"]);
    }
    const Outcome text = run({"tiling", picture});
    EXPECT_FALSE(has(text.output, "growth"));
    EXPECT_TRUE(has(text.output, "exact      no: corners within 0.0"));
    EXPECT_TRUE(has(text.errors, "1 ground left out\n"));
}

/// Pieces of files are those of the pattern that wrote them, at the length of a unit.
TEST(TilingCommand, CutsPiecesOfFiles) {
    const ScratchFolder folder;
    const std::string picture = folder.file("chairs.svg");
    ASSERT_EQ(run({"draw", "chair", "-n", "2", "--name-tiles", "--step", "5mm", "-o", picture}).status, 0);
    const std::string list = folder.write("chairs.json", tiling({"chair", "-n", "2"}).dump());
    const auto pieces = [](const Json& json) {
        std::map<int, std::pair<int, double>> by_colour;  // number and area of all
        for (const Json& row : json["kinds"]) {
            auto& [count, area] = by_colour[row["colour"].get<int>()];
            count += row["pieces"].get<int>();
            area = row["area"].get<double>();
        }
        std::multiset<int> counts;
        for (const auto& [colour, piece] : by_colour) {
            EXPECT_NEAR(piece.second, 3 * 25.0, 0.1) << colour;
            counts.insert(piece.first);
        }
        return counts;
    };
    const std::multiset<int> exact = pieces(tiling({"chair", "-n", "2", "--cut-list", "--step", "5mm"}));
    EXPECT_EQ(exact, (std::multiset<int>{2, 4, 4, 6}));
    for (const auto& [file, step] : {std::pair(picture, "1mm"), std::pair(list, "5mm")}) {
        SCOPED_TRACE(file);
        EXPECT_EQ(pieces(tiling({file, "--cut-list", "--step", step})), exact);
        const Outcome drawn = run({"tiling", file, "--templates", "3mm", "--step", step, "-o", folder.file("t.svg")});
        EXPECT_EQ(drawn.status, 0) << drawn.errors;
        EXPECT_GT(std::filesystem::file_size(folder / "t.svg"), 500U);
        const Outcome laid =
            run({"tiling", file, "--cutting-sheet", "60x60mm", "--step", step, "-o", folder.file("sheet.svg")});
        EXPECT_EQ(laid.status, 0) << laid.errors;
        for (int i = 1; i <= 4; ++i) {  // one for each colour
            const std::string name = "sheet-" + std::to_string(i) + ".svg";
            EXPECT_TRUE(has(laid.output, name));
            EXPECT_TRUE(std::filesystem::remove(folder / name)) << name;
        }
        EXPECT_TRUE(std::filesystem::remove(folder / "t.svg"));
        EXPECT_FALSE(std::filesystem::exists(folder / "sheet.svg"));
        const Outcome small =
            run({"tiling", file, "--cutting-sheet", "25x25mm", "--step", step, "-o", folder.file("small.svg")});
        EXPECT_EQ(small.status, 1);
        EXPECT_TRUE(has(small.errors, " mm within their margins\n"));
    }
    EXPECT_EQ(folder.names().size(), 2U);
}

TEST(TilingCommand, RefusesDamagedFilesOfPolygons) {
    const ScratchFolder folder;
    const std::string bad = folder.write("bad.json", "[[[0,0],[1,0],\n[0]]]");
    const Outcome outcome = run({"tiling", bad});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "bad.json: polygon 1: corner 3: expected [x, y], not 1 number\n"));
    EXPECT_EQ(run({"tiling", folder.write("none.json", "[]")}).status, 1);
    EXPECT_EQ(run({"tiling", "no-such-file.svg"}).status, 1);
    EXPECT_EQ(run({"tiling", bad, "-n", "3"}).status, 2);
    EXPECT_EQ(run({"tiling", bad, "--counts"}).status, 2);
    EXPECT_EQ(run({"tiling", "chair", "--tolerance", "0.1"}).status, 2);
    EXPECT_EQ(run({"tiling", bad, "--tolerance", "0"}).status, 2);
}

TEST(TilingCommand, RefusesInOneLine) {
    const Outcome many = run({"tiling", "chair", "-n", "40"});
    EXPECT_EQ(many.status, 1);
    EXPECT_TRUE(has(many.errors, "n = 40 makes about 1.21e+24 tiles; at most 10000000 are examined"));
    EXPECT_TRUE(has(many.errors, "--counts"));
    EXPECT_EQ(run({"tiling", "penrose-rhombs", "--budget", "100"}).status, 1);
    const ScratchFolder folder;
    const Outcome map = run({"tiling", folder.write("layer.lsys", maps::layer)});
    EXPECT_EQ(map.status, 2);
    EXPECT_TRUE(has(map.errors, "a map has no turtle, so it draws no tiles"));
    EXPECT_TRUE(has(run({"tiling", "bush-3d"}).errors, "a tiling lies in the plane"));
    EXPECT_EQ(run({"tiling"}).status, 2);
    EXPECT_EQ(run({"tiling", "no-such-pattern"}).status, 2);
}

}  // namespace sikku::tiling_program_test
