// Ink that can hardly be seen on its ground is reported, whatever draws it.
#include "art/prints.h"
#include "art/sheets.h"
#include "art/style/contrast.h"
#include "engine/base/output.h"
#include "tests/files.h"
#include "tests/reference.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::faint_inks_test {

/// The warnings about a print.
std::string warnings(const Document& document, const OptionValues& values, const std::string& format = "svg") {
    OptionValues all = values;
    all.push_back({"size", "60x60mm"});
    return warnings_of(remarks_about(prints(), document, format, all));
}

bool is_told(const std::string& text) {
    return text.find("can hardly be seen") != std::string::npos;
}

const std::string kolam =
    "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle increment: 90\nline: spline\n"
    "stroke: 0.2 step #fffaf0\nground: #8c3b2a\n";

/// Values of published pairs: Sharma, Wu & Dalal list L*a*b*; white, grey and primaries follow from sRGB.
TEST(Contrast, IsTheCieColourDifference) {
    const Colour white{255, 255, 255, 255}, black{0, 0, 0, 255};
    EXPECT_NEAR(colour_difference(white, black), 100, 1e-3);
    EXPECT_EQ(colour_difference(white, white), 0);
    // L* of 119/255 grey is 50.03.
    EXPECT_NEAR(colour_difference({119, 119, 119, 255}, black), 50.03, 0.01);
    // sRGB red is 53.24, 80.09, 67.20, and blue 32.30, 79.19, -107.86.
    EXPECT_NEAR(colour_difference({255, 0, 0, 255}, {0, 0, 255, 255}),
                std::sqrt(20.94 * 20.94 + 0.9 * 0.9 + 175.06 * 175.06), 0.05);
    EXPECT_EQ(laid_over({0, 0, 0, 128}, white), (Colour{127, 127, 127, 255}));
    EXPECT_EQ(laid_over({10, 20, 30, 255}, white), (Colour{10, 20, 30, 255}));
}

TEST(FaintInks, AreReportedInEveryOutput) {
    const Document document = parse("kolam.lsys", kolam);
    const OptionValues white = {{"ground", "white"}};
    for (const char* format : {"svg", "pdf", "eps", "png", "tif"}) {
        EXPECT_TRUE(is_told(warnings(document, white, format))) << format;
        EXPECT_FALSE(is_told(warnings(document, {}, format))) << format;
    }
    const auto with = [&](const OptionValues& more) {
        OptionValues all = white;
        all.insert(all.end(), more.begin(), more.end());
        return warnings(document, all);
    };
    EXPECT_EQ(with({}),
              "lines in floralwhite can hardly be seen on a ground in white; set the colour of 'stroke', or "
              "'ground'\n");
    EXPECT_TRUE(is_told(with({{"lesson", ""}})));
    EXPECT_TRUE(is_told(with({{"tile", "50x50mm"}})));
    EXPECT_TRUE(is_told(with({{"repeat", "p1:2x2"}})));
    EXPECT_TRUE(is_told(with({{"generations", "0:1"}})));
    EXPECT_TRUE(has(with({{"stroke", "0.2 step #804020"}, {"dots", "2mm #fefefe"}}), "dots in #fefefe"));
    EXPECT_TRUE(has(with({{"stroke", "0.2 step #804020"}, {"fields", "chessboard"}, {"powders", "#fff0f0 #fff0f0"}}),
                    "fields in #fff0f0"));
    // Borders choose colours that can be seen.
    EXPECT_FALSE(is_told(with({{"stroke", "0.2 step #804020"}, {"border", "lotus"}, {"dots", ""}})));
    // Paper may have any colour.
    EXPECT_FALSE(is_told(warnings(document, {{"ground", "none"}})));
    EXPECT_FALSE(is_told(with({{"plotter", "true"}})));
}

TEST(FaintInks, SheetsNameTheDrawings) {
    MemoryDestination memory;
    const std::vector<SheetItem> items = {{parse("a.lsys", "title: Seen\n" + kolam), {}},
                                          {parse("b.lsys", "title: Unseen\n" + kolam), {{"ground", "snow"}}}};
    const std::string text = remarks_of(plan_sheet(items, "svg", {})->make(memory, "sheet.svg", {}, 1));
    EXPECT_TRUE(has(text, "'Unseen': lines in floralwhite"));
    EXPECT_FALSE(has(text, "'Seen'"));
}

TEST(FaintInks, PracticeDotsAreVisible) {
    const Document document = parse("kolam.lsys", kolam);
    for (const char* ground : {"#8c3b2a", "white", "snow", "none"}) {
        const OptionValues values = {{"dots", "only"}, {"ground", ground}};
        EXPECT_FALSE(is_told(warnings(document, values))) << ground;
        const std::string svg = draw(document, "svg", values);
        const std::size_t fill = svg.find("fill=\"#", svg.find("discs"));
        const std::string colour = svg.substr(fill + 6, 7);
        EXPECT_GT(colour_difference(*parse_colour(colour), {255, 255, 255, 255}), 15) << ground << colour;
    }
}

/// Joints in the colour of the ground show tiles, and outlines show pale fills; neither shows the other.
TEST(FaintInks, JointsAndOutlinesAreSeen) {
    const auto tiles = [](const std::string& keys) {
        return parse("tiles.lsys", "angle increment: 90\naxiom: [{F+F+F+F}]f[{F+F+F+F}]\nground: white\n" + keys);
    };
    const std::string joints = "stroke: 0.1 step white\n";
    EXPECT_FALSE(is_told(warnings(tiles(joints + "palette: navy\n"), {})));
    EXPECT_TRUE(is_told(warnings(tiles(joints + "palette: #fefefe\n"), {})));
    EXPECT_FALSE(is_told(warnings(tiles("stroke: 0.1 step navy\npalette: #fefefe\n"), {})));
    EXPECT_TRUE(is_told(warnings(tiles("stroke: none\npalette: #fefefe\n"), {})));
    // Only along their edges.
    EXPECT_TRUE(is_told(warnings(parse("apart.lsys",
                                       "angle increment: 90\naxiom: FFFF;f[{F+F+F+F}]\nground: white\n"
                                       "stroke: 0.1 step white\npalette: navy\n"),
                                 {})));
    EXPECT_TRUE(is_told(warnings(tiles("stroke: 0.1 step transparent\npalette: #fefefe\n"), {})));
    // Dots show no lines.
    const Document kolam_on_white = parse("kolam.lsys", kolam);
    EXPECT_TRUE(is_told(warnings(kolam_on_white, {{"ground", "white"}, {"dots", "2mm navy"}})));
}

/// Bundled patterns have no faint ink on their own ground.
TEST(FaintInks, NoBundledPatternHasAny) {
    for (const char* folder : {"kolams", "tilings", "words", "curves"}) {
        for (const auto& file : pattern_files(std::string("patterns/") + folder)) {
            const Document document = load(file.string());
            EXPECT_FALSE(is_told(warnings(document, {}))) << file;
        }
    }
}

}  // namespace sikku::faint_inks_test
