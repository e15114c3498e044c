// Predefined surfaces: files of cpfg, patches in patterns, and what is wrong with them.
#include "engine/language/surface.h"

#include "engine/geometry/space_turtle.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace sikku::surface_test {

using reference::expect_mistakes;
using reference::grammar_of;

const std::filesystem::path corpus = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/surfaces";

Surface surface_of(const std::string& text, Diagnostics& diagnostics) {
    return read_surface(std::make_shared<const Source>("leaf.s", text), diagnostics);
}

TEST(Surface, FilesAreRead) {
    Diagnostics diagnostics;
    const Surface leaf = surface_of(contents(corpus / "two-patches.s"), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_EQ(leaf.size, 302);
    EXPECT_EQ(leaf.contact, glm::dvec3(0, 0, 0));
    EXPECT_EQ(leaf.end, glm::dvec3(0, 302, 0));
    EXPECT_EQ(leaf.heading, glm::dvec3(0, 1, 0));
    EXPECT_EQ(leaf.up, glm::dvec3(0, 0, 1));
    ASSERT_EQ(leaf.patches.size(), 2u);
    EXPECT_EQ(leaf.patches[0].points[4], glm::dvec3(-40, 90, -20));
    EXPECT_EQ(leaf.patches[1].points[11], glm::dvec3(43, 190, -20));
    EXPECT_EQ(leaf.patches[0].colour, 0);
    EXPECT_EQ(leaf.patches[1].colour, 2);
    EXPECT_EQ(leaf.patches[0].neighbours, std::vector<std::size_t>{1});
    EXPECT_EQ(leaf.patches[1].neighbours, std::vector<std::size_t>{0});
    // Without settings a unit is a step, and the turtle stays at the origin.
    const Surface plain = surface_of(contents(corpus / "plain.s"), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_EQ(plain.size, 1);
    EXPECT_EQ(plain.end, plain.contact);
}

TEST(Surface, EachFaultHasItsPlace) {
    struct Fault {
        const char *from, *to;
        Place where;
        const char* essence;
    };
    const std::string text = contents(corpus / "two-patches.s");
    for (const Fault& fault : {Fault{"302.0 -21.5", "302.0 x", {1, 22}, "expected a number"},
                               {"T: 5", "T: 5 6", {2, 21}, "expected the end of the line"},
                               {"CONTACT POINT X", "CONTACT PINT X", {3, 9}, "expected 'POINT'"},
                               {"X: 0.0 Y: 1.0 Z", "X: 0.0 Y: 0.0 Z", {6, 1}, "two directions"},
                               {"SIZE: 302.0", "SIZE: 0", {7, 1}, "above 0"},
                               {"DIFFUSE: 0.50 BOTTOM", "BOTTOM", {9, 14}, "expected 'DIFFUSE:'"},
                               {"R: right", "R: wrong", {11, 9}, "no patch has this name"},
                               {"-40 90 -20 ", "-40 90 ", {14, 1}, "expected a number"},
                               {"-40 90 -20 ", "-40 90 1e10", {14, 8}, "expected a number"}}) {
        std::string faulty = text;
        const std::size_t at = faulty.find(fault.from);
        ASSERT_NE(at, std::string::npos) << fault.from;
        faulty.replace(at, std::string(fault.from).size(), fault.to);
        Diagnostics diagnostics;
        surface_of(faulty, diagnostics);
        ASSERT_EQ(diagnostics.list().size(), 1u) << fault.to;
        EXPECT_EQ(diagnostics.list()[0].where, fault.where) << fault.to;
        EXPECT_TRUE(has(diagnostics.list()[0].message, fault.essence));
        EXPECT_EQ(diagnostics.list()[0].file, "leaf.s");
    }
    for (std::size_t length = 0; length + 100 < text.size(); length += 7) {
        Diagnostics diagnostics;
        const Surface surface = surface_of(text.substr(0, length), diagnostics);
        EXPECT_TRUE(diagnostics.has_errors() || surface.patches.size() == 1) << length;
    }
}

const std::string flat_patch =
    "patch leaf:\n"
    "0 0 0, 1 0 0, 2 0 0, 3 0 0\n0 1 0, 1 1 0, 2 1 0, 3 1 0\n"
    "0 2 0, 1 2 0, 2 2 0, 3 2 0\n0 3 0, 1 3 0, 2 3 0, 3 3 0\n";

TEST(Surface, PatternsStatePatches) {
    const Grammar grammar = grammar_of(flat_patch + "axiom: F~leaf(2)~leaf\n" + flat_patch);
    ASSERT_EQ(grammar.surfaces().size(), 1u);
    EXPECT_EQ(grammar.surfaces()[0]->name, "leaf");
    EXPECT_EQ(grammar.surfaces()[0]->patches.size(), 2u);
    EXPECT_TRUE(grammar.surfaces()[0]->is_smooth);
    EXPECT_TRUE(grammar.is_spatial());
    EXPECT_EQ(to_text(grammar, grammar.axiom()), "F ~leaf(2) ~leaf");
    EXPECT_FALSE(grammar_of(flat_patch + "axiom: F\n").is_spatial()) << "a surface that is not used";
    // Names of symbols and of surfaces do not meet; without surfaces ~ is a symbol like others.
    EXPECT_EQ(grammar_of("symbols: leaf\naxiom: leaf ~leaf\n" + flat_patch).axiom().size(), 2u);
    EXPECT_EQ(grammar_of("axiom: ~leaf\n").axiom().size(), 5u);
}

TEST(Surface, MistakesInPatternsHaveTheirPlace) {
    expect_mistakes("axiom: F~petal\n" + flat_patch, {{{1, 9}, "the name of a surface after '~'"}});
    expect_mistakes("axiom: F\npatch leaf:\n1 2 3\n", {{{2, 7}, "48 numbers; here are 3"}});
    expect_mistakes("axiom: F\npatch leaf:\n1 2 x3\n", {{{3, 5}, "expected a coordinate"}});
    expect_mistakes("axiom: F\npatch:\n", {{{2, 1}, "'patch NAME:'"}});
    expect_mistakes("axiom: F\npatch 1a:\n", {{{2, 7}, "a name is letters and digits"}});
    expect_mistakes("axiom: F\n1 2 3\n", {{{2, 1}, "expected 'key: value'"}});
    expect_mistakes("axiom: F\nsurface: leaf\n", {{{2, 10}, "expected NAME = FILE"}});
    expect_mistakes("axiom: F\nsurface: leaf = missing.s\n", {{{2, 17}, "missing.s"}});
    expect_mistakes("axiom: F\nsurface: leaf = /dev/zero\n", {{{2, 17}, ""}});
}

TEST(Surface, FilesLieBesideThePattern) {
    const std::string text = "axiom: ~leaf(2)F~leaf\nsurface: leaf = two-patches.s, other = plain.s\n";
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern(corpus / "test.lsys", text, diagnostics);
    const Grammar grammar = compile_grammar(pattern, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.sorted()) ADD_FAILURE() << diagnostic.text();
    ASSERT_EQ(grammar.surfaces().size(), 2u);
    EXPECT_EQ(grammar.surfaces()[0]->patches.size(), 2u);
    ASSERT_TRUE(grammar.surfaces()[0]->source);
    EXPECT_EQ(grammar.surfaces()[0]->source->name(), "two-patches.s");
    // The turtle goes on from the end point: (302 - 0) / 302 steps, times the factor.
    const auto turtle = SpaceTurtle::make(grammar);
    derive(grammar, *turtle);
    EXPECT_NEAR(turtle->survey().end.y, 2 + 1 + 1, 1e-12);
}

TEST(Surface, TheEndPointMovesTheTurtle) {
    // By (end - contact) scale / SIZE, turned from the file's heading and up to the turtle's.
    std::string text = contents(corpus / "two-patches.s");
    const auto replace = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    };
    replace("CONTACT POINT X: 0.0 Y: 0.0 Z: 0.0", "CONTACT POINT X: 1 Y: 2 Z: 3");
    replace("END POINT X: 0.0 Y: 302.0 Z: 0.0", "END POINT X: 5 Y: 12 Z: -4");
    replace("HEADING X: 0.0 Y: 1.0 Z: 0.0", "HEADING X: 2 Y: 0 Z: 0");
    replace("UP X: 0.0 Y: 0.0 Z: 1.0", "UP X: 3 Y: 5 Z: 0");
    replace("SIZE: 302.0", "SIZE: 4");
    const ScratchFolder folder;
    folder.write("leaf.s", text);
    const auto end = [&](const std::string& axiom) {
        Diagnostics diagnostics;
        const Pattern pattern =
            parse_pattern(folder / "test.lsys", axiom + "\nsurface: leaf = leaf.s\n", diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        for (const Diagnostic& diagnostic : diagnostics.sorted()) ADD_FAILURE() << diagnostic.text();
        const auto turtle = SpaceTurtle::make(grammar);
        derive(grammar, *turtle);
        return turtle->survey().end;
    };
    // (4, 10, -7): 4 ahead, 10 up, and 7 against heading x up, which a rotation turns to the turtle's right. Upright,
    // ahead is y, right is x and up is z.
    const auto expect = [&](const std::string& axiom, const glm::dvec3& wanted) {
        EXPECT_LT(glm::distance(end(axiom), wanted), 1e-12) << axiom;
    };
    expect("axiom: ~leaf", glm::dvec3(-7, 4, 10) / 4.0);
    expect("axiom: ~leaf(2)", glm::dvec3(-7, 4, 10) / 2.0);
    expect("axiom: ~leafF", glm::dvec3(-7, 4 + 4, 10) / 4.0);
    expect("axiom: F+(90)~leaf", glm::dvec3(4, 4 + 7, 10) / 4.0);
}

}  // namespace sikku::surface_test
