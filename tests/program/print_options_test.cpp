// tests/program/print_options_test.cpp: runs the program to draw strands, tiles and kolams, and with faulty options.
#include "art/print/ornaments.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <pugixml.hpp>
#include <set>

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
    static std::size_t count(const pugi::xml_document& document, const char* path) {
        return document.select_nodes(path).size();
    }

    ScratchFolder folder_;
};

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

TEST_F(PrintOptions, TilesAreFilesAndAppearTogether) {
    const Outcome outcome =
        draw({"snake-kolam", "-n", "4", "--dots", "--dot-spacing", "15mm", "--tile", "A4"}, "big.svg");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "4 sheets"));
    for (const char* name : {"big-1-1.svg", "big-1-2.svg", "big-2-1.svg", "big-2-2.svg"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    }
    EXPECT_EQ(draw({"snake-kolam", "--tile", "20x20mm"}, "none.svg").status, 2);
    EXPECT_EQ(folder_.names().size(), 4u);
}

TEST_F(PrintOptions, MistakesAreToldBeforeAnythingIsWritten) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--pen-speed", "nan", "--plotter"}, "--pen-speed nan: expected a number"},
        {{"--travel"}, "needs --plotter"},
        {{"--gcode-end", "G0 X1e300 Y1"}, "--gcode-end X1e300: expected a place within 10 m"},
        {{"--pen", "2 speed=20", "--plotter"}, "--profile axidraw writes them"},
        {{"--pen", "2 speed=20"}, "--pen: needs --plotter"},
        {{"--refill", "5m@1,1"}, "--refill: needs --plotter"},
        {{"--no-arcs", "--plotter"}, "applies only to G-code"},
        {{"--dots", "gold gold"}, "unexpected 'gold'"},
        {{"--dot-spacing", "3mm", "--step", "1mm"}, "cannot be combined with --step: both set the step length"},
        {{"--tile", "A11"}, "--tile A11"}};
    for (const auto& [arguments, message] : cases) {
        std::vector<std::string> all = {"snake-kolam"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = draw(all, "bad.svg");
        EXPECT_EQ(outcome.status, 2) << arguments.front() << " " << arguments.back();
        EXPECT_TRUE(has(outcome.errors, message));
    }
    // Off the page a plotter would run against its stops.
    EXPECT_EQ(draw({"snake-kolam", "--step", "50mm"}, "bad.hpgl").status, 1);
    EXPECT_TRUE(folder_.names().empty());
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

TEST(FilledPage, DeterminesItsDerivationLength) {
    ScratchFolder folder;
    const Outcome outcome =
        run({"draw", "penrose-rhombs", "-n", "3", "--fill-page", "--size", "60x60mm", "-o", folder.file("x.svg")});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.errors, "the derivation length 3 is not used: --fill-page determines its own"));
}

TEST(ScreenedPrint, OfAGalleryIsThatOfTheLibrary) {
    ScratchFolder folder;
    folder.write("g.toml",
                 "format = \"tif\"\nsize = \"60x60mm\"\ndpi = 300\n[[item]]\n"
                 "pattern = \"flowering-plant\"\nbits = 1\nscreen = \"halftone,60\"\n");
    const Outcome gallery = run({"-q", "gallery", "--file", folder.file("g.toml"), "-o", folder.file("g")});
    EXPECT_EQ(gallery.status, 0) << gallery.errors;
    const std::vector<std::string> command = {
        "-q",          "draw", "flowering-plant",    "--size", "60x60mm", "--dpi", "300", "--bits", "1", "--screen",
        "halftone,60", "-o",   folder.file("b.tif"), "-j",     "1"};
    ASSERT_EQ(run(command).status, 0);
    EXPECT_EQ(contents(folder / "g/flowering-plant.tif"), contents(folder / "b.tif"));
}

/// The example of the help shows something.
TEST(BlankPicture, IsReportedWithItsRemedy) {
    ScratchFolder folder;
    const auto draw = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "draw");
        more.insert(more.end(), {"--dpi", "40", "-o", folder.file("b.png")});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return outcome.errors;
    };
    EXPECT_TRUE(has(draw({"koch-island", "-n", "25"}), "the picture looks empty"));
    const std::string help = run(std::vector<std::string>{"draw", "--help"}).output;
    const std::size_t at = help.find("hilbert -n 60 --window ");
    ASSERT_NE(at, std::string::npos);
    const std::size_t begin = at + std::string_view("hilbert -n 60 --window ").size();
    const std::string window = help.substr(begin, help.find_first_of(" \n", begin) - begin);
    EXPECT_EQ(draw({"hilbert", "-n", "60", "--window", window}), "");
}

}  // namespace sikku::print_options_test
