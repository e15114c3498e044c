// Swatches: three by three copies against the tiling drawn at once, in pixels; tiles that cross an edge against their
// copies at the opposite one; neighbours against each other.
#include "art/writer/swatch.h"
#include "art/prints.h"
#include "art/raster/raster.h"
#include "art/writer/draw.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/vec2.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::swatch_test {

const std::vector<Setting> by_neighbours = {{"test", "tile colours", "neighbours"}};

std::string refusal(const Document& document, const OptionValues& more = {}, const std::string& format = "svg") {
    OptionValues values = {{"swatch", ""}};
    values.insert(values.end(), more.begin(), more.end());
    try {
        draw(document, format, values);
    } catch (const SettingError& error) {
        return error.option() + ": " + error.message();
    }
    return "";
}

Style style_of(const Document& document) {
    Diagnostics diagnostics;
    return read_style(document.pattern(), 96, diagnostics);
}

/// The tiling around a swatch, three times as wide and high, drawn at once from a deeper derivation.
DrawnPixels drawn_at_once(const Document& document, const Swatch& swatch, int width, int height, double dpi) {
    DrawOptions options;
    options.format = PrintFormat::png;
    const glm::dvec2 size = swatch.frame.high - swatch.frame.low;
    DrawnExtent frame;
    // Rows and cells grow upwards and to the right only.
    const bool is_inflated = !document.grammar().has_schedule();
    const glm::dvec2 low = is_inflated ? swatch.frame.low - size : swatch.frame.low;
    frame.box.add(low);
    frame.box.add(low + 3.0 * size);
    options.frame = frame;
    options.placement.rotate = swatch.turn;
    Print print;
    print.style = style_of(document);
    print.dpi = dpi;
    print.page = {3 * width * 25.4 / dpi, 3 * height * 25.4 / dpi, 0};
    options.placement.step = width * 25.4 / dpi / size.x;
    options.stretch = {1, height * 25.4 / dpi / size.y / *options.placement.step};
    if (swatch.has_tile_period) options.tile_period = swatch.cell.sides;
    DrawnPixels pixels;
    options.show_pixels = [&](Rendering& rendering, const PixelSize& all) {
        pixels.width = all.width;
        pixels.height = all.height;
        rendering.render(1, [&](int, int, std::span<const std::uint8_t> rows) {
            pixels.bytes.insert(pixels.bytes.end(), rows.begin(), rows.end());
        });
    };
    MemoryDestination nowhere;
    const std::int64_t steps = is_inflated ? swatch.steps + 2 : 3 * swatch.steps + 6;
    draw(*document.grammar().with_steps(steps), print, options, "all.png", nowhere);
    return pixels;
}

TEST(Swatch, ThreeByThreeCopiesAreTheTiling) {
    std::vector<Document> documents;
    for (const char* name :
         {"trihexagonal", "cairo", "snub-trihexagonal", "pythagorean", "basket-weave", "herringbone",
          "tumbling-blocks", "truncated-square", "elongated-triangular", "twin-dragon"}) {
        documents.push_back(load(name));
    }
    documents.push_back(load("honeycomb").with(by_neighbours));
    documents.push_back(load("cairo").with({{"test", "decorate", "kolam"}, {"test", "tile edges", "none"}}));
    documents.push_back(load("snub-square").with({{"test", "tile edges", "once"}}));
    constexpr double dpi = 100;
    for (const Document& document : documents) {
        const std::string name = document.text("title");
        const Swatch swatch = find_swatch(document.grammar(), style_of(document), {}, {}, false);
        const DrawnPixels one =
            draw_pixels(document, {{"swatch", ""}, {"step", "6mm"}, {"dpi", fmt::format("{}", dpi)}});
        const DrawnPixels all = drawn_at_once(document, swatch, one.width, one.height, dpi);
        ASSERT_EQ(all.width, 3 * one.width) << name;
        ASSERT_EQ(all.height, 3 * one.height) << name;
        const std::size_t channels = all.bytes.size() / static_cast<std::size_t>(all.width * all.height);
        ASSERT_EQ(channels, 3U) << name;
        int differing = 0;
        for (int y = 0; y < all.height; ++y) {
            for (int x = 0; x < all.width; ++x) {
                const auto here = static_cast<std::size_t>(y * all.width + x) * channels;
                const auto there = static_cast<std::size_t>(y % one.height * one.width + x % one.width) * 4;
                for (std::size_t c = 0; c < 3; ++c) {
                    if (std::abs(int{all.bytes[here + c]} - int{one.bytes[there + c]}) > 8) ++differing;
                }
            }
        }
        EXPECT_EQ(differing, 0) << name << ' ' << one.width << 'x' << one.height;
    }
}

struct Tile {
    std::vector<std::pair<long, long>> corners;  ///< micrometres
    std::string fill;
};

/// The filled polygons of an SVG, and its page in micrometres.
std::vector<Tile> tiles_of(const std::string& text, long& width, long& height) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(text.c_str()));
    double w = 0, h = 0;
    std::istringstream(document.document_element().attribute("viewBox").value() + 4) >> w >> h;
    width = std::lround(w * 1000);
    height = std::lround(h * 1000);
    std::vector<Tile> tiles;
    for (const auto& found : document.select_nodes("//g[@*[local-name()='label']='fills']/g/path")) {
        std::string data = found.node().attribute("d").value();
        Tile tile;
        tile.fill = found.node().parent().attribute("fill").value();
        for (std::size_t i = 1; i < data.size(); ++i) {
            if (data[i] == '-' && data[i - 1] != ' ') data.insert(i++, " ");
        }
        std::istringstream stream(data);
        std::pair<long, long> at;
        for (char command = 0; stream >> std::ws, stream.peek() != EOF;) {
            if (std::isalpha(stream.peek()) != 0) stream >> command;
            if (command == 'z') break;
            long x = 0, y = 0;
            if (command != 'v') stream >> x;
            if (command != 'h') stream >> y;
            at = command == 'M' ? std::pair(x, y) : std::pair(at.first + x, at.second + y);
            tile.corners.push_back(at);
        }
        tiles.push_back(std::move(tile));
    }
    return tiles;
}

bool is_near(const Tile& tile, const Tile& other, long right, long down) {
    if (tile.fill != other.fill || tile.corners.size() != other.corners.size()) return false;
    return std::all_of(tile.corners.begin(), tile.corners.end(), [&](const auto& corner) {
        return std::any_of(other.corners.begin(), other.corners.end(), [&](const auto& image) {
            return std::labs(corner.first + right - image.first) <= 3 &&
                   std::labs(corner.second + down - image.second) <= 3;
        });
    });
}

TEST(Swatch, TilesAcrossAnEdgeGoOnAtTheOpposite) {
    for (const char* name :
         {"trihexagonal", "cairo", "gosper-islands", "herringbone", "floret-pentagonal", "windmill"}) {
        long width = 0, height = 0;
        const auto tiles = tiles_of(draw(load(name), "svg", {{"swatch", ""}, {"step", "6mm"}}), width, height);
        ASSERT_FALSE(tiles.empty());
        int crossing = 0;
        for (const Tile& tile : tiles) {
            const auto [left, right] = std::minmax_element(tile.corners.begin(), tile.corners.end());
            const auto [top, bottom] =
                std::minmax_element(tile.corners.begin(), tile.corners.end(),
                                    [](const auto& a, const auto& b) { return a.second < b.second; });
            const auto expect_image = [&](bool crosses, long x, long y) {
                if (!crosses) return;
                ++crossing;
                EXPECT_TRUE(std::any_of(tiles.begin(), tiles.end(), [&](const Tile& other) {
                    return is_near(tile, other, x, y);
                })) << name;
            };
            constexpr long inside = 5;
            const bool is_seen = right->first > inside && left->first < width - inside && bottom->second > inside &&
                                 top->second < height - inside;
            if (!is_seen) continue;
            expect_image(left->first < -inside, width, 0);
            expect_image(right->first > width + inside, -width, 0);
            expect_image(top->second < -inside, 0, height);
            expect_image(bottom->second > height + inside, 0, -height);
        }
        EXPECT_GT(crossing, 0) << name;
    }
}

TEST(Swatch, ColoursOfNeighboursDifferAcrossTheEdges) {
    for (const char* name :
         {"trihexagonal", "cairo", "herringbone", "honeycomb", "tumbling-blocks", "basket-weave"}) {
        long width = 0, height = 0;
        const auto tiles =
            tiles_of(draw(load(name).with(by_neighbours), "svg", {{"swatch", ""}, {"step", "6mm"}}), width, height);
        // Fills of the tiles at each edge, by its middle: two edges of a small page can have the same ends.
        std::map<std::pair<long, long>, std::set<std::string>> fills;
        // Middles within a few micrometres are one, also across the page.
        std::vector<std::pair<long, long>> known;
        const auto middle = [&](std::pair<long, long> from, std::pair<long, long> to) {
            std::pair<long, long> at((from.first + to.first) / 2, (from.second + to.second) / 2);
            at = {(at.first % width + width) % width, (at.second % height + height) % height};
            const auto gap = [](long a, long b, long size) {
                const long way = std::labs(a - b);
                return std::min(way, size - way);
            };
            for (const auto& each : known) {
                if (gap(at.first, each.first, width) <= 4 && gap(at.second, each.second, height) <= 4) return each;
            }
            known.push_back(at);
            return at;
        };
        for (const Tile& tile : tiles) {
            for (std::size_t i = 0; i < tile.corners.size(); ++i) {
                // Copies of a tile have the same edges and the same fill.
                fills[middle(tile.corners[i], tile.corners[(i + 1) % tile.corners.size()])].insert(tile.fill);
            }
        }
        std::size_t shared = 0, colours = 0;
        std::set<std::string> all;
        for (const auto& [edge, both] : fills) {
            shared += both.size() == 2 ? 1 : 0;
            EXPECT_LE(both.size(), 2U) << name;
            all.insert(both.begin(), both.end());
        }
        colours = all.size();
        EXPECT_GT(shared, fills.size() / 2) << name << ": most edges are inner ones, between two colours";
        EXPECT_LE(colours, 4U) << name;
    }
}

TEST(Swatch, IsMadeOfPeriodicTilingsAlone) {
    const std::set<std::string> periodic = {"basket-weave",
                                            "cairo",
                                            "crosses",
                                            "deltoidal-trihexagonal",
                                            "elongated-triangular",
                                            "floret-pentagonal",
                                            "gosper-islands",
                                            "herringbone",
                                            "hexagonal-tiling",
                                            "honeycomb",
                                            "kisrhombille",
                                            "pythagorean",
                                            "rhombitrihexagonal",
                                            "running-bond",
                                            "snub-square",
                                            "snub-trihexagonal",
                                            "square",
                                            "terdragon",
                                            "tetrakis-square",
                                            "triakis-triangular",
                                            "triangular",
                                            "trihexagonal",
                                            "truncated-hexagonal",
                                            "truncated-square",
                                            "truncated-trihexagonal",
                                            "tumbling-blocks",
                                            "twin-dragon",
                                            "windmill"};
    std::set<std::string> found;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings")) {
        const std::string name = entry.path().stem().string();
        const Document document = load(name);
        try {
            const Swatch swatch = find_swatch(document.grammar(), style_of(document), {}, {}, false);
            found.insert(name);
            EXPECT_TRUE(swatch.is_rectangle) << name;
            EXPECT_EQ(swatch.turn, 0) << name;
            EXPECT_GE(swatch.tiles, 2U) << name;
        } catch (const SwatchError&) {
        }
    }
    for (const std::string& name : periodic) EXPECT_TRUE(found.contains(name)) << name;
    for (const std::string& name : found) EXPECT_TRUE(periodic.contains(name)) << name;
}

TEST(Swatch, IsTheSmallestRectangle) {
    const auto found = [](const std::string& name, bool may_turn, double rotate = 0) {
        const Document document = load(name);
        DrawOptions options;
        options.placement.rotate = rotate;
        return find_swatch(document.grammar(), style_of(document), options, options, may_turn);
    };
    const auto size = [](const Swatch& swatch) { return swatch.frame.high - swatch.frame.low; };
    const Swatch hexagons = found("trihexagonal", false);
    EXPECT_NEAR(size(hexagons).x, 2, 1e-9);
    EXPECT_NEAR(size(hexagons).y, 2 * std::sqrt(3.0), 1e-9);
    EXPECT_EQ(hexagons.tiles, 6U);
    EXPECT_EQ(found("crosses", false).tiles, 25U);
    const Swatch turned = found("crosses", true);
    EXPECT_EQ(turned.tiles, 5U);
    EXPECT_NEAR(turned.turn, -26.565051177, 1e-6);
    EXPECT_NEAR(size(turned).x, std::sqrt(5.0), 1e-9);
    // Turned so that no rectangle lies along the axes.
    const Swatch back = found("trihexagonal", false, 20);
    EXPECT_EQ(back.tiles, 6U);
    EXPECT_NEAR(std::fmod(20 + back.turn + 360, 30), 0, 1e-6);
}

TEST(Swatch, IsAParallelogramWhereThereIsNoRectangle) {
    const Document oblique =
        parse("oblique.lsys",
              "title: Oblique\nderivation length: 14\nturn: left\nheading: 0\naxiom: X\ntable rows:\nX --> [Y]vZ\nZ "
              "--> [Y]vX\n"
              "table cells:\nY --> CuY\nschedule: rows*((n+1)/2) cells*(n/2)\ninterpret:\nu --> f\n"
              "v --> +(70)f(1.2599210498948732)-(70)\n"
              "C --> [{F+(70)F(1.2599210498948732)+(110)F+(70)F(1.2599210498948732)}]\n"
              "stroke: 0.05 step black\nground: white\nfill: #30a050\n");
    const DrawnPixels pixels = draw_pixels(oblique, {{"swatch", ""}, {"step", "10mm"}, {"dpi", "100"}});
    EXPECT_EQ(pixels.width, static_cast<int>(std::lround((1 + 1.2599210498948732 * 0.342020143) * 10 / 0.254)));
    const auto alpha = [&](double x, double y) {
        const int column = static_cast<int>(x * (pixels.width - 1)), row = static_cast<int>(y * (pixels.height - 1));
        return int{pixels.bytes[4 * static_cast<std::size_t>(row * pixels.width + column) + 3]};
    };
    EXPECT_EQ(alpha(0.02, 0.1), 0) << "beside the parallelogram";
    EXPECT_EQ(alpha(0.98, 0.9), 0);
    EXPECT_EQ(alpha(0.5, 0.5), 255);
    ASSERT_FALSE(pixels.remarks.empty());
}

TEST(Swatch, IsRefusedWithAReason) {
    // A patch proves nothing about the rest of a tiling.
    EXPECT_TRUE(has(refusal(load("penrose-rhombs")), "; its shapes tend to the ratio τ, which is irrational"));
    for (const char* name :
         {"hat", "spectre", "pinwheel", "chair", "ammann-beenker", "half-hex", "sphinx", "penrose-rhombs"}) {
        const std::string reason = refusal(load(name));
        EXPECT_EQ(reason.find("swatch: found no period among translations of up to "), 0U) << reason;
    }
    // Positions exceed the precision of doubles before there are many tiles.
    for (const char* name : {"fibonacci-spiral", "padovan-spiral"}) {
        const std::string reason = refusal(load(name));
        EXPECT_EQ(reason.find("swatch: found no period in "), 0U) << reason;
        EXPECT_TRUE(has(reason, "; longer ones: positions of up to "));
        EXPECT_FALSE(has(reason, "overlap"));
    }
    EXPECT_EQ(refusal(load("hilbert")),
              "swatch: this drawing has no tiles, which are closed polygons between { and }");
    EXPECT_EQ(refusal(load("bush-3d")), "swatch: applies only to tilings in the plane");
    EXPECT_EQ(refusal(load("square", {"truchet", {}})),
              "swatch: the tiles repeat, but the lines or colours on them do not");
    EXPECT_EQ(refusal(load("fudgeflake")),
              "swatch: the tiles repeat, but their colours do not; 'tile colours' by shape or neighbours repeat");
    EXPECT_EQ(refusal(load("fudgeflake").with(by_neighbours)), "");
    EXPECT_EQ(refusal(load("honeycomb"), {}, "hpgl"), "swatch: its edges would cut the strokes of a plot");
    EXPECT_EQ(refusal(load("honeycomb"), {{"border", "rope"}}),
              "border: a swatch is part of an endless tiling, with nothing around it");
}

}  // namespace sikku::swatch_test
