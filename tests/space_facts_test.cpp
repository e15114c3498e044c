// Plants in space: their measures, which a plain walk through the derived word found, and their words as published.
#include "engine/extent.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace sikku {
namespace {

Grammar pattern_of(const std::string& name, const std::vector<Setting>& settings = {}, std::string_view variant = {}) {
    return reference::grammar_of(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / (name + ".lsys")),
                                 settings, variant);
}

Setting after_steps(int n) { return {"-n", "derivation length", std::to_string(n)}; }

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

const std::vector<Fact> facts = {
FACTS_HERE
};

class SpaceFacts : public ::testing::TestWithParam<Fact> {};

TEST_P(SpaceFacts, AreMeasured) {
    const Fact& fact = GetParam();
    const Measurement found = measure(pattern_of(fact.pattern, {}, fact.variant), 2e8);
    EXPECT_EQ(found.symbols.value, fact.symbols);
    EXPECT_EQ(found.drawn.value, fact.drawn);
    EXPECT_EQ(found.moves.value, fact.moves);
    EXPECT_NEAR(found.length.value, fact.length, 1e-8 * fact.length);
    SPACE_HERE
}

INSTANTIATE_TEST_SUITE_P(Patterns, SpaceFacts, ::testing::ValuesIn(facts), [](const auto& info) {
    std::string name = std::filesystem::path(info.param.pattern).filename().string() + "_" + info.param.variant;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// --- words ---------------------------------------------------------------------------------------------------------

std::string word_of(const Grammar& grammar) {
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    return to_text(grammar, collector.word);
}

std::ptrdiff_t count(const std::string& text, const std::string& part) {
    std::ptrdiff_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
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
        const std::string word = word_of(
            pattern_of("plants/borchert-honda", {after_steps((cycle + 1) * (cycle + 1) - 1)}, variant));
        if (variant == "unpruned") expect_apices_counted(word);
        return count(word, "A(");
    };
    EXPECT_EQ(apices("unpruned", 5), 16);
    // The stump stands where the first branch stood, which bore 5 of the 16.
    const std::string after = word_of(pattern_of("plants/borchert-honda", {after_steps(36)}, "pruning"));
    EXPECT_EQ(count(after, "[-(32)Z]"), 1);
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

}  // namespace
}  // namespace sikku
