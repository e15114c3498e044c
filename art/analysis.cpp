#include "art/analysis.h"

#include "art/deep/seen_drawing.h"
#include "art/product/draw_settings.h"
#include "art/style/style.h"
#include "engine/derivation/forecast.h"

namespace sikku {
namespace {

constexpr double any_resolution = 300;  // widths do not matter here

Style style_of(const Document& document) {
    Diagnostics diagnostics;
    Style style = read_style(document.pattern(), any_resolution, diagnostics);
    diagnostics.throw_if_errors();
    return style;
}

}  // namespace

DrawnLines drawn_lines(const Document& document, double budget, const Monitor& monitor) {
    require_turtle(document, "it draws no lines");
    const Style style = style_of(document);
    TraceOptions options;
    options.moves_draw = style.moves_draw();
    options.draws = [&style](const Pen& pen) { return style.draws(pen); };
    options.budget = budget;
    options.watch = [&monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    if (document.grammar().is_spatial()) return trace_in_space(document.grammar(), options);
    return trace(document.grammar(), options);
}

KolamExamination examine_kolam(const Document& document, double budget, const Monitor& monitor) {
    require_turtle(document, "it is not a kolam");
    const Style style = style_of(document);
    KolamOptions options;
    options.spline = style.line == Line::spline;
    options.moves_lift = style.moves_lift;
    options.draws = [&style](const Pen& pen) { return style.draws(pen); };
    options.budget = budget;
    options.watch = [&monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    options.monitor = monitor;
    return examine_kolam(document.grammar(), options);
}

bool has_view(const Document& document) {
    try {
        DrawingOptions options;
        options.window = parse_window("0,0,1,1");
        std::string why;
        const Grammar grammar = shorten(document.grammar());
        return seen_parts(grammar, read_print_style(document, {}), options, {}, why).has_value();
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace sikku
