#include "art/reading/dot_finder.h"

#include "engine/geometry/point_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace sikku {
namespace {

/// Maximum distance of a dot from its place, in spacings.
constexpr double dot_reach = 0.22;
/// Least strength of a dot, relative to most dots.
constexpr double weakest = 0.35;
/// Beyond this distance from the place that the others suggest, and beyond an empty place, a spot must resemble
/// most dots.
constexpr double far_reach = 0.32;
constexpr double strong = 0.6;

using Key = std::pair<std::int32_t, std::int32_t>;

/// Ornaments of a border have other sizes; flowers for dots are found by the lines around them.
bool is_dot_size(double of_most) {
    return of_most > 0.5 && of_most < 2.2;
}

std::vector<GridDot> ways_of(DotLattice lattice) {
    if (lattice == DotLattice::square) return {{2, 0}, {0, 2}, {-2, 0}, {0, -2}};
    return {{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}};
}

/// Grows the dots of a lattice from a patch of them.
class Growth {
public:
    Growth(const std::vector<InkSpot>& spots, const LatticeFit& fit, const SpotFinder& finder)
        : spots_(spots),
          points_(points_of(spots)),
          lattice_(fit.lattice),
          ways_(ways_of(fit.lattice)),
          finder_(finder),
          map_(fit.lattice, fit.patch_map),
          is_used_(spots.size()) {
        std::vector<double> steps;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            if (!fit.patch[i]) continue;
            take({fit.patch[i]->x, fit.patch[i]->y}, i);
            steps.push_back(map_.spacing(point({fit.patch[i]->x, fit.patch[i]->y})));
        }
        spacing_ = median(std::move(steps));
    }

    /// @return false for a degenerate lattice
    bool grow(const Monitor& monitor) {
        if (dots_.size() < 2 || !(spacing_ < finder_.longer_side()) || !(spacing_ > 2)) return false;
        measure();
        drop_other_sizes();
        if (dots_.size() < 2) return false;
        const PointGrid index(points_, std::max(4.0, 0.5 * spacing_));
        for (int round = 0; round < 200 && dots_.size() <= most_seen_dots; ++round) {
            monitor.check();
            if (grow_once(index, ways_, dot_reach, weakest)) continue;
            if (add_weak(monitor)) continue;
            if (grow_once(index, ways_, far_reach, strong)) continue;
            if (!grow_once(index, double_ways(), 0.6 * dot_reach, strong)) break;
        }
        drop_lonely();
        measure();
        return dots_.size() >= 2 && dots_.size() <= most_seen_dots;
    }

    FoundGrid result(double angle) {
        FoundGrid found{{DotGrid(std::vector<std::uint32_t>{1}), {}}, map_, spacing_, radius_, strength_, angle, 0};
        std::vector<GridDot> places;
        double squares = 0;
        for (const auto& [place, spot] : dots_) {
            const GridDot dot{place.first, place.second};
            places.push_back(dot);
            const double off = glm::distance(map_.without(dot), spot.at) / map_.spacing(point(place));
            squares += off * off;
        }
        found.placed = place_grid(lattice_, std::move(places));
        found.map = map_.from(found.placed.origin);
        // Dots that touch no other are rare in kolams, and lattices with many holes are accidents.
        const double off = std::sqrt(squares / static_cast<double>(dots_.size()));
        const auto count = static_cast<double>(found.grid().dots().size());
        const auto gaps = static_cast<double>(found.grid().gaps().size());
        const double full = lattice_ == DotLattice::square ? 2 : 3;
        found.score = count * std::min(1.0, gaps / (full * std::max(1.0, count - 1.6 * std::sqrt(count)))) *
                      std::min(1.0, strength_) * std::max(0.05, 1 - off / 0.16);
        return found;
    }

private:
    static std::vector<glm::dvec2> points_of(const std::vector<InkSpot>& spots) {
        std::vector<glm::dvec2> points;
        points.reserve(spots.size());
        for (const InkSpot& spot : spots) points.push_back(spot.at);
        return points;
    }
    glm::dvec2 point(Key place) const { return lattice_point(lattice_, {place.first, place.second}); }
    std::vector<GridDot> double_ways() const {
        std::vector<GridDot> ways;
        for (const GridDot way : ways_) ways.push_back({2 * way.x, 2 * way.y});
        return ways;
    }
    void take(Key place, std::size_t spot) {
        if (!dots_.emplace(place, spots_[spot]).second) return;
        is_used_[spot] = 1;
        map_.see({place.first, place.second}, spots_[spot].at);
    }
    std::size_t neighbours(Key place) const {
        std::size_t count = 0;
        for (const GridDot way : ways_) count += dots_.contains({place.first + way.x, place.second + way.y});
        return count;
    }

    /// The appearance of most dots, and the perspective that fits all of them.
    void measure() {
        std::vector<double> strengths;
        std::vector<double> radii;
        std::vector<double> spacings;
        std::vector<glm::dvec2> from, to;
        for (const auto& [place, spot] : dots_) {
            from.push_back(point(place));
            to.push_back(spot.at);
        }
        if (dots_.size() >= 9) {
            if (const auto better = Homography::fit(from, to)) {
                map_ = LatticeMap(lattice_, *better);
                for (const auto& [place, spot] : dots_) map_.see({place.first, place.second}, spot.at);
            }
        }
        for (const auto& [place, spot] : dots_) {
            strengths.push_back(spot.strength);
            spacings.push_back(map_.spacing(point(place)));
            radii.push_back(spot.radius / spacings.back());
        }
        strength_ = median(std::move(strengths));
        radius_ = median(std::move(radii));
        spacing_ = median(std::move(spacings));
        measured_ = dots_.size();
    }

    /// Adds spots at the places that some ways lead to from the dots. @return true if there were any
    bool grow_once(const PointGrid& index, const std::vector<GridDot>& ways, double reach, double least) {
        std::map<Key, std::size_t> more;
        std::set<Key> tried;
        for (const auto& [place, spot] : dots_) {
            for (const GridDot way : ways) {
                const Key to{place.first + way.x, place.second + way.y};
                if (dots_.contains(to) || !tried.insert(to).second) continue;
                const glm::dvec2 at = map_(point(to));
                const double spacing = map_.spacing(point(to));
                if (!(spacing > 0.3 * spacing_ && spacing < 3 * spacing_)) continue;
                const std::int64_t found = index.nearest(at, std::min(reach * spacing, 0.5 * spacing_));
                if (found < 0) continue;
                const auto i = static_cast<std::size_t>(found);
                if (is_used_[i] != 0 || spots_[i].strength < least * strength_) continue;
                if (const double size = spots_[i].radius / spacing / radius_; !is_dot_size(size)) continue;
                more.emplace(to, i);
            }
        }
        for (const auto& [place, spot] : more) {
            if (is_used_[spot] == 0) take(place, spot);
        }
        if (10 * dots_.size() > 13 * measured_) measure();
        return !more.empty();
    }

    /// Adds places beside dots where there is a weaker spot, since a dot may be weak.
    bool add_weak(const Monitor& monitor) {
        std::map<Key, InkSpot> more;
        for (const auto& [place, spot] : dots_) {
            monitor.check();
            for (const GridDot way : ways_) {
                const Key to{place.first + way.x, place.second + way.y};
                if (dots_.contains(to)) continue;
                const std::size_t around = neighbours(to);
                if (around < (dots_.size() < 6 ? 1U : 2U)) continue;
                const auto [seen, is_new] = tried_.emplace(to, around);
                if (!is_new && seen->second >= around) continue;
                seen->second = around;
                const double spacing = map_.spacing(point(to));
                const InkSpot near = finder_.near(map_(point(to)), radius_ * spacing, 0.12 * spacing);
                if (near.strength > weakest * strength_) more[to] = near;
            }
        }
        for (const auto& [place, spot] : more) {
            dots_.emplace(place, spot);
            map_.see({place.first, place.second}, spot.at);
        }
        return !more.empty();
    }

    void drop_other_sizes() {
        std::erase_if(dots_, [&](const auto& dot) {
            return !is_dot_size(dot.second.radius / map_.spacing(point(dot.first)) / radius_);
        });
        map_.forget();
        for (const auto& [place, spot] : dots_) map_.see({place.first, place.second}, spot.at);
    }

    /// Spots that are much weaker than the others, or apart from them, are not dots.
    void drop_lonely() {
        std::erase_if(dots_, [&](const auto& dot) { return dot.second.strength < weakest * strength_; });
        if (dots_.size() <= 4) return;
        std::vector<Key> lonely;
        for (const auto& [place, spot] : dots_) {
            if (neighbours(place) == 0) lonely.push_back(place);
        }
        for (const Key& place : lonely) dots_.erase(place);
    }

    const std::vector<InkSpot>& spots_;
    std::vector<glm::dvec2> points_;
    DotLattice lattice_;
    std::vector<GridDot> ways_;
    const SpotFinder& finder_;
    LatticeMap map_;
    std::vector<char> is_used_;
    std::map<Key, InkSpot> dots_;
    std::map<Key, std::size_t> tried_;  ///< places where no weaker spot was found, with their neighbours then
    std::size_t measured_ = 0;
    double spacing_ = 0;
    double radius_ = 0;
    double strength_ = 0;
};

}  // namespace

FoundGrid FoundGrid::with(std::vector<GridDot> places) const {
    FoundGrid other = *this;
    other.placed = place_grid(grid().lattice(), std::move(places));
    other.map = map.from(other.placed.origin);
    other.placed.origin = placed.origin + other.placed.origin;
    return other;
}

std::optional<FoundGrid> find_grid(const SpotFinder& finder, const std::vector<InkSpot>& all,
                                   std::optional<DotLattice> lattice, const Monitor& monitor,
                                   std::optional<double> spacing) {
    if (all.size() < 2) return std::nullopt;
    const double high = all[all.size() / 20].strength;
    std::optional<FoundGrid> best;
    std::size_t before = 0;
    for (const double part : {0.75, 0.55, 0.4, 0.28}) {
        const auto end = std::partition_point(all.begin(), all.end(),
                                              [&](const InkSpot& spot) { return spot.strength >= part * high; });
        const auto count = std::min<std::size_t>(static_cast<std::size_t>(end - all.begin()), most_seen_dots);
        if (count == before || count < 2) continue;
        before = count;
        const std::vector<InkSpot> spots(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        std::vector<glm::dvec2> points;
        for (const InkSpot& spot : spots) points.push_back(spot.at);
        const auto fit = fit_lattice(points, true, lattice, monitor, spacing);
        if (!fit || fit->fitted < 2) continue;
        Growth growth(spots, *fit, finder);
        if (!growth.grow(monitor)) continue;
        FoundGrid found = growth.result(fit->angle);
        // Chance finds lattices among many spots, too.
        const double share = static_cast<double>(found.grid().dots().size()) / static_cast<double>(count);
        found.score *= 0.4 + 0.6 * std::min(1.0, share);
        if (!best || found.score > best->score) best = std::move(found);
    }
    return best;
}

}  // namespace sikku
