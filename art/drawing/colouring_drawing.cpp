#include "art/drawing/colouring_drawing.h"

#include "art/style/white_paper.h"
#include "engine/language/grammar.h"

#include <utility>

namespace sikku {
namespace {

/// Forwards lines in one pen, and omits everything else.
class OneInk : public PathFilter {
public:
    /// @param style  of the lines
    OneInk(PathSink& sink, const Style& style) : Forwarding(sink), style_(style) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, plain(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(plain(pen)); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void area(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
    void label(std::string_view, glm::dvec2, double, const Pen&) override {}

private:
    Pen plain(const Pen& pen) const { return style_.draws(pen) ? Pen{} : Pen{.width = 0, .width_set = true}; }

    const Style& style_;
};

bool has_polygons(const Grammar& grammar) {
    return !grammar.map() && grammar.leads_to([](Action action) { return action == Action::polygon_begin; });
}

}  // namespace

void prepare_colouring(Style& style, const Grammar& grammar, Colour ink, double width) {
    style.ground = white_paper;
    style.stroke = {.value = width, .in_steps = false, .unit = 1.0};
    style.stroke_colour = ink;
    style.stroked = true;
    style.hand = 0;
    style.dots.reset();
    style.border.reset();
    style.fields.reset();
    style.weave.reset();
    style.parallel = {};
    style.tile_colours.reset();
    style.map.fill = CellFill::none;
    style.map.tissue.reset();
    const bool is_decorated = style.decoration.is_set() && style.tile_edges == TileEdges::none;
    if (!is_decorated && style.line == Line::straight && has_polygons(grammar)) style.tile_edges = TileEdges::once;
}

ColouringDrawing::ColouringDrawing(std::unique_ptr<Drawing> inner, const DrawingOptions& options,
                                   const Reading& reading)
    : DerivedDrawing(std::move(inner), options, reading) {
    style_.palette = {style_.line_colour({})};
    style_.fill.reset();
}

void ColouringDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    OneInk lines(sink, drawn_);
    inner_->read(print, window, lines);
    if (reading_.is_plot()) return;
    for (const Speck& speck : options_.specks) sink.disc(speck.centre, speck.radius, Pen{});
}

}  // namespace sikku
