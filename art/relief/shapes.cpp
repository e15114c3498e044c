#include "art/relief/shapes.h"

#include "art/kolam/segment_grid.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/simple_polygon.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

constexpr double same_place = 0.003;   // millimetres
constexpr double same_corner = 0.002;  // millimetres

/// Finds edges of polygons along segments.
class EdgeFinder {
public:
    EdgeFinder(std::vector<std::pair<glm::dvec2, glm::dvec2>> edges, const Monitor& monitor)
        : edges_(std::move(edges)), grid_(grid_for(edges_)) {
        for (std::uint32_t i = 0; i < edges_.size(); ++i) grid_.add(i, edges_[i].first, edges_[i].second);
        grid_.sort(monitor);
    }

    /// True if an edge runs along this segment, at its middle.
    bool is_along(glm::dvec2 from, glm::dvec2 to) const {
        const glm::dvec2 middle = (from + to) / 2.0;
        bool is_found = false;
        grid_.visit(std::span(&middle, 1), [&](std::uint32_t item) {
            const auto& [a, b] = edges_[item];
            const double length = glm::distance(a, b);
            const double along = glm::dot(middle - a, b - a) / length;
            is_found = is_found || (along > -same_place && along < length + same_place &&
                                    std::fabs(side_of(a, b, from)) < same_place * length &&
                                    std::fabs(side_of(a, b, to)) < same_place * length);
        });
        return is_found;
    }

private:
    static kolam_plane::SegmentGrid grid_for(const std::vector<std::pair<glm::dvec2, glm::dvec2>>& edges) {
        Box box;
        double length = 0;
        for (const auto& [a, b] : edges) {
            box.add(a);
            box.add(b);
            length += glm::distance(a, b);
        }
        return {box, length / static_cast<double>(edges.size()), same_place};
    }

    std::vector<std::pair<glm::dvec2, glm::dvec2>> edges_;
    kolam_plane::SegmentGrid grid_;
};

}  // namespace

ReliefShapes::ReliefShapes(const Print& print, std::size_t most)
    : print_(print),
      most_(most),
      line_slots_(print.style.line_slots()),
      fill_slots_(print.style.fill_slots()),
      corners_(same_corner) {}

Colour ReliefShapes::colour(const ReliefShape& shape) const {
    const Pen pen{.colour = shape.colour};
    return shape.kind == ReliefShape::Kind::line ? print_.style.line_colour(pen) : print_.style.fill_colour(pen);
}

glm::dvec2 ReliefShapes::place(glm::dvec2 point) const {
    const glm::dvec2 placed = print_.placement.to_page * glm::dvec3(point, 1);
    return {placed.x, print_.page.height - placed.y};
}

void ReliefShapes::require_room() const {
    if (points_.size() + line_.size() >= most_) {
        throw BudgetError(
            fmt::format("the drawing has more than {} points, too many for a relief; choose a shorter "
                        "derivation or a window",
                        most_));
    }
}

void ReliefShapes::add(glm::dvec2 point) {
    require_room();
    points_.push_back(point);
}

void ReliefShapes::add_to_line(glm::dvec2 point) {
    require_room();
    line_.push_back(point);
}

void ReliefShapes::end_shape(ReliefShape shape) {
    shape.end = points_.size();
    shapes_.push_back(shape);
}

void ReliefShapes::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start;
    is_whole_ = true;
    line_.clear();
    take(pen);
}

void ReliefShapes::take(const Pen& pen) {
    pen_ = pen;
    is_visible_ = print_.style.draws(pen) && print_.style.line_width(pen, print_.placement.step) > 0;
}

void ReliefShapes::start_line() {
    if (line_.empty()) add_to_line(place(at_));
}

void ReliefShapes::lines(std::span<const glm::dvec2> ends) {
    if (is_visible_ && !ends.empty()) start_line();
    for (const glm::dvec2 end : ends) {
        if (is_visible_) add_to_line(place(end));
        at_ = end;
    }
}

void ReliefShapes::curves(std::span<const glm::dvec2> controls) {
    if (is_visible_ && !controls.empty()) start_line();
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        if (is_visible_) {
            flatten(place(at_), place(controls[i]), place(controls[i + 1]), place(controls[i + 2]), relief_tolerance,
                    [&](glm::dvec2 end) { add_to_line(end); });
        }
        at_ = controls[i + 2];
    }
}

void ReliefShapes::end_line(bool closed) {
    if (line_.empty()) return;
    const std::size_t begin = points_.size();
    points_.insert(points_.end(), line_.begin(), line_.end());
    line_.clear();
    const double width = print_.style.line_width(pen_, print_.placement.step);
    const int slot = line_slots_[static_cast<std::size_t>(print_.style.index(pen_))];
    end_shape({ReliefShape::Kind::line, closed, slot, width / 2, begin, 0});
}

void ReliefShapes::change_pen(const Pen& pen) {
    if (pen == pen_) return;
    end_line(false);
    is_whole_ = false;
    take(pen);
}

void ReliefShapes::end_stroke(bool closed) {
    end_line(closed && is_whole_);
}

void ReliefShapes::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (print_.style.fill_colour(pen).alpha == 0 || vertices.size() < 3) return;
    const std::size_t begin = points_.size();
    for (const glm::dvec2 vertex : vertices) add(corners_.points[corners_.at(place(vertex))]);
    const int slot = fill_slots_[static_cast<std::size_t>(print_.style.index(pen))];
    end_shape({ReliefShape::Kind::polygon, true, slot, 0, begin, 0});
}

void ReliefShapes::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (print_.style.fill_colour(pen).alpha == 0 || outline.size() < 4) return;
    const std::size_t begin = points_.size();
    add(place(outline[0]));
    for (std::size_t i = 0; i + 3 < outline.size(); i += 3) {
        flatten(place(outline[i]), place(outline[i + 1]), place(outline[i + 2]), place(outline[i + 3]),
                relief_tolerance, [&](glm::dvec2 end) { add(end); });
    }
    const int slot = fill_slots_[static_cast<std::size_t>(print_.style.index(pen))];
    end_shape({ReliefShape::Kind::area, true, slot, 0, begin, 0});
}

void ReliefShapes::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    if (print_.style.fill_colour(pen).alpha == 0) return;
    const double size = print_.style.disc_radius(radius, pen, print_.placement.step);
    if (!(size > 0)) return;
    const std::size_t begin = points_.size();
    add(place(centre));
    const int slot = fill_slots_[static_cast<std::size_t>(print_.style.index(pen))];
    end_shape({ReliefShape::Kind::disc, true, slot, size, begin, 0});
}

void ReliefShapes::drop_edges(const Monitor& monitor) {
    using Kind = ReliefShape::Kind;
    std::vector<std::pair<glm::dvec2, glm::dvec2>> edges;
    for (const ReliefShape& shape : shapes_) {
        if (shape.kind != Kind::polygon) continue;
        const auto corners = points(shape);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 next = corners[(i + 1) % corners.size()];
            if (glm::distance(corners[i], next) > same_place) edges.emplace_back(corners[i], next);
        }
    }
    if (edges.empty()) return;
    const EdgeFinder finder(std::move(edges), monitor);
    Pulse pulse(monitor);
    std::vector<ReliefShape> kept;
    for (const ReliefShape& shape : shapes_) {
        if (shape.kind != Kind::line) {
            kept.push_back(shape);
            continue;
        }
        std::size_t begin = shape.begin;
        bool is_whole = true;
        const auto end_run = [&](std::size_t end) {
            if (end <= begin + 1 && shape.end > shape.begin + 1) return;
            ReliefShape run = shape;
            run.begin = begin;
            run.end = end;
            run.is_closed = shape.is_closed && is_whole;
            kept.push_back(run);
        };
        for (std::size_t i = shape.begin; i + 1 < shape.end; ++i) {
            pulse();
            if (!finder.is_along(points_[i], points_[i + 1])) continue;
            is_whole = false;
            end_run(i + 1);
            begin = i + 1;
        }
        end_run(shape.end);
    }
    shapes_ = std::move(kept);
}

}  // namespace sikku
