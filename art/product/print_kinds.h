// art/product/print_kinds.h: kinds of prints, by their settings and format.
#pragma once

#include "art/product/draw_settings.h"

namespace sikku {

/// A kind of print. Several may hold at once.
using PrintKind = bool (*)(const DrawSettings& settings, PrintFormat format);

namespace when {
using S = DrawSettings;
using Format = PrintFormat;

constexpr PrintKind always = [](const S&, Format) { return true; };
constexpr PrintKind relief = [](const S& s, Format f) { return is_relief(s, f); };
constexpr PrintKind no_relief = [](const S& s, Format f) { return !is_relief(s, f); };
constexpr PrintKind flat = [](const S&, Format f) { return info(f).kind != FormatKind::model; };
constexpr PrintKind model = [](const S& s, Format f) { return is_model(s, f); };
constexpr PrintKind fitted = [](const S& s, Format) { return s.place.fit; };
constexpr PrintKind stepped = [](const S& s, Format) { return s.look.placement.step.has_value(); };
constexpr PrintKind windowed = [](const S& s, Format) { return s.look.window.has_value(); };
constexpr PrintKind untitled = [](const S& s, Format) { return !s.look.title_line; };
constexpr PrintKind without_text = [](const S& s, Format) { return !s.look.title_line && s.look.edition.empty(); };
constexpr PrintKind in_font = [](const S& s, Format) { return !s.look.font_name.empty(); };
constexpr PrintKind page_filled = [](const S& s, Format) { return s.place.fills_page; };
constexpr PrintKind part = [](const S& s, Format) { return s.look.window || s.place.fills_page; };
constexpr PrintKind placed = [](const S& s, Format) {
    return s.place.fit || s.look.window || s.look.dot_spacing || s.look.repeat || s.look.composes ||
           s.time.generations || s.look.placement.rotate != 0;
};
constexpr PrintKind pixels = [](const S&, Format f) { return !is_vector(f); };
constexpr PrintKind plot = [](const S& s, Format f) { return s.plot.plotter || is_for_plotters(f); };
constexpr PrintKind no_plot = [](const S& s, Format f) { return !plot(s, f); };
constexpr PrintKind drawn_plot = [](const S& s, Format f) { return s.plot.plotter && f != Format::dxf; };
constexpr PrintKind without_travel = [](const S& s, Format f) {
    return !(plot(s, f) && info(f).kind == FormatKind::vectors);
};
constexpr PrintKind without_parking = [](const S&, Format f) { return !is_for_plotters(f) || f == Format::dxf; };
constexpr PrintKind dxf = [](const S&, Format f) { return f == Format::dxf; };
constexpr PrintKind no_gcode = [](const S&, Format f) { return f != Format::gcode; };
constexpr PrintKind no_hpgl = [](const S&, Format f) { return f != Format::hpgl; };
constexpr PrintKind untiled = [](const S& s, Format) { return !s.paper.tile; };
constexpr PrintKind untrimmed = [](const S& s, Format) { return s.plot.plotter || s.paper.tile; };
constexpr PrintKind still = [](const S&, Format f) { return !info(f).is_animated; };
constexpr PrintKind without_names = [](const S&, Format f) { return !info(f).has_names; };
constexpr PrintKind hatched = [](const S& s, Format) { return s.plot.hatch.has_value(); };
constexpr PrintKind named_dxf = [](const S& s, Format f) { return s.paper.names_tiles && f == Format::dxf; };
constexpr PrintKind gif = [](const S&, Format f) { return f == Format::gif; };
constexpr PrintKind one_page = [](const S&, Format f) {
    return info(f).kind == FormatKind::vectors && !info(f).has_pages;
};
constexpr PrintKind swatch = [](const S& s, Format) { return s.place.swatch != SwatchChoice::none; };
constexpr PrintKind undivided = [](const S&, Format f) { return f != Format::svg && f != Format::gif; };
constexpr PrintKind division = [](const S& s, Format) { return s.time.division.has_value(); };
constexpr PrintKind lesson = [](const S& s, Format) { return s.time.lesson.has_value(); };
constexpr PrintKind lesson_of_dots = [](const S& s, Format) { return s.time.lesson && s.look.only_dots; };
constexpr PrintKind lesson_cells = [](const S& s, Format f) {
    return s.time.lesson && !is_vector(f) && f != Format::gif;
};
constexpr PrintKind colouring = [](const S& s, Format) { return s.look.colouring.has_value(); };
constexpr PrintKind animated_colouring = [](const S& s, Format f) { return s.look.colouring && f == Format::gif; };
constexpr PrintKind solid_colouring = [](const S& s, Format f) {
    return s.look.colouring && (is_model(s, f) || is_relief(s, f));
};
constexpr PrintKind rule = [](const S& s, Format) { return s.time.shows_rule; };
constexpr PrintKind highlighted = [](const S& s, Format) { return s.look.highlight.has_value(); };
/// Derivation lengths one after the other, or in a file each.
constexpr PrintKind grown = [](const S& s, Format f) {
    return s.time.frames || (f == Format::gif && !s.time.lesson);
};
/// One file with several derivation lengths side by side.
constexpr PrintKind row = [](const S& s, Format f) {
    return s.time.generations && f != Format::gif && !s.time.frames && !s.time.division;
};
constexpr PrintKind plotted_row = [](const S& s, Format f) { return row(s, f) && plot(s, f); };
constexpr PrintKind flat_relief = [](const S& s, Format f) { return flat(s, f) && is_relief(s, f); };
constexpr PrintKind relief_row = [](const S& s, Format f) {
    return is_relief(s, f) && s.time.generations && !s.time.frames;
};
constexpr PrintKind one_generation = [](const S& s, Format) { return !s.time.generations; };
constexpr PrintKind untimed = [](const S& s, Format f) { return f != Format::gif && !s.time.division; };
constexpr PrintKind unframed = [](const S& s, Format f) { return !s.time.generations || row(s, f); };
}  // namespace when

}  // namespace sikku
