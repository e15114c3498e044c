#include "engine/measure/parts.h"

#include "engine/geometry/lattice.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr std::size_t most_parts = 1'000'000;
// Boxes are sums of rounded numbers.
constexpr double box_slack = 1e-14;

template <class Number>
struct Vector {
    Number x, y;
};

/// A unit step, exact at multiples of 90 degrees.
template <class Number>
Vector<Number> direction(double first, std::uint32_t heading, std::uint32_t headings) {
    // Multiplied before the division, so that degrees stay whole as long as possible.
    long double degrees = static_cast<long double>(first) + 360.0L * heading / headings;
    degrees = std::fmod(std::fmod(degrees, 360.0L) + 360.0L, 360.0L);
    const int quarter = static_cast<int>(degrees / 90.0L);
    const long double rest = degrees - 90.0L * quarter;
    constexpr long double degree = 3.14159265358979323846264338327950288L / 180;
    const long double half = 0.5L;
    const long double height = std::sqrt(0.75L);
    long double c = std::cos(rest * degree);
    long double s = std::sin(rest * degree);
    if (rest == 0) {
        c = 1;
        s = 0;
    } else if (rest == 30) {
        c = height;
        s = half;
    } else if (rest == 60) {
        c = half;
        s = height;
    } else if (rest == 45) {
        c = s = std::sqrt(half);
    }
    const Vector<long double> turned = by_quarters(quarter, Vector<long double>{c, s});
    return {static_cast<Number>(turned.x), static_cast<Number>(turned.y)};
}

bool is_bracket(Action action) {
    return action == Action::push || action == Action::pop;
}

bool is_plain(Action action) {
    return action == Action::pass || action == Action::mark || action == Action::draw || action == Action::move ||
           action == Action::turn || is_bracket(action);
}

}  // namespace

template <class Number>
void DrawnPart<Number>::append(const DrawnPart& next) {
    if (next.draws()) {
        const glm::dvec2 at{static_cast<double>(x), static_cast<double>(y)};
        low = draws() ? glm::min(low, at + next.low) : at + next.low;
        high = draws() ? glm::max(high, at + next.high) : at + next.high;
        extent = static_cast<float>(std::max(high.x - low.x, high.y - low.y));
        // Combines two masses by Steiner's theorem.
        const double all = ink + next.ink;
        const double share = all > 0 ? next.ink / all : 0;
        const glm::dvec2 apart = at + next.centre - centre;
        const glm::dvec3 between{apart.x * apart.x, apart.x * apart.y, apart.y * apart.y};
        spread = (1 - share) * spread + share * next.spread + share * (1 - share) * between;
        centre += share * apart;
        ink = all;
    }
    x += next.x;
    y += next.y;
}

/// Finds the headings that occur at each level, from the axiom down. False if there are too many.
template <class Number>
bool Parts<Number>::find_headings(const Grammar& grammar, const std::vector<std::uint32_t>& turn) {
    // Turn of each symbol, by level.
    std::vector<std::vector<std::uint32_t>> turns{turn};
    const auto is_bracket_of = [&](Symbol symbol) { return grammar.is_push(symbol) || grammar.is_pop(symbol); };
    std::vector<std::uint32_t> open;
    /// Calls visit(child, heading) for each symbol of a word except brackets; returns the heading at its end.
    const auto walk = [&](const Word& word, std::size_t level, std::uint32_t heading, auto&& visit) {
        open.clear();
        for (const Symbol child : word) {
            if (grammar.is_push(child)) {
                open.push_back(heading);
            } else if (grammar.is_pop(child)) {
                if (open.empty()) continue;
                heading = open.back();
                open.pop_back();
            } else {
                visit(child, heading);
                heading = (heading + turns[level][child]) % headings_;
            }
        }
        return heading;
    };
    for (int level = 1; level <= levels(); ++level) {
        std::vector<std::uint32_t> next = turns.back();
        for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
            const Word* word = is_bracket_of(symbol) ? nullptr : successor(symbol, level);
            if (word)
                next[symbol] = walk(*word, static_cast<std::size_t>(level) - 1, 0, [](Symbol, std::uint32_t) {});
        }
        turns.push_back(std::move(next));
    }
    constexpr std::uint32_t none = UINT32_MAX;
    rows_.assign(turns.size() * headings_, none);
    std::uint32_t rows = 0;
    std::vector<char> here(symbols_ * headings_);
    const auto mark = [&](std::vector<char>& marks, std::size_t level) {
        return [&, level](Symbol symbol, std::uint32_t heading) {
            marks[symbol * headings_ + heading] = 1;
            std::uint32_t& row = rows_[level * headings_ + heading];
            if (row == none) row = rows++;
        };
    };
    walk(grammar.axiom(), turns.size() - 1, 0, mark(here, turns.size() - 1));
    for (std::size_t level = turns.size() - 1; level > 0; --level) {
        std::vector<char> below(symbols_ * headings_);
        for (std::size_t i = 0; i < here.size(); ++i) {
            if (!here[i]) continue;
            const auto symbol = static_cast<Symbol>(i / headings_);
            const auto heading = static_cast<std::uint32_t>(i % headings_);
            const Word* word = successor(symbol, static_cast<int>(level));
            if (word) {
                walk(*word, level - 1, heading, mark(below, level - 1));
            } else {
                mark(below, level - 1)(symbol, heading);
            }
        }
        here = std::move(below);
        if (rows > most_parts / symbols_) return false;
    }
    parts_.resize(rows * symbols_);
    return true;
}

/// Computes the parts of level 0, which are single symbols.
template <class Number>
void Parts<Number>::place_symbols(const Grammar& grammar, const Lattice& lattice, const std::vector<char>& reached,
                                  bool moves_draw) {
    std::vector<Vector<Number>> directions;
    for (std::uint32_t heading = 0; heading < headings_; ++heading) {
        directions.push_back(direction<Number>(lattice.first_heading, heading, headings_));
    }
    for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
        if (!reached[symbol]) continue;
        const Command& command = grammar.symbols()[symbol].command;
        const Number length = lattice.step_length<Number>(symbol, command.value, directions);
        for (std::uint32_t heading = 0; heading < headings_; ++heading) {
            if (!occurs(0, heading)) continue;
            DrawnPart<Number>& part = parts_[index(symbol, 0, heading)];
            if (command.action == Action::turn) part.turn = lattice.turn[symbol];
            if (!command.is_step()) continue;
            part.x = length * directions[heading].x;
            part.y = length * directions[heading].y;
            if (command.action == Action::move && !moves_draw) continue;
            const glm::dvec2 end{static_cast<double>(part.x), static_cast<double>(part.y)};
            part.low = glm::dvec2(std::min(end.x, 0.0), std::min(end.y, 0.0));
            part.high = glm::dvec2(std::max(end.x, 0.0), std::max(end.y, 0.0));
            part.extent = static_cast<float>(std::max(std::fabs(end.x), std::fabs(end.y)));
            part.ink = std::fabs(command.value);
            part.centre = 0.5 * end;
            part.spread = glm::dvec3(end.x * end.x, end.x * end.y, end.y * end.y) / 12.0;
        }
    }
}

template <class Number>
std::optional<Parts<Number>> Parts<Number>::make(const Grammar& grammar, bool moves_draw) {
    if (grammar.map()) return std::nullopt;
    const Lattice lattice = make_lattice(grammar);
    if (!grammar.is_plain() || grammar.whole_word_steps() > 0 || lattice.headings == 0) return std::nullopt;
    Parts parts;
    parts.headings_ = lattice.headings;
    parts.symbols_ = grammar.symbols().size();
    if (grammar.interpretation()) parts.tables_.push_back(grammar.interpretation());
    // Estimated before the headings that occur are known.
    const std::size_t per_level = parts.symbols_ * parts.headings_ / 16 + 1;
    for (std::size_t i = grammar.schedule().size(); i > 0; --i) {
        const ScheduleRun& run = grammar.schedule()[i - 1];
        if (static_cast<std::size_t>(run.steps) > most_parts / per_level) return std::nullopt;
        parts.tables_.insert(parts.tables_.end(), static_cast<std::size_t>(run.steps), &grammar.tables()[run.table]);
    }
    if (parts.tables_.size() + 1 > most_parts / per_level) return std::nullopt;

    const std::vector<char> reached = grammar.reachable();
    for (Symbol symbol = 0; symbol < parts.symbols_; ++symbol) {
        if (!reached[symbol]) continue;
        const Command& command = grammar.symbols()[symbol].command;
        if (!is_plain(command.action) || !std::isfinite(command.value)) return std::nullopt;
        if (!is_bracket(command.action)) continue;
        for (const Table* table : parts.tables_) {
            if (table->successor(symbol)) return std::nullopt;
        }
    }

    if (!parts.find_headings(grammar, lattice.turn)) return std::nullopt;

    parts.place_symbols(grammar, lattice, reached, moves_draw);

    struct Saved {
        Number x, y;
        std::uint32_t heading;
    };
    std::vector<Saved> saved;
    /// False if brackets do not balance or numbers are not finite.
    const auto compose = [&](const Word& word, int level, std::uint32_t heading, DrawnPart<Number>& part) {
        const std::uint32_t first = heading;
        saved.clear();
        for (const Symbol child : word) {
            const Action action = grammar.symbols()[child].command.action;
            if (action == Action::push) {
                saved.push_back({part.x, part.y, heading});
                continue;
            }
            if (action == Action::pop) {
                if (saved.empty()) return false;
                part.x = saved.back().x;
                part.y = saved.back().y;
                heading = saved.back().heading;
                saved.pop_back();
                continue;
            }
            // A symbol may be composed in a heading in which only others occur; the result is not used.
            if (!parts.occurs(level, heading)) return true;
            const DrawnPart<Number>& next = parts.parts_[parts.index(child, level, heading)];
            part.append(next);
            heading = (heading + next.turn) % parts.headings_;
        }
        part.turn = (heading + parts.headings_ - first) % parts.headings_;
        if (!part.draws()) return saved.empty();
        part.returns = std::hypot(static_cast<double>(part.x), static_cast<double>(part.y)) < 0.5 * part.extent;
        const glm::dvec2 slack = box_slack * (glm::abs(part.low) + glm::abs(part.high));
        part.low -= slack;
        part.high += slack;
        return saved.empty() && std::isfinite(part.ink) && std::isfinite(static_cast<double>(part.extent)) &&
               std::isfinite(part.spread.x + part.spread.y + part.spread.z);
    };
    for (int level = 1; level <= parts.levels(); ++level) {
        for (Symbol symbol = 0; symbol < parts.symbols_; ++symbol) {
            if (!reached[symbol]) continue;
            const Word* successor = parts.successor(symbol, level);
            for (std::uint32_t heading = 0; heading < parts.headings_; ++heading) {
                if (!parts.occurs(level, heading)) continue;
                DrawnPart<Number>& part = parts.parts_[parts.index(symbol, level, heading)];
                if (!successor) {
                    part = parts.parts_[parts.index(symbol, level - 1, heading)];
                } else if (!compose(*successor, level - 1, heading, part)) {
                    return std::nullopt;
                }
            }
        }
    }
    if (!compose(grammar.axiom(), parts.levels(), 0, parts.whole_)) return std::nullopt;
    return parts;
}

template struct DrawnPart<double>;
template class Parts<double>;
template class Parts<long double>;
template class Parts<Quad>;

}  // namespace sikku
