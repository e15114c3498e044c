// art/drawing/map_frames.h: the steps of a map's derivation with their vertices placed.
#pragma once

#include "engine/language/grammar.h"
#include "engine/map/placement.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace sikku {

/// A map after some steps, with places of its vertices.
struct MapFrame {
    Map map;
    std::vector<glm::dvec2> places;  ///< places of the vertices
    std::vector<glm::dvec2> starts;  ///< places when the step was made: those of the step before, and new vertices at
                                     ///< equal parts of their edges
    std::vector<std::uint32_t> cell_born;  ///< step in which a division made each cell; 0: the axiom
    std::int64_t steps = 0;
    double grown = 1;              ///< share of the new walls' length that is drawn, from both of their ends
    bool outline_crosses = false;  ///< the outer wall crosses itself, so that parts of the map overlap

    /// The frame between `starts` (0) and `places` (1), with its new walls growing.
    MapFrame at(double share) const;
    /// True if the step moves vertices or makes walls.
    bool has_growth() const;
};

/// Selection of the frames of a derivation that are kept.
enum class KeptFrames { last, all };

/// Frames of one run of a derivation, made on demand.
class MapFrames {
public:
    /// Derives the map once without placing it, so that a map beyond the budget is refused early.
    /// @param grammar  has a map. @throws BudgetError, PlacementError, Stopped
    MapFrames(const Grammar& grammar, double budget, Monitor monitor, KeptFrames kept);

    /// The map after that many steps, at most those of the grammar; if only the last frame is kept, not fewer than in
    /// the call before. Cost: that of the steps not yet made. Memory: some 100 bytes an edge of a frame.
    /// @throws as PlacedMap::next(); BudgetError if the frames kept have over 20 million edges
    std::shared_ptr<const MapFrame> after(std::int64_t steps);

private:
    void add_frame();

    std::shared_ptr<const Grammar> grammar_;
    PlacedMap placed_;
    KeptFrames kept_;
    double kept_edges_ = 0;
    Map before_;  ///< the map of the step before, and its cells' births
    std::vector<std::uint32_t> born_;
    std::vector<glm::dvec2> places_before_;
    std::map<std::int64_t, std::shared_ptr<const MapFrame>> frames_;
};

/// Limits for drawing with a budget of derivation nodes: an edge of any step costs one node, or, where vertices are
/// placed by gravity or pressure, 1000.
MapLimits map_limits(const MapSystem& system, double budget);

}  // namespace sikku
