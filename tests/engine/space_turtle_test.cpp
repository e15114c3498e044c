#include "engine/geometry/space_turtle.h"

#include "engine/geometry/lettering.h"
#include "engine/geometry/turtle.h"
#include "engine/language/surface.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace sikku::space_turtle_test {

using reference::expect_mistakes;
using reference::grammar_of;

struct Stem {
    glm::dvec3 from, to;
    Pen before, pen;
    bool goes_on;
};

/// All that a turtle in space hands on.
class Recorder : public SpaceSink {
public:
    void segment(const glm::dvec3& from, const Pen& before, const glm::dvec3& to, const Pen& pen,
                 bool goes_on) override {
        stems.push_back({from, to, before, pen, goes_on});
    }
    void polygon(std::span<const glm::dvec3> vertices, const Pen& pen) override {
        polygons.emplace_back(vertices.begin(), vertices.end());
        colours.push_back(pen.colour);
    }
    void facet(std::span<const glm::dvec3> vertices, std::span<const int> vertex_colours, const Pen& pen) override {
        polygon(vertices, pen);
        corner_colours.emplace_back(vertex_colours.begin(), vertex_colours.end());
    }
    void surface(const Surface& surface, const glm::dmat4x3& map, const Pen& pen) override {
        surfaces.emplace_back(surface.name, map);
        colours.push_back(pen.colour);
    }
    void sphere(const glm::dvec3& centre, double radius, const Pen&) override {
        spheres.emplace_back(centre, radius);
    }
    void label(std::string_view text, const glm::dvec3& centre, double height, const Pen&) override {
        labels.push_back({std::string(text), centre, height});
    }

    std::vector<Stem> stems;
    std::vector<std::vector<glm::dvec3>> polygons;
    std::vector<int> colours;
    std::vector<std::vector<int>> corner_colours;
    std::vector<std::pair<std::string, glm::dmat4x3>> surfaces;
    std::vector<std::pair<glm::dvec3, double>> spheres;
    struct Text {
        std::string text;
        glm::dvec3 centre;
        double height;
    };
    std::vector<Text> labels;
    SpaceSurvey survey;
};

Recorder drawn(const std::string& text) {
    const Grammar grammar = grammar_of(text);
    Recorder recorder;
    const auto turtle = SpaceTurtle::make(grammar, &recorder);
    derive(grammar, *turtle, {.interpreted = true});
    recorder.survey = turtle->survey();
    return recorder;
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, const std::string& what) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], 1e-9) << what;
}

glm::dvec3 end_of(const std::string& word, const std::string& keys = "") {
    return drawn(keys + "axiom: " + word + "\n").survey.end;
}

TEST(SpaceTurtle, EachSymbolTurnsAsItsNameSays) {
    // It starts upwards, its left to the left, its up towards the reader.
    expect_near(end_of("F"), {0, 1, 0}, "F");
    expect_near(end_of("+F"), {1, 0, 0}, "+ is to the right if nobody says otherwise");
    expect_near(end_of("+F", "turn: left\n"), {-1, 0, 0}, "+");
    expect_near(end_of("-F", "turn: left\n"), {1, 0, 0}, "-");
    expect_near(end_of("&F"), {0, 0, -1}, "down is away from the reader");
    expect_near(end_of("^F"), {0, 0, 1}, "^");
    expect_near(end_of("|F"), {0, -1, 0}, "|");
    // Rolled to the left, what is up points to the left; so pitching up goes there.
    expect_near(end_of("\\^F"), {-1, 0, 0}, "\\");
    expect_near(end_of("/^F"), {1, 0, 0}, "/");
    expect_near(end_of("/(30)^F"), {0.5, 0, std::sqrt(0.75)}, "/(30)");
    expect_near(end_of("&(60)F(2)"), {0, 1, -std::sqrt(3.0)}, "&(60)");
    expect_near(end_of("F&F&F&F"), {0, 0, 0}, "a square on edge");
    EXPECT_TRUE(drawn("axiom: F&F&F&F&\n").survey.closed);
    EXPECT_FALSE(drawn("axiom: F&F&F&\n").survey.closed);
}

TEST(SpaceTurtle, WritesLabelsWhereItIs) {
    const Recorder found =
        drawn("axiom: &F/N(2.5)F[^N(7)]A(1)\nA(x) --> N(x)\nderivation length: 1\nlabel N: v {1}\nlettering: 0.5\n");
    ASSERT_EQ(found.labels.size(), 3u);
    EXPECT_EQ(found.labels[0].text, "v 2.5");
    expect_near(found.labels[0].centre, {0, 0, -1}, "after one step");
    EXPECT_EQ(found.labels[1].text, "v 7");
    EXPECT_EQ(found.labels[2].text, "v 1");
    expect_near(found.labels[2].centre, {0, 0, -2}, "back on the axis");
    EXPECT_EQ(found.labels[2].height, 0.5);
    ASSERT_TRUE(found.survey.ink);
    EXPECT_NEAR(found.survey.ink->high.y, 0.25, 1e-12);
    EXPECT_NEAR(found.survey.ink->high.x, text_width("v 2.5", 0.5) / 2, 1e-12);
    EXPECT_EQ(found.survey.drawn, 2u);
}

TEST(SpaceTurtle, DollarLevelsItsLeft) {
    // A heading to the right, rolled by any angle: level again, its up points upwards.
    for (const char* roll : {"", "/(10)", "\\(100)", "/(180)"}) {
        expect_near(end_of(std::string("+") + roll + "$^F"), {0, 1, 0}, roll);
    }
    // Upright there is nothing to level.
    expect_near(end_of("/(30)$^F"), end_of("/(30)^F"), "upright");
    const std::string slanted = "&(20)+(50)/(77)";
    const glm::dvec3 left = end_of(slanted + "$-F", "turn: right\n");
    EXPECT_NEAR(left.y, 0.0, 1e-12);
}

/// The matrices of Prusinkiewicz and Hanan, section 2.5, on rows: heading, left, up.
class MatrixTurtle {
public:
    glm::dvec3 at{0.0};
    glm::dvec3 heading{0, 1, 0}, left{-1, 0, 0}, up{0, 0, 1};

    void turn(char symbol, double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        switch (symbol) {
            case '+':
                rotate(heading, left, a);
                break;
            case '-':
                rotate(heading, left, -a);
                break;
            case '&':
                rotate(heading, up, -a);
                break;
            case '^':
                rotate(heading, up, a);
                break;
            case '\\':
                rotate(left, up, -a);
                break;
            case '/':
                rotate(left, up, a);
                break;
            case '|':
                rotate(heading, left, std::numbers::pi);
                break;
            default:
                break;
        }
    }

private:
    /// first' = first cos a + second sin a, and so on.
    static void rotate(glm::dvec3& first, glm::dvec3& second, double a) {
        const glm::dvec3 turned = first * std::cos(a) + second * std::sin(a);
        second = second * std::cos(a) - first * std::sin(a);
        first = turned;
    }
};

TEST(SpaceTurtle, EqualsTheMatricesOfTheLiterature) {
    std::mt19937 random(6);
    for (int round = 0; round < 200; ++round) {
        const double angle = std::uniform_real_distribution(-200.0, 200.0)(random);
        std::string word;
        MatrixTurtle other;
        std::vector<MatrixTurtle> stack;
        std::vector<glm::dvec3> expected;
        double length = 0;
        for (int i = 0; i < 300; ++i) {
            const char symbol = std::string_view("F+-&^\\/|F[]FF")[random() % 13];
            if (symbol == ']' && stack.empty()) continue;
            word += symbol;
            if (symbol == 'F') {
                other.at += other.heading;
                expected.push_back(other.at);
                length += 1;
            } else if (symbol == '[') {
                stack.push_back(other);
            } else if (symbol == ']') {
                other = stack.back();
                stack.pop_back();
            } else {
                other.turn(symbol, angle);
            }
        }
        word += std::string(stack.size(), ']');
        if (!stack.empty()) other = stack.front();
        char text[32];
        std::snprintf(text, sizeof(text), "%.17g", angle);
        const Recorder found = drawn("turn: left\nangle increment: " + std::string(text) + "\naxiom: " + word + "\n");
        ASSERT_EQ(found.stems.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) expect_near(found.stems[i].to, expected[i], word);
        expect_near(found.survey.end, other.at, word);
        EXPECT_EQ(found.survey.length, length);
    }
}

TEST(SpaceTurtle, DrawsInThePlaneWhatTheTurtleOfThePlaneDraws) {
    for (const char* text :
         {"axiom: F+F+F+F\nF --> F+F-F-FF+F+F-F\nderivation length: 2\n",
          "axiom: X\nX --> F-[[X]+X]+F[+FX]-X\nF --> FF\nangle increment: 22.5\nderivation length: 4\nturn: left\n",
          "axiom: F(1.5)[+(17)F]|f-F\nheading: 20\n"}) {
        const Recorder space = drawn(text);
        const Survey plane = reference::survey_of(grammar_of(text));
        EXPECT_EQ(space.survey.drawn, plane.drawn);
        EXPECT_EQ(space.survey.moves, plane.moves);
        EXPECT_NEAR(space.survey.length, plane.length, 1e-9);
        EXPECT_EQ(space.survey.depth, plane.depth);
        EXPECT_EQ(space.survey.closed, plane.closed);
        expect_near(space.survey.end, glm::dvec3(plane.end, 0), text);
        expect_near(space.survey.box.low, glm::dvec3(plane.box.low, 0), text);
        expect_near(space.survey.box.high, glm::dvec3(plane.box.high, 0), text);
        ASSERT_TRUE(space.survey.ink && plane.ink);
        expect_near(space.survey.ink->high, glm::dvec3(plane.ink->high, 0), text);
    }
}

TEST(SpaceTurtle, IsAskedForOnlyWhereItIsNeeded) {
    EXPECT_FALSE(grammar_of("axiom: F+F[-F]\n").is_spatial());
    EXPECT_TRUE(grammar_of("axiom: F&F\n").is_spatial());
    EXPECT_TRUE(grammar_of("axiom: A\nA --> F/(90)\n").is_spatial());
    EXPECT_TRUE(grammar_of("axiom: A(1)\nA(x) --> F\\(x)A(x)\n").is_spatial());
    EXPECT_TRUE(grammar_of("axiom: F$F\n").is_spatial());
    EXPECT_TRUE(grammar_of("axiom: F\ntropism: 0 -1\nelasticity: 0.1\n").is_spatial());
    // A letter that is never reached, and a context alone, ask for nothing.
    EXPECT_FALSE(grammar_of("axiom: F\nB --> F&F\n").is_spatial());
}

TEST(SpaceTurtle, TropismTurnsByElasticityTimesSegmentCrossForce) {
    // To the right, pulled down: e |F x T| to the right after each segment.
    const std::string keys = "tropism: 0, -2, 0\nelasticity: 0.1\nheading: 0\n";
    const Recorder bent = drawn(keys + "axiom: F(3)F(1)F(1)\n");
    double angle = 0;
    glm::dvec2 at(0);
    std::vector<glm::dvec2> expected;
    for (const double length : {3.0, 1.0, 1.0}) {
        const glm::dvec2 segment = length * glm::dvec2(std::cos(angle), std::sin(angle));
        at += segment;
        expected.push_back(at);
        angle -= 0.1 * std::fabs(segment.x * -2);
    }
    ASSERT_EQ(bent.stems.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) expect_near(bent.stems[i].to, glm::dvec3(expected[i], 0), "tropism");
    // Along the force nothing bends; without drawing neither; a negative elasticity bends away.
    expect_near(end_of("FFF", "tropism: 0 1 0\nelasticity: 5\n"), {0, 3, 0}, "along");
    expect_near(end_of("fff", keys), {3, 0, 0}, "moves");
    EXPECT_GT(end_of("FF", "tropism: 0 -1 0\nelasticity: -0.2\nheading: 0\n").y, 0);
    EXPECT_LT(end_of("FF", "tropism: 0 -1 0\nelasticity: 0.2\nheading: 0\n").y, 0);
    // Towards the reader.
    EXPECT_GT(end_of("FF", "tropism: 0 0 1\nelasticity: 0.2\n").z, 0);
}

TEST(SpaceTurtle, StemsTaperFromPenToPen) {
    const Recorder found = drawn("axiom: !(4)F!(2)F[&F]+F;fF\n");
    ASSERT_EQ(found.stems.size(), 5u);
    const auto widths = [&](std::size_t i) {
        return std::pair(found.stems[i].before.width, found.stems[i].pen.width);
    };
    EXPECT_EQ(widths(0), std::pair(4.0, 4.0)) << "the first has come from nowhere";
    EXPECT_EQ(widths(1), std::pair(4.0, 2.0));
    EXPECT_EQ(widths(2), std::pair(2.0, 2.0));
    EXPECT_EQ(widths(4), std::pair(2.0, 2.0));
    std::vector<bool> goes_on;
    for (const Stem& stem : found.stems) goes_on.push_back(stem.goes_on);
    EXPECT_EQ(goes_on, (std::vector<bool>{false, true, false, false, false}));
    EXPECT_EQ(found.stems[4].pen.colour, 1);
}

TEST(SpaceTurtle, PolygonsAndSpheres) {
    const Recorder found = drawn("axiom: {f&f&f&f}f{;F+F}@O(2)@.\n");
    ASSERT_EQ(found.polygons.size(), 2u);
    ASSERT_EQ(found.polygons[0].size(), 4u) << "the return adds no vertex";
    expect_near(found.polygons[0][1], {0, 1, 0}, "second");
    expect_near(found.polygons[0][2], {0, 1, -1}, "third");
    EXPECT_EQ(found.polygons[1].size(), 3u);
    EXPECT_EQ(found.colours, (std::vector<int>{0, 1}));
    ASSERT_EQ(found.spheres.size(), 2u);
    EXPECT_EQ(found.spheres[0].second, 2.0);
    EXPECT_EQ(found.spheres[1].second, 0.0);
}

std::string word_error(const std::string& axiom) {
    return error_of<WordError>([&] { drawn("axiom: " + axiom + "\n"); });
}

TEST(SpaceTurtle, TellsThePlaceOfWhatItCannotRead) {
    EXPECT_EQ(word_error("&F]"), "symbol 3 of the word: ']' without '['");
    EXPECT_EQ(word_error("&[F"), "symbol 2 of the word: this '[' is not closed");
    EXPECT_EQ(word_error("&{F"), "symbol 2 of the word: this '{' is not closed");
    EXPECT_EQ(word_error("&F}"), "symbol 3 of the word: '}' without '{'");
    for (const char* symbol : {"F", "f", "&", "^", "/", "\\", "+", "#", ";", "@O"}) {
        EXPECT_EQ(word_error(std::string("$") + symbol + "(1/0)"),
                  "symbol 2 of the word: its parameter is not finite")
            << symbol;
    }
    EXPECT_EQ(word_error("$F(1e308)F(1e308)"),
              "symbol 2 of the word: the turtle leaves the range of its coordinates");
}

TEST(SpaceTurtle, KeysOfTropismAreChecked) {
    expect_mistakes("axiom: F\ntropism: 0 -1 0\n", {{{2, 1}, "need each other"}});
    expect_mistakes("axiom: F\nelasticity: 1\n", {{{2, 1}, "need each other"}});
    for (const char* wrong : {"0", "down", "0 -1 0 0", "0 -1 nan", "0 -1e200", ""}) {
        expect_mistakes("axiom: F\nelasticity: 1\ntropism: " + std::string(wrong) + "\n",
                        {{{3, wrong[0] ? 10 : 9}, "expected two or three numbers x, y"}});
    }
    expect_mistakes("axiom: F\nelasticity: much\ntropism: 0 1\n", {{{2, 13}, "expected a number"}});
}

// --- polygons of frameworks ---------------------------------------------------------------------------------------

/// The framework of the lily of the valley: Prusinkiewicz & Lindenmayer 1990, section 5.2.
std::string lily(int n) {
    std::string axiom;
    for (int gore = 0; gore < 5; ++gore) axiom += "[X(36)A]/(72)[X(36)B]";
    return "derivation length: " + std::to_string(n) + "\nangle increment: 9\npolygons: framework\naxiom: " + axiom +
           "\nA --> [&GA{.].\nB --> B&.G.}\nX(a) --> X(a+4.5)\ninterpret:\nX(a) --> ^(a)\n";
}

TEST(SpaceTurtle, PolygonsOfAFrameworkContinueThroughBranches) {
    const Recorder flower = drawn(lily(10));
    EXPECT_EQ(flower.stems.size(), 100u);
    EXPECT_EQ(flower.survey.polygons, 50u);
    EXPECT_EQ(flower.polygons.size(), 50u);
    // Trapezoids, and triangles at the base, of sides of one step along the ribs.
    std::size_t triangles = 0;
    for (const auto& polygon : flower.polygons) {
        triangles += polygon.size() == 3 ? 1 : 0;
        ASSERT_TRUE(polygon.size() == 3 || polygon.size() == 4);
        EXPECT_NEAR(glm::distance(polygon[0], polygon[1]), 1, 1e-9);
    }
    EXPECT_EQ(triangles, 5u);
}

TEST(SpaceTurtle, VerticesOfAFrameworkKeepTheirColours) {
    const Recorder found = drawn("polygons: framework\naxiom: {;(1).&G;(2).-G;(3).}\n");
    ASSERT_EQ(found.corner_colours.size(), 1u);
    EXPECT_EQ(found.corner_colours[0], (std::vector{1, 2, 3}));
}

TEST(SpaceTurtle, InsertedEdgesCloseCyclesInSpace) {
    const Recorder found = drawn("edges: ? #\naxiom: [&F?]^F#\n");
    ASSERT_EQ(found.polygons.size(), 1u);
    expect_near(found.polygons[0][0], {0, 0, -1}, "the beginning of the edge");
    expect_near(found.polygons[0][1], {0, 0, 0}, "the branching point");
    expect_near(found.polygons[0][2], {0, 0, 1}, "its end");
    ASSERT_EQ(found.stems.size(), 3u);
    expect_near(found.stems[2].from, {0, 0, -1}, "the edge");
    expect_near(found.stems[2].to, {0, 0, 1}, "the edge");
}

// --- surfaces ----------------------------------------------------------------------------------------------------

const std::string flat_patch =
    "patch leaf:\n"
    "-1 0 0  -0.5 0 0  0.5 0 0  1 0 0\n"
    "-1 1 0  -0.5 1 0  0.5 1 0  1 1 0\n"
    "-1 2 0  -0.5 2 0  0.5 2 0  1 2 0\n"
    "-1 3 0  -0.5 3 0  0.5 3 0  1 3 0\n";

TEST(SpaceTurtle, SurfacesStandWhereTheTurtleStandsAndTurnWithIt) {
    const auto at = [](const Recorder& found, const glm::dvec3& point) {
        return found.surfaces.at(0).second * glm::dvec4(point, 1.0);
    };
    // Upright, a patch lies on the page as it is written: x to the right, y up, z towards the reader.
    const Recorder plain = drawn(flat_patch + "axiom: F~leaf;~leaf(2)F\n");
    EXPECT_EQ(plain.surfaces.size(), 2u);
    EXPECT_EQ(plain.surfaces[0].first, "leaf");
    EXPECT_EQ(plain.colours, (std::vector{0, 1}));
    expect_near(at(plain, {1, 3, 0.5}), {1, 4, 0.5}, "upright");
    expect_near(plain.surfaces[1].second * glm::dvec4(1, 3, 0, 1), {2, 7, 0}, "twice as large");
    expect_near(plain.survey.end, {0, 2, 0}, "the turtle stays where it is");
    expect_near(at(drawn(flat_patch + "axiom: +~leaf\n"), {1, 3, 0.5}), {3, -1, 0.5}, "to the right");
    expect_near(at(drawn(flat_patch + "axiom: ^~leaf\n"), {1, 3, 0.5}), {1, -0.5, 3}, "pitched up");
    expect_near(at(drawn(flat_patch + "axiom: ~leaf(2,3,4)\n"), {1, 3, 0.5}), {2, 9, 2}, "three factors");
    expect_near(at(drawn(flat_patch + "axiom: A(2)\nA(s) --> ~leaf(s,s+1,s*s)\nderivation length: 1\n"), {1, 3, 0.5}),
                {2, 9, 2}, "three factors that a module computes");
}

}  // namespace sikku::space_turtle_test
