#include "engine/geometry/polylines.h"

#include "engine/base/monitor.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

namespace sikku::polylines_test {

using reference::grammar_of;

using Begins = std::vector<std::int64_t>;

Polylines<glm::dvec2> traced(const std::string& axiom, const TraceOptions& options = {}) {
    return trace(grammar_of("angle factor: 4\naxiom: " + axiom + "\n"), options);
}

TEST(Polylines, StrokesBeginWhereThePenWasLifted) {
    const auto lines = traced("F+F(2)f[F]-f[F]f");
    EXPECT_EQ(lines.begins, (Begins{0, 3, 5, 7}));
    ASSERT_EQ(lines.points.size(), 7U);
    EXPECT_EQ(lines.points[0], glm::dvec2(0, 0));
    EXPECT_EQ(lines.points[1], glm::dvec2(0, 1));
    EXPECT_EQ(lines.points[2], glm::dvec2(2, 1));
    EXPECT_EQ(lines.points[3], glm::dvec2(3, 1));
    EXPECT_EQ(lines.points[6], glm::dvec2(3, 3));
}

TEST(Polylines, NothingDrawnIsAnEmptyList) {
    for (const char* axiom : {"+", "f", "@."}) {
        const auto lines = traced(axiom);
        EXPECT_TRUE(lines.points.empty());
        EXPECT_EQ(lines.begins, Begins{0});
    }
}

TEST(Polylines, MovesBelongToControlPolygons) {
    TraceOptions options{.moves_draw = true};
    EXPECT_EQ(traced("FfF", options).begins, (Begins{0, 4}));
    EXPECT_EQ(traced("FfF").begins, (Begins{0, 2, 4}));
}

TEST(Polylines, InvisibleLinesAreLeftOut) {
    TraceOptions options;
    options.draws = [](const Pen& pen) { return pen.colour != 1; };
    const auto lines = traced("FF;F;FF", options);
    EXPECT_EQ(lines.begins, (Begins{0, 3, 6}));
    EXPECT_EQ(lines.points[3], glm::dvec2(0, 3));
    EXPECT_EQ(traced(";F", options).begins, Begins{0});
}

TEST(Polylines, LongStrokesAreWhole) {
    const Grammar grammar = grammar_of("axiom: F\nF --> FF\nderivation length: 15\n");
    const auto lines = trace(grammar, {});
    EXPECT_EQ(lines.begins, (Begins{0, 32769}));
    for (std::size_t i = 0; i < lines.points.size(); ++i) ASSERT_EQ(lines.points[i].y, static_cast<double>(i));
}

TEST(Polylines, LinesInSpace) {
    const Grammar grammar = grammar_of("angle factor: 4\naxiom: F&F[+F]F\n");
    ASSERT_TRUE(grammar.is_spatial());
    const auto lines = trace_in_space(grammar, {});
    EXPECT_EQ(lines.points.size(), static_cast<std::size_t>(lines.begins.back()));
    EXPECT_EQ(lines.points[0], glm::dvec3(0, 0, 0));
    EXPECT_NEAR(lines.points[1].x, 0, 1e-12);
    EXPECT_NEAR(lines.points[1].y, 1, 1e-12);
    EXPECT_NEAR(std::abs(lines.points[2].z), 1, 1e-12);
    EXPECT_EQ(lines.points.size() - (lines.begins.size() - 1), 4U);
}

TEST(Polylines, LimitsAndStops) {
    const Grammar grammar = grammar_of("axiom: F\nF --> FF\nderivation length: 40\n");
    EXPECT_THROW(trace(grammar, {}), BudgetError);
    TraceOptions options{.budget = 1e18};
    EXPECT_THROW(trace(grammar, options), BudgetError);  // 16 TB of points
    const Grammar shorter = grammar_of("axiom: F\nF --> FF\nderivation length: 24\n");
    options.watch = [](std::uint64_t) { throw Stopped(); };
    EXPECT_THROW(trace(shorter, options), Stopped);
    EXPECT_THROW(traced("F]"), WordError);
}

}  // namespace sikku::polylines_test
