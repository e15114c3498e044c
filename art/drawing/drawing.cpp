#include "art/drawing/drawing.h"

#include "art/drawing/cell_drawing.h"
#include "art/drawing/composition.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/hand_drawing.h"
#include "art/drawing/ink_shape.h"
#include "art/drawing/lesson_drawing.h"
#include "art/drawing/map_drawing.h"
#include "art/drawing/repeated_drawing.h"
#include "art/drawing/seen_drawing.h"
#include "art/drawing/tile_drawing.h"
#include "art/drawing/window_drawing.h"
#include "art/drawing/word_drawing.h"
#include "art/print/clip.h"

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sikku {

DrawReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                       const PlacementOptions& placement) {
    double ink_steps = 0;
    double ink_millimetres = 0;
    (stroke.in_steps ? ink_steps : ink_millimetres) = seen.widest / 2;
    print.placement = place(seen.box, print.page, placement, ink_steps, ink_millimetres);
    const double step = print.placement.step;
    DrawReport report;
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

DrawReport Drawing::place(Print& print) {
    const DrawnExtent& placed = options_.frame ? *options_.frame : extent();
    // Read in any case, to find its properties.
    around_ = seen().around;
    PlacementOptions placement = this->placement();
    placement.scale = scale();
    const Page page = print.page;
    // Corners that a cut has widened are cut off at the width of the cut.
    print.page.margin += border_space(page) + options_.kerf;
    print.page.height -= foot_space(page);
    DrawReport report = place_print(print, placed, style().stroke, placement);
    print.page = page;
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

namespace {

std::unique_ptr<Drawing> make_map_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options) {
    if (has_ornaments(style, options) || options.only_dots) {
        throw std::runtime_error("dots, fields, weaves, parallel lines and colours by strand do not apply to maps");
    }
    auto frames = options.map_frames;
    if (!frames) frames = std::make_shared<MapFrames>(grammar, options.budget, options.monitor, KeptFrames::last);
    auto frame = frames->after(grammar.steps());
    if (options.map_share < 1) frame = std::make_shared<const MapFrame>(frame->at(options.map_share));
    return std::make_unique<MapDrawing>(std::move(frame), style, options, grammar.scale_percent());
}

/// Repeats, tiles, frames and hand-drawn lines around a drawing in the plane.
std::unique_ptr<Drawing> surrounded(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const Style& style,
                                    const DrawOptions& options) {
    if (options.repeat) drawing = std::make_unique<RepeatedDrawing>(std::move(drawing), options);
    if (has_tile_work(style)) drawing = std::make_unique<TileDrawing>(std::move(drawing), seed, options);
    if (options.cell) drawing = std::make_unique<CellDrawing>(std::move(drawing), *options.cell, options);
    if (has_frame(style, options)) drawing = std::make_unique<FramedDrawing>(std::move(drawing), options);
    if (!(style.hand > 0) && !options.lesson_step) return drawing;
    auto by_hand = std::make_unique<HandDrawing>(std::move(drawing), seed, options);
    if (!options.lesson_step) return by_hand;
    return std::make_unique<LessonDrawing>(std::move(by_hand), options);
}

/// The grammar, with a mark after each part that `tile colours: by generation` colours.
Grammar with_generations(const Grammar& grammar, const Style& style) {
    if (style.tile_colours != TileColours::generation) return grammar;
    auto marked = grammar.with_marks(style.tile_generation);
    if (!marked) {
        throw std::runtime_error(
            "'tile colours: by generation' needs productions without contexts, parameters and random choices");
    }
    return *std::move(marked);
}

}  // namespace

std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options) {
    if (grammar.map()) {
        return surrounded(make_map_drawing(grammar, style, options), grammar.seed(), style, options);
    }
    auto shared = std::make_shared<const Grammar>(resolved(with_generations(grammar, style), options));
    std::string why;
    if (auto parts = seen_parts(*shared, style, options, why)) {
        return std::make_unique<SeenDrawing>(std::move(shared), std::move(*parts), style, options);
    }
    if (auto window = WindowDrawing::make(shared, style, options, why)) {
        return surrounded(std::move(window), shared->seed(), style, options);
    }
    if (options.window) require_window(*shared, options, why);
    std::unique_ptr<Drawing> drawing;
    make_one_copy(options, [&](const DrawOptions& one) {
        auto lines = std::make_unique<WordDrawing>(*shared, style, one);
        if (has_ornaments(style, options)) {
            drawing = std::make_unique<Composition>(*shared, std::move(lines), one);
        } else {
            drawing = std::move(lines);
        }
    });
    if (shared->is_spatial() && (options.repeat || has_frame(style, options))) {
        throw std::runtime_error("repeats, borders and lines of text apply only to drawings in the plane");
    }
    if (shared->is_spatial() && has_tile_work(style)) {
        throw std::runtime_error("'tile colours', 'tile edges' and 'decorate' apply only to drawings in the plane");
    }
    if (shared->is_spatial() && (style.hand > 0 || options.lesson_step)) {
        throw std::runtime_error("hand-drawn lines and lessons apply only to drawings in the plane");
    }
    return surrounded(std::move(drawing), shared->seed(), style, options);
}

}  // namespace sikku
