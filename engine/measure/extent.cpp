#include "engine/measure/extent.h"

#include "engine/derivation/exact_counts.h"
#include "engine/derivation/forecast.h"
#include "engine/measure/exact_quantity.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace sikku {
namespace {

void tell_counts(const Grammar& grammar, const std::vector<Integer>& counts, Measurement& result) {
    std::map<std::string, Integer> letters;
    Integer total = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        letters[grammar.symbols()[i].letter] += counts[i];
        total += counts[i];
    }
    result.symbols = quantity_of(total);
    for (const auto& [letter, count] : letters) result.counts.emplace_back(letter, quantity_of(count));
}

bool closes_polygon(const Command& command) {
    return command.action == Action::polygon_end || command.action == Action::edge_end;
}

/// Computes drawn, moves, length and polygons from the symbol counts of the interpreted word.
void tell_steps(const Grammar& grammar, const std::vector<Integer>& counts, Measurement& result) {
    const Lattice lattice = make_lattice(grammar);
    Integer drawn = 0, moves = 0, polygons = 0;
    std::array<Integer, most_coordinates> units;
    double length = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (closes_polygon(command)) polygons += counts[i];
        if (!command.is_step() || counts[i] == 0) continue;
        moves += counts[i];
        if (command.action == Action::move) continue;
        drawn += counts[i];
        if (lattice.rank > 0) {
            const auto step = lattice.step(static_cast<Symbol>(i));
            for (std::size_t j = 0; j < units.size(); ++j)
                units[j] += counts[i] * (command.value < 0 ? -step[j] : step[j]);
        } else {
            length += counts[i].template convert_to<double>() * std::fabs(command.value);
        }
    }
    result.drawn = quantity_of(drawn);
    result.moves = quantity_of(moves);
    result.polygons = quantity_of(polygons);
    result.length = lattice.rank > 0 ? quantity_of(lattice, units) : Quantity::of(length);
}

Fold as_fold(const Survey& survey) {
    const auto four = [](const Bounds& bounds) {
        return std::array{Quantity::of(bounds.low.x), Quantity::of(bounds.low.y), Quantity::of(bounds.high.x),
                          Quantity::of(bounds.high.y)};
    };
    Fold fold;
    fold.box = four(survey.box);
    if (survey.ink) fold.ink = four(*survey.ink);
    fold.end = {Quantity::of(survey.end.x), Quantity::of(survey.end.y)};
    fold.heading = survey.heading;
    fold.closed = survey.closed;
    fold.depth = survey.depth;
    return fold;
}

/// Sums `counted` over the symbols of a word that is too long to be counted exactly.
template <class Counted>
Quantity about(const Grammar& grammar, const Forecast& forecast, Counted counted) {
    double value = 0;
    double largest = -std::numeric_limits<double>::infinity();
    double parts = 0;
    for (std::size_t i = 0; i < forecast.rough_counts.size(); ++i) {
        const double times = counted(grammar.symbols()[i].command);
        if (times == 0 || forecast.rough_counts[i] == 0) continue;
        value += times * forecast.rough_counts[i];
        const double log10 = forecast.log10_counts[i] + std::log10(times);
        parts =
            log10 > largest ? parts * std::pow(10.0, largest - log10) + 1 : parts + std::pow(10.0, log10 - largest);
        largest = std::max(largest, log10);
    }
    if (value < 0x1p53) return {value, ""};
    return {value, fmt::format("about 10^{:.0f}", std::floor(largest + std::log10(parts)))};
}

/// Counts how often each symbol occurs.
class Census : public SymbolSink {
public:
    explicit Census(const Grammar& grammar) : counts_(grammar.symbols().size()) {}
    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) ++counts_[symbol];
    }
    std::vector<Integer> counts() const { return {counts_.begin(), counts_.end()}; }

private:
    std::vector<std::uint64_t> counts_;
};

/// Walks a turtle through the word to find its geometry, and counts its steps if `counts_steps`.
void walk(const Grammar& grammar, DerivationOptions options, bool counts_steps, Measurement& result) {
    const auto tell = [&](const auto& survey) {
        if (!counts_steps) return;
        result.drawn = quantity_of(Integer(survey.drawn));
        result.moves = quantity_of(Integer(survey.moves));
        result.length = Quantity::of(survey.length);
        result.polygons = quantity_of(Integer(survey.polygons));
    };
    result.derived = true;
    options.interpreted = true;
    if (grammar.is_spatial()) {
        const auto turtle = SpaceTurtle::make(grammar);
        derive(grammar, *turtle, options);
        tell(turtle->survey());
        result.space = turtle->survey();
    } else {
        const auto turtle = Turtle::surveying(grammar);
        derive(grammar, *turtle, options);
        tell(turtle->survey());
        result.geometry = as_fold(turtle->survey());
    }
}

/// Labels count as ink but have no exact extent. A walk finds it if the budget allows; otherwise the ink is
/// unknown.
void note_labels(const Grammar& grammar, const DerivationOptions& options, bool is_affordable, Measurement& result) {
    result.geometry->ink.reset();
    if (!is_affordable) return;
    const auto turtle = Turtle::surveying(grammar);
    derive(grammar, *turtle, options);
    result.geometry->ink = as_fold(turtle->survey()).ink;
}

/// Measures a system that cannot be forecast: walks through the words before and after `interpret:`.
Measurement walked(const Grammar& grammar, DerivationOptions options) {
    Measurement result;
    result.n = grammar.steps();
    options.interpreted = false;
    Census census(grammar);
    derive(grammar, census, options);
    tell_counts(grammar, census.counts(), result);
    walk(grammar, options, true, result);
    return result;
}

Measurement measured(const Grammar& given, double budget, const std::function<void(std::uint64_t)>& watch) {
    const DerivationOptions options = DerivationOptions::within(budget, watch);
    const Grammar grammar = resolve_contexts(shorten(given), options);
    if (!grammar.is_plain()) return walked(grammar, options);
    Measurement result;
    result.n = given.steps();
    result.derived = grammar.is_begun();
    const Forecast plain = *forecast(grammar, false);
    const Forecast interpreted = grammar.interpretation() ? *forecast(grammar, true) : plain;
    if (!plain.counts || !interpreted.counts) {
        const auto one_if = [](bool wanted) { return wanted ? 1.0 : 0.0; };
        const auto draws = [](const Command& command) { return command.action == Action::draw; };
        result.symbols = about(grammar, plain, [](const Command&) { return 1.0; });
        result.drawn = about(grammar, interpreted, [&](const Command& command) { return one_if(draws(command)); });
        result.moves = about(grammar, interpreted, [&](const Command& command) { return one_if(command.is_step()); });
        result.length = about(grammar, interpreted, [&](const Command& command) {
            return draws(command) ? std::fabs(command.value) : 0.0;
        });
        result.polygons =
            about(grammar, interpreted, [&](const Command& command) { return one_if(closes_polygon(command)); });
        return result;
    }
    tell_counts(grammar, *plain.counts, result);
    tell_steps(grammar, *interpreted.counts, result);
    if (!grammar.is_spatial()) result.geometry = fold(grammar);
    if (!result.geometry && interpreted.nodes <= budget) walk(grammar, options, false, result);
    if (result.geometry && grammar.has_labels()) note_labels(grammar, options, interpreted.nodes <= budget, result);
    return result;
}

/// Rounded positions within 1e-9 steps count as the start, which is meaningless for drawings of about that size.
void doubt_closed(Measurement& result) {
    constexpr double small = 1e-6;  // relative to the size
    const auto is_far = [](double gap, double width, double height) { return gap > small * std::max(width, height); };
    if (result.geometry) {
        Fold& fold = *result.geometry;
        const auto& box = fold.box;
        if (is_far(std::hypot(fold.end[0].value, fold.end[1].value), box[2].value - box[0].value,
                   box[3].value - box[1].value)) {
            fold.closed = false;
        }
    }
    if (result.space) {
        SpaceSurvey& survey = *result.space;
        const glm::dvec3 size = survey.box.high - survey.box.low;
        if (is_far(glm::length(survey.end), std::max(size.x, size.y), size.z)) survey.closed = false;
    }
}

}  // namespace

Measurement measure(const Grammar& given, double budget, const std::function<void(std::uint64_t)>& watch) {
    Measurement result = measured(given, budget, watch);
    doubt_closed(result);
    return result;
}

}  // namespace sikku
