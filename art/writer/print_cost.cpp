#include "art/writer/print_cost.h"

#include "art/deep/seen_drawing.h"
#include "art/deep/window_drawing.h"
#include "art/drawing/census.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/line_work.h"
#include "art/drawing/map_frames.h"
#include "art/drawing/repeated_drawing.h"
#include "art/print/tiles.h"
#include "art/relief/most_triangles.h"
#include "art/space/tessellation.h"
#include "art/tiles/tile_drawing.h"
#include "art/writer/make_drawing.h"
#include "art/writer/tiled_print.h"
#include "engine/derivation/forecast.h"
#include "engine/map/map_step.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double nodes_read = 50'000;  // maximum for a word whose drawing is forecast: a millisecond
// Maximum for a word whose drawing is made to find its size: some milliseconds.
constexpr double nodes_placed = 5'000;
constexpr double edges_made = 300'000;  // maximum for maps, likewise

// Memory that is kept, in bytes.
constexpr double picture_bytes = 6e6;  // for the library, for each file
constexpr double writer_bytes = 1e6;
constexpr double map_edge_bytes = 250;
constexpr double scene_line_bytes = 60;
constexpr double lit_line_bytes = 80;        // for a line in space that casts a shadow
constexpr double worked_line_bytes = 900;    // for a line that is intersected for fields or a weave
constexpr double ornament_line_bytes = 250;  // for a line that is examined for dots or strands
constexpr double tile_edge_bytes = 500;      // for a line whose tiles are coloured or whose edges are united
constexpr double hand_line_bytes = 3200;     // for a line that is drawn by hand
constexpr double plot_line_bytes = 400;

// Processor time, in seconds.
constexpr double node_seconds = 6e-9;  // for each symbol that is read
constexpr double point_seconds = 15e-9;
constexpr double curve_seconds = 60e-9;
constexpr double map_edge_seconds = 1.5e-6;
constexpr double placed_edge_seconds = 5e-6;
constexpr double ornament_line_seconds = 2e-6;
constexpr double worked_line_seconds = 8e-6;
constexpr double tile_edge_seconds = 3e-6;
constexpr double hand_line_seconds = 30e-6;
constexpr double hand_pixel_seconds = 40e-9, floor_pixel_seconds = 8e-9;
constexpr double floor_seconds = 0.3, floor_bytes = 2;  // of its texture, and for each pixel of a compressed picture
constexpr double frame_points = 2e4;

double square(double value) {
    return value * value;
}

/// Number of passes of a pen that is narrower than the lines.
double plot_passes(const Print& print, const PlotPen& plot) {
    if (!(plot.pen_width > 0) || print.style.stroke.in_steps) return 1;
    return std::max(1.0, print.style.pen_width({}) / plot.pen_width);
}

/// The numbers of symbols of a map do not follow from its productions, so it is derived as far as that is cheap.
DrawingCost cost_of_map(const Grammar& grammar, const ReadingLimits& limits) {
    MapDerivation derivation(grammar, map_limits(*grammar.map(), limits.budget), limits.monitor);
    std::vector<double> edges(1, static_cast<double>(derivation.map().edges().size()));
    double made = edges.back();
    while (made < edges_made && derivation.next()) {
        edges.push_back(static_cast<double>(derivation.map().edges().size()));
        made += edges.back();
    }
    const auto left = static_cast<double>(grammar.steps() - derivation.steps());
    const std::size_t before = edges.size() / 2;
    double last = edges.back();
    if (left > 0 && before + 1 < edges.size()) {
        const double growth = std::pow(last / edges[before], 1 / static_cast<double>(edges.size() - 1 - before));
        const double grown = last * std::pow(std::max(1.0, growth), left);
        made += growth > 1.01 ? (grown - last) / (growth - 1) * growth : left * last;
        last = grown;
    } else {
        made += left * last;
    }
    DrawingCost cost;
    const double cells = last / 3;
    cost.nodes = made;
    cost.lines = last + cells;
    cost.points = 2 * cost.lines;
    cost.seconds = made * map_edge_seconds;
    if (grammar.map()->placing != Placing::straight) cost.seconds += made * placed_edge_seconds;
    cost.kept_memory = last * map_edge_bytes;
    return cost;
}

/// The placement of a word on its page, from its census.
double place(Print& print, const DrawnCensus& census, const Grammar& grammar, const DrawingOptions& options) {
    if (census.box.empty()) return 1;
    PlacementOptions placement = options.placement;
    placement.scale *= grammar.scale_percent() / 100;
    try {
        place_print(print, {census.box, census.widest}, print.style.stroke, placement);
    } catch (const std::runtime_error&) {
        return 1;  // make() reports it
    }
    return print.placement.step;
}

DrawingCost cost_of_word(const Grammar& grammar, Print print, const DrawingOptions& options, const Reading& reading) {
    const DrawnCensus census = drawn_census(grammar, print.style, orientation(options.placement), nodes_read);
    DrawingCost cost;
    const double step = place(print, census, grammar, options);
    const double unit = print.style.stroke.in_steps ? step : 1;
    cost.nodes = std::min(census.nodes, 2 * reading.budget);
    cost.is_doubtful = census.nodes > reading.budget;
    const double share = census.nodes > 0 ? cost.nodes / census.nodes : 1;
    cost.lines = (census.lines + census.polygons + census.discs) * share;
    cost.points = (census.lines + census.corners + census.discs + census.strokes) * share;
    cost.strokes = census.strokes * share;
    cost.length = census.length * share * step;
    cost.ink = cost.length * census.mean_width * unit;
    cost.area = census.area * share * square(step);
    cost.patches = census.patches * share;
    for (const BentPatches& patches : census.bent) cost.bent.emplace_back(patches.bend * step, patches.count * share);
    cost.polygons = census.polygons * share;
    cost.reach = census.deepest * step;
    if (!census.box.empty()) cost.size = (census.box.high - census.box.low) * step;
    const bool spline = print.style.line == Line::spline;
    const double passes = spline ? 3 : 2;
    cost.seconds = passes * (cost.nodes * node_seconds + cost.points * point_seconds);
    if (spline) cost.seconds += 2 * census.lines * share * curve_seconds;
    if (grammar.is_spatial()) cost.kept_memory = (cost.points + cost.patches) * scene_line_bytes;
    return cost;
}

/// Adds the cost of processing the lines of a drawing in the plane before they are written.
void add_work(const Print& print, const DrawingOptions& options, DrawingCost& cost) {
    if (options.repeat) {
        const double copies = options.repeat->copies();
        for (double* number : {&cost.nodes, &cost.lines, &cost.points, &cost.strokes, &cost.polygons, &cost.seconds})
            *number *= copies;
    }
    const auto add = [&](bool is_done, double seconds, double bytes) {
        if (!is_done) return;
        cost.seconds += cost.points * seconds;
        cost.kept_memory += cost.points * bytes;
    };
    add(print.style.dots || options.colours_strokes, ornament_line_seconds, ornament_line_bytes);
    add(has_line_work(print.style), worked_line_seconds, worked_line_bytes);
    add(has_tile_work(print.style), tile_edge_seconds, tile_edge_bytes);
    add(print.style.hand > 0 || options.lesson_step.has_value(), hand_line_seconds, hand_line_bytes);
    if (has_frame(print.style, options)) {
        cost.points += frame_points;
        cost.seconds += frame_points * curve_seconds;
    }
}

DrawingCost cost_of_reading(const Grammar& grammar, const Print& print, const DrawingOptions& options,
                            const Reading& reading) {
    DrawingCost cost = grammar.map() ? cost_of_map(grammar, reading) : cost_of_word(grammar, print, options, reading);
    add_work(print, options, cost);
    double drawn = cost.kept_memory;
    if (reading.pen) drawn += cost.points * plot_passes(print, *reading.pen) * plot_line_bytes;
    if (reading.is_vector) {
        cost.memory = writer_bytes + drawn;
        return cost;
    }
    const PixelSize size = pixel_size(print.page, print.dpi);
    double pieces = cost.points;
    if (print.style.line == Line::spline) {
        // The steps are taken to fill the page evenly.
        const double step = std::sqrt(static_cast<double>(size.width) * size.height / std::max(cost.lines, 1.0));
        pieces *= curve_lines(step);
    }
    cost.thread_memory = band_bytes(size);
    cost.lines_memory = pieces * raster_line_bytes;
    cost.memory = picture_bytes + cost.lines_memory + cost.thread_memory + drawn;
    return cost;
}

/// The contents of a window are unknown before they are drawn: assumes as many tiles as a page shows well.
DrawingCost cost_of_window(const Print& print, const Reading& reading) {
    DrawingCost cost;
    cost.nodes = std::min(1e6, reading.budget);
    cost.lines = 1e5;
    cost.points = 4e5;
    cost.seconds = cost.nodes * node_seconds + cost.points * (has_tile_work(print.style) ? tile_edge_seconds : 0);
    cost.memory = writer_bytes + (has_tile_work(print.style) ? cost.lines * tile_edge_bytes : 0);
    if (reading.is_vector) return cost;
    cost.thread_memory = band_bytes(pixel_size(print.page, print.dpi));
    cost.lines_memory = cost.lines * raster_line_bytes;
    cost.memory += picture_bytes + cost.lines_memory + cost.thread_memory;
    return cost;
}

// --- pictures of drawings in space

constexpr double pixel_samples = 16;  // for each pixel
constexpr double facet_bytes = 160;   // for each polygon of a divided surface

/// Processor time of a pixel of a drawing in space, drawn on or not.
constexpr double sampled_pixel_seconds = 40e-9;
constexpr double lit_pixel_seconds = 100e-9;
constexpr double question_seconds = 1.5e-9;  // for testing whether light of one direction reaches a place
constexpr double map_square_seconds = 2.5e-9;
constexpr double shadowed_square_seconds = 3e-9;
constexpr double ground_block_seconds = 0.2e-6;  // for testing whether sun and sky reach the ground there
constexpr double map_triangle_seconds = 12e-9;
constexpr double triangle_seconds = 200e-9;
constexpr double sample_seconds = 3e-9;
constexpr double maps_of_sky = 64, maps_of_sun = 40;

/// Polygons into which the patches of a drawing are divided. @param deviation  in millimetres
double patch_polygons(const DrawingCost& drawing, double deviation) {
    double sum = 0;
    for (const auto& [bend, count] : drawing.bent) sum += count * polygons_of_patch(bend, deviation);
    return sum;
}

void add_picture(const Grammar& grammar, const Print& print, const DrawOptions& options, const DrawingCost& drawing,
                 Cost& cost) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    const double pixels = static_cast<double>(size.width) * size.height;
    const double fine = print.dpi / 25.4;
    const PixelCost each = pixel_cost(options.format);
    // Most time is spent on pixels at the edges of lines and polygons.
    const double rims = std::min(pixels, drawing.length * fine * 3);
    const double inked = std::min(pixels, drawing.ink * square(fine) + rims + drawing.area * square(fine) * 0.1);
    cost.seconds += 0.004 + pixels * each.seconds + inked * each.ink_seconds;
    cost.bytes += 1000 + pixels * each.bytes + inked * 1.0;
    cost.band = drawing.thread_memory;
    if (grammar.is_spatial()) return add_scene(print, drawing, cost);
    cost.seconds +=
        drawing.points * 60e-9 + drawing.length * fine * 4e-9 + (drawing.ink + drawing.area) * square(fine) * 2e-9;
    if (print.style.hand > 0) cost.seconds += inked * hand_pixel_seconds;
    if (print.style.shown_floor()) {
        cost.seconds += floor_seconds + pixels * (each.ink_seconds + floor_pixel_seconds);
        cost.bytes += pixels * floor_bytes;
    }
}

constexpr double plot_point_seconds = 1.2e-6;
constexpr double hidden_point_seconds = 2.5e-6, hidden_point_bytes = 200;

/// Makes the drawing of a word of few nodes, and places it on `print`. False if it cannot be drawn, which make()
/// reports.
bool place_short_word(const Grammar& grammar, Print& print, DrawOptions options) {
    options.watch = nullptr;
    options.begin = nullptr;
    Style style = print.style;
    style.hand = 0;  // takes long, and hardly changes the size
    try {
        const auto drawing = make_drawing(grammar, style, options);
        if (options.tiles) {
            place_whole(*drawing, print);
        } else {
            drawing->place(print);
        }
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

/// The step that `dot-spacing` gives: dots are as many steps apart in a shorter word.
std::optional<double> step_of_spacing(const Grammar& grammar, Print print, DrawOptions options) {
    options.repeat.reset();
    options.tiles.reset();
    const std::int64_t steps = largest_affordable(grammar, true, nodes_placed);
    const auto shorter = steps < 0 ? std::nullopt : grammar.with_steps(steps);
    if (!shorter || !place_short_word(*shorter, print, options)) return std::nullopt;
    return print.placement.step;
}

/// The sheets of a tiled print. With a fixed step, the page is as large as the drawing.
/// @throws std::runtime_error if it is certain that there are too many
Tiling sheets_of(const Grammar& grammar, Print whole, const DrawOptions& options, const DrawingCost& drawing) {
    const double copies = options.repeat ? options.repeat->copies() : 1;
    bool is_exact = !options.placement.step;
    if (!is_exact && !grammar.map() && drawing.nodes * copies <= nodes_placed) {
        is_exact = place_short_word(grammar, whole, options);
    }
    if (!is_exact) {
        const glm::dvec2 cells =
            options.repeat ? glm::dvec2(options.repeat->columns, options.repeat->rows) : glm::dvec2(1.0);
        whole.page.width = drawing.size.x * cells.x + 2 * whole.page.margin;
        whole.page.height = drawing.size.y * cells.y + 2 * whole.page.margin;
    }
    try {
        return tiling_of(whole.page, *options.tiles);
    } catch (const std::runtime_error&) {
        if (is_exact) throw;
        Tiling most;
        most.sheet = options.tiles->sheet;
        most.rows = most.columns = 20;
        return most;
    }
}

/// Adds the cost of the sheets of a tiled print: marks, the pattern in each file, and the overview page of a PDF.
/// Sheets that are files read the drawing again.
void add_sheets(const Print& print, const DrawOptions& options, const DrawingCost& drawing, double sheets,
                Cost& cost) {
    constexpr double marks_bytes = 5500, picture_marks_bytes = 2000, sheet_seconds = 300e-6;
    cost.seconds += sheets * sheet_seconds;
    if (options.format == PrintFormat::pdf) {
        cost.bytes += (sheets + 1) * marks_bytes;
        return;
    }
    cost.seconds += (sheets - 1) * drawing.seconds / 2;
    cost.bytes += sheets * (is_vector(options.format) ? marks_bytes : picture_marks_bytes) +
                  (sheets - 1) * static_cast<double>(print.pattern.size());
}

/// Polygons of which a vector print of a drawing in space consists: wide stems are lit in strips.
double shaded_polygons(const DrawingCost& drawing) {
    constexpr double wide_stem = 0.8;  // millimetres
    const double width = drawing.length > 0 ? drawing.ink / drawing.length : 0;
    return (drawing.lines - drawing.polygons) * (width > wide_stem ? 8 : 2) + drawing.polygons +
           patch_polygons(drawing, 0.1);
}

}  // namespace

DrawingCost drawing_cost(const Grammar& given_grammar, const Print& given, const DrawingOptions& options,
                         const Reading& reading) {
    if (given_grammar.map()) return cost_of_reading(given_grammar, given, options, reading);
    const Grammar grammar = shorten(given_grammar);
    std::string why;
    // One at a time, because galleries forecast on many threads and parts take much memory.
    static std::mutex mutex;
    std::unique_lock lock(mutex, std::defer_lock);
    if (may_be_seen(grammar, given.style, options, reading)) lock.lock();
    if (const auto parts = seen_parts(grammar, given.style, options, reading, why)) {
        return seen_cost(grammar, *parts, given, options, reading);
    }
    if (WindowDrawing::make(std::make_shared<const Grammar>(grammar), given.style, options, reading, why)) {
        return cost_of_window(given, reading);
    }
    if (options.window) require_window(grammar, reading, why);
    make_one_copy(options, reading, [&](const Reading& one) { require_affordable(grammar, true, one.budget); });
    return cost_of_reading(grammar, given, options, reading);
}

void add_scene(const Print& print, const DrawingCost& drawing, Cost& cost) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    const double pixels = static_cast<double>(size.width) * size.height;
    const double fine = print.dpi / 25.4;
    const double stems = drawing.lines - drawing.polygons;
    // One of the two sides of a surface is visible, at all angles.
    const double shown = (drawing.ink + 0.6 * drawing.area) * square(fine);
    const double frame = std::max(1.0, drawing.size.x * drawing.size.y * square(fine));
    const double covered = 0.7 * frame * (1 - std::exp(-shown / (0.7 * frame)));
    const bool is_lit = !print.style.light.is_flat;
    // In light, deviations are measured, which saves up to half the divisions each way.
    const double loose = is_lit ? 2 : 1;
    const double pieces = 2 * patch_polygons(drawing, 0.2 / fine * loose);
    const double triangles = stems * 12 + drawing.points + pieces;
    cost.seconds += pixels * (is_lit ? lit_pixel_seconds : sampled_pixel_seconds) + triangles * triangle_seconds +
                    shown * pixel_samples * sample_seconds;
    cost.memory += pixel_samples * (is_lit ? 8 : 12) * size.width * 32 + pieces * facet_bytes;
    if (!is_lit) return;
    const double reach = drawing.reach * fine;
    const double side = reach < 512 ? 512 : reach <= 2048 ? 1024 : 2048;
    const double shape = std::clamp(drawing.size.x / std::max(drawing.size.y, 1e-9), 0.1, 1.0);
    const double of_sky = print.style.light.sun < 1 ? maps_of_sky : 0;
    const double of_sun = print.style.light.sun > 0 ? maps_of_sun : 0;
    const double squares = (of_sky / 4 + of_sun) * square(side) * std::max(0.35, shape);
    const double casters = 2 * stems + drawing.points + 2 * patch_polygons(drawing, drawing.reach / side * loose);
    const double shadowed = shown * square(side / std::max(reach, 1.0));
    cost.memory += 2 * squares + casters * lit_line_bytes;
    const double block = print.dpi < 200 && reach <= 2048 ? 1 : 2;
    const double questions = covered / square(block) * 1.6 * 2 * (of_sky + of_sun);
    const double ground = print.style.light.has_ground ? pixels / square(block) : 0;
    // Small maps stay in the processor's cache.
    const double distant = side > 512 ? 1 : 0.4;
    cost.seconds += squares * map_square_seconds + casters * (of_sky + of_sun) * map_triangle_seconds +
                    shadowed * (of_sky / 4 + of_sun) * shadowed_square_seconds +
                    distant * (questions * question_seconds + ground * ground_block_seconds);
}

Cost base_cost(bool has_module) {
    Cost base;
    base.seconds = base.shared_seconds = has_module ? 0.26 : 0.003;
    base.memory = base.shared_memory = has_module ? 130e6 : 7e6;
    return base;
}

Cost print_cost(const Grammar& grammar, const Print& print, const DrawOptions& given) {
    DrawOptions options = given;
    if (options.dot_spacing && !grammar.map()) options.placement.step = step_of_spacing(grammar, print, options);
    const DrawingCost drawing = drawing_cost(grammar, print, options, options.reading());
    const bool has_pixels = !is_vector(options.format);
    Cost cost = base_cost(uses_image_module(options.format));
    cost.is_doubtful = drawing.is_doubtful;
    cost.seconds += drawing.seconds + 0.001;
    cost.memory += drawing.memory + static_cast<double>(print.pattern.size());
    cost.bytes = static_cast<double>(print.pattern.size());
    Print paper = print;
    if (options.tiles) {
        const Tiling tiling = sheets_of(grammar, print, options, drawing);
        paper.page.width = tiling.sheet.width * tiling.columns;
        paper.page.height = tiling.sheet.height * tiling.rows;
        add_sheets(print, options, drawing, static_cast<double>(tiling.columns) * tiling.rows, cost);
    }
    if (has_pixels) {
        add_picture(grammar, paper, options, drawing, cost);
        return cost;
    }
    const bool spline = print.style.line == Line::spline;
    const LineCost writer = line_cost(options.format);
    // A kolam has about a dot for every four curves, and a dot takes the bytes of two.
    constexpr double with_dots = 1.5;
    double points = drawing.points * (print.style.dots ? with_dots : 1);
    const bool is_plot = options.plot || is_for_plotters(options.format);
    if (grammar.is_spatial() && !is_plot) {
        const double shades = shaded_polygons(drawing);
        cost.seconds += shades * writer.shade_seconds;
        cost.memory += shades * facet_bytes;
        cost.bytes += shades * writer.shade_bytes;
    }
    if (is_plot) {
        // Only visible parts of lines in space are drawn.
        if (grammar.is_spatial()) {
            points += drawing.lines * 8 + patch_polygons(drawing, 0.1) * 2;
            cost.memory += points * hidden_point_bytes;
        }
        points *= options.plot ? plot_passes(print, *options.plot) : 1;
        cost.seconds += points * (grammar.is_spatial() ? hidden_point_seconds : plot_point_seconds);
    }
    cost.seconds += points * (spline ? writer.curve_seconds : writer.line_seconds);
    cost.bytes += writer.bytes + points * (spline ? writer.curve_bytes : writer.line_bytes);
    return cost;
}

Cost solid_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, PrintFormat format) {
    constexpr double relief_triangle_seconds = 1.1e-6, relief_triangle_bytes = 100;
    constexpr double coloured_triangle_seconds = 1.2e-6, coloured_triangle_bytes = 120;
    constexpr double model_triangle_seconds = 0.25e-6;
    constexpr double written_triangle_seconds = 2.6e-6;  // for each triangle of a text
    const DrawingCost drawing = drawing_cost(grammar, print, options, options.reading());
    const bool spline = print.style.line == Line::spline;
    Cost cost = base_cost(false);
    cost.seconds += drawing.seconds + 0.001;
    cost.memory += drawing.memory + static_cast<double>(print.pattern.size());
    const double bytes = format == PrintFormat::stl ? 50 : format == PrintFormat::glb ? 30 : 80;
    double triangles = 0;
    if (options.relief) {
        // The outlines of two lines that cross have four points in common; lines along polygons are left out.
        constexpr double of_line = 16, of_curve = 120, of_corner = 4, of_crossing = 32;
        const double page = std::max(drawing.size.x * drawing.size.y, 1.0);
        triangles = drawing.points * (drawing.polygons > 0 ? of_corner
                                      : spline             ? of_curve
                                                           : of_line) +
                    of_crossing * square(drawing.length) / (std::numbers::pi * page);
        triangles = std::min(triangles, 2.0 * static_cast<double>(most_relief_triangles));
        const bool is_stl = format == PrintFormat::stl;
        cost.seconds += triangles * (is_stl ? relief_triangle_seconds : coloured_triangle_seconds);
        cost.memory += triangles * (is_stl ? relief_triangle_bytes : coloured_triangle_bytes);
    } else {
        triangles = (drawing.lines - drawing.polygons) * 6 + drawing.points + drawing.patches * 200;
        cost.seconds += triangles * (format == PrintFormat::obj ? written_triangle_seconds : model_triangle_seconds);
        cost.memory += triangles * 110;
    }
    cost.bytes = static_cast<double>(print.pattern.size()) + 1000 + triangles * bytes;
    return cost;
}

}  // namespace sikku
