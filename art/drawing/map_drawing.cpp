#include "art/drawing/map_drawing.h"

#include "art/drawing/extent_sink.h"
#include "art/drawing/ink_shape.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace sikku {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The two edges of each vertex where only two edges meet that may share a stroke.
class Joints {
public:
    explicit Joints(const Map& map) : edges_(map.vertices(), {none, none}), degrees_(map.vertices(), 0) {
        for (std::uint32_t i = 0; i < map.edges().size(); ++i) {
            for (const std::uint32_t vertex : {map.edges()[i].tail, map.edges()[i].head}) {
                if (degrees_[vertex] < 2) edges_[vertex][degrees_[vertex]] = i;
                degrees_[vertex] = std::min(degrees_[vertex] + 1, 3);
            }
        }
    }
    /// The other edge at a vertex of two edges, or `none`.
    std::uint32_t beyond(std::uint32_t vertex, std::uint32_t edge) const {
        if (degrees_[vertex] != 2) return none;
        return edges_[vertex][0] == edge ? edges_[vertex][1] : edges_[vertex][0];
    }

private:
    std::vector<std::array<std::uint32_t, 2>> edges_;
    std::vector<int> degrees_;
};

std::vector<glm::dvec2> inset(std::vector<glm::dvec2> corners, double share) {
    glm::dvec2 middle(0);
    for (const glm::dvec2 corner : corners) middle += corner / static_cast<double>(corners.size());
    for (glm::dvec2& corner : corners) corner = middle + (1 - share) * (corner - middle);
    return corners;
}

/// Draws a wall from both of its ends. @param share  share of its length
void draw_growing(glm::dvec2 from, glm::dvec2 to, double share, const Pen& pen, PathSink& sink) {
    if (!(share > 0)) return;
    for (const auto& [start, end] : {std::pair(from, to), std::pair(to, from)}) {
        const glm::dvec2 tip = glm::mix(start, end, share / 2);
        sink.begin_stroke(start, pen);
        sink.lines(std::span(&tip, 1));
        sink.end_stroke(false);
    }
}

}  // namespace

std::vector<glm::dvec2> closed_beta_spline(const std::vector<glm::dvec2>& corners, double tension) {
    const std::size_t count = corners.size();
    const double whole = 12 + tension;
    const auto at = [&](std::size_t i) { return corners[i % count]; };
    const auto knot = [&](std::size_t i) {
        return (2.0 * at(i + count - 1) + (8 + tension) * at(i) + 2.0 * at(i + 1)) / whole;
    };
    const auto tangent = [&](std::size_t i) { return 2.0 * (at(i + 1) - at(i + count - 1)) / whole; };
    std::vector<glm::dvec2> controls{knot(0)};
    controls.reserve(3 * count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        controls.push_back(knot(i) + tangent(i));
        controls.push_back(knot(i + 1) - tangent(i + 1));
        controls.push_back(i + 1 == count ? controls.front() : knot(i + 1));
    }
    return controls;
}

MapDrawing::MapDrawing(std::shared_ptr<const MapFrame> map, const Style& style, const DrawingOptions& options,
                       const Reading& reading, double scale_percent)
    : Drawing(options, reading), map_(std::move(map)), style_(style), scale_percent_(scale_percent) {
    add_colours();
    if (style_.stroked && style_.map.draws_walls()) chain_walls();
}

void MapDrawing::add_colours() {
    first_class_ = static_cast<int>(style_.palette.size());
    for (const Colour colour : style_.map.classes) style_.palette.push_back(colour);
    tissue_ = static_cast<int>(style_.palette.size());
    if (style_.map.tissue) style_.palette.push_back(*style_.map.tissue);
}

std::uint32_t MapDrawing::wall_age(std::size_t edge) const {
    return style_.map.widths_by_age ? static_cast<std::uint32_t>(map_->steps) - map_->map.edges()[edge].born + 1 : 1;
}

void MapDrawing::chain_walls() {
    const Map& map = map_->map;
    const Joints joints(map);
    std::vector<char> is_drawn(map.edges().size(), 0);
    const auto is_growing = [&](std::size_t edge) {
        return map_->grown < 1 && map_->steps > 0 && map.edges()[edge].born == map_->steps;
    };
    // Adds edges of the same width from the stroke's last vertex on.
    const auto extend = [&](WallStroke& stroke, std::uint32_t edge) {
        while (true) {
            const std::uint32_t at = stroke.vertices.back();
            edge = joints.beyond(at, edge);
            if (edge == none || is_drawn[edge] || is_growing(edge) || wall_age(edge) != stroke.age) return;
            is_drawn[edge] = 1;
            const MapEdge& next = map.edges()[edge];
            stroke.vertices.push_back(next.tail == at ? next.head : next.tail);
        }
    };
    for (std::uint32_t i = 0; i < is_drawn.size(); ++i) {
        if (is_drawn[i]) continue;
        is_drawn[i] = 1;
        WallStroke stroke{{map.edges()[i].head, map.edges()[i].tail}, wall_age(i)};
        if (is_growing(i)) {
            stroke.is_growing = true;
            walls_.push_back(std::move(stroke));
            continue;
        }
        extend(stroke, i);
        std::reverse(stroke.vertices.begin(), stroke.vertices.end());
        extend(stroke, i);
        stroke.is_closed = stroke.vertices.front() == stroke.vertices.back();
        walls_.push_back(std::move(stroke));
    }
    std::stable_sort(walls_.begin(), walls_.end(),
                     [](const WallStroke& a, const WallStroke& b) { return a.age < b.age; });
}

std::vector<glm::dvec2> MapDrawing::corners(std::span<const HalfEdge> wall) const {
    std::vector<glm::dvec2> found;
    found.reserve(wall.size());
    for (const HalfEdge half : wall) found.push_back(map_->places[map_->map.start(half)]);
    return found;
}

const DrawnExtent& MapDrawing::seen() {
    if (extent_) return *extent_;
    if (reading_.begin) reading_.begin(2);
    ExtentSink sink(style_, orientation(options_.placement));
    read({}, {}, sink);
    return extent_.emplace(placed_extent({sink.box, sink.widest}, options_, is_outside_));
}

Balance MapDrawing::balance() const {
    if (options_.window) return {};
    InkShape shape(style_);
    read({}, {}, shape);
    return balance_of(shape.hull(), shape.centre());
}

void MapDrawing::read(const Print&, const Window&, PathSink& sink) const {
    if (style_.map.tissue) {
        sink.area(closed_beta_spline(corners(map_->map.outer()), style_.map.tension), Pen{.colour = tissue_});
    }
    read_cells(sink);
    read_walls(sink);
}

Pen MapDrawing::cell_pen(std::size_t cell) const {
    const int classes = static_cast<int>(style_.map.classes.size());
    if (style_.map.fill == CellFill::colour) return {};
    const std::int64_t number = style_.map.fill == CellFill::age
                                    ? map_->steps - static_cast<std::int64_t>(map_->cell_born[cell])
                                    : static_cast<std::int64_t>(map_->map.cell(cell).size()) - 3;
    return Pen{.colour = first_class_ + static_cast<int>(std::clamp<std::int64_t>(number, 0, classes - 1))};
}

void MapDrawing::read_cells(PathSink& sink) const {
    const MapStyle& style = style_.map;
    const bool is_filled = style.fill != CellFill::none;
    if (!is_filled && !style.draws_splines()) return;
    for (std::size_t i = 0; i < map_->map.cells(); ++i) {
        if (reading_.watch && i % 1024 == 0) reading_.watch(1024);
        const std::vector<glm::dvec2> wall = corners(map_->map.cell(i));
        if (!style.draws_splines()) {
            if (wall.size() > 2) sink.polygon(wall, cell_pen(i));
            continue;
        }
        const std::vector<glm::dvec2> spline = closed_beta_spline(inset(wall, style.inset), style.tension);
        if (is_filled && wall.size() > 2) sink.area(spline, cell_pen(i));
        if (!style_.draws({})) continue;
        sink.begin_stroke(spline.front(), {});
        sink.curves(std::span(spline).subspan(1));
        sink.end_stroke(true);
    }
}

void MapDrawing::read_walls(PathSink& sink) const {
    std::vector<glm::dvec2> ends;
    for (const WallStroke& wall : walls_) {
        const Pen pen{.width = static_cast<double>(wall.age)};
        ends.clear();
        for (const std::uint32_t vertex : wall.vertices) ends.push_back(map_->places[vertex]);
        if (wall.is_growing) {
            draw_growing(ends.front(), ends.back(), map_->grown, pen, sink);
            continue;
        }
        sink.begin_stroke(ends.front(), pen);
        sink.lines(std::span(ends).subspan(1));
        sink.end_stroke(wall.is_closed);
    }
}

void MapDrawing::report(DrawingReport& report) const {
    report.is_empty = is_outside_;
    report.cells = map_->map.cells();
    report.crosses_itself = map_->outline_crosses;
}

}  // namespace sikku
