// art/hand/hand_grid.h: finds points near another by square cells.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {

/// Points in square cells.
class HandGrid {
public:
    /// @param cell  side of a cell, above 0
    HandGrid(std::span<const glm::dvec2> points, double cell) : cell_(cell) {
        // Columns and rows are limited to 10^9: beyond them, many points would share a cell.
        for (const glm::dvec2 point : points) {
            cell_ = std::max({cell_, std::fabs(point.x) / 9e8, std::fabs(point.y) / 9e8});
        }
        order_.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            order_.emplace_back(key(column(points[i].x), column(points[i].y)), static_cast<std::uint32_t>(i));
        }
        std::sort(order_.begin(), order_.end());
        for (std::size_t begin = 0; begin < order_.size();) {
            std::size_t end = begin;
            while (end < order_.size() && order_[end].first == order_[begin].first) ++end;
            cells_.emplace(order_[begin].first, std::pair(begin, end));
            begin = end;
        }
    }

    /// Calls `visit(index)` for all points within a cell's side of `at`, and for some others, in a fixed order.
    template <class Visit>
    void visit(glm::dvec2 at, Visit&& visit) const {
        const std::int64_t x = column(at.x), y = column(at.y);
        for (std::int64_t row = y - 1; row <= y + 1; ++row) {
            for (std::int64_t col = x - 1; col <= x + 1; ++col) {
                const auto found = cells_.find(key(col, row));
                if (found == cells_.end()) continue;
                for (std::size_t k = found->second.first; k < found->second.second; ++k) visit(order_[k].second);
            }
        }
    }

private:
    std::int64_t column(double x) const {
        return static_cast<std::int64_t>(std::floor(std::clamp(x / cell_, -1e9, 1e9)));
    }
    static std::uint64_t key(std::int64_t x, std::int64_t y) {
        return static_cast<std::uint64_t>(x + 2'000'000'000) << 32 | static_cast<std::uint64_t>(y + 2'000'000'000);
    }

    double cell_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;
    std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> cells_;
};

}  // namespace sikku
