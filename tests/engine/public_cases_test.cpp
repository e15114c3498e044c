// tests/engine/public_cases_test.cpp: faults and requests that users of other programs reported, restated.
#include "engine/derivation/forecast.h"
#include "engine/measure/extent.h"
#include "tests/checks.h"
#include "tests/module_reference.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::public_cases_test {

using reference::derived_modules;
using reference::diagnostics_of;
using reference::grammar_of;

std::string word(const std::string& text, int steps = 1) {
    return derived_modules(grammar_of(text, {{"-n", "derivation length", std::to_string(steps)}}));
}

TEST(PublicCases, SeveralContextsOfOnePredecessor) {
    const std::string rules = "A < B > C --> Y\nX < B > C --> Z\nA < B > D --> W\n";
    EXPECT_EQ(word("axiom: ABCDEFGHI\n" + rules), "AYCDEFGHI");
    EXPECT_EQ(word("axiom: XBCABD\n" + rules), "XZCAWD");
    // Both sides have to match.
    EXPECT_EQ(word("axiom: ABDXBD\nA < B > C --> Y\n"), "ABDXBD");
    EXPECT_EQ(word("axiom: XBCAB\nA < B > C --> Y\n"), "XBCAB");
}

TEST(PublicCases, ParametersOfTurnsAndStepsAreAdded) {
    EXPECT_EQ(word("axiom: F(1)+(90)F(2)+(30)F(3)\n+(a)F(b) --> S(a+b)\n"), "F(1)S(92)S(33)");
}

TEST(PublicCases, SequencesOfDigits) {
    EXPECT_EQ(word("axiom: 0\n0 --> 001\n1 --> 10\n", 2), "00100110");
}

TEST(PublicCases, WeightsBeforeTheArrow) {
    const auto warned = diagnostics_of("axiom: F\nF : 0.33 --> FF\nF : 0.67 --> F\n");
    ASSERT_FALSE(warned.empty());
    EXPECT_TRUE(has(warned[0].message, "a weight follows the successor: --> … : 0.33"));
    reference::expect_mistakes("axiom: F\nF 0.33 --> FF\n", {{{2, 3}, "write 'F --> FF : 0.33'"}});
    EXPECT_TRUE(diagnostics_of("axiom: F1\nF 1 --> F\n").empty());
    // Several productions without weights cannot all apply.
    reference::expect_mistakes("axiom: F\nF --> FF\nF --> F\n", {{{3, 1}, "can never apply"}});
}

TEST(PublicCases, WeightsBesideTheWord) {
    for (const char* line :
         {"F --> 0.33 F+F", "F --> F+F 0.33", "F --> 0.33 : F+F", "F --> F+F, 0.33", "F --> .33  F+F"}) {
        const auto found = diagnostics_of("axiom: F\n" + std::string(line) + "\n");
        ASSERT_EQ(found.size(), 1U) << line;
        EXPECT_TRUE(has(found[0].message, "a weight follows the successor; write 'F --> F+F : "));
        EXPECT_TRUE(has(found[0].message, ".33'"));
    }
    reference::expect_mistakes("axiom: F\nF --> 33% F\nF --> 67% FF\n",
                               {{{2, 7}, "write 'F --> F : 33'"}, {{3, 7}, "write 'F --> FF : 67'"}});
    for (const char* line : {"F --> 1 F", "F --> F 1", "F --> F%F", "F --> {.F.F}", "F --> F : 0.33", "F --> F. F"}) {
        EXPECT_TRUE(diagnostics_of("axiom: F\n" + std::string(line) + "\n").empty()) << line;
    }
    // Digits with productions are symbols.
    EXPECT_TRUE(diagnostics_of("axiom: 0\n0 --> 1.0 F\n1 --> F\n").empty());
}

TEST(PublicCases, LettersThatMoveWithoutDrawing) {
    const Measurement carpet =
        measure(grammar_of("axiom: F\nmove: f G\nderivation length: 3\nF --> FGF\nG --> GGG\n"), 1e6);
    EXPECT_EQ(carpet.drawn.value, 8);
    EXPECT_EQ(carpet.moves.value, 27);  // drawn or not
}

TEST(PublicCases, AHundredStepsAreForecastAtOnce) {
    const Grammar grammar = grammar_of("axiom: F\nderivation length: 100\nF --> F+F-F\n");
    EXPECT_EQ(measure(grammar, 1e6).drawn.digits, "515377520732011331036461129765621272702107522001");  // 3^100
}

TEST(PublicCases, NoStepsAreTheAxiom) {
    EXPECT_EQ(word("axiom: X\nX --> F[+X]X\n", 0), "X");
    EXPECT_EQ(measure(grammar_of("axiom: X\nX --> F[+X]X\n"), 1e6).drawn.value, 0);
}

}  // namespace sikku::public_cases_test
