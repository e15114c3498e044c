// Words in dots: the topology of letters, their sizes, and bad input.
#include "art/kolam/dot_grid_text.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// The dots of a grid as text, a row of blanks around them.
std::vector<std::string> picture_of(const DotGrid& grid) {
    std::int32_t left = 1 << 30, right = -left, bottom = left, top = right;
    for (const GridDot dot : grid.dots()) {
        left = std::min(left, dot.x), right = std::max(right, dot.x);
        bottom = std::min(bottom, dot.y), top = std::max(top, dot.y);
    }
    const auto width = static_cast<std::size_t>((right - left) / 2 + 3),
               height = static_cast<std::size_t>((top - bottom) / 2 + 3);
    std::vector<std::string> picture(height, std::string(width, ' '));
    for (const GridDot dot : grid.dots()) {
        picture[static_cast<std::size_t>((top - dot.y) / 2 + 1)][static_cast<std::size_t>((dot.x - left) / 2 + 1)] =
            'o';
    }
    return picture;
}

/// Number of regions of a character. @param diagonal  whether places that touch in a corner are neighbours
std::size_t regions(std::vector<std::string> picture, char wanted, bool diagonal) {
    std::size_t count = 0;
    for (std::size_t row = 0; row < picture.size(); ++row) {
        for (std::size_t column = 0; column < picture[row].size(); ++column) {
            if (picture[row][column] != wanted) continue;
            ++count;
            std::vector<std::pair<std::size_t, std::size_t>> stack = {{row, column}};
            while (!stack.empty()) {
                const auto [y, x] = stack.back();
                stack.pop_back();
                if (y >= picture.size() || x >= picture[y].size() || picture[y][x] != wanted) continue;
                picture[y][x] = 'x';
                for (const std::size_t dy : {y - 1, y, y + 1}) {
                    for (const std::size_t dx : {x - 1, x, x + 1}) {
                        if (diagonal || dy == y || dx == x) stack.emplace_back(dy, dx);
                    }
                }
            }
        }
    }
    return count;
}

TEST(DotGridText, LettersHaveTheirCountersAndParts) {
    constexpr std::string_view one = "ADOPQRabdegopq0469", two = "B8", parted = "ij";
    for (const char letter : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789")) {
        const DotGrid grid = text_grid(std::string(1, letter));
        const std::size_t counters = two.find(letter) != two.npos ? 2 : one.find(letter) != one.npos ? 1 : 0;
        EXPECT_EQ(regions(picture_of(grid), ' ', false), 1 + counters) << letter;
        EXPECT_EQ(regions(picture_of(grid), 'o', true), parted.find(letter) != parted.npos ? 2u : 1u) << letter;
        // Lines connect only neighbours in rows and columns.
        EXPECT_EQ(grid.groups(), parted.find(letter) != parted.npos ? 2u : 1u) << letter;
    }
}

TEST(DotGridText, BarsAreOfOneThickness) {
    EXPECT_EQ(text_grid("L", 6).text(), "o/o/o/o/o/oooo");
    const std::string stem = "oo/", foot = "oooooooo";
    std::string expected;
    for (int row = 0; row < 10; ++row) expected += stem;
    EXPECT_EQ(text_grid("L").text(), expected + foot + "/" + foot);
    for (const std::uint32_t rows : {5u, 8u, 12u, 17u, 30u, 200u}) {
        for (const char* letter : {"H", "E", "M", "Z", "T"}) {
            EXPECT_EQ(picture_of(text_grid(letter, rows)).size(), rows + 2) << letter << rows;
        }
    }
    // The stems of H are as thick as its bar, at any height.
    for (const std::uint32_t rows : {12u, 18u, 24u}) {
        const std::vector<std::string> picture = picture_of(text_grid("H", rows));
        // Bars end round.
        EXPECT_EQ(picture[4].find(' ', 1) - 1, rows / 6);
        const auto is_bar = [](const std::string& row) { return std::count(row.begin(), row.end(), ' ') == 2; };
        EXPECT_EQ(std::count_if(picture.begin(), picture.end(), is_bar), rows / 6);
    }
}

TEST(DotGridText, WordsLinesAndOtherScripts) {
    // Letters and lines never touch.
    EXPECT_EQ(text_grid("HELL").groups(), 4u);
    EXPECT_EQ(text_grid("LL/LL\nLL").groups(), 6u);
    EXPECT_EQ(text_grid("L L").dots().size(), text_grid("LL").dots().size());
    EXPECT_GT(picture_of(text_grid("L L"))[1].size(), picture_of(text_grid("LL"))[1].size());
    // A syllable of Tamil is a letter: its vowel sign stands where it is written.
    EXPECT_EQ(text_grid("தமிழ்").groups(), 4u);
    EXPECT_EQ(parse_dot_grid("text:É").groups(), 2u);
    EXPECT_EQ(parse_dot_grid("TEXT 18 : L").dots(), text_grid("L", 18).dots());
    EXPECT_EQ(dot_grid_title("text: MEERA/RAVI "), "MEERA RAVI");
    EXPECT_EQ(dot_grid_title("7x7"), "");
}

TEST(DotGridText, BadInput) {
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("text:日本"); }), "the lettering font lacks 日 (U+65E5), 本"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("text:"); }), "the text has no letters"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("text: /\n"); }), "the text has no letters"));
    for (const char* rows : {"4", "201", "-1", "9x", "99999999999999999999"}) {
        EXPECT_TRUE(
            has(error_of([&] { parse_dot_grid(std::string("text ") + rows + ":A"); }), "rows of dots from 5 to 200"))
            << rows;
    }
    EXPECT_TRUE(has(error_of([] { text_grid("\xff"); }), "the byte 0xff"));
    std::string many;
    for (int i = 0; i < 10'000; ++i) many += static_cast<char>('A' + i % 26);
    EXPECT_GT(text_grid(many).dots().size(), 400'000u);
    EXPECT_TRUE(has(error_of([&] { text_grid(many, 100); }), "more than 4000000 dots"));
    const std::string blanks(60'000, ' ');
    std::string far = "I" + blanks + "I";
    for (int i = 0; i < 30'000; ++i) far += "/.";
    EXPECT_TRUE(has(error_of([&] { text_grid(far, 5); }), "too far apart"));
    EXPECT_TRUE(has(error_of([&] { text_grid("I" + std::string(3'000'000, ' ') + "I", 200); }),
                    "a line of the text is too long"));
    EXPECT_TRUE(has(error_of([&] { text_grid(std::string(5'000'000, 'I')); }), "the text is too long"));
    EXPECT_EQ(parse_dot_grid(" text:L").dots(), text_grid("L").dots());
}

}  // namespace
}  // namespace sikku
