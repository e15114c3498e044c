#include "engine/measure/extent.h"

#include "engine/base/integer.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace sikku::extent_test {

using reference::grammar_of;

constexpr double budget = 2e8;

std::string counts_of(const Measurement& measurement) {
    std::string text;
    for (const auto& [letter, count] : measurement.counts) {
        text += (text.empty() ? "" : " ") + letter + ":" +
                (count.digits.empty() ? std::to_string(std::llround(count.value)) : count.digits);
    }
    return text;
}

TEST(Measure, ThePublishedKolam) {
    // Prusinkiewicz & Hanan 1989, figure 6.2
    const Measurement found =
        measure(grammar_of("axiom: f+Xf+f+Xf\nderivation length: 4\nX --> Xf-f-f+Xf+f+Xf-f-f+X\n"), budget);
    EXPECT_EQ(found.n, 4);
    EXPECT_EQ(found.symbols.value, 3239);
    EXPECT_EQ(counts_of(found), "+:683 -:680 X:512 f:1364");
    EXPECT_EQ(found.drawn.value, 0);
    EXPECT_EQ(found.moves.value, 1364);
    EXPECT_EQ(found.length.value, 0);
    ASSERT_TRUE(found.geometry);
    EXPECT_FALSE(found.geometry->ink);
    EXPECT_EQ(found.geometry->box[0].value, 0);
    EXPECT_EQ(found.geometry->box[1].value, 0);
    EXPECT_EQ(found.geometry->box[2].value, 31);
    EXPECT_EQ(found.geometry->box[3].value, 31);
    EXPECT_EQ(found.geometry->end[0].value, 0);
    EXPECT_EQ(found.geometry->end[1].value, 0);
    EXPECT_TRUE(found.geometry->closed);
    EXPECT_EQ(found.geometry->depth, 0);
    EXPECT_FALSE(found.derived);
}

/// Positions off the lattice are rounded; a drawing of the size of their tolerance is not closed because of that.
TEST(Measure, IsNotClosedBecauseItIsSmall) {
    const auto closed = [](const std::string& axiom) {
        return measure(grammar_of("axiom: " + axiom + "\nangle increment: 17.3\n"), budget).geometry->closed;
    };
    EXPECT_FALSE(closed("F(0.0000000000001)+F(0.0000000000001)"));
    EXPECT_FALSE(closed("F(0.0000000001)"));
    EXPECT_TRUE(closed("F(0.0000000000001)+(180)F(0.0000000000001)"));
    EXPECT_TRUE(closed("F+(180)F"));
    EXPECT_TRUE(closed("+++"));
    const std::string small = "F(0.0000000000001)";
    EXPECT_FALSE(
        measure(grammar_of("axiom: " + small + "&" + small + "\nangle increment: 17.3\n"), budget).space->closed);
}

TEST(Measure, SymbolsAreOfTheWordAndTheRestIsOfItsInterpretation) {
    const Measurement found = measure(
        grammar_of("axiom: A\nderivation length: 2\nA --> [A]B(2)B(3)\ninterpret:\nB --> *\nA --> FF(0.5)f\n"),
        budget);
    EXPECT_EQ(found.symbols.value, 9);
    EXPECT_EQ(counts_of(found), "A:1 B:4 [:2 ]:2");  // by letter, whatever the parameters
    EXPECT_EQ(found.drawn.value, 2);
    EXPECT_EQ(found.moves.value, 3);
    EXPECT_EQ(found.length.value, 1.5);
    EXPECT_EQ(found.geometry->depth, 2);
    EXPECT_EQ(found.geometry->box[3].value, 2.5);
    EXPECT_EQ((*found.geometry->ink)[3].value, 1.5);
}

TEST(Measure, LengthsAreWithoutSigns) {
    for (const char* first : {"F(2.5)", "F(1/3)"}) {
        const Measurement found = measure(grammar_of("axiom: " + std::string(first) + "F(-2)f(7)F\n"), budget);
        EXPECT_DOUBLE_EQ(found.length.value, first[2] == '2' ? 5.5 : 3 + 1.0 / 3);
        EXPECT_EQ(found.moves.value, 4);
    }
}

TEST(Measure, BothRoadsAgree) {
    reference::Kind kind;
    kind.letters = {"F", "f", "F(2.5)", "f(0.2)", "X"};
    kind.signs = {"+", "-", "+(60)"};
    kind.brackets = reference::Kind::Brackets::nested;
    kind.interpreted = true;
    for (unsigned seed = 0; seed < 100; ++seed) {
        const reference::System system = reference::random_system(seed, kind);
        if (system.schedule.empty() || !reference::rewrite_level_by_level(system, true, 5000)) continue;
        const Measurement folded = measure(grammar_of(system.text()), budget);
        // A production that never matches looks at its neighbours: now the word has to be walked.
        reference::System bound = system;
        bound.tables[0].push_back({{"Q"}, {"Q"}, {}, {"Q"}});
        const Measurement walked = measure(grammar_of(bound.text()), budget);
        EXPECT_FALSE(folded.derived);
        EXPECT_TRUE(walked.derived);
        EXPECT_EQ(folded.symbols.value, walked.symbols.value);
        EXPECT_EQ(counts_of(folded), counts_of(walked));
        EXPECT_EQ(folded.drawn.value, walked.drawn.value);
        EXPECT_EQ(folded.moves.value, walked.moves.value);
        EXPECT_NEAR(folded.length.value, walked.length.value, 1e-9 * (1 + folded.length.value));
        ASSERT_TRUE(folded.geometry && walked.geometry);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(folded.geometry->box[i].value, walked.geometry->box[i].value, 1e-7);
        }
        EXPECT_EQ(folded.geometry->closed, walked.geometry->closed);
        EXPECT_EQ(folded.geometry->depth, walked.geometry->depth);
        EXPECT_TRUE(reference::same_heading(folded.geometry->heading, walked.geometry->heading));
    }
}

TEST(Measure, NumbersBeyond53BitsAreExact) {
    const Measurement found =
        measure(grammar_of("axiom: X\nderivation length: 60\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n"), budget);
    const Integer steps = (Integer(1) << 120) - 1;
    EXPECT_EQ(found.drawn.digits, steps.str());
    EXPECT_EQ(found.moves.digits, steps.str());
    EXPECT_EQ(found.length.digits, steps.str());
    std::map<std::string, std::string> counts;
    Integer sum = 0;
    for (const auto& [letter, count] : found.counts) {
        counts[letter] = count.digits;
        sum += Integer(count.digits);
    }
    EXPECT_EQ(counts["F"], steps.str());
    EXPECT_EQ(found.symbols.digits, sum.str());
    EXPECT_EQ(found.geometry->box[3].digits, "1152921504606846975");
    EXPECT_FALSE(found.derived);
}

TEST(Measure, BeyondTenThousandDigitsOnlyTheSizeIsTold) {
    const Measurement found = measure(grammar_of("axiom: F\nderivation length: 40000\nF --> FF\n"), budget);
    EXPECT_EQ(found.symbols.digits, "about 10^12041");
    EXPECT_FALSE(found.geometry);
    EXPECT_FALSE(found.derived);
}

TEST(Measure, AnyNumberOfStepsOfUnits) {
    const Measurement found =
        measure(grammar_of("axiom: F+F\nderivation length: 1000000000\nF --> G\nG --> F\n"), budget);
    EXPECT_EQ(found.n, 1'000'000'000);
    EXPECT_EQ(found.symbols.value, 3);
    EXPECT_EQ(found.drawn.value, 2);
    EXPECT_THROW(measure(grammar_of("axiom: F\nderivation length: 1000000000\nF --> FF\n"), budget), BudgetError);
}

TEST(Measure, WordsThatMustBeWalkedKeepTheBudget) {
    // A symbol of a word kept whole counts as 40 nodes.
    const std::string text = "axiom: F\nF --> FF\nx < F --> F\nderivation length: ";
    EXPECT_EQ(measure(grammar_of(text + "10\n"), 40 * 1024).drawn.value, 1024);
    EXPECT_TRUE(measure(grammar_of(text + "10\n"), 40 * 1024).derived);
    EXPECT_THROW(measure(grammar_of(text + "10\n"), 40 * 1024 - 1), BudgetError);
    EXPECT_THROW(measure(grammar_of(text + "60\n"), 1e6), BudgetError);
}

TEST(Measure, UnbalancedWordsAreErrors) {
    EXPECT_THROW(measure(grammar_of("axiom: F]\n"), budget), WordError);
    EXPECT_THROW(measure(grammar_of("axiom: F\nderivation length: 3\nF --> [F\n"), budget), WordError);
    EXPECT_THROW(measure(grammar_of("axiom: F\nderivation length: 3\nA < F --> [F\nF --> {F\n"), budget), WordError);
    EXPECT_NO_THROW(measure(grammar_of("axiom: L[F]R\nderivation length: 3\nL --> [L\nR --> R]\n"), budget));
}

}  // namespace sikku::extent_test
