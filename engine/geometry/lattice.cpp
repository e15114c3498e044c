#include "engine/geometry/lattice.h"

#include "engine/base/decimal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t most_headings = std::int64_t{1} << 20;

/// Common denominator, or 0 if there is none.
std::int64_t common_denominator(std::int64_t one, std::int64_t other) {
    if (one == 0 || other == 0) return 0;
    const std::int64_t common = std::lcm(one, other);
    return common > largest_denominator ? 0 : common;
}

/// The length of a step as a decimal; for an edge, its factor.
double decimal_length(const SymbolInfo& symbol) {
    if (symbol.command.edge == 0) return symbol.command.value;
    return symbol.arguments.empty() ? 1.0 : symbol.arguments.front();
}

/// Places the steps of all symbols on a lattice of known headings. place() is false if they do not fit one.
class StepPlacer {
public:
    StepPlacer(const Grammar& grammar, Lattice& lattice) : grammar_(grammar), lattice_(lattice) {}

    bool place() {
        if (!find_unit()) return false;
        lattice_.unit = 1.0 / static_cast<double>(denominator_);
        place_edges();
        const std::size_t symbols = grammar_.symbols().size();
        lattice_.length.assign(symbols, 0);
        lattice_.edge.assign(symbols, 0);
        for (std::size_t i = 0; i < symbols; ++i) {
            const SymbolInfo& symbol = grammar_.symbols()[i];
            if (!symbol.command.is_step()) continue;
            const std::uint32_t edge = symbol.command.edge;
            const std::int64_t scale = edge == 0 ? denominator_ : denominator_ / edge_denominators_[edge - 1];
            std::int64_t& length = lattice_.length[i];
            length = std::llround(decimal_length(symbol) * static_cast<double>(scale));
            if (edge == 0) continue;
            const auto& way = ways_[edge - 1];
            if (!(static_cast<double>(std::abs(length)) * size(way) <= 0x1p40)) return false;
            if (std::all_of(way.begin() + 1, way.end(), [](std::int64_t each) { return each == 0; })) {
                length *= way.front();
            } else {
                lattice_.edge[i] = edge;
            }
        }
        lattice_.edges = std::move(ways_);
        return true;
    }

private:
    using Way = std::array<std::int64_t, most_coordinates>;

    static double size(const Way& way) {
        double sum = 0;
        for (const std::int64_t coordinate : way) sum += std::fabs(static_cast<double>(coordinate));
        return sum;
    }

    bool find_unit() {
        for (const EdgeLength& edge : grammar_.edges()) {
            std::int64_t& common = edge_denominators_.emplace_back(edge.parts.empty() ? 0 : 1);
            for (const EdgeLength::Part& part : edge.parts)
                common = common_denominator(common, decimal_denominator(part.length));
        }
        for (const SymbolInfo& symbol : grammar_.symbols()) {
            if (!symbol.command.is_step()) continue;
            const std::int64_t own = symbol.command.takes_argument ? 0 : decimal_denominator(decimal_length(symbol));
            const std::uint32_t edge = symbol.command.edge;
            denominator_ = common_denominator(denominator_, edge == 0 ? own : own * edge_denominators_[edge - 1]);
            if (denominator_ == 0) return false;
        }
        // Their multiples may together need more than 64 bits.
        return std::all_of(grammar_.symbols().begin(), grammar_.symbols().end(), [&](const SymbolInfo& symbol) {
            return !symbol.command.is_step() ||
                   std::fabs(symbol.command.value) * static_cast<double>(denominator_) <= 0x1p40;
        });
    }

    void place_edges() {
        const auto headings = static_cast<std::int64_t>(lattice_.headings);
        for (std::size_t i = 0; i < grammar_.edges().size(); ++i) {
            Way& way = ways_.emplace_back();
            for (const EdgeLength::Part& part : grammar_.edges()[i].parts) {
                const TurnFraction at = part.direction;
                const auto& power =
                    lattice_.power[static_cast<std::size_t>(at.numerator * (headings / at.denominator) % headings)];
                const auto steps =
                    std::llround(part.length * static_cast<double>(edge_denominators_[i])) * part.count;
                for (std::size_t j = 0; j < way.size(); ++j) way[j] += power[j] * steps;
            }
        }
    }

    const Grammar& grammar_;
    Lattice& lattice_;
    std::int64_t denominator_ = 1;
    std::vector<std::int64_t> edge_denominators_;  // of the lengths in the word of each edge, or 0
    std::vector<Way> ways_;                        // of the edges, in units of those
};

}  // namespace

Lattice make_lattice(const Grammar& grammar) {
    Lattice lattice;
    lattice.first_heading = std::fmod(grammar.heading().degrees, 360.0);
    std::int64_t k = 1;
    bool whole_headings = true;
    for (const SymbolInfo& symbol : grammar.symbols()) {
        const Command& command = symbol.command;
        if (command.action != Action::turn || !whole_headings) continue;
        whole_headings =
            !command.takes_argument && command.angle.exact && command.angle.exact->denominator <= most_headings;
        if (whole_headings) k = std::lcm(k, command.angle.exact->denominator);
        whole_headings = whole_headings && k <= most_headings;
    }
    const std::size_t symbols = grammar.symbols().size();
    if (!whole_headings) return lattice;
    if (k <= 2) k = 4;
    lattice.headings = static_cast<std::uint32_t>(k);
    lattice.turn.assign(symbols, 0);
    for (std::size_t i = 0; i < symbols; ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (command.action != Action::turn) continue;
        const TurnFraction turn = *command.angle.exact;
        const std::int64_t steps = turn.numerator * (k / turn.denominator) % k;
        lattice.turn[i] = static_cast<std::uint32_t>(steps < 0 ? steps + k : steps);
    }
    for (std::int64_t h = 0; h < k; ++h) {
        const auto& first = grammar.heading().exact;
        std::int64_t common = 0, sum = 0;
        if (first && !__builtin_mul_overflow(first->denominator, k, &common) && common < (std::int64_t{1} << 58) &&
            !__builtin_mul_overflow(first->numerator, k, &sum)) {
            sum += h * first->denominator;
            const std::int64_t divisor = std::gcd(sum, common);
            lattice.direction.push_back(unit_vector(TurnFraction{sum / divisor, common / divisor}));
        } else {
            lattice.direction.push_back(
                unit_vector(lattice.first_heading + 360.0 * static_cast<double>(h) / static_cast<double>(k)));
        }
    }
    const int rank = lattice_rank(k);
    if (rank == 0) return lattice;
    lattice.power = powers_of_root(static_cast<int>(k));
    if (StepPlacer(grammar, lattice).place()) {
        lattice.rank = rank;
    } else {
        lattice.power.clear();
        lattice.unit = 1.0;
        lattice.length.clear();
        lattice.edge.clear();
    }
    return lattice;
}

}  // namespace sikku
