#include "music/melody/melody_fold.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr std::size_t most_stretches = 1'000'000;
constexpr std::size_t most_number_bytes = std::size_t{1} << 28;
constexpr std::size_t numbers_in_stretch = 20;

using Span = GridStretch::Span;

void widen(Span& span, const Span& other) {
    span.low = std::min(span.low, other.low);
    span.high = std::max(span.high, other.high);
}

Span moved(const Span& span, bool mirrored, const Integer& by) {
    if (mirrored) return {by - span.high, by - span.low};
    return {span.low + by, span.high + by};
}

/// Goes on with `next`. Source: the composition of affine maps; the rest is bookkeeping about what is straight.
void append(GridStretch& all, const GridStretch& next) {
    const int turn = all.turn;
    const std::size_t swapped = turn % 2 == 0 ? 0 : 1;
    // A quarter turn takes x to y and y to -x.
    const bool x_mirrored = turn == 2 || turn == 3;
    const bool y_mirrored = turn == 1 || turn == 2;
    const auto direction = [&](int of_next) { return of_next < 0 ? -1 : (of_next + turn) % 4; };
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::size_t here = axis ^ swapped;
        all.length[here] += next.length[axis];
        all.drawn[here] += next.drawn[axis];
        all.steps[here] += next.steps[axis];
        all.runs[here] += next.runs[axis];
        // Runs along `axis` are crossed by the other one.
        if (next.crossings[axis]) {
            const std::size_t other = 1 - axis;
            const Span placed =
                moved(*next.crossings[axis], other == 0 ? x_mirrored : y_mirrored, all.move[other ^ swapped]);
            if (all.crossings[here]) {
                widen(*all.crossings[here], placed);
            } else {
                all.crossings[here] = placed;
            }
        }
        widen(all.box[here], moved(next.box[axis], axis == 0 ? x_mirrored : y_mirrored, all.move[here]));
    }
    if (!next.is_still) {
        if (all.last >= 0 && all.last == direction(next.first)) --all.runs[static_cast<std::size_t>(all.last % 2)];
        if (all.is_still) all.first = direction(next.first);
        all.last = direction(next.last);
        all.is_still = false;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const bool mirrored = axis == 0 ? x_mirrored : y_mirrored;
        all.move[axis ^ swapped] += mirrored ? Integer(-next.move[axis]) : next.move[axis];
    }
    all.turn = (turn + next.turn) % 4;
    all.rise += next.rise;
}

GridStretch primitive(const Grammar& grammar, const Lattice& lattice, Symbol symbol) {
    GridStretch result;
    const Action action = grammar.symbols()[symbol].command.action;
    if (action == Action::turn) {
        const std::string& letter = grammar.symbols()[symbol].letter;
        result.turn = static_cast<int>(lattice.turn[symbol]);
        result.rise = letter == "+" ? 1 : letter == "-" ? -1 : 0;
    }
    const std::int64_t length = lattice.length[symbol];
    if ((action != Action::draw && action != Action::move) || length == 0) return result;
    result.is_still = false;
    result.move[0] = length;
    result.length[0] = length < 0 ? -length : length;
    result.box[0] = {std::min<std::int64_t>(length, 0), std::max<std::int64_t>(length, 0)};
    if (action == Action::draw) {
        result.drawn[0] = result.length[0];
        result.steps[0] = 1;
        result.runs[0] = 1;
        result.crossings[0] = Span{};
        result.first = result.last = length < 0 ? 2 : 0;
    }
    return result;
}

}  // namespace

bool is_on_grid(const Lattice& lattice, int& first_direction) {
    if (lattice.headings != 4 || lattice.rank != 2 || lattice.unit != 1.0) return false;
    const double quarters = lattice.first_heading / 90.0;
    if (quarters != std::floor(quarters)) return false;
    first_direction = (static_cast<int>(quarters) % 4 + 4) % 4;
    return true;
}

std::optional<MelodyFold> MelodyFold::make(const Grammar& grammar) {
    const Lattice lattice = make_lattice(grammar);
    MelodyFold fold;
    if (!grammar.is_plain() || grammar.whole_word_steps() > 0 || !is_on_grid(lattice, fold.first_direction_))
        return std::nullopt;
    const std::vector<char> needed = grammar.reachable();
    std::size_t levels = 1 + (grammar.interpretation() ? 1 : 0);
    for (const ScheduleRun& run : grammar.schedule()) levels += static_cast<std::size_t>(run.steps);
    if (levels > most_stretches / std::max<std::size_t>(needed.size(), 1)) return std::nullopt;
    fold.symbols_ = needed.size();
    for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
        if (!needed[symbol]) {
            fold.stretches_.push_back(nullptr);
            continue;
        }
        const Action action = grammar.symbols()[symbol].command.action;
        if (action == Action::push || action == Action::pop) return std::nullopt;
        fold.stretches_.push_back(std::make_shared<const GridStretch>(primitive(grammar, lattice, symbol)));
    }
    std::size_t number_bytes = 0;
    const auto add_level = [&](const Table& table) {
        const std::size_t below = fold.stretches_.size() - fold.symbols_;
        for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
            const Word* successor = needed[symbol] ? table.successor(symbol) : nullptr;
            if (!successor || successor->size() == 1) {
                const Symbol same = successor ? successor->front() : symbol;
                fold.stretches_.push_back(fold.stretches_[below + same]);
                continue;
            }
            GridStretch stretch;
            for (const Symbol child : *successor) append(stretch, *fold.stretches_[below + child]);
            const Integer longest = stretch.length[0] + stretch.length[1];
            if (longest > 0) number_bytes += numbers_in_stretch * (boost::multiprecision::msb(longest) / 8);
            fold.stretches_.push_back(std::make_shared<const GridStretch>(std::move(stretch)));
        }
    };
    // Numbers grow with the level: so many levels may be few numbers and much memory.
    if (grammar.interpretation()) add_level(*grammar.interpretation());
    for (std::size_t i = grammar.schedule().size(); i > 0; --i) {
        const ScheduleRun& run = grammar.schedule()[i - 1];
        for (std::int64_t step = 0; step < run.steps; ++step) {
            add_level(grammar.tables()[run.table]);
            if (number_bytes > most_number_bytes) return std::nullopt;
        }
    }
    fold.whole_.turn = fold.first_direction_;
    const std::size_t top = fold.stretches_.size() - fold.symbols_;
    for (const Symbol symbol : grammar.axiom()) append(fold.whole_, *fold.stretches_[top + symbol]);
    return fold;
}

}  // namespace sikku
