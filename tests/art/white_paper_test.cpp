// Drawings on white paper: the ground is white, and no line, dot or fill vanishes on it.
#include "art/style/white_paper.h"
#include "art/prints.h"
#include "art/sheets.h"
#include "art/style/contrast.h"
#include "engine/language/pattern_library.h"
#include "tests/checks.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::white_paper_test {

Style style_of(const std::string& text, const std::vector<Setting>& settings = {}) {
    Diagnostics diagnostics;
    const Document document = parse("paper.lsys", "axiom: F\n" + text);
    const Document set = settings.empty() ? document : document.with(settings);
    Style style = read_style(set.pattern(), 96, diagnostics);
    diagnostics.throw_if_errors();
    return style;
}

/// An SVG without the text of the pattern and the recipe.
std::string drawing_of(const std::string& svg) {
    return svg.substr(svg.find("</metadata>"));
}

const Colour white{255, 255, 255, 255}, earth{0x7d, 0x33, 0x24, 255};

/// W3C states the contrast of #777777 on white as 4.48 and that of #767676 as 4.54.
TEST(WhitePaper, ContrastIsThatOfWcag) {
    EXPECT_NEAR(contrast_ratio(white, {0, 0, 0, 255}), 21, 1e-9);
    EXPECT_NEAR(contrast_ratio({0x77, 0x77, 0x77, 255}, white), 4.48, 0.005);
    EXPECT_NEAR(contrast_ratio(white, {0x76, 0x76, 0x76, 255}), 4.54, 0.005);
    EXPECT_EQ(contrast_ratio(white, white), 1);
}

TEST(WhitePaper, FlourTakesTheColourOfTheGround) {
    const Style style = style_of(
        "ground: #7d3324\nstroke: 0.2 step #fffaf0\npalette: #fffaf0 transparent #3d6cb0\n"
        "dots: 2mm white\nfill: cornsilk\npaper: white\n");
    EXPECT_EQ(style.ground, white);
    EXPECT_EQ(style.stroke_colour, earth);
    EXPECT_EQ(style.fill, earth);
    EXPECT_EQ(style.dots->colour, earth);
    EXPECT_EQ(style.palette, (std::vector<Colour>{earth, {0, 0, 0, 0}, {0x3d, 0x6c, 0xb0, 255}}));
}

TEST(WhitePaper, InkIsEarthWithoutADarkGround) {
    EXPECT_EQ(style_of("ground: none\nstroke: white\npaper: white\n").stroke_colour, deep_earth);
    EXPECT_EQ(style_of("ground: #f2b632\nstroke: white\npaper: white\n").stroke_colour, deep_earth);
    EXPECT_EQ(style_of("ground: #1d2733\nstroke: white\npaper: white\n").stroke_colour,
              (Colour{0x1d, 0x27, 0x33, 255}));
}

/// Colours of light designs, and joints in the colour of their ground.
TEST(WhitePaper, KeepsColoursThatDoNotVanish) {
    EXPECT_EQ(style_of("ground: #f6f0e4\nstroke: #fbf8f1\npaper: white\n").stroke_colour,
              (Colour{0xfb, 0xf8, 0xf1, 255}));
    EXPECT_EQ(style_of("ground: #7d3324\nstroke: #f2b632\npaper: white\n").stroke_colour,
              (Colour{0xf2, 0xb6, 0x32, 255}));
    EXPECT_EQ(style_of("ground: #7d3324\nstroke: white\npaper: none\n").ground, earth);
}

TEST(WhitePaper, GivenColoursWin) {
    const std::string text = "ground: #7d3324\nstroke: white\n";
    EXPECT_EQ(style_of(text, {{"paper", "white"}, {"stroke", "0.5mm ivory"}}).stroke_colour,
              (Colour{0xff, 0xff, 0xf0, 255}));
    EXPECT_EQ(style_of(text + "paper: white\n", {{"ground", "navy"}}).ground, (Colour{0, 0, 0x80, 255}));
    EXPECT_EQ(style_of(text + "paper: white\n", {{"paper", "none"}, {"ground", "navy"}}).stroke_colour, white);
    EXPECT_THROW(style_of(text, {{"paper", "white"}, {"ground", "navy"}}), PatternError);
    EXPECT_THROW(style_of(text + "paper: cream\n"), PatternError);
    EXPECT_THROW(style_of(text + "paper:\n"), PatternError);
}

/// An SVG without page-wide fills but white, and without colours that vanish: no bundled pattern is reported.
TEST(WhitePaper, NoBundledPatternVanishes) {
    for (const LibraryPattern& pattern : PatternLibrary::bundled().patterns()) {
        const Document document = load(pattern.name);
        Diagnostics diagnostics;
        const Style before = read_style(document.pattern(), 96, diagnostics);
        const Style style = read_style(document.with({{"paper", "white"}}).pattern(), 96, diagnostics);
        EXPECT_EQ(style.ground, white) << pattern.name;
        ASSERT_EQ(style.palette.size(), before.palette.size());
        for (std::size_t i = 0; i < style.palette.size(); ++i) {
            const Colour was = before.palette[i], is = style.palette[i];
            const bool was_faint = before.ground && is_faint(was, *before.ground);
            EXPECT_TRUE(!is_faint(is, white) || was_faint) << pattern.name << " " << hex(is);
        }
    }
}

TEST(WhitePaper, HoldsForSheetsAndLessons) {
    const Document document = parse("kolam.lsys",
                                    "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\n"
                                    "stroke: 0.2 step #fffaf0\nground: #7d3324\n");
    MemoryDestination memory;
    plan_sheet({{document, {}}, {document, {}}}, "svg", {{"paper", "white"}})->make(memory, "sheet.svg", {}, 1);
    const std::string sheet = drawing_of(memory.take("sheet.svg"));
    EXPECT_FALSE(has(sheet, "#fffaf0"));
    EXPECT_FALSE(has(sheet, "fill=\"#7d3324\""));
    EXPECT_TRUE(has(sheet, "stroke=\"#7d3324\""));
    const std::string lesson = drawing_of(draw(document, "svg", {{"paper", "white"}, {"lesson", ""}}));
    EXPECT_FALSE(has(lesson, "#fffaf0"));
    EXPECT_EQ(warnings_of(remarks_about(prints(), document, "svg", {{"paper", "white"}, {"border", "padi"}})), "");
    EXPECT_THROW(plan_sheet({{document, {{"ground", "navy"}}}}, "svg", {{"paper", "white"}}), std::runtime_error);
}

/// Dots to practise on are drawn in the same ink.
TEST(WhitePaper, OnlyDotsHaveTheSameInk) {
    const Document document = parse("kolam.lsys",
                                    "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\n"
                                    "stroke: 0.2 step #fffaf0\nground: #7d3324\n");
    const auto drawn = [&](const OptionValues& values) { return drawing_of(draw(document, "svg", values)); };
    EXPECT_EQ(drawn({{"dots", "only"}}), drawn({{"dots", "only"}, {"paper", "white"}}));
}

}  // namespace sikku::white_paper_test
