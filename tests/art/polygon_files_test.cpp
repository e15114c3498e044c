// Polygons of other programs: what is read, and where faults are.
#include "art/reading/polygon_files.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/tiling.h"
#include "engine/tiling/tiling_text.h"
#include "tests/checks.h"
#include "tests/fuzz/svg_targets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sikku::polygon_files_test {

std::string svg(const std::string& body) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + body + "\n</svg>\n";
}
std::string json_refusal(const std::string& text) {
    return error_of([&] { read_polygons_json(text); }, "none");
}
std::string svg_refusal(const std::string& body) {
    return error_of([&] { read_polygons_svg(svg(body)); }, "none");
}

TEST(PolygonFiles, ReadListsAndObjects) {
    const PolygonList plain = read_polygons_json("[[[0,0],[1,0],[1,1.5]], [[1,0],[2,0],[2e0,-1],[1,-1]]]");
    ASSERT_EQ(plain.size(), 2U);
    EXPECT_EQ(plain.polygon(0).size(), 3U);
    EXPECT_EQ(plain.polygon(0)[2], glm::dvec2(1, 1.5));
    EXPECT_EQ(plain.polygon(1)[2], glm::dvec2(2, -1));
    const PolygonList full = read_polygons_json(
        R"({"title": "Two", "n": null, "shapes": [{"corners": 7}], "list": [
            {"tile": 1, "colour": 3, "corners": [[0,0],[1,0],[0,1]], "exact": [[1,2,3]], "more": {"corners": []}},
            {"corners": [[0,0],[1,0],[0,1]]}, [[5,5],[6,5],[5,6]]], "tail": [[[[1]]]]})");
    EXPECT_EQ(full.title, "Two");
    ASSERT_EQ(full.size(), 3U);
    EXPECT_EQ(full.colour, (std::vector<std::int32_t>{3, 0, 0}));
    EXPECT_EQ(full.polygon(2)[0], glm::dvec2(5, 5));
    EXPECT_EQ(read_polygons_json("[]").size(), 0U);
    // A list of tiles differs from the examined drawing if polygons were left out.
    EXPECT_TRUE(read_polygons_json(R"({"violations": 0, "list": []})").notes.empty());
    EXPECT_EQ(read_polygons_json(R"({"violations": 3, "list": []})").notes.size(), 1U);
}

TEST(PolygonFiles, NameThePlaceOfAFaultInJson) {
    EXPECT_EQ(json_refusal("[\n [[0,0],[1,0],[0 1]]]"), "line 2, column 18: this is not valid JSON");
    EXPECT_EQ(json_refusal(""), "line 1, column 1: this is not valid JSON");
    EXPECT_EQ(json_refusal("[[[0,0],[1,0],[0,1]],[[0,0],[1,0,2],[0,1]]]"),
              "polygon 2: corner 2: expected [x, y], not 3 numbers");
    EXPECT_EQ(json_refusal("[[[0,0],[1,\"a\"],[0,1]]]"), "polygon 1: corner 2: expected [x, y], not a text");
    EXPECT_EQ(json_refusal("[[[0,0],[1,0],null]]"), "polygon 1: corner 3: expected [x, y], not null");
    EXPECT_EQ(json_refusal("[[[0,0],[1,0],[[1,1],2]]]"), "polygon 1: corner 3: expected [x, y], not a list");
    EXPECT_EQ(json_refusal("[[[0,0],[1,0]]]"), "polygon 1: a polygon has three corners or more");
    EXPECT_EQ(json_refusal("[1]"), "polygon 1: expected a list of corners, not a number");
    EXPECT_EQ(json_refusal("[{\"tile\": 1}]"), "polygon 1: 'corners' is missing");
    EXPECT_EQ(json_refusal("[{\"corners\": 4}]"), "polygon 1: 'corners' is a number, not a list of corners");
    EXPECT_EQ(json_refusal("[{\"corners\": {}}]"), "polygon 1: 'corners' is an object, not a list of corners");
    EXPECT_EQ(json_refusal("[{\"corners\": [[0,0],[1,0],[0,1]], \"corners\": [[0,0],[1,0],[0,1]]}]"),
              "polygon 1: 'corners' occurs twice");
    EXPECT_EQ(json_refusal("{\"list\": 1}"), "'list' is a number, not a list of polygons");
    EXPECT_EQ(json_refusal("{\"tiles\": []}"),
              "expected a list of polygons, or an object with such a list as 'list'");
    EXPECT_EQ(json_refusal("7"), "expected a list of polygons, not a number");
    EXPECT_EQ(json_refusal("[[[0,0],[1e300,0],[0,1]]]"),
              "polygon 1: corner 2: expected [x, y], not 1e+300, which is larger than 1e+09");
    EXPECT_NE(json_refusal("[[[0,0],[1e999,0],[0,1]]]"), "none");
    EXPECT_EQ(json_refusal("{\"a\": " + std::string(100'000, '[')), "more than 50 nested brackets");
}

TEST(PolygonFiles, ReadElementsWithTheirTransforms) {
    const PolygonList list =
        read_polygons_svg(svg("<title>Mine</title><defs><rect width=\"9\" height=\"9\"/></defs>\n"
                              "<g transform=\"translate(10 0) scale(2)\"><g transform=\"rotate(90)\" fill=\"red\">\n"
                              "<rect x=\"1\" y=\"0\" width=\"2\" height=\"1\"/></g>\n"
                              "<polygon points=\"0,0 1,0 1,1 0,0\" style=\"fill: #00f\"/></g>\n"
                              "<path fill=\"red\" d=\"M0 0h1v1zm5 5l1 0 0 1z\"/><path fill=\"none\" d=\"M0 "
                              "0h1v1z\"/><path d=\"M0 0h1v1\"/>\n"
                              "<text>a</text>"));
    EXPECT_EQ(list.title, "Mine");
    ASSERT_EQ(list.size(), 4U);
    // (1, 0) turned is (0, 1), doubled (0, 2), moved (10, 2); y points up.
    EXPECT_NEAR(list.polygon(0)[0].x, 10, 1e-12);
    EXPECT_NEAR(list.polygon(0)[0].y, -2, 1e-12);
    EXPECT_NEAR(list.polygon(0)[2].x, 8, 1e-12);
    EXPECT_NEAR(list.polygon(0)[2].y, -6, 1e-12);
    EXPECT_EQ(list.polygon(1).size(), 3U);
    EXPECT_EQ(list.polygon(3)[0], glm::dvec2(5, -5));
    EXPECT_EQ(list.colour, (std::vector<std::int32_t>{0, 1, 0, 0}));
    EXPECT_EQ(list.notes, (std::vector<std::string>{"1 unfilled outline left out", "1 open line left out",
                                                    "1 text or picture left out"}));
    EXPECT_EQ(read_polygons_svg(svg("<g fill=\"none\"><path d=\"M0 0h1v1z\"/></g>")).size(), 1U);
    // A picture in a picture has its own place.
    const PolygonList nested = read_polygons_svg(
        svg("<g transform=\"scale(2)\"><svg x=\"3\" y=\"4\"><rect width=\"1\" height=\"1\"/></svg></g>"));
    EXPECT_EQ(nested.polygon(0)[0], glm::dvec2(6, -8));
}

TEST(PolygonFiles, NameThePlaceOfAFaultInAnSvg) {
    EXPECT_EQ(svg_refusal("<g>\n<path d=\"M0 0h1q1 1 2 2z\"/></g>"),
              "line 3, column 2, <path>: byte 7 of its path is the curve 'q'; tiles have straight edges");
    EXPECT_EQ(svg_refusal("<circle r=\"1\"/>"),
              "line 2, column 2, <circle>: this is a curve; tiles have straight edges");
    EXPECT_EQ(svg_refusal("<rect width=\"3\" height=\"3\" rx=\"1\"/>"),
              "line 2, column 2, <rect>: it has round corners; tiles have straight edges");
    EXPECT_TRUE(has(svg_refusal("<polygon points=\"1 2 3\"/>"), "odd number"));
    EXPECT_TRUE(has(svg_refusal("<g transform=\"turn(3)\"/>"), "<g>: 'turn(3)': unknown transform"));
    EXPECT_TRUE(has(svg_refusal("<path d=\"M0 0 h\"/>"), "<path>: damaged path data"));
    EXPECT_TRUE(
        has(svg_refusal("<g transform=\"scale(1e11)\"><rect width=\"9\" height=\"9\"/></g>"), "larger than 1e+09"));
    EXPECT_EQ(svg_refusal("<line x1=\"3\"/>"), "the SVG has no closed polygons");
    EXPECT_TRUE(has(svg_refusal("<svg viewBox=\"0 0 1 1\"><rect width=\"1\" height=\"1\"/></svg>"), "viewBox"));
    EXPECT_TRUE(
        has(svg_refusal("<g style=\"transform: scale(2)\"><rect width=\"1\" height=\"1\"/></g>"), "is a style"));
    EXPECT_TRUE(has(error_of([] { read_polygons_svg("<svg>\n<g></svg>"); }), "line 2, column "));
    std::string deep;
    for (int i = 0; i < 10'000; ++i) deep += "<g>";
    std::string close;
    for (int i = 0; i < 10'000; ++i) close += "</g>";
    EXPECT_TRUE(has(svg_refusal(deep + "<rect width=\"1\" height=\"1\"/>" + close), "nested too deeply"));
}

/// Corners of all polygons, with y as in the file.
std::vector<std::vector<std::pair<double, double>>> corners(const PolygonList& list) {
    std::vector<std::vector<std::pair<double, double>>> result;
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto& polygon = result.emplace_back();
        for (const glm::dvec2 at : list.polygon(i)) {
            polygon.emplace_back(std::round(at.x * 1e9) / 1e9 + 0.0, std::round(-at.y * 1e9) / 1e9 + 0.0);
        }
    }
    return result;
}
std::string names(const PolygonList& list) {
    std::string text;
    for (const std::int32_t colour : list.colour) text += list.colour_names[static_cast<std::size_t>(colour)] + ' ';
    return text;
}

/// A picture with copies equals the picture with the copies written out.
TEST(PolygonSvg, ReadsCopies) {
    const PolygonList copied = read_polygons_svg(
        svg("<defs><rect id=\"a\" width=\"1\" height=\"2\"/><g id=\"two\" transform=\"rotate(90)\">"
            "<use href=\"#a\"/><use xlink:href=\"#a\" x=\"3\" y=\"1\" fill=\"red\"/></g>"
            "<rect id=\"own\" width=\"1\" height=\"1\" fill=\"blue\"/></defs>\n"
            "<use href=\"#two\" x=\"10\" transform=\"scale(2)\" fill=\"green\"/>"
            "<g fill=\"red\"><use href=\"#own\"/><use href=\"#a\" transform=\"translate(5)\" x=\"1\"/></g>"
            "<use href=\"#later\" y=\"7\"/><rect id=\"later\" width=\"4\" height=\"4\"/>"));
    const PolygonList written = read_polygons_svg(
        svg("<g transform=\"scale(2) translate(10 0) rotate(90)\"><rect width=\"1\" height=\"2\" fill=\"green\"/>"
            "<rect x=\"3\" y=\"1\" width=\"1\" height=\"2\" fill=\"red\"/></g><rect width=\"1\" height=\"1\" "
            "fill=\"blue\"/><rect x=\"6\" width=\"1\" height=\"2\" fill=\"red\"/><rect y=\"7\" width=\"4\" "
            "height=\"4\"/><rect width=\"4\" height=\"4\"/>"));
    EXPECT_EQ(corners(copied), corners(written));
    EXPECT_EQ(names(copied), names(written));
    EXPECT_TRUE(copied.notes.empty());
    // Symbols are drawn only where they are copied, with their view boxes.
    const PolygonList symbols = read_polygons_svg(
        svg("<symbol id=\"s\" viewBox=\"1 1 2 4\"><rect x=\"1\" y=\"1\" width=\"2\" height=\"4\"/></symbol>"
            "<use href=\"#s\" x=\"100\" y=\"10\" width=\"8\" height=\"8\"/>"));
    EXPECT_EQ(corners(symbols),
              corners(read_polygons_svg(svg("<rect x=\"102\" y=\"10\" width=\"4\" height=\"8\"/>"))));
}

/// Random pictures, and the same without copies and sheets by another reading of the rules.
TEST(PolygonSvg, ReadsCopiesLikeWrittenOnes) {
    std::mt19937 random(5);
    for (int round = 0; round < 3000; ++round) {
        std::string bytes;
        for (int i = 0; i < 20 + round % 100; ++i) bytes += static_cast<char>(random() % 256);
        ASSERT_NO_THROW(try_copies(bytes)) << round;
    }
}

TEST(PolygonSvg, LimitsCopies) {
    EXPECT_EQ(svg_refusal("<rect width=\"1\" height=\"1\"/><use href=\"#b\"/>"),
              "line 2, column 30, <use>: no element has the id 'b'");
    EXPECT_TRUE(
        has(svg_refusal("<use href=\"tiles.svg#a\"/>"), "it copies 'tiles.svg#a'; expected the id of an element"));
    EXPECT_TRUE(has(svg_refusal("<g id=\"a\"><use href=\"#a\"/></g>"), "it copies an element that contains it"));
    EXPECT_TRUE(has(svg_refusal("<g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g>"),
                    "it copies an element that contains it"));
    // Ten copies of ten copies of ten …
    std::string bomb = "<defs><rect id=\"l0\" width=\"1\" height=\"1\"/>", chain = bomb;
    for (int level = 1; level <= 60; ++level) {
        const std::string use = fmt::format("<use href=\"#l{}\"/>", level - 1);
        chain += fmt::format("<g id=\"l{}\">{}</g>", level, use);
        if (level > 12) continue;
        bomb += fmt::format("<g id=\"l{}\">", level);
        for (int i = 0; i < 10; ++i) bomb += use;
        bomb += "</g>";
    }
    EXPECT_TRUE(has(svg_refusal(bomb + "</defs><use href=\"#l12\"/>"), "the copies have more than 1000000 elements"));
    EXPECT_TRUE(
        has(svg_refusal(chain + "</defs><use href=\"#l60\"/>"), "copies are nested more than 50 levels deep"));
    EXPECT_EQ(read_polygons_svg(svg(chain + "</defs><use href=\"#l40\"/>")).size(), 1U);
    // Few copies of a path that takes long to read, and style sheets that take long to apply.
    const std::string path = "<path id=\"p\" d=\"M0 0 1 0 0 1z" + std::string(1 << 20, ' ') + "\"/>";
    std::string copies;
    for (int i = 0; i < 70; ++i) copies += "<use href=\"#p\"/>";
    EXPECT_TRUE(has(svg_refusal("<defs>" + path + "</defs>" + copies), "the copies have more than 64 MB of paths"));
    std::string rules;
    for (int i = 0; i <= 10'000; ++i) rules += fmt::format(".c{}{{fill:red}}", i);
    EXPECT_TRUE(has(svg_refusal("<style>" + rules + "</style>" + path), "have more than 10000 rules"));
}

/// The fill of one rectangle under a style sheet.
std::string fill_of(const std::string& sheet, const std::string& attributes, const std::string& around = "") {
    return names(read_polygons_svg(svg("<style>" + sheet + "</style><g " + around +
                                       "><rect width=\"1\" height=\"1\" " + attributes + "/></g>")));
}

/// The cascade of CSS 2.1, sections 6.4.1 and 6.4.3.
TEST(PolygonSvg, ReadsFillsOfStyleSheets) {
    EXPECT_EQ(fill_of(".a{fill:red}", "class=\"a\""), "red ");
    EXPECT_EQ(fill_of(".a{fill:red}", "class=\"b\""), "black ");
    EXPECT_EQ(fill_of(".a{fill:red}", "", "class=\"a\""), "red ") << "inherited";
    EXPECT_EQ(fill_of("rect{fill:red}", "fill=\"blue\""), "red ") << "attributes are weakest";
    EXPECT_EQ(fill_of("rect{fill:red}", "style=\"fill:blue\""), "blue ");
    EXPECT_EQ(fill_of("rect{fill:red!important}", "style=\"fill:blue\""), "red ");
    EXPECT_EQ(fill_of("rect{fill:red!important}", "style=\"fill:blue ! important\""), "blue ");
    EXPECT_EQ(fill_of(".a{fill:red}.b{fill:blue}", "class=\"b a\""), "blue ") << "the last rule";
    EXPECT_EQ(fill_of(".a{fill:red}rect{fill:blue}", "class=\"a\""), "red ") << "the more specific one";
    EXPECT_EQ(fill_of("#x{fill:green}.a.b{fill:red}rect.a{fill:blue}", "id=\"x\" class=\"a b\""), "green ");
    EXPECT_EQ(fill_of(".a.b{fill:red}rect.a{fill:blue}", "class=\"a b\""), "red ");
    EXPECT_EQ(fill_of("rect.a , .c,path{fill:red}", "class=\"c\""), "red ") << "lists";
    EXPECT_EQ(fill_of("*{fill:red}", ""), "red ");
    EXPECT_EQ(fill_of("/* .a{fill:red} */ .a{/*;*/stroke:url(data:;a);fill: #fff ;}", "class=\"a\""), "#fff ");
    EXPECT_EQ(fill_of("<![CDATA[.a{fill:red}]]>", "class=\"a\""), "red ");
    EXPECT_EQ(fill_of(".a{fill:inherit}", "class=\"a\" fill=\"red\"", "fill=\"blue\""), "blue ");
    // Hidden elements are not tiles.
    const std::string more = "<rect x=\"5\" width=\"1\" height=\"1\"/>";
    for (const char* hidden : {"display:none", "fill:none", "visibility:hidden", "opacity:0", "fill-opacity:0",
                               "fill:None", "fill:transparent"}) {
        const PolygonList list = read_polygons_svg(
            svg(fmt::format("<style>.a{{{}}}</style><rect class=\"a\" width=\"9\" height=\"9\"/>", hidden) + more));
        EXPECT_EQ(list.size(), 1U) << hidden;
    }
    EXPECT_EQ(read_polygons_svg(svg("<g visibility=\"hidden\"><rect visibility=\"visible\" width=\"1\" "
                                    "height=\"1\"/></g>"))
                  .size(),
              1U);
}

/// A square that is not painted is not a tile, however its transparency is written.
TEST(PolygonSvg, TransparentShapesAreNoTiles) {
    const std::string seen = "<rect x=\"5\" width=\"1\" height=\"1\"/>";
    for (const char* clear :
         {"opacity=\"0\"", "opacity=\"0%\"", "fill-opacity=\"0.0%\"", "fill=\"rgba(255,0,0,0)\"", "fill=\"#f000\"",
          "fill=\"#ff000000\"", "fill=\"rgb(255 0 0 / 0%)\"", "style=\"fill:hsla(0,1%,1%,0.0)\""}) {
        const PolygonList list =
            read_polygons_svg(svg("<rect " + std::string(clear) + " width=\"1\" height=\"1\"/>" + seen));
        EXPECT_EQ(list.size(), 1U) << clear;
    }
    for (const char* opaque : {"fill=\"#f00f\"", "fill=\"rgb(255,0,0)\"", "fill=\"rgb(0 0 0)\"", "opacity=\"1%\"",
                               "fill=\"rgba(0,0,0,.5)\""}) {
        const PolygonList list =
            read_polygons_svg(svg("<rect " + std::string(opaque) + " width=\"1\" height=\"1\"/>" + seen));
        EXPECT_EQ(list.size(), 2U) << opaque;
        EXPECT_TRUE(list.notes.empty()) << opaque;
    }
    const PolygonList odd = read_polygons_svg(svg("<rect style=\"opacity:calc(0)\" width=\"1\" height=\"1\"/>"));
    EXPECT_EQ(odd.notes, (std::vector<std::string>{"1 opacity not understood: its shapes count as visible"}));
    const PolygonList sheet = read_polygons_svg(svg(
        "<style type=\"text/css; charset=utf-8\">.a{fill:none}</style><rect class=\"a\" width=\"1\" height=\"1\"/>" +
        seen));
    EXPECT_EQ(sheet.size(), 1U);
    EXPECT_EQ(read_polygons_svg(svg("<style>.b( .a{fill:none}</style>" + seen)).notes.size(), 1U);
}

TEST(PolygonSvg, CountsRulesThatAreNotRead) {
    const auto notes = [](const std::string& sheet) {
        std::string all;
        for (const std::string& note :
             read_polygons_svg(svg("<style>" + sheet + "</style><rect width=\"1\" height=\"1\"/>")).notes) {
            all += note + '\n';
        }
        return all;
    };
    EXPECT_EQ(notes(".a{fill:red} @font-face{font-family:x;src:url(a)} text:hover{stroke:red}"), "");
    const std::string one =
        "1 style rule not read: only simple selectors outside of @media and similar rules are supported\n";
    for (const char* sheet : {"g .a{fill:red}", "g>rect{fill:red}", "rect[x]{fill:none}",
                              "rect:first-child{fill:red}", "@media print{.a{fill:red}}", "@import url(a.css);",
                              ".a\\:b{fill:red}", "@media print{.a{stroke:red} .b{stroke:none;fill:red}}"}) {
        EXPECT_EQ(notes(sheet), one) << sheet;
    }
    EXPECT_EQ(notes("@media print{.a{fill:red}} g g{fill:blue}").substr(0, 13), "2 style rules");
    EXPECT_EQ(read_polygons_svg(svg("<switch><rect width=\"1\" height=\"1\"/></switch>")).notes,
              (std::vector<std::string>{"1 switch read with all its alternatives"}));
    EXPECT_EQ(read_polygons_svg("<?xml-stylesheet href='x.css'?>" + svg("<rect width=\"1\" height=\"1\"/>")).notes,
              (std::vector<std::string>{"the style sheet in another file is not read"}));
    EXPECT_NE(read_polygons_svg(svg("<g clip-path=\"url(#c)\"><rect width=\"1\" height=\"1\"/></g>")).notes,
              std::vector<std::string>{});
}

TEST(PolygonSvg, LeavesMarkersOut) {
    const std::string tiles = "<rect width=\"1\" height=\"1\"/><rect x=\"1\" width=\"1\" height=\"1\"/>";
    const auto read = [&](const std::string& more) { return read_polygons_svg(svg(tiles + more)); };
    EXPECT_EQ(read("<circle cx=\"1\" r=\"0.1\"/><ellipse rx=\"0.1\" ry=\"2\"/>").notes,
              std::vector<std::string>{"2 circles left out"});
    // A circle as large as a tile would be one.
    EXPECT_TRUE(has(svg_refusal(tiles + "<circle cx=\"1\" r=\"0.6\"/>"), "<circle>: this is a curve"));
    EXPECT_TRUE(has(svg_refusal(tiles + "<g transform=\"scale(10)\"><circle r=\"0.1\"/></g>"), "<circle>"));
    EXPECT_EQ(read("<circle r=\"5\" fill=\"none\"/>").size(), 2U);
    // Curves without a fill are lines, unless all tiles are.
    EXPECT_EQ(read("<path fill=\"none\" d=\"M0 0q1 1 2 2\"/>").notes,
              std::vector<std::string>{"1 curved line left out"});
    EXPECT_TRUE(
        has(svg_refusal("<g fill=\"none\">" + tiles + "<path d=\"M0 0q1 1 2 2z\"/></g>"), "is the curve 'q'"));
}

/// Squares of a grid, each corner moved by up to `noise`.
PolygonList squares(int rows, double noise) {
    PolygonList list;
    std::uint32_t state = 1;
    const auto jitter = [&] {
        state = state * 1664525U + 1013904223U;
        return noise * (static_cast<double>(state >> 8U) / 8388608.0 - 1);
    };
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < rows; ++x) {
            for (const glm::dvec2 at :
                 {glm::dvec2(x, y), glm::dvec2(x + 1, y), glm::dvec2(x + 1, y + 1), glm::dvec2(x, y + 1)}) {
                list.corners.push_back(at + glm::dvec2(jitter(), jitter()));
            }
            list.end_polygon(0);
        }
    }
    return list;
}

TEST(PolygonFiles, AreTilesWithinTheTolerance) {
    const TilingExamination t = examine_polygons(squares(8, 0.0006), 0.002, {}).examination;
    EXPECT_TRUE(t.is_tiling());
    EXPECT_FALSE(t.is_exact);
    EXPECT_EQ(t.tolerance, 0.002);
    EXPECT_EQ(t.tiles, 64U);
    EXPECT_EQ(t.edges, 144U);
    EXPECT_EQ(t.inner_vertices, 49U);
    ASSERT_EQ(t.shapes.size(), 1U);
    EXPECT_EQ(t.figures.size(), 1U);
    EXPECT_EQ(t.symmetry.name(), "D4");
    // The same squares with a tolerance that is too small, and with corners that are too far off.
    EXPECT_FALSE(examine_polygons(squares(8, 0.0006), 0.0001, {}).examination.is_tiling());
    EXPECT_FALSE(examine_polygons(squares(8, 0.02), 0.002, {}).examination.is_tiling());
    EXPECT_NEAR(usual_tolerance(squares(3, 0)), 0.002, 1e-12);
    // A single tile has a tolerance, too.
    EXPECT_TRUE(examine_polygons(squares(1, 0), usual_tolerance(squares(1, 0)), {}).examination.is_tiling());
}

/// The tolerance would straighten a circle of many corners.
TEST(PolygonFiles, ReportOutlinesThatAreTooFine) {
    const auto circle = [](int corners, double from, double to) {
        std::string text = "[[";
        for (int i = 0; i < corners; ++i) {
            const double angle = from + (to - from) * i / corners;
            text += fmt::format("{}[{},{}]", i == 0 ? "" : ",", std::cos(angle), std::sin(angle));
        }
        return read_polygons_json(text + "]]");
    };
    const double round = 2 * std::acos(-1.0);
    for (const auto& [corners, to] : {std::pair(3000, round), std::pair(3000, round / 2)}) {
        const PolygonList polygons = circle(corners, 0, to);
        const TilingExamination fine = examine_polygons(polygons, usual_tolerance(polygons), {}).examination;
        ASSERT_EQ(fine.violations.count, 1U);
        EXPECT_EQ(fine.violations.list[0].fault, TileFault::too_fine);
        const TilingExamination finer = examine_polygons(polygons, 1e-9, {}).examination;
        EXPECT_TRUE(finer.is_tiling());
        EXPECT_NEAR(finer.shapes.at(0).area, to / 2, 2e-3);
        EXPECT_LT(tiling_text("", std::nullopt, finer, {}).size(), 2000U) << "angles are cut off";
    }
}

TEST(PolygonFiles, CountOverlapsUpToALimit) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(0, 1);
    std::string text;
    for (int i = 0; i < 2000; ++i) {
        text += i == 0 ? "[[" : "],[";
        for (int k = 0; k < 3; ++k) {
            const double x = anywhere(random), y = anywhere(random);
            text += fmt::format("{}[{},{}]", k == 0 ? "" : ",", x, y);
        }
    }
    const TilingExamination heap = examine_polygons(read_polygons_json(text + "]]"), 1e-10, {}).examination;
    EXPECT_GE(heap.violations.count, TileViolations::most_counted);
    EXPECT_LT(heap.violations.count, TileViolations::most_counted + 10'000);
    EXPECT_TRUE(has(tiling_text("", std::nullopt, heap, {}), "no: 2000 tiles; at least 1"));
    // Edges that lie on each other.
    std::string fan;
    for (int i = 0; i < 2000; ++i) {
        const double part = i / 2000.0;
        fan += fmt::format("{}[{},0],[2,0],[1,{}]", i == 0 ? "[[" : "],[", part, 1 + part);
    }
    EXPECT_THROW(examine_polygons(read_polygons_json(fan + "]]"), 1e-6, {}), BudgetError);
}

TEST(PolygonFiles, FindGapsOverlapsAndDuplicates) {
    const auto examined = [](const char* text) {
        return examine_polygons(read_polygons_json(text), 0.001, {}).examination;
    };
    // Four rectangles around a square.
    const TilingExamination gap = examined(
        "[[[0,0],[2,0],[2,1],[0,1]],[[2,0],[3,0],[3,2],[2,2]],[[1,2],[3,2],[3,3],[1,3]],[[0,1],[1,1],[1,3],[0,3]]]");
    EXPECT_FALSE(gap.is_tiling());
    ASSERT_EQ(gap.gaps.size(), 1U);
    EXPECT_NEAR(gap.gaps[0].area, 1, 1e-9);
    EXPECT_NEAR(gap.gaps[0].centre.x, 1.5, 1e-9);
    const TilingExamination over = examined("[[[0,0],[2,0],[2,2],[0,2]],[[1,1],[3,1],[3,3],[1,3]]]");
    EXPECT_EQ(over.violations.count, 1U);
    EXPECT_EQ(over.violations.list[0].fault, TileFault::overlap);
    const TilingExamination within = examined("[[[0,0],[9,0],[9,9],[0,9]],[[1,1],[3,1],[3,3],[1,3]]]");
    EXPECT_EQ(within.violations.list.at(0).fault, TileFault::overlap);
    const TilingExamination corner = examined("[[[0,0],[2,0],[2,2]],[[0,0],[2,1],[0,2]]]");
    EXPECT_EQ(corner.violations.list.at(0).fault, TileFault::overlap);
    EXPECT_EQ(examined("[[[0,0],[2,0],[2,2]],[[2,2],[0,0],[2,0]]]").violations.list.at(0).fault,
              TileFault::duplicate);
    EXPECT_EQ(examined("[[[0,0],[2,0],[0,2],[2,2]]]").violations.list.at(0).fault, TileFault::crossing);
    EXPECT_EQ(examined("[[[0,0],[2,0],[4,0]]]").violations.list.at(0).fault, TileFault::empty);
}

TEST(PolygonFiles, RefuseTolerancesThatDoNotSuit) {
    EXPECT_THROW(examine_polygons(squares(2, 0), 0.1, {}), std::runtime_error);
    EXPECT_THROW(examine_polygons(squares(2, 0), 1e-14, {}), std::runtime_error);
    EXPECT_THROW(usual_tolerance(read_polygons_json("[[[1,1],[1,1],[1,1]]]")), std::runtime_error);
    TilingOptions few;
    few.limits.tiles = 3;
    EXPECT_THROW(examine_polygons(squares(2, 0), 0.001, few), std::runtime_error);
}

}  // namespace sikku::polygon_files_test
