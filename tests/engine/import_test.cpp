// tests/engine/import_test.cpp: compares imported systems of Fractint with an independent interpreter; runs the
// program on files of both kinds.
#include "engine/import/import.h"

#include "engine/geometry/space_turtle.h"
#include "tests/checks.h"
#include "tests/fuzz/targets.h"
#include "tests/import_tools.h"
#include "tests/module_reference.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sikku::import_test {

using namespace import_tools;

// --- Fractint: the second algorithm --------------------------------------------------------------------------------

struct Segment {
    double x0, y0, x1, y1;
    int colour;
};

/// Obeys an entry as its text stands, depth first, as Fractint's documentation and sources tell: nothing is derived.
class FractintTurtle {
public:
    FractintTurtle(const std::string& entry, int order) {
        std::istringstream lines(entry.substr(entry.find('{') + 1));
        std::string axiom;
        for (std::string line; std::getline(lines, line);) {
            line = line.substr(0, line.find_first_of(";}"));
            for (char& byte : line) byte = static_cast<char>(std::tolower(byte));
            std::istringstream words(line);
            std::string first;
            std::string second;
            words >> first >> second;
            if (first == "axiom") {
                axiom = second;
            } else if (first == "angle") {
                angles_ = std::stoi(second);
            } else if (first.size() > 1) {
                rules_.emplace_back(first[0], first.substr(2));
            }
        }
        std::size_t at = 0;
        obey(axiom, at, order);
    }

    std::vector<Segment> segments;

private:
    struct State {
        double x = 0;
        double y = 0;
        int angle = 0;
        double degrees = 0;
        double size = 1;
        bool reverse = false;
        int colour = 15;
    };

    static double number(const std::string& word, std::size_t& at) {
        bool root = false;
        bool inverse = false;
        while (at < word.size() && (word[at] == 'q' || word[at] == 'i')) (word[at++] == 'q' ? root : inverse) = true;
        std::string digits;
        while (at < word.size() && (std::isdigit(word[at]) || word[at] == '.')) digits += word[at++];
        double value = digits.empty() ? 0 : std::stod(digits);
        if (root) value = std::sqrt(value);
        return inverse ? 1 / value : value;
    }

    void step(double heading, bool drawn) {
        const double x = state_.x + state_.size * std::cos(heading);
        const double y = state_.y + state_.size * std::sin(heading);
        if (drawn) segments.push_back({state_.x, state_.y, x, y, state_.colour});
        state_.x = x;
        state_.y = y;
    }

    /// Up to the end of the word or of the branch.
    void obey(const std::string& word, std::size_t& at, int depth) {
        const double pi = std::acos(-1.0);
        while (at < word.size() && word[at] != ']') {
            const char command = word[at++];
            const bool numbered = std::string("@\\/c<>").find(command) != std::string::npos;
            const double value = numbered ? number(word, at) : 0;
            bool replaced = false;
            for (const auto& [letter, body] : rules_) {
                if (depth == 0 || letter != command) continue;
                replaced = true;
                std::size_t begin = 0;
                obey(body, begin, depth - 1);
            }
            if (replaced) continue;
            const int side = state_.reverse ? -1 : 1;
            switch (command) {
                case '+':
                    state_.angle += side;
                    break;
                case '-':
                    state_.angle -= side;
                    break;
                case '|':
                    state_.angle -= angles_ / 2;
                    break;
                case '\\':
                    state_.degrees += side * value;
                    break;
                case '/':
                    state_.degrees -= side * value;
                    break;
                case '@':
                    state_.size *= value;
                    break;
                case '!':
                    state_.reverse = !state_.reverse;
                    break;
                case 'f':
                case 'g':
                    step(2 * pi * state_.angle / angles_, command == 'f');
                    break;
                case 'd':
                case 'm':
                    step(pi / 180 * state_.degrees, command == 'd');
                    break;
                case 'c':
                    state_.colour = static_cast<int>(value);
                    break;
                case '<':
                    state_.colour += static_cast<int>(value);
                    break;
                case '>':
                    state_.colour -= static_cast<int>(value);
                    break;
                case '[': {
                    const State saved = state_;
                    obey(word, at, depth);
                    ++at;
                    state_ = saved;
                    break;
                }
                default:
                    break;
            }
        }
    }

    int angles_ = 0;
    std::vector<std::pair<char, std::string>> rules_;
    State state_;
};

/// The pattern's picture of that order.
std::vector<Segment> picture(const std::string& pattern, int order) {
    const Grammar made = grammar_of(pattern);
    const auto grammar = made.with_steps(made.steps() - 2 + order);
    EXPECT_TRUE(grammar);
    reference::Recorder recorder;
    const auto turtle = Turtle::drawing(*grammar, recorder, false);
    derive(*grammar, *turtle, {.interpreted = true});
    std::vector<Segment> segments;
    for (const auto& stroke : recorder.strokes) {
        for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
            segments.push_back({stroke.points[i].x, stroke.points[i].y, stroke.points[i + 1].x,
                                stroke.points[i + 1].y, stroke.pens[i].colour});
        }
    }
    return segments;
}

/// Segment for segment the same, in the same order.
void expect_same_picture(const std::string& entry, const std::string& pattern, int order, bool with_colours = false) {
    const std::vector<Segment> expected = FractintTurtle(entry, order).segments;
    const std::vector<Segment> found = picture(pattern, order);
    ASSERT_EQ(found.size(), expected.size()) << "order " << order << " of\n" << entry << '\n' << pattern;
    double scale = 1;
    for (const Segment& segment : expected) {
        scale = std::max({scale, std::fabs(segment.x1), std::fabs(segment.y1)});
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double gap =
            std::max({std::fabs(found[i].x0 - expected[i].x0), std::fabs(found[i].y0 - expected[i].y0),
                      std::fabs(found[i].x1 - expected[i].x1), std::fabs(found[i].y1 - expected[i].y1)});
        ASSERT_LT(gap, 1e-9 * scale) << "segment " << i << ", order " << order << " of\n" << entry << '\n' << pattern;
        if (with_colours) {
            ASSERT_EQ(found[i].colour, expected[i].colour) << i << "\n" << pattern;
        }
    }
}

std::string imported(const std::string& entry) {
    const auto systems = systems_of(entry);
    EXPECT_EQ(systems.size(), 1U);
    return systems.empty() ? "" : systems.front().pattern;
}

struct Published {
    const char* entry;
    int most_order;
};

// From Mandelbrot 1982 and Prusinkiewicz & Lindenmayer 1990, as Fractint's users write them.
const std::vector<Published> published = {
    {"Koch1 {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n", 4},
    {"Dragon {\n Angle 8\n Axiom FX\n F=\n y=+FX--FY+\n x=-FX++FY-\n}\n", 8},
    {"Peano1 {\n Angle 4\n Axiom F-F-F-F\n F=F-F+F+F+F-F-F-F+F\n}\n", 3},
    {"Bush {\n Angle 16\n Axiom ++++F\n F=FF-[-F+F+F]+[+F-F-F]\n}\n", 4},
    {"Penrose1 {\n Angle 10\n Axiom +WF--XF---YF--ZF\n W=YF++ZF----XF[-YF----WF]++\n X=+YF--ZF[---WF--XF]+\n"
     " Y=-WF++XF[+++YF++ZF]-\n Z=--YF++++WF[+ZF++++XF]--XF\n F=\n}\n",
     5},
    {"SnowFlake1 {\n Angle 12\n Axiom FR\n R=++!FRFU++FU++FU!---@Q3FU|-@IQ3!FRFU!\n"
     " U=!FRFU!|+@Q3FR@IQ3+++!FR--FR--FRFU!--\n F=\n}\n",
     4},
    {"Snowflake2 {\n angle 12\n axiom F\n F=++!F!F--F--F@IQ3|+F!F--\n F=F--F!+++@Q3F@QI3|+F!F@Q3|+F!F\n}\n", 3},
    {"Cesaro {\n Angle 34\n Axiom FX\n F=\n X=----F!X!++++++++F!X!----\n}\n", 6},
    {"DoubleCesaro {\n Angle 4\n axiom D\\90D\\90D\\90D\\90\n D=\\42!D!/84!D!\\42\n}\n", 5},
    {"Island1 {\n angle 4\n axiom F+F+F+F\n F=FFFF-F+F+F-F[-GFF+F+FF+F]FF\n G=@8G@I8\n}\n", 3},
    {"Tree1 {\n angle 12\n axiom +++FX\n X=@.6[-FX]+FX\n}\n", 8},
    {"Peano2 {\n Angle 8\n Axiom FXY++F++FXY++F\n X=XY@Q2-F@IQ2-FXY++F++FXY\n Y=-@Q2F-@IQ2FXY\n}\n", 4},
    {"PentaPlexity {\n Angle 10\n Axiom F++F++F++F++F\n F=F++F++F|F-F++F\n}\n", 4},
    {"Sierpinski1 {\n angle 3\n axiom F\n F=FXF\n X=+FXF-FXF-FXF+\n}\n", 4},
};

TEST(ImportFractint, PublishedEntriesAreDrawnAsFractintDrawsThem) {
    for (const auto& [entry, most] : published) {
        const std::string pattern = imported(entry);
        for (int order = 0; order <= most; ++order) expect_same_picture(entry, pattern, order);
    }
}

TEST(ImportFractint, WordsStayWhatTheyAreWhereNothingHasToChange) {
    const std::string koch = imported(published[0].entry);
    EXPECT_EQ(word_of(koch, 1), "F+F--F+F--F+F--F+F--F+F--F+F");
    EXPECT_TRUE(has(koch, "angle factor: 6\nturn: left\nheading: 0\n"));
    EXPECT_TRUE(has(koch, "title: Koch1\nsource: test.l, line 1\n"));
    EXPECT_EQ(word_of(imported(published[1].entry), 2), "--FX++FY-+++FX--FY+-");
    // The pattern that comes along is the same island.
    EXPECT_EQ(word_of(imported("K {\nAngle 4\nAxiom f+f+f+f\nF=F+F-F-FF+F+F-F\n}\n"), 3),
              word_of(imported("K {\nangle=4\naxiom=F+F+F+F\nf = F+F-F-FF+F+F-F\n}"), 3));
}

TEST(ImportFractint, ATurnAroundOfAnOddNumberIsTheLargestBelowHalf) {
    // 360 * 2 / 5 degrees to the right, also where ! has exchanged the sides.
    const std::string entry = "A {\nangle 5\naxiom F|F+F!F|F+F\nF=F|+F\n}\n";
    const std::string pattern = imported(entry);
    EXPECT_TRUE(has(pattern, "interpret:\n| --> --\n"));
    for (int order = 0; order < 4; ++order) expect_same_picture(entry, pattern, order);
    const Survey survey = reference::survey_of(grammar_of(imported("A {\nangle 5\naxiom !F|\n}\n")));
    EXPECT_NEAR(survey.heading, 360 - 144, 1e-9);
}

TEST(ImportFractint, EffectsThatDependOnTheStepsLeft) {
    // The length after X is 2 but for X itself, so that the last step has a table of its own.
    const std::string transient = "A {\nangle 4\naxiom FXF+F\nX=@2+\nF=F-F\n}\n";
    EXPECT_TRUE(has(imported(transient), "schedule: grow*(n-1) last1\n"));
    // Here it never settles: 2^k.
    const std::string growing = "A {\nangle 6\naxiom X\nX=F+X@2XF\n}\n";
    EXPECT_TRUE(has(imported(growing), "table last10:\n"));
    // And sides are exchanged every second time.
    const std::string alternating = "A {\nangle 6\naxiom XF+F\nX=+F!XF\n}\n";
    for (const std::string& entry : {transient, growing, alternating}) {
        for (int order = 0; order < 7; ++order) expect_same_picture(entry, imported(entry), order);
    }
    // A factor of 1, and one that is hardly another.
    const std::string near = "A {\nangle 6\naxiom XXF\nX=@1.000000000000001" + repeated_text("X@1", 5000) + "\n}\n";
    EXPECT_EQ(picture(imported(near), 1).size(), 1U);
    // Beyond the tables nothing is drawn wrongly: it is refused.
    const Grammar grammar = grammar_of(imported(growing));
    EXPECT_TRUE(grammar.with_steps(10));
    EXPECT_FALSE(grammar.with_steps(11));
}

TEST(ImportFractint, Colours) {
    const std::string entry = "A {\nangle 6\naxiom FC4F+C12F\nF=F[c2F]F\n}\n";
    for (int order = 0; order < 4; ++order) expect_same_picture(entry, imported(entry), order, true);
    // Rules for colours, as older Fractints have them: those of earlier steps are gone.
    const std::string erased = "A {\nangle 6\naxiom C3XC10FC11F\nX=FC12FX\nC=\n}\n";
    const std::string pattern = imported(erased);
    EXPECT_EQ(word_of(pattern, 1), ";(15)F C12 FXFF");
    for (int order = 0; order < 4; ++order) expect_same_picture(erased, pattern, order, true);
    const auto stepped = systems_of("A {\nangle 6\naxiom F<1F>2F\n}\n");
    ASSERT_EQ(stepped[0].losses.size(), 1U);
    EXPECT_TRUE(has(stepped[0].losses[0], "line 3: cycles of colours that skip colour 0"));
    EXPECT_TRUE(has(stepped[0].pattern, "Not supported: line 3: cycles"));
}

TEST(ImportFractint, FactorsThatCancelLeaveNothing) {
    // Each rule multiplies the size by 1 in all: any order can be drawn, and no tables are needed.
    for (const char* entry :
         {"A {\nangle 4\naxiom F\nF=F@.5F@2F\n}\n", "A {\nangle 6\naxiom F\nF=F+@.25F-@q2F+@q8F@I.5F@.5F\n}\n",
          "A {\nangle 6\naxiom F\nF=F-@2F@3F-@I6F\n}\n", "A {\nangle 6\naxiom F\nF=F+@IQ3F@Q3-F\n}\n",
          "A {\nangle 4\naxiom F\nF=F@.6F@0.5F-@I.30F\n}\n"}) {
        const std::string pattern = imported(entry);
        EXPECT_FALSE(has(pattern, "schedule:"));
        for (int order = 0; order < 5; ++order) expect_same_picture(entry, pattern, order);
        EXPECT_TRUE(grammar_of(pattern).with_steps(60));
    }
    // 0.333 is not a third: the sizes leave 1 slowly, and powers of hundreds of digits cancel.
    const std::string near = "A {\nangle 6\naxiom F\nF=F@.333FF@3F-@.333F@3F+@.333F@3\n}\n";
    for (int order = 0; order < 6; ++order) expect_same_picture(near, imported(near), order);
    EXPECT_TRUE(has(imported(near), "table last10:\n"));
    // Steps that become too short for any number have no length, as in Fractint.
    const std::string shrinking = "A {\nangle 4\naxiom F\nF=F-@.8G--@.8F\n}\n";
    const Grammar grammar = grammar_of(imported(shrinking));
    EXPECT_TRUE(grammar.with_steps(12));
    for (int order = 0; order < 6; ++order) expect_same_picture(shrinking, imported(shrinking), order);
}

TEST(ImportFractint, TwoHeadings) {
    // F and G turn by + - |, D and M by \ /, each for itself.
    for (const char* entry :
         {"A {\nangle 6\naxiom F+D\\20D/5F|D[-D\\3F]D!+D\\7D\n}\n",
          "A {\nangle 4\naxiom F+F+F\nF=D[+F\\10]D!F-\nD=\\42D!\\84D!/42D\n}\n",
          "A {\nangle 5\naxiom X\nX=F|X+@.5D\\30!X@2M\n}\n", "A {\nangle 7\naxiom DXF\nX=+X\\7.25G-!D\n}\n"}) {
        const auto systems = systems_of(entry);
        EXPECT_TRUE(systems[0].losses.empty());
        for (int order = 0; order < 6; ++order) expect_same_picture(entry, systems[0].pattern, order);
    }
    // Turns of the heading that no step takes do nothing in either program.
    for (const char* entry :
         {"A {\nangle 6\naxiom F+F\\20F/3F\nF=F+F\\5F\n}\n", "A {\nangle 6\naxiom D+D\\20|DM/3D\nD=D\\5M-D\n}\n"}) {
        EXPECT_TRUE(systems_of(entry)[0].losses.empty());
        for (int order = 0; order < 4; ++order) expect_same_picture(entry, imported(entry), order);
    }
}

TEST(ImportFractint, PatternsThatDrawNothingAreReported) {
    EXPECT_FALSE(systems_of("A {\nangle 4\naxiom X\nX=G+X\n}\n")[0].draws);
    EXPECT_TRUE(systems_of("A {\nangle 4\naxiom X\nX=F+X\n}\n")[0].draws);
}

TEST(ImportFractint, CharactersThatWordsOfPatternsDoNotHold) {
    const std::string entry = "A {\nangle 6\naxiom #F+&F\",\n#=F!&+#F@2\n&=-F:#\n%=F\n}\n";
    const std::string pattern = imported(entry);
    EXPECT_TRUE(has(pattern, "// p23 is Fractint's #"));
    for (int order = 0; order < 5; ++order) expect_same_picture(entry, pattern, order);
}

TEST(ImportFractint, RandomSystems) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        std::mt19937 random(seed);
        const auto pick = [&](const std::vector<std::string>& list) { return list[random() % list.size()]; };
        const unsigned kind = random() % 4;  // D and M, F and G, or all
        const auto word = [&] {
            std::string text;
            int open = 0;
            for (std::size_t i = random() % 9 + 1; i > 0; --i) {
                const bool other = kind == 0 || (kind == 1 && random() % 2 == 0);
                const std::string step = other ? pick({"D", "M", "\\30", "/45.5"}) : pick({"F", "G", "+", "-", "|"});
                text += pick({step, step, "X", "Y", "!", pick({"@2", "@I2", "@q2", "@iq2", "@1.5"}), "[", "C3"});
                if (text.back() == '[') ++open;
                if (open > 0 && random() % 3 == 0) {
                    text += ']';
                    --open;
                }
            }
            return text + std::string(static_cast<std::size_t>(open), ']');
        };
        std::string entry =
            fmt::format("R {{\nangle {}\naxiom {}\nX={}\nY={}\n", 3 + random() % 12, word(), word(), word());
        if (random() % 2 == 0) entry += fmt::format("{}={}\n", kind == 0 ? "D" : "F", word());
        if (random() % 3 == 0) entry += "X=" + word() + "\n";
        entry += "}\n";
        const std::string pattern = imported(entry);
        ASSERT_FALSE(pattern.empty()) << entry;
        for (int order = 0; order < 4; ++order) {
            if (FractintTurtle(entry, order).segments.size() > 3000) break;
            expect_same_picture(entry, pattern, order, pattern.find("palette:") != std::string::npos);
            if (::testing::Test::HasFatalFailure()) return;
        }
    }
}

TEST(ImportFractint, Collections) {
    const auto systems = systems_of(
        "; of others { no }\ncomment {\n Angle 1 }\n{ nobody's }\n"
        "Kites&Darts(x) { ; by somebody; else\n ; after a book\n ANGLE 10\n AXIOM f ; }\n}\n"
        "plain text\nkites&darts {\nangle 3\naxiom F\n}  Third{\nangle 4\naxiom F}\n");
    ASSERT_EQ(systems.size(), 3U);
    EXPECT_EQ(systems[0].name, "Kites&Darts");
    EXPECT_EQ(systems[0].line, 5);
    EXPECT_TRUE(has(systems[0].pattern, "source: test.l, line 5: by somebody; else after a book }"));
    EXPECT_EQ(systems[1].line, 11);
    EXPECT_EQ(systems[2].name, "Third");
    EXPECT_EQ(import_file_name(systems[0].name), "kites-darts");
    EXPECT_EQ(import_file_name("../../Etc/Passwd "), "etc-passwd");
    EXPECT_EQ(import_file_name("\xE4\xF6"), "system");
    EXPECT_EQ(import_file_name(std::string(1000, 'x')).size(), 80U);
}

TEST(ImportFractint, MistakesAreTold) {
    const auto expect = [](const std::string& text, const std::vector<reference::Expected>& expected) {
        Diagnostics diagnostics;
        const auto systems = import_fractint(source_of(text), diagnostics);
        expect_errors(diagnostics, expected);
        for (const ImportedSystem& system : systems) EXPECT_EQ(system.pattern, "") << text;
    };
    expect("A {\nangle 4\n}\n", {{{1, 1}, "the entry 'A' has no axiom"}});
    expect("A {\naxiom F\n}\n", {{{1, 1}, "the entry 'A' has no angle"}});
    expect("A {\naxiom F\nangle 2\n}\n", {{{3, 7}, "a whole number from 3 to 50"}});
    expect("A {\naxiom F\nangle 8.5\n}\n", {{{3, 7}, "a whole number from 3 to 50"}});
    expect("A {\naxiom F\nangle\n}\n", {{{3, 5}, "a whole number from 3 to 50"}});
    expect("A {\naxiom F\nangle 8\nF=F [F]\n}\n", {{{4, 5}, "text after the word"}});
    expect("A {\naxiom F\nangle 8\n+=F\n}\n", {{{4, 1}, "a rule for the command '+' is not allowed"}});
    expect("A {\naxiom F\nangle 8\nFF=F\n}\n", {{{4, 1}, "expected 'Angle n', 'Axiom word' or a rule"}});
    expect("A {\naxiom F[+F\nangle 8\n}\n", {{{2, 8}, "this '[' is not closed"}});
    expect("A {\naxiom F@F\nangle 8\n}\n", {{{2, 8}, "a number above 0 after '@'"}});
    expect("A {\naxiom F@1.2.3F\nangle 8\n}\n", {{{2, 9}, "not a decimal number"}});
    expect("A {\naxiom F\xC3\xA4\nangle 8\n}\n", {{{2, 8}, "ASCII"}});
    expect("A {\naxiom F\nangle 8\n", {{{1, 3}, "the entry 'A' has no end: expected '}'"}});
    expect("A {\n}\nB {\naxiom F\n}\n", {{{1, 1}, "no axiom"}, {{3, 1}, "no angle"}});
    expect("nothing at all\n", {{{1, 1}, "there is no entry"}});
    expect(std::string("A {\n\0}", 6), {{{2, 1}, "a NUL byte"}});
    // What Fractint itself does not read is not read here.
    Diagnostics diagnostics;
    const auto cut = import_fractint(source_of("A {\naxiom F+F]-F\nangle 8\n}\n"), diagnostics);
    EXPECT_EQ(word_of(cut[0].pattern, 0), "F+F");
    EXPECT_TRUE(has(all_of(diagnostics), "test.l:2:10: warning: ']' without '['"));
}

}  // namespace sikku::import_test
