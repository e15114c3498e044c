// tests/art/prints_test.cpp: dots, borders, animations, sheets of a wall and plots as options of prints.
#include "art/prints.h"

#include "art/analysis.h"
#include "art/print/border.h"
#include "art/print/ornaments.h"
#include "art/sheets.h"
#include "tests/files.h"
#include "tests/tools.h"
#include "tests/works.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <tuple>

namespace sikku::prints_test {

MadeWork drawn(const std::string& pattern, const std::string& format, const OptionValues& values) {
    return made_work(prints(), load(pattern), format, values);
}

pugi::xml_document svg(const std::string& pattern, const OptionValues& values) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(draw(load(pattern), "svg", values).c_str()));
    return document;
}

std::vector<std::string> layers(const pugi::xml_document& document) {
    std::vector<std::string> labels;
    for (const auto& found : document.select_nodes("//g[@inkscape:label]")) {
        labels.emplace_back(found.node().attribute("inkscape:label").value());
    }
    return labels;
}

std::size_t count(const pugi::xml_document& document, const char* path) {
    return document.select_nodes(path).size();
}

TEST(Prints, DotsStandWhereTheExaminationSetsThem) {
    const OptionValues values = {{"n", "3"}, {"dots", "1.5mm gold"}, {"step", "3mm"}};
    const std::string text = draw(load("snake-kolam"), "svg", values);
    const auto document = svg("snake-kolam", values);
    for (const auto& found : document.select_nodes("//circle")) {
        EXPECT_NEAR(found.node().attribute("r").as_double(), 750, 0.1);
    }
    EXPECT_EQ(count(document, "//circle"), 85u);
    EXPECT_TRUE(has(text, "discs gold"));
    // The same by the pattern's own key.
    const std::regex made("<sikku:made>.*</sikku:made>");
    const Document keyed = load("snake-kolam").with({{"dots", "1.5mm gold"}});
    EXPECT_EQ(std::regex_replace(text, made, ""),
              std::regex_replace(draw(keyed, "svg", {{"n", "3"}, {"step", "3mm"}}), made, ""));

    const auto only = svg("snake-kolam", {{"n", "3"}, {"dots", "only"}, {"dot-spacing", "15mm"}});
    EXPECT_EQ(count(only, "//path"), 0u);
    ASSERT_EQ(count(only, "//circle"), 85u);
    const auto coloured =
        svg("snake-kolam", {{"n", "3"}, {"dots", "only"}, {"dot-spacing", "15mm"}, {"colour-by", "strand"}});
    EXPECT_EQ(count(coloured, "//path"), 0u);
    EXPECT_EQ(count(coloured, "//circle"), 85u);
    std::vector<std::pair<double, double>> spaced;
    for (const auto& found : only.select_nodes("//circle")) {
        spaced.emplace_back(found.node().attribute("cx").as_double(), found.node().attribute("cy").as_double());
    }
    double least = 1e300;
    for (const auto& a : spaced) {
        for (const auto& b : spaced) {
            if (a != b) least = std::min(least, std::hypot(a.first - b.first, a.second - b.second));
        }
    }
    EXPECT_NEAR(least, 15'000, 2);
}

TEST(Prints, NothingStandsAroundAPartOfADrawing) {
    const Document penrose = load("penrose-rhombs");
    const auto refusal = [&](const OptionValues& values) { return error_of([&] { draw(penrose, "svg", values); }); };
    EXPECT_TRUE(has(refusal({{"fill-page", "true"}, {"border", "rope"}}), "a filled page shows only part of it"));
    EXPECT_TRUE(has(refusal({{"fill-page", "true"}, {"title-line", ""}}), "would cross the text"));
    EXPECT_TRUE(has(refusal({{"window", "0,0,9,9"}, {"edition", "3/50"}}), "would cross the text"));
}

/// The box of the letters of a title in micrometres of the page, without its pen, by the width of which it is found.
Box box_of_title(const char* stem, const OptionValues& more) {
    OptionValues values = {{"n", "1"}, {"size", "100x150mm"}, {"title-line", "HHH"}};
    values.insert(values.end(), more.begin(), more.end());
    const auto document = svg("snake-kolam", values);
    Box box;
    for (const auto& path : document.select_nodes((std::string("//path[@stroke-width='") + stem + "']").c_str())) {
        std::istringstream data(path.node().attribute("d").value());
        // Letters of H are strokes of straight lines: M x y, then v and h.
        char command = 0;
        glm::dvec2 at{0.0};
        while (data >> command) {
            double first = 0, second = 0;
            data >> first;
            if (command == 'M') data >> second;
            at = command == 'M' ? glm::dvec2(first, second)
                                : at + (command == 'h' ? glm::dvec2(first, 0) : glm::dvec2(0, first));
            box.add(at);
        }
    }
    return box;
}

TEST(Prints, ATitleHasItsSizeAndItsPlace) {
    const Box usual = box_of_title("106.25", {});
    EXPECT_NEAR(usual.high.y - usual.low.y, 1250, 2);
    EXPECT_NEAR(usual.high.y, 140'000, 60);
    const Box large = box_of_title("510", {{"title-size", "6mm"}});
    EXPECT_NEAR(large.high.y - large.low.y, 6000, 2);
    EXPECT_NEAR(large.low.x, 10'000 + (usual.low.x - 10'000) * 6 / 1.25, 2);
    const Box middle = box_of_title("510", {{"title-size", "6mm"}, {"title-place", "centre"}});
    EXPECT_NEAR((middle.low.x + middle.high.x) / 2, 50'000, 2);
    EXPECT_NEAR(middle.high.y, large.high.y, 1);
    const Box above = box_of_title("510", {{"title-size", "6mm"}, {"title-place", "right,above"}});
    EXPECT_NEAR(above.low.y, 10'000, 2);
    EXPECT_NEAR(above.high.x, 100'000 - large.low.x, 2);
    // Descenders stay on the page.
    EXPECT_LT(box_of_title("1700", {{"title-size", "20mm"}, {"margin", "2mm"}}).high.y, 150'000 - 0.4 * 20'000 + 1);
}

TEST(Prints, TitlesAreRefusedOrReportedIfTheyDoNotFit) {
    const Document snake = load("snake-kolam");
    const auto refusal = [&](const OptionValues& values) { return error_of([&] { draw(snake, "svg", values); }); };
    const std::string title = "title-line";
    EXPECT_TRUE(has(refusal({{"font", "Noto Serif"}}), "needs 'title-line' or 'edition'"));
    for (const char* option : {"title-size", "title-weight", "title-place"}) {
        const char* value = option == std::string("title-place") ? "above" : "1mm";
        EXPECT_TRUE(has(refusal({{option, value}, {"edition", "3"}}), "needs 'title-line'")) << option;
    }
    EXPECT_TRUE(has(refusal({{title, ""}, {"title-size", "200mm"}}), "too high for a page or cell"));
    EXPECT_TRUE(has(refusal({{title, ""}, {"title-weight", "5mm"}}), "expected at most a fourth"));
    for (const char* place : {"", "up", "left,right", "above,above", "above,left,centre", "left,"}) {
        EXPECT_TRUE(has(refusal({{title, ""}, {"title-place", place}}), "expected above or below")) << place;
    }
    for (const char* weight : {"", "heavy", "0", "-1mm"}) {
        EXPECT_TRUE(has(refusal({{title, ""}, {"title-weight", weight}}), "expected thin")) << weight;
    }
    EXPECT_NE(refusal({{title, ""}, {"font", "No such font at all"}}), "");
    const std::string letters(10'001, 'k');
    const auto remarks = [&](const OptionValues& values) {
        MemoryDestination memory;
        return prints().plan(snake, "svg", values, {})->make(memory, "print.svg", {}, 1).remarks;
    };
    const auto cut = [&](const OptionValues& values, const char* what) {
        const auto found = remarks(values);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_TRUE(has(found.front().text, std::string("the ") + what + " is too long for its place"));
    };
    cut({{title, letters}}, "title line");
    // The edition leaves room for a title.
    cut({{"edition", letters}}, "edition");
    for (const char* place : {"left", "centre", "right", "above"}) {
        cut({{title, "K"}, {"title-place", place}, {"edition", letters}}, "edition");
        cut({{title, letters}, {"title-place", place}, {"edition", "3/50"}}, "title line");
    }
    EXPECT_EQ(remarks({{title, letters}, {"edition", letters}}).size(), 2u);
}

TEST(Prints, SheetsRefuseAnEmptyNameOfAFont) {
    EXPECT_TRUE(has(error_of([] {
                        plan_sheet({{load("snake-kolam"), {}}}, "svg", {{"titles", "title"}, {"font", ""}}, {});
                    }),
                    "expected the name of an installed font"));
}

TEST(Prints, ABorderIsALayerOfItsOwnWithinTheMargins) {
    const auto plain = svg("snake-kolam", {{"n", "2"}});
    const auto framed = svg("snake-kolam", {{"n", "2"}, {"border", "kaavi"}});
    // Its white is the ink of the lines.
    EXPECT_EQ(layers(framed).size(), layers(plain).size() + 2);
    EXPECT_EQ(count(framed, "//circle"), 4u);
    EXPECT_EQ(count(framed, "//g[@stroke='#fffaf0']"), 1u);
    const auto strokes = framed.select_nodes("//g[@stroke='#e07a50']/path");
    ASSERT_EQ(strokes.size(), 1u);
    EXPECT_TRUE(std::string_view(strokes.first().node().attribute("d").value()).ends_with("z"));
    for (const char* format : {"png", "pdf", "hpgl"}) {
        EXPECT_EQ(drawn("snake-kolam", format, {{"n", "2"}, {"border", "kaavi"}, {"dots", ""}, {"dpi", "40"}}).error,
                  "");
    }
}

TEST(Colours, AreAsFarApartAsTheyLook) {
    const auto of = [](const char* text) { return *parse_colour(text); };
    EXPECT_NEAR(lightness(of("white")), 1, 1e-6);
    EXPECT_NEAR(lightness(of("black")), 0, 1e-6);
    EXPECT_NEAR(colour_distance(of("white"), of("black")), 1, 1e-6);
    EXPECT_LT(colour_distance(of("#fffaf0"), of("#fffbf1")), 0.01);
    // Ottosson's own example: linear sRGB red.
    EXPECT_NEAR(lightness(of("red")), 0.627955, 1e-5);
}

TEST(Colours, OfABorderStandOutFromTheGround) {
    for (const char* ground : {"#8c3b2a", "#7d3324", "#93432d", "white", "black", "#6b6b3a", "#4f6b3c", "#b3452c"}) {
        const Colour under = *parse_colour(ground);
        const std::vector<Colour> colours = border_colours({BorderKind::kaavi}, under);
        ASSERT_EQ(colours.size(), 2u);
        EXPECT_EQ(hex(colours[0]), lightness(under) > 0.6 ? "#6e2c1c" : "#fffaf0");
        EXPECT_GT(colour_distance(colours[0], under), 0.2) << ground;
        EXPECT_GT(colour_distance(colours[1], under), 0.14) << ground;
        EXPECT_GT(colour_distance(colours[1], colours[0]), 0.15) << ground;
        // The lines of the others are seen on paper as well.
        const std::vector<Colour> rope = border_colours({BorderKind::rope}, under);
        ASSERT_EQ(rope.size(), 2u);
        EXPECT_GT(colour_distance(rope[0], under), 0.3) << ground;
        EXPECT_GT(colour_distance(rope[1], under), 0.14) << ground;
        EXPECT_GT(colour_distance(rope[0], rope[1]), 0.1) << ground;
    }
    EXPECT_EQ(hex(border_colours({BorderKind::kaavi}, std::nullopt)[1]), "#b3452c");
}

TEST(Prints, AnAnimationTakesItsTimeAndIsWholeWithoutIt) {
    const auto document = svg("tree-in-voices", {{"n", "3"}, {"animate", "12"}});
    double at = 0;
    const auto number = [](const std::string& style, const std::string& name) {
        double value = -1;
        const std::size_t begin = style.find(name) + name.size();
        std::from_chars(style.data() + begin, style.data() + style.size(), value);
        return value;
    };
    for (const auto& found : document.select_nodes("//path[@pathLength]")) {
        const std::string style = found.node().attribute("style").value();
        EXPECT_NEAR(number(style, "--b:"), at, 0.01);  // one stroke after the other
        at += number(style, "--l:");
    }
    EXPECT_GT(at, 100);
    const std::string rules = document.select_node("//style").node().child_value();
    EXPECT_NEAR(number(rules, "--pace: ") * at, 12, 0.01);
    EXPECT_EQ(count(document, "//path[@pathLength]"), count(document, "//path"));
    EXPECT_TRUE(has(rules, "prefers-reduced-motion"));
    // Not only drawings of one stroke, and readers that know no animation show them.
    NEEDS("rsvg-convert");
    const ScratchFolder folder;
    const auto picture = [&](const OptionValues& values) {
        const std::string file = folder.write("print.svg", draw(load("tree-in-voices"), "svg", values));
        EXPECT_TRUE(run_tool("rsvg-convert " + file + " -o " + file + ".png").ok);
        return contents(file + ".png");
    };
    EXPECT_EQ(picture({{"n", "3"}, {"animate", "12"}}), picture({{"n", "3"}}));
}

TEST(Prints, GenerationsStandSideBySide) {
    const OptionValues values = {{"generations", "0:3"}, {"landscape", "true"}, {"animate", ""}};
    const std::string text = draw(load("snake-kolam"), "svg", values);
    for (const char* caption : {"n = 0", "n = 3"}) EXPECT_TRUE(has(text, caption));
    EXPECT_GT(count(svg("snake-kolam", values), "//path[@pathLength]"), 4u);
}

TEST(Prints, TilesMakeUpTheWholePrint) {
    const MadeWork made =
        drawn("snake-kolam", "svg", {{"n", "4"}, {"dots", ""}, {"dot-spacing", "15mm"}, {"tile", "A4"}});
    // 341 dots in 31 rows, 10.6 mm apart: 330 mm and the pen's width, with 200 and 190 mm on each sheet.
    EXPECT_TRUE(has(made.remarks, "4 sheets"));
    EXPECT_EQ(made.outputs.size(), 4u);
    // The dots of all sheets, laid out as the sheets are, are those of the whole.
    std::set<std::pair<long, long>> dots;
    for (const auto& [name, left, top] :
         {std::tuple("x-1-1.svg", 0, 0), {"x-1-2.svg", 190, 0}, {"x-2-1.svg", 0, 277}, {"x-2-2.svg", 190, 277}}) {
        pugi::xml_document sheet;
        ASSERT_TRUE(sheet.load_string(made.outputs.at(name).c_str()));
        EXPECT_STREQ(sheet.document_element().attribute("width").value(), "210mm");
        for (const auto& found : sheet.select_nodes("//circle")) {
            dots.emplace(std::lround(found.node().attribute("cx").as_double() / 10 + left * 100),
                         std::lround(found.node().attribute("cy").as_double() / 10 + top * 100));
        }
    }
    EXPECT_EQ(dots.size(), 341u);
    // Nothing is left of sheets that were not finished.
    EXPECT_TRUE(is_refused(drawn("snake-kolam", "svg", {{"tile", "20x20mm"}}), 2, ""));
}

TEST(Prints, PlotsDrawNothingTwice) {
    const MadeWork plot =
        drawn("spiral-tiling", "svg", {{"plotter", "true"}, {"travel", "true"}, {"split", "500mm"}});
    EXPECT_TRUE(has(plot.remarks, "segments drawn twice"));
    EXPECT_TRUE(has(plot.remarks, "before: "));
    EXPECT_TRUE(has(plot.remarks, "plot: "));
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(plot.bytes().c_str()));
    const auto labels = layers(document);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), "% ground"), 0);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), "% travel"), 1);
    for (const std::string& label : labels) {
        EXPECT_TRUE(label.starts_with('%') || std::isdigit(static_cast<unsigned char>(label.front()))) << label;
    }
    EXPECT_TRUE(has(draw(load("hilbert"), "gcode", {{"n", "4"}}), "M3"));
    const std::string z =
        draw(load("hilbert"), "gcode",
             {{"n", "4"}, {"profile", "z"}, {"pen-speed", "25"}, {"gcode-start", "G28"}, {"gcode-end", "M84"}});
    EXPECT_TRUE(has(z, "F1500"));
    EXPECT_TRUE(has(z, "G28\n"));
    EXPECT_TRUE(z.ends_with("M84\n"));
    EXPECT_FALSE(has(z, "M3"));
}

TEST(Prints, ValuesAreRefused) {
    const std::vector<std::pair<OptionValues, std::string>> cases = {
        {{{"pen-speed", "0"}, {"plotter", "true"}}, "expected 0.001 to 1000000"},
        {{{"pen-speed", "nan"}, {"plotter", "true"}}, "pen-speed nan: expected a number"},
        {{{"split", "0mm"}, {"plotter", "true"}}, "a length above 0"},
        {{{"split", "1m"}}, "split"},
        {{{"travel", "true"}}, "needs 'plotter'"},
        {{{"profile", "grlb"}, {"plotter", "true"}}, "unknown plotter; did you mean 'grbl'?"},
        {{{"profile", "roland"}, {"plotter", "true"}}, "or a file path with a dot or a slash"},
        {{{"gcode-end", "G0 X1e300 Y1"}}, "gcode-end X1e300: expected a place within 10 m"},
        {{{"gcode-start", "G0 X1 Ynan"}}, "gcode-start Ynan: expected a place within 10 m"},
        {{{"pen", "2 speed=20"}, {"plotter", "true"}}, "writes them"},
        {{{"pen", "2 speed=20"}}, "pen: needs 'plotter'"},
        {{{"refill", "5m@1,1"}}, "refill: needs 'plotter'"},
        {{{"refill", "5m"}, {"plotter", "true"}}, "such as 5m@10,10"},
        {{{"park", "0,0"}, {"plotter", "true"}}, "applies only to HP-GL and G-code"},
        {{{"resume", "0m"}, {"plotter", "true"}}, "a length above 0"},
        {{{"arcs", "false"}, {"plotter", "true"}}, "applies only to G-code"},
        {{{"min-arc", "1mm"}, {"plotter", "true"}}, "applies only to G-code"},
        {{{"overprint", "black"}}, "only a PDF has inks that overprint"},
        {{{"registration", "true"}}, "only a PDF has registration marks"},
        {{{"dots", "gold gold"}}, "unexpected 'gold'"},
        {{{"dots", "0mm"}}, "a dot of width 0"},
        {{{"dot-spacing", "-3mm"}}, "above 0"},
        {{{"dot-spacing", "3mm"}, {"step", "1mm"}}, "cannot be combined with 'step': both set the step length"},
        {{{"border", "lotsu"}}, "unknown border; did you mean 'lotus'?"},
        {{{"colour-by", "mood"}}, "expected strand"},
        {{{"animate", "0"}}, "above 0"},
        {{{"animate", "fast"}}, "above 0"},
        {{{"generations", "4:2"}}, "the lowest first"},
        {{{"generations", "x"}}, "such as 0:4"},
        {{{"tile", "A11"}}, "tile A11"},
        {{{"tile", "A4"}, {"overlap", "200mm"}}, "too small for an overlap"},
        {{{"tile", "A4"}, {"plotter", "true"}}, "tiles would cut the strokes"},
        {{{"border", "kaavi"}, {"window", "0,0,5,5"}}, "a window shows only part"},
        {{{"plotter", "true"}, {"window", "0,0,5,5"}}, "a window would cut the strokes"}};
    for (const auto& [values, message] : cases) {
        EXPECT_TRUE(is_refused(drawn("snake-kolam", "svg", values), 2, message))
            << values.front().name << " " << values.back().name;
    }
    EXPECT_TRUE(is_refused(drawn("snake-kolam", "png", {{"animate", ""}}), 2, ""));
    EXPECT_TRUE(is_refused(drawn("snake-kolam", "png", {{"plotter", "true"}}), 2, ""));
    // Off the page a plotter would run against its stops.
    EXPECT_TRUE(is_refused(drawn("snake-kolam", "hpgl", {{"step", "50mm"}}), 1, ""));
    EXPECT_TRUE(is_refused(drawn("hilbert", "svg", {{"dots", "only"}}), 1, ""));
    EXPECT_TRUE(is_refused(drawn("hilbert", "tif", {{"screen", "diffusion"}}), 2, ""));
    EXPECT_TRUE(is_refused(drawn("hilbert", "tif", {{"bits", "1"}, {"screen", "mist"}}), 2, ""));
    EXPECT_TRUE(is_refused(drawn("hilbert", "tif", {{"bits", "1"}, {"screen", "halftone,200"}}), 2, ""));
}

/// A pattern with surfaces that neither pitches nor rolls nor bends.
TEST(Prints, WhatSpaceLacksIsRefused) {
    const std::string leafy =
        "title: Leafy\naxiom: F~leaf(s)F\ndefine s = 1\nstroke: 0.1 step black\npatch leaf:\n"
        "0 0 0, 1 0 0, 2 0 0, 3 0 0\n0 1 0, 1 1 0, 2 1 0, 3 1 0\n"
        "0 2 0, 1 2 0, 2 2 0, 3 2 0\n0 3 0, 1 3 0, 2 3 0, 3 3 0\n";
    for (const OptionValue& value : OptionValues{{"dots", ""},
                                                 {"border", "kaavi"},
                                                 {"animate", "5"},
                                                 {"lesson", ""},
                                                 {"repeat", "frieze:3"},
                                                 {"window", "0,0,1,1"}}) {
        EXPECT_TRUE(is_refused(made_work(prints(), parse("-", leafy), "svg", {value}), 2,
                               "this one pitches, rolls, bends or has surfaces"))
            << value.name;
    }
    EXPECT_TRUE(has(error_of([&] { examine_kolam(parse("-", leafy), 1e6, {}); }), "or has surfaces"));
}

TEST(Prints, ScreensAreTheSameOnEveryNumberOfThreads) {
    const Document plant = load("flowering-plant");
    const auto bytes = [&](OptionValues values, int threads) {
        values.insert(values.end(), {{"bits", "1"}, {"size", "60x60mm"}, {"dpi", "300"}});
        return made_work([&](MemoryDestination& memory) {
                   return prints().plan(plant, "tif", values)->make(memory, "x.tif", {}, threads);
               })
            .bytes();
    };
    for (const char* screen : {"threshold", "diffusion", "halftone,60"}) {
        EXPECT_EQ(bytes({{"screen", screen}}, 1), bytes({{"screen", screen}}, 4)) << screen;
    }
    EXPECT_EQ(bytes({}, 1), bytes({{"screen", "threshold"}}, 1));
    EXPECT_NE(bytes({}, 1), bytes({{"screen", "halftone,60"}}, 1));
}

TEST(Prints, BlankPicturesAreReportedWithTheirRemedy) {
    const auto remarks = [](const std::string& pattern, OptionValues values) {
        values.push_back({"dpi", "40"});
        const MadeWork made = drawn(pattern, "png", values);
        EXPECT_EQ(made.error, "");
        return made.remarks;
    };
    for (const char* n : {"25", "8"}) {
        const std::string warnings = remarks("koch-island", {{"n", n}});
        EXPECT_TRUE(has(warnings, "the picture looks empty"));
        EXPECT_TRUE(has(warnings, "(stroke: 0.3mm)"));
        EXPECT_FALSE(has(warnings, "window"));
    }
    EXPECT_EQ(remarks("koch-island", {{"n", "25"}, {"stroke", "0.3mm"}}), "");
    EXPECT_EQ(remarks("koch-island", {{"n", "3"}}), "");
    EXPECT_EQ(remarks("bush-3d", {{"n", "3"}}), "");
    EXPECT_TRUE(
        has(remarks("hilbert", {{"n", "60"}, {"window", "500,500,600,600"}}), "contains no part of the drawing"));
    EXPECT_EQ(remarks("hat", {{"n", "60"}, {"window", "0,0,20,20"}}), "");
    EXPECT_TRUE(is_refused(drawn("hat", "png", {{"n", "120"}, {"window", "0,0,20,20"}}), 1,
                           "at n = 120 the rounding errors of places add up to more than 0.001 steps"));
}

TEST(Prints, NamesOfTilesNeedTiles) {
    const std::string warning = "'name-tiles' has no effect: this drawing has no filled polygons with straight edges";
    for (const std::string format : {"svg", "pdf", "dxf"}) {
        for (const bool has_tiles : {true, false}) {
            const Document document = load(has_tiles ? "chair" : "hilbert");
            const OptionValues names = {{"name-tiles", "true"}};
            std::vector<MadeWork> works = {
                made_work(prints(), document.with({{"derivation length", "2"}}), format, names),
                made_work([&](MemoryDestination& memory) {
                    return plan_sheet({{document, {}}}, format, names)->make(memory, "x." + format, {});
                })};
            if (format != "dxf") {
                works.push_back(
                    made_work(prints(), document, format, {{"n", "2"}, {"name-tiles", "true"}, {"tile", "a6"}}));
            }
            for (const MadeWork& work : works) {
                EXPECT_EQ(work.error, "");
                EXPECT_EQ(work.remarks.find(warning) == std::string::npos, has_tiles) << format << work.remarks;
            }
        }
    }
    // An empty window says nothing about the drawing.
    const std::string empty =
        drawn("spectre", "svg", {{"n", "40"}, {"window", "1000000,3,1000040,43"}, {"name-tiles", "true"}}).remarks;
    EXPECT_TRUE(has(empty, "the window contains no part of the drawing"));
    EXPECT_FALSE(has(empty, warning));
}

}  // namespace sikku::prints_test
