// art/plotter/plot_layer.h: the lines of one pen; numbers for points, and sets of segments.
#pragma once

#include "art/plotter/pen_rules.h"
#include "art/plotter/plot_join.h"
#include "art/plotter/plot_options.h"
#include "engine/base/chance.h"
#include "engine/base/memory.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sikku {

/// The lines that one pen draws.
struct PlotLayer {
    Pen pen;
    StrokeWidths widths;
    int number = 0;  ///< number of the pen, from 1
    PenSettings settings;
    PlotGraph graph;
    PlotStrokes strokes;
    PlotStrokes as_drawn;               ///< the same lines in the strokes and the order of the drawing
    std::vector<PlotSegment> repeated;  ///< repeated segments, while the layer is arranged
};

inline std::uint64_t plot_hash(std::uint64_t a, std::uint64_t b) {
    return scrambled((a * 0x9e3779b97f4a7c15U) ^ (b + 0x632be59bd9b4e019U));
}

inline std::size_t plot_table_size(std::size_t entries) {
    std::size_t size = 16;
    while (size < 2 * entries) size *= 2;
    return size;
}

/// An empty hash table with room for this many entries.
inline std::vector<std::uint32_t> plot_table(std::size_t entries) {
    std::vector<std::uint32_t> table;
    resize_in_large_pages(table, plot_table_size(entries), PlotSegment::none);
    return table;
}

/// Numbers for points; those less than `tolerance` apart along both axes have the same.
class PlotNodes {
public:
    /// @param expected  number of points for which the table need not grow
    explicit PlotNodes(double tolerance, std::size_t expected = 0)
        : tolerance_(tolerance), table_(plot_table(expected)) {}

    /// Prefetches the memory that at() will read: first the place in the table, and later the point there.
    void expect(glm::dvec2 later, glm::dvec2 soon) const {
#ifdef __GNUC__
        __builtin_prefetch(&table_[slot(cell_of(later))]);
        const std::uint32_t node = table_[slot(cell_of(soon))];
        if (node != PlotSegment::none) __builtin_prefetch(&points[node]);
#endif
    }

    std::uint32_t at(glm::dvec2 point) {
        // Most points are too far inside their cell for points of other cells to be near.
        const glm::dvec2 cell = cell_of(point);
        const glm::dvec2 inside = point / cell_size() - cell;
        const auto other = [](double share) { return share < 1 / cells ? -1.0 : share > 1 - 1 / cells ? 1.0 : 0.0; };
        const glm::dvec2 beside(other(inside.x), other(inside.y));
        std::size_t free = 0;
        std::uint32_t found = find(point, cell, free);
        if (found == PlotSegment::none && beside.x != 0) found = find(point, cell + glm::dvec2(beside.x, 0), free);
        if (found == PlotSegment::none && beside.y != 0) found = find(point, cell + glm::dvec2(0, beside.y), free);
        if (found == PlotSegment::none && beside.x != 0 && beside.y != 0) found = find(point, cell + beside, free);
        if (found != PlotSegment::none) return found;
        found = static_cast<std::uint32_t>(points.size());
        points.push_back(point);
        if (2 * points.size() > table_.size()) {
            table_.assign(2 * table_.size(), PlotSegment::none);
            for (std::uint32_t i = 0; i < points.size(); ++i) enter(i);
        } else {
            enter(found);
        }
        return found;
    }

    std::vector<glm::dvec2> points;

private:
    static constexpr double cells = 16.0;  // side of a cell, in tolerances

    double cell_size() const {
        return cells * tolerance_;
    }
    glm::dvec2 cell_of(glm::dvec2 point) const {
        return {std::floor(point.x / cell_size()), std::floor(point.y / cell_size())};
    }
    std::size_t slot(glm::dvec2 cell) const {
        return plot_hash(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x)),
                         static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y))) &
               (table_.size() - 1);
    }
    /// A node near `point` among those of a cell, and of cells that share its place in the table.
    std::uint32_t find(glm::dvec2 point, glm::dvec2 cell, std::size_t& free) const {
        for (free = slot(cell); table_[free] != PlotSegment::none; free = (free + 1) & (table_.size() - 1)) {
            const glm::dvec2 gap = points[table_[free]] - point;
            if (std::fabs(gap.x) < tolerance_ && std::fabs(gap.y) < tolerance_) return table_[free];
        }
        return PlotSegment::none;
    }
    void enter(std::uint32_t node) {
        std::size_t at = slot(cell_of(points[node]));
        while (table_[at] != PlotSegment::none) at = (at + 1) & (table_.size() - 1);
        table_[at] = node;
    }

    double tolerance_;
    std::vector<std::uint32_t> table_;
};

/// A set of segments without duplicates.
class PlotSegmentSet {
public:
    PlotSegmentSet(std::vector<PlotSegment>& segments, std::size_t most)
        : segments_(segments), table_(plot_table(most)) {}

    bool add(const PlotSegment& segment) { return add_or_find(segment).second; }
    /// The end at which the segment is entered, and whether it is new.
    std::pair<PlotEnd, bool> add_or_find(const PlotSegment& segment) {
        const auto key = [](const PlotSegment& s) {
            return plot_hash(plot_hash(s.from, s.to), plot_hash(s.first, s.second));
        };
        const PlotSegment back = segment.backwards();
        std::size_t at = (key(segment) + key(back)) & (table_.size() - 1);
        for (; table_[at] != PlotSegment::none; at = (at + 1) & (table_.size() - 1)) {
            const PlotSegment& other = segments_[table_[at]];
            if (other == segment) return {2 * table_[at], false};
            if (other == back) return {2 * table_[at] + 1, false};
        }
        table_[at] = static_cast<std::uint32_t>(segments_.size());
        segments_.push_back(segment);
        return {2 * table_[at], true};
    }

private:
    std::vector<PlotSegment>& segments_;
    std::vector<std::uint32_t> table_;
};

}  // namespace sikku
