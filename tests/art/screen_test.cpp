#include "art/print/screen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sikku::screen_test {

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

}  // namespace sikku::screen_test
