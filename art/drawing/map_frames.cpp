#include "art/drawing/map_frames.h"

#include "engine/base/memory.h"
#include "engine/derivation/derivation.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sikku {
namespace {

constexpr double most_kept_edges = 20e6;

struct Side {
    glm::dvec2 from, to;
    double left() const { return std::min(from.x, to.x); }
    double right() const { return std::max(from.x, to.x); }
};

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const Side& a, const Side& b) {
    return turn(a.from, a.to, b.from) * turn(a.from, a.to, b.to) < 0 &&
           turn(b.from, b.to, a.from) * turn(b.from, b.to, a.to) < 0;
}

/// True if two sides of the outer wall cross. Cost: sorts them, then compares those that overlap from left to right.
bool outline_crosses(const Map& map, const std::vector<glm::dvec2>& places) {
    std::vector<Side> sides;
    for (const HalfEdge half : map.outer()) sides.push_back({places[map.start(half)], places[map.end(half)]});
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.left() < b.left(); });
    for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t k = i + 1; k < sides.size() && sides[k].left() <= sides[i].right(); ++k) {
            if (cross(sides[i], sides[k])) return true;
        }
    }
    return false;
}

}  // namespace

MapFrame MapFrame::at(double share) const {
    MapFrame frame = *this;
    for (std::size_t i = 0; i < places.size(); ++i) frame.places[i] = glm::mix(starts[i], places[i], share);
    frame.grown = share;
    return frame;
}

bool MapFrame::has_growth() const {
    const bool has_walls = std::any_of(map.edges().begin(), map.edges().end(),
                                       [&](const MapEdge& edge) { return edge.born == steps && steps > 0; });
    return has_walls || places != starts;
}

MapFrames::MapFrames(const Grammar& grammar, double budget, Monitor monitor, KeptFrames kept)
    : grammar_(std::make_shared<const Grammar>(grammar)),
      placed_(*grammar_, map_limits(*grammar.map(), budget), monitor),
      kept_(kept) {
    if (grammar.map()->placing != Placing::straight) {
        derive_map(*grammar_, map_limits(*grammar.map(), budget), monitor);
    }
    add_frame();
}

void MapFrames::add_frame() {
    MapFrame frame;
    frame.map = placed_.map();
    frame.steps = placed_.derivation().steps();
    frame.places = placed_.vertices();
    if (frame.steps == 0) {
        born_.assign(frame.map.cells(), 0);
        frame.starts = frame.places;
    } else {
        const MapOrigins& origins = placed_.derivation().origins();
        frame.starts = divided_equally(before_, origins, places_before_);
        std::vector<std::uint32_t> born(frame.map.cells(), static_cast<std::uint32_t>(frame.steps));
        for (std::size_t cell = 0; cell < born_.size(); ++cell) {
            const std::uint32_t first = origins.first_cell[cell];
            if (origins.first_cell[cell + 1] == first + 1) born[first] = born_[cell];
        }
        born_ = std::move(born);
    }
    frame.cell_born = born_;
    // Straight walls and walls in balance never cross.
    frame.outline_crosses = placed_.pressed() && outline_crosses(frame.map, frame.places);
    places_before_ = frame.places;
    if (kept_ == KeptFrames::last) {
        frames_.clear();
    } else {
        kept_edges_ += static_cast<double>(frame.map.edges().size());
        if (kept_edges_ > most_kept_edges) {
            throw BudgetError(
                fmt::format("the maps of all generations up to n = {} have over {:.0f} edges, the limit "
                            "for drawing them together",
                            frame.steps, most_kept_edges));
        }
    }
    const std::int64_t steps = frame.steps;
    frames_[steps] = std::make_shared<const MapFrame>(std::move(frame));
}

std::shared_ptr<const MapFrame> MapFrames::after(std::int64_t steps) {
    while (!frames_.contains(steps)) {
        before_ = placed_.map();
        if (!placed_.next()) return frames_.rbegin()->second;
        add_frame();
    }
    return frames_.at(steps);
}

MapLimits map_limits(const MapSystem& system, double budget) {
    constexpr double bytes_for_edge = 400, nodes_of_placed_edge = 1000;
    const double edges = system.placing == Placing::straight ? budget : budget / nodes_of_placed_edge;
    return {edges, std::min(edges * bytes_for_edge, static_cast<double>(available_memory()) / 2)};
}

}  // namespace sikku
