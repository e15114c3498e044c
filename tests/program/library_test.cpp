// tests/program/library_test.cpp: makes prints and scores in memory like a program that links the libraries.
#include "art/prints.h"
#include "music/scores.h"

#include <gtest/gtest.h>

#include <functional>

namespace sikku {
namespace {

Document curve() {
    return parse("curve", "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 3\ndefine width = 2\n");
}

TEST(Library, DrawsAndPlaysInMemory) {
    const std::string svg = draw(curve(), "svg", {{"size", "A3"}, {"stroke", "0.3mm navy"}});
    EXPECT_NE(svg.find("width=\"297mm\""), std::string::npos);
    EXPECT_NE(svg.find("#000080"), std::string::npos);
    EXPECT_TRUE(play(curve(), "mid", {{"scale", "dorian"}, {"bars", "2"}}).starts_with("MThd"));
    EXPECT_TRUE(draw(curve(), "pdf", {{"derivation length", "2"}, {"width", "3"}}).starts_with("%PDF"));
}

TEST(Library, UnknownNamesAreSettingErrors) {
    const auto error = [](const std::function<void()>& work) {
        try {
            work();
        } catch (const SettingError& caught) {
            return caught.option() + ": " + caught.what();
        }
        return std::string("no error");
    };
    EXPECT_EQ(error([] {
                  draw(curve(), "svg", {{"siz", "A3"}});
              }),
              "siz: unknown option or key; did you mean 'size'?");
    EXPECT_EQ(error([] {
                  draw(curve(), "svg", {{"widht", "2"}});
              }),
              "widht: unknown option or key; did you mean 'width'?");
    EXPECT_EQ(error([] { play(curve(), "mid", {{"qqqqqqqq", "2"}}); }), "qqqqqqqq: unknown option or key");
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

}  // namespace
}  // namespace sikku
