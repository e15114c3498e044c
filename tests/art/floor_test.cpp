// tests/art/floor_test.cpp: floors as grounds: their colours, their place, and what lies on them.
#include "art/raster/floor.h"
#include "art/drawing/drawing.h"
#include "art/prints.h"
#include "art/raster/raster.h"
#include "art/style/contrast.h"
#include "art/writer/draw_options.h"
#include "art/writer/make_drawing.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/print_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace sikku::floor_test {

using Bytes = std::vector<std::uint8_t>;

/// A part of a floor. @param pixel  in millimetres
Bytes painted(Floor floor, double pixel, glm::dvec2 corner, int width, int height) {
    const FloorPaint paint(floor, pixel, corner);
    Bytes bytes(static_cast<std::size_t>(3 * width * height));
    for (int row = 0; row < height; ++row) {
        paint.paint(bytes.data() + static_cast<std::ptrdiff_t>(3 * width) * row, row, width, 3);
    }
    return bytes;
}

std::array<double, 3> mean_of(const Bytes& bytes) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < bytes.size(); ++i) sum[i % 3] += bytes[i];
    for (double& channel : sum) channel /= static_cast<double>(bytes.size() / 3);
    return sum;
}

std::vector<Floor> all_floors() {
    std::vector<Floor> floors;
    for (const std::string_view name : floor_names()) floors.push_back(*find_floor(name));
    return floors;
}

Print print_of(const Document& document, double width, double height, double dpi) {
    Print print;
    print.page = {width, height, 5};
    Diagnostics diagnostics;
    print.style = read_style(document.pattern(), 96, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    print.dpi = dpi;
    return print;
}

Bytes pixels(Rendering& rendering, int threads = 1) {
    Bytes bytes;
    rendering.render(threads, [&](int, int, std::span<const std::uint8_t> rows) {
        bytes.insert(bytes.end(), rows.begin(), rows.end());
    });
    return bytes;
}

std::unique_ptr<Drawing> placed(const Document& document, Print& print) {
    DrawOptions options;
    options.format = PrintFormat::png;
    auto drawing = make_drawing(document.grammar(), print.style, options);
    drawing->place(print);
    print.style = drawing->style();
    return drawing;
}

/// Over a square metre, which repeats, at any resolution.
TEST(Floor, HasItsMeanColour) {
    for (const Floor floor : all_floors()) {
        const Colour mean = mean_colour(floor);
        for (const double pixel : {0.25, 1.0, 4.0}) {
            const int side = static_cast<int>(1024 / pixel);
            const auto found = mean_of(painted(floor, pixel, {-37.5, 11}, side, side));
            EXPECT_NEAR(found[0], mean.red, 1) << static_cast<int>(floor) << ' ' << pixel;
            EXPECT_NEAR(found[1], mean.green, 1) << static_cast<int>(floor) << ' ' << pixel;
            EXPECT_NEAR(found[2], mean.blue, 1) << static_cast<int>(floor) << ' ' << pixel;
        }
    }
}

/// A texture, but one on which flour stands out everywhere.
TEST(Floor, HasGrainAndLetsFlourStandOut) {
    for (const Floor floor : all_floors()) {
        const Bytes bytes = painted(floor, 25.4 / 300, {0, 0}, 1200, 1200);
        std::set<std::uint8_t> greens;
        double nearest = 1e9;
        for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
            greens.insert(bytes[i + 1]);
            if (i % 21 > 0) continue;
            const Colour colour{bytes[i], bytes[i + 1], bytes[i + 2], 255};
            nearest = std::min(nearest, colour_difference(colour, {0xff, 0xfd, 0xf5, 255}));
        }
        EXPECT_GT(greens.size(), 40U);
        EXPECT_GT(nearest, 15);
    }
}

/// The colour depends only on the place: pictures that begin elsewhere show the same, also where pixels lie between
/// those of the other.
TEST(Floor, StaysInItsPlace) {
    for (const Floor floor : all_floors()) {
        const double pixel = 25.4 / 150;
        const Bytes whole = painted(floor, pixel, {0, 0}, 300, 200);
        const Bytes part = painted(floor, pixel, glm::dvec2(100, 50) * pixel, 200, 150);
        for (int y = 0; y < 150; ++y) {
            for (int x = 0; x < 3 * 200; ++x) {
                const int a = part[static_cast<std::size_t>(600 * y + x)];
                const int b = whole[static_cast<std::size_t>(900 * (y + 50) + 300 + x)];
                ASSERT_NEAR(a, b, 2);
            }
        }
        // Twice as fine, averaged over four pixels, it is nearly the same.
        const Bytes fine = painted(floor, pixel / 2, {0, 0}, 400, 400);
        double difference = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                int sum = 0;
                for (const int at : {0, 3, 1200, 1203}) sum += fine[static_cast<std::size_t>(2400 * y + 6 * x + at)];
                difference += std::abs(sum / 4.0 - whole[static_cast<std::size_t>(900 * y + 3 * x)]);
            }
        }
        EXPECT_LT(difference / (200 * 200), 4);
    }
}

TEST(Floor, IsTheGroundOfPicturesInBandsAndTiles) {
    const Document document = parse("a.lsys", "axiom: F+F+F+F\nground: slate\nstroke: 0.1 step white\n");
    Print print = print_of(document, 100, 120, 127);
    const auto drawing = placed(document, print);
    const auto rendering = drawing->rendering(print);
    ASSERT_EQ(rendering->channels(), 3);
    const Bytes whole = pixels(*rendering);
    EXPECT_EQ(pixels(*rendering, 3), whole);
    const Bytes floor = painted(Floor::slate, 25.4 / 127, {0, 0}, 500, 600);
    EXPECT_TRUE(std::equal(floor.begin(), floor.begin() + 3000, whole.begin()));
    Bytes rows;
    rendering->render_rows(256, 384, 3, [&](int, int, std::span<const std::uint8_t> part) {
        rows.insert(rows.end(), part.begin(), part.end());
    });
    EXPECT_TRUE(std::equal(rows.begin(), rows.end(), whole.begin() + 1500 * 256));
    Print tile = print;
    const glm::dvec2 corner(20, 30);
    tile.page = {60, 60, 0};
    tile.placement.to_page[2] -= corner;
    tile.floor_corner += corner;
    const Bytes part = pixels(*drawing->rendering(tile));
    std::size_t differing = 0;
    for (std::size_t y = 0; y < 300; ++y) {
        for (std::size_t x = 0; x < 900; ++x) {
            differing += std::abs(part[900 * y + x] - whole[1500 * (y + 150) + 300 + x]) > 3;
        }
    }
    EXPECT_LT(differing, 20U);
}

/// A half transparent fill lets half of the floor through.
TEST(Floor, ShinesThroughFills) {
    const Document document = parse("a.lsys", "axiom: {F+F+F+F}\nground: concrete\nstroke: none\nfill: #ffffff80\n");
    Print print = print_of(document, 60, 60, 127);
    const auto drawing = placed(document, print);
    const Bytes filled = pixels(*drawing->rendering(print));
    const Bytes floor = painted(Floor::concrete, 25.4 / 127, {0, 0}, 300, 300);
    for (std::size_t y = 100; y < 200; ++y) {
        for (std::size_t x = 300; x < 600; ++x) {
            const double expected = floor[900 * y + x] * (127.0 / 255) + 128;
            ASSERT_NEAR(filled[900 * y + x], expected, 1.6);
        }
    }
}

TEST(Floor, IsItsMeanColourInOtherFormats) {
    const Document document = parse("a.lsys", "axiom: F+F+F+F\nground: red-earth\nstroke: 0.1 step white\n");
    const std::string earth = hex(mean_colour(Floor::red_earth));
    EXPECT_TRUE(has(draw(document, "svg", {}), earth));
    const auto ground = [](const std::string& eps) { return eps.substr(eps.find("% ground"), 60); };
    EXPECT_EQ(ground(draw(document, "eps", {{"ground", earth}})), ground(draw(document, "eps", {})));
    // Ink of that colour is reported.
    const auto warned = [&](const OptionValues& values) {
        return warnings_of(remarks_about(prints(), document, "png", values));
    };
    EXPECT_TRUE(has(warned({{"stroke", "0.2 step " + earth}}), "can hardly be seen"));
    EXPECT_EQ(warned({}), "");
    EXPECT_TRUE(has(warnings_of(remarks_about(prints(), document, "gif", {{"generations", "0:1"}})),
                    "the floor is drawn in its mean colour"));
}

/// The page of the studio has a list of its own.
TEST(Floor, ColoursOfTheStudioAreTheSame) {
    const std::string list = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "studio/page/floors.ts");
    for (const std::string_view name : floor_names()) {
        const std::size_t at = list.find(name);
        ASSERT_NE(at, std::string::npos) << name;
        const std::size_t colour = list.find('#', at);
        EXPECT_EQ(list.substr(colour, 7), hex(mean_colour(*find_floor(name)))) << name;
    }
}

TEST(Floor, NamesAreChecked) {
    const auto complaint = [](const std::string& ground) {
        return error_of([&] { draw(parse("a.lsys", "axiom: F\nground: " + ground + "\n"), "svg"); });
    };
    EXPECT_TRUE(has(complaint("red-erth"), "did you mean 'red-earth'?")) << complaint("red-erth");
    EXPECT_TRUE(has(complaint("slate grey"), "unexpected")) << complaint("slate grey");
    EXPECT_TRUE(has(complaint("marble3"), "is not a colour")) << complaint("marble3");
    EXPECT_EQ(complaint("Cow-Dung"), "");
    Style style;
    style.floor = Floor::slate;
    style.ground = mean_colour(Floor::slate);
    EXPECT_EQ(style.shown_floor(), Floor::slate);
    style.ground = Colour{255, 255, 255, 255};
    EXPECT_FALSE(style.shown_floor());
}

}  // namespace sikku::floor_test
