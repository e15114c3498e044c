// Conway worms: against the vertex figures of certificates, and the order of their links.
#include "art/tiles/tile_worms.h"
#include "art/prints.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "engine/tiling/tiling.h"
#include "tests/files.h"
#include "tests/reference.h"
#include "tests/works.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::tile_worms_test {

Grammar grammar_of(const std::string& tiling, int n) {
    return reference::grammar_of(contents(bundled("tilings/" + tiling)),
                                 {{"-n", "derivation length", std::to_string(n)}});
}

/// Collects the outlines of polygons.
struct Outlines : PolygonSink {
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override { tiles.add(vertices); }
    TileOutlines tiles;
};

TileOutlines outlines(const std::string& tiling, int n) {
    const Grammar grammar = grammar_of(tiling, n);
    Outlines result;
    derive(grammar, *Turtle::drawing(grammar, result, false), {.interpreted = true});
    return result.tiles;
}

/// Numbers of vertices with three tiles, by their largest angle.
std::map<int, std::uint64_t> threes(const std::string& tiling, int n) {
    std::map<int, std::uint64_t> counts;
    for (const VertexFigure& figure : examine_tiling(grammar_of(tiling, n), {}).examination.figures) {
        if (figure.angles.size() != 3) continue;
        counts[static_cast<int>(std::lround(*std::max_element(figure.angles.begin(), figure.angles.end())))] +=
            figure.count;
    }
    return counts;
}

TEST(TileWorms, HaveALinkForEachVertexOfThreeRhombs) {
    for (const auto& [tiling, n] : {std::pair("penrose-rhombs", 6), std::pair("ammann-beenker", 3)}) {
        std::uint64_t vertices = 0;
        for (const auto& [angle, count] : threes(tiling, n)) vertices += count;
        EXPECT_EQ(find_worms(outlines(tiling, n), {}).size(), vertices) << tiling;
        EXPECT_GT(vertices, 100U);
    }
    // Three equal rhombs are a hexagon with three axes.
    std::uint64_t cubes = 0;
    for (const auto& [angle, count] : threes("tumbling-blocks", 12)) cubes += count;
    EXPECT_EQ(find_worms(outlines("tumbling-blocks", 12), {}).size(), 3 * cubes);
    for (const char* none : {"chair", "trihexagonal", "penrose-kite-dart"}) {
        EXPECT_TRUE(find_worms(outlines(none, 4), {}).empty()) << none;
    }
}

/// Long and short links follow each other as in the words of Fibonacci: no two short ones, no three long ones.
TEST(TileWorms, InPenroseTilingsAreFibonacciWords) {
    const std::vector<WormLink> links = find_worms(outlines("penrose-rhombs", 7), {});
    double longest = 0, shortest = 1e9;
    for (const WormLink& link : links) {
        longest = std::max(longest, glm::distance(link.from, link.to));
        shortest = std::min(shortest, glm::distance(link.from, link.to));
    }
    // The diagonals of two kinds of rhombs: 2 sin 72° and 2 sin 36°.
    EXPECT_NEAR(longest / shortest, (1 + std::sqrt(5.0)) / 2, 1e-9);
    const auto key = [](glm::dvec2 at) { return std::pair(std::lround(at.x * 1e5), std::lround(at.y * 1e5)); };
    std::map<std::pair<long, long>, std::vector<const WormLink*>> at;
    for (const WormLink& link : links) {
        at[key(link.from)].push_back(&link);
        at[key(link.to)].push_back(&link);
    }
    const auto is_long = [&](const WormLink& link) {
        return std::fabs(glm::distance(link.from, link.to) - longest) < 1e-9;
    };
    std::set<const WormLink*> seen;
    std::size_t most = 0;
    for (const auto& [place, meeting] : at) {
        ASSERT_LE(meeting.size(), 2U) << "worms do not branch";
        if (meeting.size() != 1 || seen.contains(meeting.front())) continue;
        std::string word;
        auto here = place;
        for (const WormLink* link = meeting.front(); link;) {
            seen.insert(link);
            word += is_long(*link) ? 'L' : 'S';
            here = key(link->from) == here ? key(link->to) : key(link->from);
            const WormLink* next = nullptr;
            for (const WormLink* other : at.at(here)) {
                if (other != link) next = other;
            }
            link = next;
        }
        EXPECT_EQ(word.size(), meeting.front()->length);
        EXPECT_FALSE(has(word, "SS"));
        EXPECT_FALSE(has(word, "LLL"));
        most = std::max(most, word.size());
    }
    EXPECT_EQ(seen.size(), links.size());
    EXPECT_GE(most, 7U);
}

TEST(TileWorms, RankTilesByTheirLongestWorm) {
    const TileOutlines tiles = outlines("penrose-rhombs", 5);
    const std::vector<WormLink> links = find_worms(tiles, {});
    const std::vector<std::uint32_t> ranks = ranks_of_worms(tiles.size(), links);
    std::set<std::uint32_t> lengths;
    for (const WormLink& link : links) lengths.insert(link.length);
    ASSERT_EQ(ranks.size(), tiles.size());
    EXPECT_EQ(*std::max_element(ranks.begin(), ranks.end()), lengths.size());
    for (const WormLink& link : links) {
        for (const std::uint32_t tile : link.tiles) EXPECT_GE(ranks[tile], 1U);
    }
}

TEST(TileWorms, AreDrawnAsStraightStrokes) {
    const auto strokes = [](const OptionValues& more) {
        OptionValues values = {
            {"derivation length", "4"}, {"size", "100x100mm"}, {"tile-edges", "none"}, {"tile-colours", "blank"}};
        values.insert(values.end(), more.begin(), more.end());
        const std::string svg = draw(load(bundled("tilings/penrose-rhombs")), "svg", values);
        return std::count(svg.begin(), svg.end(), 'M');
    };
    const std::vector<WormLink> links = find_worms(outlines("penrose-rhombs", 4), {});
    double count = 0;
    for (const WormLink& link : links) count += 1.0 / link.length;
    EXPECT_EQ(strokes({{"decorate", "worms"}}) - strokes({}), std::lround(count));
}

/// Colours and lines without effect cause warnings.
TEST(TileWorms, MissingWormsAreReported) {
    const auto warnings = [](const char* name, const OptionValues& more) {
        OptionValues values = {{"derivation length", "3"}, {"size", "100x100mm"}};
        values.insert(values.end(), more.begin(), more.end());
        return warnings_of(remarks_about(prints(), load(bundled(name)), "svg", values));
    };
    const std::string none = "no tiles form worms: only rhombs do, three around a vertex\n";
    EXPECT_EQ(warnings("tilings/pinwheel", {{"tile-colours", "worms"}}), none);
    EXPECT_EQ(warnings("tilings/pinwheel", {{"decorate", "worms"}}), none);
    EXPECT_EQ(warnings("tilings/penrose-rhombs", {{"tile-colours", "worms"}, {"decorate", "worms"}}), "");
    const std::string alike =
        "'tile colours' gives all tiles one colour: all tiles agree in the property that sets the colour\n";
    EXPECT_EQ(warnings("tilings/chair", {{"tile-colours", "hand"}}), alike);
    EXPECT_EQ(warnings("tilings/chair", {{"tile-colours", "direction"}}), "");
}

}  // namespace sikku::tile_worms_test
