#include "music/melody/melody_fold.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_stretches = 1'000'000;
constexpr std::size_t most_number_bytes = std::size_t{1} << 28;
constexpr std::size_t numbers_in_stretch = 23;

using GridSpan = GridStretch::Span;

void widen(GridSpan& span, const GridSpan& other) {
    span.low = std::min(span.low, other.low);
    span.high = std::max(span.high, other.high);
}

GridSpan moved(const GridSpan& span, bool mirrored, const Integer& by) {
    if (mirrored) return {by - span.high, by - span.low};
    return {span.low + by, span.high + by};
}

/// Appends `next` to `all`. Source: composition of affine maps; the rest keeps track of straight runs.
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
        all.corners[here] += next.corners[axis];
        // Runs along `axis` are crossed by the other one.
        if (next.crossings[axis]) {
            const std::size_t other = 1 - axis;
            const GridSpan placed =
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
        const int following = direction(next.first);
        if (all.last >= 0 && all.last == following) --all.runs[static_cast<std::size_t>(all.last % 2)];
        if (all.last >= 0 && following >= 0 && (all.last + following) % 2 != 0) {
            ++all.corners[static_cast<std::size_t>(all.last % 2)];
        }
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
    all.marks += next.marks;
}

/// Appends stretches and brackets.
class Appender {
public:
    explicit Appender(GridStretch& all) : all_(all) {}
    void add(Action action, const GridStretch& next) {
        if (action == Action::push) {
            saved_.push_back({all_.move, all_.turn, all_.rise});
        } else if (action == Action::pop) {
            if (saved_.empty()) {
                is_balanced_ = false;
                return;
            }
            std::tie(all_.move, all_.turn, all_.rise) = std::move(saved_.back());
            saved_.pop_back();
        } else {
            return append(all_, next);
        }
        // A bracket ends the run before it.
        all_.last = -1;
        if (all_.is_still) all_.first = -1;
        all_.is_still = false;
    }
    /// True if every bracket has its partner within the stretch.
    bool is_balanced() const { return is_balanced_ && saved_.empty(); }

private:
    GridStretch& all_;
    std::vector<std::tuple<std::array<Integer, 2>, int, Integer>> saved_;
    bool is_balanced_ = true;
};

/// The action of a symbol. @param moves_sound  moves count as drawn
Action action_of(const Grammar& grammar, Symbol symbol, bool moves_sound) {
    const Action action = grammar.symbols()[symbol].command.action;
    return moves_sound && action == Action::move ? Action::draw : action;
}

/// The stretch of a step or a turn in a word read symbol by symbol: all steps lie on one axis.
std::optional<GridStretch> symbol_primitive(const Grammar& grammar, Symbol symbol, bool moves_sound) {
    GridStretch result;
    const SymbolInfo& info = grammar.symbols()[symbol];
    result.rise = rise_of(info);
    if (info.command.action != Action::draw && info.command.action != Action::move) return result;
    const double length = std::fabs(info.command.value);
    if (!(length < 1e15) || length != std::floor(length)) return std::nullopt;
    result.is_still = length == 0;
    result.length[0] = static_cast<std::int64_t>(length);
    if (action_of(grammar, symbol, moves_sound) == Action::draw) result.steps[0] = 1;
    return result;
}

GridStretch primitive(const Grammar& grammar, const Lattice& lattice, Symbol symbol, bool moves_sound) {
    GridStretch result;
    const Action action = action_of(grammar, symbol, moves_sound);
    if (action == Action::turn) {
        result.turn = static_cast<int>(lattice.turn[symbol]);
        result.rise = rise_of(grammar.symbols()[symbol]);
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
        result.crossings[0] = GridSpan{};
        result.first = result.last = length < 0 ? 2 : 0;
    }
    return result;
}

}  // namespace

bool counts_degrees(const SymbolInfo& symbol) {
    constexpr double most = 14;  // larger ones, and fractions, are angles
    if (symbol.arguments.size() != 1) return false;
    const double argument = symbol.arguments.front();
    return argument >= 0 && argument <= most && argument == std::floor(argument);
}

int rise_of(const SymbolInfo& symbol) {
    if (symbol.command.action != Action::turn) return 0;
    const int direction = symbol.letter == "+" ? 1 : symbol.letter == "-" ? -1 : 0;
    return direction * (counts_degrees(symbol) ? static_cast<int>(symbol.arguments.front()) : 1);
}

bool draws_nothing(const Grammar& grammar) {
    const std::vector<char> reached = grammar.reachable();
    bool moves = false;
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
        if (!reached[symbol]) continue;
        const Action action = grammar.symbols()[symbol].command.action;
        if (action == Action::draw) return false;
        moves = moves || action == Action::move;
    }
    return moves;
}

bool is_on_grid(const Lattice& lattice, int& first_direction) {
    if (lattice.headings != 4 || lattice.rank != 2 || lattice.unit != 1.0) return false;
    const double quarters = lattice.first_heading / 90.0;
    if (quarters != std::floor(quarters)) return false;
    first_direction = (static_cast<int>(quarters) % 4 + 4) % 4;
    return true;
}

std::optional<MelodyFold> MelodyFold::make(const Grammar& grammar, FoldOf of, bool folds_brackets,
                                           std::optional<Symbol> phrase) {
    const Lattice lattice = make_lattice(grammar);
    MelodyFold fold;
    if (!grammar.is_plain() || grammar.whole_word_steps() > 0) return std::nullopt;
    if (of == FoldOf::curve && !is_on_grid(lattice, fold.first_direction_)) return std::nullopt;
    const std::vector<char> needed = grammar.reachable();
    std::size_t levels = 1 + (grammar.interpretation() ? 1 : 0);
    for (const ScheduleRun& run : grammar.schedule()) levels += static_cast<std::size_t>(run.steps);
    if (levels > most_stretches / std::max<std::size_t>(needed.size(), 1)) return std::nullopt;
    const bool moves_sound = draws_nothing(grammar);
    fold.symbols_ = needed.size();
    for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
        if (!needed[symbol]) {
            fold.stretches_.push_back(nullptr);
            continue;
        }
        const Action action = grammar.symbols()[symbol].command.action;
        const bool is_bracket = action == Action::push || action == Action::pop;
        if (is_bracket) {
            const auto is_rewritten = [&](const Table& table) { return table.successor(symbol) != nullptr; };
            if (!folds_brackets || std::any_of(grammar.tables().begin(), grammar.tables().end(), is_rewritten) ||
                (grammar.interpretation() && is_rewritten(*grammar.interpretation()))) {
                return std::nullopt;
            }
        }
        auto step = of == FoldOf::symbols ? symbol_primitive(grammar, symbol, moves_sound)
                                          : std::optional(primitive(grammar, lattice, symbol, moves_sound));
        if (!step) return std::nullopt;
        if (phrase == symbol) step->marks = 1;
        fold.stretches_.push_back(std::make_shared<const GridStretch>(*std::move(step)));
    }
    std::size_t number_bytes = 0;
    bool is_balanced = true;
    const auto compose = [&](GridStretch& all, const Word& word, std::size_t below) {
        Appender appender(all);
        for (const Symbol symbol : word) {
            appender.add(grammar.symbols()[symbol].command.action, *fold.stretches_[below + symbol]);
        }
        is_balanced = is_balanced && appender.is_balanced();
    };
    const auto add_level = [&](const Table& table) {
        const std::size_t below = fold.stretches_.size() - fold.symbols_;
        for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
            const Word* successor = needed[symbol] ? table.successor(symbol) : nullptr;
            const Action only = successor && successor->size() == 1
                                    ? grammar.symbols()[successor->front()].command.action
                                    : Action::pass;
            if (only == Action::push || only == Action::pop) is_balanced = false;
            if (!successor || successor->size() == 1) {
                const Symbol same = successor ? successor->front() : symbol;
                fold.stretches_.push_back(fold.stretches_[below + same]);
                continue;
            }
            GridStretch stretch;
            compose(stretch, *successor, below);
            const Integer longest = stretch.length[0] + stretch.length[1];
            if (longest > 0) number_bytes += numbers_in_stretch * (boost::multiprecision::msb(longest) / 8);
            fold.stretches_.push_back(std::make_shared<const GridStretch>(std::move(stretch)));
        }
    };
    // Numbers grow with the level, so that even few may take much memory.
    if (grammar.interpretation()) add_level(*grammar.interpretation());
    for (std::size_t i = grammar.schedule().size(); i > 0; --i) {
        const ScheduleRun& run = grammar.schedule()[i - 1];
        for (std::int64_t step = 0; step < run.steps; ++step) {
            add_level(grammar.tables()[run.table]);
            if (number_bytes > most_number_bytes || !is_balanced) return std::nullopt;
        }
    }
    fold.whole_.turn = fold.first_direction_;
    const std::size_t top = fold.stretches_.size() - fold.symbols_;
    compose(fold.whole_, grammar.axiom(), top);
    if (!is_balanced) return std::nullopt;
    return fold;
}

}  // namespace sikku
