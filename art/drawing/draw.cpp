#include "art/drawing/draw.h"

#include "art/drawing/draw_view.h"
#include "art/drawing/picture.h"
#include "art/drawing/plot_scene.h"
#include "art/image/image_file.h"
#include "art/kolam/kolam.h"
#include "art/print/ornaments.h"
#include "art/raster/raster.h"
#include "art/space/solid_raster.h"
#include "art/space/solids.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"
#include "engine/base/output.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/point_tree.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/fold.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace sikku {
namespace {

/// The box of what can be seen of a drawing as it will lie on the page, and its widest pen.
class ExtentSink : public PathSink {
public:
    ExtentSink(const Style& style, const glm::dmat3x2& orientation) : style_(style), orientation_(orientation) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        change_pen(pen);
        at_ = turned(start);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        if (ends.empty()) return;
        if (draws_) {
            begin_line();
            for (const glm::dvec2 end : ends) box.add(turned(end));
        }
        at_ = turned(ends.back());
    }
    void curves(std::span<const glm::dvec2> controls) override {
        if (controls.size() < 3) return;
        if (!draws_) {
            at_ = turned(controls.back());
            return;
        }
        begin_line();
        add_curves(controls);
    }
    void change_pen(const Pen& pen) override {
        draws_ = style_.draws(pen);
        width_ = style_.pen_width(pen);
    }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        for (const glm::dvec2 vertex : vertices) box.add(turned(vertex));
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0 || outline.empty()) return;
        const glm::dvec2 at = std::exchange(at_, turned(outline.front()));
        box.add(at_);
        add_curves(outline.subspan(1));
        at_ = at;
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        // A dot is twice as wide as the line.
        const double dot = radius > 0.0 ? 0.0 : 2 * style_.pen_width(pen);
        if (!(radius + dot > 0.0)) return;
        widest = std::max(widest, dot);
        const glm::dvec2 at = turned(centre);
        box.add(at - glm::dvec2(radius));
        box.add(at + glm::dvec2(radius));
    }

    Box box;
    double widest = 0.0;  ///< of pens and dots, in the measure of the style's stroke

private:
    glm::dvec2 turned(glm::dvec2 point) const { return orientation_ * glm::dvec3(point, 1.0); }

    /// Only now, as the pen may have been changed before anything was drawn with it.
    void begin_line() {
        box.add(at_);
        widest = std::max(widest, width_);
    }

    /// From at_.
    void add_curves(std::span<const glm::dvec2> controls) {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const std::array<glm::dvec2, 4> b = {at_, turned(controls[i]), turned(controls[i + 1]),
                                                 turned(controls[i + 2])};
            box.add(b[3]);
            for (int axis = 0; axis < 2; ++axis) {
                const auto inside = [&](double value) { return value >= box.low[axis] && value <= box.high[axis]; };
                if (!inside(b[1][axis]) || !inside(b[2][axis])) add_extremes(b, axis);
            }
            at_ = b[3];
        }
    }

    /// Where the curve's derivative along `axis` vanishes.
    void add_extremes(const std::array<glm::dvec2, 4>& b, int axis) {
        const double p = b[1][axis] - b[0][axis];
        const double q = b[2][axis] - b[1][axis];
        const double r = b[3][axis] - b[2][axis];
        const double square = p - 2 * q + r;
        const double half = q - p;
        const double root = std::sqrt(std::max(0.0, half * half - square * p));
        for (const double t : {square == 0 ? -p / (2 * half) : (-half + root) / square,
                               square == 0 ? -1.0 : (-half - root) / square}) {
            if (!(t > 0 && t < 1)) continue;
            const double s = 1 - t;
            box.add(s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3]);
        }
    }

    const Style& style_;
    glm::dmat3x2 orientation_;
    glm::dvec2 at_{0.0};
    bool draws_ = false;
    double width_ = 0.0;
};

/// A drawing with all that is drawn beside it, in the colours of one palette.
class Composition {
public:
    /// Examines the drawing for its dots, if any are to be drawn; makes room for the border, and the step what the
    /// distance of the dots asks for.
    Composition(const Grammar& grammar, Print& print, DrawOptions& options) : options_(options) {
        if (options.border) {
            border_width_ = border_width(print.page);
            print.page.margin += border_room(border_width_);
        }
        if (!print.style.dots && !options.colours_strokes) return;
        KolamOptions examined;
        examined.spline = print.style.line == Line::spline;
        examined.moves_lift = print.style.moves_lift;
        examined.budget = options.budget;
        examined.watch = options.watch;
        examined.monitor = options.monitor;
        examined.draws = [style = print.style](const Pen& pen) { return style.draws(pen); };
        const KolamExamination examination = examine_kolam(grammar, examined);
        for (const std::uint32_t line : examination.line_of_stroke) {
            orbit_of_stroke_.push_back(examination.orbit_of_line[line]);
        }
        if (!print.style.dots) return;
        dots_ = dot_places(examination);
        distance_ = least_distance(dots_);
        if (options.dot_spacing) {
            if (!(distance_ > 0))
                throw std::runtime_error(
                    fmt::format("dot spacing needs at least two dots; this drawing has {}", dots_.size()));
            options.placement.step = *options.dot_spacing / distance_;
        }
        if (dots_.empty() && options.only_dots) {
            throw std::runtime_error("there is nothing to draw: the lines enclose no dots");
        }
    }

    /// Once the print is placed: its palette grows by the colours of what is added.
    void add_colours(Print& print) {
        drawn_ = print.style;
        Style& style = print.style;
        if (options_.colours_strokes) add_stroke_colours(style);
        if (print.style.dots) {
            dot_pen_.colour = static_cast<int>(style.palette.size());
            style.palette.push_back(style.dots->colour.value_or(
                options_.only_dots ? style.ground.value_or(style.line_colour({})) : style.line_colour({})));
            // To practise on, on white paper.
            if (options_.only_dots) style.ground = Colour{255, 255, 255, 255};
        }
        if (options_.border) {
            border_colour_ = static_cast<int>(style.palette.size());
            for (const Colour colour : border_colours(style.ground)) style.palette.push_back(colour);
            // The border is no part of what the drawing may fill.
            print.page.margin -= border_room(border_width_);
        }
    }

    std::size_t dots() const { return dots_.size(); }

    void draw(const Drawing& drawing, const Print& print, PathSink& sink) const {
        NotedDiscs noted(sink, print.style);
        PathSink& own = dots_.empty() ? sink : noted;
        OldColours lines(own, drawn_);
        if (options_.colours_strokes) {
            StrokeColours coloured(own, drawn_, stroke_colours_, orbit_of_stroke_);
            drawing.read(print, coloured);
        } else if (!options_.only_dots) {
            drawing.read(print, lines);
        }
        const double radius = dot_radius(print);
        // A dot drawn by the pattern itself is not repeated.
        std::optional<PointTree> drawn;
        if (!noted.places.empty()) drawn.emplace(noted.places);
        const double nearby = distance_ > 0 ? distance_ / 4 : 0.25;
        std::vector<PointTree::Near> found;
        for (const glm::dvec2 dot : dots_) {
            if (drawn) drawn->nearest(dot, nearby, 1, found);
            if (found.empty()) sink.disc(dot, radius, dot_pen_);
        }
        if (options_.border) draw_border(print, border_width_, border_colour_, sink);
    }

private:
    /// Colours of the pattern's own palette if they distinguish lines; otherwise, on dark ground, those of kolams.
    /// None is close to the ground.
    void add_stroke_colours(Style& style) {
        constexpr double least = 0.12;  // in OKLab
        const Colour ground = style.ground && style.ground->alpha > 0 ? *style.ground : Colour{255, 255, 255, 255};
        const auto is_seen = [&](Colour colour) { return colour_distance(colour, ground) >= least; };
        const bool is_dark = lightness(ground) < 0.6;
        if (!is_dark || style.palette != default_palette()) {
            const std::vector<int> slots = style.line_slots();
            for (int i = 0; i < static_cast<int>(slots.size()); ++i) {
                const Pen pen{.colour = i};
                if (slots[static_cast<std::size_t>(i)] == i && style.draws(pen) && is_seen(style.line_colour(pen))) {
                    stroke_colours_.push_back(i);
                }
            }
            if (stroke_colours_.size() > 1) return;
        }
        stroke_colours_.clear();
        for (const Colour colour : is_dark ? kolam_palette() : default_palette()) {
            if (!is_seen(colour)) continue;
            stroke_colours_.push_back(static_cast<int>(style.palette.size()));
            style.palette.push_back(colour);
        }
    }

    /// In steps.
    double dot_radius(const Print& print) const {
        if (!print.style.dots) return 0;
        const auto& size = print.style.dots->size;
        if (!size) return distance_ > 0 ? distance_ / 12 : 0.25;
        return size->value / (size->in_steps ? 1.0 : print.placement.step) / 2;
    }

    const DrawOptions& options_;
    std::vector<glm::dvec2> dots_;
    double distance_ = 0;  ///< between the nearest of them, in steps
    Style drawn_;          ///< with the palette of the drawing alone
    Pen dot_pen_;
    int border_colour_ = 0;
    double border_width_ = 0;                     ///< millimetres
    std::vector<std::uint32_t> orbit_of_stroke_;  ///< of its line
    std::vector<int> stroke_colours_;
};

void draw_travels(const PlotPlan& plan, const Print& print, PathSink& sink) {
    const double width = 0.1 / (print.style.stroke.in_steps ? print.placement.step : 1.0) / print.style.stroke.unit;
    const Pen pen{width, true, *print.travel_colour};
    for (const PlotTravel& travel : plan.travels()) {
        sink.begin_stroke(travel.from, pen);
        sink.lines(std::span(&travel.to, 1));
        sink.end_stroke(false);
    }
}

void draw_plot(const Drawing& drawing, const Composition& composition, Print print, const DrawOptions& options,
               Output& output, DrawReport& report) {
    print.is_plot = true;
    print.style = with_fill_pens(print.style);
    PlotOptions arranged = options.plot.value_or(PlotOptions{});
    arranged.monitor = options.monitor;
    if (options.format == PrintFormat::hpgl) {
        arranged.start = hpgl_origin(print.page, options.hpgl);
        arranged.home = arranged.start;
    } else if (options.format == PrintFormat::gcode) {
        arranged.home = gcode_home(options.gcode);
    }
    // Outlines are drawn even where lines are not.
    Print plotted = print;
    plotted.style.stroked = true;
    PlotPlan plan(drawing.is_spatial() ? plotted : print, arranged);
    composition.draw(drawing, print, plan);
    plan.arrange();
    report.plot = plan.report();
    if (is_for_plotters(options.format)) {
        const auto writer = options.format == PrintFormat::hpgl ? write_hpgl(plotted, options.hpgl, output)
                                                                : write_gcode(plotted, options.gcode, output);
        plan.draw(*writer);
        writer->finish();
        return;
    }
    if (options.shows_travel) {
        plotted.travel_colour = static_cast<int>(plotted.style.palette.size());
        plotted.style.palette.push_back({0x88, 0x88, 0x88, 255});
    }
    const auto writer = options.format == PrintFormat::svg ? write_svg(plotted, output) : write_pdf(plotted, output);
    plan.draw(*writer);
    if (options.shows_travel) draw_travels(plan, plotted, *writer);
    writer->finish();
}

/// Draws into whatever a format takes.
using Content = std::function<void(PathSink& sink)>;

/// @return is nothing of the drawing visible?
bool write_pixels(Rendering& rendering, const Print& print, const DrawOptions& options, Output& output,
                  const std::filesystem::path& file) {
    Picture picture(print, options, rendering.channels(), output, file);
    std::mutex mutex;
    const auto watch = [&] {
        const std::scoped_lock lock(mutex);
        if (options.watch) options.watch(0);
    };
    rendering.watch(watch);
    rendering.render(options.threads, [&](int first_row, int rows, std::span<const std::uint8_t> pixels) {
        watch();
        picture.rows(first_row, rows, pixels);
    });
    picture.close();
    return picture.is_blank();
}

/// @return is it a picture in which nothing of the drawing is visible?
bool write(const Content& content, const Print& given, const DrawOptions& options, Output& output,
           const std::filesystem::path& file) {
    // Only PDF knows the sheet from its bleed.
    const Print print = options.format == PrintFormat::pdf ? given : as_picture(given);
    if (is_vector(options.format)) {
        const auto writer = options.format == PrintFormat::svg ? write_svg(print, output) : write_pdf(print, output);
        content(*writer);
        writer->finish();
        return false;
    }
    const auto raster = make_raster(print);
    content(*raster);
    return write_pixels(*raster, print, options, output, file);
}

/// Each sheet is drawn from the whole word again, and keeps what is seen on it.
void draw_tiles(const Drawing& drawing, const Composition& composition, Print print, double widest,
                const DrawOptions& options, const std::filesystem::path& file, Destination& destination,
                DrawReport& report) {
    const int mark_colour = static_cast<int>(print.style.palette.size());
    const bool is_dark = print.style.ground && print.style.ground->red + print.style.ground->green < 256;
    const std::uint8_t grey = is_dark ? 0xc0 : 0x70;
    print.style.palette.push_back({grey, grey, grey, 255});
    const double around = widest / (print.style.stroke.in_steps ? 1.0 : print.placement.step);
    std::vector<std::unique_ptr<Output>> outputs;
    for (const Tile& tile : tiles_of(print.page, *options.tiles)) {
        const Print sheet = tile_print(print, tile, *options.tiles);
        outputs.push_back(destination.open(tile_file(file, tile)));
        const glm::dmat3x2& to_page = sheet.placement.to_page;
        const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(to_page[0], to_page[1]));
        Box seen;
        for (const double x : {0.0, sheet.page.width}) {
            for (const double y : {0.0, sheet.page.height}) seen.add(back * (glm::dvec2(x, y) - to_page[2]));
        }
        seen.low -= around;
        seen.high += around;
        const auto content = [&](PathSink& sink) {
            ClipSink clip(sink, seen);
            composition.draw(drawing, print, clip);
            draw_tile_marks(sheet, tile, *options.tiles, mark_colour, sink);
        };
        write(content, sheet, options, *outputs.back(), tile_file(file, tile));
    }
    for (const auto& output : outputs) output->commit();
    report.sheets = static_cast<int>(outputs.size());
}

/// Keeping a part of a scene takes the memory and time of about so many nodes.
constexpr double nodes_of_kept_part = 10;
/// Of a model, whose tubes have sides: of about so many.
constexpr double nodes_of_modelled_part = 200;

DerivationOptions reading(const DrawOptions& options) {
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.limit_whole_words(options.budget);
    derivation.watch = options.watch;
    return derivation;
}

/// Stems and spheres that are kept, as far as they are known beforehand.
double parts_of(const Grammar& grammar) {
    const auto known = estimate(grammar, true);
    if (!known) return 0;
    double parts = 0;
    for (std::size_t i = 0; i < std::min(known->rough_counts.size(), grammar.symbols().size()); ++i) {
        const Action action = grammar.symbols()[i].command.action;
        if (action == Action::draw || action == Action::disc) parts += known->rough_counts[i];
    }
    return parts;
}

/// @throws BudgetError, if there are more parts of a scene than `most`, before they are read
void require_room(const Grammar& grammar, double most) {
    const double parts = parts_of(grammar);
    if (parts <= most) return;
    std::int64_t fits = grammar.steps();
    for (bool is_found = false; !is_found && fits > 0;) {
        const auto other = grammar.with_steps(--fits);
        is_found = other && parts_of(*other) <= most;
    }
    throw BudgetError(fmt::format(
        "drawings in space are kept whole, and this one has {:.3g} segments and spheres (n = {}); the budget allows "
        "{:.0f}, up to n = {}",
        parts, grammar.steps(), most, fits));
}

Grammar resolved(const Grammar& given, const DrawOptions& options) {
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    return resolve_contexts(shorten(given), whole_words);
}

}  // namespace

Drawing::Drawing(const Grammar& grammar, const Style& style, const DrawOptions& options)
    : grammar_(resolved(grammar, options)), style_(style), options_(options), spline_(style.line == Line::spline) {
    require_affordable(grammar_, true, options.budget);
    drawn_style_ = grammar_.is_spatial() && is_vector(options.format) && !is_plot() ? with_shades(style) : style;
    if (grammar_.is_spatial() && spline_) {
        throw std::runtime_error("'line: spline' is for drawings in the plane; this one pitches, rolls or bends");
    }
    const std::vector<char> reached = grammar_.reachable();
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) continue;
        switch (grammar_.symbols()[i].command.action) {
            case Action::push:
            case Action::pop:
                has_brackets_ = true;
                break;
            case Action::polygon_begin:
            case Action::disc:
                has_areas_ = true;
                break;
            case Action::width_factor:
            case Action::width_set:
                has_widths_ = true;
                break;
            case Action::colour_step:
            case Action::colour_set:
                has_colours_ = true;
                break;
            default:
                break;
        }
    }
}

namespace {

void require_ink(const Box& box) {
    if (!box.empty()) return;
    throw std::runtime_error(
        "there is nothing to draw: the word holds no step that draws, no polygon, no disc, or none in a "
        "colour that is seen");
}

}  // namespace

const DrawnExtent& Drawing::extent() {
    require_ink(seen().box);
    return *extent_;
}

std::optional<SpaceBounds> Drawing::bounds() const {
    if (!scene_ || scene_->empty()) return std::nullopt;
    return scene_->bounds();
}

const DrawnExtent& Drawing::seen() {
    if (extent_) return *extent_;
    if (grammar_.is_spatial()) {
        if (options_.begin) options_.begin(1);
        require_room(grammar_, options_.budget / nodes_of_kept_part);
        scene_ = Scene::of(grammar_, style_, reading(options_), options_.budget / nodes_of_kept_part);
        const SceneExtent found = extent_of(*scene_, style_, orientation(options_.placement), options_.monitor);
        return extent_.emplace(DrawnExtent{found.box, found.widest});
    }
    // Straight lines that are all visible are folded for their extent; a spline without brackets and lifts is one
    // stroke, and is folded for whether it closes.
    const bool folds_extent = !spline_ && !has_areas_ && !has_widths_ && all_lines_are_seen();
    std::optional<Fold> folded;
    const bool is_one_stroke = spline_ && !has_brackets_ && style_.moves_draw();
    if (folds_extent || is_one_stroke) folded = fold(grammar_);
    const bool takes_census = spline_ && !folded;
    const bool reads_extent = spline_ || !folded;
    if (options_.begin) options_.begin(1 + (takes_census ? 1 : 0) + (reads_extent ? 1 : 0));

    if (takes_census) {
        StrokeCensus census;
        read_straight(census);
        closed_ = std::move(census.closed);
    } else if (spline_) {
        closed_ = {folded->closed};
    }
    const glm::dmat3x2 turned = orientation(options_.placement);
    ExtentSink extent(style_, turned);
    if (!reads_extent) {
        for (const glm::dvec2 corner : folded->ink_hull) extent.box.add(turned * glm::dvec3(corner, 1.0));
        extent.widest = style_.pen_width({});
    } else {
        read({}, extent);
    }
    return extent_.emplace(DrawnExtent{extent.box, extent.widest});
}

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

DrawReport Drawing::place(Print& print) {
    PlacementOptions placement = options_.placement;
    placement.scale = scale();
    const DrawnExtent& placed = options_.frame ? *options_.frame : extent();
    // Read for what is known of it in any case.
    seen();
    return place_print(print, placed, style_.stroke, placement);
}

void Drawing::read(const Print& print, PathSink& sink) const {
    if (scene_) {
        return is_plot() ? plot_scene(*scene_, print, options_.plot.value_or(PlotOptions{}), sink, options_.monitor)
                         : draw_solids(*scene_, print, sink, options_.monitor);
    }
    if (!spline_) return read_straight(sink);
    SplineSink spline(sink, closed_);
    const auto turtle = Turtle::outlining(grammar_, spline, spline, style_.moves_draw());
    derive(grammar_, *turtle, reading(options_));
}

void Drawing::read_straight(PathSink& sink) const {
    const auto turtle = Turtle::drawing(grammar_, sink, style_.moves_draw());
    derive(grammar_, *turtle, reading(options_));
}

std::unique_ptr<Rendering> Drawing::rendering(const Print& print) const {
    return scene_ ? make_solid_raster(*scene_, print) : nullptr;
}

bool Drawing::is_plot() const {
    return options_.plot || is_for_plotters(options_.format);
}

/// In every colour that may occur.
bool Drawing::all_lines_are_seen() const {
    const int colours = has_colours_ ? static_cast<int>(style_.palette.size()) : 1;
    for (int colour = 0; colour < colours; ++colour) {
        if (!style_.draws(Pen{.colour = colour})) return false;
    }
    return true;
}

DrawReport draw(const Grammar& given, Print print, const DrawOptions& given_options,
                const std::filesystem::path& file, Destination& destination) {
    DrawOptions options = given_options;
    if (!is_vector(options.format)) prepare_images(options.threads);
    // Once for both roads.
    const Grammar grammar = resolved(given, options);
    if (auto report = draw_view(grammar, print, options, file, destination)) return *report;
    if (grammar.is_spatial() && (print.style.dots || options.colours_strokes || options.border || print.animation)) {
        throw std::runtime_error("dots, colours by strand, borders and animations are for drawings in the plane");
    }
    Composition composition(grammar, print, options);
    Drawing drawing(grammar, print.style, options);
    DrawReport report = drawing.place(print);
    print.style = drawing.style();
    const bool is_plot = options.plot || is_for_plotters(options.format);
    if (options.tiles) {
        if (is_plot) throw std::runtime_error("a plot cannot be cut into sheets");
        if (grammar.is_spatial() && !is_vector(options.format)) {
            throw std::runtime_error("drawings in space are cut into sheets only as SVG or PDF");
        }
        if (options.placement.step) {
            // The page of the whole is as large as the drawing asks for.
            print.page.width = report.size.x + 2 * print.page.margin;
            print.page.height = report.size.y + 2 * print.page.margin;
            report = drawing.place(print);
        }
        composition.add_colours(print);
        check_spots(print.press, print.style);
        draw_tiles(drawing, composition, print, drawing.extent().widest, options, file, destination, report);
        return report;
    }
    const auto opened = destination.open(file);
    Output& output = *opened;
    report.dots = composition.dots();
    composition.add_colours(print);
    check_spots(print.press, print.style);
    if (is_plot) {
        draw_plot(drawing, composition, print, options, output, report);
    } else if (grammar.is_spatial() && !is_vector(options.format)) {
        print = as_picture(print);
        report.is_blank = write_pixels(*drawing.rendering(print), print, options, output, file);
    } else {
        const auto content = [&](PathSink& sink) { composition.draw(drawing, print, sink); };
        report.is_blank = write(content, print, options, output, file);
    }
    if (!is_vector(options.format)) {
        report.leaves_pattern_out = !keeps_text(info(options.format).extension, print.pattern);
    }
    output.commit();
    return report;
}

ModelReport draw_model(const Grammar& given, Print print, const DrawOptions& options, PrintFormat format,
                       const std::filesystem::path& file, Destination& destination) {
    if (print.style.line == Line::spline) {
        throw std::runtime_error("a model is of straight lines, and this drawing is of splines");
    }
    const Grammar grammar = resolved(given, options);
    require_affordable(grammar, true, options.budget);
    require_room(grammar, options.budget / nodes_of_modelled_part);
    if (options.begin) options.begin(1);
    const Scene scene = Scene::of(grammar, print.style, reading(options), options.budget / nodes_of_modelled_part);
    const SceneExtent seen = extent_of(scene, print.style, orientation(options.placement), options.monitor);
    require_ink(seen.box);
    PlacementOptions placement = options.placement;
    placement.scale *= grammar.scale_percent() / 100;
    place_print(print, {seen.box, seen.widest}, print.style.stroke, placement);
    return write_model(scene, print, format, file, options.monitor, destination);
}

}  // namespace sikku
