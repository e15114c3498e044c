// The plain form of systems with parameters: derives the same words, and is counted and folded without deriving.
#include "engine/derivation/plain_form.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/exact_counts.h"
#include "engine/derivation/forecast.h"
#include "engine/measure/extent.h"
#include "engine/measure/fold.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace sikku::plain_form_test {

using reference::derived_text;
using reference::grammar_of;

std::string written(const Grammar& grammar) {
    const Grammar word = write_out(grammar, {});
    return to_text(word, word.axiom());
}

TEST(PlainForm, DerivesTheSameWords) {
    for (const std::string text :
         {"axiom: A(1)[+f(2)B]\nA(x) --> f(x*2)A(x+1)B\nB --> A(0.5)-\nf(x) --> f(x/3)\n",
          "axiom: A(1,5)\nA(x,y) : x < y --> A(x+1,y)+A(x,y-1)\nA(x,y) : x >= y --> F(x)\n",
          "axiom: A(3)\nA(x) : x > 0 --> A(x-1)A(x-1)\nA(x) : x == 0 --> *\n",
          "axiom: A(1)\nschedule: one*(n-2) two*2\ntable one:\nA(x) --> A(x*2)B(x)\ntable two:\nA(x) --> +(x)F(x)\n"
          "B(x) --> A(-x)\ninterpret:\nA(x) --> f(x)\nF(x) --> F(x+1)F\n"}) {
        for (int n = 0; n < 7; ++n) {
            const Grammar grammar = grammar_of(text, {{"-n", "derivation length", std::to_string(n)}});
            const auto plain = plain_form(grammar);
            ASSERT_TRUE(plain) << text;
            EXPECT_TRUE(plain->is_plain());
            EXPECT_EQ(derived_text(*plain, true), written(grammar)) << text << n;
        }
    }
}

/// All bundled patterns with parameters and without chance.
TEST(PlainForm, DerivesTheSameBundledPatterns) {
    int count = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns")) {
        if (entry.path().extension() != ".lsys") continue;
        const std::string text = contents(entry.path());
        if (text.find("surface:") != std::string::npos) continue;
        const Grammar grammar = grammar_of(text);
        if (grammar.map() || !grammar.is_parametric()) continue;
        DerivationOptions few;
        few.limit_whole_words(1e7);
        const auto plain = plain_form(grammar);
        if (grammar.is_stochastic() || grammar.whole_word_steps() > 0) {
            EXPECT_FALSE(plain) << entry.path();
            continue;
        }
        if (!plain) continue;
        ++count;
        EXPECT_EQ(derived_text(*plain, true), written(grammar)) << entry.path();
        ASSERT_TRUE(forecast(*plain, true)) << entry.path();
    }
    EXPECT_GT(count, 10);
}

TEST(PlainForm, IsFoldedAndCounted) {
    const std::string text = "turn: left\nheading: 0\naxiom: F(1)+F(1)\nF(x) --> F(x*2)[+F(x)]F(x)\n";
    const auto plain = plain_form(grammar_of(text, {{"-n", "derivation length", "7"}}));
    ASSERT_TRUE(plain);
    const auto folded = fold(*plain);
    ASSERT_TRUE(folded);
    // Each step makes the path of a segment 3 times as long.
    EXPECT_NEAR(folded->end[0].value, std::pow(3.0, 7), 1e-6);
    const auto deep = plain_form(grammar_of(text, {{"-n", "derivation length", "60"}}));
    ASSERT_TRUE(deep);
    const auto counts = forecast(*deep, false);
    ASSERT_TRUE(counts && counts->counts);
    Integer segments = 0;
    for (Symbol symbol = 0; symbol < deep->symbols().size(); ++symbol) {
        if (deep->symbols()[symbol].letter == "F") segments += (*counts->counts)[symbol];
    }
    EXPECT_EQ(segments, 2 * boost::multiprecision::pow(Integer(3), 60));
}

TEST(PlainForm, DoesNotExistForChanceContextsAndTooManyModules) {
    EXPECT_FALSE(plain_form(grammar_of("axiom: A(1)\nderivation length: 3\nA(x) --> A(x*random(1,2))\n")));
    EXPECT_FALSE(plain_form(grammar_of("axiom: A(1)A(2)\nderivation length: 3\nA(y) < A(x) --> A(x+y)\n")));
    EXPECT_FALSE(plain_form(grammar_of("axiom: A(1)\nderivation length: 30\nA(x) --> A(2*x)A(2*x+1)\n")));
    EXPECT_FALSE(plain_form(grammar_of("axiom: A(1)\nderivation length: 100000000\nA(x) --> A(x+1)\n")));
    const Grammar same = grammar_of("axiom: A\nderivation length: 3\nA --> AB\n");
    EXPECT_EQ(derived_text(*plain_form(same)), derived_text(same));
}

}  // namespace sikku::plain_form_test
