#include "art/drawing/drawing.h"

#include "art/drawing/ink_shape.h"
#include "art/print/clip.h"
#include "art/raster/raster.h"

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <utility>

namespace sikku {

DrawingReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                          const PlacementOptions& placement) {
    double ink_steps = 0;
    double ink_millimetres = 0;
    (stroke.in_steps ? ink_steps : ink_millimetres) = seen.widest / 2;
    print.placement = place(seen.box, print.page, placement, ink_steps, ink_millimetres);
    const double step = print.placement.step;
    DrawingReport report;
    report.step = step;
    report.size = (seen.box.high - seen.box.low) * step + 2.0 * (ink_steps * step + ink_millimetres);
    report.room = glm::dvec2(print.page.width, print.page.height) - 2 * print.page.margin;
    report.overflows = report.size.x > report.room.x + 1e-6 || report.size.y > report.room.y + 1e-6;
    return report;
}

Window whole_page(const Page& page) {
    return {0.0, 0.0, page.width, page.height, false, page.margin};
}

Box seen_box(const Print& print, const Window& window, double around) {
    const glm::dmat3x2& to_page = print.placement.to_page;
    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(to_page[0], to_page[1]));
    Box box;
    for (const double x : {window.left - around, window.left + window.width + around}) {
        for (const double y : {window.top - around, window.top + window.height + around}) {
            box.add(back * (glm::dvec2(x, y) - to_page[2]));
        }
    }
    return box;
}

void require_ink(const Box& box) {
    if (box.empty()) throw NothingDrawn();
}

const DrawnExtent& Drawing::extent() {
    const DrawnExtent& found = seen();
    require_ink(found.box);
    return found;
}

Balance Drawing::balance_of(const std::vector<glm::dvec2>& points, glm::dvec2 centre) const {
    const glm::dmat3x2 turned = orientation(options_.placement);
    std::vector<glm::dvec2> corners;
    Box box;
    for (const glm::dvec2 point : points) {
        corners.push_back(turned * glm::dvec3(point, 1));
        box.add(corners.back());
    }
    const glm::dvec2 size = box.high - box.low;
    if (box.empty() || !(size.x > 0 && size.y > 0)) return {};
    const glm::dvec2 mass = turned * glm::dvec3(centre, 1);
    return {polygon_area(convex_hull(std::move(corners))) / (size.x * size.y),
            (mass - (box.low + box.high) / 2.0) / size};
}

PlacementOptions Drawing::placement() const {
    PlacementOptions placement = options_.placement;
    // Generations share one frame, and with it one place.
    if (options_.composes) placement.balance = options_.frame ? Balance{} : balance();
    return placement;
}

DrawingReport Drawing::place(Print& print) {
    const DrawnExtent& placed = options_.frame ? *options_.frame : extent();
    // Read in any case, to find its properties.
    around_ = seen().around;
    PlacementOptions placement = this->placement();
    placement.scale = scale();
    const Page page = print.page;
    // Corners that a cut has widened are cut off at the width of the cut.
    print.page.margin += border_space(page) + options_.kerf;
    const TextSpace text = text_space(page);
    print.page.height -= text.total();
    DrawingReport report = place_print(print, placed, style().stroke, placement);
    print.page = page;
    print.placement.to_page[2].y += text.above;
    if (options_.stretch != glm::dvec2(1.0)) {
        const glm::dvec2 middle = glm::dvec2(page.width, page.height) / 2.0;
        glm::dmat3x2& to_page = print.placement.to_page;
        to_page = {options_.stretch * to_page[0], options_.stretch * to_page[1],
                   middle + options_.stretch * (to_page[2] - middle)};
    }
    return report;
}

void Drawing::read_visible(const Print& print, const Window& window, PathSink& sink) const {
    if (!options_.window) return read(print, window, sink);
    const double width = around_ * (print.style.stroke.in_steps ? print.placement.step : 1.0);
    ClipSink clip(sink, seen_box(print, window, width + print.press.bleed));
    read(print, window, clip);
}

std::unique_ptr<Rendering> Drawing::rendering(const Print& print, const Window& window) const {
    auto raster = make_raster(print);
    read(print, window, *raster);
    return raster;
}

std::unique_ptr<Rendering> Drawing::rendering(const Print& print) const {
    return rendering(print, whole_page(print.page));
}

}  // namespace sikku
