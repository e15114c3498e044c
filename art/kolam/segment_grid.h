// art/kolam/segment_grid.h: a square grid that finds the segments near a place.
#pragma once

#include "engine/base/monitor.h"
#include "engine/geometry/box.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

namespace sikku::kolam_plane {

/// A square grid over the drawing, with the segments near each of its cells.
class SegmentGrid {
public:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t item = 0;
        bool operator<(const Entry& other) const { return key != other.key ? key < other.key : item < other.item; }
    };

    SegmentGrid(const Box& box, double cell, double pad) : low_(box.low - glm::dvec2(2 * pad)), pad_(pad) {
        const double widest = box.longest() + 4 * pad;
        cell_ = std::max({cell, 4 * pad, widest / 1e9});
    }
    void add(std::uint32_t item, glm::dvec2 a, glm::dvec2 b) {
        if (a.x > b.x) std::swap(a, b);
        const std::uint64_t first = column(a.x - pad_);
        const std::uint64_t last = column(b.x + pad_);
        for (std::uint64_t x = first; x <= last; ++x) {
            double y0 = a.y;
            double y1 = b.y;
            if (b.x > a.x) {  // the part in this column
                const double left = low_.x + static_cast<double>(x) * cell_ - 2 * pad_;
                const double slope = (b.y - a.y) / (b.x - a.x);
                if (left > a.x) y0 = a.y + (std::min(left, b.x) - a.x) * slope;
                if (left + cell_ + 4 * pad_ < b.x) y1 = a.y + (std::max(left + cell_ + 4 * pad_, a.x) - a.x) * slope;
            }
            const std::uint64_t top = row(std::max(y0, y1) + 2 * pad_);
            for (std::uint64_t y = row(std::min(y0, y1) - 2 * pad_); y <= top; ++y) {
                entries_.push_back({x << 32 | y, item});
            }
        }
    }
    void sort(const Monitor& monitor) {
        std::sort(entries_.begin(), entries_.end(), stoppable(monitor, std::less<>()));
    }
    const std::vector<Entry>& entries() const { return entries_; }
    double cell() const { return cell_; }
    std::uint64_t column(double x) const { return place(x, low_.x); }
    std::uint64_t row(double y) const { return place(y, low_.y); }
    /// Index after the last entry of a column up to row `y`.
    std::size_t end_of(std::uint64_t x, std::uint64_t y) const {
        const auto above = [](std::uint64_t key, const Entry& entry) { return key < entry.key; };
        return static_cast<std::size_t>(std::upper_bound(entries_.begin(), entries_.end(), x << 32 | y, above) -
                                        entries_.begin());
    }

    /// Visits the entries of the cells that the box of `points` meets.
    template <class Visitor>
    void visit(std::span<const glm::dvec2> points, const Visitor& visitor) const {
        const auto [low, high] = box_of(points);
        const auto below = [](const Entry& entry, std::uint64_t key) { return entry.key < key; };
        for (std::uint64_t x = column(low.x); x <= column(high.x); ++x) {
            const std::size_t end = end_of(x, row(high.y));
            for (auto i = static_cast<std::size_t>(
                     std::lower_bound(entries_.begin(), entries_.end(), x << 32 | row(low.y), below) -
                     entries_.begin());
                 i < end; ++i) {
                visitor(entries_[i].item);
            }
        }
    }

private:
    std::uint64_t place(double value, double low) const {
        return static_cast<std::uint64_t>(std::clamp((value - low) / cell_, 0.0, 4e9));
    }
    glm::dvec2 low_;
    double pad_;
    double cell_;
    std::vector<Entry> entries_;
};

}  // namespace sikku::kolam_plane
