// tests/engine/parts_test.cpp: compares the motion and area of parts with the fold and with walking the word.
#include "engine/measure/parts.h"

#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/extent.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sikku::parts_test {

using reference::grammar_of;

/// Length, centre of mass and covariance of straight lines.
class MassSink : public PolygonSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            const glm::dvec2 way = end - at_;
            const double weight = std::hypot(way.x, way.y);
            const glm::dvec2 middle = 0.5 * (at_ + end);
            length += weight;
            sum += weight * middle;
            squares += weight * (glm::dvec3(middle.x * middle.x, middle.x * middle.y, middle.y * middle.y) +
                                 glm::dvec3(way.x * way.x, way.x * way.y, way.y * way.y) / 12.0);
            at_ = end;
        }
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}

    double length = 0;
    glm::dvec2 sum{0.0};
    glm::dvec3 squares{0.0};

private:
    glm::dvec2 at_{0.0};
};

TEST(Parts, TellOfEveryPatternWhatWalkingTells) {
    int seen = 0;
    for (const auto& file : pattern_files("patterns")) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(file.string(), contents(file), diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        const auto parts = Parts<double>::make(grammar);
        if (!parts || !parts->whole().draws()) continue;
        SCOPED_TRACE(file);
        ++seen;
        const DrawnPart<double>& whole = parts->whole();
        MassSink mass;
        const auto turtle = Turtle::drawing(grammar, mass, false);
        derive(grammar, *turtle, {.interpreted = true});
        const double size = 1e-9 * (1 + whole.extent);
        EXPECT_NEAR(whole.ink, mass.length, 1e-9 * mass.length);
        const glm::dvec2 centre = mass.sum / mass.length;
        EXPECT_NEAR(whole.centre.x, centre.x, size);
        EXPECT_NEAR(whole.centre.y, centre.y, size);
        const glm::dvec3 spread =
            mass.squares / mass.length - glm::dvec3(centre.x * centre.x, centre.x * centre.y, centre.y * centre.y);
        const double square = size * (1 + whole.extent);
        EXPECT_NEAR(whole.spread.x, spread.x, square);
        EXPECT_NEAR(whole.spread.y, spread.y, square);
        EXPECT_NEAR(whole.spread.z, spread.z, square);
        const auto folded = fold(grammar);
        ASSERT_TRUE(folded && folded->ink);
        const auto& ink = *folded->ink;
        EXPECT_NEAR(whole.low.x, ink[0].value, size);
        EXPECT_NEAR(whole.low.y, ink[1].value, size);
        EXPECT_NEAR(whole.high.x, ink[2].value, size);
        EXPECT_NEAR(whole.high.y, ink[3].value, size);
        EXPECT_LE(whole.low.x, ink[0].value);
        EXPECT_GE(whole.high.y, ink[3].value);
        EXPECT_NEAR(whole.x, folded->end[0].value, size);
        EXPECT_NEAR(whole.y, folded->end[1].value, size);
    }
    EXPECT_GT(seen, 30);
}

TEST(Parts, PlacesAreExactInTheBitsTheyHave) {
    const std::string hilbert = "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: ";
    const Grammar sixty = grammar_of(hilbert + "60\n");
    const auto long_parts = Parts<long double>::make(sixty);
    ASSERT_TRUE(long_parts);
    // The curve ends at the other corner of its side.
    const auto side = static_cast<long double>((std::int64_t{1} << 60) - 1);
    EXPECT_TRUE(std::fabs(long_parts->whole().x) == side || std::fabs(long_parts->whole().y) == side);
    EXPECT_TRUE(long_parts->whole().x == 0 || long_parts->whole().y == 0);
    const Grammar hundred = grammar_of(hilbert + "100\n");
    const auto quad_parts = Parts<Quad>::make(hundred);
    ASSERT_TRUE(quad_parts);
    Quad far = 1;
    for (int i = 0; i < 100; ++i) far *= 2;
    const Quad x = quad_parts->whole().x;
    const Quad y = quad_parts->whole().y;
    EXPECT_TRUE((x == 0 && (y == far - 1 || y == 1 - far)) || (y == 0 && (x == far - 1 || x == 1 - far)));
}

TEST(Parts, AreRefusedWhereTheyWouldLie) {
    for (const char* text :
         {"axiom: F'F\n", "axiom: F{F+F+F}\n", "axiom: F@O(2)\n", "axiom: !(2)F\n",
          "axiom: AFB\nA --> [\nB --> ]F\nderivation length: 1\n", "axiom: AB\nA < B --> F\nderivation length: 1\n",
          "axiom: F\nF --> FF\nderivation length: 2000000\n", "axiom: F\nF --> F+F-F\nderivation length: 2000\n",
          "axiom: F(1/0)\n"}) {
        EXPECT_FALSE(Parts<double>::make(grammar_of(text))) << text;
    }
    EXPECT_TRUE(Parts<double>::make(grammar_of("axiom: F[+F]F\n")));
    EXPECT_FALSE(Parts<double>::make(grammar_of("axiom: A\nA --> B\nB --> C\n"))->whole().draws());
}

}  // namespace sikku::parts_test
