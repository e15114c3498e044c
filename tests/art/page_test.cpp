#include "art/print/page.h"
#include "art/style/length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <random>
#include <stdexcept>
#include <string>

namespace sikku::page_test {

TEST(Length, HasUnits) {
    EXPECT_DOUBLE_EQ(parse_length("15mm", 300).value(), 15.0);
    EXPECT_DOUBLE_EQ(parse_length("1.5cm", 300).value(), 15.0);
    EXPECT_DOUBLE_EQ(parse_length("2in", 300).value(), 50.8);
    EXPECT_DOUBLE_EQ(parse_length("72pt", 300).value(), 25.4);
    EXPECT_DOUBLE_EQ(parse_length("300px", 300).value(), 25.4);
    EXPECT_DOUBLE_EQ(parse_length("300px", 150).value(), 50.8);
    EXPECT_DOUBLE_EQ(parse_length("7", 300).value(), 7.0);
    EXPECT_DOUBLE_EQ(parse_length(" 15 MM ", 300).value(), 15.0);
    EXPECT_DOUBLE_EQ(parse_length("+1e1mm", 300).value(), 10.0);
    EXPECT_DOUBLE_EQ(parse_length(".5mm", 300).value(), 0.5);
    EXPECT_DOUBLE_EQ(parse_length("-3mm", 300).value(), -3.0);
    EXPECT_DOUBLE_EQ(parse_length("0", 300).value(), 0.0);
}

TEST(Length, IsWhollyANumberAndAUnit) {
    for (const char* bad :
         {"",        " ",       "mm",  "15km", "15mmm", "1,5mm", "15 m m", "0x10", "inf",  "infmm", "nan",
          "1e400mm", "1e308in", "--3", "+-3",  "+",     "3/2",   "15mm 2", "١٥mm", "15\"", "1.5.2"}) {
        EXPECT_FALSE(parse_length(bad, 300)) << bad;
    }
    EXPECT_FALSE(parse_length("1px", 0.0));
}

TEST(Size, HasNamesInAnyCase) {
    EXPECT_EQ(parse_size("A4", 300), glm::dvec2(210, 297));
    EXPECT_EQ(parse_size("a0", 300), glm::dvec2(841, 1189));
    EXPECT_EQ(parse_size(" A6 ", 300), glm::dvec2(105, 148));
    EXPECT_EQ(parse_size("Letter", 300), glm::dvec2(215.9, 279.4));
    EXPECT_EQ(parse_size("LEGAL", 300), glm::dvec2(215.9, 355.6));
    EXPECT_EQ(parse_size("tabloid", 300), glm::dvec2(279.4, 431.8));
    // Each sheet of the A series is half of the one before, rounded down.
    for (int i = 0; i < 6; ++i) {
        const auto sheet = parse_size("A" + std::to_string(i), 300);
        const auto half = parse_size("A" + std::to_string(i + 1), 300);
        ASSERT_TRUE(sheet && half);
        EXPECT_EQ(half->x, std::floor(sheet->y / 2));
        EXPECT_EQ(half->y, sheet->x);
    }
}

/// Half of a sheet of a series has the proportions of the whole (ISO 216, 217 and 269, JIS P 0138), to a millimetre.
TEST(Size, HasSeries) {
    const std::vector<std::tuple<std::string, int, double>> series = {{"A", 10, 1e6},
                                                                      {"B", 10, std::sqrt(2) * 1e6},
                                                                      {"C", 10, std::sqrt(std::sqrt(2)) * 1e6},
                                                                      {"JIS B", 10, 1.5e6}};
    for (const auto& [name, last, area] : series) {
        for (int i = 0; i <= last; ++i) {
            const auto size = parse_size(name + std::to_string(i), 300);
            ASSERT_TRUE(size) << name << i;
            const double width = std::sqrt(area / std::sqrt(2)) / std::pow(2, i / 2.0);
            EXPECT_NEAR(size->x, width, 1.01) << name << i;
            EXPECT_NEAR(size->y, width * std::sqrt(2), 1.01) << name << i;
        }
        EXPECT_FALSE(parse_size(name + std::to_string(last + 1), 300));
    }
    for (const std::string name : {"RA", "SRA"}) {
        for (int i = 0; i < 4; ++i) {
            const auto sheet = parse_size(name + std::to_string(i), 300);
            const auto half = parse_size(name + std::to_string(i + 1), 300);
            ASSERT_TRUE(sheet && half);
            EXPECT_EQ(half->x, sheet->y / 2);
            EXPECT_EQ(half->y, sheet->x);
            // Larger than the trimmed sheet.
            EXPECT_GT(sheet->x, parse_size("A" + std::to_string(i), 300)->x);
        }
    }
    EXPECT_EQ(parse_size("sra3", 300), glm::dvec2(320, 450));
    EXPECT_EQ(parse_size("B2", 300), glm::dvec2(500, 707));
    EXPECT_EQ(parse_size("jis-b4", 300), glm::dvec2(257, 364));
    EXPECT_EQ(parse_size("2A0", 300), glm::dvec2(1189, 1682));
}

TEST(Size, HasInchSizes) {
    const auto size = [](const char* name) { return *parse_size(name, 300) / 25.4; };
    EXPECT_NEAR(size("ANSI C").x, 17, 1e-9);
    EXPECT_NEAR(size("ansi-e").y, 44, 1e-9);
    EXPECT_NEAR(size("Arch D").x, 24, 1e-9);
    EXPECT_NEAR(size("arch_e1").y, 42, 1e-9);
    EXPECT_NEAR(size("ledger").y, 17, 1e-9);
    EXPECT_EQ(size("ANSI A"), size("letter"));
    EXPECT_EQ(size("ANSI B"), size("tabloid"));
}

TEST(Size, HasMeasures) {
    EXPECT_EQ(parse_size("50x70cm", 300), glm::dvec2(500, 700));
    EXPECT_EQ(parse_size("50×70cm", 300), glm::dvec2(500, 700));
    EXPECT_NEAR(parse_size("20x30in", 300)->y, 762, 1e-9);
    EXPECT_EQ(parse_size("300x300mm", 300), glm::dvec2(300, 300));
    EXPECT_EQ(parse_size("300x200", 300), glm::dvec2(300, 200));
    EXPECT_EQ(parse_size("20cmx30cm", 300), glm::dvec2(200, 300));
    EXPECT_EQ(parse_size("20cmx300mm", 300), glm::dvec2(200, 300));
    EXPECT_EQ(parse_size("20 cm X 30 cm", 300), glm::dvec2(200, 300));
    const auto inches = parse_size("12x18in", 300);
    ASSERT_TRUE(inches);
    EXPECT_DOUBLE_EQ(inches->x, 12 * 25.4);
    EXPECT_DOUBLE_EQ(inches->y, 18 * 25.4);
    for (const char* pixels : {"300x600px", "300pxx600px", "300px x 600px"}) {
        const auto size = parse_size(pixels, 300);
        ASSERT_TRUE(size) << pixels;
        EXPECT_DOUBLE_EQ(size->x, 25.4);
        EXPECT_DOUBLE_EQ(size->y, 50.8);
    }
    // The range is the caller's matter.
    EXPECT_EQ(parse_size("0x-5", 300), glm::dvec2(0, -5));
}

TEST(Size, RefusesTheRest) {
    for (const char* bad : {"", "A11", "SRA5", "ANSI F", "A", "x", "300", "300x", "x300", "300x300x300", "300x300km",
                            "12inx18", "pxxpx", "A4x", "300*300", "1e400x1", "nanxnan"}) {
        EXPECT_FALSE(parse_size(bad, 300)) << bad;
    }
}

glm::dvec2 turned(const PlacementOptions& options, glm::dvec2 point) {
    return orientation(options) * glm::dvec3(point, 1.0);
}

TEST(Orientation, QuarterTurnsAreExact) {
    PlacementOptions options;
    const glm::dvec2 point(3.0, 1.0);
    const auto at = [&](double rotate, bool mirror) {
        options.rotate = rotate;
        options.mirror = mirror;
        return turned(options, point);
    };
    EXPECT_EQ(at(0, false), glm::dvec2(3, 1));
    EXPECT_EQ(at(90, false), glm::dvec2(-1, 3));  // anticlockwise
    EXPECT_EQ(at(180, false), glm::dvec2(-3, -1));
    EXPECT_EQ(at(270, false), glm::dvec2(1, -3));
    EXPECT_EQ(at(-90, false), glm::dvec2(1, -3));
    EXPECT_EQ(at(36090, false), glm::dvec2(-1, 3));
    EXPECT_EQ(at(0, true), glm::dvec2(-3, 1));
    EXPECT_EQ(at(90, true), glm::dvec2(-1, -3));  // mirrored first
    EXPECT_NEAR(at(45, false).x, 2 * std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(at(45, false).y, 4 * std::sqrt(0.5), 1e-15);
    options = {};
    for (int column = 0; column < 3; ++column) {
        EXPECT_FALSE(std::signbit(orientation(options)[column].x));
        EXPECT_FALSE(std::signbit(orientation(options)[column].y));
    }
}

/// The corners of a box on the page, widened by the pen.
Box inked(const Box& box, const Placement& placement, double ink_steps, double ink_mm) {
    Box result;
    const double ink = ink_steps * placement.step + ink_mm;
    for (const glm::dvec2 corner : {box.low, box.high}) {
        const glm::dvec2 at = placement.to_page * glm::dvec3(corner, 1.0);
        result.add(at - ink);
        result.add(at + ink);
    }
    return result;
}

TEST(Place, BoxAndPenTouchTheMargins) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-50.0, 50.0);
    std::uniform_real_distribution<double> small(0.0, 3.0);
    for (int i = 0; i < 1000; ++i) {
        Box box;
        box.add({number(random), number(random)});
        box.add({number(random), number(random)});
        const Page page{100.0 + 2.0 * number(random) / 3.0, 150.0 + number(random), 5.0};
        const double ink_steps = i % 2 ? small(random) : 0.0;
        const double ink_mm = i % 3 ? small(random) : 0.0;
        const Placement placement = place(box, page, {}, ink_steps, ink_mm);
        const Box ink = inked(box, placement, ink_steps, ink_mm);
        EXPECT_NEAR(ink.low.x + ink.high.x, page.width, 1e-9);
        EXPECT_NEAR(ink.low.y + ink.high.y, page.height, 1e-9);
        EXPECT_GE(ink.low.x, page.margin - 1e-9);
        EXPECT_GE(ink.low.y, page.margin - 1e-9);
        EXPECT_NEAR(std::min(ink.low.x, ink.low.y), page.margin, 1e-9);
    }
}

TEST(Place, YGoesDownAndTheStepIsAsAsked) {
    Box box;
    box.add({0.0, 0.0});
    box.add({4.0, 2.0});
    PlacementOptions options{.step = 5.0};
    options.scale = 0.5;  // of fitted drawings only
    const Placement placement = place(box, {210.0, 297.0, 10.0}, options, 0.1, 0.4);
    EXPECT_EQ(placement.step, 5.0);
    EXPECT_EQ(placement.to_page * glm::dvec3(0, 0, 1), glm::dvec2(95.0, 153.5));
    EXPECT_EQ(placement.to_page * glm::dvec3(4, 2, 1), glm::dvec2(115.0, 143.5));
    options.step.reset();
    EXPECT_DOUBLE_EQ(place(box, {210.0, 297.0, 5.0}, options, 0.0, 0.0).step, 25.0);
}

TEST(Place, TakesPatternUnitsAndABoxAlreadyTurned) {
    PlacementOptions options{.rotate = 90.0, .mirror = true, .step = 1.0};
    Box box;
    box.add(turned(options, {0.0, 0.0}));
    box.add(turned(options, {10.0, 4.0}));
    const Placement placement = place(box, {20.0, 20.0, 0.0}, options, 0.0, 0.0);
    // (0, 0) is the upper right corner of the drawing, 4 wide and 10 high; x points down, y to the left.
    EXPECT_EQ(placement.to_page * glm::dvec3(0, 0, 1), glm::dvec2(12, 5));
    EXPECT_EQ(placement.to_page * glm::dvec3(10, 0, 1), glm::dvec2(12, 15));
    EXPECT_EQ(placement.to_page * glm::dvec3(0, 4, 1), glm::dvec2(8, 5));
}

TEST(Place, DrawingsWithoutExtent) {
    const Page page{100.0, 60.0, 5.0};
    Box box;
    EXPECT_EQ(place(box, page, {}, 0.0, 0.0).step, 10.0);
    box.add({7.0, -3.0});
    const Placement dot = place(box, page, {}, 0.2, 0.0);
    EXPECT_EQ(dot.step, 10.0);
    EXPECT_EQ(dot.to_page * glm::dvec3(7, -3, 1), glm::dvec2(50, 30));
    // A level line is as wide as the page lets it.
    box.add({17.0, -3.0});
    EXPECT_DOUBLE_EQ(place(box, page, {}, 0.0, 0.0).step, 9.0);
    EXPECT_DOUBLE_EQ(place(box, page, {}, 0.0, 1.0).step, 8.8);
}

TEST(Place, HugeDrawingsFitToo) {
    Box box;
    box.add({-1e18, 0.0});
    box.add({1e18, 1e18});
    const Placement placement = place(box, {210.0, 297.0, 10.0}, {}, 0.0, 0.2);
    EXPECT_NEAR((placement.to_page * glm::dvec3(1e18, 0, 1)).x, 199.8, 1e-9);
}

TEST(Place, APenWiderThanThePageIsAnError) {
    Box box;
    box.add({0.0, 0.0});
    box.add({1.0, 0.0});
    EXPECT_THROW(place(box, {100.0, 60.0, 5.0}, {}, 0.0, 45.0), std::runtime_error);
    EXPECT_THROW(place(box, {100.0, 60.0, 5.0}, {}, 0.0, 26.0), std::runtime_error);
    EXPECT_THROW(place(box, {100.0, 60.0, 50.0}, {}, 0.0, 0.0), std::runtime_error);
    EXPECT_THROW(place(box, {100.0, 60.0, 31.0}, {}, 0.0, 0.0), std::runtime_error);
    EXPECT_NO_THROW(place(box, {100.0, 60.0, 5.0}, {}, 0.0, 24.0));
    PlacementOptions options{.step = 1.0};
    EXPECT_NO_THROW(place(box, {100.0, 60.0, 5.0}, options, 0.0, 450.0));
}

}  // namespace sikku::page_test
