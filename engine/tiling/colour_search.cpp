#include "engine/tiling/colour_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <limits>

namespace sikku {
namespace {

using Tile = std::uint32_t;
constexpr Tile none = std::numeric_limits<Tile>::max();

/// Removes tiles with fewer than three remaining neighbours as long as there are any. Returns the order of removal.
std::vector<Tile> peel(const TileNeighbours& neighbours, std::vector<char>& is_removed) {
    std::vector<std::size_t> degree(neighbours.tiles());
    std::vector<Tile> order;
    is_removed.assign(neighbours.tiles(), 0);
    for (Tile tile = 0; tile < neighbours.tiles(); ++tile) {
        degree[tile] = neighbours.of(tile).size();
        if (degree[tile] >= 3) continue;
        is_removed[tile] = 1;
        order.push_back(tile);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const Tile other : neighbours.of(order[i])) {
            if (is_removed[other] || --degree[other] >= 3) continue;
            is_removed[other] = 1;
            order.push_back(other);
        }
    }
    return order;
}

/// A set of numbers below a limit, as bits, with the bits of words that are not 0, and so on. Cost of each call: a
/// few nanoseconds.
class IndexSet {
public:
    explicit IndexSet(std::size_t limit) {
        do {
            limit = limit / 64 + 1;
            levels_.emplace_back(limit, 0);
        } while (limit > 1);
    }
    void insert(std::uint32_t index) {
        for (auto& level : levels_) {
            std::uint64_t& word = level[index / 64];
            const bool was_empty = word == 0;
            word |= std::uint64_t{1} << index % 64;
            if (!was_empty) return;
            index /= 64;
        }
    }
    /// Removes a number; false if it was not in the set.
    bool erase(std::uint32_t index) {
        if ((levels_.front()[index / 64] >> index % 64 & 1U) == 0) return false;
        for (auto& level : levels_) {
            std::uint64_t& word = level[index / 64];
            word &= ~(std::uint64_t{1} << index % 64);
            if (word != 0) break;
            index /= 64;
        }
        return true;
    }
    /// Removes the least number; `none` if there is none.
    std::uint32_t pop_least() {
        if (levels_.back().front() == 0) return none;
        std::uint32_t index = 0;
        for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
            index = 64 * index + static_cast<std::uint32_t>(std::countr_zero((*level)[index]));
        }
        erase(index);
        return index;
    }

private:
    std::vector<std::vector<std::uint64_t>> levels_;
};

/// A search for three colours that learns from each conflict which choices exclude each other.
/// Source: Marques-Silva & Sakallah 1999, "GRASP"; Moskewicz et al. 2001, "Chaff".
class ThreeColours {
public:
    /// @param is_removed  tiles to be ignored; all others are coloured
    ThreeColours(const TileNeighbours& neighbours, const std::vector<char>& is_removed, const ColourBudget& budget,
                 const Monitor& monitor)
        : neighbours_(neighbours),
          is_removed_(is_removed),
          budget_{budget.conflicts, budget.steps + 20 * std::uint64_t{neighbours.tiles()}},
          pulse_(monitor),
          value_(3 * std::size_t{neighbours.tiles()}, unknown),
          reason_(value_.size()),
          phase_(value_.size(), 1),
          level_(value_.size(), 0),
          activity_(value_.size(), 0.0),
          idle_(value_.size()),
          place_(value_.size(), none),
          list_of_(2 * value_.size(), none) {}

    Colourable search() {
        for (Variable v = 0; v < value_.size(); ++v) {
            if (!is_removed_[v / 3]) push(v);
        }
        fix_first_tiles();
        std::uint64_t conflicts = 0, since_restart = 0, restart = 100;
        while (true) {
            pulse_();
            if (propagate()) {
                if (level() == 0) return Colourable::no;
                if (++conflicts > budget_.conflicts || steps_ > budget_.steps) return Colourable::undecided;
                learn();
                if (++since_restart >= restart) {
                    since_restart = 0;
                    restart += restart / 4;
                    back_to(0);
                }
                continue;
            }
            if (steps_ > budget_.steps) return Colourable::undecided;
            const Variable next = pop();
            if (next == none) return Colourable::yes;
            if (value_[next] != unknown) continue;
            level_begin_.push_back(trail_.size());
            assign(next, phase_[next], {});
        }
    }
    /// Colour of a tile; valid after search() returned yes.
    Tile colour(Tile tile) const {
        for (Tile c = 0; c < 3; ++c) {
            if (value_[3 * tile + c] == 1) return c;
        }
        return none;
    }

private:
    /// Variable 3 t + c: tile t has colour c. Literal 2 v: v is true; 2 v + 1: it is false.
    using Variable = std::uint32_t;
    using Literal = std::uint32_t;
    static constexpr std::int8_t unknown = -1;
    /// Reason for the value of a variable.
    struct Reason {
        enum class Kind : std::uint8_t { decision, other, siblings, clause } kind = Kind::decision;
        std::uint32_t index = 0;  ///< the other variable, or the clause
    };

    std::size_t level() const { return level_begin_.size(); }
    bool is_true(Literal literal) const { return value_[literal / 2] == static_cast<std::int8_t>(1 - literal % 2); }
    bool is_false(Literal literal) const { return value_[literal / 2] == static_cast<std::int8_t>(literal % 2); }

    /// The literal that is false while a variable keeps its value.
    Literal excluded(Variable v) const { return 2 * v + (value_[v] == 1 ? 1U : 0U); }

    void assign(Variable v, std::int8_t value, Reason reason) {
        value_[v] = value;
        reason_[v] = reason;
        level_[v] = static_cast<std::uint32_t>(level());
        trail_.push_back(v);
        ++steps_;
    }
    /// Two neighbours with most neighbours get the first two colours: names of colours do not matter.
    void fix_first_tiles() {
        Tile best = none;
        for (Tile tile = 0; tile < neighbours_.tiles(); ++tile) {
            if (is_removed_[tile]) continue;
            if (best == none || neighbours_.of(tile).size() > neighbours_.of(best).size()) best = tile;
        }
        if (best == none) return;
        assign(3 * best, 1, {});
        for (const Tile other : neighbours_.of(best)) {
            if (!is_removed_[other]) return assign(3 * other + 1, 1, {});
        }
    }

    /// Sets a variable; true if that is a conflict, whose literals are then in `conflict_`.
    bool imply(Variable v, std::int8_t value, Reason reason) {
        if (value_[v] == unknown) {
            assign(v, value, reason);
            return false;
        }
        if (value_[v] == value) return false;
        conflict_.assign(1, v);
        add_causes(v, reason, conflict_);
        return true;
    }
    /// Adds the variables that led to a variable's value.
    void add_causes(Variable v, const Reason& reason, std::vector<Variable>& causes) const {
        if (reason.kind == Reason::Kind::other) {
            causes.push_back(reason.index);
        } else if (reason.kind == Reason::Kind::siblings) {
            for (Variable other = v - v % 3; other < v - v % 3 + 3; ++other) {
                if (other != v) causes.push_back(other);
            }
        } else if (reason.kind == Reason::Kind::clause) {
            for (const Literal literal : clauses_[reason.index]) {
                if (literal / 2 != v) causes.push_back(literal / 2);
            }
        }
    }

    /// Propagates all values; true if there is a conflict.
    bool propagate() {
        while (next_ < trail_.size()) {
            pulse_();
            const Variable v = trail_[next_++];
            if (propagate_colours(v) || propagate_clauses(excluded(v))) return true;
        }
        return false;
    }
    bool propagate_colours(Variable v) {
        const Variable first = v - v % 3;
        if (value_[v] == 1) {
            for (Variable other = first; other < first + 3; ++other) {
                if (other != v && imply(other, 0, {Reason::Kind::other, v})) return true;
            }
            steps_ += neighbours_.of(v / 3).size();
            for (const Tile tile : neighbours_.of(v / 3)) {
                if (!is_removed_[tile] && imply(3 * tile + v % 3, 0, {Reason::Kind::other, v})) return true;
            }
            return false;
        }
        int possible = 0;
        Variable left = none;
        for (Variable other = first; other < first + 3; ++other) {
            if (value_[other] == 0) continue;
            ++possible;
            left = other;
        }
        if (possible == 0) conflict_ = {first, first + 1, first + 2};
        return possible == 0 || (possible == 1 && imply(left, 1, {Reason::Kind::siblings, 0}));
    }
    void watch(Literal literal, std::uint32_t clause) {
        if (list_of_[literal] == none) {
            list_of_[literal] = static_cast<std::uint32_t>(watches_.size());
            watches_.emplace_back();
        }
        watches_[list_of_[literal]].push_back(clause);
    }
    /// Propagates through the clauses that watch a literal which became false.
    bool propagate_clauses(Literal literal) {
        if (list_of_[literal] == none) return false;
        std::vector<std::uint32_t>& watching = watches_[list_of_[literal]];
        std::size_t kept = 0;
        steps_ += watching.size();
        for (std::size_t i = 0; i < watching.size(); ++i) {
            std::vector<Literal>& clause = clauses_[watching[i]];
            if (clause[0] == literal) std::swap(clause[0], clause[1]);
            const auto other = is_true(clause[0]) ? clause.end()
                                                  : std::find_if(clause.begin() + 2, clause.end(),
                                                                 [&](Literal each) { return !is_false(each); });
            if (other != clause.end()) {
                std::swap(clause[1], *other);
                watch(clause[1], watching[i]);
                continue;
            }
            watching[kept++] = watching[i];
            if (is_true(clause[0])) continue;
            const Literal unit = clause[0];
            const Reason reason{Reason::Kind::clause, watching[i]};
            if (imply(unit / 2, static_cast<std::int8_t>(1 - unit % 2), reason)) {
                for (++i; i < watching.size(); ++i) watching[kept++] = watching[i];
                watching.resize(kept);
                return true;
            }
        }
        watching.resize(kept);
        return false;
    }

    /// Finds the first choice to which all causes of the conflict lead (first unique implication point), keeps the
    /// clause that excludes them together, and backtracks.
    void learn() {
        std::vector<Literal> clause(1);
        std::vector<Variable> causes = conflict_;
        std::size_t open = 0;
        std::size_t at = trail_.size();
        seen_.resize(value_.size(), 0);
        marked_.clear();
        while (true) {
            steps_ += causes.size() + 1;
            for (const Variable v : causes) {
                if (seen_[v] || level_[v] == 0) continue;
                seen_[v] = 1;
                marked_.push_back(v);
                bump(v);
                if (level_[v] == level()) {
                    ++open;
                } else {
                    clause.push_back(excluded(v));
                }
            }
            do {
                --at;
                ++steps_;
            } while (!seen_[trail_[at]]);
            const Variable v = trail_[at];
            if (--open == 0) {
                clause[0] = excluded(v);
                break;
            }
            causes.clear();
            add_causes(v, reason_[v], causes);
        }
        for (const Variable v : marked_) seen_[v] = 0;
        increment_ /= 0.95;
        std::size_t target = 0;
        for (std::size_t i = 1; i < clause.size(); ++i) {
            if (level_[clause[i] / 2] > target) {
                target = level_[clause[i] / 2];
                std::swap(clause[1], clause[i]);
            }
        }
        back_to(target);
        const Literal unit = clause[0];
        Reason reason{};
        if (clause.size() > 1) {
            const auto number = static_cast<std::uint32_t>(clauses_.size());
            watch(clause[0], number);
            watch(clause[1], number);
            clauses_.push_back(std::move(clause));
            reason = {Reason::Kind::clause, number};
        }
        assign(unit / 2, static_cast<std::int8_t>(1 - unit % 2), reason);
    }
    void back_to(std::size_t target) {
        if (target >= level()) return;
        steps_ += trail_.size() - level_begin_[target];
        while (trail_.size() > level_begin_[target]) {
            const Variable v = trail_.back();
            trail_.pop_back();
            phase_[v] = value_[v];
            value_[v] = unknown;
            push(v);
        }
        level_begin_.resize(target);
        next_ = trail_.size();
    }

    // --- variables by activity, then by number: those without activity in a set, others in a heap ----------------
    bool before(Variable a, Variable b) const {
        return activity_[a] != activity_[b] ? activity_[a] > activity_[b] : a < b;
    }
    void bump(Variable v) {
        const bool waits = idle_.erase(v);
        activity_[v] += increment_;
        if (activity_[v] > 1e100) {
            steps_ += activity_.size();
            for (double& each : activity_) each *= 1e-100;
            increment_ *= 1e-100;
        }
        if (waits) return push(v);
        if (place_[v] != none) rise(place_[v]);
    }
    void put(std::size_t at, Variable v) {
        heap_[at] = v;
        place_[v] = static_cast<std::uint32_t>(at);
    }
    void rise(std::size_t at) {
        const Variable v = heap_[at];
        for (; at > 0 && before(v, heap_[(at - 1) / 2]); at = (at - 1) / 2) put(at, heap_[(at - 1) / 2]);
        put(at, v);
    }
    void push(Variable v) {
        if (activity_[v] == 0) return idle_.insert(v);
        if (place_[v] != none) return;
        heap_.push_back(v);
        place_[v] = static_cast<std::uint32_t>(heap_.size() - 1);
        rise(heap_.size() - 1);
    }
    Variable pop() {
        if (heap_.empty()) return idle_.pop_least();
        const Variable top = heap_.front();
        const Variable last = heap_.back();
        heap_.pop_back();
        place_[top] = none;
        if (heap_.empty()) return top;
        std::size_t at = 0;
        while (true) {
            std::size_t child = 2 * at + 1;
            if (child >= heap_.size()) break;
            if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
            if (!before(heap_[child], last)) break;
            put(at, heap_[child]);
            at = child;
        }
        put(at, last);
        return top;
    }

    const TileNeighbours& neighbours_;
    const std::vector<char>& is_removed_;
    ColourBudget budget_;
    Pulse pulse_;
    std::vector<std::int8_t> value_;
    std::vector<Reason> reason_;
    std::vector<std::int8_t> phase_;  ///< last values, which are tried again
    std::vector<std::uint32_t> level_;
    std::vector<double> activity_;
    double increment_ = 1;
    IndexSet idle_;
    std::vector<Variable> heap_;
    std::vector<std::uint32_t> place_;  // in the heap
    std::vector<Variable> trail_;
    std::size_t next_ = 0;  // of the trail, to be propagated
    std::vector<std::size_t> level_begin_;
    std::vector<std::vector<Literal>> clauses_;
    std::vector<std::uint32_t> list_of_;              // of literals: index into watches_, or none
    std::deque<std::vector<std::uint32_t>> watches_;  // clauses that watch a literal
    std::vector<Variable> conflict_;
    std::vector<char> seen_;
    std::vector<Variable> marked_;
    std::uint64_t steps_ = 0;
};

}  // namespace

std::optional<std::vector<Tile>> two_colours(const TileNeighbours& neighbours) {
    std::vector<Tile> colours(neighbours.tiles(), none), reached;
    for (Tile start = 0; start < neighbours.tiles(); ++start) {
        if (colours[start] != none) continue;
        colours[start] = 0;
        reached.assign(1, start);
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (const Tile other : neighbours.of(reached[i])) {
                if (colours[other] == colours[reached[i]]) return std::nullopt;
                if (colours[other] != none) continue;
                colours[other] = 1 - colours[reached[i]];
                reached.push_back(other);
            }
        }
    }
    return colours;
}

TileColouring find_colours(const TileNeighbours& neighbours, const ColourBudget& budget, const Monitor& monitor) {
    TileColouring result;
    result.colours = colours_of_neighbours(neighbours, monitor);
    for (const Tile colour : result.colours) result.at_most = std::max(result.at_most, static_cast<int>(colour) + 1);
    result.at_least = std::min(result.at_most, 3);
    if (result.at_most <= 3) return result;
    std::vector<char> is_removed;
    const std::vector<Tile> order = peel(neighbours, is_removed);
    std::vector<Tile> colours(neighbours.tiles(), none);
    if (order.size() < neighbours.tiles()) {
        ThreeColours search(neighbours, is_removed, budget, monitor);
        const Colourable found = search.search();
        if (found == Colourable::no) result.at_least = 4;
        if (found != Colourable::yes) return result;
        for (Tile tile = 0; tile < neighbours.tiles(); ++tile) {
            if (!is_removed[tile]) colours[tile] = search.colour(tile);
        }
    }
    for (std::size_t i = order.size(); i > 0; --i) {
        std::array<bool, 4> used{};
        for (const Tile other : neighbours.of(order[i - 1])) {
            if (colours[other] != none) used[colours[other]] = true;
        }
        colours[order[i - 1]] = static_cast<Tile>(std::find(used.begin(), used.end(), false) - used.begin());
    }
    result.at_most = 3;
    result.colours = std::move(colours);
    return result;
}

}  // namespace sikku
