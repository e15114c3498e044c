#include "engine/derivation/derivation.h"

#include "engine/derivation/forecast.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

namespace sikku::derivation_test {

using reference::derived;
using reference::derived_text;
using reference::grammar_of;
using reference::Kind;
using reference::random_system;

// --- published words -----------------------------------------------------------------------------------------------

TEST(Derivation, PublishedWords) {
    // Prusinkiewicz & Hanan 1989, figures 1.3 and 1.4.
    EXPECT_EQ(derived_text("axiom: b\nderivation length: 5\na --> ab\nb --> a\n"), "abaababa");
    EXPECT_EQ(derived_text("symbols: ar al br bl\naxiom: ar\nderivation length: 4\n"
                           "ar --> al br\nal --> bl ar\nbr --> ar\nbl --> al\n"),
              "bl ar bl ar ar bl ar ar");
    // Section 3.4: a hormone; figures 3.12 and 3.13: signals.
    EXPECT_EQ(derived_text("axiom: baaaaaaaa\nderivation length: 3\nb < a --> b\n"), "bbbbaaaaa");
    EXPECT_EQ(derived_text("axiom: J[I]I[I]I[I]I\nderivation length: 1\nJ < I --> J\n"), "J[J]J[I]I[I]I");
    EXPECT_EQ(derived_text("axiom: J[I]I[I]I[I]I\nderivation length: 3\nJ < I --> J\n"), "J[J]J[J]J[J]J");
    EXPECT_EQ(derived_text("axiom: I[I]I[I]I[I]J\nderivation length: 1\nI > J --> J\n"), "I[I]I[I]J[I]J");
    EXPECT_EQ(derived_text("axiom: I[I]I[I]I[I]J\nderivation length: 3\nI > J --> J\n"), "J[I]J[I]J[I]J");
}

TEST(Derivation, NothingAndItself) {
    EXPECT_EQ(derived_text("axiom: F+X\n"), "F+X");
    EXPECT_EQ(derived_text("axiom: F+X\nderivation length: 7\n"), "F+X");
    EXPECT_EQ(derived_text("axiom: FF\nderivation length: 1\nF --> *\n"), "");
    EXPECT_EQ(derived_text("axiom: F\nderivation length: 2\nF --> GG\nG --> *\n"), "");
}

// --- a second way --------------------------------------------------------------------------------------------------

void expect_equal(unsigned seed, const Kind& kind) {
    const reference::System system = random_system(seed, kind);
    for (const bool interpreted : {false, true}) {
        const auto expected = reference::rewrite_level_by_level(system, interpreted, 50'000);
        if (!expected) continue;
        const Grammar grammar = grammar_of(system.text());
        DerivationOptions options;
        options.interpreted = interpreted;
        for (const std::size_t memory : {std::size_t{0}, std::size_t{100}, options.block_memory}) {
            options.block_memory = memory;
            const Word word = derived(grammar, options);
            ASSERT_EQ(reference::tokens_of(grammar, word), *expected) << seed << ' ' << memory << '\n'
                                                                      << system.text();
        }
    }
}

TEST(Derivation, StreamingEqualsRewritingLevelByLevel) {
    Kind kind;
    kind.interpreted = true;
    kind.brackets = Kind::Brackets::anywhere;
    kind.most_steps = 8;
    for (unsigned seed = 0; seed < 400; ++seed) expect_equal(seed, kind);
}

TEST(Derivation, StreamingThroughTablesEqualsRewriting) {
    Kind kind;
    kind.tables = 3;
    kind.interpreted = true;
    kind.most_steps = 10;
    kind.longest = 3;
    for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
}

TEST(Derivation, UnitChainsEqualRewriting) {
    Kind kind;
    kind.letters = {"A", "B", "C", "D", "E", "F"};
    kind.longest = 1;
    kind.tables = 2;
    kind.most_steps = 40;
    for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
    kind.longest = 2;
    kind.most_steps = 12;
    for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
}

TEST(Derivation, ContextsEqualThoseOfPfg) {
    Kind kind;
    kind.contexts = true;
    kind.longest = 3;
    for (const auto brackets : {Kind::Brackets::none, Kind::Brackets::nested, Kind::Brackets::anywhere}) {
        kind.brackets = brackets;
        for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
    }
}

TEST(Derivation, ContextsOfOneSymbolEqualThoseOfPfg) {
    Kind kind;
    kind.contexts = true;
    kind.longest_context = 1;
    kind.longest = 10;
    kind.interpreted = true;
    for (const auto brackets : {Kind::Brackets::none, Kind::Brackets::nested, Kind::Brackets::anywhere}) {
        kind.brackets = brackets;
        for (const std::size_t tables : {1, 2}) {
            kind.tables = tables;
            for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
        }
    }
}

TEST(Derivation, SubwordsAndTablesOfContextsEqualRewriting) {
    Kind kind;
    kind.contexts = true;
    kind.subwords = true;
    kind.interpreted = true;
    kind.longest = 3;
    kind.letters = {"F", "A", "B"};
    kind.brackets = Kind::Brackets::nested;
    for (const std::size_t tables : {1, 3}) {
        kind.tables = tables;
        for (unsigned seed = 0; seed < 300; ++seed) expect_equal(seed, kind);
    }
    kind.contexts = false;
    for (unsigned seed = 0; seed < 200; ++seed) expect_equal(seed, kind);
}

TEST(Derivation, WhatIsPrintedReadsBack) {
    Kind kind;
    kind.letters = {"F", "F(2.5)", "ab", "a", "b", "A(1,0.1)", "@O(2)"};
    kind.signs = {"+", "-(60)", "\\", "/"};
    kind.most_steps = 3;
    for (unsigned seed = 0; seed < 200; ++seed) {
        reference::System system = random_system(seed, kind);
        system.keys = "symbols: ab ba1\n";
        const Grammar grammar = grammar_of(system.text());
        const Word word = derived(grammar);
        if (word.empty()) continue;
        const std::string printed = to_text(grammar, word);
        const Grammar again = grammar_of(system.keys + "axiom: " + printed + "F\n");
        auto tokens = reference::tokens_of(grammar, word);
        tokens.push_back("F");
        EXPECT_EQ(reference::tokens_of(again, again.axiom()), tokens) << printed;
    }
}

// --- contexts, case by case ----------------------------------------------------------------------------------------

std::string once(const std::string& axiom, const std::string& productions) {
    return derived_text("derivation length: 1\naxiom: " + axiom + "\n" + productions + "\n");
}

TEST(Contexts, WholeBranchesAreSkippedToTheRight) {
    EXPECT_EQ(once("A[x[y]z]B", "A > B --> C"), "C[x[y]z]B");
    EXPECT_EQ(once("A[x][y]B", "A > B --> C"), "C[x][y]B");
    EXPECT_EQ(once("A[B]", "A > B --> C"), "A[B]");
}

TEST(Contexts, FinishedBranchesAreSkippedToTheLeft) {
    EXPECT_EQ(once("B[x[y]z]A", "B < A --> C"), "B[x[y]z]C");
    EXPECT_EQ(once("B[x][y]A", "B < A --> C"), "B[x][y]C");
    EXPECT_EQ(once("[B]A", "B < A --> C"), "[B]A");
}

TEST(Contexts, ABranchSeesItsMothersAxis) {
    EXPECT_EQ(once("B[A[A]x[A]]", "B < A --> C"), "B[C[A]x[A]]");
    EXPECT_EQ(once("DB[[[A]]]", "DB < A --> C"), "DB[[[C]]]");
    EXPECT_EQ(once("D[x]B[y][A]", "DB < A --> C"), "D[x]B[y][C]");
}

TEST(Contexts, TheEndOfABranchOrOfTheWordMatchesNothing) {
    EXPECT_EQ(once("[A]B", "A > B --> C"), "[A]B");
    EXPECT_EQ(once("A", "A > B --> C"), "A");
    EXPECT_EQ(once("A", "B < A --> C"), "A");
    EXPECT_EQ(once("BA", "BB < A --> C"), "BA");
    EXPECT_EQ(once("AB]B", "A > BB --> C"), "AB]B");
    EXPECT_EQ(once("A[B", "A > B --> C"), "A[B");
    EXPECT_EQ(once("B]A", "B < A --> C"), "B]A");
}

TEST(Contexts, IgnoredSymbolsAreNotSeen) {
    EXPECT_EQ(once("B+-A-+D", "B < A > D --> C\nignore: +-"), "B+-C-+D");
    EXPECT_EQ(once("B+xA", "B < A --> C\nignore: +-"), "B+xA");
    EXPECT_EQ(once("B+xAyD", "B < A > D --> C\nconsider: ABD"), "B+xCyD");
    EXPECT_EQ(once("Bx[yA]z[B]D", "B < A --> C\nA > D --> E\nconsider: ABD"), "Bx[yC]z[B]D");
    // They may still be rewritten.
    EXPECT_EQ(once("B+A", "B < A --> C\n+ --> -\nignore: +"), "B-C");
    // Whatever their parameters.
    EXPECT_EQ(once("B+(60)A", "B < A --> C\nignore: +"), "B+(60)C");
}

TEST(Contexts, ComeFirstAndAmongEqualsTheFirstWritten) {
    EXPECT_EQ(once("BAD", "A --> x\nA > D --> y\nB < A --> z"), "ByD");
    EXPECT_EQ(once("BAD", "A --> x\nB < A --> z\nA > D --> y"), "BzD");
    EXPECT_EQ(once("A", "A --> x\nB < A --> z\nA > D --> y"), "x");
}

TEST(Contexts, MatchTheWordAsItWasBeforeTheStep) {
    EXPECT_EQ(once("ABAB", "A > B --> B\nA < B --> A"), "BABA");
}

TEST(Subwords, AreReplacedScanningLeftToRight) {
    EXPECT_EQ(once("AAAAA", "AA --> B"), "BBA");
    EXPECT_EQ(once("AAB", "AA --> x\nAB --> y"), "xB");
    EXPECT_EQ(once("AAB", "AAB --> z\nAA --> x"), "z");
    EXPECT_EQ(once("AAB", "AA --> x\nAAB --> z"), "xB");  // the first written
    EXPECT_EQ(once("AAB", "A --> a\nAA --> x"), "aaB");
    EXPECT_EQ(once("AAB", "A --> a\nAA > B --> x"), "xB");  // context comes first
    EXPECT_EQ(once("xAAA", "x < AA --> B\nAA --> C"), "xBA");
    EXPECT_EQ(once("A[A]A", "AA --> B"), "A[A]A");  // no branch is skipped within
    EXPECT_EQ(once("xA+Ax", "A+A --> *"), "xx");
    // The right context begins after the subword.
    EXPECT_EQ(once("ABC", "AB > C --> x"), "xC");
}

// --- limits --------------------------------------------------------------------------------------------------------

/// Counts, and remembers both ends.
class Ends : public SymbolSink {
public:
    void symbols(const Run& run) override {
        EXPECT_LE(run.symbols.size(), 4096u);
        if (count == 0) first = run.symbols.front();
        last = run.symbols.back();
        count += run.symbols.size();
    }
    std::uint64_t count = 0;
    Symbol first = 0;
    Symbol last = 0;
};
struct Found {
    std::uint64_t count;
    std::string first, last;
};
Found ends_of(const Grammar& grammar, const DerivationOptions& options = {}) {
    Ends ends;
    derive(grammar, ends, options);
    return {ends.count, grammar.symbols()[ends.first].letter, grammar.symbols()[ends.last].letter};
}

TEST(Limits, AMillionStepsOfLinearGrowth) {
    const std::string head = "derivation length: 1000000\naxiom: A\n";
    const Found right = ends_of(grammar_of(head + "A --> bA\n"));
    EXPECT_EQ(right.count, 1'000'001u);
    EXPECT_EQ(right.first + right.last, "bA");
    const Found left = ends_of(grammar_of(head + "A --> Ab\n"));
    EXPECT_EQ(left.count, 1'000'001u);
    EXPECT_EQ(left.first + left.last, "Ab");
    const Found middle = ends_of(grammar_of(head + "A --> bAc\n"));
    EXPECT_EQ(middle.count, 2'000'001u);
    EXPECT_EQ(middle.first + middle.last, "bc");
    DerivationOptions plain;
    plain.block_memory = 0;
    EXPECT_EQ(ends_of(grammar_of(head + "A --> Ab\n"), plain).count, 1'000'001u);
}

TEST(Limits, UnitChainsCollapseHoweverManyThereAre) {
    const std::clock_t begin = std::clock();  // processor time, because the machine may be busy
    struct TooSlow {};
    DerivationOptions options;
    options.watch = [&](std::uint64_t) {
        if (std::clock() - begin > 10 * CLOCKS_PER_SEC) throw TooSlow();
    };
    const std::string head = "derivation length: 1000000\naxiom: A\n";
    EXPECT_NO_THROW(EXPECT_EQ(ends_of(grammar_of(head + "A --> Ab\nb --> b\n"), options).count, 1'000'001u));
    EXPECT_NO_THROW(EXPECT_EQ(ends_of(grammar_of(head + "A --> Ab\nb --> c\nc --> b\n"), options).count, 1'000'001u));
}

TEST(Limits, UnitChainsOfAnyLength) {
    const auto text = [](const std::string& n, const std::string& rest) {
        return "derivation length: " + n + "\n" + rest;
    };
    const std::string cycle = "axiom: ABC\nA --> B\nB --> C\nC --> A\nX --> *\n";
    EXPECT_EQ(derived_text(shorten(grammar_of(text("999999999", cycle)))), "ABC");
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000000", cycle)))), "BCA");
    EXPECT_EQ(derived_text(shorten(grammar_of(text("9223372036854775807", cycle)))), "BCA");
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000000", "axiom: F+F\nF --> F\n")))), "F+F");
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000000", "axiom: FGH\nF --> G\nG --> *\n")))), "H");
    EXPECT_EQ(
        derived_text(shorten(grammar_of(text("1000000000", "axiom: F\nF --> F\ninterpret:\nF --> GG\n"))), true),
        "GG");
    const std::string tables = "axiom: ABC\nschedule: s*(n-1) t\ntable s:\nA --> B\nB --> A\ntable t:\nA --> a\n";
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000001", tables)))), "aBC");
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000000", tables)))), "BaC");
    // Symbols that are never reached may grow.
    EXPECT_EQ(derived_text(shorten(grammar_of(text("1000000000", "axiom: F\nF --> F\nG --> GG\n")))), "F");
}

TEST(Limits, LongChainsThatGrowAreRefused) {
    EXPECT_THROW(shorten(grammar_of("derivation length: 1000001\naxiom: F\nF --> FF\n")), BudgetError);
    EXPECT_THROW(shorten(grammar_of("derivation length: 1000000000\naxiom: F\nF --> Fx\n")), BudgetError);
    EXPECT_THROW(shorten(grammar_of("derivation length: 1000000000\naxiom: F\nA < F --> F\n")), BudgetError);
    EXPECT_EQ(shorten(grammar_of("derivation length: 1000000\naxiom: F\nF --> Fx\n")).steps(), 1'000'000);
}

TEST(Limits, WordsThatStopChangingCostNothingMore) {
    const std::string head = "derivation length: 1000000000\n";
    EXPECT_EQ(derived_text(head + "axiom: baaa\nb < a --> b\n"), "bbbb");
    EXPECT_EQ(derived_text("derivation length: 1000000000\naxiom: baaa\nschedule: s*(n-2) t*2\n"
                           "table s:\nb < a --> b\ntable t:\nb > b --> c\n"),
              "cccb");
}

TEST(Limits, WholeWordsKeepTheirBudget) {
    const Grammar grammar = grammar_of("derivation length: 40\naxiom: F\nF --> FF\nx < F --> x\n");
    DerivationOptions options;
    options.longest_word = 100'000;
    EXPECT_THROW(derived(grammar, options), BudgetError);
    const Grammar small = grammar_of("derivation length: 10\naxiom: F\nF --> FF\nx < F --> x\n");
    options.longest_word = 1024;
    EXPECT_EQ(derived(small, options).size(), 1024u);
    options.longest_word = 1023;
    EXPECT_THROW(derived(small, options), BudgetError);
    // Only up to the last step that looks at neighbours; from there on the word is streamed.
    const Grammar late = grammar_of(
        "derivation length: 12\naxiom: F\nschedule: s*2 t*10\ntable s:\nF --> FF\nx < F --> x\ntable t:\nF --> FF\n");
    options.longest_word = 4;
    EXPECT_EQ(ends_of(late, options).count, 4096u);
}

TEST(Limits, AllWordsKeptWholeTogether) {
    const Grammar grammar = grammar_of("derivation length: 1000000\naxiom: FxyxyxF\nF > y --> F\nx --> y\ny --> x\n");
    DerivationOptions options;
    options.whole_words = 10'000;
    EXPECT_THROW(derived(grammar, options), BudgetError);
    options.limit_whole_words(7e5);
    EXPECT_TRUE(has(error_of<BudgetError>([&] { resolve_contexts(grammar, options); }),
                    "the largest derivation length that fits is 100000"));
}

TEST(Limits, ContextsAreResolvedOnce) {
    const Grammar grammar = grammar_of(
        "derivation length: 60\naxiom: ABF\nschedule: once grow*(n-1)\n"
        "table once:\nA < B --> B+\ntable grow:\nF --> FF\n");
    const Grammar rest = resolve_contexts(grammar, {});
    EXPECT_EQ(to_text(rest, rest.axiom()), "AB+F");
    EXPECT_EQ(rest.steps(), 60);
    EXPECT_EQ(rest.schedule().size(), 1u);
    EXPECT_EQ(rest.schedule().front().steps, 59);
    EXPECT_EQ(rest.whole_word_steps(), 0);
    EXPECT_FALSE(rest.with_steps(3));
    EXPECT_EQ(forecast(rest, false)->length(), "576460752303423491");
    EXPECT_EQ(error_of<BudgetError>([&] { require_affordable(rest, false, 1e6); }),
              "a word of 576460752303423491 symbols (n = 60) is above the budget of 1000000 nodes");
    // Without contexts nothing happens.
    EXPECT_EQ(resolve_contexts(grammar_of("derivation length: 3\naxiom: F\nF --> FF\n"), {}).steps(), 3);
}

TEST(Limits, ErasedWordsCostWhatTheForecastTells) {
    // Erased far above the levels whose expansions are kept, and through levels that keep none.
    for (const std::string schedule : {"grow*(n-1) wipe", "grow*30 wipe grow*(n-31)"}) {
        const Grammar grammar = grammar_of("derivation length: 60\naxiom: FD\nschedule: " + schedule +
                                           "\ntable grow:\nD --> DD\nX --> Y\ntable wipe:\nD --> *\n");
        ASSERT_LE(forecast(grammar, false)->nodes, 10);
        DerivationOptions options;
        int calls = 0;
        options.watch = [&](std::uint64_t) {
            if (++calls > 10) throw std::runtime_error("more is visited than the forecast tells");
        };
        EXPECT_EQ(ends_of(grammar, options).count, 1u) << schedule;
    }
    // Above the levels that are kept it is not known that nothing will come of it.
    const Grammar deep = grammar_of(
        "derivation length: 1000000\naxiom: FD\nschedule: grow*(n-1) wipe\n"
        "table grow:\nD --> DD\nX --> Y\ntable wipe:\nD --> *\n");
    EXPECT_THROW(require_affordable(deep, false, 1e8), BudgetError);
}

TEST(Limits, ContextsAcrossLongStretchesAreFoundInOneStep) {
    // Quadratic, these would take hours.
    const std::size_t many = 1'000'000;
    std::string stretch(many, 'x');
    EXPECT_EQ(derived_text("ignore: x\naxiom: A" + stretch + "B" + stretch + "B\nderivation length: 1\n" +
                           "A < B --> C\nB < B --> D\nx --> *\n"),
              "ACD");
    const Grammar ignored = grammar_of("ignore: x\naxiom: A" + stretch + "\nderivation length: 1\nA < x --> y\n");
    EXPECT_EQ(to_text(ignored, rewrite(ignored, ignored.tables()[0], ignored.axiom())), "A" + std::string(many, 'y'));
    const Grammar right = grammar_of("ignore: x\naxiom: " + stretch + "A\nderivation length: 1\nx > A --> y\n");
    EXPECT_EQ(to_text(right, rewrite(right, right.tables()[0], right.axiom())), std::string(many, 'y') + "A");
    std::string branches;
    for (int i = 0; i < 300'000; ++i) branches += "[B]";
    const Grammar siblings = grammar_of("axiom: A" + branches + "\nderivation length: 1\nA < B --> C\n");
    const Word word = rewrite(siblings, siblings.tables()[0], siblings.axiom());
    EXPECT_EQ(std::count(word.begin(), word.end(), word[2]), 300'000);
    EXPECT_EQ(to_text(siblings, std::span(word).first(4)), "A[C]");
}

TEST(Limits, ALongStepIsWatched) {
    const Grammar grammar =
        grammar_of("axiom: " + std::string(1'000'000, 'x') + "\nderivation length: 1\nA < x --> y\n");
    int calls = 0;
    DerivationOptions options;
    options.watch = [&](std::uint64_t) { ++calls; };
    rewrite(grammar, grammar.tables()[0], grammar.axiom(), options);
    EXPECT_GE(calls, 10);
}

TEST(Limits, NestingOfMillions) {
    std::string axiom(1'000'000, '[');
    axiom += "A" + std::string(1'000'000, ']');
    EXPECT_EQ(ends_of(grammar_of("axiom: " + axiom + "\nderivation length: 3\nA --> [A]\n")).count, 2'000'007u);
    EXPECT_EQ(ends_of(grammar_of("axiom: B" + axiom + "\nderivation length: 1\nB < A --> C\n")).count, 2'000'002u);
    EXPECT_EQ(ends_of(grammar_of("axiom: A\nderivation length: 1000000\nA --> [[A]]\n")).count, 4'000'001u);
}

TEST(Limits, TheWatchSeesEverySymbolAndMayStop) {
    const Grammar grammar = grammar_of("derivation length: 20\naxiom: F\nF --> FF\n");
    std::uint64_t seen = 0;
    DerivationOptions options;
    options.watch = [&](std::uint64_t symbols) { seen += symbols; };
    EXPECT_EQ(ends_of(grammar, options).count, 1U << 20);
    EXPECT_EQ(seen, 1U << 20);
    struct Enough {};
    seen = 0;
    options.watch = [&](std::uint64_t symbols) {
        seen += symbols;
        if (seen > 10'000) throw Enough();
    };
    EXPECT_THROW(ends_of(grammar, options), Enough);
    EXPECT_LE(seen, 10'000u + 4096);
    // Steps on whole words are watched, too.
    int steps = 0;
    options.watch = [&](std::uint64_t symbols) { steps += symbols == 0 ? 1 : 0; };
    derived(grammar_of("derivation length: 5\naxiom: xFFFFFFF\nx < F --> x\n"), options);
    EXPECT_EQ(steps, 5);
}

}  // namespace sikku::derivation_test
