#include "engine/derivation/forecast.h"

#include "engine/base/text.h"
#include "engine/derivation/exact_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace sikku {
namespace {

constexpr double most_entries_visited = 5e7;  // table entries visited

/// Productions of a table as pairs of successor symbol and multiplicity.
struct Sparse {
    struct Term {
        Symbol symbol;
        std::uint32_t times;
    };
    std::vector<std::uint32_t> begin;  // by symbol; one more at the end
    std::vector<Term> terms;
    std::vector<char> has;              // by symbol: 1 if it has a production
    std::vector<std::uint32_t> length;  // length of the successor

    Sparse(const Table& table, std::size_t symbols, const std::vector<char>& needed) {
        begin.push_back(0);
        for (Symbol symbol = 0; symbol < symbols; ++symbol) {
            const Word* successor = needed[symbol] ? table.successor(symbol) : nullptr;
            has.push_back(successor ? 1 : 0);
            length.push_back(successor ? static_cast<std::uint32_t>(successor->size()) : 1);
            if (successor) {
                std::map<Symbol, std::uint32_t> counts;
                for (const Symbol child : *successor) ++counts[child];
                for (const auto& [child, times] : counts) terms.push_back({child, times});
            }
            begin.push_back(static_cast<std::uint32_t>(terms.size()));
        }
    }
    /// The successor of a symbol.
    std::span<const Term> of(Symbol symbol) const {
        return std::span(terms).subspan(begin[symbol], begin[symbol + 1] - begin[symbol]);
    }
};

/// The table of each step, with `interpret:` as the last one.
struct Steps {
    std::vector<Sparse> tables;
    std::vector<std::pair<std::size_t, std::int64_t>> runs;  // index into tables, number of steps
    std::vector<Symbol> symbols;                             // symbols reached
    std::int64_t count = 0;
    double work = 0;  // table entries visited in one pass

    Steps(const Grammar& grammar, bool interpreted) {
        const std::vector<char> needed = grammar.reachable();
        for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
            if (needed[symbol]) symbols.push_back(symbol);
        }
        for (const Table& table : grammar.tables()) tables.emplace_back(table, needed.size(), needed);
        for (const ScheduleRun& run : grammar.schedule()) runs.emplace_back(run.table, run.steps);
        if (interpreted && grammar.interpretation()) {
            tables.emplace_back(*grammar.interpretation(), needed.size(), needed);
            runs.emplace_back(tables.size() - 1, 1);
        }
        for (const auto& [table, steps] : runs) {
            count += steps;
            work += static_cast<double>(steps) * static_cast<double>(1 + symbols.size() + tables[table].terms.size());
        }
        if (work > most_entries_visited) {
            throw BudgetError(
                fmt::format("{} steps of {} symbols are too much even to forecast", count, symbols.size()));
        }
    }
};

/// For each step, the symbols known to lead to an empty word. Covers only the last steps, as many as derive() keeps
/// expansions of.
class Emptiness {
public:
    Emptiness(const Steps& steps, std::size_t symbols) {
        const bool erases = std::any_of(steps.tables.begin(), steps.tables.end(), [](const Sparse& table) {
            return std::find(table.length.begin(), table.length.end(), 0U) != table.length.end();
        });
        if (!erases) return;
        const auto most_rows = static_cast<std::size_t>(kept_levels(symbols)) + 1;
        rows_.emplace_back(symbols, 0);
        for (std::size_t i = steps.runs.size(); i > 0; --i) {
            const auto& [index, count] = steps.runs[i - 1];
            const Sparse& table = steps.tables[index];
            for (std::int64_t step = 0; step < count && rows_.size() < most_rows; ++step) {
                std::vector<char> row = rows_.back();
                for (const Symbol symbol : steps.symbols) {
                    if (!table.has[symbol]) continue;
                    const auto terms = table.of(symbol);
                    row[symbol] = std::all_of(terms.begin(), terms.end(), [&](const Sparse::Term& term) {
                        return rows_.back()[term.symbol] != 0;
                    });
                }
                rows_.push_back(std::move(row));
            }
        }
    }
    /// True if the expansion of `symbol` with `left` remaining steps is known to be empty.
    bool empty(Symbol symbol, std::int64_t left) const {
        return static_cast<std::size_t>(left) < rows_.size() && rows_[static_cast<std::size_t>(left)][symbol];
    }

private:
    std::vector<std::vector<char>> rows_;
};

/// A number of any size to 15 digits: value x 2^exponent.
struct Scaled {
    double value = 0.0;
    std::int64_t exponent = 0;

    void add(const Scaled& other, double times) {
        if (other.value == 0 || times == 0) return;
        Scaled term{other.value * times, other.exponent};
        term.normalize();
        if (value == 0 || term.exponent > exponent + 200) {
            *this = term;
            return;
        }
        const std::int64_t gap = term.exponent - exponent;
        if (gap < -200) return;
        value += std::ldexp(term.value, static_cast<int>(gap));
        normalize();
    }
    void normalize() {
        int shift = 0;
        value = std::frexp(value, &shift);
        exponent += shift;
    }
    double log10() const {
        return value == 0 ? -std::numeric_limits<double>::infinity()
                          : std::log10(value) + static_cast<double>(exponent) * std::log10(2.0);
    }
    double as_double() const {
        return exponent > 1020 ? std::numeric_limits<double>::infinity()
                               : std::ldexp(value, static_cast<int>(exponent));
    }
};

std::vector<std::uint64_t> axiom_counts(const Grammar& grammar) {
    std::vector<std::uint64_t> counts(grammar.symbols().size(), 0);
    for (const Symbol symbol : grammar.axiom()) ++counts[symbol];
    return counts;
}

template <class Number, class Add>
void advance(const Sparse& table, const std::vector<Symbol>& symbols, std::vector<Number>& counts,
             std::vector<Number>& next, Add add) {
    for (const Symbol symbol : symbols) next[symbol] = Number();
    for (const Symbol symbol : symbols) {
        if (!table.has[symbol]) {
            add(next[symbol], counts[symbol], 1);
            continue;
        }
        for (const auto& [child, times] : table.of(symbol)) add(next[child], counts[symbol], times);
    }
    counts.swap(next);
}

/// Forecasts the nodes visited, the length and the counts, to 15 digits.
Forecast rough_forecast(const Grammar& grammar, const Steps& steps) {
    const std::size_t symbols = grammar.symbols().size();
    const Emptiness emptiness(steps, symbols);
    std::vector<Scaled> counts(symbols);
    std::vector<Scaled> next(symbols);
    const std::vector<std::uint64_t> occurrences = axiom_counts(grammar);
    for (std::size_t i = 0; i < symbols; ++i) counts[i].add({1.0, 0}, static_cast<double>(occurrences[i]));
    Scaled nodes;
    std::int64_t left = steps.count;
    for (const auto& [index, count] : steps.runs) {
        const Sparse& table = steps.tables[index];
        for (std::int64_t step = 0; step < count; ++step, --left) {
            for (const Symbol symbol : steps.symbols) {
                if (emptiness.empty(symbol, left)) {
                    counts[symbol] = {};
                } else if (table.has[symbol] && table.length[symbol] != 1) {
                    nodes.add(counts[symbol], 1);
                }
            }
            advance(table, steps.symbols, counts, next,
                    [](Scaled& sum, const Scaled& term, std::uint32_t times) { sum.add(term, times); });
        }
    }
    Forecast result;
    Scaled length;
    for (const Scaled& count : counts) {
        length.add(count, 1);
        nodes.add(count, 1);
        result.rough_counts.push_back(count.as_double());
        result.log10_counts.push_back(count.log10());
    }
    result.log10_length = length.log10();
    result.nodes = nodes.as_double();
    return result;
}

std::shared_ptr<const ExactCounts> exact_counts(const Grammar& grammar, const Steps& steps) {
    const std::vector<std::uint64_t> occurrences = axiom_counts(grammar);
    ExactCounts counts(occurrences.begin(), occurrences.end()), next(counts.size());
    for (const auto& [index, count] : steps.runs) {
        for (std::int64_t step = 0; step < count; ++step) {
            advance(steps.tables[index], steps.symbols, counts, next,
                    [](Integer& sum, const Integer& term, std::uint32_t times) {
                        times == 1 ? sum += term : sum += term * times;
                    });
        }
    }
    return std::make_shared<const ExactCounts>(std::move(counts));
}

/// True if the productions alone determine the numbers of symbols. A map has no symbols; its edges depend on where
/// its walls meet.
bool is_countable(const Grammar& grammar) {
    return grammar.is_plain() && !grammar.map() && grammar.whole_word_steps() == 0;
}

/// With one table in every step, one pass from the last step upwards finds the cost of every derivation length.
std::int64_t largest_affordable_of_one_table(const Grammar& grammar, bool interpreted, double budget) {
    const Steps steps(grammar, interpreted);
    const std::size_t symbols = grammar.symbols().size();
    std::vector<double> nodes(symbols, 1.0);  // 0: the symbol leads to nothing
    std::vector<double> next = nodes;
    const auto level = [&](const Sparse& table) {
        for (const Symbol symbol : steps.symbols) {
            if (!table.has[symbol]) {
                next[symbol] = nodes[symbol];
                continue;
            }
            double sum = 0;
            for (const auto& [child, times] : table.of(symbol)) sum += times * nodes[child];
            next[symbol] = sum > 0 && table.length[symbol] != 1 ? sum + 1 : sum;
        }
        nodes.swap(next);
    };
    const auto fits = [&] {
        double sum = 0;
        for (const Symbol symbol : grammar.axiom()) sum += nodes[symbol];
        return sum <= budget;
    };
    if (interpreted && grammar.interpretation()) level(steps.tables.back());
    std::int64_t largest = fits() ? 0 : -1;
    for (std::int64_t n = 1; n <= grammar.steps(); ++n) {
        level(steps.tables.front());
        if (!fits()) break;
        largest = n;
    }
    return largest;
}

[[noreturn]] void refuse_steps(const Grammar& grammar) {
    std::string size;
    if (const auto shorter = grammar.with_steps(most_steps)) {
        if (const auto known = estimate(*shorter, false); known && known->log10_length > 15) {
            size = fmt::format("; at {} the word has {} symbols already", most_steps, known->length());
        }
    }
    throw BudgetError(
        fmt::format("a derivation length of {} is too much: above {} only systems are derived whose words "
                    "do not grow{}",
                    grammar.steps(), most_steps, size));
}

}  // namespace

std::string Forecast::length() const {
    if (!counts) return fmt::format("about 10^{:.0f}", std::floor(log10_length));
    Integer sum = 0;
    for (const Integer& count : *counts) sum += count;
    return sum.str();
}

std::optional<Forecast> estimate(const Grammar& grammar, bool interpreted) {
    if (!is_countable(grammar)) return std::nullopt;
    return rough_forecast(grammar, Steps(grammar, interpreted));
}

std::optional<Forecast> forecast(const Grammar& grammar, bool interpreted) {
    if (!is_countable(grammar)) return std::nullopt;
    const Steps steps(grammar, interpreted);
    Forecast result = rough_forecast(grammar, steps);
    if (result.log10_length < most_digits) result.counts = exact_counts(grammar, steps);
    return result;
}

std::int64_t largest_affordable(const Grammar& grammar, bool interpreted, double budget) {
    if (grammar.tables().size() == 1) return largest_affordable_of_one_table(grammar, interpreted, budget);
    const auto fits = [&](std::int64_t steps) {
        const auto shorter = grammar.with_steps(steps);
        return shorter && rough_forecast(*shorter, Steps(*shorter, interpreted)).nodes <= budget;
    };
    // The schedule may also be too short for some lengths below n; a smaller length is then not searched for.
    std::int64_t low = fits(0) ? 0 : -1;
    std::int64_t high = 1;
    while (high < grammar.steps() && fits(high)) {
        low = high;
        high *= 2;
    }
    high = std::min(high, grammar.steps());
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

void require_affordable(const Grammar& grammar, bool interpreted, double budget) {
    if (!is_countable(grammar)) return;
    const Steps steps(grammar, interpreted);
    Forecast found = rough_forecast(grammar, steps);
    if (found.nodes <= budget) return;
    // If exact counts would take seconds, only the size of the word is reported.
    if (found.log10_length < most_digits && steps.work * (1 + found.log10_length / 100) < most_entries_visited) {
        found.counts = exact_counts(grammar, steps);
    }
    std::string advice;
    if (!grammar.is_begun()) {
        const std::int64_t fits = largest_affordable(grammar, interpreted, budget);
        advice = fits >= 0 ? fmt::format("; the largest derivation length that fits is {}", fits)
                           : std::string("; no derivation length fits");
    }
    throw BudgetError(fmt::format("a word of {} symbols (n = {}) is above the budget of {:.0f} nodes{}",
                                  readable(found.length()), grammar.steps(), budget, advice));
}

Grammar shorten(const Grammar& grammar) {
    // A map has no word, and its derivation limits its steps.
    if (grammar.map()) return grammar;
    if (grammar.steps() <= most_steps) return grammar;
    if (!grammar.is_plain() || grammar.cut()) refuse_steps(grammar);
    const std::vector<char> reached = grammar.reachable();
    constexpr auto nothing = std::numeric_limits<Symbol>::max();
    std::vector<std::vector<Symbol>> maps;  // for each table, the successor of each symbol
    for (const Table& table : grammar.tables()) {
        std::vector<Symbol> map(reached.size());
        for (Symbol symbol = 0; symbol < map.size(); ++symbol) {
            const Word* successor = table.context_free() ? table.successor(symbol) : nullptr;
            if (!table.context_free() || (reached[symbol] && successor && successor->size() > 1)) {
                refuse_steps(grammar);
            }
            map[symbol] = !successor ? symbol : successor->size() == 1 ? successor->front() : nothing;
        }
        maps.push_back(std::move(map));
    }
    const auto then = [&](const std::vector<Symbol>& first, const std::vector<Symbol>& second) {
        std::vector<Symbol> both = first;
        for (Symbol& symbol : both) {
            if (symbol != nothing) symbol = second[symbol];
        }
        return both;
    };
    std::vector<Symbol> all(reached.size());
    for (Symbol symbol = 0; symbol < all.size(); ++symbol) all[symbol] = symbol;
    for (const ScheduleRun& run : grammar.schedule()) {
        std::vector<Symbol> power = maps[run.table];
        for (std::int64_t steps = run.steps; steps > 0; steps /= 2) {
            if (steps % 2 == 1) all = then(all, power);
            power = then(power, power);
        }
    }
    return grammar.with_map(all);
}

double expected_symbols(const Grammar& grammar, bool interpreted) {
    try {
        const auto known = grammar.steps() <= most_steps ? estimate(grammar, interpreted) : std::nullopt;
        return known ? std::pow(10.0, known->log10_length) : 0.0;
    } catch (const BudgetError&) {
        return 0.0;  // a word that is too costly to forecast may still be streamed
    }
}

double matching_seconds(const Grammar& grammar, double budget) {
    constexpr double seconds_a_symbol = 2e-9;
    if (grammar.whole_word_steps() == 0) return 0;
    double compared = 0;
    for (const Table& table : grammar.tables()) {
        if (table.context_free()) continue;
        std::vector<double> lengths(grammar.symbols().size(), 0);
        for (const Production& production : table.productions()) {
            lengths[production.predecessor.front()] +=
                static_cast<double>(production.left.size() + production.predecessor.size() + production.right.size());
        }
        double sum = 0;
        for (const Symbol symbol : grammar.axiom()) sum += lengths[symbol];
        compared = std::max(compared, sum);
    }
    compared *= static_cast<double>(grammar.whole_word_steps());
    return std::min(compared, budget / 4) * seconds_a_symbol;
}

double drawn_symbols(const Grammar& grammar, const Forecast& forecast, bool moves_draw) {
    double drawn = 0;
    for (std::size_t i = 0; i < std::min(forecast.rough_counts.size(), grammar.symbols().size()); ++i) {
        const Action action = grammar.symbols()[i].command.action;
        if (action == Action::draw || action == Action::disc || action == Action::surface ||
            (moves_draw && action == Action::move))
            drawn += forecast.rough_counts[i];
    }
    return drawn;
}

double label_lines(const Grammar& grammar, const Forecast& forecast) {
    constexpr double lines_of_letter = 10, letters_of_number = 3;
    double lines = 0;
    for (std::size_t i = 0; i < std::min(forecast.rough_counts.size(), grammar.symbols().size()); ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (command.action != Action::label) continue;
        double letters = 0;
        for (const LabelText::Part& part : grammar.labels()[command.label].parts) {
            letters += static_cast<double>(part.text.size()) + (part.parameter > 0 ? letters_of_number : 0);
        }
        lines += forecast.rough_counts[i] * letters * lines_of_letter;
    }
    return lines;
}

}  // namespace sikku
