// tests/program/library_test.cpp: makes prints and scores in memory like a program that links the libraries.
#include "art/prints.h"
#include "art/sheets.h"
#include "music/scores.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

namespace sikku::library_test {

Document curve() {
    return parse("curve", "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 3\ndefine width = 2\n");
}

TEST(Library, DrawsAndPlaysInMemory) {
    const std::string svg = draw(curve(), "svg", {{"size", "A3"}, {"stroke", "0.3mm navy"}});
    EXPECT_TRUE(has(svg, "width=\"297mm\""));
    EXPECT_TRUE(has(svg, "#000080"));
    EXPECT_TRUE(play(curve(), "mid", {{"scale", "dorian"}, {"bars", "2"}}).starts_with("MThd"));
    EXPECT_TRUE(draw(curve(), "pdf", {{"derivation length", "2"}, {"width", "3"}}).starts_with("%PDF"));
}

TEST(Library, UnknownNamesAreSettingErrors) {
    EXPECT_EQ(error_of<SettingError>([] {
                  draw(curve(), "svg", {{"siz", "A3"}});
              }),
              "siz: unknown option or key; did you mean 'size'?");
    EXPECT_EQ(error_of<SettingError>([] {
                  draw(curve(), "svg", {{"widht", "2"}});
              }),
              "widht: unknown option or key; did you mean 'width'?");
    EXPECT_EQ(error_of<SettingError>([] {
                  play(curve(), "mid", {{"qqqqqqqq", "2"}});
              }),
              "qqqqqqqq: unknown option or key");
}

TEST(Library, AnErrorNamesTheOptionAndItsValueWhoeverCatchesIt) {
    const auto what = [](std::string_view format, const OptionValues& values) -> std::string {
        return error_of([&] { draw(curve(), format, values); }, "no error");
    };
    EXPECT_EQ(what("sgv", {}), "format sgv: unknown format");
    EXPECT_EQ(what("svg", {{"sise", "A3"}}), "sise: unknown option or key; did you mean 'size'?");
    EXPECT_TRUE(what("svg", {{"size", "3x"}}).starts_with("size 3x: ")) << what("svg", {{"size", "3x"}});
    EXPECT_TRUE(what("svg", {{"rotate", "left"}}).starts_with("rotate left: "));
    EXPECT_TRUE(what("gif", {}).starts_with("generations: required for a .gif"));
    // Settings of the pattern name the key, once.
    EXPECT_TRUE(what("svg", {{"n", "many"}}).starts_with("n many: ")) << what("svg", {{"n", "many"}});
}

TEST(Library, TheDerivationLengthHasItsNamesOfTheCommandLine) {
    const auto sheet = [](const SheetItem& item) {
        MemoryDestination memory;
        plan_sheet({item}, "svg", {})->make(memory, "sheet.svg", {});
        return memory.take("sheet.svg");
    };
    const Document two = curve().with({{"derivation length", "2"}});
    ASSERT_NE(draw(two, "svg"), draw(curve(), "svg"));
    for (const char* name : {"n", "steps", "derivation length"}) {
        EXPECT_EQ(draw(curve(), "svg", {{name, "2"}}), draw(two, "svg")) << name;
        EXPECT_EQ(play(curve(), "mid", {{name, "2"}}), play(two, "mid")) << name;
        EXPECT_EQ(sheet({curve(), {{name, "2"}}}), sheet({two, {}})) << name;
    }
    // Also if the pattern has a define of that name, which with() sets.
    const Document own = parse("own.lsys", "define n = 2\naxiom: F(n)\nF(x) --> F(x)F(x)\nderivation length: 1\n");
    EXPECT_EQ(own.with({{"n", "5"}}).grammar().steps(), 1U);
    EXPECT_EQ(draw(own, "svg", {{"n", "3"}}), draw(own.with({{"derivation length", "3"}}), "svg"));
}

TEST(Library, SeveralOutputsNeedADestination) {
    const OptionValues values = {{"step", "60mm"}, {"tile", "A4"}};
    EXPECT_THROW(draw(curve(), "svg", values), std::runtime_error);
    MemoryDestination memory;
    prints().plan(curve(), "svg", values)->make(memory, "wall.svg", {});
    EXPECT_GT(memory.outputs().size(), 1U);
    EXPECT_TRUE(memory.outputs().contains("wall-1-1.svg"));
}

TEST(Library, AMonitorStopsTheWork) {
    MemoryDestination memory;
    const Monitor stop([](void*) { return true; });
    EXPECT_THROW(prints().plan(curve(), "svg", {})->make(memory, "a.svg", stop), Stopped);
    EXPECT_TRUE(memory.outputs().empty());
}

}  // namespace sikku::library_test
