#include "art/reading/lattice_map.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace sikku {
namespace {

constexpr double search_radius = 2.1;
/// Weight of no deviation: without neighbours the perspective holds.
constexpr double prior = 0.15;

}  // namespace

void LatticeMap::see(GridDot place, glm::dvec2 at) {
    deviations_[{place.y, place.x}] = at - perspective_(lattice_point(lattice_, place));
}

glm::dvec2 LatticeMap::deviation(glm::dvec2 point, const GridDot* without) const {
    if (deviations_.empty()) return glm::dvec2(0.0);
    const double rows = lattice_point(lattice_, {0, 2}).y;
    // Places far from all dots, which wrong fits can produce, do not fit into integers.
    if (!(std::fabs(point.x) < 1e8 && std::fabs(point.y) < 1e8)) return glm::dvec2(0.0);
    glm::dvec2 sum(0.0);
    double weights = prior;
    const auto low = static_cast<std::int32_t>(std::ceil((point.y - search_radius) / rows));
    const auto high = static_cast<std::int32_t>(std::floor((point.y + search_radius) / rows));
    for (std::int32_t row = low; row <= high; ++row) {
        const auto left = static_cast<std::int32_t>(std::ceil(2 * (point.x - search_radius)));
        const auto right = static_cast<std::int32_t>(std::floor(2 * (point.x + search_radius)));
        for (auto each = deviations_.lower_bound({2 * row, left}); each != deviations_.end(); ++each) {
            const auto& [place, deviation] = *each;
            if (place.first != 2 * row || place.second > right) break;
            if (without != nullptr && place == Key{without->y, without->x}) continue;
            const glm::dvec2 off = lattice_point(lattice_, {place.second, place.first}) - point;
            const double weight = std::exp(-glm::dot(off, off) / (2 * smoothing_ * smoothing_));
            sum += weight * deviation;
            weights += weight;
        }
    }
    return sum / weights;
}

glm::dvec2 LatticeMap::without(GridDot place) const {
    const glm::dvec2 point = lattice_point(lattice_, place) + shift_;
    return perspective_(point) + deviation(point, &place);
}

double LatticeMap::spacing(glm::dvec2 point) const {
    const auto steps = derivatives(point);
    return 0.5 * (glm::length(steps[0]) + glm::length(steps[1]));
}

LatticeMap LatticeMap::from(GridDot origin) const {
    LatticeMap map = *this;
    map.origin_ = origin_ + origin;
    map.shift_ = lattice_point(lattice_, map.origin_);
    return map;
}

LatticeMap LatticeMap::fitted_to(std::span<const GridDot> places) const {
    std::vector<glm::dvec2> from, to;
    std::vector<GridDot> seen;
    for (const GridDot place : places) {
        const auto found = deviations_.find({place.y + origin_.y, place.x + origin_.x});
        if (found == deviations_.end()) continue;
        const glm::dvec2 point = lattice_point(lattice_, place);
        seen.push_back(place);
        from.push_back(point);
        to.push_back(perspective_(point + shift_) + found->second);
    }
    constexpr std::size_t least = 9;
    const auto fitted = seen.size() < least ? std::nullopt : Homography::fit(from, to);
    if (!fitted) return *this;
    LatticeMap map(lattice_, *fitted);
    for (std::size_t i = 0; i < seen.size(); ++i) map.see(seen[i], to[i]);
    return map;
}

}  // namespace sikku
