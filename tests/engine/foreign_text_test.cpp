// tests/engine/foreign_text_test.cpp: errors about lines from other programs and the literature show the line in
// the pattern language; texts of other programs are recognised.
#include "engine/language/foreign_text.h"

#include "engine/language/foreign_line.h"
#include "engine/language/grammar.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

namespace sikku::foreign_text_test {

using reference::diagnostics_of;
using reference::expect_mistakes;

std::vector<std::string> advice(const std::string& line, bool has_axiom = false) {
    return advice_for_line(line, has_axiom).lines;
}

/// The messages for a line of a pattern that is complete without it.
std::string answer(const std::string& line) {
    std::string text;
    for (const Diagnostic& one : diagnostics_of("axiom: F\n" + line + "\n")) text += one.message + '\n';
    return text;
}

TEST(ForeignLine, ArrowsOfOtherNotationsBecomeThatOfPatterns) {
    for (const char* line : {"X → F+X",
                             "X -> F+X",
                             "X => F+X",
                             "X –> F+X",
                             "X —> F+X",
                             "X --&gt; F+X",
                             "X -&gt; F+X",
                             "X ⟶ F+X",
                             "X ⇒ F+X",
                             "X ::= F+X",
                             "X := F+X",
                             "(X --> F+X)",
                             "( X → F+X )",
                             "X = F+X",
                             "X=F+X",
                             "X: F+X",
                             "X : \"F+X\"",
                             "X: 'F+X',",
                             "\"X\": \"F+X\",",
                             "'X' => 'F+X'",
                             "rule: X → F+X",
                             "rule1: X → F+X",
                             "p1 : X → F+X",
                             "p_2: X -> F+X",
                             "- X: F+X",
                             "rules[0] = X -> F+X",
                             "rules[\"X\"] = \"F+X\";",
                             "{ a: \"X\", b: \"F+X\" }",
                             "(\"X\", \"F+X\")",
                             "addRule('X', 'F+X');",
                             "setProduction(\"X\", \"F+X\")"}) {
        EXPECT_EQ(advice(line), std::vector<std::string>{"X --> F+X"}) << line;
        EXPECT_TRUE(has(answer(line), "write 'X --> F+X'")) << line << '\n' << answer(line);
    }
    EXPECT_EQ(answer("X → F+X"), "'→' is not the arrow of a production; write 'X --> F+X'\n");
    EXPECT_EQ(answer("X=F+X"), "expected 'key: value' or a production with '-->'; write 'X --> F+X'\n");
    EXPECT_EQ(answer("X: F+X"), "unknown key 'X'; write 'X --> F+X'\n");
    // Typographic signs are replaced like the arrow; contexts and parameters remain.
    EXPECT_EQ(advice("X → F−[[X]+X]"), std::vector<std::string>{"X --> F-[[X]+X]"});
    EXPECT_EQ(advice("A < B(x) > C : x > 2 → B(x/2)"), std::vector<std::string>{"A < B(x) > C : x > 2 --> B(x/2)"});
    EXPECT_EQ(advice("F → "), std::vector<std::string>{"F --> *"});
}

TEST(ForeignLine, AxiomsOfOtherNotations) {
    for (const char* line :
         {"axiom = X", "axiom → X", "ω : X", "ω: X", "w : X", "axiom: \"X\",", "\"axiom\": \"X\",",
          "var axiom = \"X\";", "const axiom = 'X'", "start = X", "premise = X", "initiator: X", "setAxiom('X')"}) {
        EXPECT_EQ(advice(line), std::vector<std::string>{"axiom: X"}) << line;
    }
    // Where the axiom is known, w is a symbol.
    EXPECT_EQ(advice("w : X", true), std::vector<std::string>{"w --> X"});
}

TEST(ForeignLine, AnAxiomInAnotherNotationIsNotMissing) {
    expect_mistakes("start: X\nX --> F\n", {{{1, 1}, "'start:' delays a part of a score; write 'axiom: X'"}});
    expect_mistakes("axiom = X\nX --> F\n", {{{1, 1}, "write 'axiom: X'"}});
    expect_mistakes("ω : F\nF --> FF\n", {{{1, 1}, "unknown key 'ω'; write 'axiom: F'"}});
    expect_mistakes("start: 2\nX --> F\n", {{{1, 1}, "'axiom:' is missing"}});
    EXPECT_TRUE(diagnostics_of("axiom: X\nstart: 2\n").empty());
}

TEST(ForeignLine, KeysOfOtherPrograms) {
    const std::vector<std::pair<std::string, std::string>> rows = {
        {"angle = 25", "angle increment: 25"},
        {"angle: 25°", "angle increment: 25"},
        {"angle: 25 degrees", "angle increment: 25"},
        {"δ=25.7°", "angle increment: 25.7"},
        {"angle = radians(25);", "angle increment: 25"},
        {"iterations: 5", "derivation length: 5"},
        {"iters: 6", "derivation length: 6"},
        {"Order: 4", "derivation length: 4"},
        {"generations = 7", "derivation length: 7"},
        {"n = 5", "derivation length: 5"},
        {"let depth = 5;", "derivation length: 5"},
        {"\"angle\": 90,", "angle increment: 90"},
    };
    for (const auto& [line, expected] : rows) {
        EXPECT_EQ(advice(line), std::vector<std::string>{expected}) << line;
        EXPECT_TRUE(has(answer(line), "write '" + expected + "'"));
    }
    EXPECT_EQ(answer("iterations: 5"), "unknown key 'iterations'; write 'derivation length: 5'\n");
    EXPECT_EQ(answer("angle increment: 25°"), "degrees are a plain number; write 'angle increment: 25'\n");
    EXPECT_EQ(answer("heading: 90 degrees"), "degrees are a plain number; write 'heading: 90'\n");
    EXPECT_TRUE(has(answer("angle increment: wide"), "expected degrees"));
    // Advice does not repeat a value that is not understood.
    EXPECT_EQ(answer("angle: PI/6"), "unknown key 'angle'; did you mean 'angle increment'?\n");
    EXPECT_EQ(answer("angel: 25"), "unknown key 'angel'; did you mean 'angle increment'?\n");
    EXPECT_EQ(answer("length factor = 1.36"),
              "expected 'key: value' or a production with '-->'; leave this line out; a step takes its length as a "
              "parameter: F(x) --> F(1.36*x)\n");
    EXPECT_EQ(answer("iteration count: 5"), "unknown key 'iteration count'\n");
}

TEST(ForeignLine, ListsAreSplit) {
    EXPECT_EQ(advice("rules  : (X → F+[[X]−X]), (F → FF)"),
              (std::vector<std::string>{"X --> F+[[X]-X]", "F --> FF"}));
    EXPECT_EQ(advice("n=5, δ=25.7°"), (std::vector<std::string>{"derivation length: 5", "angle increment: 25.7"}));
    EXPECT_EQ(advice("rules = {\"X\": \"F+X\", \"F\": \"FF\"}"), (std::vector<std::string>{"X --> F+X", "F --> FF"}));
    EXPECT_EQ(advice("rules: F=FF; X=F[+X]"), (std::vector<std::string>{"F --> FF", "X --> F[+X]"}));
    EXPECT_EQ(advice("{\"axiom\": \"F\", \"rules\": {\"F\": \"F+F\"}, \"angle\": 90}"),
              (std::vector<std::string>{"axiom: F", "F --> F+F", "angle increment: 90"}));
    EXPECT_EQ(answer("rules: (A → AB), (B → A)"),
              "unknown key 'rules'; write each in its own line: 'A --> AB', 'B --> A'\n");
}

TEST(ForeignLine, NeedlessLinesAreLeftOut) {
    for (const char* line : {"variables: X F", "constants : + − [ ]", "alphabet: A, B",
                             "rules:", "config:", "step = 5", "rules = {", "production:"}) {
        EXPECT_TRUE(has(answer(line), "leave this line out")) << line << '\n' << answer(line);
    }
}

TEST(ForeignLine, WholePagesAreReportedLineByLine) {
    // As encyclopedias print a plant.
    expect_mistakes(
        "variables : X F\nconstants : + − [ ]\nstart  : X\nrules  : (X → F+[[X]−X]), (F → FF)\nangle  : 25°\n",
        {{{1, 1}, "leave this line out"},
         {{2, 1}, "leave this line out"},
         {{3, 1}, "write 'axiom: X'"},
         {{4, 1}, "'X --> F+[[X]-X]', 'F --> FF'"},
         {{5, 1}, "write 'angle increment: 25'"}});
    // As Prusinkiewicz and Lindenmayer print theirs.
    expect_mistakes("n=5, δ=25.7°\nω : F\np1 : F → F[+F]F[−F]F\n",
                    {{{1, 1}, "'derivation length: 5', 'angle increment: 25.7'"},
                     {{2, 1}, "write 'axiom: F'"},
                     {{3, 8}, "write 'F --> F[+F]F[-F]F'"}});
    // A program's object: brackets alone in a line are not errors of their own.
    expect_mistakes("{\n  \"axiom\": \"F\",\n  \"rules\": {\n    \"F\": \"F+F\"\n  }\n}\n",
                    {{{2, 3}, "write 'axiom: F'"}, {{3, 3}, "leave this line out"}, {{4, 5}, "write 'F --> F+F'"}});
    // Settings in sections.
    expect_mistakes("[L-System]\nname=Plant\naxiom=G\nangle=26\nrule0=G>GX[+G]\niterations=6\n",
                    {{{2, 1}, "write 'title: Plant'"},
                     {{3, 1}, "write 'axiom: G'"},
                     {{4, 1}, "write 'angle increment: 26'"},
                     {{5, 1}, "write 'G --> GX[+G]'"},
                     {{6, 1}, "write 'derivation length: 6'"}});
    expect_mistakes(
        "export const bush = {\n    axiom: \"X\",\n    rules: {\n        \"X\": \"F[+X]FX\",\n    },\n    angle: "
        "30\n}\n",
        {{{2, 12}, "quotation marks"},
         {{3, 5}, "leave this line out"},
         {{4, 9}, "write 'X --> F[+X]FX'"},
         {{6, 5}, "write 'angle increment: 30'"}});
    // Following the advice yields a pattern.
    for (const char* text : {"axiom: X\nX --> F+[[X]-X]\nF --> FF\nangle increment: 25\n",
                             "derivation length: 5\nangle increment: 25.7\naxiom: F\nF --> F[+F]F[-F]F\n"}) {
        EXPECT_TRUE(diagnostics_of(text).empty());
    }
}

TEST(ForeignLine, NamesOfProductionsAreNotPredecessors) {
    expect_mistakes("axiom: F\np1 : F --> FF\n", {{{2, 1}, "write 'F --> FF'"}});
    expect_mistakes("axiom: F(1)\np1 : F(x) : x > 2 --> F(x)\n", {{{2, 1}, "write 'F(x) : x > 2 --> F(x)'"}});
    expect_mistakes("axiom: F\nF ---> FF\n", {{{2, 3}, "expected '-->'"}});
    // Symbols with names and conditions on defines are unaffected.
    EXPECT_TRUE(diagnostics_of("axiom: p1\nsymbols: p1\ndefine c = 1\np1 : c --> F\n").empty());
    EXPECT_TRUE(diagnostics_of("axiom: A1\nA1 : random(0, 1) < 0.5 --> F\n").empty());
    EXPECT_TRUE(diagnostics_of("axiom: +-\n- --> F\n-F --> F-\n").empty());
}

TEST(ForeignLine, AnUnrecognisedTextIsReportedOnce) {
    std::string prose = "# A project\n\nIt draws: curves.\n";
    for (int i = 0; i < 40; ++i) prose += "Some prose about curves and more prose.\n";
    expect_mistakes(prose, {{{1, 1}, "this text is not a pattern"}});
    expect_mistakes("axiom: F\n" + prose, {{{2, 1}, "this text is not a pattern"}});
    // Without an axiom most lines suffice, and what was said about others is left out.
    expect_mistakes("# A project\n\nIt draws curves.\nThey are long.\n\nAnd loud.\n<img src=\"a.png\">\nF -> FF\n",
                    {{{1, 1}, "this text is not a pattern"}});
    expect_mistakes("F --> FF\nwhat is this\n", {{{1, 1}, "'axiom:' is missing"}, {{2, 1}, "expected 'key: value'"}});
    // One strange line in a pattern is one error in its place.
    expect_mistakes("axiom: F\nF --> FF\nwhat is this\n", {{{3, 1}, "expected 'key: value'"}});
}

TEST(ForeignLine, NumbersOfItemsAreNotPartsOfProductions) {
    for (const char* line : {"1. X -> F+X", "2) X → F+X", "(3) X = F+X", "1. X --> F+X", "12. X: F+X", "1) X --> F+X",
                             "1: X --> F+X", "1: X -> F+X", "• X → F+X", "rule: 1. X → F+X"}) {
        const std::string message = answer(line);
        EXPECT_TRUE(has(message, "write 'X --> F+X'")) << line << '\n' << message;
    }
    expect_mistakes("axiom: F\n1. F --> F+F\n",
                    {{{2, 1}, "'1.' is not a predecessor: productions have no numbers; write 'F --> F+F'"}});
    EXPECT_EQ(advice("1. axiom: X"), std::vector<std::string>{"axiom: X"});
    // Names of productions, and the condition of the literature that always holds.
    expect_mistakes("axiom: A\np3 : A < A > A : * --> AA\n",
                    {{{2, 1}, "'p3:' is not a predecessor: productions have no names; write 'A < A > A --> AA'"}});
    expect_mistakes("axiom: A(1,2)\nA(l,w) : * --> F(l)A(l,w)\n",
                    {{{2, 10},
                      "'*' is not a condition: without one, a production always applies; write 'A(l,w) --> "
                      "F(l)A(l,w)'"}});
    // Digits are symbols.
    for (const char* line : {"1 --> 11", "0 < 1 > 0 --> 1", "1.F --> F", "11 --> 1"}) EXPECT_EQ(answer(line), "");
    EXPECT_TRUE(diagnostics_of("axiom: 1\ndefine c = 1\n1 : c --> F\n").empty());
}

TEST(ForeignLine, DoubleSignsAreThoseOfProductions) {
    for (const char* line : {"X :: F+X", "X == F+X", "X : : F+X"}) {
        EXPECT_EQ(advice(line), std::vector<std::string>{"X --> F+X"}) << line;
    }
}

TEST(ForeignLine, WhatIsOfferedIsAccepted) {
    // Lines as people paste them: none of the advice may be refused in its turn.
    for (const char* line : {"F -> >F<",
                             "F = >F<",
                             "F :: F+F",
                             "F :: >F",
                             "F → F(",
                             "F → F)",
                             "F -> F -> G",
                             "F -> F --> G",
                             "F → F*F",
                             "A(x) : x >> 1 → B(x)",
                             "A(x) → B(x+)",
                             "axiom = <F>",
                             "start: F(",
                             "X → F : y",
                             "rules: (F → >F<), (G → FF)",
                             "F: <b>F</b>",
                             "F < G > → F",
                             "< F → F",
                             "F > → G",
                             "a -> b: c",
                             "F = F = F",
                             "<img src=\"a.png\" width=\"2\">",
                             "rules = {\"F\": \"F:F\", \"G\": \"GG\"}",
                             "(\"F\", \"F+(F\")",
                             "1. F -> F->F",
                             "| F → FF | F |"}) {
        for (const std::string& offered : advice(line)) {
            const std::string begin = offered.starts_with("axiom:") ? "" : "axiom: F\n";
            for (const Diagnostic& one : diagnostics_of(begin + offered + "\n")) {
                EXPECT_TRUE(one.warning) << line << " | " << offered << " | " << one.message;
            }
        }
    }
    EXPECT_EQ(
        answer("F -> >F<"),
        "'->' is not the arrow of a production; '>' is not a symbol; branches stand in [ ], and a step takes its "
        "length as a parameter: F(1.36*x)\n");
    EXPECT_FALSE(has(answer("F = >F<"), "write"));
    EXPECT_FALSE(has(answer("<img src=\"a.png\" width=\"2\">"), "write"));
    // The valid items of a list are offered; names that other lines may define are accepted.
    EXPECT_EQ(advice("rules: (F → >F<), (G → FF)"), std::vector<std::string>{"G --> FF"});
    EXPECT_TRUE(has(answer("rules: (F → >F<), (G → FF)"), "'>' is not a symbol"));
    EXPECT_EQ(advice("A(x) : x > K → B(x/R)"), std::vector<std::string>{"A(x) : x > K --> B(x/R)"});
    // An axiom with errors is not missing, too.
    EXPECT_EQ(diagnostics_of("axiom = <F>\nF --> FF\n").size(), 1U);
}

TEST(ForeignLine, ReadsAnyBytes) {
    for (const char* line : {"", "=", ":", "()", "((((", "))))", "\"", "'", "→", "=>", "rules", "rules:(", "rules[",
                             "rules[]=", "p1:", ", , ,", "{{{{{{{{{{{{{{{{{{}}}}", "\xFF\xFE = \xC3", "a=b=c:d->e"}) {
        advice_for_line(line, false);
        foreign_kind(line);
        find_late_remark(line, [](std::string_view) { return false; });
    }
    std::string deep;
    for (int i = 0; i < 1000; ++i) deep += "(";
    EXPECT_FALSE(advice_for_line(deep + "X = F", false).is_understood());
}

TEST(ForeignSign, TypographyInWordsIsAnError) {
    for (const char* sign : {"\u2212", "\u2013", "\u2014", "\u2010"}) {
        expect_mistakes(std::string("axiom: F") + sign + "F\n", {{{1, 9}, "write '-'"}});
    }
    expect_mistakes("axiom: F\nF --> F\u00A0F\n", {{{2, 8}, "write a plain blank"}});
    expect_mistakes("axiom: F\nF\u00A0--> FF\n", {{{2, 2}, "write a plain blank"}});
    expect_mistakes("axiom: F\u200BF\n", {{{1, 9}, "U+200B is not a symbol: leave it out"}});
    expect_mistakes("axiom: \u201CF\u201D\n", {{{1, 8}, "leave it out"}});
    expect_mistakes("axiom: F\nF --> >F<\n", {{{2, 7}, "a step takes its length as a parameter: F(1.36*x)"}});
    expect_mistakes("axiom: F\nF --> F<+F>\n", {{{2, 8}, "branches stand in [ ]"}});
    // Letters of any script are symbols.
    EXPECT_TRUE(diagnostics_of("axiom: αஅ🌿\nα --> αβ\n").empty());
}

TEST(LateRemark, OtherMarksOfCommentsAreWarnedOf) {
    for (const char* line : {"F --> F+F # leaf of the first kind", "F --> F+F ; the stem", "F --> F+F % a stem",
                             "F --> F+F -- the stem", "F --> F+F # größer"}) {
        const auto found = diagnostics_of("axiom: F\n" + std::string(line) + "\n");
        ASSERT_EQ(found.size(), 1U) << line;
        EXPECT_TRUE(found[0].warning);
        EXPECT_EQ(found[0].where.column, 11) << line;
        EXPECT_TRUE(has(found[0].message, "does not begin a comment"));
    }
    EXPECT_EQ(diagnostics_of("axiom: F # the beginning\n").size(), 1U);
    // The turtle's own signs.
    for (const char* line : {"F --> F#F", "F --> F # F", "F --> # F ! F", "F --> #(2) F", "F --> F #(2) FX(1)",
                             "F --> F ; F , F", "F --> F -- F", "F --> F # fF", "F --> F # FX F"}) {
        EXPECT_TRUE(diagnostics_of("axiom: F\n" + std::string(line) + "\n").empty()) << line;
    }
}

TEST(LateRemark, MarksWithoutABlankAfterThem) {
    for (const char* line : {"F --> F+F #leaf", "F --> F+F ;the stem", "F --> F+F %leaf", "F --> F+F --stem",
                             "F --> F+F //leaf", "F --> F+F #größer", "F --> F+F #leaf : 0.5"}) {
        const auto found = diagnostics_of("axiom: F\n" + std::string(line) + "\n");
        ASSERT_EQ(found.size(), 1U) << line;
        EXPECT_TRUE(found[0].warning);
        EXPECT_EQ(found[0].where.column, 11) << line;
        EXPECT_TRUE(has(found[0].message, "does not begin a comment"));
    }
    EXPECT_EQ(diagnostics_of("axiom: F #start\n").size(), 1U);
    // Symbols of the turtle and of the system.
    for (const char* line : {"F --> F#leaf", "F --> F #fF", "F --> F #FX", "F --> F #leaf+F", "F --> F #le[af]",
                             "F --> F //F", "F --> F ;F", "F --> F #a(2)bcd"}) {
        EXPECT_TRUE(diagnostics_of("axiom: F\n" + std::string(line) + "\n").empty()) << line;
    }
    EXPECT_TRUE(diagnostics_of("axiom: a\na --> b #bac\nb --> F # abc\nc --> a\n").empty());
}

TEST(LateRemark, LongLinesOfMarksAreReadOnce) {
    std::string line = "F --> F";
    for (int i = 0; i < 400000; ++i) line += " # F";
    EXPECT_EQ(find_late_remark(line, [](std::string_view) { return false; }), std::string::npos);
}

TEST(ForeignSign, QuotationMarksAroundAWordAreWarnedOf) {
    for (const char* line : {"F --> \"FF\"", "F --> 'FF'", "F --> \"FF\","}) {
        const auto found = diagnostics_of("axiom: F\n" + std::string(line) + "\n");
        ASSERT_EQ(found.size(), 1U) << line;
        EXPECT_TRUE(found[0].warning);
    }
    EXPECT_TRUE(diagnostics_of("axiom: F\nF --> ''F;F'\nf --> 'F\n").empty());
}

TEST(LateRemark, NamesOfSymbolsAreNotRemarks) {
    EXPECT_TRUE(diagnostics_of("axiom: plant\nplant --> F -- leaf # leaf plant\nsymbols: plant leaf\n").empty());
}

TEST(ForeignText, OtherProgramsAreRecognised) {
    EXPECT_EQ(foreign_kind("Koch1 { ; a remark\n  Angle 6\n  Axiom F--F--F\n  F=F-F++F-F\n}\n"),
              ForeignKind::fractint);
    EXPECT_EQ(foreign_kind("/* a plant */\n#define N 5\nLsystem: 1\nderivation length: N\nAxiom: F\nendlsystem\n"),
              ForeignKind::cpfg);
    EXPECT_EQ(foreign_kind("#include <lpfgall.h>\nderivation length: 3;\nmodule I(float);\nAxiom: I(1);\nI(x) :\n{\n"
                           "  produce I(x/2);\n}\n"),
              ForeignKind::lpfg);
    EXPECT_EQ(foreign_kind("module A();\nAxiom: A();\n"), ForeignKind::lpfg);
    EXPECT_EQ(
        foreign_kind("#include <lpfgall.h>\nmodule A(int);\nAxiom: A(1);\nproduction:\nA(x): { produce F(1); }\n"),
        ForeignKind::lpfg);
    EXPECT_EQ(foreign_kind("Axiom: A\nderivation length: 3\nproduction:\nA :\n  produce F A\n"), ForeignKind::lpy);
    EXPECT_EQ(foreign_kind("\n<!DOCTYPE html>\n<html></html>\n"), ForeignKind::html);
    for (const char* text : {"", "axiom: F\nF --> {F}\n", "title: x\naxiom: F\n/* Koch {\n axiom F\n} */\n",
                             "rules = {\n'F': 'FF'\n}\naxiom = 'F'\n", "description: Lsystem: 1\naxiom: F\n",
                             "lsystem plant\n{\n  rules\n  rules {\n  axiom -> X;\n  X -> FF;\n }\n}\n"}) {
        EXPECT_EQ(foreign_kind(text), ForeignKind::none) << text;
    }
    expect_mistakes("Koch1 {\n  Angle 6\n  Axiom F\n  F=F-F\n}\n",
                    {{{1, 1}, "this is a Fractint collection of L-systems, not a pattern; import it first"}});
    expect_mistakes("Lsystem: 1\nAxiom: F\nF --> FF\nendlsystem\n", {{{1, 1}, "this is an L-system of cpfg"}});
}

}  // namespace sikku::foreign_text_test
