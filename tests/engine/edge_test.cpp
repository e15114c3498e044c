// Edges whose lengths are those of words: compared with sums of complex numbers, with the words themselves in their
// places, and with walks.
#include "engine/geometry/cyclotomic.h"
#include "engine/geometry/lattice.h"
#include "engine/measure/extent.h"
#include "engine/measure/fold.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace sikku::edge_test {

using reference::expect_mistakes;
using reference::grammar_of;
using reference::survey_of;
using Complex = std::complex<long double>;

constexpr long double turn = 2 * std::numbers::pi_v<long double>;

std::string header(int k) {
    return "turn: left\nheading: 0\nangle factor: " + std::to_string(k) + "\n";
}

/// The last symbol of the axiom.
Symbol last(const Grammar& grammar) {
    return grammar.axiom().back();
}

long double real_part(const Lattice& lattice, Symbol symbol) {
    const auto step = lattice.step(symbol);
    long double sum = 0;
    for (int i = 0; i < lattice.rank; ++i)
        sum += static_cast<long double>(step[static_cast<std::size_t>(i)]) * std::cos(turn * i / lattice.headings);
    return sum * lattice.unit;
}

TEST(Edges, HaveTheLengthsOfTheirWords) {
    struct Case {
        int k;
        const char* word;
        long double length;
    };
    const long double root5 = std::sqrt(5.0L);
    for (const Case& one : {Case{10, "-f++f-", (1 + root5) / 2}, Case{10, "++f----f++", (root5 - 1) / 2},
                            Case{12, "-f++f-", std::sqrt(3.0L)}, Case{12, "-f++f-|f|", std::sqrt(3.0L) - 1},
                            Case{8, "-f++f-", std::sqrt(2.0L)}, Case{8, "-f(0.5)++f(0.5)-", std::sqrt(0.5L)},
                            Case{14, "f++f----f++", 1 + 2 * std::cos(turn / 7)}, Case{4, "f+f-f-f+", 2},
                            Case{6, "fff", 3}, Case{24, "+++++f----------f+++++", 2 * std::cos(turn * 5 / 24)},
                            Case{4, "|ff|", -2}, Case{4, "f(0.25)f(0.5)", 0.75}}) {
        const Grammar grammar = grammar_of(header(one.k) + "axiom: FfL\nedge L: " + one.word + "\n");
        const Command& command = grammar.symbols()[last(grammar)].command;
        EXPECT_EQ(command.action, Action::draw);
        EXPECT_NEAR(command.value, static_cast<double>(one.length), 1e-15) << one.word;
        const Lattice lattice = make_lattice(grammar);
        ASSERT_GT(lattice.rank, 0) << one.word;
        EXPECT_NEAR(static_cast<double>(real_part(lattice, last(grammar)) - one.length), 0, 1e-15) << one.word;
    }
}

/// Random words whose second half is the mirror image of the first end straight ahead.
TEST(Edges, AgreeWithSumsOfComplexNumbers) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        const std::vector<int> factors = {5, 7, 8, 9, 10, 12, 14, 15, 16, 18, 20, 24, 30};
        const int k = factors[random() % factors.size()];
        std::string word, mirrored;
        Complex sum = 0;
        int heading = 0;
        for (int i = 0; i < 12; ++i) {
            if (random() % 2 == 0) {
                word += '+';
                ++heading;
            } else {
                word += 'f';
                sum += std::polar(1.0L, turn * heading / k);
            }
        }
        word += std::string(static_cast<std::size_t>(heading), '-');
        for (const char symbol : word) mirrored += symbol == '+' ? '-' : symbol == '-' ? '+' : symbol;
        const auto length = static_cast<double>(2 * sum.real());
        if (std::fabs(length) < 1e-9) continue;
        const Grammar grammar = grammar_of(header(k) + "axiom: L\nedge L: " + word + mirrored + "\n");
        EXPECT_NEAR(grammar.symbols()[last(grammar)].command.value, length, 1e-14) << word;
        const Lattice lattice = make_lattice(grammar);
        ASSERT_GT(lattice.rank, 0);
        EXPECT_NEAR(static_cast<double>(real_part(lattice, last(grammar))), length, 1e-13) << word;
        const Cyclotomic numbers(lattice);
        EXPECT_TRUE(numbers.is_real(lattice.step(last(grammar)))) << word;
    }
}

TEST(Edges, EndWhereTheirWordsEnd) {
    // Positions after 60 steps have 26 digits; the moves are the edges' words on one side.
    const std::string rest = "derivation length: 60\nA --> [B+E]E++A-E\nB --> E-A\nE --> E++e--E\ne --> E\n";
    for (const auto& [k, word] : {std::pair(10, "-f++f-"), {12, "-f++f-"}, {14, "f++f----f++"}, {8, "-f+ff+f-"}}) {
        const std::string start = header(k) + "axiom: +A\nmove: f L M\n" + rest + "interpret:\n";
        const Grammar edges = grammar_of(header(k) + "axiom: +A\nmove: f L M\nedge L: " + word + "\nedge M: " + word +
                                         "f\n" + rest + "interpret:\nE --> L\ne --> M\n");
        const Grammar words =
            grammar_of(header(k) + "axiom: +A\n" + rest + "interpret:\nE --> " + word + "\ne --> " + word + "f\n");
        const auto one = fold(edges), other = fold(words);
        ASSERT_TRUE(one && other);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(one->end[i].digits, other->end[i].digits) << word;
            EXPECT_FALSE(one->end[i].digits.empty());
        }
        EXPECT_EQ(one->heading, other->heading);
    }
}

TEST(Edges, AreMeasuredAsTheyAreWalked) {
    for (const auto& [k, word] : {std::pair(10, "-f++f-"), {12, "-f++f-|f|"}, {14, "f++f----f++"}, {4, "ff"}}) {
        const Grammar grammar = grammar_of(header(k) + "axiom: L\nmove: f M\nedge L: " + word + "\nedge M: " + word +
                                           "\nderivation length: 6\nL --> L+[M-L]F+L(2)\nM --> ML(0.5)\n");
        const Measurement measured = measure(grammar, 1e7, {});
        const Survey walked = survey_of(grammar);
        ASSERT_TRUE(measured.geometry);
        EXPECT_EQ(measured.drawn.value, static_cast<double>(walked.drawn));
        EXPECT_EQ(measured.moves.value, static_cast<double>(walked.moves));
        EXPECT_NEAR(measured.length.value, walked.length, 1e-9 * walked.length);
        EXPECT_NEAR(measured.geometry->end[0].value, walked.end.x, 1e-9);
        EXPECT_NEAR(measured.geometry->end[1].value, walked.end.y, 1e-9);
        EXPECT_NEAR(measured.geometry->box[0].value, walked.box.low.x, 1e-9);
        EXPECT_NEAR(measured.geometry->box[3].value, walked.box.high.y, 1e-9);
    }
}

TEST(Edges, HaveExactLengthsAtAnyDepth) {
    // 2^90 edges of the golden ratio: floor(2^90 (1 + root 5) / 2 + 1/2), by arbitrary precision.
    const Grammar grammar = grammar_of(header(10) + "axiom: L\nedge L: -f++f-\nderivation length: 90\nL --> LL\n");
    EXPECT_EQ(measure(grammar, 1e7, {}).length.digits, "2003029059598125374137856770");
}

TEST(Edges, CloseExactly) {
    // A kite of Penrose, and hats, by both edge lengths.
    EXPECT_TRUE(survey_of(grammar_of(header(10) + "axiom: L+++F+F+++L\nedge L: -f++f-\n")).closed);
    for (const auto& [a, b] : {std::pair("f", "-f++f-"), {"-f++f-", "f"}, {"f", "fff"}}) {
        const Grammar grammar =
            grammar_of(header(12) + "axiom: ++a---b++b+++a--a+++b--b+++a++aa++a---b++b+++a\nedge a: " + a +
                       "\nedge b: " + b + "\n");
        const Survey survey = survey_of(grammar);
        EXPECT_TRUE(survey.closed);
        EXPECT_EQ(survey.end, glm::dvec2(0.0));
    }
}

TEST(Edges, MoveWhereMoveListsThem) {
    const std::string text = header(4) + "axiom: FLl\nmove: f l\nedge L: ff\nedge l: ff\n";
    const Survey survey = survey_of(grammar_of(text));
    EXPECT_EQ(survey.drawn, 2U);
    EXPECT_EQ(survey.moves, 3U);
    EXPECT_EQ(survey.length, 3.0);
    EXPECT_EQ(survey.end, glm::dvec2(5, 0));
}

TEST(Edges, TakeMultiples) {
    const Grammar grammar = grammar_of(header(10) + "axiom: L(2)L(-0.5)\nedge L: -f++f-\n");
    EXPECT_NEAR(survey_of(grammar).end.x, 1.5 * std::numbers::phi, 1e-15);
    EXPECT_EQ(make_lattice(grammar).rank, 4);
    // With a parameter of its own it lies on no lattice.
    const Grammar parametric = grammar_of(header(10) +
                                          "axiom: L(2)\nedge L: -f++f-\nderivation length: 1\n"
                                          "L(x) --> L(x*x)\n");
    EXPECT_NEAR(survey_of(parametric).end.x, 4 * std::numbers::phi, 1e-14);
}

TEST(Edges, FitOtherPatternsWithoutLattices) {
    const std::string text = "axiom: L+(26.56505117707799)L\nedge L: ff\nturn: left\nheading: 0\n";
    const Survey survey = survey_of(grammar_of(text));
    EXPECT_NEAR(survey.end.x, 2 + 4 / std::sqrt(5.0), 1e-14);
}

TEST(Edges, ReportTheirMistakes) {
    const std::string start = "axiom: L\nangle factor: 10\n";
    expect_mistakes(start + "edge L: -f++f\n", {{{3, 9}, "another heading, turned by 36 degrees to the right"}});
    expect_mistakes(start + "edge L: f+f-\n", {{{3, 9}, "ends 18 degrees to the right of its start"}});
    expect_mistakes(start + "edge L: f++f++f++f++f++\n", {{{3, 9}, "ends where it starts"}});
    expect_mistakes(start + "edge L: *\n", {{{3, 9}, "ends where it starts"}});
    expect_mistakes(start + "edge L:\n", {{{3, 1}, "expected a word"}});
    expect_mistakes(start + "edge L: -F++F-\n", {{{3, 9}, "'F' draws"}});
    expect_mistakes(start + "edge L: -X++X-\n", {{{3, 9}, "'X' neither moves nor turns"}});
    expect_mistakes(start + "edge L: [f]\n", {{{3, 9}, "'[' neither moves nor turns"}});
    expect_mistakes(start + "edge L: fM\nedge M: f\n", {{{3, 9}, "'M' is an edge itself"}});
    expect_mistakes(start + "edge L: fL\n", {{{3, 9}, "'L' is an edge itself"}});
    expect_mistakes(start + "edge L: f\nedge L: ff\n", {{{4, 1}, "given twice"}});
    expect_mistakes(start + "edge +: ff\n", {{{3, 6}, "'+' is already a command of the turtle"}});
    expect_mistakes(start + "edge LM: ff\n", {{{3, 6}, "'LM' is not one symbol"}});
    expect_mistakes(start + "edge L: f(1/0)\n", {{{3, 9}, "not finite"}});
    expect_mistakes(start + "edge L: f(2)\nf(x) --> f(2*x)\n", {{{3, 9}, "must be constants"}});
    expect_mistakes(start + "edge L: " + std::string(1'000'001, 'f') + "\n", {{{3, 9}, "at most 1,000,000 symbols"}});
    expect_mistakes("axiom: L\nangle factor: 11\nedge L: -f++f-\n", {{{3, 9}, "drawn in doubles"}});
    expect_mistakes("axiom: L\nangle factor: 11\nedge L: -f++f\n", {{{3, 9}, "another heading"}});
    expect_mistakes("axiom: L\nangle factor: 11\nedge L: f+f-\n", {{{3, 9}, "degrees to the right of its start"}});
    expect_mistakes("axiom: L\nangle factor: 22\nedge L: ff\n", {});
}

TEST(Edges, AreNamedBySymbolsOfSeveralLetters) {
    const Grammar grammar = grammar_of("symbols: wall\naxiom: wall\nedge wall: fff\nheading: 0\n");
    EXPECT_EQ(survey_of(grammar).end, glm::dvec2(3, 0));
}

}  // namespace sikku::edge_test
