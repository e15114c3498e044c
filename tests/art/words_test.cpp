#include "art/prints.h"
#include "art/product/highlight.h"
#include "art/product/rule_figures.h"
#include "art/words/tidy_tree.h"
#include "art/words/word_svg.h"
#include "engine/geometry/turtle.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <pugixml.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace sikku::words_test {

Document pattern_of(const std::string& name, int steps) {
    return load(name, {"", {{"derivation length", std::to_string(steps)}}});
}

// Trees: the aesthetics of Reingold & Tilford 1981.

/// A complete tree, level by level.
std::vector<TidyNode> complete_tree(std::size_t children, int levels) {
    std::vector<TidyNode> nodes;
    std::size_t next = 1, of_level = 1;
    for (int level = 0; level < levels; ++level, of_level *= children) {
        for (std::size_t i = 0; i < of_level; ++i) {
            const bool is_leaf = level + 1 == levels;
            nodes.push_back({is_leaf ? 0 : next, is_leaf ? 0 : children, 1});
            if (!is_leaf) next += children;
        }
    }
    return nodes;
}

TEST(TidyTree, ACompleteTreeIsAsWideAsItsLeaves) {
    for (const std::size_t children : {2U, 3U}) {
        const auto nodes = complete_tree(children, 5);
        const auto places = tidy_places(nodes);
        const std::size_t leaves = children == 2 ? 16 : 81;
        for (std::size_t i = nodes.size() - leaves + 1; i < nodes.size(); ++i) {
            EXPECT_NEAR(places[i] - places[i - 1], 1, 1e-9);
        }
        EXPECT_NEAR(places[0], 0, 1e-9);
        EXPECT_NEAR(places.back() + places[nodes.size() - leaves], 0, 1e-9);
    }
}

/// The tree of a word, below a root.
std::vector<TidyNode> tree_of(const WordTable& table) {
    std::vector<TidyNode> nodes = {{1, table.rows.front().symbols.size(), 0}};
    for (const TableRow& row : table.rows) {
        const std::size_t below = nodes.size() + row.symbols.size();
        for (const TableSymbol& symbol : row.symbols) {
            nodes.push_back({below + symbol.first_child, symbol.children, static_cast<double>(symbol.width) + 1});
        }
    }
    return nodes;
}

TEST(TidyTree, NodesKeepTheirDistanceAndParentsAreCentred) {
    for (const auto& [name, steps] : std::map<std::string, int>{
             {"fibonacci-words", 7}, {"branch-shedding", 5}, {"hormone", 4}, {"stochastic-branches", 2}}) {
        SCOPED_TRACE(name);
        const Grammar grammar = pattern_of(name, steps).grammar();
        const WordTable table = lay_out_words(grammar, word_lineage(grammar, 0, steps, false, {}));
        const auto nodes = tree_of(table);
        const auto places = tidy_places(nodes);
        std::size_t begin = 1;
        for (const TableRow& row : table.rows) {
            for (std::size_t i = begin + 1; i < begin + row.symbols.size(); ++i) {
                EXPECT_GE(places[i] - places[i - 1], (nodes[i].width + nodes[i - 1].width) / 2 - 1e-9);
            }
            begin += row.symbols.size();
        }
        for (std::size_t v = 0; v < nodes.size(); ++v) {
            if (nodes[v].children == 0) continue;
            const std::size_t first = nodes[v].first_child;
            EXPECT_NEAR(places[v], (places[first] + places[first + nodes[v].children - 1]) / 2, 1e-9);
        }
    }
}

/// A tree and its mirror image are drawn as mirror images.
TEST(TidyTree, IsSymmetric) {
    // A root with a leaf, a node with three leaves, and a leaf; and the mirror of an uneven tree.
    const std::vector<TidyNode> uneven = {{1, 3, 1}, {4, 4, 1}, {0, 0, 1}, {8, 1, 1}, {0, 0, 1},
                                          {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    const std::vector<TidyNode> mirrored = {{1, 3, 1}, {4, 1, 1}, {0, 0, 1}, {5, 4, 1}, {0, 0, 1},
                                            {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    const auto one = tidy_places(uneven), other = tidy_places(mirrored);
    EXPECT_NEAR(one[1], -other[3], 1e-9);
    EXPECT_NEAR(one[2], -other[2], 1e-9);
    EXPECT_NEAR(one[4], -other[8], 1e-9);
    EXPECT_NEAR(one[8], -other[4], 1e-9);
}

// SVG

std::vector<std::string> texts_of(const pugi::xml_node& node, const std::string& style) {
    std::vector<std::string> found;
    for (const pugi::xml_node& child : node.children()) {
        if (std::string(child.name()) == "text" && child.attribute("class").value() == style) {
            found.emplace_back(child.text().get());
        }
        const auto inner = texts_of(child, style);
        found.insert(found.end(), inner.begin(), inner.end());
    }
    return found;
}

/// Figure 1.3 has 1 + 1 + 2 + 3 + 5 + 8 letters: those of the last word are not replaced.
TEST(WordSvg, HasTheLettersOfFigure13) {
    const Document document = pattern_of("fibonacci-words", 5);
    const WordTable table = lay_out_words(document.grammar(), word_lineage(document.grammar(), 0, 5, false, {}));
    for (const std::string& svg :
         {words_svg(table, word_figure(document.pattern())), tree_svg(table, word_figure(document.pattern()))}) {
        pugi::xml_document parsed;
        ASSERT_TRUE(parsed.load_string(svg.c_str()));
        EXPECT_EQ(texts_of(parsed, "l").size(), 12U);
        EXPECT_EQ(texts_of(parsed, "s").size(), 8U);
        EXPECT_EQ(texts_of(parsed, "rule"), (std::vector<std::string>{"axiom: b", "a → ab", "b → a"}));
        EXPECT_EQ(parsed.child("svg").child_value("desc"), document.source().text());
    }
}

TEST(WordSvg, EscapesAndShowsErasedSymbols) {
    const Document document = parse("erased", "axiom: A&\nderivation length: 1\nA --> *\n& --> AA\ntitle: A & B\n");
    const WordTable table = lay_out_words(document.grammar(), word_lineage(document.grammar(), 0, 1, false, {}));
    const std::string svg = tree_svg(table, word_figure(document.pattern()));
    pugi::xml_document parsed;
    ASSERT_TRUE(parsed.load_string(svg.c_str()));
    EXPECT_EQ(texts_of(parsed, "c"), std::vector<std::string>{"ε"});
    EXPECT_EQ(texts_of(parsed, "l"), (std::vector<std::string>{"A", "&"}));
}

// Productions

Survey survey_of(const Grammar& grammar) {
    const auto turtle = Turtle::surveying(grammar);
    derive(grammar, *turtle);
    return turtle->survey();
}

RuleFigures figures_of(const Document& document) {
    Diagnostics diagnostics;
    return rule_figures(document, read_style(document.pattern(), 96, diagnostics), 1e6, {});
}

/// The edge and the path that replaces it have the same ends, as in figure 7 of Prusinkiewicz, Hammel, Hanan & Mech
/// 1996. Koch's path is three steps from end to end, and has four edges.
TEST(RuleFigures, AnEdgeEndsWhereItsPathEnds) {
    for (const char* name : {"koch-curve", "koch-island", "snowflake", "dragon-subword", "quadratic-snowflake"}) {
        SCOPED_TRACE(name);
        const RuleFigures found = figures_of(load(name));
        ASSERT_FALSE(found.figures.empty());
        for (const RuleFigure& figure : found.figures) {
            const glm::dvec2 one = survey_of(*figure.predecessor).end, other = survey_of(*figure.successor).end;
            EXPECT_NEAR(glm::length(one - other), 0, 1e-9) << figure.before;
        }
    }
    const RuleFigures koch = figures_of(load("koch-curve"));
    EXPECT_NEAR(survey_of(*koch.figures.front().predecessor).length, 3, 1e-9);
    EXPECT_EQ(survey_of(*koch.figures.front().successor).drawn, 4U);
}

/// A rhomb of Penrose grows by the golden ratio in each step.
TEST(RuleFigures, TilesGrowAsStepsDo) {
    const RuleFigures found = figures_of(load("penrose-rhombs"));
    ASSERT_EQ(found.figures.size(), 2U);
    const Survey tile = survey_of(*found.figures.front().predecessor);
    EXPECT_EQ(tile.polygons, 1U);
    EXPECT_NEAR(tile.length, 4 * (1 + std::sqrt(5)) / 2, 1e-9);
    EXPECT_EQ(found.sentences, std::vector<std::string>{"f → −f++f− draws nothing"});
}

/// A short cell of Anabaena becomes a long one.
TEST(RuleFigures, CellsKeepTheirSize) {
    const RuleFigures found = figures_of(load("anabaena"));
    ASSERT_EQ(found.figures.size(), 4U);
    EXPECT_EQ(found.figures[2].before, "br");
    const Survey is_short = survey_of(*found.figures[2].predecessor);
    const Survey is_long = survey_of(*found.figures[2].successor);
    EXPECT_LT(is_short.box.high.x - is_short.box.low.x, 0.7 * (is_long.box.high.x - is_long.box.low.x));
    EXPECT_EQ(survey_of(*found.figures[3].predecessor).length, is_short.length);
}

TEST(RuleFigures, UseTheValuesOfTheFirstApplication) {
    // Equation 8 of the same paper: F(s) --> F(s/3) …, applied to F(1).
    const RuleFigures found = figures_of(load("snowflake"));
    EXPECT_NEAR(survey_of(*found.figures.front().successor).length, 4.0 / 3, 1e-9);
    const Document unused = parse("unused", "axiom: F(1)\nderivation length: 2\nF(s) : s > 5 --> F(s)F(s)\n");
    const RuleFigures none = figures_of(unused);
    EXPECT_TRUE(none.figures.empty());
    EXPECT_EQ(none.sentences.front(), "F(s) : s > 5 → F(s)F(s) is not drawn: no step up to n = 2 applies it");
}

TEST(RuleFigures, SearchWithinTheBudget) {
    const Document unused = parse(
        "unused", "axiom: F(1)\nderivation length: 1000000\nF(s) : s > 5 --> F(s)F(s)\nF(s) : s <= 5 --> F(s)\n");
    const RuleFigures found = figures_of(unused);
    EXPECT_EQ(found.figures.size(), 1U);
    ASSERT_EQ(found.sentences.size(), 1U);
    EXPECT_TRUE(has(found.sentences.front(), "not found within the budget")) << found.sentences.front();
}

TEST(RuleFigures, SayLittleAboutManyProductions) {
    std::string text = "axiom: F\nderivation length: 1\nF --> FF\n";
    for (char letter = 'H'; letter <= 'Z'; ++letter) text += fmt::format("{0} --> {0}{0}{0}\n", letter);
    const RuleFigures found = figures_of(parse("many", text));
    ASSERT_EQ(found.sentences.size(), 4U);
    EXPECT_EQ(found.sentences.front(), "H → HHH draws nothing");
    EXPECT_EQ(found.sentences.back(), "… and 16 further productions draw nothing");
}

TEST(RuleFigures, ReportsBracketsThatDoNotClose) {
    const RuleFigures found = figures_of(parse("open", "axiom: A]\nderivation length: 1\nA --> [F\n"));
    EXPECT_TRUE(found.figures.empty());
    ASSERT_EQ(found.sentences.size(), 1U);
    EXPECT_TRUE(has(found.sentences.front(), "is not drawn alone"));
}

// Highlighted steps

/// Numbers of segments, by the index of their colour.
class SegmentCounter : public PathSink {
public:
    void begin_stroke(glm::dvec2, const Pen& pen) override { colour_ = pen.colour; }
    void lines(std::span<const glm::dvec2> ends) override { counts[colour_] += ends.size(); }
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen& pen) override { colour_ = pen.colour; }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen& pen) override { ++polygons[pen.colour]; }
    void disc(glm::dvec2, double, const Pen&) override {}
    std::map<int, std::size_t> counts, polygons;

private:
    int colour_ = 0;
};

SegmentCounter lit(const Document& document, const Highlight& highlight) {
    Diagnostics diagnostics;
    const LitDrawing drawing =
        lit_drawing(document.grammar(), read_style(document.pattern(), 96, diagnostics), highlight, 1e8, {});
    SegmentCounter counter;
    const auto turtle = Turtle::drawing(drawing.grammar, counter, false);
    derive(drawing.grammar, *turtle);
    const Survey whole = survey_of(drawing.grammar);
    DerivationOptions interpreted;
    interpreted.interpreted = true;
    const auto given = Turtle::surveying(document.grammar());
    derive(document.grammar(), *given, interpreted);
    EXPECT_EQ(whole.drawn, given->survey().drawn);
    EXPECT_EQ(whole.end, given->survey().end);
    return counter;
}

/// An edge of Koch's island becomes eight in each step: those that come from one edge of the axiom are a quarter.
TEST(Highlight, CountsAsTheProductionsDo) {
    const Document island = pattern_of("koch-island", 3);
    const auto all = lit(island, {1, std::nullopt}).counts;
    EXPECT_EQ(all, (std::map<int, std::size_t>{{1, 512}, {2, 512}, {3, 512}, {4, 512}}));
    const auto one = lit(island, {2, 5}).counts;
    EXPECT_EQ(one, (std::map<int, std::size_t>{{0, 2048 - 64}, {1, 64}}));
    const auto last = lit(island, {3, 256}).counts;
    EXPECT_EQ(last, (std::map<int, std::size_t>{{0, 2040}, {1, 8}}));
}

TEST(Highlight, WorksWithEverySystem) {
    for (const auto& [name, steps] : std::map<std::string, int>{{"mesotonic-signal", 20},
                                                                {"stochastic-branches", 4},
                                                                {"branch-shedding", 9},
                                                                {"snowflake", 3},
                                                                {"dragon-subword", 6},
                                                                {"abop-plant-c", 3}}) {
        SCOPED_TRACE(name);
        const auto counts = lit(pattern_of(name, steps), {2, std::nullopt}).counts;
        std::size_t coloured = 0;
        for (const auto& [colour, count] : counts) coloured += colour > 0 ? count : 0;
        EXPECT_GT(coloured, 0U);
    }
}

/// A tile of the chair becomes four in each step.
TEST(Highlight, ColoursTiles) {
    const auto found = lit(pattern_of("chair", 3), {1, std::nullopt}).polygons;
    std::size_t all = 0;
    for (const auto& [colour, count] : found) all += count;
    EXPECT_EQ(all, 64U);
}

TEST(Highlight, KeepsTheBudgetOverAllSteps) {
    const Document line = parse("line", "axiom: F\nderivation length: 1000000\nF --> F\n");
    Diagnostics diagnostics;
    const std::string error = error_of<BudgetError>([&] {
        lit_drawing(line.grammar(), read_style(line.pattern(), 96, diagnostics), {1, std::nullopt}, 1e5, {});
    });
    EXPECT_TRUE(has(error, "those up to step 50000 have more than 100000 symbols in all")) << error;
}

TEST(Highlight, RefusesStepsAndSymbolsThatDoNotExist) {
    const Document island = pattern_of("koch-island", 2);
    EXPECT_TRUE(has(error_of([&] { draw(island, "svg", {{"highlight", "3"}}); }), "derivation length, 2"));
    EXPECT_TRUE(has(error_of([&] { draw(island, "svg", {{"highlight", "1:5"}}); }), "replaces only 4 symbols"));
    for (const char* text : {"0", "-1", "1:0", "1:", "x", "99999999999999999999"}) {
        EXPECT_TRUE(has(error_of([&] { draw(island, "svg", {{"highlight", text}}); }), "expected a step")) << text;
    }
    EXPECT_TRUE(has(error_of([&] { draw(load("moss-leaf"), "svg", {{"highlight", "1"}}); }), "a map has none"));
    EXPECT_TRUE(has(error_of([&] { draw(load("moss-leaf"), "svg", {{"rule", "true"}}); }), "a map has none"));
    EXPECT_TRUE(has(error_of([&] {
                        draw(load("fibonacci-words"), "svg", {{"rule", "true"}});
                    }),
                    "no production of the pattern draws anything"));
}

}  // namespace sikku::words_test
