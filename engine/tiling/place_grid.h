// engine/tiling/place_grid.h: finds the points near a straight line, and lines near each other.
#pragma once

#include "engine/geometry/box.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// A grid of square cells over a box, about as many as there are things in it.
class PlaceGrid {
public:
    PlaceGrid(const Box& box, std::size_t things) : low_(box.low) {
        const glm::dvec2 size = box.size();
        const double count = static_cast<double>(std::max<std::size_t>(things, 1));
        width_ = std::max({std::sqrt(size.x * size.y / count), std::max(size.x, size.y) / count, 1e-12});
        columns_ = static_cast<std::int64_t>(size.x / width_) + 1;
        rows_ = static_cast<std::int64_t>(size.y / width_) + 1;
    }
    std::size_t cells() const { return static_cast<std::size_t>(columns_ * rows_); }
    std::size_t cell(glm::dvec2 at) const { return static_cast<std::size_t>(row(at.y) * columns_ + column(at.x)); }
    /// Visits the cells that a line comes within `margin` of, and possibly some beside them.
    template <class Visit>
    void along(glm::dvec2 from, glm::dvec2 to, double margin, Visit&& visit) const {
        if (from.y > to.y) std::swap(from, to);
        const std::int64_t first = row(from.y - margin), last = row(to.y + margin);
        for (std::int64_t y = first; y <= last; ++y) {
            // The part of the line in this row, with half a row of it on either side.
            double begin = from.x, end = to.x;
            if (last > first && to.y > from.y) {
                const double bottom = low_.y + static_cast<double>(y) * width_ - margin;
                const double slope = (to.x - from.x) / (to.y - from.y);
                const double lower = std::clamp(bottom, from.y, to.y);
                const double upper = std::clamp(bottom + width_ + 2 * margin, from.y, to.y);
                begin = from.x + (lower - from.y) * slope;
                end = from.x + (upper - from.y) * slope;
            }
            if (begin > end) std::swap(begin, end);
            const std::int64_t right = column(end + margin);
            for (std::int64_t x = column(begin - margin); x <= right; ++x) {
                visit(static_cast<std::size_t>(y * columns_ + x));
            }
        }
    }

    /// Visits the cells that a box touches.
    template <class Visit>
    void over(const Box& box, Visit&& visit) const {
        for (std::int64_t y = row(box.low.y); y <= row(box.high.y); ++y) {
            for (std::int64_t x = column(box.low.x); x <= column(box.high.x); ++x) {
                visit(static_cast<std::size_t>(y * columns_ + x));
            }
        }
    }

private:
    std::int64_t column(double x) const { return clamped((x - low_.x) / width_, columns_); }
    std::int64_t row(double y) const { return clamped((y - low_.y) / width_, rows_); }
    static std::int64_t clamped(double value, std::int64_t count) {
        return static_cast<std::int64_t>(std::clamp(value, 0.0, static_cast<double>(count - 1)));
    }

    glm::dvec2 low_;
    double width_ = 1;
    std::int64_t columns_ = 1;
    std::int64_t rows_ = 1;
};

/// Lists of numbers or other small values, one for each cell, in one array.
template <class Entry>
class CellLists {
public:
    /// Call count() for all, then start(), then add() for all in the same way.
    explicit CellLists(std::size_t cells) : begin_(cells + 1) {}
    void count(std::size_t cell) { ++begin_[cell + 1]; }
    void start() {
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        list_.resize(begin_.back());
        next_.assign(begin_.begin(), begin_.end() - 1);
    }
    void add(std::size_t cell, const Entry& entry) { list_[next_[cell]++] = entry; }
    template <class Visit>
    void visit(std::size_t cell, Visit&& visit) const {
        for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) visit(list_[i]);
    }
    /// Visits the entries of a cell that were added so far.
    template <class Visit>
    void visit_added(std::size_t cell, Visit&& visit) const {
        for (std::size_t i = begin_[cell]; i < next_[cell]; ++i) visit(list_[i]);
    }
    std::size_t size(std::size_t cell) const { return begin_[cell + 1] - begin_[cell]; }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> next_;
    std::vector<Entry> list_;
};

}  // namespace sikku
