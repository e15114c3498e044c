// tests/engine/import_cpfg_test.cpp: compares imported systems of cpfg with an independent interpreter and with
// bundled patterns.
#include "engine/import/import.h"

#include "engine/geometry/space_turtle.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/fuzz/targets.h"
#include "tests/import_tools.h"
#include "tests/module_reference.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace sikku::import_cpfg_test {

using namespace import_tools;

/// Reads a bundled pattern.
std::string along(const std::string& name) {
    return contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / (name + ".lsys"));
}

/// The same words after each number of steps.
void expect_same_words(const std::string& imported, const std::string& pattern, int most) {
    for (int n = 0; n <= most; ++n) ASSERT_EQ(word_of(imported, n), word_of(pattern, n)) << n << '\n' << imported;
}

TEST(ImportCpfg, ParametersAndDefines) {
    const ImportedSystem honda = cpfg(
        "/* Honda's trees, table 1 */\n#define r1 0.75 // first\n#define r2 .77\n#define alpha1 35\n#define alpha2 "
        "-35\n"
        "#define w0 30\n#define q 0.50\n#define e (0.40)\n#define min 0.0\n\nLsystem: 1\nderivation length: 10\n"
        "Axiom: A(100, w0)\n\nA(s,w) : s >= min --> !(w)F(s)\n\t[+(alpha1)/(0)A(s*r1,w*q^e)]\n"
        "\t[+(alpha2)/(0)A(s*r2,w*(1-q)^e)]\nendlsystem\n",
        "angle increment: 18\nline style: polygon\n");
    expect_same_words(honda.pattern, along("plants/honda-trees"), 8);
    EXPECT_TRUE(has(honda.pattern, "define alpha2 = -35\n"));
    EXPECT_TRUE(has(honda.pattern, "angle increment: 18\n"));
    EXPECT_TRUE(has(honda.pattern, "title: test\nsource: test.l\n"));
    ASSERT_EQ(honda.losses.size(), 1U);
    EXPECT_EQ(honda.losses[0], "test.v, line 2: 'line style:' of the view");

    const ImportedSystem words = cpfg(
        "Lsystem: words\nderivation length: 5\nAxiom: B(2)A(4,4)\nA(x,y) : y <= 3 --> A(x*2,x+y)\n"
        "A(x,y) : y > 3 --> B(x)A(x/y,0)\nB(x) : x < 1 --> C\nB(x) : x >= 1 --> B(x-1)\nendlsystem\n");
    expect_same_words(words.pattern, along("words/parametric-example"), 9);
    EXPECT_TRUE(has(words.pattern, "title: words\n"));
    EXPECT_TRUE(has(words.pattern, "angle increment: 45\nturn: left\n"));
    EXPECT_TRUE(words.losses.empty());

    const ImportedSystem leaf = cpfg(
        "Lsystem: 0\nderivation length: 5\nAxiom: !(1)F(1)\nF(s) --> G(s)[-!(1)F(s)][+!(1)F(s)]G(s)!(1)F(s)\n"
        "G(s) --> G(2*s)\n!(w) --> !(3)\nendlsystem\n");
    expect_same_words(leaf.pattern, along("plants/compound-leaf"), 6);
}

TEST(ImportCpfg, RollsInWordsAreNoComments) {
    const ImportedSystem bush = cpfg(
        "Lsystem: 1 // figure 1.25\n// by hand\nderivation length: 2\nAxiom: A\n"
        "A --> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF --> S/////F // grows\nS --> FL\nendlsystem\n");
    EXPECT_TRUE(has(bush.pattern, "A --> [&FL!A]/////'[&FL!A]///////'[&FL!A]\n"));
    EXPECT_TRUE(has(bush.pattern, "F --> S/////F\n"));
}

TEST(ImportCpfg, ContextsAndCuts) {
    const ImportedSystem hogeweg = cpfg(
        "Lsystem: 1\nderivation length: 30\nignore: +-F\nAxiom: F1F1F1\n0 < 0 > 0 --> 1\n0 < 0 > 1 --> 1[-F1F1]\n"
        "0 < 1 > 0 --> 1\n0 < 1 > 1 --> 1\n1 < 0 > 0 --> 0\n1 < 0 > 1 --> 1F1\n1 < 1 > 0 --> 1\n1 < 1 > 1 --> 0\n"
        "* < - > * --> +\n* < + > * --> -\nendlsystem\n",
        "angle factor: 16\n");
    expect_same_words(hogeweg.pattern, along("plants/hogeweg-hesper-b"), 24);
    EXPECT_TRUE(has(hogeweg.pattern, "angle factor: 16\n"));

    const ImportedSystem considered = cpfg(
        "Lsystem: 1\nderivation length: 30\nconsider: [01]\nAxiom: F1F1F1\n0 < 0 > 0 --> 1\n0 < 0 > 1 --> 1[-F1F1]\n"
        "0 < 1 > 0 --> 1\n0 < 1 > 1 --> 1\n1 < 0 > 0 --> 0\n1 < 0 > 1 --> 1F1\n1 < 1 > 0 --> 1\n1 < 1 > 1 --> 0\n"
        "- --> +\n+ --> -\nendlsystem\n");
    expect_same_words(considered.pattern, along("plants/hogeweg-hesper-b"), 20);
    EXPECT_TRUE(has(considered.pattern, "consider: 0 1 [ ]\n"));
    // cpfg passes through brackets that it is not told to consider.
    const ImportedSystem through = cpfg(
        "Lsystem: 1\nconsider: ab\nderivation length: 1\nAxiom: a[b]\na > b --> c\n"
        "endlsystem\n");
    EXPECT_EQ(word_of(through.pattern), "c[b]");

    const ImportedSystem shedding = cpfg(
        "Lsystem: 1\nderivation length: 9\nAxiom: A\nA --> F(1)[-X(3)B][+X(3)B]A\nB --> F(1)B\nX(d) : d > 0 --> "
        "X(d-1)\n"
        "X(d) : d == 0 --> U%\nU --> F(0.3)\nendlsystem\n");
    expect_same_words(shedding.pattern, along("plants/branch-shedding"), 9);

    // `=` lets a branch go on.
    const ImportedSystem flux = cpfg(
        "#define a1 10 /* branching angle */\n#define a2 32\n#define sigma0 17\n#define eta 0.89\n#define lambda "
        "0.7\n"
        "#define v_th 5.0\nLsystem: 1\nderivation length: 35\nignore: +-/\nAxiom: N(1)I(0,2,0,1)A(1)\n"
        "N(k) < I(b,m,v,c) : b==0 && m==2 --> I(b,1,sigma0*2^((k-1)*(eta^k)),c)\n"
        "N(k) > I(b,m,v,c) : b==0 && m==2 --> N(k+1)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml==1 && b==1 --> I(b,ml,vl-vl*(1-lambda)*((cl-c)/c),c)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml==1 && b==2 --> I(b,ml,vl*(1-lambda)*(c/(cl-c)),c)\n"
        "I(b,m,v,c) < A(s) : m==1 && v>v_th "
        "-->\n\t[-(s*a2)I(2,2,v*(1-lambda),1)A(-s)]\n\t+(s*a1)I(1,2,v*lambda,1)A(-s)\n"
        "I(b,m,v,c) > A(s) : m==1 && v<=v_th --> I(b,2,v,c)\n"
        "I(b,m,v,c) > [I(b2,m2,v2,c2)=]I(b1,m1,v1,c1) : m==0 && m1==2 && m2==2 --> I(b,2,v,c1+c2)\n"
        "I(b,m,v,c) : m==1 --> I(b,0,v,c)\nI(bl,ml,vl,cl) < I(b,m,v,c) : ml==2 && m==2 --> I(b,0,v,c)\n"
        "homomorphism\nI(b,m,v,c) --> F\nendlsystem\n");
    // cpfg tries them in the order of the file: the last never overtakes the one before it.
    const std::string ordered = flux.pattern;
    EXPECT_TRUE(has(ordered, "ml==2&&m==2&&!(m==1) --> I(b,0,v,c)\n"));
    const std::string equation_17 =
        "define a1 = 10\ndefine a2 = 32\ndefine s0 = 17\ndefine eta = 0.89\ndefine l = 0.7\n"
        "derivation length: 35\nturn: left\nignore: + -\naxiom: N(1)I(0,2,0,1)A(1)\n"
        "N(k) < I(b,m,v,c) : b == 0 && m == 2 --> I(b, 1, s0*2^((k-1)*eta^k), c)\n"
        "N(k) > I(b,m,v,c) : b == 0 && m == 2 --> N(k+1)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 1 && b == 1 --> I(b, ml, vl - vl*(1-l)*((cl-c)/c), c)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 1 && b == 2 --> I(b, ml, vl*(1-l)*(c/(cl-c)), c)\n"
        "I(b,m,v,c) < A(s) : m == 1 && v > 5 --> [-(s*a2)I(2,2,v*(1-l),1)A(-s)]+(s*a1)I(1,2,v*l,1)A(-s)\n"
        "I(b,m,v,c) > A(s) : m == 1 && v <= 5 --> I(b, 2, v, c)\n"
        "I(b,m,v,c) > [I(b2,m2,v2,c2)]I(b1,m1,v1,c1) : m == 0 && m1 == 2 && m2 == 2 --> I(b, 2, v, c1+c2)\n"
        "I(b,m,v,c) : m == 1 --> I(b, 0, v, c)\n"
        "I(bl,ml,vl,cl) < I(b,m,v,c) : ml == 2 && m == 2 --> I(b, 0, v, c)\ninterpret:\nI(b,m,v,c) --> F\n";
    expect_same_words(ordered, equation_17, 35);
    EXPECT_EQ(word_of(ordered, 20, true), word_of(equation_17, 20, true));
}

TEST(ImportCpfg, Chance) {
    const std::string text =
        "seed: 0\nderivation length: 5\nAxiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : "
        "0.34\n"
        "endlsystem\n";
    const ImportedSystem chance = cpfg("Lsystem: 1\n" + text);
    expect_same_words(chance.pattern, along("plants/stochastic-branches"), 5);
    // A missing weight is 1. Without a seed, productions are not chosen at random.
    EXPECT_TRUE(has(cpfg("Lsystem: 1\nseed: 3\nAxiom: A\nA --> B\nA --> C : 2\nB --> D : 0.5\nendlsystem\n").pattern,
                    "seed: 3\naxiom: A\nA --> B : 1\nA --> C : 2\nB --> D\n"));
    const ImportedSystem certain = cpfg("Lsystem: 1\n" + text.substr(8));
    EXPECT_EQ(word_of(certain.pattern, 1), "F[+F]F[-F]F");
    EXPECT_EQ(certain.losses.size(), 3U);
    EXPECT_TRUE(has(certain.losses[0], "probabilities"));
    const ImportedSystem mixed = cpfg("Lsystem: 1\nseed: 3\nAxiom: AB\nA > B --> C\nA --> D\nendlsystem\n");
    ASSERT_EQ(mixed.losses.size(), 1U);
    EXPECT_TRUE(has(mixed.losses[0], "whatever their contexts"));
    EXPECT_TRUE(has(cpfg("Lsystem: 1\nderivation length: 1\nAxiom: A\nA --> F(ran(2)+1)\nendlsystem\n").pattern,
                    "A --> F(random(0,2)+1)\n"));
}

TEST(ImportCpfg, Expressions) {
    const auto value = [](const std::string& expression) {
        const ImportedSystem system =
            cpfg("Lsystem: 1\nderivation length: 1\nAxiom: A(7,3)\nA(x,y) --> B(" + expression + ")\nendlsystem\n");
        const std::string word = word_of(system.pattern);
        return std::stod(word.substr(2));
    };
    // Powers associate to the left, signs bind tightest.
    EXPECT_EQ(value("2^3^2"), 64);
    EXPECT_EQ(value("-2^2"), 4);
    EXPECT_EQ(value("-(2^2)"), -4);
    EXPECT_EQ(value("2^(3^2)"), 512);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("!x+1"), 1);
    EXPECT_EQ(value("!(x>7)*5"), 5);
    EXPECT_EQ(value("10-3-2"), 5);
    EXPECT_EQ(value("10-(3-2)"), 9);
    EXPECT_EQ(value("x-(-y)"), 10);
    EXPECT_EQ(value("x--y"), 10);
    EXPECT_EQ(value("24/4/2"), 3);
    EXPECT_EQ(value("24/(4/2)"), 12);
    EXPECT_EQ(value("x%4"), 3);
    EXPECT_EQ(value("-7.9%4"), -3);
    EXPECT_EQ(value("(x+0.9)%(y+.5)"), 1);
    EXPECT_EQ(value("x<>y"), 1);
    EXPECT_EQ(value("x<y||y<x&&0"), 0);
    EXPECT_NEAR(value("sin(30)+cos(x*0+60)"), 1, 1e-15);
    EXPECT_NEAR(value("asin(1)-atan(1)"), 45, 1e-12);
    EXPECT_EQ(value("trunc(2.5)+floor(2.9)+ceil(0.1)"), 6);
    EXPECT_EQ(value("sign(-x)+fabs(0-2)"), 1);
    EXPECT_EQ(value("sqrt(x+2)"), 3);
    EXPECT_EQ(value("log(exp(2))"), 2);
}

TEST(ImportCpfg, DefinesAreExpandedAsByAPreprocessor) {
    const auto word = [](const std::string& head, const std::string& successor) {
        return word_of(
            cpfg(head + "Lsystem: 1\nderivation length: 1\nAxiom: A\nA --> " + successor + "\nendlsystem\n").pattern);
    };
    EXPECT_EQ(word("#define STEP(a, b) F(a*b)\n", "STEP(2,1+2)[STEP((1),4)]"), "F(4)[F(4)]");
    EXPECT_EQ(word("#define leaf [+ stalk]\n#define stalk FF\n", "X leaf leaf"), "X[+FF][+FF]");
    EXPECT_EQ(word("#define F G\n", "F FF[F]"), "GFF[G]");
    EXPECT_EQ(word("#define SUM 1+2\n", "F(SUM*3)"), "F(7)") << "what is no number by itself is text";
    EXPECT_EQ(word("#define SUM (1+2)\n", "F(SUM*3)"), "F(9)");
    EXPECT_EQ(word("#define LEN -2\n", "F(3-LEN)"), "F(5)");
    EXPECT_EQ(word("#define L 2 \\\n + 3\n", "F(L)"), "F(5)");
    EXPECT_EQ(word("#define L 2\n#undef L\n#define L 3\n", "F(L)"), "F(3)");
    EXPECT_EQ(word("#ifdef BIG\n#define L 9\n#else\n#define L 3\n#endif\n#if L\n#define M 1\n#endif\n", "F(L+M)"),
              "F(4)");
    EXPECT_EQ(word("#if 0\nnonsense ((\n#ifdef X\n#endif\n#endif\n", "F"), "F");
    // Numbers stay names.
    const ImportedSystem named = cpfg(
        "#define STEPS 4\n#define LEN 2.50\n#define TWICE (LEN*2)\n#define UNUSED 1\nLsystem: 1\n"
        "derivation length: STEPS+1\nAxiom: F(TWICE)\nF(a) : a<LEN --> F(TWICE)\nendlsystem\n");
    EXPECT_TRUE(has(named.pattern, "\n\ndefine LEN = 2.5\ndefine TWICE = LEN*2\n\n"));
    EXPECT_TRUE(has(named.pattern, "derivation length: 5\n"));
    EXPECT_EQ(word_of(named.pattern, 0), "F(5)");
}

/// First production of the file that matches, letter by letter; a module is a letter with a number.
struct OrderedRule {
    char left = 0, predecessor = 0, right = 0;
    int least = 0;  ///< condition: the number is at least that
    std::string letters;
};

TEST(ImportCpfg, TheFirstProductionThatMatchesApplies) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto letter = [&] { return static_cast<char>('a' + random() % 3); };
        std::vector<OrderedRule> rules;
        std::string text = "Lsystem: 1\nderivation length: 5\nAxiom: a(1)b(2)c(0)a(3)\n";
        for (std::size_t i = random() % 8 + 1; i > 0; --i) {
            OrderedRule rule;
            rule.predecessor = letter();
            if (random() % 2 == 0) rule.left = letter();
            if (random() % 3 == 0) rule.right = letter();
            rule.least = random() % 2 == 0 ? static_cast<int>(random() % 4) : -100;
            for (std::size_t k = random() % 3; k > 0; --k) rule.letters += letter();
            const char name = "pqst"[random() % 4];
            if (rule.left != 0) text += fmt::format("{}(l) < ", rule.left);
            text += fmt::format("{}({})", rule.predecessor, name);
            if (rule.right != 0) text += fmt::format(" > {}(r)", rule.right);
            if (rule.least > -100) text += fmt::format(" : {} >= {}", name, rule.least);
            text += " -->";
            if (rule.letters.empty()) text += " *";
            for (std::size_t k = 0; k < rule.letters.size(); ++k) {
                text += fmt::format(" {}({}{})", rule.letters[k], name, k % 2 == 0 ? "+1" : "-1");
            }
            text += '\n';
            rules.push_back(rule);
        }
        std::vector<std::pair<char, int>> word = {{'a', 1}, {'b', 2}, {'c', 0}, {'a', 3}};
        const ImportedSystem system = cpfg(text + "endlsystem\n");
        for (int step = 0; step <= 5; ++step) {
            std::string expected;
            for (const auto& [symbol, value] : word) expected += fmt::format("{}({})", symbol, value);
            ASSERT_EQ(word_of(system.pattern, step), expected) << text << '\n' << system.pattern;
            std::vector<std::pair<char, int>> next;
            for (std::size_t at = 0; at < word.size(); ++at) {
                const auto rule = std::find_if(rules.begin(), rules.end(), [&](const OrderedRule& one) {
                    return one.predecessor == word[at].first && word[at].second >= one.least &&
                           (one.left == 0 || (at > 0 && word[at - 1].first == one.left)) &&
                           (one.right == 0 || (at + 1 < word.size() && word[at + 1].first == one.right));
                });
                if (rule == rules.end()) {
                    next.push_back(word[at]);
                    continue;
                }
                for (std::size_t k = 0; k < rule->letters.size(); ++k) {
                    next.emplace_back(rule->letters[k], word[at].second + (k % 2 == 0 ? 1 : -1));
                }
            }
            word = std::move(next);
        }
    }
}

TEST(ImportCpfg, WhatTheTurtleDoesOtherwise) {
    const auto drawn = [](const std::string& axiom, const std::string& homomorphism = "",
                          const std::string& view = "") {
        return word_of(cpfg("Lsystem: 1\nAxiom: " + axiom + "\n" + homomorphism + "endlsystem\n", view).pattern, 0,
                       true);
    };
    // Without an increment ! and # do nothing; ' means nothing; circles have diameters; tubes are no polygons.
    EXPECT_EQ(drawn("!F#(2)G#f'g"), "F#(2)Gfg");
    EXPECT_EQ(drawn("!F", "", "line width increment: 0.5\n"), "!F");
    EXPECT_EQ(drawn("@O(3)@c(1)@o(4,1)F@v@O$"), "@O(1.5)@O(0.5)@O(2)F$");
    EXPECT_EQ(drawn("{(4)F}(4){(0)F}{F}"), "F{(0)F}{F}");
    EXPECT_EQ(drawn("A!'", "homomorphism: no warnings\nA --> F!'@O(2)%{(3)[B]}(3)\nB --> FF\n"), "F@O(1)[B]");
    const Survey survey =
        reference::survey_of(grammar_of(cpfg("Lsystem: 1\nAxiom: F+(90)G(2)f-(90)g\nendlsystem\n").pattern));
    EXPECT_NEAR(survey.end.x, -3, 1e-12);
    EXPECT_NEAR(survey.end.y, 2, 1e-12);
    EXPECT_EQ(survey.drawn, 2U);
    // Polygons are those of a framework.
    const std::string blade = cpfg("Lsystem: 1\nAxiom: {.G.+(90)G.+(90)G.}\nendlsystem\n").pattern;
    EXPECT_TRUE(has(blade, "\npolygons: framework\n"));
    EXPECT_EQ(reference::survey_of(grammar_of(blade)).drawn, 3U);
    // A surface called f does not move the turtle.
    const ImportedSystem surface =
        cpfg("Lsystem: 1\nderivation length: 1\nAxiom: F~f(1)\n~f(s) --> ~f(s*2)~p(1)\nendlsystem\n");
    EXPECT_EQ(word_of(surface.pattern), "F~\xCE\x91(2)~p(1)");
    EXPECT_TRUE(has(surface.pattern, "// The surface ~f is ~\xCE\x91 here"));
}

/// The turtle of cpfg: each turn mixes two of its three vectors. Its up is away from the reader.
glm::dvec3 end_of_cpfg(const std::vector<std::pair<char, double>>& commands) {
    glm::dvec3 at(0.0);
    glm::dvec3 heading(0, 1, 0);
    glm::dvec3 left(-1, 0, 0);
    glm::dvec3 up(0, 0, -1);
    const auto mix = [](glm::dvec3& one, glm::dvec3& other, double degrees) {
        const double angle = degrees * std::acos(-1.0) / 180;
        const glm::dvec3 turned = std::cos(angle) * one + std::sin(angle) * other;
        other = std::cos(angle) * other - std::sin(angle) * one;
        one = turned;
    };
    for (const auto& [command, value] : commands) {
        if (command == 'F') at += value * heading;
        if (command == '+' || command == '-') mix(heading, left, command == '+' ? value : -value);
        if (command == '&' || command == '^') mix(heading, up, command == '&' ? value : -value);
        if (command == '/' || command == '\\') mix(left, up, command == '/' ? value : -value);
        if (command == '|') mix(heading, left, 180);
        if (command == 'v' && std::fabs(heading.y) < 1) {
            left = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), heading));
            up = glm::cross(left, heading);
        }
    }
    return at;
}

TEST(ImportCpfg, TheTurtleInSpace) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        std::vector<std::pair<char, double>> commands;
        std::string word;
        for (std::size_t i = random() % 20 + 1; i > 0; --i) {
            const char command = "FF+-&^/\\|v"[random() % 10];
            const bool is_plain = command != 'F' && random() % 2 == 0;
            const double value = is_plain ? 20 : static_cast<double>(random() % 300) / 4;
            commands.emplace_back(command, value);
            // A preprocessor would take two rolls for a comment.
            word += command == 'v' ? " @v" : std::string(" ") + command;
            if (!is_plain && command != 'v' && command != '|') word += fmt::format("({})", value);
        }
        word += "F(1)";
        commands.emplace_back('F', 1.0);
        const glm::dvec3 expected = end_of_cpfg(commands);
        // As a word of its own, and as what a homomorphism makes.
        for (const std::string& text : {"Lsystem: 1\nAxiom: " + word + "\nendlsystem\n",
                                        "Lsystem: 1\nAxiom: A\nhomomorphism\nA --> " + word + "\nendlsystem\n"}) {
            const Grammar grammar = grammar_of(cpfg(text, "angle increment: 20\n").pattern);
            const auto turtle = SpaceTurtle::make(grammar);
            derive(grammar, *turtle, {.interpreted = true});
            ASSERT_LT(glm::distance(turtle->survey().end, expected), 1e-9) << word;
        }
    }
}

TEST(ImportCpfg, ABackslashAtTheEndOfALineContinuesNothing) {
    const ImportedSystem system =
        cpfg("Lsystem: 1\nderivation length: 1\nignore: +\\\nAxiom: \\\n\\ --> \\\nA --> B\nendlsystem\n");
    EXPECT_EQ(word_of(system.pattern), "\\");
    EXPECT_TRUE(has(system.pattern, "ignore: +\\\naxiom:\\\n\\ -->\\\nA --> B\n"));
    EXPECT_EQ(word_of(system.pattern, 1, true), "/");
}

TEST(ImportCpfg, ViewFiles) {
    const auto made = [](const std::string& view) { return cpfg("Lsystem: 1\nAxiom: F\nendlsystem\n", view); };
    EXPECT_TRUE(has(made("angle factor: 7\n").pattern, "angle factor: 7\n"));
    EXPECT_TRUE(has(made("angle factor: 7.5\n").pattern, "angle increment: 360/7.5\n"));
    EXPECT_TRUE(has(made("/* angle factor: 7\n */\n\tangle increment:  25.7 // degrees\n").pattern,
                    "angle increment: 25.7\n"));
    const ImportedSystem wide = made("initial line width: 2 pixels\nscale factor: .9\nz buffer: on\n");
    EXPECT_TRUE(has(wide.pattern, "scale factor: 90\nstroke: 2 px\n"));
    ASSERT_EQ(wide.losses.size(), 1U);
    EXPECT_EQ(wide.losses[0], "test.v, line 3: 'z buffer:' of the view");
    EXPECT_TRUE(has(made("initial line width: 0.1\n").pattern, "stroke: 0.1 step\n"));
    EXPECT_TRUE(has(cpfg("Lsystem: 1\nAxiom: !(2)F\nendlsystem\n").pattern, "stroke: 1 px\n"));
    Diagnostics diagnostics;
    import_cpfg(source_of("Lsystem: 1\nAxiom: F\nendlsystem\n"), source_of("\nangle factor: many\n", "test.v"),
                diagnostics);
    expect_errors(diagnostics, {{{2, 13}, "expected a number other than 0"}});
}

TEST(ImportCpfg, LossesAreTold) {
    const auto losses = [](const std::string& text) {
        const ImportedSystem system = cpfg(text);
        for (const std::string& loss : system.losses) EXPECT_TRUE(has(system.pattern, pattern_line(loss, 200)));
        return fmt::format("{}", fmt::join(system.losses, "\n"));
    };
    const std::string head = "Lsystem: 1\nAxiom: A(1)\n";
    EXPECT_TRUE(has(losses(head + "A(x) --> B(nran(x,1))\nendlsystem\n"),
                    "line 3: this production: the pattern language has no function 'nran'"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B(x>1?2:3)\nendlsystem\n"), "'?:' chooses between values"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B(y)\nendlsystem\n"), "line 3: this production: 'y' is not defined"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B(t[x])\nendlsystem\n"), "'t' is an array"));
    EXPECT_TRUE(
        has(losses(head + "A(x) : {x=1;} 1 {\nx=f(2);\n} --> B\nendlsystem\n"), "the C statements of a production"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B\ndecomposition\nmaximum depth: 90000\nB --> BB\nendlsystem\n"),
                    "line 4: a decomposition of that many rounds"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B\nhomomorphism\nmaximum depth: 3\nB --> BC\nendlsystem\n"),
                    "line 5: a homomorphism that is applied to its own successors"));
    EXPECT_TRUE(has(losses(head + "A(x) --> B\nendlsystem\nLsystem: 2\n"), "line 5: the sub-L-systems"));
    EXPECT_TRUE(
        has(losses("#include <stdio.h>\n" + head + "A(x) --> B\nendlsystem\n"), "line 1: the contents of #include"));
    EXPECT_TRUE(has(losses("Lsystem: 1\nring Lsystem\nAxiom: F\nendlsystem\n"), "line 2: the ring of the word"));
    EXPECT_TRUE(has(losses("Lsystem: 1\nStartEach: {\n a=1;\n}\nAxiom: F\nendlsystem\n"),
                    "line 2: the C statements of 'starteach:'"));
    EXPECT_TRUE(has(losses("Lsystem: 1\nAxiom: AB\nA --> C\nA > B --> D\nendlsystem\n"),
                    "line 4: a production that can never apply"));
    EXPECT_TRUE(has(losses("Lsystem: 1\nAxiom: AB\nA > =]B --> D\nendlsystem\n"),
                    "line 3: this production: a right context"));
    EXPECT_TRUE(has(losses("Lsystem: 1\nAxiom: [AB]\nA > [B]C --> D\nendlsystem\n"),
                    "right contexts that end with their branch"));
    // Constants that are set once, when all begins, are defines.
    const ImportedSystem start = cpfg(
        "#define SI 1.5\nLsystem: 0\nStart: {c=SI+2*0.25;n = c;}\nderivation length: 1\nAxiom: A\nA --> F(c)F(n+1)\n"
        "endlsystem\n");
    EXPECT_TRUE(start.losses.empty());
    EXPECT_EQ(word_of(start.pattern), "F(2)F(3)");
    EXPECT_TRUE(has(losses("Lsystem: 0\nStart: {c=1;}\nEndEach: {c=c+1;}\nAxiom: A\nA --> F(c)\nendlsystem\n"),
                    "this production: 'c' is not defined"));
}

TEST(ImportCpfg, MistakesAreTold) {
    const auto expect = [](const std::string& text, const std::vector<reference::Expected>& expected) {
        SCOPED_TRACE(text.substr(0, 100));
        Diagnostics diagnostics;
        const auto systems = import_cpfg(source_of(text), nullptr, diagnostics);
        expect_errors(diagnostics, expected);
        for (const ImportedSystem& system : systems) EXPECT_EQ(system.pattern, "");
    };
    const std::string head = "Lsystem: 1\nAxiom: A(1)\n";
    expect("Axiom: A\n", {{{1, 1}, "expected 'Lsystem:'"}, {{1, 1}, "there is no line 'Lsystem:'"}});
    expect("Lsystem: 1\nendlsystem\n", {{{2, 1}, "there is no 'Axiom:' before"}});
    expect("Lsystem: 1\nderivation length: 3\n", {{{1, 1}, "there is no 'Axiom:'"}});
    expect("Lsystem: 1\nderivation length: x\nAxiom: F\nendlsystem\n", {{{2, 20}, "'x' is not defined"}});
    expect("Lsystem: 1\nA --> B\nAxiom: F\nendlsystem\n", {{{2, 1}, "expected an item"}});
    expect("Lsystem: 1\nAxiom: F(x)\nendlsystem\n", {{{2, 10}, "'x' is not defined"}});
    expect("Lsystem: 1\nAxiom: F*F\nendlsystem\n", {{{2, 9}, "'*' is the empty word"}});
    expect("Lsystem: 1\nAxiom: F\xC3\xA4\nendlsystem\n", {{{2, 9}, "one character of ASCII"}});
    expect(head + "A(x) B\nendlsystem\n", {{{3, 7}, "expected '-->' after the predecessor"}});
    expect(head + "A(x) -->\nendlsystem\n", {{{3, 1}, "expected a successor"}});
    expect(head + "A(1) --> B\nendlsystem\n", {{{3, 3}, "the name of a parameter"}});
    expect(head + "A(x,x) --> B\nendlsystem\n", {{{3, 6}, "'x' is named twice"}});
    expect(head + "A(x --> B\nendlsystem\n", {{{3, 5}, "expected ',' or ')'"}});
    expect(head + "A(x) --> B(x\nendlsystem\n", {{{3, 13}, "expected ',' or ')'"}});
    expect(head + "A(x) : x = 1 --> B\nendlsystem\n", {{{3, 10}, "expected '=='"}});
    expect(head + "A(x) : --> B(x+)\nendlsystem\n", {{{3, 16}, "expected a number, a name or '('"}});
    expect(head + "A(x) : (x --> B\n\nA(y) --> B)\nendlsystem\n",
           {{{3, 11}, "expected ')'"}, {{5, 11}, "')' is not a symbol"}});
    expect(head + "A(x) --> B(1e999)\nendlsystem\n", {{{3, 12}, "number is out of range"}});
    expect(head + "A(x) --> B : 1 2\nendlsystem\n", {{{3, 16}, "expected the end of the line"}});
    expect("/* no end\n", {{{1, 1}, "this comment has no end"}, {{1, 1}, "there is no line 'Lsystem:'"}});
    // The preprocessor.
    expect("#define A A B\n#define B A\nLsystem: 1\nAxiom: A\nendlsystem\n", {{{4, 8}, "'A' is defined by itself"}});
    expect("#define a b+1\n#define b a\nLsystem: 1\nAxiom: F(a)\nendlsystem\n",
           {{{4, 10}, "'a' is defined by itself"}});
    expect("#define S(a,b) a\nLsystem: 1\nAxiom: S(F)\nendlsystem\n", {{{3, 8}, "'S' takes 2 arguments, not 1"}});
    expect("#define S(a F\nLsystem: 1\nAxiom: F\nendlsystem\n", {{{1, 13}, "expected names"}});
    expect("#define x 1\n" + head + "A(x) --> B\nendlsystem\n", {{{4, 4}, "the parameter 'x' is a define"}});
    // Directives after a condition that is not understood are still matched.
    expect("#if x > (\n#else\n#endif\n" + head + "endlsystem\n", {{{1, 4}, "this condition is not understood"}});
    // Integers of C: 1/2 is 0.
    expect("#if 1/2\n#else\n#endif\n" + head + "endlsystem\n", {{{1, 4}, "this condition is not read: it divides"}});
    expect("#ifdef x\n" + head + "endlsystem\n",
           {{{1, 1}, "has no #endif"}, {{1, 1}, "there is no line 'Lsystem:'"}});
    expect(head + "#(w) --> B\nendlsystem\n", {{{3, 1}, "unknown preprocessor directive"}});
    std::string laughs = "#define l0 FF\n";
    for (int i = 1; i < 40; ++i) laughs += fmt::format("#define l{0} l{1} l{1}\n", i, i - 1);
    expect(laughs + "Lsystem: 1\nAxiom: l39\nendlsystem\n", {{{42, 8}, "expand to more than 16 MB"}});
    std::string chain = "#define l0 1\n";
    for (int i = 1; i < 5000; ++i) chain += fmt::format("#define l{} (l{})\n", i, i - 1);
    expect(chain + "Lsystem: 1\nAxiom: F(l4999)\nendlsystem\n", {{{5002, 10}, "more than 200 deep"}});
    const std::string deep(300, '(');
    expect("Lsystem: 1\nAxiom: F(" + deep + "1\nendlsystem\n", {{{2, 266}, "nest at most 256 deep"}});
    expect("Lsystem: 1\nAxiom: F(1" + repeated_text("%1.5", 40) + ")\nendlsystem\n", {{{2, 71}, "longer than 1 MB"}});
}

}  // namespace sikku::import_cpfg_test
