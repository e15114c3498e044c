#include "art/style/style.h"

#include "engine/base/keys.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace sikku::style_test {

struct Read {
    Style style;
    std::vector<Diagnostic> errors;
};
Read read(const std::string& text) {
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
    EXPECT_TRUE(diagnostics.list().empty());
    const Style style = read_style(pattern, 300.0, diagnostics);
    return {style, diagnostics.list()};
}

TEST(Colour, IsReadAsCssWritesIt) {
    EXPECT_EQ(parse_colour("#f80"), (Colour{0xff, 0x88, 0x00, 255}));
    EXPECT_EQ(parse_colour("#F80a"), (Colour{0xff, 0x88, 0x00, 0xaa}));
    EXPECT_EQ(parse_colour("#12aBfE"), (Colour{0x12, 0xab, 0xfe, 255}));
    EXPECT_EQ(parse_colour("#12abfe07"), (Colour{0x12, 0xab, 0xfe, 7}));
    EXPECT_EQ(parse_colour("White"), (Colour{255, 255, 255, 255}));
    EXPECT_EQ(parse_colour("lightGoldenRodYellow"), (Colour{0xfa, 0xfa, 0xd2, 255}));
    EXPECT_EQ(parse_colour("rebeccapurple"), (Colour{0x66, 0x33, 0x99, 255}));
    EXPECT_EQ(parse_colour("transparent"), (Colour{0, 0, 0, 0}));
    for (const char* bad : {"", "#", "#f", "#ff", "#fffff", "#fffffff", "#fffffffff", "#ggg", "#ff ", "whit", "none",
                            "white ", " white", "rgb(1,2,3)", "ffffff"}) {
        EXPECT_FALSE(parse_colour(bad)) << bad;
    }
}

TEST(Colour, EveryNameIsKnownAndNamesItself) {
    EXPECT_EQ(colour_names().size(), 149u);  // 148 and transparent
    for (const std::string_view name : colour_names()) {
        const auto colour = parse_colour(name);
        ASSERT_TRUE(colour) << name;
        EXPECT_EQ(hex(parse_colour(colour_name(*colour)).value()), hex(*colour)) << name;
    }
    EXPECT_EQ(colour_name({0, 255, 255, 255}), "cyan");
    EXPECT_EQ(colour_name({255, 0, 255, 3}), "magenta");
    EXPECT_EQ(colour_name({128, 128, 128, 255}), "gray");
    EXPECT_EQ(colour_name({1, 2, 0xab, 255}), "#0102ab");
}

TEST(Style, HasDefaults) {
    const auto [style, errors] = read("axiom: F\n");
    EXPECT_TRUE(errors.empty());
    EXPECT_EQ(style.line, Line::straight);
    EXPECT_TRUE(style.stroked);
    EXPECT_EQ(style.stroke.value, 0.4);
    EXPECT_FALSE(style.stroke.in_steps);
    EXPECT_EQ(style.line_colour({}), (Colour{0, 0, 0, 255}));
    EXPECT_EQ(style.fill_colour({}), (Colour{0, 0, 0, 255}));
    EXPECT_EQ(style.ground, (Colour{255, 255, 255, 255}));
    EXPECT_EQ(style.palette.size(), 8u);
}

TEST(Style, StrokeIsAWidthAndAColourInEitherOrder) {
    struct Case {
        std::string value;
        double width;
        bool in_steps;
        std::optional<Colour> colour;
    };
    const Colour white{255, 255, 255, 255};
    for (const Case& expected :
         {Case{"0.4mm #fff", 0.4, false, white}, Case{"#fff 0.4mm", 0.4, false, white},
          Case{"0.2 step white", 0.2, true, white}, Case{"white 0.2step", 0.2, true, white},
          Case{"White", 0.4, false, white}, Case{"0.3 steps", 0.3, true, {}}, Case{"0.3 STEPS", 0.3, true, {}},
          Case{"1.5", 1.5, false, {}}, Case{"1.5 white", 1.5, false, white}, Case{".5 mm", 0.5, false, {}},
          Case{"+1e-1cm", 1.0, false, {}}, Case{"72pt", 25.4, false, {}}, Case{"3px", 0.254, false, {}},
          Case{"999.9", 999.9, false, {}}, Case{"0.4mm /* thin */ #fff", 0.4, false, white}}) {
        const auto [style, errors] = read("stroke: " + expected.value + "\n");
        EXPECT_TRUE(errors.empty()) << expected.value;
        EXPECT_DOUBLE_EQ(style.stroke.value, expected.width) << expected.value;
        EXPECT_EQ(style.stroke.in_steps, expected.in_steps) << expected.value;
        EXPECT_EQ(style.stroke_colour, expected.colour) << expected.value;
        EXPECT_TRUE(style.stroked);
    }
    EXPECT_FALSE(read("stroke: None\n").style.stroked);
}

TEST(Style, TheOtherKeys) {
    const auto [style, errors] =
        read("LINE: Spline\nground: #8b1a1a\nfill: gold\npalette: red, #00f8 ,green\tblue,\n");
    EXPECT_TRUE(errors.empty());
    EXPECT_EQ(style.line, Line::spline);
    EXPECT_TRUE(style.moves_draw());
    EXPECT_EQ(style.ground, (Colour{0x8b, 0x1a, 0x1a, 255}));
    EXPECT_EQ(style.fill, (Colour{255, 215, 0, 255}));
    EXPECT_EQ(style.palette,
              (std::vector<Colour>{{255, 0, 0, 255}, {0, 0, 255, 0x88}, {0, 128, 0, 255}, {0, 0, 255, 255}}));
    EXPECT_FALSE(read("ground: none\n").style.ground);
    EXPECT_FALSE(read("ground: transparent\n").style.ground);
    EXPECT_EQ(read("ground: #fff8\n").style.ground, (Colour{255, 255, 255, 0x88}));
    EXPECT_EQ(read("fill: none\n").style.fill.value().alpha, 0);
}

TEST(Style, IndicesWrapAndZeroHasColoursOfItsOwn) {
    const Style style = read("stroke: white\nfill: gold\npalette: red green blue\n").style;
    for (const auto& [colour, index] : {std::pair{0, 0},
                                        {1, 1},
                                        {2, 2},
                                        {3, 0},
                                        {7, 1},
                                        {-1, 2},
                                        {-3, 0},
                                        {-4, 2},
                                        {std::numeric_limits<int>::max(), 1},
                                        {std::numeric_limits<int>::min(), 1}}) {
        const Pen pen{1.0, false, colour};
        EXPECT_EQ(style.index(pen), index) << colour;
        EXPECT_EQ(colour_name(style.line_colour(pen)), index == 0 ? "white" : index == 1 ? "green" : "blue");
        EXPECT_EQ(colour_name(style.fill_colour(pen)), index == 0 ? "gold" : index == 1 ? "green" : "blue");
    }
    EXPECT_EQ(colour_name(read("palette: red green\n").style.line_colour({})), "red");
    // With a palette of the file a fill is the palette's, without one it follows the stroke.
    EXPECT_EQ(colour_name(read("stroke: white\npalette: red green\n").style.fill_colour({})), "red");
    EXPECT_EQ(colour_name(read("stroke: white\n").style.fill_colour({})), "white");
    EXPECT_EQ(Style{}.index({}), 0);
    EXPECT_EQ(Style{}.line_colour({}), (Colour{0, 0, 0, 255}));
}

TEST(Style, IndicesOfOneColourAreOneSlot) {
    const Style style = read("stroke: blue\nfill: red\npalette: white red blue red #f008\n").style;
    EXPECT_EQ(style.line_slots(), (std::vector<int>{0, 1, 0, 1, 4}));
    EXPECT_EQ(style.fill_slots(), (std::vector<int>{0, 0, 2, 0, 4}));
}

TEST(Style, WidthsAreFactorsOrSet) {
    Style style = read("stroke: 0.2 step\n").style;
    EXPECT_DOUBLE_EQ(style.line_width({}, 10.0), 2.0);
    EXPECT_DOUBLE_EQ(style.line_width({1.25, false, 0}, 10.0), 2.5);
    EXPECT_DOUBLE_EQ(style.line_width({0.5, true, 0}, 10.0), 5.0);
    style.stroke = {0.4, false};
    EXPECT_DOUBLE_EQ(style.line_width({}, 10.0), 0.4);
    EXPECT_DOUBLE_EQ(style.line_width({2.0, false, 0}, 10.0), 0.8);
    EXPECT_DOUBLE_EQ(style.line_width({0.7, true, 0}, 10.0), 0.7);
    EXPECT_EQ(style.line_width({-1.0, true, 0}, 10.0), 0.0);
    EXPECT_EQ(style.line_width({std::nan(""), true, 0}, 10.0), 0.0);
    EXPECT_TRUE(std::isfinite(style.line_width({HUGE_VAL, false, 0}, 10.0)));
}

TEST(Style, AWidthThatIsSetIsInTheUnitOfTheStroke) {
    const auto width_of_two = [](const std::string& stroke) {
        return read("stroke: " + stroke + "\n").style.line_width({2.0, true, 0}, 10.0);
    };
    EXPECT_DOUBLE_EQ(width_of_two("1pt"), 2 * 25.4 / 72);
    EXPECT_DOUBLE_EQ(width_of_two("0.7 PT white"), 2 * 25.4 / 72);
    EXPECT_DOUBLE_EQ(width_of_two("3px"), 2 * 25.4 / 300);
    EXPECT_DOUBLE_EQ(width_of_two("0.1cm"), 20);
    EXPECT_DOUBLE_EQ(width_of_two("0.1in"), 2 * 25.4);
    EXPECT_DOUBLE_EQ(width_of_two("0.1mm"), 2);
    EXPECT_DOUBLE_EQ(width_of_two("0.1"), 2);
    EXPECT_DOUBLE_EQ(width_of_two("white"), 2);
    EXPECT_DOUBLE_EQ(width_of_two("0.1 step"), 20);
    EXPECT_DOUBLE_EQ(Style{}.line_width({2.0, true, 0}, 10.0), 2);
}

/// One bad value: where it is and a piece of what is said.
struct Bad {
    std::string text;
    int column;
    std::string message;
};

class BadStyle : public ::testing::TestWithParam<Bad> {};

TEST_P(BadStyle, IsReportedAtItsPlace) {
    const auto [style, errors] = read("axiom: F\n" + GetParam().text + "\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].where, (Place{2, GetParam().column})) << errors[0].text();
    EXPECT_TRUE(has(errors[0].message, GetParam().message)) << errors[0].text();
    EXPECT_FALSE(errors[0].warning);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadStyle,
    ::testing::Values(
        Bad{"line:", 1, "'line:' is empty: expected 'straight', 'spline' or 'spline with lifts'"},
        Bad{"line: splines", 7, "did you mean 'spline'?"},
        Bad{"line: 17", 7, "expected 'straight', 'spline' or 'spline with lifts'"},
        Bad{"line: spline straight", 14, "unexpected 'straight'"}, Bad{"stroke:", 1, "'stroke:' is empty"},
        Bad{"stroke: 0.4mm whit", 15, "did you mean 'white'?"}, Bad{"stroke: #ff", 9, "3, 4, 6 or 8"},
        Bad{"stroke: 0.4mm #fffff", 15, "3, 4, 6 or 8"}, Bad{"stroke: qqqqqqqqqqqqqqqq", 9, "expected a width"},
        Bad{"stroke: rgb(1, 2, 3)", 9, "write #rrggbb or a CSS name"},
        Bad{"stroke: 0.4km", 12, "expected mm, cm, in"}, Bad{"stroke: 0.4mmwhite", 12, "expected mm, cm, in"},
        Bad{"stroke: 1,5mm", 10, "',5mm' is not a unit"}, Bad{"stroke: 0x10mm", 10, "'x10mm' is not a unit"},
        Bad{"stroke: 3/2 white", 10, "'/2' is not a unit"}, Bad{"stroke: 0mm", 9, "cannot be seen"},
        Bad{"stroke: white 0 step", 15, "cannot be seen"}, Bad{"stroke: -1mm", 9, "above 0"},
        Bad{"stroke: 1000mm", 9, "narrower than 1000 mm"}, Bad{"stroke: 1e999 step", 9, "narrower than 1000"},
        Bad{"stroke: 1e300cm", 9, "narrower than 1000"}, Bad{"stroke: 1e308in", 9, "narrower than 1000"},
        Bad{"stroke: 1000 steps", 9, "narrower than 1000 steps"}, Bad{"stroke: 1mm 2mm", 13, "second width"},
        Bad{"stroke: red blue", 13, "unexpected 'blue'"}, Bad{"stroke: none white", 14, "must stand alone"},
        Bad{"stroke: 1mm none", 13, "must stand alone"}, Bad{"stroke: inf", 9, "'inf' is not a colour"},
        Bad{"stroke: nanmm", 9, "is not a colour"},
        Bad{"ground:", 1, "'ground:' is empty: expected a colour, red-earth, cow-dung, slate, concrete or none"},
        Bad{"ground: earth", 9, "is not a colour"}, Bad{"ground: red green", 13, "unexpected 'green'"},
        Bad{"fill:", 1, "'fill:' is empty"}, Bad{"fill: goldd", 7, "did you mean 'gold'?"},
        Bad{"fill: #12345g", 7, "3, 4, 6 or 8"}, Bad{"palette:", 1, "'palette:' is empty"},
        Bad{"palette: , ,", 10, "'palette:' is empty"}, Bad{"palette: red, gren blue", 15, "did you mean 'green'?"},
        Bad{"palette: none", 10, "is not a colour"}, Bad{"palette: red கோலம்", 14, "'கோலம்' is not a colour"}));

TEST(Style, AllMistakesAreReportedAtOnceAndNoneTwice) {
    const auto [style, errors] = read("line: curly\nstroke: -1mm rad\nground: #1\nfill: 7\npalette: a b c\n");
    EXPECT_EQ(errors.size(), 8u);
}

TEST(Style, EndlessNonsenseIsCutShort) {
    std::string palette = "palette:";
    for (int i = 0; i < 100'000; ++i) palette += " nonsense";
    EXPECT_EQ(read(palette + "\n").errors.size(), 20u);
    palette = "palette:";
    for (int i = 0; i < 4096; ++i) palette += " red";
    EXPECT_TRUE(read(palette + "\n").errors.empty());
    EXPECT_EQ(read(palette + " red blue\n").errors.size(), 1u);
    const auto long_word = read("ground: " + std::string(100'000, 'x') + "\n").errors;
    ASSERT_EQ(long_word.size(), 1u);
    EXPECT_LT(long_word[0].message.size(), 200u);
}

TEST(Style, SplinesMayLiftThePenWhereTheTurtleMoves) {
    const auto [plain, no_errors] = read("axiom: F\nline: spline\n");
    EXPECT_TRUE(no_errors.empty());
    EXPECT_TRUE(plain.moves_draw());
    const auto [lifted, none] = read("axiom: F\nline: Spline  with lifts\n");
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(lifted.line, Line::spline);
    EXPECT_TRUE(lifted.moves_lift);
    EXPECT_FALSE(lifted.moves_draw());
    EXPECT_FALSE(read("axiom: F\n").style.moves_draw());
    for (const char* bad : {"spline with", "spline lifts", "spline with lifts too", "straight with lifts"}) {
        const auto [style, errors] = read(std::string("axiom: F\nline: ") + bad + "\n");
        ASSERT_EQ(errors.size(), 1u) << bad;
        EXPECT_TRUE(has(errors[0].message, "'spline with lifts'"));
    }
}

TEST(Style, ReadsFields) {
    EXPECT_FALSE(read("axiom: F\n").style.fields);
    EXPECT_FALSE(read("axiom: F\nfields: none\n").style.fields);
    EXPECT_EQ(read("axiom: F\nfields: Chessboard\n").style.fields, FieldsBy::chessboard);
    EXPECT_EQ(read("axiom: F\nfields: by kind\n").style.fields, FieldsBy::kind);
    EXPECT_EQ(read("axiom: F\nfields: distance\n").style.fields, FieldsBy::distance);
    EXPECT_EQ(read("axiom: F\nfields: by centre\n").style.fields, FieldsBy::centre);
    EXPECT_EQ(read("axiom: F\nfields: by strand\n").style.fields, FieldsBy::strand);
    EXPECT_EQ(read("axiom: F\nfields: by symmetry\n").style.fields, FieldsBy::symmetry);
    for (const auto& [bad, essence] :
         {std::pair("", "chessboard"), std::pair("by", "chessboard"), std::pair("by kinds", "did you mean 'kind'"),
          std::pair("red", "by distance"), std::pair("kind red", "unexpected 'red'")}) {
        const auto [style, errors] = read(std::string("axiom: F\nfields: ") + bad + "\n");
        ASSERT_EQ(errors.size(), 1u) << bad;
        EXPECT_TRUE(has(errors[0].message, essence));
    }
}

TEST(Style, ReadsPowders) {
    const Style named = read("axiom: F\npowders: Lotus\n").style;
    EXPECT_TRUE(named.powders_are_named);
    EXPECT_EQ(named.powders, find_powders("lotus"));
    const Style own = read("axiom: F\npowders: red, none #123\n").style;
    EXPECT_FALSE(own.powders_are_named);
    ASSERT_EQ(own.powders.size(), 3u);
    EXPECT_EQ(own.powders[1].alpha, 0);
    EXPECT_EQ(read("axiom: F\npalette: peacock\n").style.palette, find_powders("peacock"));
    for (const auto& [bad, essence] : {std::pair("", "is empty"), std::pair("lotos", "did you mean 'lotus'"),
                                       std::pair("red lotus", "did you mean"), std::pair("#12", "hexadecimal")}) {
        const auto [style, errors] = read(std::string("axiom: F\npowders: ") + bad + "\n");
        ASSERT_EQ(errors.size(), 1u) << bad;
        EXPECT_TRUE(has(errors[0].message, essence));
    }
}

TEST(Style, SetsOfPowdersAreListedAndTellApart) {
    const std::string listed(find_language_key("powders")->values);
    for (const std::string_view name : powder_names()) {
        EXPECT_TRUE(has(listed, name)) << name;
        const auto colours = *find_powders(name);
        EXPECT_GE(colours.size(), 6u);
        for (std::size_t i = 0; i < colours.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                EXPECT_GE(colour_distance(colours[i], colours[k]), 0.06) << name << ' ' << i << ' ' << k;
            }
        }
    }
    EXPECT_FALSE(find_powders("chalk"));
}

TEST(Style, ReadsWeaveAndParallelLines) {
    EXPECT_FALSE(read("axiom: F\n").style.weave);
    EXPECT_FALSE(read("axiom: F\nweave: none\n").style.weave);
    EXPECT_GT(read("axiom: F\nweave: yes\n").style.weave, 0.2);
    EXPECT_EQ(read("axiom: F\nweave: 0\n").style.weave, 0);
    EXPECT_EQ(read("axiom: F\nweave: 1.25\n").style.weave, 1.25);
    EXPECT_EQ(read("axiom: F\n").style.parallel.count, 1);
    EXPECT_EQ(read("axiom: F\nparallel: 3\n").style.parallel.count, 3);
    EXPECT_EQ(read("axiom: F\nparallel: 4 2.5\n").style.parallel.spacing, 2.5);
    for (const char* bad :
         {"weave: ", "weave: maybe", "weave: -1", "weave: 6", "weave: 1 2", "parallel: ", "parallel: 0",
          "parallel: 10", "parallel: 2.5", "parallel: 2 0.5", "parallel: 2 3 4", "parallel: two"}) {
        EXPECT_EQ(read(std::string("axiom: F\n") + bad + "\n").errors.size(), 1u) << bad;
    }
}

}  // namespace sikku::style_test
