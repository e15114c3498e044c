// Parts of a word that recur: the tiles that are moved equal those that are read, symbol by symbol, from the same
// word.
#include "engine/tiling/tile_repeats.h"

#include "engine/tiling/tiling.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::tile_repeats_test {

/// Compares the tiles of a word with those of the same word written out, in which no part recurs. Returns the number
/// of tiles of parts that were kept or moved.
std::size_t compare(const std::string& name, const Grammar& grammar) {
    const TilingResult moved = examine_tiling(grammar, {});
    const TilingResult read = examine_tiling(write_out(grammar, DerivationOptions::within(200e6)), {});
    const TileSet &a = moved.patch.tiles, &b = read.patch.tiles;
    EXPECT_TRUE(b.placed.empty()) << name;
    EXPECT_EQ(a.polygons, b.polygons) << name;
    EXPECT_EQ(a.begin, b.begin) << name;
    EXPECT_EQ(a.corner, b.corner) << name;
    EXPECT_EQ(a.in_class, b.in_class) << name;
    EXPECT_EQ(a.colour, b.colour) << name;
    EXPECT_EQ(a.number, b.number) << name;
    const auto faults = [](const TileSet& tiles) {
        std::vector<std::tuple<TileFault, std::uint32_t, std::uint32_t>> list;
        for (const TileViolation& each : tiles.violations.list) list.emplace_back(each.fault, each.tile, each.other);
        return list;
    };
    EXPECT_EQ(a.violations.count, b.violations.count) << name;
    EXPECT_EQ(faults(a), faults(b)) << name;
    EXPECT_EQ(moved.patch.pieces.twin, read.patch.pieces.twin) << name;
    EXPECT_EQ(moved.patch.pieces.out, read.patch.pieces.out) << name;
    EXPECT_EQ(moved.examination.is_tiling(), read.examination.is_tiling()) << name;
    EXPECT_EQ(moved.examination.symmetry.name(), read.examination.symmetry.name()) << name;
    const std::size_t points = moved.patch.plane.points();
    EXPECT_EQ(points, read.patch.plane.points()) << name;
    for (std::uint32_t point = 0; point < std::min(points, read.patch.plane.points()); ++point) {
        const glm::dvec2 gap = moved.patch.plane.at(point) - read.patch.plane.at(point);
        EXPECT_LT(scalar_product(gap, gap), 1e-12) << name << ", point " << point;
    }
    std::size_t placed = 0;
    for (const auto& each : a.placed) placed += a.parts[each.part].in_class.size();
    return placed;
}

TEST(TileRepeats, MovedTilesEqualThoseRead) {
    for (const auto& [tiling, steps] : std::vector<std::pair<std::string, std::int64_t>>{{"hat", 4},
                                                                                         {"chair", 6},
                                                                                         {"half-hex", 5},
                                                                                         {"spectre", 3},
                                                                                         {"sphinx", 5},
                                                                                         {"penrose-rhombs", 7},
                                                                                         {"penrose-kite-dart", 6},
                                                                                         {"ammann-beenker", 4}}) {
        const auto grammar = reference::grammar_of(contents(bundled("tilings/" + tiling))).with_steps(steps);
        ASSERT_TRUE(grammar) << tiling;
        EXPECT_GT(compare(tiling, *grammar), 500U) << tiling;
    }
}

TEST(TileRepeats, FaultsAreThoseOfTheWholeWord) {
    // Rows of squares: each continues the previous row, lies on its end, or overlaps it by half a square.
    const std::string keys = "\nderivation length: 5\nmove: f\nangle factor: 4\n";
    const std::string squares = "\ninterpret:\nA --> {F+F+F+F+}f{F+F+F+F+}f\n";
    for (const std::string way : {"", "|ff|", "|f(0.5)|"}) {
        const std::size_t between =
            compare("rows " + way, reference::grammar_of("axiom: A" + way + "A" + keys + "A --> AA" + squares));
        EXPECT_GT(between, 0U) << way;
        const std::size_t within =
            compare("squares " + way, reference::grammar_of("axiom: AA" + keys + "A --> A" + way + "A" + squares));
        EXPECT_EQ(within > 0, way != "|ff|") << way;  // a part that holds a tile twice is read each time
    }
}

/// The places are those of the turtle, however far it goes between tiles.
TEST(TileRepeats, PartsThatGoFarAreRead) {
    const std::string squares = "{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}f";
    const Grammar far = reference::grammar_of(
        "axiom: |f(4294967296)|Af(4294967296)ffffA\nderivation length: 1\nmove: f\nangle factor: 4\n"
        "A --> f(4294967296)" +
        squares + "|f(4294967296)ffff|\n");
    const TilingResult found = examine_tiling(far, {});
    const TilingResult read = examine_tiling(write_out(far, DerivationOptions::within(200e6)), {});
    EXPECT_FALSE(found.patch.plane.is_exact());
    EXPECT_EQ(found.patch.tiles.polygons, 8U);
    EXPECT_EQ(found.examination.regions, read.examination.regions);
    EXPECT_EQ(found.examination.regions, 2U);
}

TEST(TileRepeats, SkippedMovesStayInTheRangeOfCoordinates) {
    for (const std::string steps : {"26", "30"}) {
        const Grammar grammar = reference::grammar_of("axiom: {F+F+F+F+}fB{F+F+F+F+}\nderivation length: " + steps +
                                                      "\nmove: f\nangle factor: 4\nB --> BB\ninterpret:\n"
                                                      "B --> f(274877906944)\n");
        TilingOptions options;
        options.limits.nodes = 1e12;
        EXPECT_THROW(examine_tiling(grammar, options), WordError) << steps;
    }
}

TEST(TileRepeats, PartsThatLeaveTheirBracketsAreRead) {
    // The expansion of B closes a bracket that was opened before it, and that of C leaves a polygon open.
    const std::string squares = "f{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}f{F+F+F+F+}";
    compare("brackets",
            reference::grammar_of("axiom: [A[A[A[A]B]B]B]\nderivation length: 2\nmove: f\nangle factor: 4\n"
                                  "A --> AfA\nB --> " +
                                  squares + "]f[\ninterpret:\nA --> " + squares + "\n"));
    compare("polygons",
            reference::grammar_of("axiom: CDCDCDCD\nderivation length: 1\nmove: f\nangle factor: 4\nC --> " +
                                  squares + "{F\nD --> +F+F+F+}f\n"));
    // A part that changes the pen, so that the next one is entered with another pen.
    compare("colours",
            reference::grammar_of("axiom: AAAAAAAA\nderivation length: 1\nmove: f\nangle factor: 4\nA --> " +
                                  squares + ";f\n"));
}

}  // namespace sikku::tile_repeats_test
