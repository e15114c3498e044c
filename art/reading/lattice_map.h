// art/reading/lattice_map.h: maps the plane of a grid to a picture of a hand drawing.
#pragma once

#include "art/reading/lattice.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <utility>

namespace sikku {

/// A perspective map of a lattice with the deviations of dots drawn by hand: rows are wavy, or the middle is drawn
/// closer together than the rim. Between dots the deviations are smooth.
class LatticeMap {
public:
    LatticeMap() = default;
    LatticeMap(DotLattice lattice, Homography perspective) : lattice_(lattice), perspective_(perspective) {}

    /// Records where the dot of a place was seen.
    void see(GridDot place, glm::dvec2 at);
    /// True if the dot of a place was recorded.
    bool has_seen(GridDot place) const { return deviations_.contains({place.y + origin_.y, place.x + origin_.x}); }
    /// Removes all recorded dots.
    void forget() { deviations_.clear(); }
    /// Makes the map pass exactly through the recorded dots, not only near them.
    void follow() { smoothing_ = 0.3; }
    /// Moves the image of the map, in spacings: all dots of a hand drawing may lie beside the middles of their
    /// loops.
    void offset(glm::dvec2 spacings) { offset_ += spacings; }
    glm::dvec2 offset() const { return offset_; }
    /// Maps the plane of the lattice to pixels.
    glm::dvec2 operator()(glm::dvec2 point) const {
        return perspective_(point + shift_ + offset_) + deviation(point + shift_);
    }
    /// The dot of a place, which the offset does not move.
    glm::dvec2 dot(GridDot place) const {
        const glm::dvec2 point = lattice_point(lattice_, place) + shift_;
        return perspective_(point) + deviation(point);
    }
    /// The same, computed without the dot that was seen at a place.
    glm::dvec2 without(GridDot place) const;
    /// The derivatives of the perspective by x and y at a point.
    std::array<glm::dvec2, 2> derivatives(glm::dvec2 point) const { return perspective_.derivatives(point + shift_); }
    /// Distance in pixels from a place to its neighbours.
    double spacing(glm::dvec2 point) const;
    DotLattice lattice() const { return lattice_; }
    const Homography& perspective() const { return perspective_; }
    /// The displacement of a point of the plane before the perspective.
    glm::dvec2 shift() const { return shift_ + offset_; }
    /// The same map, with places counted from another origin.
    LatticeMap from(GridDot origin) const;
    /// A map that is fitted to the dots of some places alone, without offset.
    LatticeMap fitted_to(std::span<const GridDot> places) const;

private:
    glm::dvec2 deviation(glm::dvec2 point, const GridDot* without = nullptr) const;

    using Key = std::pair<std::int32_t, std::int32_t>;  // y, x
    DotLattice lattice_ = DotLattice::square;
    Homography perspective_;
    GridDot origin_;         ///< origin of places
    glm::dvec2 shift_{0.0};  ///< its point
    glm::dvec2 offset_{0.0};
    /// Deviations are averaged over this distance, in spacings: a dot beside the middle of its loop should not bend
    /// the lattice, a wavy row should.
    double smoothing_ = 0.7;
    std::map<Key, glm::dvec2> deviations_;
};

}  // namespace sikku
