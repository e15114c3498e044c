#include "art/writer/make_drawing.h"

#include "art/deep/seen_drawing.h"
#include "art/deep/window_drawing.h"
#include "art/drawing/colouring_drawing.h"
#include "art/drawing/composition.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/hand_drawing.h"
#include "art/drawing/lesson_drawing.h"
#include "art/drawing/map_drawing.h"
#include "art/drawing/map_frames.h"
#include "art/drawing/repeated_drawing.h"
#include "art/drawing/word_drawing.h"
#include "art/print/crop.h"
#include "art/print/ornaments.h"
#include "art/tiles/tile_drawing.h"

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

std::shared_ptr<const BorderMotif> motif_of(const BorderPattern& pattern, const ReadingLimits& given) {
    if (pattern.grammar->is_spatial()) {
        throw std::runtime_error(
            "the pattern of a border has to lie in the plane; this one pitches, rolls, bends or has surfaces");
    }
    constexpr double motif_budget = 1e5;
    Reading reading;
    reading.budget = std::min(given.budget, motif_budget);
    reading.watch = given.watch;
    reading.monitor = given.monitor;
    auto motif = std::make_shared<BorderMotif>();
    Style style = pattern.style;
    style.border.reset();
    const auto drawing = make_drawing(*pattern.grammar, style, {}, reading);
    motif->box = drawing->extent().box;
    const glm::dvec2 size = motif->box.high - motif->box.low;
    if (!(size.x > 0 && size.y > 0)) {
        throw std::runtime_error("the pattern of a border needs a width and a height; this one is a straight line");
    }
    motif->style = drawing->style();
    Print print;
    print.style = motif->style;
    drawing->read(print, motif->path);
    return motif;
}

Border border_of(const BorderStyle& style, const DrawingOptions& options, const Reading& reading) {
    Border border{.kind = style.kind};
    if (style.kind != BorderKind::pattern) return border;
    if (!options.border_repeat) throw std::runtime_error("the pattern of the border is missing");
    border.repeat = motif_of(*options.border_repeat, reading);
    if (options.border_corner) border.corner = motif_of(*options.border_corner, reading);
    return border;
}

std::unique_ptr<Drawing> make_map_drawing(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                                          const Reading& reading) {
    if (has_ornaments(style, options) || options.only_dots) {
        throw std::runtime_error("dots, fields, weaves, parallel lines and colours by strand do not apply to maps");
    }
    auto frames = options.map_frames;
    if (!frames) frames = std::make_shared<MapFrames>(grammar, reading.budget, reading.monitor, KeptFrames::last);
    auto frame = frames->after(grammar.steps());
    if (options.map_share < 1) frame = std::make_shared<const MapFrame>(frame->at(options.map_share));
    return std::make_unique<MapDrawing>(std::move(frame), style, options, reading, grammar.scale_percent());
}

/// Draws the part of a drawing within a parallelogram. The ground fills it as a polygon, whose colour is the
/// last of the palette.
class CellDrawing : public DerivedDrawing {
public:
    CellDrawing(std::unique_ptr<Drawing> inner, const Cell& cell, const DrawingOptions& options,
                const Reading& reading)
        : DerivedDrawing(std::move(inner), options, reading), cell_(cell) {
        if (!drawn_.ground) return;
        style_.palette.push_back(*drawn_.ground);
        style_.ground.reset();
    }

    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override {
        constexpr double chord = 1e-3;  // deviation of chords from curves, as a share of a side
        const std::array<glm::dvec2, 2>& sides = cell_.sides;
        if (drawn_.ground) {
            const std::array<glm::dvec2, 4> corners = {cell_.corner, cell_.corner + sides[0],
                                                       cell_.corner + sides[0] + sides[1], cell_.corner + sides[1]};
            sink.polygon(corners, Pen{.colour = static_cast<int>(drawn_.palette.size())});
        }
        const glm::dmat2x2 to_cell = glm::inverse(glm::dmat2x2(sides[0], sides[1]));
        const double length = std::sqrt(sides[0].x * sides[0].x + sides[0].y * sides[0].y);
        // Lines along an edge belong to the copies on both of its sides.
        constexpr double rounding = 1e-9;
        CropSink crop(sink, glm::dvec2(-rounding), glm::dvec2(1 + rounding),
                      {to_cell[0], to_cell[1], -(to_cell * cell_.corner)}, chord * length);
        OldColours old(crop, drawn_);
        inner_->read(print, window, old);
    }

private:
    Cell cell_;
};

/// Repeats, tiles, frames and hand-drawn lines around a drawing in the plane.
std::unique_ptr<Drawing> surrounded(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const Style& style,
                                    const DrawingOptions& options, const Reading& reading) {
    if (options.repeat) drawing = std::make_unique<RepeatedDrawing>(std::move(drawing), options, reading);
    if (has_tile_work(style)) drawing = std::make_unique<TileDrawing>(std::move(drawing), seed, options, reading);
    if (options.cell) drawing = std::make_unique<CellDrawing>(std::move(drawing), *options.cell, options, reading);
    if (options.colouring) drawing = std::make_unique<ColouringDrawing>(std::move(drawing), options, reading);
    drawing = with_frame(std::move(drawing), style, options, reading);
    if (!(style.hand > 0) && !options.lesson_step) return drawing;
    auto by_hand = std::make_unique<HandDrawing>(std::move(drawing), seed, options, reading);
    if (!options.lesson_step) return by_hand;
    return std::make_unique<LessonDrawing>(std::move(by_hand), options, reading);
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

std::unique_ptr<Drawing> with_frame(std::unique_ptr<Drawing> drawing, const Style& style,
                                    const DrawingOptions& options, const Reading& reading) {
    if (!has_frame(style, options)) return drawing;
    std::optional<Border> border;
    if (const auto& own = drawing->style().border) border = border_of(*own, options, reading);
    return std::make_unique<FramedDrawing>(std::move(drawing), std::move(border), options, reading);
}

std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                                      const Reading& reading) {
    if (grammar.map()) {
        return surrounded(make_map_drawing(grammar, style, options, reading), grammar.seed(), style, options,
                          reading);
    }
    auto shared = std::make_shared<const Grammar>(resolved(with_generations(grammar, style), reading));
    std::string why;
    if (auto parts = seen_parts(*shared, style, options, reading, why)) {
        return std::make_unique<SeenDrawing>(std::move(shared), std::move(*parts), style, options, reading);
    }
    if (auto window = WindowDrawing::make(shared, style, options, reading, why)) {
        return surrounded(std::move(window), shared->seed(), style, options, reading);
    }
    if (options.window) require_window(*shared, reading, why);
    std::unique_ptr<Drawing> drawing;
    make_one_copy(options, reading, [&](const Reading& one) {
        auto lines = std::make_unique<WordDrawing>(*shared, style, options, one);
        if (has_ornaments(style, options)) {
            drawing = std::make_unique<Composition>(*shared, std::move(lines), options, one);
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
    return surrounded(std::move(drawing), shared->seed(), style, options, reading);
}

}  // namespace sikku
