#include "engine/tiling/tile_lineage.h"

#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace sikku {
namespace {

/// The tables of the steps, one after the other.
std::vector<std::uint32_t> tables_of(const Grammar& grammar) {
    std::vector<std::uint32_t> tables;
    for (const ScheduleRun& run : grammar.schedule()) {
        tables.insert(tables.end(), static_cast<std::size_t>(run.steps), run.table);
    }
    return tables;
}

/// Collects the polygons of a word, each with the symbol that draws it.
class PolygonReader : public PolygonSink, public PlaceSink {
public:
    /// @param makers  symbol before `interpret:` of each symbol of the word
    PolygonReader(TileGeneration& generation, const std::vector<std::uint32_t>& makers)
        : generation_(generation), makers_(makers) {}

    void vertices(std::span<const std::int64_t>, std::uint64_t position, bool) override { position_ = position; }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        // Inserted edges bound blades, not tiles.
        if (position_ == 0) return;
        PolygonList& list = generation_.polygons;
        list.corners.insert(list.corners.end(), vertices.begin(), vertices.end());
        list.end_polygon(pen.colour);
        generation_.symbol.push_back(makers_[position_ - 1]);
        position_ = 0;
    }

private:
    TileGeneration& generation_;
    const std::vector<std::uint32_t>& makers_;
    std::uint64_t position_ = 0;
};

class Lineage {
public:
    Lineage(const Grammar& grammar, const LineageLimits& limits, const Monitor& monitor)
        : grammar_(grammar), monitor_(monitor), word_(grammar.axiom_modules()) {
        options_.limit_whole_words(limits.nodes);
        options_.watch = [this](std::uint64_t symbols) { monitor_.advance(symbols); };
    }

    const ModuleWord& word() const { return word_; }
    /// Derives the next word. @param parents  receives for each symbol that of the word before
    void step(std::uint32_t table, std::vector<std::uint32_t>& parents) {
        monitor_.check();
        word_ = rewrite(grammar_, grammar_.tables()[table], word_, ++steps_, options_, &parents);
    }

    /// Draws the present word.
    TileGeneration generation() {
        TileGeneration result;
        result.steps = steps_;
        std::vector<std::uint32_t> makers;
        const Table* interpretation = grammar_.interpretation();
        ModuleWord interpreted;
        if (interpretation) {
            interpreted = rewrite(grammar_, *interpretation, word_, steps_ + 1, options_, &makers);
        } else {
            makers.resize(word_.symbols.size());
            std::iota(makers.begin(), makers.end(), 0U);
        }
        const auto written = grammar_.written_out(interpretation ? interpreted : word_);
        if (!written) throw BudgetError("the word has more than 524,288 different modules");
        PolygonReader reader(result, makers);
        const auto turtle = Turtle::tracing(*written, reader, reader, false);
        derive(*written, *turtle, options_);
        return result;
    }

private:
    const Grammar& grammar_;
    const Monitor& monitor_;
    DerivationOptions options_;
    ModuleWord word_;
    std::int64_t steps_ = 0;
};

/// @throws LineageError if the derivations up to `last` do not continue each other
std::vector<std::uint32_t> common_tables(const Grammar& grammar, std::int64_t first, std::int64_t last) {
    const auto longest = grammar.with_steps(last);
    if (!longest) {
        throw LineageError(fmt::format("the schedule is too short for a derivation length of {}", last));
    }
    std::vector<std::uint32_t> all = tables_of(*longest);
    for (std::int64_t steps = first; steps < last && grammar.has_schedule(); ++steps) {
        const auto shorter = grammar.with_steps(steps);
        const std::vector<std::uint32_t> tables = shorter ? tables_of(*shorter) : std::vector<std::uint32_t>{};
        if (!shorter || !std::equal(tables.begin(), tables.end(), all.begin())) {
            throw LineageError(
                "its schedule applies the tables in a different order at each derivation length, so generations "
                "are not derived from those before");
        }
    }
    return all;
}

}  // namespace

std::vector<TileGeneration> tile_generations(const Grammar& grammar, std::int64_t first, std::int64_t last,
                                             const LineageLimits& limits, const Monitor& monitor) {
    require_word(grammar);
    if (grammar.is_spatial()) {
        throw LineageError("this drawing pitches, rolls, bends or has surfaces; tiles lie in the plane");
    }
    if (last > limits.steps) {
        throw BudgetError(fmt::format("generations are derived up to n = {}, not to {}", limits.steps, last));
    }
    const std::vector<std::uint32_t> tables = common_tables(grammar, first, last);
    Lineage lineage(grammar, limits, monitor);
    std::vector<TileGeneration> generations;
    std::vector<std::uint32_t> parents;
    std::size_t tiles = 0;
    for (std::int64_t steps = 0; steps <= last; ++steps) {
        const auto too_many = [&](const std::string& what) {
            return BudgetError(steps > first
                                   ? fmt::format("{}; the largest derivation length that fits is {}", what, steps - 1)
                                   : what);
        };
        try {
            if (steps > 0) lineage.step(tables[static_cast<std::size_t>(steps - 1)], parents);
            if (steps < first) continue;
            generations.push_back(lineage.generation());
        } catch (const BudgetError& error) {
            throw too_many(fmt::format("n = {}: {}", steps, error.what()));
        }
        TileGeneration& generation = generations.back();
        tiles += generation.symbol.size();
        if (static_cast<double>(tiles) > limits.tiles) {
            throw too_many(fmt::format("n = {} to {} have {} tiles together, more than the limit of {:.0f}", first,
                                       steps, tiles, limits.tiles));
        }
        if (steps == first) continue;
        for (const std::uint32_t symbol : generation.symbol) generation.parent.push_back(parents[symbol]);
    }
    return generations;
}

}  // namespace sikku
