// art/reading/point_grid.h: finds points of a picture by their place.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sikku {

/// Converts a whole number to an integer, limited to ±10^8, because wrong fits can reach infinity.
inline std::int32_t whole(double number) {
    constexpr double farthest = 1e8;
    return static_cast<std::int32_t>(number < farthest ? std::max(number, -farthest) : farthest);
}

/// Finds points by their place, in cells of a given size.
class PointGrid {
public:
    PointGrid(const std::vector<glm::dvec2>& points, double size) : points_(points), size_(size) {
        for (std::uint32_t i = 0; i < points.size(); ++i) cells_[cell(points[i])].push_back(i);
    }
    /// The nearest point within `reach` (up to the size of a cell), or -1.
    std::int64_t nearest(glm::dvec2 at, double reach) const {
        std::int64_t best = -1;
        double least = reach;
        visit(at, 1, [&](std::uint32_t i) {
            const double distance = glm::distance(points_[i], at);
            if (distance < least || (distance == least && best < 0)) {
                least = distance;
                best = i;
            }
        });
        return best;
    }
    /// The nearest points to another one, nearest first.
    std::vector<std::uint32_t> neighbours(std::uint32_t point, std::size_t most) const {
        std::vector<std::uint32_t> found;
        for (int rings = 1; rings <= 8 && found.size() < most + 1; rings *= 2) {
            found.clear();
            visit(points_[point], rings, [&](std::uint32_t i) { found.push_back(i); });
        }
        std::erase(found, point);
        std::sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double to_a = glm::distance(points_[a], points_[point]);
            const double to_b = glm::distance(points_[b], points_[point]);
            return to_a != to_b ? to_a < to_b : a < b;
        });
        if (found.size() > most) found.resize(most);
        return found;
    }

private:
    using Cell = std::pair<std::int32_t, std::int32_t>;

    Cell cell(glm::dvec2 point) const { return {cell(point.x), cell(point.y)}; }
    std::int32_t cell(double coordinate) const { return whole(std::floor(coordinate / size_)); }
    template <class Visit>
    void visit(glm::dvec2 at, int rings, Visit&& see) const {
        const Cell middle = cell(at);
        for (int dy = -rings; dy <= rings; ++dy) {
            for (int dx = -rings; dx <= rings; ++dx) {
                const auto found = cells_.find({middle.first + dx, middle.second + dy});
                if (found == cells_.end()) continue;
                for (const std::uint32_t i : found->second) see(i);
            }
        }
    }

    const std::vector<glm::dvec2>& points_;
    double size_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace sikku
