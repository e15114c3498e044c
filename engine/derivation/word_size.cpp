#include "engine/derivation/word_size.h"

#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace sikku {
namespace {

class DrawnCounter : public SymbolSink {
public:
    DrawnCounter(const Grammar& grammar, WordSize& size) : size_(size) {
        for (const SymbolInfo& symbol : grammar.symbols()) {
            const Action action = symbol.command.action;
            draws_.push_back(action == Action::draw || action == Action::disc || action == Action::surface ? 1 : 0);
        }
    }
    void symbols(const Run& run) override {
        size_.nodes += static_cast<double>(run.symbols.size());
        for (const Symbol symbol : run.symbols) size_.drawn += draws_[symbol];
    }

private:
    WordSize& size_;
    std::vector<char> draws_;
};

/// Derives the word to measure it; nullopt above `most` nodes.
std::optional<WordSize> derived_size(const Grammar& grammar, double most) {
    WordSize size;
    DerivationOptions options = DerivationOptions::within(most);
    // Kept words may be as long as streamed ones here, although keeping them costs more: most are short.
    options.longest_word = options.compared = static_cast<std::uint64_t>(most);
    options.whole_words = 5 * options.longest_word;
    try {
        const Grammar resolved = resolve_contexts(grammar, options);
        DrawnCounter counter(resolved, size);
        derive(resolved, counter, options);
    } catch (const BudgetError&) {
        return std::nullopt;
    }
    return size;
}

}  // namespace

WordSize word_size(const Grammar& grammar, double most) {
    if (const auto known = estimate(grammar, true)) return {known->nodes, drawn_symbols(grammar, *known)};
    if (const auto whole = derived_size(grammar, most)) return *whole;
    std::optional<WordSize> last;
    std::int64_t steps = grammar.steps();
    for (std::int64_t less = 1; !last && steps > 0; less += std::max<std::int64_t>(1, less / 4)) {
        steps = std::max<std::int64_t>(0, grammar.steps() - less);
        if (const auto shorter = grammar.with_steps(steps)) last = derived_size(*shorter, most);
    }
    if (!last) return {most, most / 2};
    // Productions may alternate, so growth is measured over several steps.
    const std::int64_t before = std::max<std::int64_t>(0, steps - std::max<std::int64_t>(1, steps / 4));
    const auto shorter = grammar.with_steps(before);
    const auto first = shorter && before < steps ? derived_size(*shorter, most) : std::nullopt;
    if (!first || !(first->nodes > 0)) return *last;
    const double growth = extrapolated_growth(before, first->nodes, steps, last->nodes, grammar.steps());
    return {last->nodes * growth, last->drawn * growth};
}

double extrapolated_growth(std::int64_t early, double first, std::int64_t late, double last, std::int64_t steps) {
    constexpr double slow = 1.15;  // factor of a step
    if (!(first > 0 && last > first) || late <= early || steps <= late) return 1;
    const double of_step = std::pow(last / first, 1 / static_cast<double>(late - early));
    if (of_step >= slow || early == 0) return std::pow(of_step, static_cast<double>(steps - late));
    const double power = std::log(last / first) / std::log(static_cast<double>(late) / static_cast<double>(early));
    return std::pow(static_cast<double>(steps) / static_cast<double>(late), power);
}

}  // namespace sikku
