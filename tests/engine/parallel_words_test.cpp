// Long words derived by several threads: with random choices and without parameters, and with contexts.
#include "engine/base/chance.h"
#include "engine/base/monitor.h"
#include "engine/base/threads.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/word_printer.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::parallel_words_test {

using reference::Dice;
using reference::grammar_of;

const std::vector<int> thread_counts = {1, 2, 3, 8};

/// Prusinkiewicz & Hanan 1989, figures 3.16 and 3.11a.
const std::string specimen = "axiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\n";
const std::string signals =
    "axiom: F1F1F1\nignore: +-F\n0 < 0 > 0 --> 0\n0 < 0 > 1 --> 1[+F1F1]\n0 < 1 > 0 --> 1\n0 < 1 > 1 --> 1\n"
    "1 < 0 > 0 --> 0\n1 < 0 > 1 --> 1F1\n1 < 1 > 0 --> 0\n1 < 1 > 1 --> 0\n* < + > * --> -\n* < - > * --> +\n";

Grammar long_grammar(const std::string& text, std::int64_t steps) {
    return grammar_of("derivation length: " + std::to_string(steps) + "\n" + text);
}

/// Counts and mixes the symbols of a word; all of them come from one thread.
class Digest : public SymbolSink {
public:
    void symbols(const Run& run) override {
        EXPECT_EQ(std::this_thread::get_id(), thread_);
        EXPECT_FALSE(run.symbols.empty());
        EXPECT_TRUE(run.arguments.empty());
        for (const Symbol symbol : run.symbols) mixed = scrambled(mixed + symbol);
        count += run.symbols.size();
    }
    bool operator==(const Digest& other) const { return count == other.count && mixed == other.mixed; }
    std::uint64_t count = 0;
    std::uint64_t mixed = 1;

private:
    std::thread::id thread_ = std::this_thread::get_id();
};

/// The word as `sikku derive` prints it.
class Print {
public:
    explicit Print(const Grammar& grammar)
        : printer(grammar, [this](std::string_view text) {
              EXPECT_EQ(std::this_thread::get_id(), thread_);
              for (const char byte : text) mixed = scrambled(mixed + static_cast<unsigned char>(byte));
              count += text.size();
          }) {}
    std::uint64_t count = 0;
    std::uint64_t mixed = 1;
    WordPrinter printer;

private:
    std::thread::id thread_ = std::this_thread::get_id();
};

ModuleWord rewritten(const Grammar& grammar, const DerivationOptions& options = {}) {
    ModuleWord word = grammar.axiom_modules();
    std::int64_t step = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps; ++i) {
            word = rewrite(grammar, grammar.tables()[run.table], word, ++step, options);
        }
    }
    if (options.interpreted && grammar.interpretation()) {
        word = rewrite(grammar, *grammar.interpretation(), word, ++step, options);
    }
    return word;
}

/// Compares derive(), with any number of threads, as symbols and as text, with rewriting step by step.
void expect_rewritten(const Grammar& grammar, std::size_t least, bool interpreted = false) {
    DerivationOptions options;
    options.interpreted = interpreted;
    const ModuleWord word = rewritten(grammar, options);
    EXPECT_GE(word.symbols.size(), least);
    Digest expected;
    expected.symbols({word.symbols, -1, {}});
    Print printed(grammar);
    printed.printer.symbols({word.symbols, -1, {}});
    printed.printer.finish();
    for (const int threads : thread_counts) {
        on_threads(threads, [&] {
            Digest digest;
            derive(grammar, digest, options);
            EXPECT_EQ(digest.count, expected.count) << threads << " threads";
            EXPECT_TRUE(digest == expected) << threads << " threads";
            Print print(grammar);
            derive(grammar, print.printer, options);
            EXPECT_EQ(print.count, printed.count) << threads << " threads";
            EXPECT_EQ(print.mixed, printed.mixed) << threads << " threads";
        });
    }
}

TEST(ParallelChance, MakesTheWordThatRewritingMakes) {
    expect_rewritten(long_grammar(specimen, 11), 3'000'000);
    expect_rewritten(long_grammar("seed: 7\n" + specimen, 10), 500'000);
    // Branches that end in brackets, so that the text behind a symbol grows with each step; deterministic symbols;
    // symbols that vanish.
    expect_rewritten(long_grammar("axiom: A\nA --> F[B][A[A]] : 2\nA --> [[A]B]A : 1\nB --> BB\n", 15), 400'000);
    expect_rewritten(
        long_grammar(
            "axiom: XF\nX --> XYX : 3\nX --> YXZ : 2\nX --> : 1\nY --> ZZ\nZ --> F+F\nF --> F : 1\nF --> FX : 1\n",
            19),
        500'000);
    // Long texts beside symbols.
    expect_rewritten(long_grammar("axiom: A\nA --> ++++++++A-------A : 1\nA --> A[[[[[[[]]]]]]]A : 1\n", 16),
                     500'000);
    // Units only, and a symbol that is rewritten once in a while.
    expect_rewritten(long_grammar("axiom: A\nA --> B : 1\nA --> C : 1\nB --> AA : 1\nB --> A : 1\nC --> BA\n", 45),
                     300'000);
}

TEST(ParallelChance, MakesTheWordOfTablesAndOfAHomomorphism) {
    const std::string text =
        "axiom: AB\nderivation length: 16\nschedule: grow*3 rest grow*2 rest grow*9\ntable grow:\nA --> A[B]A : 1\nA "
        "--> AB : 2\nB --> BA : 1\n"
        "B --> AFB : 1\ntable rest:\nB --> A : 1\nB --> BB : 1\n";
    const std::string drawn = "interpret:\nA --> F+F\nB --> F : 1\nB --> F[-F]F : 1\n";
    const Grammar grammar = grammar_of(text + drawn);
    expect_rewritten(grammar, 200'000);
    expect_rewritten(grammar, 500'000, true);
    expect_rewritten(long_grammar(specimen + "interpret:\nF --> FF++FF\n", 9), 400'000, true);
}

TEST(ParallelChance, MakesTheWordOfRandomSystems) {
    int compared = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Dice dice(seed);
        const std::string letters = "ABCF+-[]";
        const auto random_text = [&](std::size_t longest) {
            std::string text;
            for (std::size_t i = dice.below(longest + 1); i > 0; --i) text += letters[dice.below(letters.size())];
            return text;
        };
        std::string text = "seed: " + std::to_string(seed) + "\naxiom: A" + random_text(6) + " \n";
        for (const char letter : {'A', 'B', 'C', 'F'}) {
            if (letter != 'A' && dice.once_in(3)) continue;
            for (std::size_t i = 1 + dice.below(4); i > 0; --i) {
                text += std::string(1, letter) + " --> " + random_text(8) + (letter == 'A' ? "A" : "") + " : " +
                        std::to_string(dice.below(5) + 1) + "\n";
            }
        }
        std::int64_t steps = 1;
        ModuleWord word;
        const Grammar first = long_grammar(text, 50);
        word = first.axiom_modules();
        for (; steps < 50 && word.symbols.size() < 200'000; ++steps) {
            word = rewrite(first, first.tables()[0], word, steps);
        }
        if (word.symbols.size() < 200'000 || word.symbols.size() > 3'000'000) continue;
        ++compared;
        SCOPED_TRACE(text);
        expect_rewritten(long_grammar(text, steps - 1), 200'000);
    }
    EXPECT_GE(compared, 10);
}

/// Symbols and message of a derivation that ends in an error.
struct End {
    std::string message;
    std::uint64_t count = 0;
    std::uint64_t mixed = 0;
    std::uint64_t watched = 0;
    bool operator<(const End& other) const {
        return std::tie(message, count, mixed, watched) <
               std::tie(other.message, other.count, other.mixed, other.watched);
    }
};

TEST(ParallelChance, EndsAtTheSameSymbol) {
    const Grammar endless = long_grammar(specimen, 40);
    for (const double nodes : {1.0, 70'000.0, 1e6, 3e6}) {
        std::set<End> ends, prints;
        for (const int threads : thread_counts) {
            on_threads(threads, [&] {
                End end;
                DerivationOptions options;
                options.most_nodes = nodes;
                options.watch = [&](std::uint64_t symbols) { end.watched = scrambled(end.watched + symbols); };
                Digest digest;
                end.message = error_of<BudgetError>([&] { derive(endless, digest, options); });
                EXPECT_TRUE(has(end.message, "deriving the word (n = 40) visits more nodes than the budget of"));
                end.count = digest.count;
                end.mixed = digest.mixed;
                EXPECT_LT(static_cast<double>(end.count), std::max(nodes, 1e5));
                EXPECT_GT(static_cast<double>(end.count), nodes / 2 - 200'000);
                ends.insert(end);
                Print print(endless);
                end = {};
                end.message = error_of<BudgetError>([&] { derive(endless, print.printer, options); });
                end.count = print.count;
                end.mixed = print.mixed;
                prints.insert(end);
            });
        }
        EXPECT_EQ(ends.size(), 1u) << nodes;
        EXPECT_EQ(prints.size(), 1u) << nodes;
    }
}

/// Accepts a limited number of symbols.
class Thrower : public Digest {
public:
    explicit Thrower(std::uint64_t most) : most_(most) {}
    void symbols(const Run& run) override {
        if (count + run.symbols.size() > most_) throw WordError("enough");
        Digest::symbols(run);
    }

private:
    std::uint64_t most_;
};

TEST(ParallelChance, StopsWhenTheReaderStops) {
    const Grammar endless = long_grammar(specimen, 40);
    for (const std::uint64_t most : {0u, 100'000u, 700'000u, 3'000'000u}) {
        std::set<End> ends;
        for (const int threads : thread_counts) {
            on_threads(threads, [&] {
                Thrower thrower(most);
                End end;
                end.message = error_of<WordError>([&] { derive(endless, thrower); });
                EXPECT_EQ(end.message, "enough");
                end.count = thrower.count;
                end.mixed = thrower.mixed;
                ends.insert(end);
                // The same by `watch`.
                DerivationOptions options;
                std::uint64_t seen = 0;
                options.watch = [&](std::uint64_t symbols) {
                    seen += symbols;
                    if (seen > most) throw Stopped();
                };
                Digest digest;
                EXPECT_THROW(derive(endless, digest, options), Stopped);
                EXPECT_LE(digest.count, most + 10'000);
                EXPECT_EQ(digest.count, seen);
            });
        }
        EXPECT_EQ(ends.size(), 1u) << most;
    }
}

long peak() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

// Words most of whose symbols are erased at the end, or soon, or that rarely grow.
TEST(ParallelChance, ErasedSymbolsAreCountedAndTakeLittleMemory) {
    if (sanitized) GTEST_SKIP() << "sanitizers take memory of their own";
    const std::vector<std::pair<std::string, std::string>> systems = {
        {"axiom: C\nC --> CC\n", "interpret:\nC --> x : 0.0001\nC --> : 0.9999\n"},
        {"axiom: CCCCCCCCCCCCCCCCCCCCCCCCCCCCCCCC\nC --> CCCC : 0.5\nC --> : 0.5\n",
         "interpret:\nC --> x : 0.000001\nC --> : 0.999999\n"},
        {"axiom: AAAA\nA --> AA\nB --> BBBBBBBB\n", "interpret:\nA --> B : 0.000001\nA --> : 0.999999\n"},
        {"axiom: AAAA\nA --> AA : 0.999\nA --> BB : 0.001\nB --> BBBBBBBBBBBBBBBB\n", ""},
    };
    for (const auto& [productions, homomorphism] : systems) {
        const Grammar grammar = long_grammar(productions + homomorphism, 40);
        std::set<End> ends;
        for (const int threads : thread_counts) {
            const long before = peak();
            on_threads(threads, [&] {
                End end;
                DerivationOptions options;
                options.interpreted = true;
                options.most_nodes = 2e6;
                Digest digest;
                end.message = error_of<BudgetError>([&] { derive(grammar, digest, options); });
                EXPECT_TRUE(has(end.message, "visits more nodes than the budget of")) << productions << end.message;
                end.count = digest.count;
                end.mixed = digest.mixed;
                ends.insert(end);
            });
            EXPECT_LT(peak() - before, 64 * 1024) << productions;
        }
        EXPECT_EQ(ends.size(), 1u) << productions;
    }
}

TEST(ParallelChance, TakesLittleMemory) {
    if (sanitized) GTEST_SKIP() << "sanitizers take memory of their own";
    const Grammar grammar = long_grammar(specimen, 13);
    const long before = peak();
    on_threads(8, [&] {
        Digest digest;
        derive(grammar, digest);
        EXPECT_GT(digest.count, 40'000'000u);
    });
    EXPECT_LT(peak() - before, 16 * 1024);
}

// --- contexts ------------------------------------------------------------------------------------------------------

TEST(ParallelContexts, MakeTheWordThatRewritingMakes) {
    expect_rewritten(long_grammar(signals, 48), 400'000);
    // Brackets that contexts see, that do not match, and that are ignored.
    expect_rewritten(
        long_grammar("axiom: ]A[[B]A[\nA < A --> AB\nB > A --> BA\nA > B --> [A]\nA < [ --> [B\nB --> ]AB[\n"
                     "B < A > A -->\n",
                     20),
        300'000);
    expect_rewritten(
        long_grammar("ignore: [+\naxiom: ]A[+B]A[\nA < A --> AB+\nB > A --> [BA]\nA < B > B --> [[A]\nB --> AB\n",
                     25),
        300'000);
    // Long successors, and words that grow at once.
    expect_rewritten(
        long_grammar("axiom: ABAB\nA < B --> " + std::string(200, 'A') + "B\nB --> A\nA > A --> BAB\n", 4), 300'000);
}

TEST(ParallelContexts, MakeTheWordOfSchedules) {
    // A context of two symbols, and tables without contexts, among the others.
    const std::string schedule = "look grow look*2 far grow look grow look*2 grow far look*7 grow*7";
    expect_rewritten(
        grammar_of("axiom: AB\nderivation length: 26\nschedule: " + schedule +
                   "\ntable look:\nA < B --> BA\nB > A --> AB\nB --> AA\ntable grow:\nA --> AB\nB --> A[B]\n"
                   "table far:\nA B < A --> BB\n"),
        300'000);
}

TEST(ParallelContexts, MakeTheWordOfRandomSystems) {
    int compared = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        Dice dice(seed);
        const std::string letters = "ABC+[]";
        const auto letter = [&] { return std::string(1, letters[dice.below(letters.size())]); };
        std::string text = dice.once_in(2) ? "ignore: +" + std::string(dice.once_in(2) ? "[" : "C") + "\n" : "";
        text += "axiom: ABC";
        for (std::size_t i = dice.below(6); i > 0; --i) text += letter();
        text += " \n";
        std::set<std::string> known = {"A", "B"};
        for (std::size_t i = 3 + dice.below(6); i > 0; --i) {
            const auto neighbour = [&] { return std::string(1, "ABC+"[dice.below(4)]); };
            std::string rule = dice.once_in(3) ? "" : neighbour() + " < ";
            rule += letter();
            if (!dice.once_in(3)) rule += " > " + neighbour();
            if (!known.insert(rule).second) continue;
            text += rule + " --> ";
            for (std::size_t k = dice.below(5); k > 0; --k) text += letter();
            text += " \n";
        }
        text += "A --> AB[C]\nB --> BA\n";
        Grammar grammar = long_grammar(text, 60);
        ModuleWord word = grammar.axiom_modules();
        std::int64_t steps = 0;
        for (; steps < 60 && word.symbols.size() < 270'000; ++steps) {
            word = rewrite(grammar, grammar.tables()[0], word, steps + 1);
        }
        if (word.symbols.size() < 270'000) {
            if (seed % 3 == 0) expect_rewritten(long_grammar(text, 20), 0);
            continue;
        }
        ++compared;
        SCOPED_TRACE(text);
        // One step more, so that a step begins with a long word.
        if (word.symbols.size() < 1'000'000) ++steps;
        expect_rewritten(long_grammar(text, steps), 1);
    }
    EXPECT_GE(compared, 5);
}

TEST(ParallelContexts, RefuseTheSameWords) {
    const Grammar endless = long_grammar(signals, 200);
    for (const std::uint64_t most : {10u, 1'000u, 300'000u, 1'000'000u}) {
        std::set<std::string> messages;
        for (const int threads : thread_counts) {
            on_threads(threads, [&] {
                DerivationOptions options;
                options.longest_word = most;
                const std::string message = error_of<BudgetError>([&] { resolve_contexts(endless, options); });
                EXPECT_TRUE(has(message, "would have more than " + std::to_string(most) + " symbols"));
                messages.insert(message);
                options.longest_word = UINT64_MAX;
                options.whole_words = most;
                messages.insert(error_of<BudgetError>([&] { resolve_contexts(endless, options); }));
            });
        }
        EXPECT_EQ(messages.size(), 2u) << most;
    }
}

TEST(ParallelContexts, AreWatchedByTheThreadThatCalls) {
    const Grammar endless = long_grammar(signals, 200);
    std::set<std::uint64_t> counts;
    for (const int threads : thread_counts) {
        on_threads(threads, [&] {
            const std::thread::id here = std::this_thread::get_id();
            DerivationOptions options;
            std::uint64_t count = 0;
            options.watch = [&](std::uint64_t) {
                EXPECT_EQ(std::this_thread::get_id(), here);
                if (++count == 110) throw Stopped();
            };
            EXPECT_THROW(resolve_contexts(endless, options), Stopped);
        });
    }
}

}  // namespace sikku::parallel_words_test
