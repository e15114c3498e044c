// Points and pieces of tilings: numbers as in a std::map, and the same pieces with fewer corners looked for.
#include "engine/tiling/point_blocks.h"
#include "engine/tiling/tiling.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>

namespace sikku {

TEST(PointBlocks, NumberPointsAsAMapDoes) {
    // Dense around the origin, so that blocks have very different numbers of points.
    std::mt19937 random(1);
    std::normal_distribution<double> spread(0, 1);
    using Coordinates = std::array<std::int32_t, 4>;
    PointBlocks blocks(4);
    std::map<Coordinates, std::uint32_t> known;
    const auto place = [](const Coordinates& at) { return glm::dvec2(at[0] + 0.5 * at[2], at[1] - 0.7 * at[3]); };
    for (int i = 0; i < 60'000; ++i) {
        Coordinates at{};
        const double size = i % 3 == 0 ? 3 : i % 3 == 1 ? 40 : 5'000;
        for (std::int32_t& each : at) each = static_cast<std::int32_t>(size * spread(random));
        EXPECT_EQ(blocks.find(at.data(), place(at)), known.count(at) > 0 ? known.at(at) : no_number);
        const std::uint32_t number = known.try_emplace(at, static_cast<std::uint32_t>(known.size())).first->second;
        ASSERT_EQ(blocks.add(at.data(), place(at)), number);
        EXPECT_EQ(blocks.find(at.data(), place(at)), number);
        EXPECT_TRUE(std::equal(at.begin(), at.end(), blocks.coordinates(number)));
    }
    EXPECT_EQ(blocks.size(), known.size());
}

TEST(TilePieces, UnpairedEdgesHaveAllCorners) {
    for (const std::string tiling : {"hat-equal", "hat", "chair", "pinwheel", "spectre", "sphinx", "running-bond",
                                     "basket-weave", "ammann-a3", "pythagorean", "penrose-rhombs", "equithirds"}) {
        TilingResult found = examine_tiling(reference::grammar_of(contents(bundled("tilings/" + tiling))), {});
        ASSERT_TRUE(found.examination.has_border) << tiling;
        TilingPatch& patch = found.patch;
        if (!patch.plane.is_exact()) continue;
        const TilePieces few = cut_into_pieces(patch.plane, patch.tiles, CutSearch::unpaired, {});
        const TilePieces all = cut_into_pieces(patch.plane, patch.tiles, CutSearch::all, {});
        EXPECT_EQ(few.from, all.from) << tiling;
        EXPECT_EQ(few.begin, all.begin) << tiling;
        EXPECT_EQ(few.twin, all.twin) << tiling;
        EXPECT_EQ(few.out, all.out) << tiling;
        EXPECT_EQ(few.edges_cut, all.edges_cut) << tiling;
    }
}

}  // namespace sikku
