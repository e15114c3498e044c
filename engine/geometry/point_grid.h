// engine/geometry/point_grid.h: finds points near another by square cells.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Points in square cells. Keeps a reference to the points.
class PointGrid {
public:
    /// @param cell  side of a cell, above 0. Cells are larger if there would be more than 9 x 10^8 rows or columns.
    PointGrid(std::span<const glm::dvec2> points, double cell) : points_(points), cell_(cell) {
        for (const glm::dvec2 point : points) {
            cell_ = std::max({cell_, std::fabs(point.x) / 9e8, std::fabs(point.y) / 9e8});
        }
        entries_.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            entries_.push_back({row(points[i].y), row(points[i].x), static_cast<std::uint32_t>(i)});
        }
        std::sort(entries_.begin(), entries_.end());
    }

    /// Calls `visit(index)` for all points within `rings` sides of a cell of `at`, and for some others: by rows of
    /// cells, then by columns, then by index.
    template <class Visit>
    void visit(glm::dvec2 at, int rings, Visit&& visit) const {
        const std::int32_t x = row(at.x), y = row(at.y);
        for (std::int32_t i = y - rings; i <= y + rings; ++i) {
            auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{i, x - rings, 0});
            for (; entry != entries_.end() && entry->row == i && entry->column <= x + rings; ++entry) {
                visit(entry->index);
            }
        }
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
    struct Entry {
        std::int32_t row, column;
        std::uint32_t index;
        auto operator<=>(const Entry&) const = default;  // NOLINT(modernize-use-nullptr): no pointer is compared
    };
    /// The row or column of a coordinate; also of infinite ones, to which wrong fits of photographs lead.
    std::int32_t row(double coordinate) const {
        constexpr double farthest = 1e9;
        const double number = std::floor(coordinate / cell_);
        return static_cast<std::int32_t>(number < farthest ? std::max(number, -farthest) : farthest);
    }

    std::span<const glm::dvec2> points_;
    double cell_;
    std::vector<Entry> entries_;
};

}  // namespace sikku
