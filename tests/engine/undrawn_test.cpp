// tests/engine/undrawn_test.cpp: symbols that are meant to draw are found in systems of the literature; nodes,
// apices and notes are not reported.
#include "engine/language/undrawn.h"

#include "engine/language/grammar.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace sikku::undrawn_test {

using reference::diagnostics_of;
using reference::grammar_of;

struct System {
    const char* name;
    const char* text;
};

/// The warnings of a pattern about letters that draw nothing.
std::string warned(const std::string& text, std::string_view variant = {}) {
    std::string found;
    for (const Diagnostic& one : diagnostics_of(text, {}, variant)) {
        if (one.message.find("forward:") != std::string::npos) found += one.text() + '\n';
    }
    return found;
}

/// Published with two letters or more that draw.
const std::vector<System> edge_systems = {
    {"'forward: F G' makes it a step", "axiom: F\nangle increment: 90\nF --> F+G\nG --> F-G\n"},
    {"'forward: F G' makes it a step", "axiom: F-G-G\nangle increment: 120\nF --> F-G+F+G-F\nG --> GG\n"},
    {"'A' and 'B' draw nothing; 'forward: A B'", "axiom: A\nangle increment: 60\nA --> B-A-B\nB --> A+B+A\n"},
    {"'forward: F G'", "axiom: F\nangle increment: 60\nF --> G-F-G\nG --> F+G+F\n"},
    // Gosper's curve
    {"'forward: A B'", "axiom: A\nangle increment: 60\nA --> A-B--B+A++AA+B-\nB --> +A-BB--B-A++A+B\n"},
    {"'forward: F G'", "axiom: F\nangle increment: 60\nF --> F-G--G+F++FF+G-\nG --> +F-GG--G-F++F+G\n"},
    // dragon with L and R
    {"'forward: L R'", "axiom: L\nL --> L+R+\nR --> -L-R\n"},
    // binary trees
    {"'forward: 0 1'", "axiom: 0\nangle increment: 45\n0 --> 1[+0]-0\n1 --> 11\n"},
    {"'forward: F G'", "axiom: F\nangle increment: 45\nF --> G[+F]-F\nG --> GG\n"},
    // Cantor's set with a gap that should move
    {"'G' draws nothing", "axiom: F\nF --> FGF\nG --> GGG\n"},
    // Penrose's rhombs, in which 1 draws
    {"'forward: 1 6 7 8 9'",
     "axiom: [7]++[7]++[7]++[7]++[7]\nangle increment: 36\n6 --> 81++91----71[-81----61]++\n"
     "7 --> +81--91[---61--71]+\n8 --> -61++71[+++81++91]-\n9 --> --81++++61[+91++++71]--71\n1 --> *\n"},
    // E-curve's beginning, FASS
    {"'forward: L R'", "axiom: -L\nL --> LL+R+R-L-L+R+RL\nR --> -LRR-L-LRR\n"},
    {"'forward: F G'", "axiom: F\ntable t:\nF --> F+G\nG --> F-G\nschedule: t\n"},
    {"'forward: F G'", "axiom: F(1)\nF(x) --> F(x/2)+G(x/2)\nG(x) --> F(x/2)-G(x/2)\n"},
};

/// Published with nodes or apices, or with letters that only mark something.
const std::vector<System> node_systems = {
    {"Hilbert", "axiom: A\nA --> +BF-AFA-FB+\nB --> -AF+BFB+FA-\n"},
    {"Hilbert", "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n"},
    {"Moore", "axiom: LFL+F+LFL\nL --> -RF+LFL+FR-\nR --> +LF-RFR-FL+\n"},
    {"dragon", "axiom: FX\nX --> X+YF+\nY --> -FX-Y\n"},
    {"dragon, steps erased", "axiom: FX\nX --> X+YF+\nY --> -FX-Y\nF --> *\n"},
    {"Peano", "axiom: X\nX --> XFYFX+F+YFXFY-F-XFYFX\nY --> YFXFY-F-XFYFX+F+YFXFY\n"},
    {"Gosper", "axiom: XF\nX --> X+YF++YF-FX--FXFX-YF+\nY --> -FX+YFYF++YF+FX--FX-Y\n"},
    {"Gosper with subwords", "axiom: Fl\nFl --> Fl+rF++rF-Fl--FlFl-rF+\nrF --> -Fl+rFrF++rF+Fl--Fl-rF\n"},
    {"arrowhead", "axiom: YF\nX --> YF+XF+Y\nY --> XF-YF-X\n"},
    {"square", "axiom: F+XF+F+XF\nX --> XF-F+F-XF+F+XF-F+F-X\n"},
    {"Penrose",
     "axiom: [X]++[X]++[X]\nW --> YF++ZF----XF[-YF----WF]++\nX --> +YF--ZF[---WF--XF]+\n"
     "Y --> -WF++XF[+++YF++ZF]-\nZ --> --YF++++WF[+ZF++++XF]--XF\nF --> *\n"},
    {"plant", "axiom: X\nX --> F-[[X]+X]+F[+FX]-X\nF --> FF\n"},
    {"plant with an apex", "axiom: A\nA --> F[+A][-A]FA\nF --> FF\n"},
    {"bush with a delay",
     "axiom: A\nA --> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF --> S/////F\nS --> FL\n"
     "L --> ['''^^{-f+f+f-|-f+f+f}]\n"},
    {"weed", "axiom: F\nF --> FF-[XY]+[XY]\nX --> +FY\nY --> -FX\n"},
    {"side shoots", "axiom: F\nF --> F[+X]F\nX --> F[-X]X\n"},
    {"leaf", "axiom: a\nF --> F\na --> F[+x]Fb\nb --> F[-y]Fa\nx --> a\ny --> b\n"},
    {"bush", "axiom: VZFFF\nV --> [+++W][---W]YV\nW --> +X[-W]Z\nX --> -W[+X]Z\nY --> YZ\nZ --> [-FFF][+FFF]F\n"},
    {"algae", "axiom: A\nA --> AB\nB --> A\n"},
    {"signal", "axiom: BAAA\nB < A --> B\n"},
    {"contexts", "axiom: F1F1F1\nignore: +-F\n0 < 0 > 0 --> 0\n0 < 0 > 1 --> 1[+F1F1]\n1 < 0 > 1 --> 1\n+ --> -\n"},
    {"homomorphism", "axiom: F\nF --> F+G\nG --> F-G\ninterpret:\nG --> F\n"},
    {"polygons", "axiom: A\nA --> [{+F-F}]B\nB --> A\n"},
    {"stated", "axiom: F\nforward: F\nF --> F+G\nG --> F-G\n"},
    {"moves", "axiom: F\nmove: f G\nF --> FGF\nG --> GGG\n"},
    {"notes", "axiom: A\nmapping: symbols\nA --> B+A\nB --> A-B\n"},
    {"notes", "axiom: A\nnote A: C4\nA --> B+A\nB --> A-B\n"},
    {"spline through moves", "axiom: -X--X\nline: spline\nX --> XfX--XfX\n"},
    {"delay", "axiom: F[I]\nI --> J\nJ --> K\nK --> F\n"},
};

TEST(Undrawn, LettersThatCanOnlyBeMeantToDrawAreFound) {
    for (const auto& [expected, text] : edge_systems) {
        EXPECT_TRUE(has(warned(text), expected)) << text << warned(text);
    }
    EXPECT_EQ(warned(edge_systems[0].text).rfind("test.lsys:4:1: warning: 'G' draws nothing; 'forward: F G'", 0), 0U);
    // Following the advice fixes the pattern.
    const std::string dragon = std::string(edge_systems[0].text) + "forward: F G\n";
    EXPECT_EQ(warned(dragon), "");
    EXPECT_FALSE(diagnostics_of(edge_systems[0].text).front().excerpt.empty());
}

TEST(Undrawn, NodesAndApicesAreNotReported) {
    for (const auto& [name, text] : node_systems) EXPECT_EQ(warned(text), "") << name;
}

TEST(Undrawn, NoBundledPatternIsWarnedOf) {
    std::size_t patterns = 0;
    const std::filesystem::path root = std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.path().extension() != ".lsys") continue;
        std::ifstream stream(entry.path());
        std::ostringstream text;
        text << stream.rdbuf();
        ++patterns;
        EXPECT_EQ(warned(text.str()), "") << entry.path();
        for (const Diagnostic& one : diagnostics_of(text.str())) {
            EXPECT_FALSE(has(one.message, "does not begin a comment")) << entry.path();
            EXPECT_FALSE(has(one.message, "a weight follows")) << entry.path();
        }
        Diagnostics diagnostics;
        for (const Variant& variant : parse_pattern("a", text.str(), diagnostics).variants) {
            EXPECT_EQ(warned(text.str(), variant.name.view()), "") << entry.path() << variant.name.view();
        }
    }
    EXPECT_GT(patterns, 180U);
}

TEST(Undrawn, AWordWithoutInkNamesItsLetters) {
    EXPECT_EQ(undrawn_hint(grammar_of(edge_systems[2].text)), "; 'forward: A B' makes A and B steps");
    EXPECT_EQ(undrawn_hint(grammar_of("axiom: A\nA --> AB\nB --> A\n")), "; 'forward: A B' makes A and B steps");
    EXPECT_EQ(undrawn_hint(grammar_of("axiom: A\nA --> A\n")), "; 'forward: A' makes A a step");
    // Other words of the system draw, or none of its letters has productions.
    EXPECT_EQ(undrawn_hint(grammar_of("axiom: X\nX --> F[+X]X\n")), "");
    EXPECT_EQ(undrawn_hint(grammar_of("axiom: A\n")), "");
    EXPECT_TRUE(can_draw(grammar_of("axiom: X\nX --> F[+X]X\n")));
    EXPECT_FALSE(can_draw(grammar_of(edge_systems[2].text)));
    EXPECT_FALSE(can_draw(grammar_of("axiom: X\nX --> f[+X]X\nY --> F\n")));
}

/// A plant whose steps are written as moves.
const char* const moved_plant = "derivation length: 4\nangle increment: 25\naxiom: +X\nX --> f-[X]+fX\nf --> ff\n";

TEST(Undrawn, WhereNothingDrawsMovesAreNamed) {
    EXPECT_TRUE(has(warned(moved_plant),
                    "test.lsys:5:1: warning: 'f' moves without drawing; 'forward: f' makes it a step, F draws"));
    EXPECT_EQ(undrawn_hint(grammar_of(moved_plant)),
              "; 'f' moves without drawing; 'forward: f' makes it a step, F draws");
    EXPECT_TRUE(has(warned("axiom: A\nmove: A F\nA --> F+A\n"),
                    "'A' and 'F' move without drawing; 'forward: A F' makes them steps"));
    EXPECT_EQ(warned(std::string(moved_plant) + "forward: f\n"), "");
    // Something draws, or moves are points of a spline or rests.
    for (const char* more : {"X --> X\ntable t:\nX --> @O\n", "interpret:\nf --> F\n", "line: spline\n",
                             "mapping: symbols\n", "label X: {1}\n"}) {
        EXPECT_EQ(warned("axiom: fX\nf --> ff\n" + std::string(more)), "") << more;
    }
    EXPECT_NE(warned(std::string(moved_plant) + "line: spline with lifts\n"), "");
}

TEST(Undrawn, OnlyTheStepsOfTheDerivationCount) {
    const std::string slow = "axiom: A\nA --> B\nB --> C\nC --> F\nderivation length: ";
    for (const auto& [steps, draws] :
         {std::pair{"0", false}, {"2", false}, {"3", true}, {"4", true}, {"1000000000000", true}}) {
        EXPECT_EQ(may_draw(grammar_of(slow + steps)), draws) << steps;
    }
    EXPECT_TRUE(can_draw(grammar_of(slow + "0")));
    // It draws in every second step, and in tables of the schedule only.
    const std::string turns = "axiom: A\nA --> F\nF --> A\nderivation length: ";
    EXPECT_FALSE(may_draw(grammar_of(turns + "4")));
    EXPECT_TRUE(may_draw(grammar_of(turns + "5")));
    const std::string tables = "axiom: A\nderivation length: 3\ntable a:\nA --> AA\ntable b:\nA --> F\nschedule: ";
    EXPECT_FALSE(may_draw(grammar_of(tables + "a*3")));
    EXPECT_TRUE(may_draw(grammar_of(tables + "a*2 b")));
    EXPECT_TRUE(may_draw(grammar_of("axiom: A\ninterpret:\nA --> F\n")));
    // Conditions and contexts count as fulfilled.
    EXPECT_TRUE(may_draw(grammar_of("axiom: A(4)\nA(n) : n==1 --> F\nderivation length: 1\n")));
    EXPECT_TRUE(may_draw(grammar_of("axiom: A\nB < A --> F\nderivation length: 1\n")));
}

}  // namespace sikku::undrawn_test
