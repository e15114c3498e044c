#include "engine/derivation/lineage.h"

#include "engine/base/text.h"
#include "engine/derivation/word_table.h"
#include "engine/language/document.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sikku::lineage_test {

std::vector<LineageWord> lineage(const Grammar& grammar, std::int64_t first, bool interpreted = false) {
    WordLineageLimits limits;
    limits.symbols = 200'000;
    return word_lineage(grammar, first, grammar.steps(), interpreted, limits);
}

/// The word that derive() returns.
class Reader : public SymbolSink {
public:
    void symbols(const Run& run) override {
        word.symbols.insert(word.symbols.end(), run.symbols.begin(), run.symbols.end());
        word.arguments.insert(word.arguments.end(), run.arguments.begin(), run.arguments.end());
    }
    ModuleWord word;
};

std::string derived(const Grammar& grammar, bool interpreted) {
    Reader reader;
    DerivationOptions options;
    options.interpreted = interpreted;
    derive(grammar, reader, options);
    return to_text(grammar, reader.word);
}

/// Prusinkiewicz & Hanan 1989, section 1.2 and figure 1.3: b, a, ab, aba, abaab, abaababa, abaababaabaab.
const std::vector<std::string> published = {"b", "a", "ab", "aba", "abaab", "abaababa", "abaababaabaab"};

TEST(Lineage, GivesTheWordsOfFigure13) {
    const Grammar grammar = load("fibonacci-words", {"", {{"derivation length", "6"}}}).grammar();
    const auto words = lineage(grammar, 0);
    ASSERT_EQ(words.size(), published.size());
    for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(to_text(grammar, words[i].word), published[i]);
}

/// Figure 1.4, subscripts as names: long cells a and short cells b.
TEST(Lineage, GivesTheFilamentOfFigure14) {
    const Grammar grammar = load("anabaena").grammar();
    const auto words = lineage(grammar, 0);
    ASSERT_EQ(words.size(), 5U);
    const std::vector<std::string> cells = {"ar", "al br", "bl ar ar", "al al br al br", "bl ar bl ar ar bl ar ar"};
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(to_text(grammar, words[i].word), cells[i]);
}

/// Tables, contexts, parameters, chance, cuts, long predecessors, brackets.
const std::vector<std::pair<const char*, int>> systems = {
    {"koch-curve", 3},     {"bag-of-candies", 4},     {"hormone", 5},        {"mesotonic-signal", 12},
    {"snowflake", 3},      {"branch-shedding", 8},    {"dragon-subword", 5}, {"stochastic-branches", 4},
    {"insect-attack", 10}, {"parametric-example", 3}, {"bush-3d", 3},        {"capsella-by-chance", 9}};

TEST(Lineage, DerivesTheSameWordsAsDerive) {
    for (const auto& [name, steps] : systems) {
        SCOPED_TRACE(name);
        const Grammar grammar = load(name, {"", {{"derivation length", std::to_string(steps)}}}).grammar();
        const auto words = lineage(grammar, 0, true);
        const bool has_interpretation = grammar.interpretation() != nullptr;
        ASSERT_EQ(words.size(), static_cast<std::size_t>(steps + (has_interpretation ? 2 : 1)));
        EXPECT_EQ(to_text(grammar, words[static_cast<std::size_t>(steps)].word), derived(grammar, false));
        EXPECT_EQ(to_text(grammar, words.back().word), derived(grammar, true));
        if (grammar.has_schedule()) continue;
        for (int n = 0; n < steps; ++n) {
            EXPECT_EQ(to_text(grammar, words[static_cast<std::size_t>(n)].word),
                      derived(*grammar.with_steps(n), false))
                << n;
        }
    }
}

/// Each symbol has as many children as its production has symbols in the successor, and symbols that stay have one.
TEST(Lineage, EachSymbolHasTheChildrenOfItsProduction) {
    for (const auto& [name, steps] : systems) {
        SCOPED_TRACE(name);
        const Grammar grammar = load(name, {"", {{"derivation length", std::to_string(steps)}}}).grammar();
        const auto words = lineage(grammar, 0);
        std::size_t replaced = 0, cut = 0;
        for (std::size_t n = 0; n + 1 < words.size(); ++n) {
            const LineageWord& before = words[n];
            const LineageWord& after = words[n + 1];
            ASSERT_EQ(before.applied.size(), before.word.symbols.size());
            ASSERT_EQ(after.parents.size(), after.word.symbols.size());
            EXPECT_TRUE(std::is_sorted(after.parents.begin(), after.parents.end()));
            std::vector<std::size_t> children(before.word.symbols.size(), 0);
            for (const std::uint32_t parent : after.parents) ++children.at(parent);
            for (std::size_t i = 0; i < children.size();) {
                if (before.applied[i] == StepOrigins::is_cut) {
                    EXPECT_EQ(children[i++], 0U);
                    ++cut;
                } else if (before.applied[i] == StepOrigins::stays) {
                    EXPECT_EQ(children[i++], 1U);
                } else {
                    const Production& production = before.next->production(before.applied[i]);
                    EXPECT_EQ(production.predecessor.front(), before.word.symbols[i]);
                    EXPECT_EQ(children[i], production.successor.size());
                    i += production.predecessor.size();
                    ++replaced;
                }
            }
        }
        EXPECT_GT(replaced, 0U);
        if (grammar.cut()) {
            EXPECT_GT(cut, 0U);
        }
    }
}

TEST(Lineage, BeginsAtAnyStep) {
    const Grammar grammar = load("branch-shedding", {"", {{"derivation length", "9"}}}).grammar();
    const auto all = lineage(grammar, 0), last = lineage(grammar, 7);
    ASSERT_EQ(last.size(), 3U);
    EXPECT_TRUE(last.front().parents.empty());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(to_text(grammar, last[i].word), to_text(grammar, all[7 + i].word));
        EXPECT_EQ(last[i].applied, all[7 + i].applied);
    }
}

TEST(Lineage, StopsAtItsLimits) {
    const Grammar grammar = load("koch-curve", {"", {{"derivation length", "40"}}}).grammar();
    WordLineageLimits limits;
    limits.symbols = 1000;
    const std::string error = error_of<BudgetError>([&] { word_lineage(grammar, 0, 40, false, limits); });
    EXPECT_TRUE(has(error, "step 5")) << error;
}

/// Of A, BBBB and nothing, the second word is longer than the limit, and is not among the first two.
TEST(Lineage, LimitsOnlyTheWordsThatItGives) {
    const Grammar grammar = parse("pulse", "axiom: A\nderivation length: 2\nA --> BBBB\nB --> *\n").grammar();
    WordLineageLimits limits;
    limits.symbols = 3;
    EXPECT_TRUE(word_lineage(grammar, 2, 2, false, limits).front().word.symbols.empty());
    EXPECT_TRUE(
        has(error_of<BudgetError>([&] { word_lineage(grammar, 1, 2, false, limits); }), "more than 3 symbols"));
}

/// One step compares fewer symbols than the budget allows, forty more.
TEST(Lineage, ComparedSymbolsAddUpOverTheSteps) {
    const std::string many(100, 'A');
    const Grammar grammar =
        parse("compared", "axiom: " + many + "\nderivation length: 40\n" + many.substr(50) + " < A --> A\n")
            .grammar();
    WordLineageLimits limits;
    limits.nodes = 1e5;
    EXPECT_EQ(word_lineage(grammar, 0, 1, false, limits).size(), 2U);
    EXPECT_TRUE(
        has(error_of<BudgetError>([&] { word_lineage(grammar, 0, 40, false, limits); }), "matching contexts"));
}

TEST(WordTable, PlacesSymbolsAboveThoseThatReplaceThem) {
    for (const auto& [name, steps] : systems) {
        SCOPED_TRACE(name);
        const Grammar grammar =
            load(name, {"", {{"derivation length", std::to_string(std::min(steps, 5))}}}).grammar();
        const WordTable table = lay_out_words(grammar, lineage(grammar, 0));
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const auto& row = table.rows[r].symbols;
            for (std::size_t i = 0; i < row.size(); ++i) {
                EXPECT_LE(row[i].begin, row[i].column);
                EXPECT_LE(row[i].column + (row[i].is_joined ? 0 : row[i].width), row[i].end);
                if (i > 0) {
                    EXPECT_GE(row[i].column, row[i - 1].column + row[i - 1].width);
                }
                if (r > 0) {
                    const TableSymbol& parent = table.rows[r - 1].symbols[row[i].parent];
                    EXPECT_GE(row[i].begin, parent.begin);
                    EXPECT_LE(row[i].end, parent.end);
                }
            }
            if (!row.empty()) {
                EXPECT_LE(row.back().column + row.back().width, table.columns);
            }
        }
    }
}

TEST(WordTable, WritesTextMarkdownAndLatex) {
    const Grammar grammar = load("fibonacci-words", {"", {{"derivation length", "4"}}}).grammar();
    const WordTable table = lay_out_words(grammar, lineage(grammar, 2));
    EXPECT_EQ(words_as_text(table, 0),
              "2   a   b\n"
              "3  a  b a\n"
              "4  ab a ab\n");
    EXPECT_EQ(words_as_markdown(table, 0, "A *title*"),
              "**A \\*title\\***\n\n```text\n" + words_as_text(table, 0) + "```\n");
    EXPECT_TRUE(words_as_markdown(table, 0, "&lt;").starts_with("**\\&lt;**"));
    EXPECT_TRUE(
        has(words_as_latex(table, ""),
            "2 & \\multicolumn{3}{c}{\\replaced{a}} & \\multicolumn{2}{c}{\\replaced{b}} \\\\\n"
            "3 & \\multicolumn{2}{c}{\\replaced{a}} & \\replaced{b} & \\multicolumn{2}{c}{\\replaced{a}} \\\\\n"
            "4 & a & b & a & a & b \\\\\n"));
    const Grammar ticks = parse("ticks", "axiom: A`'B\n").grammar();
    EXPECT_TRUE(has(words_as_latex(lay_out_words(ticks, lineage(ticks, 0)), ""),
                    "& A & \\textasciigrave{} & \\textquotesingle{} & B"));
}

/// Blocks of lines contain the same symbols in the same order.
TEST(WordTable, Wraps) {
    const Grammar grammar = load("koch-curve", {"", {{"derivation length", "3"}}}).grammar();
    const WordTable table = lay_out_words(grammar, lineage(grammar, 0));
    const std::string text = words_as_text(table, 40);
    std::vector<std::string> rows(4);
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::string line(take_line(rest));
        EXPECT_LE(line.size(), 40U);
        if (line.empty()) continue;
        std::string& row = rows.at(static_cast<std::size_t>(line.front() - '0'));
        for (const char each : line.substr(1)) row += each == ' ' ? "" : std::string(1, each);
    }
    for (int n = 0; n < 4; ++n) EXPECT_EQ(rows[static_cast<std::size_t>(n)], derived(*grammar.with_steps(n), false));
}

TEST(WordTable, ShowsEmptyWords) {
    const Grammar grammar = parse("empty", "axiom: A\nderivation length: 2\nA --> *\n").grammar();
    const WordTable table = lay_out_words(grammar, lineage(grammar, 0));
    EXPECT_EQ(words_as_text(table, 0), "0  A\n1\n2\n");
    EXPECT_EQ(table.rows.front().symbols.front().children, 0U);
    EXPECT_TRUE(table.rows.front().symbols.front().is_replaced);
    const Grammar nothing = parse("nothing", "axiom: *\nderivation length: 1\nA --> AA\n").grammar();
    EXPECT_EQ(words_as_text(lay_out_words(nothing, lineage(nothing, 0)), 0), "0\n1\n");
}

}  // namespace sikku::lineage_test
