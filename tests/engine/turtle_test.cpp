#include "engine/geometry/turtle.h"

#include "engine/measure/extent.h"

#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sikku::turtle_test {

using reference::derived_text;
using reference::expect_mistakes;
using reference::grammar_of;
using reference::Kind;
using reference::Recorder;
using reference::survey_of;

Survey survey_of(const std::string& text) {
    return survey_of(grammar_of(text));
}
Recorder drawn(const Grammar& grammar, bool moves_draw = false) {
    Recorder recorder;
    const auto turtle = Turtle::drawing(grammar, recorder, moves_draw);
    derive(grammar, *turtle, {.interpreted = true});
    return recorder;
}
Recorder drawn(const std::string& axiom, bool moves_draw = false, const std::string& keys = "") {
    return drawn(grammar_of(keys + "axiom: " + axiom + "\n"), moves_draw);
}
std::string word_error(const std::string& axiom) {
    const Grammar grammar = grammar_of("axiom: " + axiom + "\n");
    std::string message;
    try {
        survey_of(grammar);
    } catch (const WordError& error) {
        message = error.what();
    }
    try {
        drawn(grammar);
        EXPECT_EQ(message, "");
    } catch (const WordError& error) {
        EXPECT_EQ(message, error.what());
    }
    return message;
}
using Points = std::vector<glm::dvec2>;

void expect_near(const Points& found, const Points& expected, const std::string& what, double tolerance = 1e-9) {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].x, expected[i].x, tolerance) << what;
        EXPECT_NEAR(found[i].y, expected[i].y, tolerance) << what;
    }
}

TEST(Turtle, StepsUpAndTurnsRight) {
    const Survey survey = survey_of("axiom: FF+f-F[+F(2.5)]F\n");
    EXPECT_EQ(survey.drawn, 5u);
    EXPECT_EQ(survey.moves, 6u);
    EXPECT_EQ(survey.length, 6.5);
    EXPECT_EQ(survey.box.low, glm::dvec2(0, 0));
    EXPECT_EQ(survey.box.high, glm::dvec2(3.5, 4));
    EXPECT_EQ(survey.ink->low, glm::dvec2(0, 0));
    EXPECT_EQ(survey.end, glm::dvec2(1, 4));
    EXPECT_EQ(survey.heading, 90);
    EXPECT_EQ(survey.depth, 1);
    EXPECT_FALSE(survey.closed);
}

TEST(Turtle, HeadingsAreFrom0To360) {
    for (const auto& [axiom, heading] : {std::pair{"+", 0.0},
                                         {"++", 270.0},
                                         {"+++", 180.0},
                                         {"-", 180.0},
                                         {"|", 270.0},
                                         {"++++", 90.0},
                                         {"+(30)", 60.0},
                                         {"-(0.5)", 90.5},
                                         {"+(450)", 0.0},
                                         {"-(1.23456789)+(91.23456789)", 0.0}}) {
        const double found = survey_of("axiom: " + std::string(axiom) + "\n").heading;
        EXPECT_TRUE(reference::same_heading(found, heading)) << axiom << ' ' << found;
        EXPECT_GE(found, 0);
        EXPECT_LT(found, 360);
    }
}

TEST(Turtle, InkIsOfWhatIsDrawn) {
    const Survey survey = survey_of("axiom: f+f+FF-f\n");
    ASSERT_TRUE(survey.ink);
    EXPECT_EQ(survey.ink->low, glm::dvec2(1, -1));
    EXPECT_EQ(survey.ink->high, glm::dvec2(1, 1));
    EXPECT_EQ(survey.box.high, glm::dvec2(2, 1));
    EXPECT_FALSE(survey_of("axiom: ff+f\n").ink);
}

TEST(Turtle, ClosedCurvesCloseExactly) {
    for (int k = 1; k <= 30; ++k) {
        std::string axiom;
        for (int i = 0; i < k; ++i) axiom += "F+";
        const Survey survey = survey_of("axiom: " + axiom + "\nangle factor: " + std::to_string(k) + "\n");
        EXPECT_EQ(survey.closed, k > 1) << k;
        EXPECT_NEAR(survey.heading, 90, 1e-9) << k;
    }
    EXPECT_FALSE(survey_of("axiom: F(0.001)\n").closed);
    EXPECT_TRUE(survey_of("axiom: F+(25.7)F|F-(25.7)F\n").closed);  // F, then back along it
}

void expect_like(const Survey& found, const reference::Walk& expected, const std::string& what) {
    const double tolerance = 1e-8;
    EXPECT_EQ(found.drawn, expected.drawn) << what;
    EXPECT_EQ(found.moves, expected.moves) << what;
    EXPECT_NEAR(found.length, static_cast<double>(expected.length), tolerance) << what;
    EXPECT_NEAR(found.box.low.x, static_cast<double>(expected.box[0]), tolerance) << what;
    EXPECT_NEAR(found.box.low.y, static_cast<double>(expected.box[1]), tolerance) << what;
    EXPECT_NEAR(found.box.high.x, static_cast<double>(expected.box[2]), tolerance) << what;
    EXPECT_NEAR(found.box.high.y, static_cast<double>(expected.box[3]), tolerance) << what;
    ASSERT_EQ(found.ink.has_value(), expected.ink.has_value()) << what;
    if (found.ink) {
        EXPECT_NEAR(found.ink->low.x, static_cast<double>((*expected.ink)[0]), tolerance) << what;
        EXPECT_NEAR(found.ink->low.y, static_cast<double>((*expected.ink)[1]), tolerance) << what;
        EXPECT_NEAR(found.ink->high.x, static_cast<double>((*expected.ink)[2]), tolerance) << what;
        EXPECT_NEAR(found.ink->high.y, static_cast<double>((*expected.ink)[3]), tolerance) << what;
    }
    EXPECT_NEAR(found.end.x, static_cast<double>(expected.x), tolerance) << what;
    EXPECT_NEAR(found.end.y, static_cast<double>(expected.y), tolerance) << what;
    EXPECT_TRUE(reference::same_heading(found.heading, static_cast<double>(expected.heading))) << what;
    EXPECT_EQ(found.closed, expected.closed) << what;
    EXPECT_EQ(found.depth, expected.depth) << what;
}

/// Turns, headings, lengths of all the kinds there are.
void random_turtle(reference::Dice& dice, reference::System& system) {
    const auto degrees = [&](const std::string& key, long double& value) {
        switch (dice.below(4)) {
            case 0: {
                const std::size_t k = 1 + dice.below(30);
                system.keys += key + ": 360/" + std::to_string(k) + "\n";
                value = 360.0L / static_cast<long double>(k);
                break;
            }
            case 1:
                system.keys += key + ": 25.7\n";
                value = 25.7;
                break;
            case 2:
                system.keys += key + ": -137.508\n";
                value = -137.508;
                break;
            default:
                system.keys += key + ": 1.23456789012\n";
                value = 1.23456789012;
        }
    };
    degrees("angle increment", system.increment);
    if (dice.once_in(2)) degrees("heading", system.heading);
    system.plus_turns_left = dice.once_in(2);
    if (system.plus_turns_left) system.keys += "turn: left\n";
}

TEST(Turtle, AgreesWithANaiveOne) {
    Kind kind;
    kind.letters = {"F", "f", "F(2.5)", "f(0.2)", "F(-1)", "X", "@O(2)", "@."};
    kind.signs = {"+", "-", "|", "+(60)", "-(45)", "#", "!", "#(3)", "'", ";", ",", ";(4)"};
    kind.longest = 12;
    kind.most_steps = 2;
    kind.brackets = Kind::Brackets::nested;
    std::size_t strokes = 0;
    std::size_t closed = 0;
    for (unsigned seed = 0; seed < 500; ++seed) {
        reference::Dice dice(seed + 1000);
        reference::System system = reference::random_system(seed, kind);
        random_turtle(dice, system);
        if (dice.once_in(2)) {
            system.axiom.insert(system.axiom.begin(), "{");
            system.axiom.insert(system.axiom.end() - 1, "}");
        }
        const auto word = reference::rewrite_level_by_level(system, false, 3000);
        if (!word) continue;
        const Grammar grammar = grammar_of(system.text());
        const std::string what = std::to_string(seed) + "\n" + system.text();
        expect_like(survey_of(grammar), reference::walk(system, *word), what);
        for (const bool moves_draw : {false, true}) {
            const reference::Walk expected = reference::walk(system, *word, moves_draw);
            const Recorder found = drawn(grammar, moves_draw);
            ASSERT_EQ(found.strokes.size(), expected.strokes.size()) << what;
            for (std::size_t i = 0; i < found.strokes.size(); ++i) {
                expect_near(found.strokes[i].points, expected.strokes[i].points, what, 1e-8);
                EXPECT_EQ(found.strokes[i].closed, expected.strokes[i].closed) << what;
                ASSERT_EQ(found.strokes[i].pens.size(), expected.strokes[i].pens.size()) << what;
                for (std::size_t k = 0; k < found.strokes[i].pens.size(); ++k) {
                    EXPECT_EQ(found.strokes[i].pens[k].colour, expected.strokes[i].pens[k].colour) << what;
                    EXPECT_EQ(found.strokes[i].pens[k].width_set, expected.strokes[i].pens[k].width_set) << what;
                    EXPECT_NEAR(found.strokes[i].pens[k].width, expected.strokes[i].pens[k].width, 1e-9) << what;
                }
                ++strokes;
                closed += found.strokes[i].closed ? 1 : 0;
            }
            ASSERT_EQ(found.polygons.size(), expected.polygons.size()) << what;
            for (std::size_t i = 0; i < found.polygons.size(); ++i) {
                expect_near(found.polygons[i].vertices, expected.polygons[i].vertices, what, 1e-8);
                EXPECT_EQ(found.polygons[i].pen.colour, expected.polygons[i].pen.colour);
            }
            ASSERT_EQ(found.discs.size(), expected.discs.size()) << what;
            for (std::size_t i = 0; i < found.discs.size(); ++i) {
                expect_near({found.discs[i].centre}, {expected.discs[i].centre}, what, 1e-8);
                EXPECT_EQ(found.discs[i].radius, expected.discs[i].radius);
                EXPECT_EQ(found.discs[i].pen.colour, expected.discs[i].pen.colour);
            }
        }
    }
    EXPECT_GT(strokes, 1000u);  // the systems above are not all empty
    EXPECT_GT(closed, 5u);
}

TEST(Turtle, StrokesBeginWhereThePenComesDown) {
    const Recorder plain = drawn("FF+F f F[+F]F");
    ASSERT_EQ(plain.strokes.size(), 3u);
    EXPECT_EQ(plain.strokes[0].points, (Points{{0, 0}, {0, 1}, {0, 2}, {1, 2}}));
    EXPECT_EQ(plain.strokes[1].points, (Points{{2, 2}, {3, 2}, {3, 1}}));  // '[' does not lift, ']' does
    EXPECT_EQ(plain.strokes[2].points, (Points{{3, 2}, {4, 2}}));
}

TEST(Turtle, ForASplineEveryStepIsAControlPoint) {
    const Recorder spline = drawn("f[F+f]fX+(0)F", true);
    ASSERT_EQ(spline.strokes.size(), 3u);  // only brackets and the end lift
    EXPECT_EQ(spline.strokes[0].points, (Points{{0, 0}, {0, 1}}));
    EXPECT_EQ(spline.strokes[1].points, (Points{{0, 1}, {0, 2}, {1, 2}}));
    EXPECT_EQ(spline.strokes[2].points, (Points{{0, 1}, {0, 2}, {0, 3}}));
    EXPECT_TRUE(drawn("f+f+f+f", true).strokes.at(0).closed);
    EXPECT_TRUE(drawn("f+f+f+f").strokes.empty());
}

TEST(Turtle, BracketsRestorePenAndPlace) {
    const Recorder found = drawn("F[;(3)#(2)+F]F");
    ASSERT_EQ(found.strokes.size(), 2u);
    EXPECT_EQ(found.strokes[0].pens[1].colour, 3);
    EXPECT_EQ(found.strokes[0].pens[1].width, 2);
    EXPECT_TRUE(found.strokes[0].pens[1].width_set);
    EXPECT_EQ(found.strokes[1].points, (Points{{0, 1}, {0, 2}}));
    EXPECT_EQ(found.strokes[1].pens[0], Pen());
}

TEST(Turtle, PensTravelAlongTheStroke) {
    const Recorder found = drawn("F;F;;F,F'F,(7)F#F!F!F#(0.5)F!(4)F");
    ASSERT_EQ(found.strokes.size(), 1u);
    std::vector<int> colours;
    std::vector<double> widths;
    for (const Pen& pen : found.strokes[0].pens) {
        colours.push_back(pen.colour);
        widths.push_back(pen.width);
    }
    EXPECT_EQ(colours, (std::vector{0, 1, 3, 2, 3, 7, 7, 7, 7, 7, 7}));
    EXPECT_EQ(widths, (std::vector{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.25, 1.0, 0.8, 0.5, 4.0}));
    EXPECT_FALSE(found.strokes[0].pens[8].width_set);
    EXPECT_TRUE(found.strokes[0].pens[9].width_set);
}

TEST(Turtle, PolygonsOfAFrameworkHaveTheVerticesThatAreMarked) {
    const auto framed = [](const std::string& axiom) { return drawn(axiom, false, "polygons: framework\n"); };
    // { and the ends of G and g are not vertices; those of F and f and . are.
    EXPECT_EQ(framed("G{F+f+F}").polygons.at(0).vertices, (Points{{0, 2}, {1, 2}, {1, 1}}));
    EXPECT_EQ(framed("{.G+g.+G.}").polygons.at(0).vertices, (Points{{0, 0}, {1, 1}, {1, 0}}));
    EXPECT_EQ(framed("{.G+g.+G.}").strokes.size(), 2u);
    EXPECT_EQ(framed("{[-G.]G.[+G.]}").polygons.at(0).vertices, (Points{{-1, 0}, {0, 1}, {1, 1}}));
    // Vertices in one place are one.
    EXPECT_EQ(framed("{..G.[+G.][.]-G.|G}").polygons.at(0).vertices,
              (Points{{0, 0}, {0, 1}, {1, 1}, {0, 1}, {-1, 1}}));
    EXPECT_TRUE(framed("{.G.G}{..}").polygons.empty());
    // Without the key, G, g and . have no meaning.
    EXPECT_TRUE(drawn("{.G.+g.}").polygons.empty());
    EXPECT_EQ(drawn("GFgF").strokes.at(0).points.size(), 3u);
    EXPECT_EQ(drawn("{.G+g.+G.}", false, "polygons: framework\nforward: G\nmove: g\n").polygons.at(0).vertices.size(),
              4u);
    // Under splines, their edges are straight.
    EXPECT_EQ(drawn("{F+f+F}", true, "polygons: framework\n").polygons.size(), 1u);
    expect_mistakes("axiom: F\npolygons: both\n", {{{2, 11}, "'outline' or 'framework'"}});
}

TEST(Turtle, TheBladeOfTheCordateLeafIsASetOfTriangles) {
    const std::string system =
        "angle increment: 9.5\nturn: left\npolygons: framework\nderivation length: 17\n"
        "axiom: [A][B]\nA --> [+A{.].C.}\nB --> [-B{.].C.}\nC --> GC\n";
    const Recorder leaf = drawn(grammar_of(system));
    const Measurement measured = measure(grammar_of(system), 1e6);
    EXPECT_EQ(measured.drawn.value, 272);
    EXPECT_EQ(measured.polygons.value, 34);
    EXPECT_FALSE(measured.derived);
    // The innermost has no area, nor has the next, whose sides are one axis.
    EXPECT_EQ(leaf.polygons.size(), 30u);
    for (const auto& polygon : leaf.polygons) EXPECT_EQ(polygon.vertices.size(), 3u);
}

TEST(Turtle, GeneralisedCylindersAreRefused) {
    const std::string essence = "symbol 2 of the word: '{' with a parameter begins a generalised cylinder";
    for (int type = 1; type <= 4; ++type) {
        EXPECT_TRUE(word_error("F{(" + std::to_string(type) + ")FF}").starts_with(essence));
        EXPECT_THROW(measure(grammar_of("axiom: F{(" + std::to_string(type) + ")FF}\n"), 1e6), WordError);
    }
    EXPECT_THROW(measure(grammar_of("axiom: A(1)\nA(n) --> F{(n+1)F}\nderivation length: 1\n"), 1e6), WordError);
    EXPECT_THROW(drawn("&{(2)FF}"), WordError);
    // {(0) is { in cpfg.
    EXPECT_EQ(drawn("{(0)F+F}").polygons.size(), 1u);
}

TEST(Turtle, InsertedEdgesCloseThePathBetweenTheirEnds) {
    const auto edged = [](const std::string& axiom, bool moves_draw = false) {
        return drawn(axiom, moves_draw, "edges: ? #\n");
    };
    const Recorder found = edged("[-F?]F+F#");
    ASSERT_EQ(found.polygons.size(), 1u);
    EXPECT_EQ(found.polygons[0].vertices, (Points{{-1, 0}, {0, 0}, {0, 1}, {1, 1}}));
    ASSERT_EQ(found.strokes.size(), 3u);
    EXPECT_EQ(found.strokes[2].points, (Points{{-1, 0}, {1, 1}}));
    // They nest as brackets do. A place is left where it was entered.
    EXPECT_EQ(edged("[-F?F?]F#F#").polygons.size(), 2u);
    EXPECT_EQ(edged("[-F?F?]F#F#").polygons.at(0).vertices, (Points{{-2, 0}, {-1, 0}, {0, 0}, {0, 1}}));
    EXPECT_EQ(edged("F[F][-F?][F]+F#").polygons.at(0).vertices, (Points{{-1, 1}, {0, 1}, {1, 1}}));
    // Of length zero, and along an axis: nothing, and a line.
    EXPECT_TRUE(edged("[?]#").strokes.empty());
    EXPECT_EQ(edged("[?]F#").strokes.size(), 2u);
    EXPECT_TRUE(edged("[?]F#").polygons.empty());
    // # widens the pen where it is not the end of an edge.
    EXPECT_EQ(drawn("F#F").strokes.at(0).pens.at(1).width, 1.25);
    EXPECT_THROW(edged("F#"), WordError);
    EXPECT_THROW(edged("F?"), WordError);
    expect_mistakes("axiom: F\nedges: ?\n", {{{2, 8}, "expected two symbols"}});
    expect_mistakes("axiom: F\nedges: ? ?\n", {{{2, 8}, "expected two symbols"}});
}

TEST(Turtle, TheCordateLeafHasAnEdgeBetweenNeighbouringAxes) {
    const std::string system =
        "turn: left\nforward: I\nedges: ? #\nangle increment: 10\nderivation length: 4\n"
        "axiom: [A][B]\nA --> [+A?]C#\nB --> [-B?]C#\nC --> IC\n";
    const Grammar grammar = grammar_of(system);
    const Recorder leaf = drawn(grammar);
    // Of four edges on either side one has no length, one lies on an axis, and two complete triangles.
    EXPECT_EQ(leaf.polygons.size(), 4u);
    EXPECT_EQ(measure(grammar, 1e6).polygons.value, 8);
    EXPECT_EQ(measure(grammar, 1e6).drawn.value, 12);
    // The left half, as section 4.2 prints it; the other half is its mirror image.
    EXPECT_EQ(derived_text(grammar).substr(0, 33), "[[+[+[+[+A?]C#?]IC#?]IIC#?]IIIC#]");
    // Axis k has k steps, 10 (3 - k) degrees to the left of the midrib; edge k joins the tips of axes k and k + 1.
    const auto tip = [](int k) {
        const double angle = (90 + 10 * (3 - k)) * M_PI / 180;
        return double(k) * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    const auto lines = [&](const glm::dvec2& from, const glm::dvec2& to) {
        return std::count_if(leaf.strokes.begin(), leaf.strokes.end(), [&](const auto& stroke) {
            return glm::distance(stroke.points.front(), from) < 1e-9 &&
                   glm::distance(stroke.points.back(), to) < 1e-9;
        });
    };
    // The innermost, of length 0, is not drawn; the next lies on an axis, which is drawn as well.
    EXPECT_EQ(lines({0, 0}, {0, 0}), 0);
    EXPECT_EQ(lines({0, 0}, tip(1)), 2);
    EXPECT_EQ(lines({0, 0}, tip(2)), 1);
    EXPECT_EQ(lines(tip(1), tip(2)), 1);
    EXPECT_EQ(lines(tip(2), tip(3)), 1);
}

TEST(Turtle, BothVersionsOfTheCordateLeafAreOneShape) {
    // Inserted edges ? # and marks . on the same axes fill the same triangles.
    const std::string keys = "turn: left\nangle increment: 9.5\nderivation length: 17\n";
    const Recorder edged = drawn(grammar_of(keys + "forward: I\nedges: ? #\naxiom: [A][B]\nA --> [+A?]C#\n"
                                                   "B --> [-B?]C#\nC --> IC\n"));
    const Recorder framed = drawn(grammar_of(keys + "polygons: framework\naxiom: [A][B]\nA --> [+A{.].C.}\n"
                                                    "B --> [-B{.].C.}\nC --> GC\n"));
    const auto triangles = [](const Recorder& recorder) {
        std::vector<std::vector<std::pair<long, long>>> result;
        for (const auto& polygon : recorder.polygons) {
            // Inserted edges have a vertex at each step of an axis.
            const auto& points = polygon.vertices;
            std::vector<std::pair<long, long>> corners;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::dvec2 in = points[i] - points[(i + points.size() - 1) % points.size()];
                const glm::dvec2 out = points[(i + 1) % points.size()] - points[i];
                if (std::fabs(in.x * out.y - in.y * out.x) < 1e-9 && glm::dot(in, out) > 0) continue;
                corners.emplace_back(std::lround(points[i].x * 1e6), std::lround(points[i].y * 1e6));
            }
            std::sort(corners.begin(), corners.end());
            if (corners.size() == 3) result.push_back(corners);
        }
        std::sort(result.begin(), result.end());
        return result;
    };
    EXPECT_EQ(triangles(edged).size(), 30u);
    EXPECT_EQ(triangles(edged), triangles(framed));
}

TEST(Turtle, PolygonsTakeTheirFirstVertexFromTheBrace) {
    EXPECT_EQ(drawn("f{F+f+F}").polygons.at(0).vertices, (Points{{0, 1}, {0, 2}, {1, 2}, {1, 1}}));
    EXPECT_EQ(drawn("{F+F+F+F}").polygons.at(0).vertices.size(), 4u);  // a return to the start adds none
    EXPECT_EQ(drawn("{.F[+F]-F}").polygons.at(0).vertices, (Points{{0, 0}, {0, 1}, {1, 1}, {-1, 1}}));
    EXPECT_TRUE(drawn("{F}{}{F|F}").polygons.empty());  // fewer than three vertices
    EXPECT_EQ(drawn("{;(5)F+F+F}").polygons.at(0).pen.colour, 5);
    // They nest: a step belongs to the innermost.
    const auto nested = drawn("{F+{F+F+F}+F+F}").polygons;
    ASSERT_EQ(nested.size(), 2u);
    EXPECT_EQ(nested[0].vertices, (Points{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
    EXPECT_EQ(nested[1].vertices.size(), 4u);
    // For all kinds of angles, as a turtle that comes back only nearly would add one.
    for (const char* k : {"3", "5", "7", "11", "13", "14", "31", "360"}) {
        std::string axiom = "{";
        for (int i = 0; i < std::atoi(k); ++i) axiom += "F+";
        EXPECT_EQ(drawn(axiom + "}", false, "angle factor: " + std::string(k) + "\n").polygons.at(0).vertices.size(),
                  static_cast<std::size_t>(std::atoi(k)))
            << k;
    }
}

TEST(Turtle, DiscsLieWhereTheTurtleIs) {
    const auto discs = drawn("F@.F@O@O(2.5)").discs;
    ASSERT_EQ(discs.size(), 3u);
    EXPECT_EQ(discs[0].centre, glm::dvec2(0, 1));
    EXPECT_EQ(discs[0].radius, 0);
    EXPECT_EQ(discs[1].radius, 1);
    EXPECT_EQ(discs[2].centre, glm::dvec2(0, 2));
    EXPECT_EQ(discs[2].radius, 2.5);
}

TEST(Turtle, TheThirdDimensionIsPassedOver) {
    EXPECT_EQ(survey_of("axiom: F&F^F\\F/F$F?F\n").end, glm::dvec2(0, 7));
}

TEST(Turtle, LongStrokesArriveWhole) {
    const Recorder found = drawn(grammar_of("axiom: F\nderivation length: 7\nF --> F-F++F-F\nangle factor: 6\n"));
    ASSERT_EQ(found.strokes.size(), 1u);
    EXPECT_EQ(found.strokes[0].points.size(), 16385u);
    EXPECT_EQ(found.strokes[0].points.back(), glm::dvec2(0, 2187));
}

TEST(TurtleErrors, NameThePositionInTheWord) {
    EXPECT_TRUE(has(word_error("F]F"), "symbol 2 of the word: ']' without '['"));
    EXPECT_TRUE(has(word_error("F[+F[-F]F"), "symbol 2 of the word: this '[' is not closed"));
    EXPECT_TRUE(has(word_error("F[+F[-F"), "symbol 5 of the word: this '[' is not closed"));
    EXPECT_TRUE(has(word_error("F}"), "symbol 2 of the word: '}' without '{'"));
    EXPECT_TRUE(has(word_error("F{{F}"), "symbol 2 of the word: this '{' is not closed"));
    EXPECT_TRUE(has(word_error("FF+(10^400)"), "symbol 3 of the word"));
    EXPECT_EQ(word_error("F[+F[-F]F]"), "");
    EXPECT_EQ(word_error("{[}]"), "");  // they need not nest in one another
}

TEST(TurtleErrors, NothingWraps) {
    // 2^63 units of a millionth of a step are 9.2 x 10^12 steps.
    std::string axiom = "F(0.000001)";
    for (int i = 0; i < 20; ++i) axiom += "F(1000000000000)";
    try {
        const Survey survey = survey_of("axiom: " + axiom + "\n");
        EXPECT_NEAR(survey.end.y, 2e13, 1);
        EXPECT_NEAR(survey.box.high.y, 2e13, 1);
    } catch (const WordError&) {
        SUCCEED();  // it may refuse
    }
}

}  // namespace sikku::turtle_test
