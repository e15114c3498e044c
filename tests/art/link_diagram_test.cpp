#include "art/kolam/link_diagram.h"

#include "art/kolam/curve_meetings.h"
#include "art/kolam/kolam.h"
#include "tests/checks.h"
#include "tests/line_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace sikku::link_diagram_test {

using namespace line_tools;

/// Alternation as one sees it: walking along each line.
bool is_alternating(const LinkDiagram& diagram) {
    for (const LinkDiagram::Line& line : diagram.lines) {
        for (std::size_t i = 0; i < line.passes.size(); ++i) {
            if (i + 1 == line.passes.size() && !line.is_closed) break;
            const auto& next = line.passes[(i + 1) % line.passes.size()];
            if (diagram.is_over(line.passes[i]) == diagram.is_over(next)) return false;
        }
    }
    return true;
}

/// Crossings without which the drawing falls apart: the second way to count nugatory ones.
std::size_t count_cuts(const LinkDiagram& diagram) {
    const auto parts_without = [&](std::uint32_t removed) {
        std::vector<std::set<std::uint32_t>> joined(diagram.crossings());
        for (const LinkDiagram::Line& line : diagram.lines) {
            for (std::size_t i = 0; i < line.passes.size(); ++i) {
                const std::uint32_t a = line.passes[i].crossing;
                const std::uint32_t b = line.passes[(i + 1) % line.passes.size()].crossing;
                joined[a].insert(b);
                joined[b].insert(a);
            }
        }
        std::vector<bool> seen(diagram.crossings(), false);
        std::size_t parts = 0;
        for (std::uint32_t first = 0; first < diagram.crossings(); ++first) {
            if (first == removed || seen[first]) continue;
            ++parts;
            std::vector<std::uint32_t> front = {first};
            seen[first] = true;
            while (!front.empty()) {
                const std::uint32_t at = front.back();
                front.pop_back();
                for (const std::uint32_t other : joined[at]) {
                    if (other == removed || seen[other]) continue;
                    seen[other] = true;
                    front.push_back(other);
                }
            }
        }
        return parts;
    };
    const std::uint32_t nothing = static_cast<std::uint32_t>(diagram.crossings());
    std::size_t cuts = 0;
    for (std::uint32_t i = 0; i < nothing; ++i) {
        // A loop that begins and ends at a crossing falls off with it.
        bool has_loop = false;
        for (const LinkDiagram::Line& line : diagram.lines) {
            for (std::size_t k = 0; k < line.passes.size(); ++k) {
                has_loop = has_loop ||
                           (line.passes[k].crossing == i && line.passes[(k + 1) % line.passes.size()].crossing == i);
            }
        }
        cuts += has_loop || parts_without(i) > parts_without(nothing) ? 1 : 0;
    }
    return cuts;
}

LinkDiagram diagram_of(const CurvedLines& lines) {
    const CurveMeetings meetings = find_meetings(lines, 1'000'000, {});
    LinkDiagram diagram = make_curve_diagram(lines, meetings).diagram;
    EXPECT_TRUE(alternate(diagram));
    EXPECT_TRUE(is_alternating(diagram));
    return diagram;
}

TEST(LinkDiagram, TrefoilIsReducedWithThreeCrossingsOfOneSign) {
    const auto trefoil = closed_curve(
        [](double t) { return glm::dvec2(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t)); });
    const LinkDiagram diagram = diagram_of({trefoil});
    const DiagramFacts facts = diagram_facts(diagram);
    EXPECT_EQ(facts.crossings, 3u);
    EXPECT_EQ(facts.nugatory, 0u);
    EXPECT_EQ(facts.crossing_number(), 3u);
    EXPECT_EQ(std::abs(facts.writhe), 3);
    EXPECT_EQ(facts.components, 1u);
}

TEST(LinkDiagram, FigureEightKnotHasNoWrithe) {
    // Source: the parametrisation of Wikipedia's "Figure-eight knot", seen from above.
    const auto knot = closed_curve([](double t) {
        return glm::dvec2((2 + std::cos(2 * t)) * std::cos(3 * t), (2 + std::cos(2 * t)) * std::sin(3 * t));
    });
    const LinkDiagram diagram = diagram_of({knot});
    const DiagramFacts facts = diagram_facts(diagram);
    EXPECT_EQ(facts.crossings, 4u);
    EXPECT_TRUE(facts.is_reduced());
    EXPECT_EQ(facts.writhe, 0);
}

TEST(LinkDiagram, AFigureOfEightUntwists) {
    const auto eight = closed_curve([](double t) { return glm::dvec2(std::sin(2 * t), 2 * std::sin(t)); });
    const DiagramFacts facts = diagram_facts(diagram_of({eight}));
    EXPECT_EQ(facts.crossings, 1u);
    EXPECT_EQ(facts.nugatory, 1u);
    EXPECT_EQ(facts.crossing_number(), 0u);
}

TEST(LinkDiagram, TwoRingsAreLinkedAndBorromeanRingsAreNot) {
    const LinkDiagram hopf = diagram_of(joined({ring({0, 0}, 1), ring({1, 0}, 1)}));
    const DiagramFacts two = diagram_facts(hopf);
    EXPECT_EQ(two.crossings, 2u);
    EXPECT_EQ(two.components, 2u);
    EXPECT_EQ(two.linked_pairs, 1u);
    EXPECT_EQ(two.writhe, 0);

    std::vector<CurvedLines> rings;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3;
        rings.push_back(ring({0.6 * std::cos(angle), 0.6 * std::sin(angle)}, 1));
    }
    const DiagramFacts three = diagram_facts(diagram_of(joined(rings)));
    EXPECT_EQ(three.crossings, 6u);
    EXPECT_EQ(three.linked_pairs, 0u);
    EXPECT_EQ(three.nugatory, 0u);
    EXPECT_EQ(three.parts, 1u);

    const DiagramFacts apart = diagram_facts(diagram_of(joined({ring({0, 0}, 1), ring({5, 0}, 1)})));
    EXPECT_EQ(apart.crossings, 0u);
    EXPECT_EQ(apart.parts, 2u);
}

TEST(LinkDiagram, AnOpenLineThatEndsInsideCannotAlternate) {
    CurvedLines lines = joined({ring({0, 0}, 1)});
    lines.lines.push_back({lines.pieces.size(), lines.pieces.size() + 1, false, 1});
    lines.pieces.push_back({straight_curve({0, 0}, {3, 0.1}), {}, true});
    LinkDiagram diagram = make_curve_diagram(lines, find_meetings(lines, 1000, {})).diagram;
    ASSERT_EQ(diagram.crossings(), 1u);
    EXPECT_FALSE(alternate(diagram));
    // Through the ring it can.
    lines.pieces.back().curve = straight_curve({-3, 0}, {3, 0.1});
    diagram = make_curve_diagram(lines, find_meetings(lines, 1000, {})).diagram;
    ASSERT_EQ(diagram.crossings(), 2u);
    EXPECT_TRUE(alternate(diagram));
    EXPECT_TRUE(is_alternating(diagram));
}

/// The crossings of anklets are known: 4, 20, 84, 340. Each of their loops hangs on one crossing.
TEST(LinkDiagram, AnkletsAreUnknots) {
    std::uint64_t known = 4;
    for (const char* steps : {"2", "3", "4", "5"}) {
        const Drawn anklets = drawn_pattern("kolams/anklets-of-krishna", steps);
        ASSERT_TRUE(anklets.examination.diagram);
        const DiagramFacts& facts = *anklets.examination.diagram;
        EXPECT_EQ(facts.crossings, known) << steps;
        EXPECT_EQ(facts.nugatory, known) << steps;
        EXPECT_EQ(static_cast<std::uint64_t>(std::abs(facts.writhe)), known) << steps;
        known = 4 * known + 4;
    }
}

/// Two ways: from the planar graph of the control polygons, and from the curves.
TEST(LinkDiagram, KolamsHaveTheSameDiagramByGraphAndByCurve) {
    for (const char* name : {"kolams/anklets-of-krishna", "kolams/bag-of-candies", "kolams/kooja-kolam",
                             "kolams/mountain-kolam", "kolams/scissors", "kolams/snake-kolam"}) {
        SCOPED_TRACE(name);
        const Drawn kolam = drawn_pattern(name, "");
        const LinkDiagram diagram = diagram_of(kolam.lines);
        const DiagramFacts facts = diagram_facts(diagram);
        ASSERT_TRUE(kolam.examination.diagram) << kolam.examination.no_diagram;
        EXPECT_EQ(facts.crossings, kolam.examination.crossings);
        EXPECT_EQ(facts.crossings, kolam.examination.diagram->crossings);
        EXPECT_EQ(facts.nugatory, kolam.examination.diagram->nugatory);
        EXPECT_EQ(facts.writhe, kolam.examination.diagram->writhe);
        EXPECT_EQ(facts.components, kolam.examination.diagram->components);
        if (diagram.crossings() < 200) {
            EXPECT_EQ(facts.nugatory, count_cuts(diagram));
        }
    }
}

TEST(LinkDiagram, ReportsWhyThereIsNone) {
    EXPECT_TRUE(has(drawn_text("axiom: FFF\n").examination.no_diagram, "open"));
    EXPECT_TRUE(has(drawn_text("axiom: F+F+F+F+F+F+F+F\n").examination.no_diagram, "more than once"));
    EXPECT_TRUE(has(drawn_pattern("kolams/mango-leaves", "").examination.no_diagram, "more than two"));
}

}  // namespace sikku::link_diagram_test
