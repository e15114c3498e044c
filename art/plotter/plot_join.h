// art/plotter/plot_join.h: joins lines and curves that meet into strokes.
#pragma once

#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sikku {

/// A line, or a curve with two control points, as numbers of points.
struct PlotSegment {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t from = 0, to = 0;
    std::uint32_t first = none, second = none;
    bool is_curve() const { return first != none; }
    bool operator==(const PlotSegment&) const = default;
    PlotSegment backwards() const { return {to, from, second, first}; }
};

/// Each segment i has two ends: 2 i where it begins, and 2 i + 1. The other end of e is e ^ 1. A segment is entered
/// at one of them.
using PlotEnd = std::uint32_t;

using CubicBezier = std::array<glm::dvec2, 4>;
double bezier_length(const CubicBezier& bezier);

/// Distinct segments between points, which are identified by their numbers.
struct PlotGraph {
    std::vector<glm::dvec2> points;
    std::vector<PlotSegment> segments;

    glm::dvec2 point(PlotEnd end) const {
        return points[end % 2 == 0 ? segments[end / 2].from : segments[end / 2].to];
    }
    /// The curve, from the end at which it is entered.
    CubicBezier bezier(PlotEnd end) const;
    double length(PlotEnd end) const;
    /// Unit vector from the end's point along its segment; 0 for a segment without length.
    glm::dvec2 direction(PlotEnd end) const;
};

struct PlotStroke {
    std::uint32_t begin = 0, count = 0;  ///< range of its segments in PlotStrokes::order
    bool closed = false;
};
/// The ends at which the segments of each stroke are entered, one after another.
struct PlotStrokes {
    std::vector<PlotEnd> order;
    std::vector<PlotStroke> strokes;

    std::span<const PlotEnd> ends(const PlotStroke& stroke) const {
        return std::span(order).subspan(stroke.begin, stroke.count);
    }
};

/// Joins straight lines into as few strokes as possible, and curves into smooth ones, by the rules of PlotPlan. The
/// strokes are in the order in which their first segments were drawn. Cost: linear, except for points in which many
/// segments meet.
/// @throws Stopped
PlotStrokes join_segments(const PlotGraph& graph, const Monitor& monitor = {});

}  // namespace sikku
