// Parameters, chance, cuts and contexts with brackets: against a second algorithm, and as they are published.
#include "engine/derivation/forecast.h"
#include "engine/measure/extent.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <string>

namespace sikku::modules_test {

using reference::derived_modules;
using reference::diagnostics_of;
using reference::expect_mistakes;
using reference::grammar_of;
using reference::ModuleKind;

// --- a second way --------------------------------------------------------------------------------------------------

/// Whole words throughout, where the engine would stream them.
std::string derived_whole(const Grammar& grammar) {
    ModuleWord word = grammar.axiom_modules();
    std::int64_t step = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps; ++i) {
            word = rewrite(grammar, grammar.tables()[run.table], word, ++step);
        }
    }
    return to_text(grammar, word);
}

/// Turtles read both alike.
void expect_same_drawing(const Grammar& grammar, const Grammar& written) {
    const auto walk = [](const Grammar& walked, std::string& mistake) {
        try {
            return reference::survey_of(walked);
        } catch (const WordError& error) {
            mistake = error.what();
            return Survey();
        }
    };
    std::string mistake;
    std::string other_mistake;
    const Survey one = walk(grammar, mistake);
    const Survey other = walk(written, other_mistake);
    if (mistake.find("range") != std::string::npos || other_mistake.find("range") != std::string::npos) return;
    EXPECT_EQ(mistake, other_mistake);
    EXPECT_EQ(one.drawn, other.drawn);
    EXPECT_EQ(one.moves, other.moves);
    EXPECT_EQ(one.depth, other.depth);
    const double size = 1e-9 * (1 + one.length);
    EXPECT_NEAR(one.length, other.length, size);
    EXPECT_NEAR(one.end.x, other.end.x, size);
    EXPECT_NEAR(one.end.y, other.end.y, size);
    EXPECT_NEAR(one.box.low.x, other.box.low.x, size);
    EXPECT_NEAR(one.box.high.y, other.box.high.y, size);
}

void expect_equal(const ModuleKind& kind, unsigned seeds) {
    int compared = 0;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        const reference::ModuleSystem system = reference::random_modules(seed, kind);
        reference::ModuleReference slow(system);
        const auto expected = slow.word(false, 3000);
        if (!expected) continue;
        ++compared;
        const std::string text = system.text();
        const Grammar grammar = grammar_of(text);
        ASSERT_EQ(derived_modules(grammar), reference::text_of(*expected)) << seed << '\n' << text;
        ASSERT_EQ(derived_whole(grammar), reference::text_of(*expected)) << seed << '\n' << text;
        if (kind.interpreted) {
            ASSERT_EQ(derived_modules(grammar, true), reference::text_of(*slow.word(true, 30'000))) << seed << '\n'
                                                                                                    << text;
        }
        // As a plain system of one word.
        DerivationOptions options;
        const auto interpreted = slow.word(true, 30'000);
        const Grammar written = write_out(grammar, options);
        EXPECT_TRUE(written.is_plain());
        ASSERT_EQ(to_text(written, written.axiom()), reference::text_of(*interpreted)) << seed << '\n' << text;
        SCOPED_TRACE(text);
        expect_same_drawing(grammar, written);
    }
    EXPECT_GT(compared, seeds / 2);
}

TEST(Modules, ParametersEqualTheReference) {
    ModuleKind kind{.interpreted = true};
    expect_equal(kind, 250);
}

TEST(Modules, ChanceEqualsTheReference) {
    ModuleKind kind{.chance = true, .random = true, .interpreted = true};
    expect_equal(kind, 250);
    kind.parameters = false;
    expect_equal(kind, 300);
}

TEST(Modules, CutsEqualTheReference) {
    ModuleKind kind{.cuts = true, .interpreted = true};
    expect_equal(kind, 300);
    kind.chance = true;
    expect_equal(kind, 300);
    kind.chance = kind.parameters = false;
    expect_equal(kind, 300);
}

TEST(Modules, ContextsInBracketsEqualTheReference) {
    ModuleKind kind;
    kind.contexts = kind.branches = true;
    expect_equal(kind, 250);
    kind.chance = kind.random = kind.cuts = kind.subwords = kind.interpreted = true;
    expect_equal(kind, 250);
    kind.parameters = kind.chance = kind.random = false;
    expect_equal(kind, 250);
}

// --- published words -----------------------------------------------------------------------------------------------

TEST(Modules, TheParametricExample) {
    // Prusinkiewicz, Hammel, Hanan & Mech 1996, equation 3 and figure 5.
    const std::string text =
        "axiom: B(2)A(4,4)\nA(x, y) : y <= 3 --> A(x * 2, x + y)\nA(x, y) : y > 3 --> B(x)A(x/y, 0)\n"
        "B(x) : x < 1 --> C\nB(x) : x >= 1 --> B(x - 1)\n";
    const std::array<std::string, 5> words = {"B(2)A(4,4)", "B(1)B(4)A(1,0)", "B(0)B(3)A(2,1)", "CB(2)A(4,3)",
                                              "CB(1)A(8,7)"};
    for (std::size_t n = 0; n < words.size(); ++n) {
        EXPECT_EQ(derived_modules(text + fmt::format("derivation length: {}\n", n)), words[n]);
    }
    EXPECT_EQ(derived_modules(text + "derivation length: 5\n"), "CB(0)B(8)A(1.1428571428571428,0)");
}

TEST(Modules, ParametersAndContextsOfEquations2And5) {
    EXPECT_EQ(derived_modules("derivation length: 1\naxiom: A(9)A(5)A\nA(t) : t > 5 --> B(t+1)CD(t^0.5,t-2)\n"),
              "B(10)CD(3,7)A(5)A");
    const std::string text =
        "derivation length: 1\nA(x) < B(y) > C(z) : x + y + z > 10 --> E((x + y)/2)F((y + z)/2)\naxiom: ";
    EXPECT_EQ(derived_modules(text + "A(4)B(5)C(6)\n"), "A(4)E(4.5)F(5.5)C(6)");
    EXPECT_EQ(derived_modules(text + "A(1)B(5)C(4)\n"), "A(1)B(5)C(4)");
    EXPECT_EQ(derived_modules(text + "A(4)[X(1)]B(5)[Y]C(6)\n"), "A(4)[X(1)]E(4.5)F(5.5)[Y]C(6)");
    EXPECT_EQ(derived_modules(text + "A(4)B(5)C\n"), "A(4)B(5)C");
}

TEST(Modules, CutsOfEquation13) {
    EXPECT_EQ(derived_modules("axiom: a[b%[cd]e[%f]]g[h[%i]j]k\nderivation length: 1\n"), "a[b]g[h[]j]k");
    EXPECT_EQ(derived_modules("axiom: a[b%[cd]e[%f]]g[h[%i]j]k\n"), "a[b%[cd]e[%f]]g[h[%i]j]k");
    EXPECT_EQ(derived_modules("axiom: ab%c[d]e\nderivation length: 1\n"), "ab");
    EXPECT_EQ(derived_modules("axiom: %a\nderivation length: 1\n"), "");
    EXPECT_EQ(derived_modules("axiom: ab\nderivation length: 2\na --> a%\n"), "a%");
    // What is cut is no neighbour.
    EXPECT_EQ(derived_modules("axiom: a[b%c]d\nderivation length: 1\nb > c --> x\na > [b] --> y\n"), "y[b]d");
}

TEST(Modules, SheddingOfEquation14) {
    const std::string text =
        "axiom: A\nA --> F(1)[-X(3)B][+X(3)B]A\nB --> F(1)B\nX(d) : d > 0 --> X(d-1)\nX(d) : d == 0 --> U%\n"
        "U --> F(0.3)\nderivation length: ";
    EXPECT_EQ(derived_modules(text + "2\n"), "F(1)[-X(2)F(1)B][+X(2)F(1)B]F(1)[-X(3)B][+X(3)B]A");
    EXPECT_EQ(derived_modules(text + "5\n").substr(0, 50), "F(1)[-U%F(1)F(1)F(1)F(1)B][+U%F(1)F(1)F(1)F(1)B]F(");
    EXPECT_EQ(derived_modules(text + "6\n").substr(0, 50), "F(1)[-F(0.3)][+F(0.3)]F(1)[-U%F(1)F(1)F(1)F(1)B][+");
}

TEST(Modules, TheInsectOfEquation16AtABranchingPoint) {
    const std::string text =
        "U < F --> FU\nU --> *\nUL < + --> +U\nF > D --> DF\nD --> *\nL > [+D] --> UR\nUR < - --> -U\n"
        "R > [][-D] --> D\nderivation length: 1\naxiom: ";
    EXPECT_EQ(derived_modules(text + "FUL[+FA][-FA]\n"), "FL[+UFA][-FA]");  // figure 13a
    EXPECT_EQ(derived_modules(text + "FL[+DF][-FA]\n"), "FUR[+F][-FA]");    // b
    EXPECT_EQ(derived_modules(text + "FUR[+F][-FA]\n"), "FR[+F][-UFA]");    // c
    EXPECT_EQ(derived_modules(text + "FR[+F][-DF]\n"), "FD[+F][-F]");       // d
    EXPECT_EQ(derived_modules(text + "FR[-DF][+F]\n"), "FR[-F][+F]");
    EXPECT_EQ(derived_modules(text + "FRX[+F][-DF]\n"), "FRX[+F][-F]");
}

TEST(Modules, BranchesInContextsOneByOne) {
    const auto once = [](const std::string& axiom, const std::string& production) {
        return derived_modules("derivation length: 1\naxiom: " + axiom + "\n" + production + "\n");
    };
    EXPECT_EQ(once("A[B]", "A > [B] --> C"), "C[B]");
    EXPECT_EQ(once("A[BD]E", "A > [B] --> C"), "C[BD]E");  // the rest of the branch is free
    EXPECT_EQ(once("A[DB]", "A > [B] --> C"), "A[DB]");
    EXPECT_EQ(once("A[D][B]", "A > [B] --> C"), "A[D][B]");
    EXPECT_EQ(once("A[D][B]", "A > [][B] --> C"), "C[D][B]");
    EXPECT_EQ(once("A[D]", "A > [][] --> C"), "A[D]");
    EXPECT_EQ(once("A[D]E", "A > []E --> C"), "C[D]E");
    EXPECT_EQ(once("A[D][D]E", "A > []E --> C"), "C[D][D]E");
    EXPECT_EQ(once("AE[D]", "A > []E --> C"), "AE[D]");
    EXPECT_EQ(once("A[[B]D]", "A > [[B]D] --> C"), "C[[B]D]");
    EXPECT_EQ(once("A[[B]D]", "A > [D] --> C"), "C[[B]D]");
    EXPECT_EQ(once("A[]", "A > [B] --> C"), "A[]");
    EXPECT_EQ(once("A[", "A > [] --> C"), "C[");
    EXPECT_EQ(once("A+[B]", "A > [B] --> C"), "A+[B]");
    EXPECT_EQ(once("A+[-B]", "ignore: +-\nA > [B] --> C"), "C+[-B]");
    EXPECT_EQ(once("A", "A > [B][B][B][B]BBBBBBB --> C"), "A");
    EXPECT_EQ(once("A(1)[B(2)]D(4)", "A(x) > [B(y)]D(z) --> A(x+y+z)"), "A(7)[B(2)]D(4)");
}

TEST(Modules, ProductionsWithContextComeFirst) {
    EXPECT_EQ(derived_modules("axiom: SB(1)\nderivation length: 1\nB(j) : j < 3 --> B(j+1)\nS < B(j) --> *\n"), "S");
    EXPECT_EQ(derived_modules("axiom: SB(1)\nderivation length: 1\nB(j) --> B(j+1)\nS < B(j) : j > 1 --> *\n"),
              "SB(2)");
}

TEST(Modules, FormalsComeBeforeDefines) {
    EXPECT_EQ(derived_modules("axiom: A(1)\nderivation length: 1\ndefine x = 7\ndefine y = 5\nA(x) --> B(x+y)\n"),
              "B(6)");
    EXPECT_EQ(derived_modules("axiom: A(3)\nderivation length: 1\nA(\xCE\xB1) --> A(\xCE\xB1^2)\n"), "A(9)");
}

TEST(Modules, TypesAreLettersWithNumbersOfParameters) {
    EXPECT_EQ(derived_modules("axiom: AA(1)A(1,2)\nderivation length: 1\nA(x) --> B(x)\nA --> C\n"), "CB(1)A(1,2)");
    EXPECT_EQ(derived_modules("symbols: ab\naxiom: ab(2)ab\nderivation length: 1\nab(x) --> ab(x/4) ab\n"),
              "ab(0.5) ab ab");
}

TEST(Modules, NumbersArePrintedAsTheyReadBack) {
    const Grammar grammar =
        grammar_of("axiom: A(1/3)A(1e300*1e10)A(0/0)A(-1e-7)A(1e22)\nderivation length: 1\nA(x) --> A(x)\n");
    const std::string text = derived_modules(grammar);
    EXPECT_EQ(text, "A(0.3333333333333333)A(1/0)A(0/0)A(-1e-07)A(1e+22)");
    EXPECT_EQ(derived_modules("axiom: " + text + "\nderivation length: 1\nA(x) --> A(x)\n"), text);
}

TEST(Modules, InterpretationsHaveParametersAndAreAppliedOnce) {
    const std::string text =
        "axiom: A(2)\nderivation length: 1\nA(s) --> A(s*2)B\ninterpret:\nA(s) : s > 3 --> !(s)F(s)A(1)\nB --> "
        "A(9)\n";
    EXPECT_EQ(derived_modules(text), "A(4)B");
    EXPECT_EQ(derived_modules(text, true), "!(4)F(4)A(1)A(9)");
}

Grammar pattern_of(const std::string& file, const std::vector<Setting>& settings = {},
                   std::string_view variant = {}) {
    return grammar_of(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / file), settings, variant);
}

struct Told {
    std::string letter;
    std::vector<double> values;
};
std::vector<Told> modules_of(const Grammar& grammar) {
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    std::vector<Told> result;
    auto next = collector.word.arguments.begin();
    for (const Symbol symbol : collector.word.symbols) {
        const SymbolInfo& info = grammar.symbols()[symbol];
        result.push_back(
            {info.letter, info.arity > 0 ? std::vector<double>(next, next + info.arity) : info.arguments});
        next += info.arity;
    }
    return result;
}

TEST(ModulePatterns, FluxesAndApexCountsOfBorchertAndHondaAddUp) {
    // Equation 17: after 35 steps the fifth cycle is complete, as figure 15 has it.
    const auto word = modules_of(pattern_of("plants/borchert-honda.lsys"));
    EXPECT_EQ(word.front().letter, "N");
    EXPECT_EQ(word.front().values, std::vector<double>{6});
    struct Segment {
        double flux, apices;  // told
        double branches_flux = 0, counted = 0;
        bool forks = false;
    };
    std::vector<Segment> segments;
    std::vector<std::size_t> path;                // from the base to here
    std::vector<std::vector<std::size_t>> saved;  // at open brackets
    for (const Told& module : word) {
        if (module.letter == "I") {
            if (!path.empty()) {
                segments[path.back()].branches_flux += module.values[2];
                segments[path.back()].forks = true;
            }
            path.push_back(segments.size());
            segments.push_back({module.values[2], module.values[3]});
        } else if (module.letter == "A") {
            for (const std::size_t at : path) ++segments[at].counted;
        } else if (module.letter == "[") {
            saved.push_back(path);
        } else if (module.letter == "]") {
            path = saved.back();
            saved.pop_back();
        }
    }
    EXPECT_EQ(segments.size(), 31u);
    for (const Segment& segment : segments) {
        EXPECT_EQ(segment.apices, segment.counted);
        EXPECT_NEAR(segment.forks ? segment.branches_flux : segment.flux, segment.flux, 1e-9);
    }
    // sigma0 2^((k-1) eta^k) of the fifth cycle.
    EXPECT_NEAR(segments.front().flux, 17 * std::pow(2, 4 * std::pow(0.89, 5)), 1e-9);
    EXPECT_EQ(segments.front().apices, 16);
}

TEST(ModulePatterns, FlowersOpenUpwardsOrDownwards) {
    for (const std::string variant : {"acropetal", "basipetal"}) {
        const auto word = modules_of(pattern_of("plants/flowering-signal.lsys", {}, variant));
        std::vector<double> ages;
        for (const Told& module : word) {
            if (module.letter == "K") ages.push_back(module.values[0]);
        }
        ASSERT_GT(ages.size(), 10u);
        // Each second one is a whole step older or younger than that two below it.
        for (std::size_t i = 2; i + 1 < ages.size() - 4; ++i) {
            EXPECT_EQ(ages[i] - ages[i - 2], variant == "acropetal" ? -1 : 1) << variant << i;
        }
    }
}

TEST(ModulePatterns, TheCrownOfEquation14KeepsItsSize) {
    // From step 6 on what is added above is shed below: one branch a side in each step.
    std::vector<std::size_t> segments;
    for (const std::string n : {"6", "7", "8", "9", "30"}) {
        const auto word = modules_of(pattern_of("plants/branch-shedding.lsys", {{"-n", "derivation length", n}}));
        segments.push_back(static_cast<std::size_t>(
            std::count_if(word.begin(), word.end(), [](const Told& module) { return module.letter == "B"; })));
    }
    EXPECT_EQ(segments, std::vector<std::size_t>(5, segments.front()));
}

TEST(ModulePatterns, HondaTreesHaveAsManyInternodesAsTheirTableSays) {
    // Without a least length every apex forks in every step.
    for (const auto& [variant, n] : {std::pair{"a", 10}, {"d", 10}, {"g", 10}}) {
        const auto word = modules_of(pattern_of("plants/honda-trees.lsys", {}, variant));
        const auto drawn = std::count_if(word.begin(), word.end(), [](const Told& m) { return m.letter == "F"; });
        EXPECT_EQ(drawn, (1 << n) - 1) << variant;
        // Leonardo's postulate where e is 0.5: areas of branches add up to that of the stem.
        if (variant != std::string("a")) {
            double area = 0;
            for (const Told& module : word) area += module.letter == "A" ? module.values[1] * module.values[1] : 0;
            const double stem = word.front().values[0];
            EXPECT_NEAR(area, stem * stem, 1e-6) << variant;
        }
    }
}

// --- what kind of system it is -------------------------------------------------------------------------------------

TEST(Modules, WhatNeedsNoArgumentsStaysPlain) {
    EXPECT_TRUE(grammar_of("axiom: F(2)+(60)\nF --> F(1)\n").is_plain());
    EXPECT_TRUE(grammar_of("axiom: F\ndefine on = 1\nF : on == 1 --> FF\nF --> F\n").is_plain());
    EXPECT_TRUE(grammar_of("axiom: F\nF --> FF : 2\n").is_plain());
    EXPECT_TRUE(grammar_of("axiom: F\nF --> FF : 1\nF --> F : 0\n").is_plain());
    EXPECT_TRUE(grammar_of("axiom: F%\nF > [F] --> FF\n").is_plain());
    const Grammar grammar = grammar_of("axiom: F(1)-(120)\nF(s) --> F(s/3)+(60)F(s/3)\n");
    EXPECT_TRUE(grammar.is_parametric());
    EXPECT_FALSE(grammar.is_stochastic());
    for (const SymbolInfo& symbol : grammar.symbols()) EXPECT_EQ(symbol.arity, symbol.letter == "F" ? 1u : 0u);
    EXPECT_TRUE(grammar_of("axiom: F\nF --> FF : 1\nF --> F : 2\n").is_stochastic());
    EXPECT_TRUE(grammar_of("axiom: F(random(0, 1))\n").is_stochastic());
    EXPECT_TRUE(grammar_of("axiom: F\nF : random(0, 1) < 0.5 --> FF\n").is_stochastic());
}

TEST(Modules, SwitchesChooseProductions) {
    const std::string text = "axiom: F\nderivation length: 2\ndefine on = 0\nF : on == 1 --> FF\nF --> FG\n";
    EXPECT_EQ(derived_modules(text), "FGG");
    EXPECT_EQ(derived_modules(grammar_of(text, {{"--set", "on", "1"}})), "FFFF");
}

// --- chance --------------------------------------------------------------------------------------------------------

/// Of counts against what is expected; below it with a probability of 0.999 for so many degrees of freedom.
double chi_square(const std::vector<double>& counts, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    }
    return sum;
}

std::vector<double> counts_of(const Grammar& grammar, const std::vector<std::string>& letters) {
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    std::vector<double> counts(letters.size(), 0.0);
    for (const Symbol symbol : collector.word.symbols) {
        const auto found = std::find(letters.begin(), letters.end(), grammar.symbols()[symbol].letter);
        if (found != letters.end()) ++counts[static_cast<std::size_t>(found - letters.begin())];
    }
    return counts;
}

TEST(Chance, AMillionChoicesAreDistributedAsTheirWeights) {
    for (const std::string seed : {"0", "1", "2024"}) {
        // 2^20 cells, then each becomes one of four.
        const auto counts =
            counts_of(grammar_of("axiom: F\nderivation length: 21\nseed: " + seed +
                                 "\nschedule: grow*(n-1) choose\ntable grow:\nF --> FF\ntable choose:\n"
                                 "F --> A : 1\nF --> B : 2.5\nF --> C : 0\nF --> D : 0.5\n"),
                      {"A", "B", "D", "C"});
        const double all = 1 << 20;
        EXPECT_LT(chi_square({counts[0], counts[1], counts[2]}, {all / 4, all * 2.5 / 4, all / 8}), 13.8) << seed;
        EXPECT_EQ(counts[3], 0);
    }
}

TEST(Chance, NeighboursAndGenerationsAreIndependent) {
    // Pairs of neighbours, of one parent and of two; and of one cell in two steps.
    const Grammar grammar = grammar_of(
        "axiom: F\nderivation length: 21\nschedule: grow*(n-1) choose\ntable grow:\nF --> FF\ntable choose:\n"
        "F --> A : 1\nF --> B : 1\n");
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    std::array<std::vector<double>, 2> pairs = {std::vector<double>(4, 0.0), std::vector<double>(4, 0.0)};
    for (std::size_t i = 0; i + 1 < collector.word.symbols.size(); ++i) {
        const auto is_a = [&](std::size_t at) {
            return grammar.symbols()[collector.word.symbols[at]].letter == "A" ? 1U : 0U;
        };
        ++pairs[i % 2][2 * is_a(i) + is_a(i + 1)];
    }
    for (const auto& counts : pairs) {
        const double each = (counts[0] + counts[1] + counts[2] + counts[3]) / 4;
        EXPECT_LT(chi_square(counts, {each, each, each, each}), 16.3);
    }
    const auto twice =
        counts_of(grammar_of("axiom: F\nderivation length: 22\nschedule: grow*(n-2) choose*2\ntable grow:\nF --> FF\n"
                             "table choose:\nF --> F : 1\nF --> A : 1\nA --> B : 1\nA --> C : 1\n"),
                  {"F", "A", "B", "C"});
    const double quarter = (1 << 20) / 4.0;
    EXPECT_LT(chi_square(twice, {quarter, quarter, quarter, quarter}), 16.3);
}

TEST(Chance, RandomNumbersAreUniform) {
    const Grammar grammar = grammar_of(
        "axiom: F\nderivation length: 21\nschedule: grow*(n-1) choose\ntable grow:\nF --> FF\ntable choose:\n"
        "F --> A(random(2, 12), random(0, 1))\n");
    reference::ModuleCollector collector(grammar);
    derive(grammar, collector);
    std::vector<double> tenths(10, 0.0);
    std::vector<double> both(100, 0.0);
    for (std::size_t i = 0; i < collector.word.arguments.size(); i += 2) {
        const double a = collector.word.arguments[i];
        const double b = collector.word.arguments[i + 1];
        ASSERT_TRUE(a >= 2 && a < 12 && b >= 0 && b < 1);
        ++tenths[static_cast<std::size_t>(a - 2)];
        ++both[static_cast<std::size_t>(a - 2) * 10 + static_cast<std::size_t>(b * 10)];
    }
    const double all = 1 << 20;
    EXPECT_LT(chi_square(tenths, std::vector<double>(10, all / 10)), 27.9);
    EXPECT_LT(chi_square(both, std::vector<double>(100, all / 100)), 148.2);
}

TEST(Chance, SeedsChangeTheWordAndNothingElseDoes) {
    const std::string text = "axiom: F\nderivation length: 8\nF --> F[+F]F : 1\nF --> F[-F] : 1\nF --> FF : 1\n";
    const std::string word = derived_modules(text);
    EXPECT_EQ(derived_modules(text), word);
    EXPECT_EQ(derived_modules(text + "seed: 0\n"), word);
    EXPECT_NE(derived_modules(text + "seed: 1\n"), word);
    // The first steps of a longer derivation are those of a shorter one.
    const Grammar grammar = grammar_of(text);
    const Grammar longer = grammar_of(text + "interpret:\nF --> FX\n");
    EXPECT_EQ(derived_modules(longer), word);
    ModuleWord by_steps = grammar.axiom_modules();
    for (std::int64_t step = 1; step <= 8; ++step) {
        EXPECT_EQ(derived_modules(*grammar.with_steps(step - 1)), to_text(grammar, by_steps));
        by_steps = rewrite(grammar, grammar.tables()[0], by_steps, step);
    }
    EXPECT_EQ(to_text(grammar, by_steps), word);
    // Contexts, which need whole words, change nothing either.
    EXPECT_EQ(derived_modules(text + "X < F --> G\n"), word);
}

TEST(Chance, WeightsAreComputedFromParameters) {
    const auto counts = counts_of(
        grammar_of("axiom: F(3)\nderivation length: 21\nschedule: grow*(n-1) choose\ntable grow:\nF(x) --> F(x)F(x)\n"
                   "table choose:\nF(x) --> A : x\nF(x) --> B : x^2\nF(x) : x > 5 --> C : 100\n"),
        {"A", "B"});
    const double all = 1 << 20;
    EXPECT_LT(chi_square(counts, {all / 4, all * 3 / 4}), 10.9);
}

// --- mistakes ------------------------------------------------------------------------------------------------------

TEST(ModuleMistakes, HaveTheirPlaces) {
    expect_mistakes("axiom: A(1)\nA(x+1) --> A(1)\n", {{{2, 3}, "its contexts must be names"}});
    expect_mistakes("axiom: A(1)\nA(2) --> A(1)\n", {{{2, 3}, "its contexts must be names"}});
    expect_mistakes("axiom: A(1)\nA(x) < A(x) --> A(1)\n", {{{2, 10}, "named twice"}});
    expect_mistakes("axiom: A(1,2)\nA(x,x) --> A(1,2)\n", {{{2, 5}, "named twice"}});
    expect_mistakes("axiom: A(1)\nA(x) --> A(y)\n", {{{2, 12}, "'y' is not defined"}});
    expect_mistakes("axiom: A(1)\nA(x) --> A(sine(x))\n", {{{2, 12}, "unknown function 'sine'"}});
    expect_mistakes("axiom: A(1)\nA(x) --> A(max(x))\n", {{{2, 15}, "takes 2 arguments"}});
    expect_mistakes("axiom: A(1)\nA() --> A(1)\n", {{{2, 3}, "expected a parameter"}});
    expect_mistakes("axiom: A(1)\nA(x --> A(1)\n", {{{2, 1}, "expected"}});
    expect_mistakes("axiom: A(1)\nA(x) : x > --> A(1)\n", {{{2, 11}, "expected a number"}});
    expect_mistakes("axiom: A(1)\nA(x) : --> A(1)\n", {{{2, 7}, "expected a condition"}});
    expect_mistakes("axiom: A(1)\nA(x) : 0/0 --> A(1)\n", {{{2, 8}, "never a number"}});
    expect_mistakes("axiom: A\nA --> B :\n", {{{2, 10}, "expected a weight"}});
    expect_mistakes("axiom: A\nA --> B : 1\nA --> C\n", {{{3, 1}, "has no weight"}});
    expect_mistakes("axiom: A\nA --> B\nA --> C : 1\n", {{{2, 1}, "has no weight"}});
    expect_mistakes("axiom: A\nA --> B : -1\nA --> C : 1/0\nA --> D : 0/0\n",
                    {{{2, 11}, "expected a finite weight"},
                     {{3, 11}, "expected a finite weight"},
                     {{4, 11}, "expected a finite weight"}});
    expect_mistakes("axiom: A\nA --> B : 0\nA --> C : 0\n", {{{2, 11}, "all 0"}});
    expect_mistakes("axiom: A\nA --> B : 1e308\nA --> C : 1e308\n", {{{2, 11}, "no finite sum"}});
    expect_mistakes("axiom: A\nA > [B --> C\n", {{{2, 5}, "not closed"}});
    expect_mistakes("axiom: A\nA > B]C --> C\n", {{{2, 5}, "without '['"}});
    expect_mistakes("axiom: A\n[B] < A --> C\n", {{{2, 1}, "left context cannot contain brackets"}});
    expect_mistakes("axiom: A\nA% --> C\n", {{{2, 2}, "removed before"}});
    expect_mistakes("axiom: A%(3)\n", {{{1, 10}, "no parameters"}});
    expect_mistakes("axiom: A\nignore: F(1)\n", {{{2, 10}, "cannot contain parameters"}});
    expect_mistakes("axiom: A\ndefine a = random(0, 1)\n", {{{2, 12}, "'random' is not allowed here"}});
    expect_mistakes("axiom: A\nseed: -1\n", {{{2, 7}, "whole number"}});
    expect_mistakes("axiom: A(1)\nA(x) --> A(x)\nA(y) --> A(y)\n", {{{3, 1}, "can never apply"}});
    expect_mistakes("axiom: A(1)\ninterpret:\nA(x) > B --> F(x)\n", {{{3, 1}, "replaces one symbol"}});
    EXPECT_TRUE(diagnostics_of("axiom: A(1)A\nA(x) --> A(x)\nA --> A\nA(x) : x > 1 --> B\n").size() == 1);
    EXPECT_TRUE(diagnostics_of("axiom: A(1)\nA(x) : x > 1 --> A(x)\nA(x) --> A(x)\n").empty());
    // A warning: the axiom of equation 10 as the scan has it.
    expect_mistakes("axiom: !(1)F(1,1)\nF(s) --> G(s)\n",
                    {{{2, 1}, "words contain 'F' with 2 parameters, never with 1"}});
}

TEST(ModuleMistakes, HostileFilesAreReadQuickly) {
    const auto begin = std::chrono::steady_clock::now();
    std::string deep = "axiom: A(1)\nderivation length: 1\nA(x) --> A(";
    deep += std::string(10'000, '(') + "x" + std::string(10'000, ')') + ")\n";
    EXPECT_EQ(derived_modules(deep), "A(1)");
    std::string right = "axiom: A(1)\nderivation length: 1\nA(x) --> A(";
    for (int i = 0; i < 10'000; ++i) right += "(x+";
    right += "x" + std::string(10'000, ')') + ")\n";
    EXPECT_EQ(derived_modules(right), "A(10001)");
    std::string many = "axiom: A(999999)\nderivation length: 1\n";
    for (int i = 0; i < 300'000; ++i) many += fmt::format("A(x) : x == {} --> B(x)\n", i + 700'000);
    EXPECT_EQ(derived_modules(many), "B(999999)");
    std::string wide = "axiom: A(1)\nA(x";
    for (int i = 0; i < 100; ++i) wide += fmt::format(",x{}", i);
    expect_mistakes(wide + ") --> A(1)\n", {{{2, 2}, "at most 64"}});
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 20);
}

TEST(ModuleMistakes, WeightsAreToldWithTheSymbolsPosition) {
    const auto message = [](const std::string& text) -> std::string {
        return error_of<WordError>([&] { derived_modules(text); });
    };
    const std::string weights = "A(x) --> B : x\nA(x) --> C : 2*x\nderivation length: 1\naxiom: ";
    EXPECT_EQ(message(weights + "FA(1)A(0)F\n"),
              "step 1: what becomes symbol 3 of the word, 'A(0)': the weights are all 0");
    EXPECT_EQ(message(weights + "A(-1)\n"),
              "step 1: what becomes symbol 1 of the word, 'A(-1)': a weight is negative or no number");
    EXPECT_EQ(message(weights + "A(1/0)\n"),
              "step 1: what becomes symbol 1 of the word, 'A(1/0)': the weights have no finite sum");
    EXPECT_EQ(message("X < F --> G\n" + weights + "FA(1)A(0)F\n"),
              "step 1: symbol 3 of the word before it, 'A(0)': the weights are all 0");
}

TEST(ModuleLimits, BudgetsStopWhatCannotBeForecast) {
    const Grammar grammar = grammar_of("axiom: A(1)\nderivation length: 100\nA(x) --> A(x+1)A(x+2)\n");
    EXPECT_FALSE(forecast(grammar, false));
    EXPECT_FALSE(fold(grammar));
    require_affordable(grammar, false, 10);
    EXPECT_THROW(measure(grammar, 1e6), BudgetError);
    const Grammar contexts =
        grammar_of("axiom: A(1)\nderivation length: 100\nA(x) --> A(x+1)A(x+2)\nB < A(x) --> A(x)\n");
    EXPECT_THROW(measure(contexts, 1e6), BudgetError);
    EXPECT_THROW(shorten(grammar_of("axiom: A(1)\nderivation length: 2000000\nA(x) --> A(x+1)\n")), BudgetError);
    EXPECT_THROW(shorten(grammar_of("axiom: A%\nderivation length: 2000000\nA --> A\n")), BudgetError);
    EXPECT_EQ(derived_modules("axiom: A(1)\nderivation length: 1000000\nA(x) --> A(x+1)\n"), "A(1000001)");
    EXPECT_EQ(derived_modules("axiom: A(1)\nderivation length: 200000\nA(x) : x < 1000 --> A(x+1)B\n").size(), 1006u);
}

TEST(ModuleLimits, LongWordsAreHandedOverInRuns) {
    std::string word;
    for (int i = 0; i < 20'000; ++i) word += "BC(1)F(2)";
    EXPECT_EQ(derived_modules("axiom: " + word + "\nF(x) --> F(x)\n"), word);
    // As an axiom, as the successor of the last step, and of one before it.
    for (const std::string n : {"1", "2"}) {
        EXPECT_EQ(derived_modules("axiom: A(1)F(3)\nderivation length: " + n + "\nA(x) --> " + word +
                                  "\nF(x) : x > 3 --> F(x)\nC(x) : x > 3 --> F(x)\n"),
                  word + "F(3)");
    }
}

// --- turtles -------------------------------------------------------------------------------------------------------

TEST(ModuleTurtle, ParametersAreStepsAnglesWidthsAndColours) {
    const std::string rule = "derivation length: 1\naxiom: A(2)\nangle increment: 30\n";
    const Survey survey =
        reference::survey_of(grammar_of(rule + "A(s) --> F(s)+(45*s)f(s/2)-(10+s)F(-s)|!(s)@O(s)\nF(s) --> F(s)\n"));
    EXPECT_EQ(survey.drawn, 2u);
    EXPECT_EQ(survey.moves, 3u);
    EXPECT_DOUBLE_EQ(survey.length, 4);
    EXPECT_NEAR(survey.heading, 90 - 90 + 12 + 180, 1e-9);
    EXPECT_NEAR(survey.end.x, 1 - 2 * std::cos(12 * std::numbers::pi / 180), 1e-12);
    EXPECT_NEAR(survey.end.y, 2 - 2 * std::sin(12 * std::numbers::pi / 180), 1e-12);
    // The same, written out as a plain word.
    const Survey plain = reference::survey_of(grammar_of("axiom: F(2)+(90)f(1)-(12)F(-2)|\n"));
    EXPECT_NEAR(plain.end.x, survey.end.x, 1e-12);
    EXPECT_NEAR(plain.end.y, survey.end.y, 1e-12);
}

TEST(ModuleTurtle, WhatIsNotFiniteIsToldWithItsPosition) {
    const auto message = [](const std::string& successor) -> std::string {
        return error_of<WordError>([&] {
            reference::survey_of(grammar_of("axiom: FA(0)\nderivation length: 1\nA(x) --> " + successor + "\n"));
        });
    };
    EXPECT_EQ(message("F(1)F(1/x)"), "symbol 3 of the word: its parameter is not finite");
    EXPECT_EQ(message("+(log(x))"), "symbol 2 of the word: its parameter is not finite");
    EXPECT_EQ(message("!(x/x)"), "symbol 2 of the word: its parameter is not finite");
    EXPECT_EQ(message("B(1/x)F(1)"), "");
}

TEST(ModuleTurtle, TheSnowflakeOfEquation8) {
    const Grammar grammar = grammar_of(
        "turn: left\naxiom: F(1)-(120)F(1)-(120)F(1)\nderivation length: 3\n"
        "F(s) --> F(s/3)+(60)F(s/3)-(120)F(s/3)+(60)F(s/3)\n");
    const Measurement measured = measure(grammar, 1e6);
    EXPECT_TRUE(measured.derived);
    EXPECT_EQ(measured.drawn.value, 192);
    EXPECT_NEAR(measured.length.value, 3 * std::pow(4.0 / 3, 3), 1e-12);
    ASSERT_TRUE(measured.geometry);
    EXPECT_TRUE(measured.geometry->closed);
}

}  // namespace sikku::modules_test
