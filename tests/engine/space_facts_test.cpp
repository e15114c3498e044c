// Plants in space: their measures, which a plain walk through the derived word found, and their words as published.
#include "engine/measure/extent.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace sikku::space_facts_test {

Grammar pattern_of(const std::string& name, const std::vector<Setting>& settings = {},
                   std::string_view variant = {}) {
    return reference::grammar_of(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / (name + ".lsys")),
                                 settings, variant);
}

Setting after_steps(int n) {
    return {"-n", "derivation length", std::to_string(n)};
}

// --- measures ------------------------------------------------------------------------------------------------------

/// Positions by a script that turns three vectors with sines and cosines, symbol by symbol; y up, and z towards the
/// reader.
struct Fact {
    const char* pattern;
    const char* variant;
    double symbols, drawn, moves, length;
    std::array<double, 6> box, ink;
    std::array<double, 3> end;
    std::int64_t depth;
};

// clang-format off
const std::vector<Fact> facts = {
    {"plants/fibonacci-bush", "", 28532, 759, 4719, 759,
     {-26.8049317, 0, -30.4516978, 30.695676, 53.732671, 23.1547607},
     {-24.2720022, 0, -27.8167917, 28.0406446, 51.1144306, 20.8965503},
     {0, 0, 0}, 11},
    {"plants/bush-3d", "", 77399, 3891, 11595, 3891,
     {-21.4766325, 0, -23.3254831, 23.3254831, 32.9389779, 16.800986},
     {-20.3069568, 0, -21.935866, 21.935866, 31.620217, 15.5200374},
     {0, 0, 0}, 7},
    {"plants/flowering-plant", "", 15445, 533, 2369, 533,
     {-10.9736301, 0, -16.6721366, 26.9948761, 60.910189, 8.03768353},
     {-10.5778385, 0, -15.4265294, 25.4502944, 60.4599475, 7.67747945},
     {11.3012579, 57.8718654, 3.21644081}, 5},
    {"plants/tropism", "a", 897, 496, 496, 496,
     {-13.2395856, 0, 0, 13.4783321, 48, 0},
     {-13.2395856, 0, 0, 13.4783321, 48, 0},
     {0, 48, 0}, 2},
    {"plants/tropism", "b", 897, 496, 496, 496,
     {-5.79122191, 0, 0, 5.79209321, 48, 0},
     {-5.79122191, 0, 0, 5.79209321, 48, 0},
     {0, 48, 0}, 2},
    {"plants/tropism", "c", 897, 496, 496, 496,
     {-23.7355415, -7.7914854, 0, 22.9829872, 48, 0},
     {-23.7355415, -7.7914854, 0, 22.9829872, 48, 0},
     {0, 48, 0}, 2},
    {"plants/lily-of-the-valley", "", 385, 86, 2766, 30.535,
     {-2.3971441, 0, -1.95675101, 2.3971441, 14.8248645, 3.70220431},
     {-0.775858216, 0, -0.501258846, 0.775858216, 14.8248645, 3.68272837},
     {0, 14.8145063, 3.55148087}, 12},
    {"plants/fern", "", 14786, 1539, 23571, 545.04,
     {-13.7001749, 0, -12.5241618, 12.4412456, 10.635244, 12.2523202},
     {-13.6595489, 0, -12.4643989, 12.4024527, 10.5964493, 12.2352782},
     {0, 0, 0}, 4},
    {"plants/capsella", "", 187, 46, 990, 23.18,
     {-4.40897487, 0, -4.02465068, 5.37388958, 16.1184686, 4.9038126},
     {-0.421212769, 0, -0.405985779, 0.361105076, 15.4809576, 0.382483459},
     {0, 15.44, 0}, 3},
    {"plants/capsella-by-chance", "", 191, 50, 930, 26.26,
     {-4.40897487, 0, -4.02465068, 5.37388958, 16.1184686, 4.9038126},
     {-0.421212769, 0, -0.415018869, 0.400274329, 15.4809576, 0.408034958},
     {0, 15.44, 0}, 3},
    {"plants/capsella-by-table", "", 187, 46, 990, 23.18,
     {-4.40897487, 0, -4.02465068, 5.37388958, 16.1184686, 4.9038126},
     {-0.421212769, 0, -0.405985779, 0.361105076, 15.4809576, 0.382483459},
     {0, 15.44, 0}, 3},
    {"plants/generic-plant", "", 48, 13, 13, 12.18,
     {-0.200990378, 0, -0.175493357, 0.207288742, 10.5, 0.20491934},
     {-0.200990378, 0, -0.175493357, 0.207288742, 10.5, 0.20491934},
     {0, 10.5, 0}, 1},
    {"plants/lilac", "", 1197, 362, 362, 112.62,
     {-1.44667056, 0, -2.52627636, 1.44667056, 12.0035703, 3.76462829},
     {-1.44667056, 0, -2.52627636, 1.44667056, 12.0035703, 3.76462829},
     {0, 6.6, 0}, 4},
    {"plants/flower-field", "", 257366, 7888, 39200, 7888,
     {-20.7238298, 0, -82.9989344, 75.9085424, 49.1242002, 21.6820651},
     {-19.3718672, 0, -82.2342039, 75.3656168, 48.6739587, 20.3469766},
     {0, 0, 0}, 6},
    {"plants/date-palm", "", 6436, 1914, 1914, 2137.39,
     {-11.0753838, 0, -10.8395715, 11.1936299, 30.7316856, 11.223051},
     {-11.0753838, 0, -10.8395715, 11.1936299, 30.7316856, 11.223051},
     {0, 27.44, 0}, 2},
    {"plants/andujar-example-6", "", 2844, 385, 1620, 385,
     {-10.5531959, -0.571622857, -4.41794637, 15.1384661, 16.8772363, 15.3743},
     {-10.5531959, 0, -4.30709648, 15.1384661, 16.8772363, 14.9011581},
     {-3.07387279, 16.8772363, -3.29363684}, 9},
    {"plants/honda-trees", "c", 5611, 510, 510, 3969.25083,
     {-184.114397, 0, 0, 281.894216, 394.172369, 0},
     {-184.114397, 0, 0, 281.894216, 394.172369, 0},
     {0, 100, 0}, 9},
    {"plants/honda-trees", "d", 11254, 1023, 1023, 8907.70906,
     {-188.338381, 0, 0, 201.038807, 527.034734, 0},
     {-188.338381, 0, 0, 201.038807, 527.034734, 0},
     {0, 100, 0}, 10},
    {"plants/honda-trees", "e", 21891, 1990, 1990, 10390.4147,
     {-175.281616, 0, 0, 90.1289484, 504.800214, 0},
     {-175.281616, 0, 0, 90.1289484, 504.800214, 0},
     {0, 100, 0}, 11},
    {"plants/honda-trees", "f", 55298, 5027, 5027, 12147.024,
     {-275.892585, 0, 0, 243.849645, 892.128245, 0},
     {-275.892585, 0, 0, 243.849645, 892.128245, 0},
     {0, 100, 0}, 15},
    {"plants/honda-trees", "g", 11254, 1023, 1023, 18158.5271,
     {-257.711452, 0, -197.933245, 257.711452, 416.302191, 197.933245},
     {-257.711452, 0, -197.933245, 257.711452, 416.302191, 197.933245},
     {0, 100, 0}, 10},
    {"plants/honda-trees", "h", 10110, 919, 919, 31735.2637,
     {-348.312937, 0, -302.111321, 405.311631, 915.882446, 355.924603},
     {-348.312937, 0, -302.111321, 405.311631, 915.882446, 355.924603},
     {0, 100, 0}, 12},
    {"plants/honda-trees", "i", 17447, 1586, 1586, 19603.369,
     {-301.668196, 0, -151.384823, 170.57645, 853.862681, 251.557108},
     {-301.668196, 0, -151.384823, 170.57645, 853.862681, 251.557108},
     {0, 100, 0}, 12},
    {"curves/paper-tape", "", 989, 160, 160, 160,
     {-5, 0, -1, 1, 1, 5},
     {-5, 0, -1, 1, 1, 5},
     {0, 0, 0}, 0},
};
// clang-format on

class SpaceFacts : public ::testing::TestWithParam<Fact> {};

TEST_P(SpaceFacts, AreMeasured) {
    const Fact& fact = GetParam();
    const Measurement found = measure(pattern_of(fact.pattern, {}, fact.variant), 2e8);
    EXPECT_EQ(found.symbols.value, fact.symbols);
    EXPECT_EQ(found.drawn.value, fact.drawn);
    EXPECT_EQ(found.moves.value, fact.moves);
    EXPECT_NEAR(found.length.value, fact.length, 1e-8 * fact.length);
    ASSERT_TRUE(found.space);
    const SpaceSurvey& survey = *found.space;
    ASSERT_TRUE(survey.ink);
    const auto near = [&](const SpaceBounds& bounds, const std::array<double, 6>& told, const char* what) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            EXPECT_NEAR(bounds.low[axis], told[i], 1e-6) << what << axis;
            EXPECT_NEAR(bounds.high[axis], told[i + 3], 1e-6) << what << axis;
        }
    };
    near(survey.box, fact.box, "box");
    near(*survey.ink, fact.ink, "ink");
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(survey.end[axis], fact.end[static_cast<std::size_t>(axis)], 1e-6) << axis;
    }
    EXPECT_EQ(survey.depth, fact.depth);
}

std::string name_of(const ::testing::TestParamInfo<Fact>& fact) {
    std::string name = std::filesystem::path(fact.param.pattern).filename().string() + "_" + fact.param.variant;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Patterns, SpaceFacts, ::testing::ValuesIn(facts), name_of);

// --- words ---------------------------------------------------------------------------------------------------------

std::string word_of(const Grammar& grammar) {
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    return to_text(grammar, collector.word);
}

std::ptrdiff_t count(const std::string& text, std::string_view part) {
    return static_cast<std::ptrdiff_t>(count_of(text, part));
}

/// Without turns and what stands in parentheses.
std::string without_geometry(const std::string& word) {
    return std::regex_replace(word, std::regex(R"([-+&^/\\]|\([^)]*\))"), "");
}

TEST(SpaceWords, ARacemeHasFlowersOfEachAge) {
    // Prusinkiewicz & Hanan 1989, section 3.3.1: A, I[IF0]A, I[IF1]I[IF0]A ... The pedicel is in four pieces, the
    // flower in five, and the stalk below them has grown before.
    const std::vector<std::string> published = {"A", "I[IF0]A", "I[IF1]I[IF0]A", "I[IF2]I[IF1]I[IF0]A",
                                                "I[IF3]I[IF2]I[IF1]I[IF0]A"};
    for (std::size_t n = 0; n < published.size(); ++n) {
        std::string word = word_of(pattern_of("plants/lily-of-the-valley", {after_steps(static_cast<int>(n))}));
        word = std::regex_replace(word, std::regex(R"(G\((\d+),\d\))"), "F$1");
        word = without_geometry(word);
        word = std::regex_replace(word, std::regex(R"(JJJJ(F\d+)\1\1\1\1)"), "I$1");
        EXPECT_EQ(word.substr(0, 12), "[M][M]IIIIII");
        EXPECT_EQ(word.substr(12), published[n]);
    }
}

TEST(SpaceWords, PinnaeOfAFernAreOlderBelow) {
    // Section 3.3.1: A --> I0[B]A, B --> I0[L0][L0]B on nine fronds.
    std::string word = word_of(pattern_of("plants/fern", {after_steps(3)}));
    word = std::regex_replace(word, std::regex(R"(([IL])\((\d+)(,\d)?\))"), "$1$2");
    const std::string frond = "[I2[I1[L1][L1]I0[L0][L0]B]I1[I0[L0][L0]B]I0[B]A]";
    std::string plant;
    for (int i = 0; i < 9; ++i) plant += frond;
    EXPECT_EQ(without_geometry(word), plant);
}

TEST(SpaceWords, OfTwoApicesOfLychnisOneWaitsFourStepsLonger) {
    // Section 3.3.2: an apex A0 has its flower after eight steps, an apex A4 after four, and so has the whole plant
    // after the first.
    std::vector<std::ptrdiff_t> flowers(30);
    for (int n = 0; n < 30; ++n) {
        const Setting seed{"--set", "axiom", "A(7,1)"};
        flowers[static_cast<std::size_t>(n)] =
            count(word_of(pattern_of("plants/lychnis", {seed, after_steps(n)})), "K(");
    }
    for (std::size_t n = 9; n < 30; ++n) EXPECT_EQ(flowers[n], 1 + flowers[n - 8] + flowers[n - 4]) << n;
    EXPECT_EQ(flowers[1], 1);
}

TEST(SpaceWords, ThreeSwitchesOfCapsella) {
    // Section 3.3.3. Counting to nine and nine steps by the first table come to the same.
    for (const int n : {1, 9, 10, 11, 28}) {
        const std::string counted = word_of(pattern_of("plants/capsella", {after_steps(n)}));
        EXPECT_EQ(std::regex_replace(counted, std::regex(R"(A\(\d+\))"), "A"),
                  word_of(pattern_of("plants/capsella-by-table", {after_steps(n)})));
        EXPECT_EQ(count(counted, "L("), std::min(n, 10));
        EXPECT_EQ(count(counted, "K("), std::max(n - 10, 0));
    }
    EXPECT_EQ(count(word_of(pattern_of("plants/capsella-by-chance", {{"--set", "stay", "1"}})), "L("), 28);
    EXPECT_EQ(count(word_of(pattern_of("plants/capsella-by-chance", {{"--set", "stay", "0"}})), "L("), 1);
    // The number of leaves is geometric: of mean 1 / (1 - stay), were the season endless.
    double leaves = 0;
    const int plants = 400;
    for (int seed = 0; seed < plants; ++seed) {
        const std::vector<Setting> settings = {{"--seed", "seed", std::to_string(seed)}, after_steps(100)};
        leaves += static_cast<double>(count(word_of(pattern_of("plants/capsella-by-chance", settings)), "L("));
    }
    EXPECT_NEAR(leaves / plants, 10, 4 * std::sqrt(90.0 / plants));
}

TEST(SpaceWords, InternodesOfTheBushAreFibonacciNumbers) {
    int before = 0;
    int length = 1;
    for (int n = 1; n < 15; ++n) {
        const Setting axiom{"--set", "axiom", "stem"};
        EXPECT_EQ(count(word_of(pattern_of("plants/fibonacci-bush", {axiom, after_steps(n)})), "F"), length) << n;
        before = std::exchange(length, before + length);
    }
}

TEST(SpaceWords, BushesForkInThree) {
    for (int n = 0, apices = 1; n < 8; ++n, apices *= 3) {
        EXPECT_EQ(count(word_of(pattern_of("plants/bush-3d", {after_steps(n)})), "A"), apices);
        EXPECT_EQ(count(word_of(pattern_of("plants/fibonacci-bush", {after_steps(2 * n)})), "apex"), apices);
    }
}

TEST(SpaceWords, ADatePalmShedsAsManyLeavesAsItMakes) {
    // Equation 14 of Prusinkiewicz, Hammel, Hanan & Mech 1996: the crown keeps its size once leaves fall.
    for (const int n : {10, 42, 60, 100}) {
        const std::string word = word_of(pattern_of("plants/date-palm", {after_steps(n)}));
        EXPECT_EQ(count(word, "T("), n);
        EXPECT_EQ(count(word, "P("), std::min(n, 42));
        EXPECT_EQ(count(word, "U"), std::max(n - 41, 0));
    }
}

TEST(SpaceWords, BranchesByChanceEndAfterEighteenInternodes) {
    // Andújar's slides derive it in 100 steps; every second of 36 is an internode, and then nothing grows.
    const std::string word = word_of(pattern_of("plants/andujar-example-6"));
    EXPECT_EQ(word, word_of(pattern_of("plants/andujar-example-6", {after_steps(36)})));
    EXPECT_EQ(count(word, "A("), 0);
    EXPECT_EQ(count(word, "C("), 0);
    // Each apex has a leaf or a second branch, and internodes end branches where there is no apex.
    const Grammar longer = pattern_of("plants/andujar-example-6", {after_steps(35)});
    EXPECT_GT(count(word_of(longer), "C(18)"), 0);
}

TEST(SpaceWords, SixteenSpecimensOfAFlowerField) {
    const std::string word = word_of(pattern_of("plants/flower-field"));
    std::vector<std::string> plants;
    int depth = 0;
    std::size_t from = 0;
    for (std::size_t at = 0; at < word.size(); ++at) {
        if (word[at] == '[' && depth++ == 0) from = at;
        if (word[at] == ']' && --depth == 0) {
            // What stands before is how it is turned.
            plants.push_back(word.substr(word.find("F", from), at - word.find("F", from)));
        }
    }
    ASSERT_EQ(plants.size(), 16u);
    std::sort(plants.begin(), plants.end());
    EXPECT_EQ(std::unique(plants.begin(), plants.end()), plants.end());
}

// --- rolls
// -----------------------------------------------------------------------------------------------------------

/// Half turns about the heading keep a plant in its plane: the other side comes next. Where the file of a pattern has
/// that side as a parameter, the equation as printed draws the same.
void expect_same_in_plane(const std::string& printed, const Grammar& pattern) {
    const Measurement space = measure(reference::grammar_of(printed), 2e8);
    const Measurement plane = measure(pattern, 2e8);
    ASSERT_TRUE(space.space && plane.geometry);
    EXPECT_EQ(space.drawn.value, plane.drawn.value);
    const auto& [low, high] = space.space->box;
    const std::array<double, 4> box = {low.x, low.y, high.x, high.y};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(box[i], plane.geometry->box[i].value, 1e-9) << i;
    EXPECT_NEAR(low.z, 0, 1e-9);
    EXPECT_NEAR(high.z, 0, 1e-9);
}

TEST(SpaceWords, RollsByHalfATurnChangeSides) {
    // Prusinkiewicz, Hammel, Hanan & Mech 1996, equations 15 and 17.
    expect_same_in_plane(
        "define m = 3\ndefine n = 4\ndefine u = 4\ndefine v = 2\nderivation length: 60\nturn: left\nignore: + - /\n"
        "axiom: S(0)F(1,0)A(0)\n"
        "A(i) : i < m-1 --> A(i+1)\n"
        "A(i) : i == m-1 --> [+(60)F(1,1)B(0)]F(1,0)/(180)A(0)\n"
        "B(i) : i < n-1 --> B(i+1)\n"
        "B(i) : i == n-1 --> F(1,1)B(0)\n"
        "S(i) : i < u+v --> S(i+1)\n"
        "S(i) : i == u+v --> *\n"
        "S(i) < F(l,o) : (o == 0) && (i == u-1) --> #F(l,o)!S(0)\n"
        "S(i) < F(l,o) : (o == 1) && (i == v-1) --> #F(l,o)!S(0)\n"
        "S(i) < B(j) --> *\n",
        pattern_of("plants/mesotonic-signal"));
    expect_same_in_plane(
        "derivation length: 35\nturn: left\nignore: + - /\n"
        "axiom: N(1)I(0,2,0,1)A\n"
        "N(k) < I(b,m,v,c) : b == 0 && m == 2 --> I(b, 1, 17*2^((k-1)*0.89^k), c)\n"
        "N(k) > I(b,m,v,c) : b == 0 && m == 2 --> N(k+1)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 1 && b == 1 --> I(b, ml, vl - vl*0.3*((cl-c)/c), c)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 1 && b == 2 --> I(b, ml, vl*0.3*(c/(cl-c)), c)\n"
        "I(b,m,v,c) < A : m == 1 && v > 5 --> /(180)[-(32)I(2, 2, v*0.3, 1)A]+(10)I(1, 2, v*0.7, 1)A\n"
        "I(b,m,v,c) > A : m == 1 && v <= 5 --> I(b, 2, v, c)\n"
        "I(b,m,v,c) > [I(b2,m2,v2,c2)]I(b1,m1,v1,c1) : m == 0 && m1 == 2 && m2 == 2 --> I(b, 2, v, c1+c2)\n"
        "I(b,m,v,c) : m == 1 --> I(b, 0, v, c)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 2 && m == 2 --> I(b, 0, v, c)\n"
        "interpret:\nI(b,m,v,c) --> F\n",
        pattern_of("plants/borchert-honda"));
}

// --- resources -----------------------------------------------------------------------------------------------------

/// Apices below each segment that the word tells, and counts by hand, of the segments outside the brackets of the
/// word's beginning; only where a cycle is complete.
void expect_apices_counted(const std::string& word) {
    std::vector<std::pair<double, int>> segments;  // told, counted
    std::vector<std::size_t> path;
    std::vector<std::vector<std::size_t>> saved;
    for (std::size_t at = 0; at < word.size(); ++at) {
        if (word[at] == 'I') {
            const std::string arguments = word.substr(at + 2, word.find(')', at) - at - 2);
            path.push_back(segments.size());
            segments.emplace_back(std::stod(arguments.substr(arguments.rfind(',') + 1)), 0);
        } else if (word[at] == 'A') {
            for (const std::size_t segment : path) ++segments[segment].second;
        } else if (word[at] == '[') {
            saved.push_back(path);
        } else if (word[at] == ']') {
            path = saved.back();
            saved.pop_back();
        }
    }
    EXPECT_FALSE(segments.empty());
    for (const auto& [told, counted] : segments) EXPECT_EQ(told, counted);
}

TEST(SpaceWords, APrunedBranchingStructureCatchesUp) {
    // Figure 16: cycle k of equation 17 ends with step (k + 1)^2 - 1.
    const auto apices = [](const std::string& variant, int cycle) {
        const std::string word =
            word_of(pattern_of("plants/borchert-honda", {after_steps((cycle + 1) * (cycle + 1) - 1)}, variant));
        if (variant == "unpruned") expect_apices_counted(word);
        return count(word, "A(");
    };
    EXPECT_EQ(apices("unpruned", 5), 16);
    // The stump stands where the first branch stood, which bore 5 of the 16.
    const std::string after = word_of(pattern_of("plants/borchert-honda", {after_steps(36)}, "pruning"));
    EXPECT_EQ(count(after, "[-(-32)Z]"), 1);
    EXPECT_EQ(count(after, "A("), 11);
    // From cycle to cycle what is left grows the faster.
    EXPECT_EQ(apices("unpruned", 6) - apices("unpruned", 5), 6);
    EXPECT_EQ(apices("pruning", 7) - 11, 15);
    EXPECT_EQ(apices("unpruned", 7) - apices("unpruned", 5), 13);
}

TEST(SpaceWords, ShootAndRootComeIntoBalanceAgain) {
    // Figure 17: how many apices the two bear when so many cycles are complete.
    const auto balance = [](int n, std::string_view variant) {
        const std::string word = word_of(pattern_of("plants/shoot-and-root", {after_steps(n)}, variant));
        return word.substr(0, word.find(",1)"));
    };
    EXPECT_EQ(balance(11, ""), "N(3,4,4");
    EXPECT_EQ(balance(71, ""), "N(8,39,39");
    // Of the shoot's seven apices three are cut off; the root waits, the shoot grows fast.
    EXPECT_EQ(balance(19, "pruned-3"), "N(4,4,7");
    EXPECT_EQ(balance(29, "pruned-3"), "N(5,8,10");
    EXPECT_EQ(balance(41, "pruned-3"), "N(6,15,15");
    EXPECT_EQ(balance(29, "pruned-5"), "N(5,11,11");
    EXPECT_EQ(balance(41, "pruned-5"), "N(6,12,17");
    expect_apices_counted(word_of(pattern_of("plants/shoot-and-root", {after_steps(70)}, "pruned-5")));
}

}  // namespace sikku::space_facts_test
