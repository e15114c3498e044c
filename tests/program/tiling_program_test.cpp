// tests/program/tiling_program_test.cpp: `sikku tiling` as text and as JSON.
#include "tests/maps.h"
#include "tests/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using Json = nlohmann::json;
using Point = std::pair<double, double>;

Json tiling(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"tiling", "--json"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return Json::parse(outcome.output);
}

Point point(const Json& json) {
    return {json[0].get<double>(), json[1].get<double>()};
}
double area(const Json& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point a = point(corners[i]), b = point(corners[(i + 1) % corners.size()]);
        twice += a.first * b.second - a.second * b.first;
    }
    return twice / 2;
}

TEST(TilingCommand, ReportsTheCertificate) {
    const Outcome outcome = run({"tiling", "penrose-rhombs"});
    EXPECT_EQ(outcome.status, 0);
    for (const char* line :
         {"Penrose rhombs, n = 5\n", "tiling     yes: 445 tiles, one region, no gap, no overlap\n",
          "shapes     2: 170 rhombs 36 144, in 5 orientations; 275 rhombs 72 108, in 5 orientations\n",
          "edges      935, edge-to-edge; 845 inner, 90 on the border, one loop\n",
          "vertices   491; 401 inner with 7 figures: 108.108.144 160, 36.72.36.108.108 90, 72.144.144 60, ",
          "neighbours 845 pairs; 4 for 380 tiles, 3 for 40, 2 for 25; 3 colours suffice, 2 do not\n",
          "symmetry   C5 about 0 0\n",
          "growth     1.618034 a step in length, τ; in the limit 0.381966 rhombs 36 144; 0.618034 rhombs 72 108",
          "exact      yes\n"}) {
        EXPECT_TRUE(has(outcome.output, line)) << line << "is not in\n" << outcome.output;
    }
    const Outcome no = run({"tiling", "koch-island", "-n", "1"});
    EXPECT_EQ(no.status, 0);
    EXPECT_TRUE(has(no.output, "tiling     no: "));
}

/// Reads the tiles back: corners from their whole coordinates, areas, and neighbours from the edges that tiles share.
TEST(TilingCommand, WritesTilesAsJson) {
    for (const char* name : {"penrose-rhombs", "ammann-beenker", "gosper-islands"}) {
        const Json json = tiling({name, "-n", "3"});
        EXPECT_TRUE(json["tiling"].get<bool>());
        const Json& list = json["list"];
        ASSERT_EQ(list.size(), json["tiles"].get<std::size_t>());
        const Json& basis = json["lattice"]["basis"];
        ASSERT_EQ(basis.size(), json["lattice"]["rank"].get<std::size_t>());
        std::map<std::pair<std::string, std::string>, int> owner;  // of edges in their direction
        double sum = 0;
        std::map<int, int> shapes;
        std::set<std::pair<int, std::string>> orientations;
        for (const Json& tile : list) {
            const Json &corners = tile["corners"], &exact = tile["exact"];
            ASSERT_EQ(corners.size(), exact.size());
            for (std::size_t i = 0; i < corners.size(); ++i) {
                double x = 0, y = 0;
                for (std::size_t j = 0; j < basis.size(); ++j) {
                    x += exact[i][j].get<double>() * basis[j][0].get<double>();
                    y += exact[i][j].get<double>() * basis[j][1].get<double>();
                }
                EXPECT_NEAR(x, corners[i][0].get<double>(), 1e-6);
                EXPECT_NEAR(y, corners[i][1].get<double>(), 1e-6);
                const auto edge = std::pair(exact[i].dump(), exact[(i + 1) % exact.size()].dump());
                EXPECT_TRUE(owner.emplace(edge, tile["tile"].get<int>()).second);
            }
            EXPECT_GT(area(corners), 0);
            sum += area(corners);
            ++shapes[tile["shape"].get<int>()];
        }
        EXPECT_NEAR(sum, json["area"].get<double>(), 1e-6);
        for (std::size_t i = 0; i < json["shapes"].size(); ++i) {
            EXPECT_EQ(json["shapes"][i]["tiles"].get<int>(), shapes[static_cast<int>(i)]);
        }
        double inside = 0;
        std::size_t border = 0;
        for (const Json& loop : json["border"]) {
            inside += area(loop);
            border += loop.size();
        }
        EXPECT_NEAR(inside, sum, 1e-6);
        EXPECT_EQ(border, json["border_edges"].get<std::size_t>());
        std::map<int, std::set<int>> neighbours;
        std::map<int, int> colours;
        std::size_t inner = 0;
        for (const auto& [edge, tile] : owner) {
            const auto other = owner.find({edge.second, edge.first});
            if (other == owner.end()) continue;
            neighbours[tile].insert(other->second);
            ++inner;
        }
        EXPECT_EQ(inner, 2 * json["inner_edges"].get<std::size_t>());
        for (const Json& tile : list) colours[tile["tile"].get<int>()] = tile["neighbour_colour"].get<int>();
        for (const Json& tile : list) {
            const int number = tile["tile"].get<int>();
            EXPECT_EQ(tile["neighbours"].get<std::set<int>>(), neighbours[number]);
            for (const int other : neighbours[number]) EXPECT_NE(colours[number], colours[other]);
        }
    }
}

TEST(TilingCommand, WritesViolationsAsJson) {
    const ScratchFolder folder;
    const std::string file = folder.write("two.lsys",
                                          "derivation length: 0\nangle factor: 4\nturn: left\nheading: 0\n"
                                          "axiom: [{FF+FF+FF+FF}][f+f-{FF+FF+FF+FF}][ffff{F+F}]\n");
    const Json json = tiling({file});
    EXPECT_FALSE(json["tiling"].get<bool>());
    ASSERT_EQ(json["violation_list"].size(), 2U);
    EXPECT_EQ(json["violation_list"][0]["fault"], "open");
    EXPECT_EQ(json["violation_list"][0]["tile"], 3);
    EXPECT_EQ(json["violation_list"][1]["fault"], "overlap");
    EXPECT_EQ(json["violation_list"][1]["tile"], 2);
    EXPECT_EQ(json["violation_list"][1]["other"], 1);
    const Outcome text = run({"tiling", file});
    EXPECT_TRUE(has(text.output, "violation  tiles 1 and 2 overlap at "));
    EXPECT_TRUE(has(text.output, ", drawn by 5:21 and 5:40\n"));
    EXPECT_TRUE(
        has(text.output, "violation  polygon 3 is open: it does not end where it began; it ends at 5 1, drawn by "));
}

/// Overlapping tiles are reported with their paths from the axiom, as are all tiles in JSON.
TEST(TilingCommand, ReportsWhereTilesAreDerived) {
    const ScratchFolder folder;
    const std::string file = folder.write("over.lsys",
                                          "derivation length: 2\nangle factor: 4\nturn: left\nheading: 0\naxiom: A\n"
                                          "A --> A[fA]B\nB --> [ffB]A\nf --> ff\n"
                                          "interpret:\nA --> [{F+F+F+F}]\nB --> [{F+F+F+F}]\n");
    const Outcome text = run({"tiling", file});
    EXPECT_TRUE(has(text.output,
                    "violation  tile 8 duplicates tile 1 at 0 0, drawn by 10:16 (A 1, A 1, A 1) and 10:16 "
                    "(A 1, B 6, A 6)\n"));
    const Json json = tiling({file});
    EXPECT_EQ(json["list"][0]["path"], "A 1, A 1, A 1");
    EXPECT_EQ(json["list"][1]["path"], "A 1, A 1, A 4");
    EXPECT_EQ(json["list"][0]["exact"][0], Json::parse("[0, 0]"));
    // 4 i times the area of a unit square.
    EXPECT_EQ(json["shapes"][0]["area_4i"], Json::parse("[0, 4]"));
    EXPECT_TRUE(tiling({"pinwheel", "-n", "1"})["list"][0]["path"].is_null());
}

TEST(TilingCommand, CountsWithoutDeriving) {
    const Outcome outcome = run({"tiling", "chair", "-n", "60", "--counts"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.output, "tiles      1329227995784915872903807060280344576\n"));
    const Json json = tiling({"chair", "-n", "60", "--counts"});
    // By heading, each with its colour: 4^59 of two, 2^59 more of the first one, and fewer of its opposite.
    std::multiset<std::string> counts;
    for (const Json& each : json["growth"]["counts"]) {
        counts.insert(each["count"].get<std::string>());
        EXPECT_EQ(each["share"], 0.25);
    }
    EXPECT_EQ(counts, (std::multiset<std::string>{
                          "332306998946228968802412517373509632", "332306998946228968225951765070086144",
                          "332306998946228968225951765070086144", "332306998946228967649491012766662656"}));
    EXPECT_LT(outcome.seconds, 1.0);
}

/// Rounded to a micrometre and read back, tilings have the same tiles, edges and figures.
TEST(TilingCommand, CertifiesItsOwnPicturesAndLists) {
    const ScratchFolder folder;
    const std::string picture = (folder.path() / "tiles.svg").string();
    for (const char* name : {"penrose-rhombs", "penrose-kite-dart", "ammann-beenker", "pinwheel", "hat", "spectre",
                             "chair", "snub-square", "pythagorean", "danzer"}) {
        SCOPED_TRACE(name);
        const Json exact = tiling({name, "-n", "3"});
        ASSERT_EQ(run({"draw", name, "-n", "3", "--name-tiles", "-o", picture}).status, 0);
        const std::string list = folder.write("tiles.json", exact.dump());
        for (const std::string& file : {picture, list}) {
            const Json read = tiling({file});
            EXPECT_TRUE(read["tiling"].get<bool>());
            EXPECT_FALSE(read["exact"].get<bool>());
            EXPECT_GT(read["tolerance"].get<double>(), 0);
            EXPECT_TRUE(read["n"].is_null());
            for (const char* key :
                 {"polygons", "tiles", "violations", "regions", "edges", "inner_edges", "border_edges", "edges_cut",
                  "vertices", "inner_vertices", "neighbours", "neighbour_counts", "symmetry"}) {
                EXPECT_EQ(read[key], exact[key]) << key;
            }
            ASSERT_EQ(read["shapes"].size(), exact["shapes"].size());
            for (std::size_t i = 0; i < exact["shapes"].size(); ++i) {
                for (const char* key : {"name", "tiles", "reflected", "orientations"}) {
                    EXPECT_EQ(read["shapes"][i][key], exact["shapes"][i][key]) << key;
                }
            }
            std::multiset<int> figures, read_figures;
            for (const Json& figure : exact["figures"]) figures.insert(figure["count"].get<int>());
            for (const Json& figure : read["figures"]) read_figures.insert(figure["count"].get<int>());
            EXPECT_EQ(read_figures, figures);
        }
    }
    const Outcome text = run({"tiling", picture});
    EXPECT_FALSE(has(text.output, "growth"));
    EXPECT_TRUE(has(text.output, "exact      no: corners within 0.0"));
    EXPECT_TRUE(has(text.errors, "1 ground left out\n"));
}

/// Colours of neighbours are those of prints, also where four are needed.
TEST(TilingCommand, ListsTheColoursOfPrints) {
    const ScratchFolder folder;
    const std::string picture = folder.file("x.svg");
    for (const char* name : {"hat", "ammann-a3", "table", "penrose-rhombs", "spiral-tiling"}) {
        SCOPED_TRACE(name);
        ASSERT_EQ(
            run({"draw", name, "-n", "3", "--name-tiles", "--tile-colours", "neighbours", "-o", picture}).status, 0);
        const std::string svg = contents(picture);
        static const std::regex tile("<path id=\"t([0-9]+)\" class=\"[^\"]*colour-([0-9]+)\"");
        std::map<int, int> drawn;
        for (auto at = std::sregex_iterator(svg.begin(), svg.end(), tile); at != std::sregex_iterator(); ++at) {
            drawn[std::stoi((*at)[1])] = std::stoi((*at)[2]);
        }
        const Json json = tiling({name, "-n", "3"});
        ASSERT_EQ(drawn.size(), json["list"].size());
        std::map<int, int> listed;
        std::map<int, std::set<int>> pairs;
        for (const Json& each : json["list"]) {
            const int number = each["tile"].get<int>();
            listed[number] = each["neighbour_colour"].get<int>();
            pairs[listed[number]].insert(drawn.at(number));
        }
        for (const auto& [colour, others] : pairs) EXPECT_EQ(others.size(), 1U) << colour;
        EXPECT_LE(pairs.size(), 4U);
        for (const Json& each : json["list"]) {
            for (const Json& other : each["neighbours"]) {
                EXPECT_NE(listed.at(each["tile"].get<int>()), listed.at(other.get<int>()));
            }
        }
    }
}

TEST(TilingCommand, ListsOriginsOfFaults) {
    const ScratchFolder folder;
    const Json json = tiling({folder.write("over.lsys",
                                           "derivation length: 1\nangle increment: 90\nheading: 0\n"
                                           "axiom: AfB\nA --> C\nB --> |f[|C]\ninterpret:\nC --> "
                                           "[{F+F+F+F}]\n")});
    ASSERT_EQ(json["violation_list"].size(), 1U) << json.dump();
    const Json& origins = json["violation_list"][0]["origins"];
    ASSERT_EQ(origins.size(), 2U);
    for (const Json& origin : origins) {
        EXPECT_EQ(origin["line"], 8);
        EXPECT_EQ(origin["column"], 16);
        EXPECT_FALSE(origin["path"].get<std::string>().empty());
    }
    EXPECT_NE(origins[0]["path"], origins[1]["path"]);
    EXPECT_TRUE(tiling({"chair", "-n", "1"})["violation_list"].empty());
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

}  // namespace
}  // namespace sikku
