// engine/map/map_step.h: derives maps: replaces edges, joins matching branches into walls, divides cells.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/grammar.h"
#include "engine/map/map.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace sikku {

/// Parts and daughters of the edges and cells of a map in a derivation step. Each list has one more entry at its end:
/// the number of edges before the new walls, of vertices, or of cells.
struct MapOrigins {
    std::vector<std::uint32_t> first_edge;    ///< of each old edge, its first part; parts are numbered tail to head
    std::vector<std::uint32_t> first_vertex;  ///< of each old edge, the first vertex inside it
    std::vector<std::uint32_t> first_cell;    ///< of each old cell, its first daughter
};

/// Sizes known from the number of edges of each label, before a step is made.
struct MapForecast {
    double edges = 0;     ///< parts of the old edges, exactly
    double walls = 0;     ///< maximum number of walls added
    double vertices = 0;  ///< exactly
    double branches = 0;  ///< of all edges
};

/// Forecasts the sizes after a step. Cost: linear in the edges.
MapForecast forecast_step(const Map& map, const MapSystem& system, std::uint32_t table);

/// Makes one derivation step.
/// @param table  index into MapSystem::tables
/// @param step  number of the step, counted from 1
/// Cost: linear in the map and its branches, about 30 bytes for each new edge and 12 for each old one.
/// @throws BudgetError above 2^31 edges; Stopped
Map step_map(const Map& map, const MapSystem& system, std::uint32_t table, std::uint32_t step, MapOrigins& origins,
             const Monitor& monitor = {});

/// Limits of a derivation.
struct MapLimits {
    double edges = std::numeric_limits<double>::infinity();  ///< of the maps of all steps together
    double bytes = std::numeric_limits<double>::infinity();  ///< peak of memory
};

/// Derives the map of a grammar step by step.
class MapDerivation {
public:
    /// @param grammar  has a map; must outlive the derivation
    /// @throws BudgetError if the derivation has more than 1,000,000 steps
    explicit MapDerivation(const Grammar& grammar, const MapLimits& limits = {}, Monitor monitor = {});

    /// Makes the next step; false if there is none. @throws BudgetError if the step could exceed the limits, before
    /// memory is spent on it; Stopped
    bool next();
    /// Number of steps made.
    std::int64_t steps() const { return step_; }
    const Map& map() const { return map_; }
    /// Origins in the last step.
    const MapOrigins& origins() const { return origins_; }
    Map take() { return std::move(map_); }

private:
    void require_affordable(std::uint32_t table);
    void require_least_edges();

    const Grammar& grammar_;
    MapLimits limits_;
    Monitor monitor_;
    Map map_;
    MapOrigins origins_;
    double edges_made_ = 0;
    double looked_ahead_at_ = 0;  ///< edges of the map whose growth was last forecast
    std::int64_t step_ = 0;
    std::size_t run_ = 0;  // of the schedule
    std::int64_t step_of_run_ = 0;
};

/// Derives the map after all steps. @throws as MapDerivation
Map derive_map(const Grammar& grammar, const MapLimits& limits = {}, const Monitor& monitor = {});

}  // namespace sikku
