#include "art/drawing/hand_flour.h"

#include "art/hand/crumbs.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr double grain_share = 0.055;        // share of a line's width
constexpr double least_powder_pixels = 3;    // narrower lines show no grain
constexpr double least_crumb_pixels = 0.45;  // radius
constexpr double crossing_height = 1.5, dot_height = 1.25, crumb_height = 0.8;
constexpr double flour_flatness = 0.15;  // pixels
/// Widths of lines that are drawn with pens differ by this share before the pen is changed.
constexpr double width_step = 0.03;

double mean_width(const std::vector<HandLine>& lines) {
    double sum = 0, length = 0;
    for (const HandLine& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            sum += 2 * line.nodes[i].half * line.step(i);
            length += line.step(i);
        }
    }
    return length > 0 ? sum / length : 1;
}

/// Lays the strokes of one drawing.
class FlourLayer {
public:
    FlourLayer(const HandStrokes& strokes, const HandOptions& options, const Print& print, Raster& raster)
        : strokes_(strokes),
          options_(options),
          print_(print),
          raster_(raster),
          pixels_(print.placement.step * print.dpi / 25.4),
          width_(mean_width(strokes.lines)) {
        raster.set_grain(grain_share * width_);
    }

    void lay() {
        const bool is_flour = width_ * pixels_ >= least_powder_pixels;
        for (const HandLine& line : strokes_.lines) {
            options_.monitor.check();
            const HandLine stroke = drawn_stroke(line, options_);
            if (is_flour) {
                strew(stroke);
            } else {
                draw_with_pens(stroke);
            }
        }
        if (is_flour) lay_crossings();
        for (std::size_t i = 0; i < strokes_.dots.size(); ++i) lay_dot(strokes_.dots[i], i);
    }

private:
    void strew(const HandLine& stroke) {
        points_.clear();
        for (const HandNode& node : flattened(stroke, flour_flatness / pixels_)) {
            points_.push_back({node.at, node.half, node.flow});
        }
        raster_.powder(points_, stroke.pen, false);
        drop(crumbs_beside(stroke, least_crumb_pixels / pixels_, options_), stroke.pen, false);
    }

    void drop(const std::vector<HandCrumb>& crumbs, const Pen& pen, bool fills) {
        for (const HandCrumb& crumb : crumbs) heap({crumb.at, crumb.radius, crumb_height}, pen, fills);
    }

    /// Flour lies on flour where lines cross.
    void lay_crossings() {
        for (const HandCrossing& crossing : hand_crossings(strokes_.lines)) {
            const HandLine &line = strokes_.lines[crossing.line], &other = strokes_.lines[crossing.other];
            const double flow = std::min(line.nodes[crossing.node].flow, other.nodes[crossing.other_node].flow);
            heap({crossing.at, crossing.half, crossing_height * flow}, line.pen, false);
        }
    }

    void lay_dot(const HandDot& dot, std::size_t number) {
        if (2 * dot.radius * pixels_ < least_powder_pixels) return raster_.disc(dot.at, dot.radius, dot.pen);
        for (const HandDot& part : heaps_of(dot, number, options_)) {
            heap({part.at, part.radius, dot_height}, dot.pen, true);
        }
        drop(crumbs_around(dot, number, least_crumb_pixels / pixels_, options_), dot.pen, true);
    }

    void heap(const PowderPoint& point, const Pen& pen, bool fills) {
        raster_.powder(std::span(&point, 1), pen, fills);
    }

    void draw_with_pens(const HandLine& stroke) {
        const StrokeWidth& pen_unit = print_.style.stroke;
        const double unit = pen_unit.unit * (pen_unit.in_steps ? 1.0 : 1 / print_.placement.step);
        const std::vector<HandNode> points = flattened(stroke, flour_flatness / pixels_);
        const auto pen_of = [&](double half) { return Pen{2 * half / unit, true, stroke.pen.colour}; };
        double half = points.front().half;
        raster_.begin_stroke(points.front().at, pen_of(half));
        for (std::size_t i = 1; i < points.size(); ++i) {
            if (std::fabs(points[i].half - half) > width_step * half) {
                half = points[i].half;
                raster_.change_pen(pen_of(half));
            }
            raster_.lines(std::span(&points[i].at, 1));
        }
        raster_.end_stroke(false);
    }

    const HandStrokes& strokes_;
    const HandOptions& options_;
    const Print& print_;
    Raster& raster_;
    double pixels_;  ///< of a turtle step
    double width_;   ///< mean width of the lines, in steps
    std::vector<PowderPoint> points_;
};

}  // namespace

void lay_flour(const HandStrokes& strokes, const HandOptions& options, const Print& print, Raster& raster) {
    FlourLayer(strokes, options, print, raster).lay();
}

}  // namespace sikku
