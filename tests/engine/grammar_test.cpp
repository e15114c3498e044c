#include "engine/language/grammar.h"

#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>

namespace sikku::grammar_test {

using reference::derived_text;
using reference::diagnostics_of;
using reference::expect_mistakes;
using reference::grammar_of;

std::string axiom_text(const std::string& axiom, const std::string& keys = "") {
    const Grammar grammar = grammar_of(keys + "axiom: " + axiom + "\n");
    return to_text(grammar, grammar.axiom());
}
std::vector<std::string> letters_of(const std::string& axiom, const std::string& keys = "") {
    const Grammar grammar = grammar_of(keys + "axiom: " + axiom + "\n");
    return reference::tokens_of(grammar, grammar.axiom());
}
using Letters = std::vector<std::string>;

/// What a symbol of the axiom, by its place, does.
Command command(const std::string& axiom, std::size_t at = 0, const std::string& keys = "") {
    const Grammar grammar = grammar_of(keys + "axiom: " + axiom + "\n");
    return grammar.symbols()[grammar.axiom()[at]].command;
}

// --- words and symbols ---------------------------------------------------------------------------------------------

TEST(Words, ASymbolIsOneCodePoint) {
    EXPECT_EQ(letters_of("aB+ \t[\\]/\"'"), (Letters{"a", "B", "+", "[", "\\", "]", "/", "\"", "'"}));
    EXPECT_EQ(letters_of("\xCE\xB1\xE2\x82\xAC\xF0\x9F\x8C\xBF"),
              (Letters{"\xCE\xB1", "\xE2\x82\xAC", "\xF0\x9F\x8C\xBF"}));
    EXPECT_EQ(letters_of("A1.=_~`"), (Letters{"A", "1", ".", "=", "_", "~", "`"}));
}

TEST(Words, AtGoesWithTheCharacterAfterIt) {
    EXPECT_EQ(letters_of("@OF@.@@ @\xCE\xB1@O(2)"), (Letters{"@O", "F", "@.", "@@", "@\xCE\xB1", "@O(2)"}));
    expect_mistakes("axiom: F@\n", {{{1, 9}, "'@' is not a symbol by itself"}});
    expect_mistakes("axiom: F@ O\n", {{{1, 9}, "'@' is not a symbol by itself"}});
    expect_mistakes("axiom: @(1)\n", {{{1, 8}, "'@' is not a symbol by itself"}});
}

TEST(Words, TheLongestListedNameIsTaken) {
    const std::string keys = "symbols: ap apex apexes x1\n";
    EXPECT_EQ(letters_of("apexapapexesapexe", keys), (Letters{"apex", "ap", "apexes", "apex", "e"}));
    EXPECT_EQ(letters_of("a apx1x2", keys), (Letters{"a", "ap", "x1", "x", "2"}));
    EXPECT_EQ(letters_of("apex(2)ap(1,0.5)", keys), (Letters{"apex(2)", "ap(1,0.5)"}));
    EXPECT_EQ(grammar_of(keys + "axiom: x\n").names(), (Letters{"ap", "apex", "apexes", "x1"}));
    // For the whole file, wherever the key stands.
    EXPECT_EQ(derived_text("axiom: FlFr\nderivation length: 1\nFl --> Fr\nFr --> Fl+\nsymbols: Fl Fr\n"), "Fr Fl +");
}

TEST(Words, NamesAreLettersAndDigits) {
    expect_mistakes("axiom: F\nsymbols: Fl, Fr\n", {{{2, 12}, "not by commas"}});
    expect_mistakes("axiom: F\nsymbols: Fl 1a\n", {{{2, 13}, "expected a name of letters and digits"}});
    expect_mistakes("axiom: F\nsymbols: Fl a_b\n", {{{2, 13}, "expected a name of letters and digits"}});
    expect_mistakes("axiom: F\nsymbols: Fl Fr Fl\n", {{{2, 16}, "'Fl' is listed twice"}});
}

TEST(Words, CharactersThatAreNoSymbols) {
    expect_mistakes("axiom: F)\n", {{{1, 9}, "')' without '('"}});
    expect_mistakes("axiom: (2)F\n", {{{1, 8}, "'('"}});
    expect_mistakes("axiom: F (2)\n", {{{1, 10}, "unexpected blank"}});
    expect_mistakes("axiom: F<G\n", {{{1, 9}, "'<' is not a symbol"}});
    expect_mistakes("axiom: F>G\n", {{{1, 9}, "'>' is not a symbol"}});
    expect_mistakes("axiom: F:G\n", {{{1, 9}, "':' is not a symbol"}});
    expect_mistakes("axiom: F*G\n", {{{1, 9}, "'*' is the empty word"}});
    expect_mistakes("axiom: F\x01\n", {{{1, 9}, "control character"}});
    expect_mistakes("axiom: F\x7FG\n", {{{1, 9}, "control character"}});
    expect_mistakes("axiom: F\xC2\x85G\n", {{{1, 9}, "control character"}});
}

TEST(Words, LookalikesNameTheAsciiSign) {
    expect_mistakes("axiom: F\xE2\x88\x92G\n", {{{1, 9}, "write '-'"}});
    expect_mistakes("axiom: F\xE2\x88\xA7G\n", {{{1, 9}, "write '^'"}});
    expect_mistakes("axiom: F\xE2\x80\x99G\n", {{{1, 9}, "write '''"}});
    expect_mistakes("axiom: F\xE2\x86\x92G\n", {{{1, 9}, "write '-->'"}});
    expect_mistakes("axiom: F\nF --> F\xE2\x88\x92\n", {{{2, 8}, "write '-'"}});
    expect_mistakes("axiom: F\nF\xE2\x88\xA7 --> F\n", {{{2, 2}, "write '^'"}});
    expect_mistakes("axiom: F\n\xE2\x80\x99 < F --> F\n", {{{2, 1}, "write '''"}});
    expect_mistakes("axiom: F\nignore: +\xE2\x88\x92\n", {{{2, 10}, "write '-'"}});
    expect_mistakes("axiom: F\nF \xE2\x86\x92 F+F\n", {{{2, 3}, "write 'F --> F+F'"}});
}

TEST(Words, ConstantParametersAreRead) {
    const Grammar grammar = grammar_of("define r = 2\naxiom: F(2.5)F(5/2)F F(r^2, -1) A(.5,1e300,1e-300)\n");
    const Word& axiom = grammar.axiom();
    ASSERT_EQ(axiom.size(), 5u);
    EXPECT_EQ(axiom[0], axiom[1]);  // the same module with the same value
    EXPECT_NE(axiom[0], axiom[2]);
    EXPECT_EQ(grammar.symbols()[axiom[3]].arguments, (std::vector<double>{4, -1}));
    EXPECT_EQ(grammar.symbols()[axiom[4]].arguments, (std::vector<double>{0.5, 1e300, 1e-300}));
    EXPECT_EQ(grammar.symbols()[axiom[0]].letter_index, grammar.symbols()[axiom[2]].letter_index);
    EXPECT_EQ(grammar.letters(), (Letters{"F", "A"}));
    EXPECT_EQ(to_text(grammar, axiom), "F(2.5)F(2.5)FF(4,-1)A(0.5,1e+300,1e-300)");
    expect_mistakes("axiom: F(2\n", {{{1, 9}, "not closed"}});
    expect_mistakes("axiom: F()\n", {{{1, 10}, "expected a parameter"}});
    expect_mistakes("axiom: F(1,)\n", {{{1, 12}, "expected a parameter"}});
    expect_mistakes("axiom: F(x)\n", {{{1, 10}, "'x' is not defined"}});
    expect_mistakes("axiom: F(1+)\n", {{{1, 12}, "expected a number"}});
    expect_mistakes("axiom: F(n)\n", {{{1, 10}, "'n' is not defined"}});
}

TEST(Words, ModulesWithAndWithoutParametersDifferToProductions) {
    EXPECT_EQ(derived_text("axiom: FF(1)\nderivation length: 1\nF --> G\n"), "GF(1)");
}

TEST(Words, TheEmptyWordHasThreeSpellings) {
    for (const char* nothing : {"*", "\xCE\xB5", "", "  "}) {
        const std::string text = "axiom: FGF\nderivation length: 1\nF --> ";
        EXPECT_EQ(derived_text(text + nothing + "\n"), "G") << nothing;
    }
    expect_mistakes("axiom: F\n* --> F\n", {{{2, 1}, "cannot be a predecessor"}});
    expect_mistakes("axiom: F\n\xCE\xB5 --> F\n", {{{2, 1}, "cannot be a predecessor"}});
    expect_mistakes("axiom: F\nF --> F*\n", {{{2, 8}, "must stand alone"}});
}

// --- productions ---------------------------------------------------------------------------------------------------

TEST(Productions, AStarIsAnEmptyContext) {
    const Grammar grammar = grammar_of("axiom: F\nderivation length: 2\n* < F > * --> FF\n");
    EXPECT_TRUE(grammar.tables()[0].context_free());
    EXPECT_EQ(derived_text(grammar), "FFFF");
    expect_mistakes("axiom: F\nF > --> G\n", {{{2, 4}, "expected a context"}});
    expect_mistakes("axiom: F\n < F --> G\n", {{{2, 2}, "expected a context"}});
}

TEST(Productions, OnesThatCanNeverApplyAreErrors) {
    expect_mistakes("axiom: F\nF --> G\nF --> H\n", {{{3, 1}, "can never apply"}});
    expect_mistakes("axiom: F\nF --> G\n* < F > * --> H\n", {{{3, 5}, "can never apply"}});
    expect_mistakes("axiom: F\nA<F>B --> G\nA < F > B --> H\n", {{{3, 5}, "can never apply"}});
    expect_mistakes("axiom: F\nFG --> G\nF G --> H\n", {{{3, 1}, "can never apply"}});
    expect_mistakes("axiom: F\nF --> G\ntable t:\nF --> H\n", {{{4, 1}, "can never apply"}});
    expect_mistakes("axiom: F\ninterpret:\nF --> G\nF --> H\n", {{{4, 1}, "can never apply"}});
    EXPECT_TRUE(diagnostics_of("axiom: F\nA < F --> G\nF --> H\nB < F --> I\nF > A --> J\nFG --> K\n").empty());
    EXPECT_TRUE(diagnostics_of("axiom: F\nschedule: s*n\ntable t:\nF --> G\ntable s:\nF --> H\ninterpret:\nF --> I\n")
                    .empty());
}

TEST(Productions, InterpretationsReplaceSingleSymbols) {
    expect_mistakes("axiom: F\ninterpret:\nFG --> G\n", {{{3, 1}, "replaces one symbol"}});
    expect_mistakes("axiom: F\ninterpret:\nA < F --> G\n", {{{3, 5}, "replaces one symbol"}});
    const std::string text = "axiom: AB\nderivation length: 1\nA --> AB\ninterpret:\nA --> [F]\nB --> *\nF --> G\n";
    EXPECT_EQ(derived_text(text), "ABB");
    EXPECT_EQ(derived_text(text, true), "[F]");
}

TEST(Productions, ThePfgProgramsFilesAreReadAsTheyStand) {
    // Prusinkiewicz & Hanan 1989, figure 3.11a, as printed but for the line that the scan ran together.
    const Grammar grammar = grammar_of(
        "derivation length: 30\n"
        "angle factor: 16\n"
        "scale factor: 100\n"
        "axiom: F1F1F1\n"
        "ignore: +-F\n"
        "0 < 0 > 0 --> 0\n"
        "0 < 0 > 1 --> 1[+F1F1]\n"
        "0 < 1 > 0 --> 1\n"
        "0 < 1 > 1 --> 1\n"
        "1 < 0 > 0 --> 0\n"
        "1 < 0 > 1 --> 1F1\n"
        "1 < 1 > 0 --> 0\n"
        "1 < 1 > 1 --> 0\n"
        "* < + > * --> -\n"
        "* < - > * --> +\n");
    EXPECT_EQ(grammar.steps(), 30);
    EXPECT_EQ(grammar.scale_percent(), 100);
    EXPECT_EQ(reference::derived(grammar).size(), 6910u);
}

// --- keys ----------------------------------------------------------------------------------------------------------

TEST(Keys, NumbersHaveTheirLimits) {
    for (const char* bad : {"-1", "1.5", "x", "", "1 2", "1e3", "9223372036854775808", "0x1"}) {
        expect_mistakes("axiom: F\nderivation length: " + std::string(bad) + "\n",
                        {{{2, *bad ? 20 : 19}, "expected a whole number"}});
    }
    EXPECT_EQ(grammar_of("axiom: F\nderivation length: 9223372036854775807\n").steps(), INT64_MAX);
    EXPECT_EQ(grammar_of("axiom: F\n").steps(), 0);
    for (const char* bad : {"0", "-1", "100.1", "x", "nan"}) {
        expect_mistakes("axiom: F\nscale factor: " + std::string(bad) + "\n", {{{2, 15}, "percentage"}});
    }
    EXPECT_EQ(grammar_of("axiom: F\nscale factor: 62.5\n").scale_percent(), 62.5);
    EXPECT_EQ(grammar_of("axiom: F\n").scale_percent(), 100);
    expect_mistakes("axiom: F\nseed: -1\n", {{{2, 7}, "whole number"}});
    EXPECT_TRUE(diagnostics_of("axiom: F\nseed: 42\n").empty());
}

TEST(Keys, AnglesAreExactFractions) {
    struct Case {
        std::string keys;
        double degrees;
        std::int64_t numerator, denominator;
    };
    for (const Case& expected : {Case{"", 90, 1, 4},
                                 {"angle factor: 1\n", 360, 0, 1},
                                 {"angle factor: 7\n", 360.0 / 7, 1, 7},
                                 {"angle factor: 1000003\n", 360.0 / 1000003, 1, 1000003},
                                 {"angle increment: 25.7\n", 25.7, 257, 3600},
                                 {"angle increment: 360/7\n", 360.0 / 7, 1, 7},
                                 {"angle increment: -45\n", -45, -1, 8},
                                 {"angle increment: 0\n", 0, 0, 1},
                                 {"angle increment: +22.50\n", 22.5, 1, 16},
                                 {"angle increment: 137.508\n", 137.508, 11459, 30000},
                                 {"angle increment: 360/-7\n", -360.0 / 7, -1, 7},
                                 {"angle increment: 12.5/2.5\n", 5, 1, 72},
                                 {"angle increment: 9e1\n", 90, 1, 4},
                                 {"angle increment: 900e-1\n", 90, 1, 4},
                                 {"angle increment: .5\n", 0.5, 1, 720}}) {
        const Angle angle = command("+", 0, expected.keys + "turn: left\n").angle;
        EXPECT_DOUBLE_EQ(angle.degrees, expected.degrees) << expected.keys;
        ASSERT_TRUE(angle.exact) << expected.keys;
        EXPECT_EQ(angle.exact->denominator, expected.denominator) << expected.keys;
        EXPECT_EQ((angle.exact->numerator - expected.numerator) % angle.exact->denominator, 0) << expected.keys;
    }
    const Angle irrational = command("+", 0, "angle increment: 1.23456789012345678\nturn: left\n").angle;
    EXPECT_FALSE(irrational.exact);
    EXPECT_DOUBLE_EQ(irrational.degrees, 1.23456789012345678);
    const double huge = command("+", 0, "angle increment: 1e300\nturn: left\n").angle.degrees;
    EXPECT_EQ(std::fmod(huge, 360), std::fmod(1e300, 360));
}

TEST(Keys, AnglesThatAreNone) {
    for (const char* bad : {"0", "-4"}) {
        const auto found = diagnostics_of("axiom: F\nangle factor: " + std::string(bad) + "\n");
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].where, (Place{2, 15}));
    }
    for (const char* bad :
         {"x", "1/0", "1/2/3", "inf", "nan", "1e400", "1/", "/2", "3/2abc", "+-5", "1e-300/1e300e"}) {
        expect_mistakes("axiom: F\nangle increment: " + std::string(bad) + "\n", {{{2, 18}, "expected degrees"}});
        expect_mistakes("axiom: F\nheading: " + std::string(bad) + "\n", {{{2, 10}, "expected degrees"}});
    }
    expect_mistakes("axiom: F\nangle increment: 60\nangle factor: 6\n", {{{3, 1}, "exclude each other"}});
    expect_mistakes("axiom: F\nturn: up\n", {{{2, 7}, "expected 'left' or 'right'"}});
}

TEST(Keys, LongExponentsAreReadAtOnce) {
    const auto begin = std::chrono::steady_clock::now();
    for (const char* angle : {"0e2000000000", "0e-2000000000", "1e-2000000000", "0.0e2147483647"}) {
        diagnostics_of("axiom: +(" + std::string(angle) + ")\nangle increment: " + angle + "\nheading: " + angle +
                       "\n");
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST(Keys, PlusTurnsRightUnlessTold) {
    for (const auto& [keys, sign] : {std::pair{"", -1.0}, {"turn: right\n", -1.0}, {"turn: left\n", 1.0}}) {
        EXPECT_EQ(command("+-|", 0, keys).angle.degrees, sign * 90);
        EXPECT_EQ(command("+-|", 1, keys).angle.degrees, -sign * 90);
        EXPECT_EQ(command("+(30)-(30)", 0, keys).angle.degrees, sign * 30);
        EXPECT_EQ(command("+(30)-(30)", 1, keys).angle.degrees, -sign * 30);
        EXPECT_EQ(std::fabs(command("+-|", 2, keys).angle.degrees), 180);
    }
    const Angle angle = command("-(25.7)").angle;
    EXPECT_EQ(angle.exact->numerator, 257);
    EXPECT_EQ(angle.exact->denominator, 3600);
}

TEST(Keys, HeadingIsUpUnlessTold) {
    EXPECT_EQ(grammar_of("axiom: F\n").heading().degrees, 90);
    const Grammar grammar = grammar_of("axiom: F\nheading: -360/8\n");
    EXPECT_EQ(grammar.heading().degrees, -45);
    EXPECT_EQ(grammar.heading().exact->denominator, 8);
}

TEST(Keys, SymbolsThatMoveAreReplaced) {
    EXPECT_EQ(command("F").action, Action::draw);
    EXPECT_EQ(command("f").action, Action::move);
    EXPECT_EQ(command("X").action, Action::pass);
    EXPECT_EQ(command("F(2.5)").value, 2.5);
    EXPECT_EQ(command("F").value, 1);
    const std::string keys = "symbols: Fl Fr\nforward: Fl X Fr\nmove: g h\n";
    for (const auto& [word, action] : {std::pair{"Fl", Action::draw},
                                       {"Fr", Action::draw},
                                       {"X", Action::draw},
                                       {"X(2)", Action::draw},
                                       {"F", Action::pass},
                                       {"f", Action::pass},
                                       {"g", Action::move},
                                       {"h(3)", Action::move}}) {
        EXPECT_EQ(command(word, 0, keys).action, action) << word;
    }
    EXPECT_EQ(command("F", 0, "forward:\n").action, Action::pass);
    expect_mistakes("axiom: F\nforward: F,G\n", {{{2, 11}, "not by commas"}});
    expect_mistakes("axiom: F\nforward: FG\nmove: gG\n", {{{3, 7}, "both 'forward:' and 'move:'"}});
}

TEST(Keys, TurtleSymbolsMeanWhatTheLanguageSays) {
    struct Case {
        std::string word;
        Action action;
        double value;
    };
    for (const Case& expected : {Case{"[", Action::push, 0},
                                 {"]", Action::pop, 0},
                                 {"{", Action::polygon_begin, 0},
                                 {"}", Action::polygon_end, 0},
                                 {"#", Action::width_factor, 1.25},
                                 {"!", Action::width_factor, 0.8},
                                 {"#(2)", Action::width_set, 2},
                                 {"!(0.5)", Action::width_set, 0.5},
                                 {"'", Action::colour_step, 1},
                                 {";", Action::colour_step, 1},
                                 {",", Action::colour_step, -1},
                                 {";(3)", Action::colour_set, 3},
                                 {",(4)", Action::colour_set, 4},
                                 {"'(5)", Action::colour_set, 5},
                                 {"@O(2)", Action::disc, 2},
                                 {"@.", Action::disc, 0},
                                 {"&", Action::pitch, 0},
                                 {"^", Action::pitch, 0},
                                 {"\\F", Action::roll, 0},
                                 {"/", Action::roll, 0},
                                 {"$", Action::level, 0},
                                 {"@x", Action::pass, 0},
                                 {"A", Action::pass, 0}}) {
        EXPECT_EQ(command(expected.word).action, expected.action) << expected.word;
        EXPECT_EQ(command(expected.word).value, expected.value) << expected.word;
    }
}

TEST(Keys, IgnoreAndConsiderExcludeEachOther) {
    expect_mistakes("axiom: F\nignore: +\nconsider: F\n", {{{3, 1}, "exclude each other"}});
    expect_mistakes("axiom: F\nignore: +, -\n", {{{2, 10}, "not by commas"}});
    expect_mistakes("axiom: F\nconsider: A,B\n", {{{2, 12}, "not by commas"}});
    const Grammar ignoring = grammar_of("axiom: F + - F(2) [ ]\nignore: + F\n");
    const Grammar considering = grammar_of("axiom: F + - F(2) [ ]\nconsider: + F\n");
    const std::vector<bool> ignored = {true, true, false, true, false, false};
    const std::vector<bool> not_considered = {false, false, true, false, false, false};
    for (std::size_t i = 0; i < ignored.size(); ++i) {
        EXPECT_EQ(ignoring.ignored(ignoring.axiom()[i]), ignored[i]) << i;
        EXPECT_EQ(considering.ignored(considering.axiom()[i]), not_considered[i]) << i;
    }
}

// --- defines -------------------------------------------------------------------------------------------------------

TEST(Defines, AreEvaluatedInAnyOrder) {
    const std::string text =
        "axiom: A(a, b, c)\ndefine a = b + c\ndefine c = b * 2\n#define b (1 + d)\ndefine d = 4\n";
    const Grammar grammar = grammar_of(text);
    EXPECT_EQ(to_text(grammar, grammar.axiom()), "A(15,5,10)");
    const Grammar set = grammar_of(text, {{"--set", "d", "0"}});
    EXPECT_EQ(to_text(set, set.axiom()), "A(3,1,2)");
    const Grammar greek = grammar_of("axiom: A(\xCE\xB1_1)\ndefine \xCE\xB1_1 = 2\n");
    EXPECT_EQ(to_text(greek, greek.axiom()), "A(2)");
    EXPECT_EQ(axiom_text("A(e1+1e1)", "define e1 = 5\n"), "A(15)");
}

TEST(Defines, MistakesAreToldOnce) {
    expect_mistakes("axiom: A(a, a)\ndefine a = 1 +\n", {{{2, 15}, "expected a number"}});
    expect_mistakes("axiom: A\ndefine 1a = 1\n", {{{2, 8}, "not begin with a digit"}});
    expect_mistakes("axiom: A\ndefine a-b = 1\n", {{{2, 8}, "letters, digits"}});
    expect_mistakes("axiom: A\ndefine a = b\n", {{{2, 12}, "'b' is not defined"}});
    expect_mistakes("axiom: A\ndefine a = a + 1\n", {{{2, 8}, "refers to itself"}});
    for (const char* cycle : {"define a = b\ndefine b = a\n", "define a = b\ndefine b = c\ndefine c = a\n",
                              "define a = b + c\ndefine b = 1\ndefine c = a + b\n"}) {
        const auto found = diagnostics_of("axiom: A\n" + std::string(cycle));
        ASSERT_FALSE(found.empty());
        for (const Diagnostic& diagnostic : found) {
            EXPECT_TRUE(has(diagnostic.message, "refers to itself")) << diagnostic.text();
            EXPECT_EQ(diagnostic.where.column, 8);
        }
    }
    // A long chain costs no call stack.
    std::string chain = "axiom: A(x0)\n";
    for (int i = 0; i < 20'000; ++i) {
        chain += "define x" + std::to_string(i) + " = x" + std::to_string(i + 1) + " + 1\n";
    }
    const Grammar grammar = grammar_of(chain + "define x20000 = 0\n");
    EXPECT_EQ(to_text(grammar, grammar.axiom()), "A(20000)");
}

// --- tables and their schedule -------------------------------------------------------------------------------------

std::string schedule_of(const std::string& schedule, int n, const std::string& more = "") {
    const Grammar grammar =
        grammar_of("axiom: F\n" + more + "schedule: " + schedule + "\nderivation length: " + std::to_string(n) +
                   "\ntable a:\nF --> FA\ntable b:\nF --> FB\ntable c:\nF --> FC\n");
    std::string text;
    std::int64_t sum = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        text += std::string(static_cast<std::size_t>(run.steps), "abc"[run.table]);
        sum += run.steps;
    }
    EXPECT_EQ(sum, grammar.steps());
    return text;
}

TEST(Schedule, CountsStepsOfTables) {
    EXPECT_EQ(schedule_of("a*2 b c*3", 6), "aabccc");
    EXPECT_EQ(schedule_of("a*(n-2) b*2", 6), "aaaabb");
    EXPECT_EQ(schedule_of("a*2 a b", 4), "aaab");
    EXPECT_EQ(schedule_of("a*k b*(n-k)", 5, "define k = 2\n"), "aabbb");
    EXPECT_EQ(schedule_of("a * 2   b*( n - 2 )", 3), "aab");
    EXPECT_EQ(schedule_of("a*(n/2) b*(n - floor(n/2))", 5), "aabbb");  // rounded down
    EXPECT_EQ(schedule_of("a*n", 3), "aaa");
    EXPECT_EQ(schedule_of("a*(1/0) b", 3), "aab");
    EXPECT_EQ(schedule_of("b", 0), "");
}

TEST(Schedule, IsCutAtTheFront) {
    EXPECT_EQ(schedule_of("a*2 b*2 c*2", 3), "bcc");
    EXPECT_EQ(schedule_of("a*(n-2) b*2", 1), "b");  // negative counts are 0
    EXPECT_EQ(schedule_of("a*(n-2) b*2", 0), "");
    EXPECT_EQ(schedule_of("a*9223372036854775807 b", 2), "ab");
}

TEST(Schedule, ShorterThanTheDerivationIsAnError) {
    const std::string tables = "table a:\nF --> FA\ntable b:\nF --> FB\n";
    expect_mistakes("axiom: F\nderivation length: 4\nschedule: a*2 b\n" + tables, {{{3, 11}, "has 3 steps"}});
    expect_mistakes("axiom: F\nderivation length: 4\nschedule: a*(n-5) b*3\n" + tables, {{{3, 11}, "has 3 steps"}});
    expect_mistakes("axiom: F\nderivation length: 1\nschedule: a*(0/0)\n" + tables, {{{3, 11}, "not a number"}});
    const Grammar grammar = grammar_of("axiom: F\nderivation length: 3\nschedule: a*2 b\n" + tables);
    EXPECT_FALSE(grammar.with_steps(4));
    EXPECT_EQ(derived_text(grammar.with_steps(2).value()), "FBA");
}

TEST(Schedule, MistakesNameTheirPlace) {
    const std::string tables = "table grow:\nF --> FA\ntable rest:\nF --> FB\n";
    const auto expect = [&](const std::string& schedule, int column, const std::string& essence) {
        expect_mistakes("axiom: F\nschedule: " + schedule + "\n" + tables, {{{2, column}, essence}});
    };
    expect("grow*2 grwo", 18, "did you mean 'grow'?");
    expect("grow*2 zzzzzz", 18, "unknown table 'zzzzzz'");
    expect("grow*", 16, "expected a whole number");
    expect("grow*-1", 16, "expected a whole number");
    expect("grow*1.5", 16, "expected a whole number");
    expect("grow*k", 16, "'k' is not defined");
    expect("grow*(n", 16, "not closed");
    expect("*2", 11, "expected the name of a table");
    expect_mistakes("axiom: F\nschedule:\n" + tables, {{{2, 1}, "schedule is empty"}});
    expect_mistakes("axiom: F\n" + tables, {{{4, 7}, "several tables need a 'schedule:'"}});
}

TEST(Schedule, OneTableIsAppliedInEveryStep) {
    EXPECT_EQ(derived_text("axiom: F\nderivation length: 3\ntable a:\nF --> FA\n"), "FAAA");
}

TEST(Schedule, ProductionsBeforeTheFirstTableBelongToEveryTable) {
    EXPECT_EQ(derived_text("axiom: FG\nderivation length: 2\nG --> GG\nschedule: a b\n"
                           "table a:\nF --> A\ntable b:\nA --> B\ninterpret:\nB --> C\n"),
              "BGGGG");
    // `interpret:` ends a table, and a table ends `interpret:`.
    EXPECT_EQ(derived_text("axiom: FG\nderivation length: 1\ninterpret:\nF --> X\ntable a:\nG --> H\n", true), "XH");
}

// --- printing ------------------------------------------------------------------------------------------------------

TEST(Printing, BlanksStandOnlyWhereSymbolsWouldRunTogether) {
    EXPECT_EQ(axiom_text("F + F [ - F ] F"), "F+F[-F]F");
    EXPECT_EQ(axiom_text("apex apex leaf F + apex + F", "symbols: apex leaf\n"), "apex apex leaf F+ apex +F");
    EXPECT_EQ(axiom_text("a p e x", "symbols: apex\n"), "a pex");
    EXPECT_EQ(axiom_text("a p a b a(1) p", "symbols: apex\n"), "a paba(1)p");
    EXPECT_EQ(axiom_text("x 1 1 x", "symbols: x1\n"), "x 11x");
    EXPECT_EQ(axiom_text("@O F @. F @O(2)"), "@OF@.F@O(2)");
    EXPECT_EQ(axiom_text("F(1) F(0.1) F(1/3) F(-0) F(1e21)"), "F(1)F(0.1)F(0.3333333333333333)F(-0)F(1e+21)");
    EXPECT_EQ(axiom_text("A B", "symbols: A B\n"), "AB");  // no names of several characters
}

TEST(Printing, ReadsBackAsTheSameWord) {
    const std::string keys = "symbols: ab abc bc1 c\n";
    const std::vector<std::string> symbols = {"a",   "b",    "c",      "1",        "d",        "ab", "abc",
                                              "bc1", "F(2)", "F(0.1)", "F(-1e-9)", "@O",       "@a", "@@",
                                              "+",   "/",    "\\",     "abc(1,2)", "\xCE\xB1", ".",  "~"};
    for (unsigned seed = 0; seed < 1000; ++seed) {
        reference::Dice dice(seed);
        std::string axiom = "F";
        for (std::size_t i = 0; i < 8; ++i) axiom += " " + symbols[dice.below(symbols.size())];
        const Grammar grammar = grammar_of(keys + "axiom: " + axiom + " F\n");
        const std::string printed = to_text(grammar, grammar.axiom());
        const Grammar again = grammar_of(keys + "axiom: " + printed + "\n");
        EXPECT_EQ(reference::tokens_of(again, again.axiom()), reference::tokens_of(grammar, grammar.axiom()))
            << printed;
        EXPECT_FALSE(printed.starts_with(' ') || printed.ends_with(' '));
    }
}

TEST(Printing, ParametersReadBackToTheLastBit) {
    reference::Dice dice(1);
    for (int i = 0; i < 1000; ++i) {
        const double value =
            std::ldexp(static_cast<double>(dice.below(1U << 31)) - 1e9, static_cast<int>(dice.below(1000)) - 500);
        const Grammar grammar = grammar_of("axiom: A(" + std::to_string(dice.below(9)) + ")\n",
                                           {{"--set", "axiom", symbol_text({"A", {value}, false, 0, {}})}});
        EXPECT_EQ(grammar.symbols()[grammar.axiom()[0]].arguments.at(0), value);
    }
    // What is no number is printed as what gives it.
    EXPECT_EQ(axiom_text("A(10^400)"), "A(1/0)");
    EXPECT_EQ(axiom_text("A(-1/0,1)"), "A(-1/0,1)");
    EXPECT_EQ(axiom_text("A(0/0)"), "A(0/0)");
}

TEST(Grammar, ReachableSymbolsAreThoseTheAxiomLeadsTo) {
    const Grammar grammar = grammar_of("axiom: A\nA --> B\nB --> C\nX --> Y\nC --> [D]\ninterpret:\nD --> F\n");
    const auto reached = grammar.reachable();
    std::string letters;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (reached[i]) letters += grammar.symbols()[i].letter;
    }
    std::sort(letters.begin(), letters.end());
    EXPECT_EQ(letters, "ABCDF[]");
}

TEST(Grammar, KnowsTheLastStepThatNeedsWholeWords) {
    const std::string tables = "table free:\nF --> FA\ntable bound:\nA < F --> B\ntable words:\nAB --> C\n";
    const auto steps = [&](const std::string& schedule, int n) {
        return grammar_of("axiom: F\nderivation length: " + std::to_string(n) + "\nschedule: " + schedule + "\n" +
                          tables)
            .whole_word_steps();
    };
    EXPECT_EQ(steps("free*5", 5), 0);
    EXPECT_EQ(steps("free*2 bound free*2", 5), 3);
    EXPECT_EQ(steps("words free*2 bound", 4), 4);
    EXPECT_EQ(steps("words free*n", 4), 0);
}

}  // namespace sikku::grammar_test
