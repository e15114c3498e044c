// tests/program/print_options_test.cpp: runs the program to draw dots, borders, animations, tiles and plots.
#include "art/print/border.h"
#include "art/print/ornaments.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <sstream>

namespace sikku::print_options_test {

class PrintOptions : public ::testing::Test {
protected:
    Outcome draw(std::vector<std::string> arguments, const std::string& file) {
        arguments.insert(arguments.begin(), "draw");
        arguments.insert(arguments.end(), {"-o", (folder_ / file).string()});
        return run(arguments, {});
    }
    pugi::xml_document svg(const std::vector<std::string>& arguments) {
        const Outcome outcome = draw(arguments, "print.svg");
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        pugi::xml_document document;
        EXPECT_TRUE(document.load_file((folder_ / "print.svg").c_str()));
        return document;
    }
    static std::vector<std::string> layers(const pugi::xml_document& document) {
        std::vector<std::string> labels;
        for (const auto& found : document.select_nodes("//g[@inkscape:label]")) {
            labels.emplace_back(found.node().attribute("inkscape:label").value());
        }
        return labels;
    }
    static std::size_t count(const pugi::xml_document& document, const char* path) {
        return document.select_nodes(path).size();
    }

    ScratchFolder folder_;
};

TEST_F(PrintOptions, DotsStandWhereTheExaminationSetsThem) {
    const auto document = svg({"snake-kolam", "-n", "3", "--dots", "1.5mm gold", "--step", "3mm"});
    std::vector<std::pair<double, double>> centres;
    for (const auto& found : document.select_nodes("//circle")) {
        const pugi::xml_node circle = found.node();
        EXPECT_NEAR(circle.attribute("r").as_double(), 750, 0.1);
        centres.emplace_back(circle.attribute("cx").as_double(), circle.attribute("cy").as_double());
    }
    EXPECT_EQ(centres.size(), 85u);
    EXPECT_TRUE(has(contents(folder_ / "print.svg"), "discs gold"));
    // The same by the pattern's own key.
    const std::string first = contents(folder_ / "print.svg");
    std::regex made("<sikku:made>.*</sikku:made>");
    svg({"snake-kolam", "-n", "3", "--set", "dots=1.5mm gold", "--step", "3mm"});
    EXPECT_EQ(std::regex_replace(first, made, ""), std::regex_replace(contents(folder_ / "print.svg"), made, ""));

    const auto only = svg({"snake-kolam", "-n", "3", "--dots=only", "--dot-spacing", "15mm"});
    EXPECT_EQ(count(only, "//path"), 0u);
    ASSERT_EQ(count(only, "//circle"), 85u);
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

TEST_F(PrintOptions, ABorderIsALayerOfItsOwnWithinTheMargins) {
    const auto plain = svg({"snake-kolam", "-n", "2"});
    const auto framed = svg({"snake-kolam", "-n", "2", "--border", "kaavi"});
    // Its white is the ink of the lines.
    EXPECT_EQ(layers(framed).size(), layers(plain).size() + 2);
    EXPECT_EQ(count(framed, "//circle"), 4u);
    EXPECT_EQ(count(framed, "//g[@stroke='#fffaf0']"), 1u);
    const auto strokes = framed.select_nodes("//g[@stroke='#e07a50']/path");
    ASSERT_EQ(strokes.size(), 1u);
    EXPECT_TRUE(std::string_view(strokes.first().node().attribute("d").value()).ends_with("z"));
    for (const char* format : {"png", "pdf", "hpgl"}) {
        EXPECT_EQ(draw({"snake-kolam", "-n", "2", "--border", "kaavi", "--dots", "--dpi", "40"},
                       std::string("framed.") + format)
                      .status,
                  0);
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

TEST_F(PrintOptions, StrandsAreToldApart) {
    const Outcome made = run({"kolam", "--grid", "5x5", "--symmetry", "none", "--density", "0.7", "--seed", "4", "-o",
                              (folder_ / "five.lsys").string()});
    ASSERT_EQ(made.status, 0) << made.errors;
    EXPECT_TRUE(has(made.errors, "5 lines"));
    const auto document = svg({(folder_ / "five.lsys").string(), "--colour-by", "strand"});
    std::set<std::string> colours;
    for (const auto& found : document.select_nodes("//g[@stroke]")) {
        colours.insert(found.node().attribute("stroke").value());
    }
    EXPECT_EQ(colours.size(), 5u);
    EXPECT_EQ(count(document, "//path"), 5u);
    EXPECT_TRUE(colours.contains("#fffaf0"));
    for (const std::string& colour : colours) {
        EXPECT_GT(colour_distance(*parse_colour(colour), *parse_colour("#7d3324")), 0.2) << colour;
    }
    // Images of each other have one colour.
    ASSERT_EQ(run({"kolam", "--grid", "7x7", "--symmetry", "C4", "--density", "0.4", "--seed", "2", "-o",
                   (folder_ / "seven.lsys").string()})
                  .status,
              0);
    const Outcome told = run({"kolam", (folder_ / "seven.lsys").string(), "--json"});
    const auto four = svg({(folder_ / "seven.lsys").string(), "--colour-by", "strand"});
    EXPECT_LT(count(four, "//g[@stroke]"), count(four, "//path")) << told.output;
}

TEST_F(PrintOptions, AnAnimationTakesItsTimeAndIsWholeWithoutIt) {
    const auto document = svg({"tree-in-voices", "-n", "3", "--animate", "12"});
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
    const std::string file = (folder_ / "print.svg").string();
    EXPECT_TRUE(run_tool("rsvg-convert " + file + " -o " + file + ".png").ok);
    ASSERT_EQ(draw({"tree-in-voices", "-n", "3"}, "still.svg").status, 0);
    const std::string still = (folder_ / "still.svg").string();
    EXPECT_TRUE(run_tool("rsvg-convert " + still + " -o " + still + ".png").ok);
    EXPECT_EQ(contents(file + ".png"), contents(still + ".png"));
}

TEST_F(PrintOptions, GenerationsStandSideBySide) {
    const auto document = svg({"snake-kolam", "--generations", "0:3", "--landscape", "--animate"});
    const std::string text = contents(folder_ / "print.svg");
    for (const char* caption : {"n = 0", "n = 3"}) EXPECT_TRUE(has(text, caption));
    EXPECT_GT(count(document, "//path[@pathLength]"), 4u);
}

TEST_F(PrintOptions, TilesMakeUpTheWholePrint) {
    const Outcome outcome =
        draw({"snake-kolam", "-n", "4", "--dots", "--dot-spacing", "15mm", "--tile", "A4"}, "big.svg");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    // 341 dots in 31 rows, 10.6 mm apart: 330 mm and the pen's width, with 200 and 190 mm on each sheet.
    EXPECT_TRUE(has(outcome.errors, "4 sheets"));
    EXPECT_EQ(folder_.names().size(), 4u);
    // The dots of all sheets, laid out as the sheets are, are those of the whole.
    std::set<std::pair<long, long>> dots;
    for (const auto& [name, left, top] : {std::tuple("big-1-1.svg", 0, 0),
                                          {"big-1-2.svg", 190, 0},
                                          {"big-2-1.svg", 0, 277},
                                          {"big-2-2.svg", 190, 277}}) {
        pugi::xml_document sheet;
        ASSERT_TRUE(sheet.load_file((folder_ / name).c_str()));
        EXPECT_STREQ(sheet.document_element().attribute("width").value(), "210mm");
        for (const auto& found : sheet.select_nodes("//circle")) {
            dots.emplace(std::lround(found.node().attribute("cx").as_double() / 10 + left * 100),
                         std::lround(found.node().attribute("cy").as_double() / 10 + top * 100));
        }
    }
    EXPECT_EQ(dots.size(), 341u);
    // Nothing is left of sheets that were not finished.
    EXPECT_EQ(draw({"snake-kolam", "--tile", "20x20mm"}, "none.svg").status, 2);
    EXPECT_EQ(folder_.names().size(), 4u);
}

TEST_F(PrintOptions, PlotsDrawNothingTwice) {
    const Outcome outcome = draw({"spiral-tiling", "--plotter", "--travel", "--split", "500mm"}, "plot.svg");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "segments drawn twice"));
    EXPECT_TRUE(has(outcome.errors, "before: "));
    EXPECT_TRUE(has(outcome.errors, "plot: "));
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "plot.svg").c_str()));
    const auto labels = layers(document);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), "% ground"), 0);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), "% travel"), 1);
    for (const std::string& label : labels) {
        EXPECT_TRUE(label.starts_with('%') || std::isdigit(static_cast<unsigned char>(label.front()))) << label;
    }
    const auto gcode = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"hilbert", "-n", "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(draw(arguments, "plot.gcode").status, 0);
        return contents(folder_ / "plot.gcode");
    };
    EXPECT_TRUE(has(gcode({}), "M3"));
    const std::string z =
        gcode({"--profile", "z", "--pen-speed", "25", "--gcode-start", "G28", "--gcode-end", "M84"});
    EXPECT_TRUE(has(z, "F1500"));
    EXPECT_TRUE(has(z, "G28\n"));
    EXPECT_TRUE(z.ends_with("M84\n"));
    EXPECT_FALSE(has(z, "M3"));
}

TEST_F(PrintOptions, MistakesAreToldBeforeAnythingIsWritten) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--pen-speed", "0", "--plotter"}, "expected 0.001 to 1000000"},
        {{"--pen-speed", "nan", "--plotter"}, "--pen-speed nan: expected a number"},
        {{"--split", "0mm", "--plotter"}, "a length above 0"},
        {{"--split", "1m"}, "--split"},
        {{"--travel"}, "needs --plotter"},
        {{"--profile", "grlb", "--plotter"}, "unknown plotter; did you mean 'grbl'?"},
        {{"--profile", "roland", "--plotter"}, "or a file with a dot or a slash in its name"},
        {{"--gcode-end", "G0 X1e300 Y1"}, "--gcode-end X1e300: expected a place within 10 m"},
        {{"--gcode-start", "G0 X1 Ynan"}, "--gcode-start Ynan: expected a place within 10 m"},
        {{"--pen", "2 speed=20", "--plotter"}, "--profile axidraw writes them"},
        {{"--pen", "2 speed=20"}, "--pen: needs --plotter"},
        {{"--refill", "5m@1,1"}, "--refill: needs --plotter"},
        {{"--refill", "5m", "--plotter"}, "such as 5m@10,10"},
        {{"--park", "0,0", "--plotter"}, "applies only to HP-GL and G-code"},
        {{"--resume", "0m", "--plotter"}, "a length above 0"},
        {{"--no-arcs", "--plotter"}, "applies only to G-code"},
        {{"--min-arc", "1mm", "--plotter"}, "applies only to G-code"},
        {{"--overprint", "black"}, "only a PDF has inks that overprint"},
        {{"--registration"}, "only a PDF has registration marks"},
        {{"--dots", "gold gold"}, "unexpected 'gold'"},
        {{"--dots", "0mm"}, "a dot of width 0"},
        {{"--dot-spacing", "-3mm"}, "above 0"},
        {{"--dot-spacing", "3mm", "--step", "1mm"}, "cannot be combined with --step: both set the step length"},
        {{"--border", "lotsu"}, "expected kaavi"},
        {{"--colour-by", "mood"}, "expected strand"},
        {{"--animate", "0"}, "above 0"},
        {{"--animate", "fast"}, "above 0"},
        {{"--generations", "4:2"}, "the lowest first"},
        {{"--generations", "x"}, "such as 0:4"},
        {{"--tile", "A11"}, "--tile A11"},
        {{"--tile", "A4", "--overlap", "200mm"}, "too small for an overlap"},
        {{"--tile", "A4", "--plotter"}, "tiles would cut the strokes"},
        {{"--border", "kaavi", "--window", "0,0,5,5"}, "a window shows only part"},
        {{"--plotter", "--window", "0,0,5,5"}, "a window would cut the strokes"},
    };
    for (const auto& [arguments, message] : cases) {
        std::vector<std::string> all = {"snake-kolam"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = draw(all, "bad.svg");
        EXPECT_NE(outcome.status, 0) << arguments.front() << " " << arguments.back();
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_TRUE(folder_.names().empty());
    }
    EXPECT_EQ(draw({"snake-kolam", "--animate"}, "bad.png").status, 2);
    EXPECT_EQ(draw({"snake-kolam", "--plotter"}, "bad.png").status, 2);
    // Off the page a plotter would run against its stops.
    EXPECT_EQ(draw({"snake-kolam", "--step", "50mm"}, "bad.hpgl").status, 1);
    EXPECT_TRUE(folder_.names().empty());
    EXPECT_EQ(draw({"hilbert", "--dots=only"}, "bad.svg").status, 1);
}

TEST_F(PrintOptions, KolamsAreMadeAndExamined) {
    const std::string file = (folder_ / "mine.lsys").string();
    ASSERT_EQ(run({"kolam", "--grid", "7x7", "--symmetry", "C4", "--single-line", "--seed", "3", "-o", file}).status,
              0);
    const Outcome examined = run({"kolam", file, "--json"});
    EXPECT_EQ(examined.status, 0);
    EXPECT_TRUE(has(examined.output, "\"kolam\": true"));
    EXPECT_TRUE(has(examined.output, "\"lines\": 1, \"open_lines\": 0"));
    EXPECT_TRUE(has(examined.output, "\"symmetry\": \"C4\""));
    // Several lines, between which the turtle moves with a pen that is not seen.
    ASSERT_EQ(run({"kolam", "--grid", "4x6", "--crossings", "all", "-o", file}).status, 0);
    EXPECT_TRUE(has(run({"kolam", file}).output, "2 closed lines, 24 dots, all encircled"));
    EXPECT_EQ(run(std::vector<std::string>{"kolam"}).status, 2);
    EXPECT_EQ(run({"kolam", "snake-kolam", "--grid", "3x3"}).status, 2);
    EXPECT_EQ(run({"kolam", "--grid", "3x4", "--symmetry", "C4"}).status, 2);
}

TEST(ScreenedPrint, IsTheSameOnEveryNumberOfThreads) {
    ScratchFolder folder;
    const auto draw = [&](std::vector<std::string> more, const std::string& file) {
        more.insert(more.begin(), {"--quiet", "draw", "flowering-plant", "--size", "60x60mm", "--dpi", "300"});
        more.insert(more.end(), {"-o", folder.file(file)});
        return run(more);
    };
    for (const char* screen : {"threshold", "diffusion", "halftone,60"}) {
        ASSERT_EQ(draw({"--bits", "1", "--screen", screen, "-j", "1"}, "a.tif").status, 0) << screen;
        ASSERT_EQ(draw({"--bits", "1", "--screen", screen, "-j", "4"}, "b.tif").status, 0) << screen;
        EXPECT_EQ(contents(folder / "a.tif"), contents(folder / "b.tif")) << screen;
    }
    ASSERT_EQ(draw({"--bits", "1"}, "plain.tif").status, 0);
    ASSERT_EQ(draw({"--bits", "1", "--screen", "threshold"}, "a.tif").status, 0);
    EXPECT_EQ(contents(folder / "plain.tif"), contents(folder / "a.tif"));
    EXPECT_NE(contents(folder / "plain.tif"), contents(folder / "b.tif"));
    EXPECT_EQ(draw({"--screen", "diffusion"}, "x.tif").status, 2);
    EXPECT_EQ(draw({"--bits", "1", "--screen", "mist"}, "x.tif").status, 2);
    EXPECT_EQ(draw({"--bits", "1", "--screen", "halftone,200"}, "x.tif").status, 2);
    folder.write("g.toml",
                 "format = \"tif\"\nsize = \"60x60mm\"\ndpi = 300\n[[item]]\n"
                 "pattern = \"flowering-plant\"\nbits = 1\nscreen = \"halftone,60\"\n");
    const Outcome gallery = run({"-q", "gallery", "--file", folder.file("g.toml"), "-o", folder.file("g")});
    EXPECT_EQ(gallery.status, 0) << gallery.errors;
    EXPECT_EQ(contents(folder / "g/flowering-plant.tif"), contents(folder / "b.tif"));
}

TEST(BlankPicture, IsReportedWithItsRemedy) {
    ScratchFolder folder;
    const auto draw = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "draw");
        more.insert(more.end(), {"--dpi", "40", "-o", folder.file("b.png")});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return outcome.errors;
    };
    for (const std::string& errors : {draw({"koch-island", "-n", "25"}), draw({"koch-island", "-n", "8"})}) {
        EXPECT_TRUE(has(errors, "the picture looks empty"));
        EXPECT_TRUE(has(errors, "(stroke: 0.3mm)"));
        EXPECT_FALSE(has(errors, "window"));
    }
    EXPECT_EQ(draw({"koch-island", "-n", "25", "--set", "stroke=0.3mm"}), "");
    EXPECT_EQ(draw({"koch-island", "-n", "3"}), "");
    EXPECT_EQ(draw({"bush-3d", "-n", "3"}), "");
    EXPECT_TRUE(has(draw({"hilbert", "-n", "60", "--window", "500,500,600,600"}), "contains no part of the drawing"));
    EXPECT_EQ(draw({"hat", "-n", "60", "--window", "0,0,20,20"}), "");
    const Outcome far = run({"draw", "hat", "-n", "120", "--window", "0,0,20,20", "-o", folder.file("far.png")});
    EXPECT_EQ(far.status, 1);
    EXPECT_TRUE(has(far.errors, "at n = 120 the rounding errors of places add up to more than 0.001 steps"));
    // The example of the help shows something.
    const std::string help = run(std::vector<std::string>{"draw", "--help"}).output;
    const std::size_t at = help.find("hilbert -n 60 --window ");
    ASSERT_NE(at, std::string::npos);
    const std::size_t begin = at + std::string_view("hilbert -n 60 --window ").size();
    const std::string window = help.substr(begin, help.find_first_of(" \n", begin) - begin);
    EXPECT_EQ(draw({"hilbert", "-n", "60", "--window", window}), "");
}

}  // namespace sikku::print_options_test
