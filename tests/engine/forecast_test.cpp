#include "engine/derivation/forecast.h"
#include "engine/derivation/exact_counts.h"

#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace sikku::forecast_test {

using reference::grammar_of;
using reference::Kind;

Integer total(const std::vector<Integer>& counts) {
    Integer sum = 0;
    for (const Integer& count : counts) sum += count;
    return sum;
}

/// Nodes, by the definition: what is rewritten into other than one symbol, and the symbols of the word, but for
/// what leads to nothing.
struct Tree {
    const reference::System& system;
    bool interpreted;
    std::map<std::pair<std::string, std::size_t>, std::uint64_t> lengths{};

    const std::vector<reference::Rule>& rules(std::size_t step) const {
        return step < system.schedule.size() ? system.tables[system.schedule[step]] : system.interpretation;
    }
    std::size_t steps() const { return system.schedule.size() + (interpreted ? 1 : 0); }
    const reference::Rule* rule(const std::string& token, std::size_t step) const {
        for (const reference::Rule& rule : rules(step)) {
            if (rule.predecessor[0] == token) return &rule;
        }
        return nullptr;
    }
    std::uint64_t length(const std::string& token, std::size_t step) {
        if (step == steps()) return 1;
        const auto [found, fresh] = lengths.try_emplace({token, step}, 0);
        if (!fresh) return found->second;
        std::uint64_t sum = 0;
        if (const reference::Rule* used = rule(token, step)) {
            for (const std::string& child : used->successor) sum += length(child, step + 1);
        } else {
            sum = length(token, step + 1);
        }
        return lengths[{token, step}] = sum;
    }
    std::uint64_t nodes(const std::string& token, std::size_t step) {
        if (length(token, step) == 0) return 0;
        if (step == steps()) return 1;
        const reference::Rule* used = rule(token, step);
        if (!used) return nodes(token, step + 1);
        std::uint64_t sum = used->successor.size() == 1 ? 0 : 1;
        for (const std::string& child : used->successor) sum += nodes(child, step + 1);
        return sum;
    }
};

TEST(Forecast, CountsWhatIsDerived) {
    Kind kind;
    kind.tables = 2;
    kind.interpreted = true;
    kind.most_steps = 7;
    kind.brackets = Kind::Brackets::anywhere;
    for (unsigned seed = 0; seed < 400; ++seed) {
        const reference::System system = reference::random_system(seed, kind);
        for (const bool interpreted : {false, true}) {
            if (!reference::rewrite_level_by_level(system, interpreted, 20'000)) continue;
            const Grammar grammar = grammar_of(system.text());
            DerivationOptions options;
            options.interpreted = interpreted;
            std::vector<Integer> expected(grammar.symbols().size());
            for (const Symbol symbol : reference::derived(grammar, options)) ++expected[symbol];
            const auto found = forecast(grammar, interpreted);
            ASSERT_TRUE(found && found->counts);
            EXPECT_EQ(*found->counts, expected) << system.text();
            EXPECT_EQ(found->length(), total(expected).str());
            if (total(expected) == 0) {
                EXPECT_EQ(found->log10_length, -std::numeric_limits<double>::infinity());
            } else {
                EXPECT_NEAR(found->log10_length, std::log10(total(expected).convert_to<double>()), 1e-9);
            }
            Tree tree{system, interpreted && !system.interpretation.empty()};
            std::uint64_t nodes = 0;
            for (const std::string& token : system.axiom) nodes += tree.nodes(token, 0);
            EXPECT_EQ(found->nodes, static_cast<double>(nodes)) << system.text();
        }
    }
}

TEST(Forecast, IsExactHoweverLong) {
    const auto found = forecast(grammar_of("axiom: F\nderivation length: 1000\nF --> F+F\n"), false);
    EXPECT_EQ(found->counts->at(0), Integer(1) << 1000);
    EXPECT_EQ(found->length(), ((Integer(1) << 1001) - 1).str());
    EXPECT_NEAR(found->log10_length, 1001 * std::log10(2.0), 1e-9);
    EXPECT_NEAR(found->nodes / (std::ldexp(3.0, 1000)), 1, 1e-12);
    // Fibonacci
    const auto words = forecast(grammar_of("axiom: b\nderivation length: 300\na --> ab\nb --> a\n"), false);
    Integer a = 0;
    Integer b = 1;
    for (int i = 0; i < 300; ++i) {
        const Integer sum = a + b;
        b = a;
        a = sum;
    }
    EXPECT_EQ(words->length(), Integer(a + b).str());
}

TEST(Forecast, AboveTenThousandDigitsOnlyTheirNumberIsTold) {
    // 10^n symbols
    const auto of = [](int n) {
        return forecast(grammar_of("axiom: F\nderivation length: " + std::to_string(n) + "\nF --> FFFFFFFFFF\n"),
                        false);
    };
    EXPECT_EQ(of(9999)->length(), "1" + std::string(9999, '0'));
    EXPECT_TRUE(of(9999)->counts);
    EXPECT_EQ(of(10'001)->length(), "about 10^10001");
    EXPECT_FALSE(of(10'001)->counts);
    EXPECT_TRUE(std::isinf(of(10'001)->nodes));
    EXPECT_EQ(of(500'000)->length(), "about 10^500000");
    const auto more = forecast(grammar_of("axiom: F\nderivation length: 100000\nF --> FF\n"), false);
    EXPECT_EQ(more->length(), "about 10^30102");  // 2^100000 = 9.99 x 10^30102
}

TEST(Forecast, SystemsWithContextsHaveNone) {
    EXPECT_FALSE(forecast(grammar_of("axiom: F\nderivation length: 3\nA < F --> F\n"), false));
    EXPECT_FALSE(forecast(grammar_of("axiom: F\nderivation length: 3\nFF --> F\n"), false));
    EXPECT_TRUE(forecast(grammar_of("axiom: F\nA < F --> F\n"), false));  // no step is taken
    EXPECT_NO_THROW(
        require_affordable(grammar_of("axiom: F\nderivation length: 60\nF --> FF\nA < F --> F\n"), false, 10));
}

TEST(Forecast, RefusesWhatIsTooMuchToForecast) {
    std::string text = "axiom: A\nderivation length: 1000000000\n";
    for (char letter = 'A'; letter < 'Z'; ++letter) {
        text += std::string(1, letter) + " --> " + std::string(1, static_cast<char>(letter + 1)) + "A\n";
    }
    EXPECT_THROW(forecast(grammar_of(text), false), BudgetError);
}

TEST(LargestAffordable, StopsAtTheBorder) {
    const Grammar grammar = grammar_of("axiom: F\nderivation length: 100\nF --> FF\n");
    const auto nodes = [&](std::int64_t n) { return forecast(grammar.with_steps(n).value(), false)->nodes; };
    for (const std::int64_t n : {0, 1, 2, 3, 10, 30, 64, 99, 100}) {
        EXPECT_EQ(largest_affordable(grammar, false, nodes(n)), n);
        EXPECT_EQ(largest_affordable(grammar, false, std::nextafter(nodes(n), 0.0)), n - 1);
    }
    EXPECT_EQ(largest_affordable(grammar, false, 1e300), 100);  // not beyond the given n
    EXPECT_EQ(largest_affordable(grammar, false, 0), -1);
}

TEST(LargestAffordable, AgreesWithTryingThemAll) {
    Kind kind;
    kind.empties = false;
    for (unsigned seed = 0; seed < 100; ++seed) {
        reference::System system = reference::random_system(seed, kind);
        system.schedule.assign(12, 0);
        const Grammar grammar = grammar_of(system.text());
        for (const double budget : {3.0, 100.0, 5000.0}) {
            std::int64_t expected = -1;
            for (std::int64_t n = 0; n <= 12; ++n) {
                if (forecast(grammar.with_steps(n).value(), false)->nodes > budget) break;
                expected = n;
            }
            EXPECT_EQ(largest_affordable(grammar, false, budget), expected) << system.text();
        }
    }
}

std::string refusal(const Grammar& grammar, double budget) {
    return error_of<BudgetError>([&] { require_affordable(grammar, false, budget); });
}

TEST(RequireAffordable, TellsTheLengthAndTheLargestThatFits) {
    const Grammar grammar = grammar_of("axiom: F\nderivation length: 100\nF --> FF\n");
    const std::string message = refusal(grammar, 2e8);
    EXPECT_TRUE(has(message, "1267650600228229401496703205376 symbols"));
    EXPECT_TRUE(has(message, "n = 100"));
    EXPECT_TRUE(has(message, "200000000"));
    EXPECT_TRUE(has(message, "fits is 26"));  // 2^27 - 1 nodes
    const std::string long_one = refusal(grammar.with_steps(1'000'000).value(), 2e8);
    EXPECT_TRUE(has(long_one, "about 10^301029 symbols"));
    EXPECT_TRUE(has(long_one, "fits is 26"));
    EXPECT_TRUE(has(refusal(grammar, 0), "no derivation length fits"));
    EXPECT_EQ(refusal(grammar.with_steps(26).value(), (1 << 27) - 1), "");
    EXPECT_NE(refusal(grammar.with_steps(26).value(), (1 << 27) - 2), "");
    // A schedule that is too short for what would fit.
    const Grammar scheduled = grammar_of(
        "axiom: F\nderivation length: 40\nschedule: a*(n-3) b*3\ntable a:\nF --> FF\ntable b:\nF --> FFF\n");
    EXPECT_TRUE(has(refusal(scheduled, 1000), "fits is 7"));
}

}  // namespace sikku::forecast_test
