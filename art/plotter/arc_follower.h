// art/plotter/arc_follower.h: approximates curves by few arcs and lines, with a greedy search.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace sikku {

/// An arc from one point to another around a centre, anticlockwise if `is_left`.
struct PlotArc {
    glm::dvec2 centre{0.0};
    bool is_left = false;
};

/// Converts dense points of curves to lines and arcs that stay within 0.0075 mm of the curve, with radii up to
/// 1 m and less than 270 degrees each. Lengths are millimetres.
class ArcFollower {
public:
    using LineTo = std::function<void(glm::dvec2 end)>;
    using ArcTo = std::function<void(const PlotArc& arc, glm::dvec2 end)>;
    /// @param arcs  false: lines only @param least  shorter arcs become lines
    ArcFollower(bool arcs, double least, LineTo line_to, ArcTo arc_to)
        : arcs_(arcs), least_(least), line_to_(std::move(line_to)), arc_to_(std::move(arc_to)) {}

    /// Begins at a point.
    void begin(glm::dvec2 at) { points_ = {at}; }
    /// Adds the next point of a curve; chords between points deviate from it by at most `chord`.
    void add(glm::dvec2 point) {
        points_.push_back(point);
        if (points_.size() >= most_points) follow(false);
    }
    /// Passes on all pending points. A line or a curve may follow.
    void finish() { follow(true); }

    /// Maximum deviation from a curve of the chords between the points passed to add().
    static constexpr double chord = 0.0005;

private:
    static constexpr std::size_t most_points = 8192;  // pending
    void follow(bool is_all);
    bool is_short(std::span<const glm::dvec2> points) const;

    bool arcs_;
    double least_;
    LineTo line_to_;
    ArcTo arc_to_;
    std::vector<glm::dvec2> points_;  ///< from the end of the last line or arc passed on
};

}  // namespace sikku
