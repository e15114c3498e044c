#include "art/print/screen.h"

#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The share of white in a picture of one grey.
double share_of_white(const Screen& screen, std::uint8_t grey, double dpi = 600, int width = 420, int rows = 420) {
    Screener screener(screen, width, dpi);
    const Bytes greys(static_cast<std::size_t>(width), grey);
    Bytes row(greys.size());
    std::uint64_t white = 0;
    for (int y = 0; y < rows; ++y) {
        screener.row(greys, row);
        for (const std::uint8_t pixel : row) {
            EXPECT_TRUE(pixel == 0 || pixel == 255);
            white += pixel / 255;
        }
    }
    return static_cast<double>(white) / (static_cast<double>(width) * rows);
}

TEST(Screen, EveryGreyHasItsShareOfWhite) {
    for (const Screen& screen : {parse_screen("diffusion"), parse_screen("halftone"), parse_screen("halftone,60")}) {
        for (int grey = 0; grey <= 255; grey += 5) {
            const auto value = static_cast<std::uint8_t>(grey);
            EXPECT_NEAR(share_of_white(screen, value), grey / 255.0, 0.012) << grey;
        }
        EXPECT_EQ(share_of_white(screen, 0), 0);
        EXPECT_EQ(share_of_white(screen, 255), 1);
    }
    EXPECT_EQ(share_of_white({}, 127), 0);
    EXPECT_EQ(share_of_white({}, 128), 1);
}

TEST(Screen, LinesKeepTheirEdges) {
    for (const char* text : {"diffusion", "halftone,40"}) {
        Screener screener(parse_screen(text), 64, 600);
        Bytes greys(64, 100);
        for (std::size_t x = 20; x < 30; ++x) greys[x] = 0;
        for (std::size_t x = 30; x < 40; ++x) greys[x] = 255;
        Bytes row(64);
        for (int y = 0; y < 50; ++y) {
            screener.row(greys, row);
            for (std::size_t x = 20; x < 40; ++x) ASSERT_EQ(row[x], x < 30 ? 0 : 255) << text << y;
        }
    }
}

TEST(Screen, AHalftoneHasAsManyDotsAsWereAskedFor) {
    // Runs of black along a line at 45 degrees: the dots' rows.
    const Screen screen = parse_screen("halftone,53");
    Screener screener(screen, 600, 600);
    const Bytes greys(600, 200);
    Bytes row(600);
    int dots = 0;
    bool was_black = false;
    for (std::size_t y = 0; y < 600; ++y) {
        screener.row(greys, row);
        const bool is_black = row[y] == 0;
        dots += is_black && !was_black;
        was_black = is_black;
    }
    // One inch down and one across: the way is sqrt 2 inches long.
    EXPECT_NEAR(dots / std::sqrt(2.0), 53, 2);
}

TEST(Screen, BadOnesAreRefused) {
    for (const char* bad : {"", "dots", "halftone,", "halftone,0", "halftone,1001", "halftone,60,", "halftone 60",
                            "halftone,nan", "diffusion,3"}) {
        EXPECT_THROW(parse_screen(bad), std::runtime_error) << bad;
    }
    EXPECT_THROW(Screener(parse_screen("halftone,600"), 10, 600), std::runtime_error);
    EXPECT_THROW(Screener(parse_screen("halftone,1"), 10, 9600), std::runtime_error);
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
        EXPECT_TRUE(has(errors, "the picture looks empty")) << errors;
        EXPECT_TRUE(has(errors, "(stroke: 0.3mm)")) << errors;
        EXPECT_FALSE(has(errors, "window")) << errors;
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

}  // namespace
}  // namespace sikku
