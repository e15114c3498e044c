#include "art/writer/draw.h"

#include "art/drawing/faint_inks.h"
#include "art/drawing/word_drawing.h"
#include "art/image/image_file.h"
#include "art/plotter/dxf.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot.h"
#include "art/raster/raster.h"
#include "art/relief/most_triangles.h"
#include "art/relief/relief.h"
#include "art/space/model.h"
#include "art/space/solids.h"
#include "art/vector/vector_formats.h"
#include "art/writer/colouring.h"
#include "art/writer/make_drawing.h"
#include "art/writer/picture.h"
#include "art/writer/press_inks.h"
#include "art/writer/tiled_print.h"
#include "engine/base/output.h"
#include "engine/derivation/forecast.h"

#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace sikku {

Reading DrawOptions::reading() const {
    Reading reading(*this);
    reading.is_vector = sikku::is_vector(format);
    reading.is_in_sheets = tiles != nullptr;
    reading.has_cut_layers = format == PrintFormat::dxf;
    if (plot || is_for_plotters(format)) reading.pen = plot.value_or(PlotOptions{});
    return reading;
}

std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options) {
    return make_drawing(grammar, style, options, options.reading());
}

DrawOptions with_locked_watch(DrawOptions options) {
    if (!options.watch) return options;
    options.watch = [watch = options.watch, mutex = std::make_shared<std::mutex>()](std::uint64_t symbols) {
        const std::scoped_lock lock(*mutex);
        watch(symbols);
    };
    return options;
}

namespace {

/// Memory and time of one part of a model, in nodes: its tubes have many sides.
constexpr double nodes_of_modelled_part = 200;

void draw_travels(const PlotPlan& plan, const Print& print, PathSink& sink) {
    const double width = 0.1 / (print.style.stroke.in_steps ? print.placement.step : 1.0) / print.style.stroke.unit;
    const Pen pen{width, true, *print.travel_colour};
    for (const PlotTravel& travel : plan.travels()) {
        sink.begin_stroke(travel.from, pen);
        sink.lines(std::span(&travel.to, 1));
        sink.end_stroke(false);
    }
}

/// Forwards strokes in the colours of a palette that lists the pens of a plot in the order in which they draw.
class PensInOrder : public PathFilter {
public:
    PensInOrder(PathSink& sink, const std::vector<PlotPlan::PlottedPen>& pens) : Forwarding(sink) {
        for (const PlotPlan::PlottedPen& pen : pens) places_.emplace(pen.pen.colour, places_.size());
    }
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, placed(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(placed(pen)); }
    Pen placed(Pen pen) const {
        pen.colour = static_cast<int>(places_.at(pen.colour));
        return pen;
    }

private:
    std::map<int, std::size_t> places_;
};

/// Opens the writer of a format of the kind `plot`.
std::unique_ptr<PlotWriter> plot_writer(const Print& print, const DrawOptions& options, const PlotPlan& plan,
                                        Output& output) {
    if (options.format == PrintFormat::hpgl) return write_hpgl(print, options.hpgl, output);
    if (options.format == PrintFormat::gcode) return write_gcode(print, options.gcode, output);
    if (options.format == PrintFormat::dxf) return write_dxf(print, output, plan.tile_kinds());
    throw std::logic_error("this format of plots has no writer");
}

/// Draws on one page. Sets `is_blank` of the report for pictures in which nothing is visible.
void draw_page(const Drawing& drawing, const Print& given, const DrawOptions& options, Output& output,
               const std::filesystem::path& file, DrawReport& report) {
    // Only PDF distinguishes the sheet from its bleed.
    const Print print = options.format == PrintFormat::pdf ? given : as_picture(given);
    if (is_vector(options.format)) {
        const auto writer = write_vectors(options.format, print, output);
        drawing.read_visible(print, whole_page(print.page), *writer);
        writer->finish();
        report.polygons = writer->polygons();
        return;
    }
    const auto rendering = drawing.rendering(print);
    if (options.show_pixels) return options.show_pixels(*rendering, pixel_size(print.page, print.dpi));
    report.is_blank = write_picture(*rendering, print, options, output, file);
    report.leaves_pattern_out = !keeps_text(info(options.format).extension, print.pattern);
}

ReliefReport draw_relief(const Drawing& drawing, const Print& print, const DrawOptions& options,
                         const std::filesystem::path& file, Destination& destination) {
    constexpr std::size_t points_of_triangle = 2;  // some of them produce no triangle, such as those of edges
    ReliefShapes shapes(print, points_of_triangle * most_relief_triangles);
    drawing.read_visible(print, whole_page(print.page), shapes);
    return write_relief(shapes, print, *options.relief, file, options.monitor, destination);
}

/// Checks the regions of a colouring page, and adds its specks to the options. @param print  not placed
RegionReport prepare_page(const Grammar& grammar, Print print, DrawOptions& options) {
    DrawOptions quiet = options;
    quiet.begin = nullptr;
    const Style style = print.style;
    make_drawing(grammar, style, quiet)->place(print);
    ColouringCheck check = check_regions(grammar, style, quiet, print, print.page);
    options.specks = std::move(check.specks);
    return check.regions;
}

}  // namespace

void draw_plot(const Drawing& drawing, Print print, const DrawOptions& options, Output& output, DrawReport& report) {
    print.is_plot = true;
    print.style = with_fill_pens(print.style);
    PlotOptions arranged = options.plot.value_or(PlotOptions{});
    arranged.monitor = options.monitor;
    arranged.hatched = drawing.hatched_colours();
    arranged.draws_circles = options.format == PrintFormat::dxf;
    if (options.format == PrintFormat::hpgl) {
        arranged.start = hpgl_origin(print.page, options.hpgl);
        arranged.home = arranged.start;
    } else if (options.format == PrintFormat::gcode) {
        arranged.home = gcode_home(options.gcode);
    }
    // Outlines are drawn even where lines are not.
    Print plotted = print;
    plotted.style.stroked = true;
    PlotPlan plan(drawing.bounds() ? plotted : print, arranged);
    drawing.read(print, plan);
    plan.arrange();
    report.plot = plan.report();
    report.polygons = report.plot->tiles;
    if (is_for_plotters(options.format)) {
        const auto writer = plot_writer(plotted, options, plan, output);
        std::vector<Pen> pens;
        for (const PlotPlan::PlottedPen& plotted_pen : plan.pens()) pens.push_back(plotted_pen.pen);
        writer->number_pens(pens);
        OnlyPolygons polygons(*writer);
        if (arranged.leaves_tiles) drawing.read(print, polygons);
        plan.draw(*writer, [&](glm::dvec2 place, const Pen& pen) { writer->dip(place, pen); });
        writer->finish();
        return;
    }
    const std::vector<PlotPlan::PlottedPen> pens = plan.pens();
    std::vector<Colour> palette;
    for (const auto& [pen, number, settings] : pens) {
        const Colour colour = plotted.style.line_colour(pen);
        if (options.format == PrintFormat::svg && options.layer_codes.full_speed > 0) {
            plotted.layer_names[number - 1] = layer_name(number, colour, settings, options.layer_codes);
        }
        palette.push_back(colour);
    }
    if (options.shows_travel) {
        plotted.travel_colour = static_cast<int>(palette.size());
        palette.push_back({0x88, 0x88, 0x88, 255});
    }
    plotted.style.stroke_colour.reset();
    if (!palette.empty()) plotted.style.palette = palette;
    const auto writer = write_vectors(options.format, plotted, output);
    PensInOrder ordered(*writer, pens);
    // A dip is a dot beside the drawing.
    plan.draw(ordered, [&](glm::dvec2 place, const Pen& pen) {
        const glm::dvec2 dot = plan.drawn_at(place);
        ordered.begin_stroke(dot, pen);
        ordered.lines(std::span(&dot, 1));
        ordered.end_stroke(false);
    });
    if (options.shows_travel) draw_travels(plan, plotted, *writer);
    writer->finish();
}

void draw_placed(const Drawing& drawing, const Print& print, const DrawOptions& options, Output& output,
                 const std::filesystem::path& file, DrawReport& report) {
    if (options.plot || is_for_plotters(options.format)) {
        draw_plot(drawing, print, options, output, report);
    } else {
        draw_page(drawing, print, options, output, file, report);
        report.faint = faint_inks(drawing, print);
    }
    drawing.report(report);
}

DrawReport draw(const Grammar& grammar, Print print, const DrawOptions& given_options,
                const std::filesystem::path& file, Destination& destination) {
    DrawOptions options = with_locked_watch(given_options);
    if (uses_image_module(options.format) && !options.show_pixels) prepare_images(options.threads);
    if (grammar.is_spatial() && print.animation) {
        throw std::runtime_error("animations apply only to drawings in the plane");
    }
    load_inks(print.press, options.format);  // before the drawing, which may take long
    std::optional<RegionReport> regions;
    if (options.colouring) regions = prepare_page(grammar, print, options);
    const auto drawing = make_drawing(grammar, print.style, options);
    if (options.tiles) {
        DrawReport report = draw_tiles(*drawing, std::move(print), options, file, destination);
        report.regions = regions;
        return report;
    }
    DrawReport report = drawing->place(print);
    report.regions = regions;
    print.style = drawing->style();
    check_spots(print.press, print.style);
    if (options.lists_contents) report.contents = contents_of(*drawing, print);
    if (options.relief) {
        report.relief =
            std::make_shared<const ReliefReport>(draw_relief(*drawing, print, options, file, destination));
        report.lacks_ridges = report.relief->ridges.empty();
        drawing->report(report);
        return report;
    }
    const auto output = destination.open(file);
    draw_placed(*drawing, print, options, *output, file, report);
    output->commit();
    return report;
}

ModelReport draw_model(const Grammar& given, Print print, const DrawOptions& options, PrintFormat format,
                       const std::filesystem::path& file, Destination& destination) {
    if (given.map()) throw std::runtime_error("a model is of a turtle's lines and solids, and a map has no turtle");
    if (print.style.line == Line::spline) {
        throw std::runtime_error("models have straight lines; this drawing has splines");
    }
    const Grammar grammar = resolved(given, options);
    require_affordable(grammar, true, options.budget);
    if (options.begin) options.begin(1);
    const Scene scene = read_scene(grammar, print.style, options, nodes_of_modelled_part);
    const SceneExtent seen = extent_of(scene, print.style, orientation(options.placement), options.monitor);
    require_ink(seen.box);
    PlacementOptions placement = options.placement;
    placement.scale *= grammar.scale_percent() / 100;
    place_print(print, {seen.box, seen.widest}, print.style.stroke, placement);
    return write_model(scene, print, format, file, options.monitor, destination);
}

}  // namespace sikku
