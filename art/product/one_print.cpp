// art/product/one_print.cpp: one drawing on a page: prints, plots, swatches, tiled prints and reliefs.
#include "art/font/letters.h"
#include "art/image/image_file.h"
#include "art/product/plot_remarks.h"
#include "art/product/print_work.h"
#include "art/relief/relief_options.h"
#include "art/writer/draw.h"
#include "art/writer/print_cost.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/map/map_measurement.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

void report_sheets(const DrawReport& report, Made& made) {
    if (report.sheets == 1) return made.fact("the print fits on one sheet");
    made.fact(fmt::format("{} sheets, {} x {}", report.sheets, report.sheet_rows, report.sheets / report.sheet_rows));
    constexpr double least = 0.05;
    const auto left_out = [&](double length, const char* sides) {
        if (length < least) return;
        made.fact(fmt::format("{:.1f} mm of the margin at the {} do not fit on the sheets and are left out", length,
                              sides));
    };
    left_out(report.left_out.x, "left and right");
    left_out(report.left_out.y, "top and bottom");
}

void report_swatch(const Swatch& swatch, const Print& print, glm::dvec2 stretch, Made& made) {
    made.fact(fmt::format("{}: {}, {:.6g} x {:.6g} mm", swatch.is_rectangle ? "a rectangle" : "a parallelogram",
                          counted(swatch.tiles, "tile"), print.page.width, print.page.height));
    if (swatch.turn != 0) made.fact(fmt::format("the tiling is turned by {:.6g} degrees", swatch.turn));
    if (!swatch.is_rectangle) {
        made.warn(fmt::format("no rectangle of this tiling repeats: copies lie {:.6g} and {:.6g} steps apart",
                              glm::length(swatch.cell.sides[0]), glm::length(swatch.cell.sides[1])));
    }
    const glm::dvec2 parts = 100.0 * (stretch - 1.0);
    if (std::max(std::fabs(parts.x), std::fabs(parts.y)) < 0.01) return;
    made.fact(fmt::format("stretched to whole pixels by {:.2g} % across and {:.2g} % down", parts.x, parts.y));
}

/// True if a style has colours that a format without opacity can only mix.
bool has_translucent_colours(const Style& style) {
    const auto mixes = [](const Colour& colour) { return colour.alpha > 0 && colour.alpha < 255; };
    if (style.ground && mixes(*style.ground)) return true;
    for (int index = 0; index < std::max(static_cast<int>(style.palette.size()), 1); ++index) {
        const Pen pen{.colour = index};
        if ((style.stroked && mixes(style.line_colour(pen))) || mixes(style.fill_colour(pen))) return true;
    }
    return false;
}

void report_relief(const ReliefReport& report, Made& made) {
    constexpr std::size_t most_named = 8;
    constexpr double thin = 0.4;  // width in mm that the usual nozzle of a 3-D printer can draw
    made.fact(fmt::format("{}, {:g} x {:g} x {:g} mm, {:.1f} cm³", counted(report.triangles, "triangle"),
                          report.size.x, report.size.y, report.size.z, report.volume / 1000));
    const auto tell = [&](const char* what, const std::vector<std::pair<Colour, double>>& heights) {
        std::string list;
        for (std::size_t i = 0; i < std::min(heights.size(), most_named); ++i) {
            list += fmt::format("{}{} {:g} mm", list.empty() ? "" : ", ", hex(heights[i].first), heights[i].second);
        }
        if (!list.empty()) made.fact(what + list + (heights.size() > most_named ? ", …" : ""));
    };
    tell("heights: ", report.heights);
    tell("heights of lines: ", report.ridges);
    if (report.lost > 0) {
        made.warn(fmt::format("{} narrower than the groove and left out",
                              report.lost == 1 ? "1 polygon is" : fmt::format("{} polygons are", report.lost)));
    }
    if (report.narrowest > 0 && report.narrowest < thin - 1e-9) {
        made.warn(fmt::format("the narrowest lines are {:.2g} mm wide; many 3-D printers need {:g} mm",
                              report.narrowest, thin));
    }
}

class OnePrint : public PrintWork {
public:
    using PrintWork::PrintWork;

    Cost forecast() const override {
        const Grammar shortened = shorten(grammar());
        if (is_relief(settings(), format())) return solid_cost(shortened, print(), drawing(), format());
        return print_cost(shortened, print(), drawing());
    }

private:
    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        // Before the drawing, which may take long.
        if (!print().press.cmyk.empty()) check_cmyk_profile(print().press.cmyk);
        report = draw(grammar(), print(), options, name, destination);
        report_text(report, name, made);
        report_letters(options, made);
        warn_of_faint_inks(report.faint, made);
        report_copies(made);
        report_drawing(made);
        if (report.regions) made.fact(regions_text(*report.regions));
        if (report.relief) report_relief(*report.relief, made);
        report_pens(options, made);
        if (report.sheets > 0) report_sheets(report, made);
        if (settings().place.swatch_place)
            report_swatch(*settings().place.swatch_place, print(), settings().place.swatch_stretch, made);
        if (settings().place.fills_page) made.fact(fmt::format("derivation length {}", grammar().steps()));
        if (report.overflows && report.sheets == 0 && !settings().place.swatch_place) {
            made.warn(
                fmt::format("the drawing is {:.1f} x {:.1f} mm, but the page has room for {:.1f} x {:.1f} mm: the "
                            "rest is cut off",
                            report.size.x, report.size.y, report.room.x, report.room.y));
        }
    }

    void report_letters(const DrawOptions& options, Made& made) const {
        std::vector<std::string> texts = {report.sheets > 1 ? print().title : ""};
        std::vector<std::string> around = {options.title_line.value_or(""), options.edition};
        if (options.font) {
            report_font(options.font, around, made);
        } else {
            texts.insert(texts.begin(), around.begin(), around.end());
        }
        for (const LabelText& label : grammar().labels()) {
            for (const LabelText::Part& part : label.parts) texts.push_back(part.text);
        }
        warn_of_letters(Letters().missing(texts), made);
    }

    static void report_font(std::shared_ptr<const Font> font, const std::vector<std::string>& texts, Made& made) {
        made.fact("font: " + printable(font->name(), 80));
        warn_of_letters(Letters(std::move(font)).missing(texts), made);
    }

    void report_copies(Made& made) const {
        if (report.copies > 0) {
            made.fact(fmt::format("{}: {}, {}", settings().look.repeat->group,
                                  report.copies == 1 ? "1 copy" : fmt::format("{} copies", report.copies),
                                  counted(report.strokes.value_or(0), "line")));
        }
        constexpr double half = 0.55, most = 0.7;
        if (report.copies > 0 && report.covered > 0 && report.covered < half && report.covered_if_packed > most) {
            made.fact(
                fmt::format("the copies cover only {:.0f} % of {}, whose units have another shape than the drawing; "
                            "packed covers {:.0f} %",
                            100 * report.covered, settings().look.repeat->group, 100 * report.covered_if_packed));
        }
    }

    void report_drawing(Made& made) const {
        for (const std::string& warning :
             drawing_warnings(report, print().style, settings(), report.plot.has_value())) {
            made.warn(warning);
        }
        if (!info(format()).has_opacity && has_translucent_colours(print().style)) {
            made.warn(fmt::format(
                "an {} has no opacity: translucent colours are mixed with that of the ground, or with white",
                info(format()).label));
        }
        if (settings().look.kerf > 0 && print().style.tile_edges == TileEdges::once) {
            made.warn(
                fmt::format("neighbours share their cuts, so that each tile loses {:g} mm along its inner edges; "
                            "pieces that keep "
                            "their size have to be laid apart, as on cutting sheets",
                            settings().look.kerf / 2));
        }
        if (document().map()) {
            const std::string remark = undivided_remark(report.cells, *document().map(), grammar().steps());
            if (!remark.empty()) made.warn(remark);
        }
        if (report.crosses_itself) {
            made.warn(
                "the outline crosses itself, so that parts of the map overlap: a smaller 'growth' prevents that");
        }
        if (report.is_empty) {
            made.warn("the window contains no part of the drawing");
        } else if (report.is_blank) {
            made.warn(
                fmt::format("the picture looks empty: lines {:.2g} mm wide leave too little ink on pixels of {:.2g} "
                            "mm; use {} or a "
                            "shorter derivation",
                            print().style.line_width({}, report.step), 25.4 / print().dpi,
                            print().style.stroke.in_steps ? "a pen in millimetres (stroke: 0.3mm)"
                                                          : "a wider pen (stroke: 0.5mm)"));
        }
    }

    void report_pens(const DrawOptions& options, Made& made) const {
        if (report.plot) report_plot(*report.plot, settings().plot.speeds, settings().plot.pen_rules, made);
        if (report.plot && settings().plot.hatch && report.plot->fills == 0 && report.fields == 0) {
            made.warn_of_unused("hatch", "this drawing has no fills");
        }
        if (!report.is_empty) warn_of_no_tiles(report.polygons, settings(), made);
        if (report.plot && format() == PrintFormat::hpgl) report_hpgl(*report.plot, settings(), options.hpgl, made);
    }
};

}  // namespace

std::unique_ptr<PrintWork> plan_one(PrintRequest request) {
    return std::make_unique<OnePrint>(std::move(request));
}

}  // namespace sikku
