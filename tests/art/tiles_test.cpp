// tests/art/tiles_test.cpp: prints cut into sheets.
#include "art/print/tiles.h"

#include "art/print/clip.h"
#include "art/prints.h"
#include "engine/base/output.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::tiles_test {

constexpr Page a1{594.0, 841.0, 10.0};
constexpr Page a4{210.0, 297.0, 5.0};

/// Records the strokes of marks without halos and letters: two points for each stroke.
class Marks : public PolygonSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        start_ = {start.x, -start.y};
        pen_ = pen;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        const bool is_straight = ends.size() == 1 && std::fabs(pen_.width - 0.2) < 1e-9 && pen_.colour == 1;
        if (is_straight) list.emplace_back(start_, glm::dvec2(ends[0].x, -ends[0].y));
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    std::vector<std::pair<glm::dvec2, glm::dvec2>> list;

private:
    glm::dvec2 start_{0.0};
    Pen pen_;
};

TEST(Tiles, AreAsFewAsHoldThePrint) {
    const Tiling tiling = tiling_of(a1, {a4, 10.0});
    EXPECT_EQ(tiling.columns, 3);
    EXPECT_EQ(tiling.rows, 3);
    EXPECT_EQ(tiling_of({210.0, 297.0, 5.0}, {a4, 10.0}).tiles.size(), 1u);
    // Landscape prints are cut into landscape sheets.
    const Tiling wide = tiling_of({570.0, 200.0, 5.0}, {a4, 10.0});
    EXPECT_EQ(wide.tiles.size(), 2u);
    EXPECT_EQ(wide.sheet.width, 297.0);
    EXPECT_THROW(tiling_of(a1, {a4, 200.0}), std::runtime_error);
    EXPECT_THROW(tiling_of({9000.0, 9000.0, 0.0}, {a4, 10.0}), std::runtime_error);
}

TEST(Tiles, NeighboursShareTheOverlapAndNoMore) {
    for (const double overlap : {0.0, 10.0, 35.5}) {
        const Tiling tiling = tiling_of(a1, {a4, overlap});
        double left = 1e300, right = -1e300;
        for (const Tile& tile : tiling.tiles) {
            left = std::min(left, tile.shown.left);
            right = std::max(right, tile.shown.left + tile.shown.width);
            if (tile.column == tiling.columns) continue;
            const Tile& next = *(&tile + 1);
            EXPECT_NEAR(tile.shown.left + tile.shown.width - next.shown.left, overlap, 1e-9);
            EXPECT_NEAR(tile.cut.left + tile.cut.width, next.cut.left, 1e-9) << "cut along one line";
            EXPECT_EQ(tile.cut.top, next.cut.top);
        }
        // The sheets cover the whole area within the margins of the print.
        EXPECT_LE(left, a1.margin + 1e-9);
        EXPECT_GE(right, a1.width - a1.margin - 1e-9);
    }
}

TEST(Tiles, MarksOfNeighboursLieOnEachOther) {
    for (const double overlap : {0.0, 4.0, 10.0}) {
        const Tiling tiling = tiling_of(a1, {a4, overlap});
        // Positions of crosses on the print, with the number of sheets that have them.
        std::map<std::pair<long, long>, int> crosses;
        for (const Tile& tile : tiling.tiles) {
            Marks marks;
            draw_tile_marks(tiling, tile, "", marks);
            std::set<std::pair<long, long>> own;
            ASSERT_EQ(marks.list.size(), 8u);
            const glm::dvec2 corner = tile_corner(tiling, tile);
            for (std::size_t i = 0; i + 1 < marks.list.size(); i += 2) {
                // Each cross has a horizontal and a vertical line along the cuts.
                const glm::dvec2 at = glm::dvec2(marks.list[i + 1].first.x, marks.list[i].first.y) + corner;
                own.emplace(std::lround(at.x * 1000), std::lround(at.y * 1000));
            }
            EXPECT_EQ(own.size(), 4u);
            for (const auto& place : own) ++crosses[place];
        }
        EXPECT_EQ(crosses.size(), 16u);
        EXPECT_EQ(std::count_if(crosses.begin(), crosses.end(), [](const auto& one) { return one.second == 4; }), 4);
        EXPECT_EQ(std::count_if(crosses.begin(), crosses.end(), [](const auto& one) { return one.second == 1; }), 4);
    }
}

TEST(Tiles, MarksStandOutFromAnyGround) {
    for (const Colour ground : {Colour{0x8c, 0x3b, 0x2a, 255}, Colour{255, 255, 255, 255}, Colour{0, 0, 0, 255}}) {
        const std::vector<Colour> palette = mark_print(a4, 300.0, ground).style.palette;
        EXPECT_EQ(palette[0], ground);
        EXPECT_GT(colour_distance(palette[1], ground), 0.4);
    }
}

TEST(Tiles, ClippingKeepsWhatMayBeSeen) {
    class Count : public PolygonSink {
    public:
        void begin_stroke(glm::dvec2, const Pen&) override { ++strokes; }
        void polygon(std::span<const glm::dvec2>, const Pen&) override { ++areas; }
        void disc(glm::dvec2, double, const Pen&) override { ++discs; }
        int strokes = 0, areas = 0, discs = 0;
    } count;
    Box box;
    box.add({0.0, 0.0});
    box.add({10.0, 10.0});
    ClipSink clip(count, box);
    clip.disc({-2.0, 5.0}, 3.0, {});
    clip.disc({-4.0, 5.0}, 3.0, {});
    EXPECT_EQ(count.discs, 1);
    const std::vector<glm::dvec2> near = {{-5.0, -5.0}, {20.0, -5.0}, {20.0, 20.0}},
                                  far = {{11, 0}, {12, 0}, {12, 1}};
    clip.polygon(near, {});
    clip.polygon(far, {});
    EXPECT_EQ(count.areas, 1);
    // The stroke leaves the sheet and returns: two strokes.
    clip.begin_stroke({5.0, 5.0}, {});
    const std::vector<glm::dvec2> way = {{20.0, 5.0}, {20.0, 8.0}, {5.0, 8.0}};
    clip.lines(way);
    clip.end_stroke(false);
    EXPECT_EQ(count.strokes, 2);
}

const std::string kolam =
    "title: Kolam\naxiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 2\nangle increment: 90\n"
    "stroke: 0.2 step #f2b632\nground: #8c3b2a\n";

TEST(Tiles, PdfHasAnOverviewAndAPageForEachSheet) {
    const Document document = parse("kolam.lsys", kolam);
    const OptionValues values = {{"size", "A1"}, {"tile", "A4"}, {"dots", ""}};
    const MadeWork made = made_work(prints(), document, "pdf", values);
    ASSERT_EQ(made.outputs.size(), 1u);
    EXPECT_TRUE(has(made.bytes(), "/Count 10 "));
    EXPECT_EQ(count_of(made.bytes(), "/Type /Page /Parent"), 10u);
    EXPECT_EQ(count_of(made.bytes(), "/Name (discs"), 1u) << "the drawing is in the file once";
    EXPECT_EQ(count_of(made.bytes(), "/MediaBox [0 0 595.2756 841.8898]"), 10u) << "all of A4";
    EXPECT_TRUE(made.remarks.starts_with("9 sheets, 3 x 3\n"));
}

TEST(Tiles, OtherFormatsHaveAFileForEachSheet) {
    const Document document = parse("kolam.lsys", kolam);
    for (const std::string format : {"svg", "png"}) {
        const OptionValues values = {{"size", "100x150mm"}, {"tile", "60x60mm"}, {"dpi", "50"}, {"border", "kaavi"}};
        const MadeWork made = made_work(prints(), document, format, values);
        EXPECT_EQ(made.outputs.size(), 6u) << format;
        EXPECT_TRUE(made.outputs.contains("x-3-2." + format));
    }
}

}  // namespace sikku::tiles_test
