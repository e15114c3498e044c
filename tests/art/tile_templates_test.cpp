// Lists of pieces and templates: against counts from the literature, areas of outlines, and an independent offset.
#include "art/cutting/tile_templates.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku::tile_templates_test {

TilingResult examined(const std::string& tiling, const std::string& steps) {
    return examine_tiling(
        reference::grammar_of(contents(bundled("tilings/" + tiling)), {{"-n", "derivation length", steps}}), {});
}

double area_of(const std::vector<glm::dvec2>& outline) {
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

double distance_to(const std::vector<glm::dvec2>& outline, glm::dvec2 point) {
    double least = 1e300;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], along = outline[(i + 1) % outline.size()] - a;
        const double part = std::fmin(1, std::fmax(0, glm::dot(point - a, along) / glm::dot(along, along)));
        least = std::fmin(least, glm::distance(point, a + along * part));
    }
    return least;
}

TEST(CutList, CountsPiecesByShapeHandAndColour) {
    const std::vector<CutKind> rhombs = cut_list(examined("penrose-rhombs", "5"), 10);
    ASSERT_EQ(rhombs.size(), 2U);
    EXPECT_EQ(rhombs[0].pieces + rhombs[1].pieces, 445U);
    for (const CutKind& kind : rhombs) {
        EXPECT_EQ(kind.pieces, kind.colour == 1 ? 170U : 275U);
        EXPECT_NEAR(kind.area, 100 * std::sin((kind.colour == 1 ? 36 : 72) * std::acos(-1) / 180), 1e-9);
        EXPECT_NEAR(kind.area, area_of(kind.corners), 1e-9);
    }
    // 36 of one hand and 28 of the other.
    std::uint64_t reflected = 0, all = 0;
    for (const CutKind& kind : cut_list(examined("sphinx", "3"), 1)) {
        all += kind.pieces;
        reflected += kind.is_reflected ? kind.pieces : 0;
    }
    EXPECT_EQ(all, 64U);
    EXPECT_TRUE(reflected == 28 || reflected == 36);
}

TEST(CutList, TextAndJsonStateTheSums) {
    const TilingResult result = examined("penrose-rhombs", "3");
    const std::string text = cut_list_text("Penrose", 3, result, 40);
    EXPECT_TRUE(has(text, "65 pieces, 843.79 cm2"));
    EXPECT_TRUE(has(cut_list_json("Penrose", 3, result, 40), "\"pieces\": 65, \"violations\": 0, "));
}

TEST(TileTemplates, OutlinesKeepTheirDistance) {
    for (const std::string tiling : {"hat", "chair", "sphinx", "penrose-rhombs", "pinwheel", "penrose-kite-dart"}) {
        for (const CutKind& kind : cut_list(examined(tiling, "2"), 30)) {
            const std::vector<glm::dvec2> outline = offset_outline(kind.corners, 6);
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const glm::dvec2 middle = (outline[i] + outline[(i + 1) % outline.size()]) / 2.0;
                EXPECT_GE(distance_to(kind.corners, outline[i]), 6 - 1e-9);
                EXPECT_GE(distance_to(kind.corners, middle), 6 - 1e-9);
                EXPECT_LE(distance_to(kind.corners, outline[i]), 12 * 1.25);
            }
            EXPECT_GT(area_of(outline), area_of(kind.corners));
        }
    }
    // A square grows by its allowance on each side.
    EXPECT_NEAR(area_of(offset_outline(std::vector<glm::dvec2>{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 3)), 256, 1e-9);
}

TEST(TileTemplates, AllowancesWiderThanNotchesAreRefused) {
    const std::vector<glm::dvec2> notched = {{0, 0},   {30, 0},  {30, 20}, {20, 20},
                                             {20, 10}, {10, 10}, {10, 20}, {0, 20}};
    EXPECT_NO_THROW(offset_outline(notched, 4));
    EXPECT_THROW(offset_outline(notched, 6), std::runtime_error);
}

TEST(TileTemplates, FilesContainOneOutlineForEachShapeAndHand) {
    const std::vector<CutKind> kinds = cut_list(examined("hat", "2"), 20);
    PieceWriting writing;
    writing.pattern = "title: Hat\naxiom: F\n";
    for (const PrintFormat format : {PrintFormat::svg, PrintFormat::pdf, PrintFormat::eps, PrintFormat::dxf,
                                     PrintFormat::hpgl, PrintFormat::gcode}) {
        writing.drawing.format = format;
        const auto written = [&] {
            MemoryDestination memory;
            write_templates(kinds, {}, writing, "a", memory);
            return memory.take("a");
        };
        const std::string bytes = written();
        EXPECT_EQ(bytes, written());
        if (format != PrintFormat::dxf) continue;
        EXPECT_EQ(count_of(bytes, "POLYLINE\n8\nCUT\n"), 2U);
        EXPECT_TRUE(has(bytes, "\nSEAM\n"));
        EXPECT_TRUE(has(bytes, "\nLABEL\n"));
    }
    MemoryDestination memory;
    EXPECT_THROW(write_templates({}, {}, writing, "a.svg", memory), std::runtime_error);
}

}  // namespace sikku::tile_templates_test
