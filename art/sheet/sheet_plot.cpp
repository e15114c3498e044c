#include "art/sheet/sheet_plot.h"

#include "art/print/clip.h"
#include "engine/geometry/moved_path.h"

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

/// Converts the pens of a drawing into those of the sheet, which are in millimetres.
class SheetPens : public PathFilter {
public:
    SheetPens(PathSink& sink, const Print& print, const std::vector<int>& lines, const std::vector<int>& fills)
        : Forwarding(sink), style_(print.style), step_(print.placement.step), lines_(lines), fills_(fills) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, line(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(line(pen)); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha > 0) sink_.polygon(vertices, fill(pen));
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha > 0) sink_.area(outline, fill(pen));
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha > 0)
            sink_.disc(centre, style_.disc_radius(radius, pen, step_) / step_, fill(pen));
    }

private:
    std::size_t index(const Pen& pen) const { return static_cast<std::size_t>(style_.index(pen)); }
    Pen line(const Pen& pen) const {
        return {style_.draws(pen) ? style_.line_width(pen, step_) : 0.0, true, lines_[index(pen)]};
    }
    Pen fill(const Pen& pen) const { return {style_.line_width(pen, step_), true, fills_[index(pen)]}; }

    const Style& style_;
    double step_;
    const std::vector<int>& lines_;
    const std::vector<int>& fills_;
};

}  // namespace

SheetDrawing::SheetDrawing(std::vector<PlacedDrawing> drawings, const Print& sheet,
                           std::function<void(PathSink&)> texts, const DrawingOptions& options,
                           const Reading& reading)
    : Drawing(options, reading), drawings_(std::move(drawings)), texts_(std::move(texts)), style_(sheet.style) {
    const auto index_of = [&](Colour colour) {
        const auto found = std::find(style_.palette.begin(), style_.palette.end(), colour);
        if (found == style_.palette.end()) {
            style_.palette.push_back(colour);
            return static_cast<int>(style_.palette.size()) - 1;
        }
        return static_cast<int>(found - style_.palette.begin());
    };
    for (const PlacedDrawing& each : drawings_) {
        lines_.emplace_back();
        fills_.emplace_back();
        const Style& style = each.print->style;
        for (int i = 0; i < static_cast<int>(std::max<std::size_t>(style.palette.size(), 1)); ++i) {
            lines_.back().push_back(index_of(style.line_colour(Pen{.colour = i})));
            fills_.back().push_back(index_of(style.fill_colour(Pen{.colour = i})));
        }
    }
    extent_.box.add({0.0, 0.0});
    extent_.box.add({sheet.page.width, -sheet.page.height});
}

std::vector<int> SheetDrawing::hatched_colours() const {
    std::vector<int> colours;
    for (std::size_t i = 0; i < drawings_.size(); ++i) {
        for (const int colour : drawings_[i].drawing->hatched_colours()) {
            if (colour >= 0) colours.push_back(lines_[i][static_cast<std::size_t>(colour)]);
        }
    }
    return colours;
}

void SheetDrawing::read(const Print&, const Window&, PathSink& sink) const {
    texts_(sink);
    for (std::size_t i = 0; i < drawings_.size(); ++i) {
        const PlacedDrawing& each = drawings_[i];
        glm::dmat3x2 map = each.print->placement.to_page;
        for (int column = 0; column < 3; ++column) map[column].y = -map[column].y;
        MovedPath moved(sink, map);
        SheetPens pens(moved, *each.print, lines_[i], fills_[i]);
        if (each.window.clips) {
            ClipSink clip(pens, seen_box(*each.print, each.window, 0.0));
            each.drawing->read(*each.print, each.window, clip);
        } else {
            each.drawing->read(*each.print, each.window, pens);
        }
    }
}

}  // namespace sikku
