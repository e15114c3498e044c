#include "art/drawing/line_work.h"

#include "art/kolam/segment_grid.h"
#include "art/plotter/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace sikku {
namespace {

/// The colours of fields: those of even and of odd classes where neighbours differ in parity, else all.
std::vector<std::size_t> colours_of_class(std::uint32_t number, FieldsBy by, std::size_t count) {
    const bool has_parity = by == FieldsBy::chessboard || by == FieldsBy::kind || by == FieldsBy::symmetry;
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < count; ++i) {
        if (!has_parity || count < 2 || i % 2 == number % 2) fitting.push_back(i);
    }
    return fitting;
}

/// Finds the ink near a field.
class ObstacleGrid {
public:
    /// @param more  added to the radius of each obstacle
    ObstacleGrid(const std::vector<Obstacle>& ink, double more, const Monitor& monitor) : ink_(ink), more_(more) {
        if (ink.empty()) return;
        Box box;
        double widest = 0;
        for (const Obstacle& one : ink) {
            box.add(one.from);
            box.add(one.to);
            widest = std::max(widest, one.radius);
        }
        const double cell = box.longest() / (1 + std::sqrt(static_cast<double>(ink.size())));
        grid_.emplace(box, cell, widest + more);
        for (std::uint32_t i = 0; i < ink.size(); ++i) grid_->add(i, ink[i].from, ink[i].to);
        grid_->sort(monitor);
    }

    std::vector<Obstacle> beside(std::span<const glm::dvec2> outline) const {
        std::vector<std::uint32_t> found;
        if (grid_) grid_->visit(outline, [&](std::uint32_t item) { found.push_back(item); });
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        std::vector<Obstacle> obstacles;
        for (const std::uint32_t i : found) obstacles.push_back({ink_[i].from, ink_[i].to, ink_[i].radius + more_});
        return obstacles;
    }

private:
    const std::vector<Obstacle>& ink_;
    double more_;
    std::optional<kolam_plane::SegmentGrid> grid_;
};

/// The edges of an outline, except those that lead to its holes and back.
std::vector<std::pair<glm::dvec2, glm::dvec2>> edges_without_ways(std::span<const glm::dvec2> outline) {
    using Edge = std::array<double, 4>;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
        edges.push_back({from.x, from.y, to.x, to.y});
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<glm::dvec2, glm::dvec2>> kept;
    for (const auto& [x0, y0, x1, y1] : edges) {
        if (std::binary_search(edges.begin(), edges.end(), Edge{x1, y1, x0, y0})) continue;
        kept.emplace_back(glm::dvec2(x0, y0), glm::dvec2(x1, y1));
    }
    return kept;
}

}  // namespace

bool has_line_work(const Style& style) {
    return style.fields || style.weave || style.parallel.count > 1;
}

LineWork::LineWork(const WordDrawing& drawing, const KolamExamination& examination, const Style& style,
                   const ReadingLimits& limits)
    : style_(style) {
    const double most = std::min(limits.budget / nodes_of_worked_segment, 1e9);
    CurveReader reader([&style](const Pen& pen) { return style.draws(pen); }, static_cast<std::size_t>(most));
    drawing.read({}, {}, reader);
    lines_ = reader.finish(examination);
    if (style.fields || style.weave) {
        meetings_ = find_meetings(lines_, static_cast<std::size_t>(most), limits.monitor);
    }
    if (style.fields) {
        fields_ = find_fields(lines_, meetings_, limits.monitor);
        classes_ = classify(fields_, *style.fields, examination.symmetry, examination.centre, limits.monitor);
    }
    if (style.weave || style.parallel.count > 1) {
        bands_ = std::make_unique<LineBands>(lines_, meetings_, style, limits.monitor);
    }
}

void LineWork::add_colours(std::vector<Colour>& palette, std::span<const Colour> others) {
    if (!style_.fields) return;
    const std::vector<Colour> powders = fill_powders(style_, others);
    const int first = static_cast<int>(palette.size());
    palette.insert(palette.end(), powders.begin(), powders.end());
    for (const std::uint32_t number : classes_) {
        const auto fitting = colours_of_class(number, *style_.fields, powders.size());
        const bool has_parity = fitting.size() < powders.size();
        const std::size_t chosen = fitting[(has_parity ? number / 2 : number) % fitting.size()];
        colours_.push_back(powders[chosen].alpha == 0 ? -1 : first + static_cast<int>(chosen));
    }
}

/// The fields that are filled, sorted by colour, like layers and pens.
std::vector<std::size_t> LineWork::fields_by_colour() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (colours_[i] >= 0) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return colours_[a] < colours_[b]; });
    return order;
}

void LineWork::draw_fields(PathSink& sink) const {
    std::vector<glm::dvec2> corners;
    for (const std::size_t i : fields_by_colour()) {
        const Field& field = fields_[i];
        const Pen pen{.colour = colours_[i]};
        if (!field.is_straight) {
            sink.area(field.outline, pen);
            continue;
        }
        corners.clear();
        for (std::size_t k = 0; k + 1 < field.outline.size(); k += 3) corners.push_back(field.outline[k]);
        if (corners.size() > 2) sink.polygon(corners, pen);
    }
}

void LineWork::hatch_fields(const Print& print, const PlotPen& plot, const Monitor& monitor,
                            const std::vector<Obstacle>& ink, PathSink& sink) const {
    const double step = print.placement.step;
    const Hatch& hatch = *plot.hatch;
    const double line = print.style.line_width({}, step);
    // If the pen width is not given, each stroke has a pen of its own width, which the spacing limits here.
    const double wanted = hatch.spacing > 0 ? hatch.spacing : plot.pen_width > 0 ? plot.pen_width : line;
    const double pen = plot.pen_width > 0 ? plot.pen_width : std::min(wanted, line);
    const StrokeWidth& unit = print.style.stroke;
    const double width = pen / (unit.in_steps ? step : 1.0) / unit.unit;
    const double around = ((bands_ ? bands_->look(print).band() : 0.0) + pen / step) / 2;
    constexpr double tolerance = 0.01;  // millimetres
    const ObstacleGrid near(ink, pen / step / 2, monitor);
    std::vector<glm::dvec2> outline;
    for (const std::size_t i : fields_by_colour()) {
        monitor.check();
        const std::vector<glm::dvec2>& curves = fields_[i].outline;
        outline.clear();
        for (std::size_t k = 0; k + 3 < curves.size(); k += 3) {
            outline.push_back(curves[k]);
            flatten(curves[k], curves[k + 1], curves[k + 2], curves[k + 3], tolerance / step,
                    [&](glm::dvec2 at) { outline.push_back(at); });
            outline.pop_back();
        }
        std::vector<Obstacle> obstacles = near.beside(outline);
        for (const auto& [from, to] : edges_without_ways(outline)) obstacles.push_back({from, to, around});
        for (const glm::dvec2 along : hatch_directions(hatch, print.placement)) {
            for (const auto& way :
                 clear_hatch_lines(outline, obstacles, along, wanted / step, tolerance / step, monitor)) {
                sink.begin_stroke(way.front(), Pen{width, true, colours_[i]});
                sink.lines(std::span(way).subspan(1));
                sink.end_stroke(false);
            }
        }
    }
}

void InkSink::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start;
    change_pen(pen);
}
void InkSink::change_pen(const Pen& pen) {
    const double step = print_.placement.step;
    radius_ = print_.style.draws(pen) ? std::max(print_.style.line_width(pen, step), pen_) / step / 2 : 0.0;
}
void InkSink::lines(std::span<const glm::dvec2> ends) {
    for (const glm::dvec2 end : ends) {
        if (radius_ > 0) ink.push_back({at_, end, radius_});
        at_ = end;
    }
}
void InkSink::curves(std::span<const glm::dvec2> controls) {
    constexpr double tolerance = 0.01;  // millimetres
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        flatten(at_, controls[i], controls[i + 1], controls[i + 2], tolerance / print_.placement.step,
                [&](glm::dvec2 end) {
                    lines({&end, 1});
                });
    }
}
void InkSink::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    const double step = print_.placement.step;
    if (print_.style.fill_colour(pen).alpha == 0) return;
    const double wide = print_.style.disc_radius(radius, pen, step);
    ink.push_back({centre, centre, spiral_reach(wide, pen_ > 0 ? pen_ : print_.style.line_width(pen, step)) / step});
}

double LineWork::parallel_width() const {
    const int between = style_.parallel.count - 1;
    if (between == 0) return 0;
    Print unplaced;
    unplaced.style = style_;
    unplaced.placement.step = 1;
    const BandLook look = bands_->look(unplaced);
    // The width that fits is known only in steps.
    return between * (style_.stroke.in_steps ? look.spacing : look.wanted);
}

void LineWork::draw_lines(const Print& print, std::span<const int> colours, PathSink& sink) const {
    const auto colour = [&](std::size_t line) {
        return colours.empty() ? -1 : colours[lines_.lines[line].orbit % colours.size()];
    };
    bands_->draw(print, colour, sink);
}

}  // namespace sikku
