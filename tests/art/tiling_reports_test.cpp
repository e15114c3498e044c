// tests/art/tiling_reports_test.cpp: reports of tilings as text and as JSON, of patterns and of their prints.
#include "art/prints.h"
#include "art/reading/polygon_files.h"
#include "engine/tiling/tile_origins.h"
#include "engine/tiling/tiling_text.h"
#include "tests/checks.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <regex>
#include <set>
#include <utility>

namespace sikku::tiling_reports_test {

using Json = nlohmann::json;
using Point = std::pair<double, double>;

Document pattern(const std::string& name, int n) {
    return load(name, {"", {{"-n", "derivation length", std::to_string(n)}}});
}

Json json_of(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
             const TileGrowth& growth, const TileOrigins* origins) {
    std::string text;
    write_tiling_json(
        title, n, result, growth, [&](std::uint32_t number) { return origins ? origins->path_text(number) : ""; },
        [&](std::string_view part) { text += part; });
    return Json::parse(text);
}

Json tiling(const Document& document) {
    TilingResult result = examine_tiling(document.grammar(), {});
    find_origins(document, result.examination, {});
    const std::int64_t n = document.grammar().steps();
    return json_of("", n, result, find_growth(document.grammar()), TileOrigins::make(document, {}).get());
}

Json tiling(const PolygonList& polygons) {
    return json_of("", {}, examine_polygons(polygons, usual_tolerance(polygons), {}), {}, nullptr);
}

std::string text_of(const Document& document) {
    TilingExamination examination = examine_tiling(document.grammar(), {}).examination;
    find_origins(document, examination, {});
    return tiling_text(document.text("title"), document.grammar().steps(), examination,
                       find_growth(document.grammar()));
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

TEST(TilingReports, ReportsTheCertificate) {
    const std::string text = text_of(load("penrose-rhombs"));
    for (const char* line :
         {"Penrose rhombs, n = 5\n", "tiling     yes: 445 tiles, one region, no gap, no overlap\n",
          "shapes     2: 170 rhombs 36 144, in 5 orientations; 275 rhombs 72 108, in 5 orientations\n",
          "edges      935, edge-to-edge; 845 inner, 90 on the border, one loop\n",
          "vertices   491; 401 inner with 7 figures: 108.108.144 160, 36.72.36.108.108 90, 72.144.144 60, ",
          "neighbours 845 pairs; 4 for 380 tiles, 3 for 40, 2 for 25; 3 colours suffice, 2 do not\n",
          "symmetry   C5 about 0 0\n",
          "growth     1.618034 a step in length, τ; in the limit 0.381966 rhombs 36 144; 0.618034 rhombs 72 108",
          "exact      yes\n"}) {
        EXPECT_TRUE(has(text, line));
    }
    EXPECT_TRUE(has(text_of(pattern("koch-island", 1)), "tiling     no: "));
}

/// Reads the tiles back: corners from their whole coordinates, areas, and neighbours from the edges that tiles share.
TEST(TilingReports, WritesTilesAsJson) {
    for (const char* name : {"penrose-rhombs", "ammann-beenker", "gosper-islands"}) {
        const Json json = tiling(pattern(name, 3));
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

TEST(TilingReports, WritesViolationsAsJson) {
    const Document document = parse("two.lsys",
                                    "derivation length: 0\nangle factor: 4\nturn: left\nheading: 0\n"
                                    "axiom: [{FF+FF+FF+FF}][f+f-{FF+FF+FF+FF}][ffff{F+F}]\n");
    const Json json = tiling(document);
    EXPECT_FALSE(json["tiling"].get<bool>());
    ASSERT_EQ(json["violation_list"].size(), 2U);
    EXPECT_EQ(json["violation_list"][0]["fault"], "open");
    EXPECT_EQ(json["violation_list"][0]["tile"], 3);
    EXPECT_EQ(json["violation_list"][1]["fault"], "overlap");
    EXPECT_EQ(json["violation_list"][1]["tile"], 2);
    EXPECT_EQ(json["violation_list"][1]["other"], 1);
    const std::string text = text_of(document);
    EXPECT_TRUE(has(text, "violation  tiles 1 and 2 overlap at "));
    EXPECT_TRUE(has(text, ", drawn by 5:21 and 5:40\n"));
    EXPECT_TRUE(has(text, "violation  polygon 3 is open: it does not end where it began; it ends at 5 1, drawn by "));
}

/// Overlapping tiles are reported with their paths from the axiom, as are all tiles in JSON.
TEST(TilingReports, ReportsWhereTilesAreDerived) {
    const Document document = parse("over.lsys",
                                    "derivation length: 2\nangle factor: 4\nturn: left\nheading: 0\naxiom: A\n"
                                    "A --> A[fA]B\nB --> [ffB]A\nf --> ff\n"
                                    "interpret:\nA --> [{F+F+F+F}]\nB --> [{F+F+F+F}]\n");
    EXPECT_TRUE(has(text_of(document),
                    "violation  tile 8 duplicates tile 1 at 0 0, drawn by 10:16 (A 1, A 1, A 1) and 10:16 "
                    "(A 1, B 6, A 6)\n"));
    const Json json = tiling(document);
    EXPECT_EQ(json["list"][0]["path"], "A 1, A 1, A 1");
    EXPECT_EQ(json["list"][1]["path"], "A 1, A 1, A 4");
    EXPECT_EQ(json["list"][0]["exact"][0], Json::parse("[0, 0]"));
    // 4 i times the area of a unit square.
    EXPECT_EQ(json["shapes"][0]["area_4i"], Json::parse("[0, 4]"));
    EXPECT_TRUE(tiling(pattern("pinwheel", 1))["list"][0]["path"].is_null());
}

TEST(TilingReports, CountsWithoutDeriving) {
    const TileGrowth growth = find_growth(pattern("chair", 60).grammar());
    EXPECT_TRUE(has(tile_counts_text("", 60, growth), "tiles      1329227995784915872903807060280344576\n"));
    const Json json = Json::parse(tile_counts_json("", 60, growth));
    // By heading, each with its colour: 4^59 of two, 2^59 more of the first one, and fewer of its opposite.
    std::multiset<std::string> counts;
    for (const Json& each : json["growth"]["counts"]) {
        counts.insert(each["count"].get<std::string>());
        EXPECT_EQ(each["share"], 0.25);
    }
    EXPECT_EQ(counts, (std::multiset<std::string>{
                          "332306998946228968802412517373509632", "332306998946228968225951765070086144",
                          "332306998946228968225951765070086144", "332306998946228967649491012766662656"}));
}

/// Rounded to a micrometre and read back, tilings have the same tiles, edges and figures.
TEST(TilingReports, CertifiesItsOwnPicturesAndLists) {
    for (const char* name : {"penrose-rhombs", "penrose-kite-dart", "ammann-beenker", "pinwheel", "hat", "spectre",
                             "chair", "snub-square", "pythagorean", "danzer"}) {
        SCOPED_TRACE(name);
        const Document document = pattern(name, 3);
        const Json exact = tiling(document);
        const std::string picture = draw(document, "svg", {{"name-tiles", "true"}});
        for (const PolygonList& polygons : {read_polygons_svg(picture), read_polygons_json(exact.dump())}) {
            const Json read = tiling(polygons);
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
}

/// Colours of neighbours are those of prints, also where four are needed.
TEST(TilingReports, ListsTheColoursOfPrints) {
    for (const char* name : {"hat", "ammann-a3", "table", "penrose-rhombs", "spiral-tiling"}) {
        SCOPED_TRACE(name);
        const Document document = pattern(name, 3);
        const std::string svg = draw(document, "svg", {{"name-tiles", "true"}, {"tile-colours", "neighbours"}});
        static const std::regex tile("<path id=\"t([0-9]+)\" class=\"[^\"]*colour-([0-9]+)\"");
        std::map<int, int> drawn;
        for (auto at = std::sregex_iterator(svg.begin(), svg.end(), tile); at != std::sregex_iterator(); ++at) {
            drawn[std::stoi((*at)[1])] = std::stoi((*at)[2]);
        }
        const Json json = tiling(document);
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

TEST(TilingReports, ListsOriginsOfFaults) {
    const Json json = tiling(parse("over.lsys",
                                   "derivation length: 1\nangle increment: 90\nheading: 0\n"
                                   "axiom: AfB\nA --> C\nB --> |f[|C]\ninterpret:\nC --> "
                                   "[{F+F+F+F}]\n"));
    ASSERT_EQ(json["violation_list"].size(), 1U) << json.dump();
    const Json& origins = json["violation_list"][0]["origins"];
    ASSERT_EQ(origins.size(), 2U);
    for (const Json& origin : origins) {
        EXPECT_EQ(origin["line"], 8);
        EXPECT_EQ(origin["column"], 16);
        EXPECT_FALSE(origin["path"].get<std::string>().empty());
    }
    EXPECT_NE(origins[0]["path"], origins[1]["path"]);
    EXPECT_TRUE(tiling(pattern("chair", 1))["violation_list"].empty());
}

}  // namespace sikku::tiling_reports_test
