#include "art/draw.h"

#include "art/draw_view.h"
#include "art/image_file.h"
#include "art/output_file.h"
#include "art/pdf.h"
#include "art/picture.h"
#include "art/raster.h"
#include "art/svg.h"
#include "engine/fold.h"
#include "engine/spline.h"
#include "engine/text.h"
#include "engine/turtle.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

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
    void change_pen(const Pen& pen) override {
        draws_ = style_.draws(pen);
        width_ = style_.pen_width(pen);
    }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        for (const glm::dvec2 vertex : vertices) box.add(turned(vertex));
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

void draw_pixels(const Drawing& drawing, const Print& print, const DrawOptions& options, OutputFile& output,
                 const std::filesystem::path& file) {
    const auto raster = make_raster(print);
    drawing.read(*raster);
    Picture picture(print, options, raster->channels(), output, file);
    raster->render(options.threads, [&](int first_row, int rows, std::span<const std::uint8_t> pixels) {
        if (options.watch) options.watch(0);
        picture.rows(first_row, rows, pixels);
    });
    picture.close();
}

Grammar resolved(const Grammar& given, const DrawOptions& options) {
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    return resolve_contexts(shorten(given), whole_words);
}

}  // namespace

std::string image_format(PrintFormat format) {
    switch (format) {
        case PrintFormat::tiff:
            return "tif";
        case PrintFormat::jpeg:
            return "jpg";
        case PrintFormat::exr:
            return "exr";
        default:
            return "png";
    }
}

Drawing::Drawing(const Grammar& grammar, const Style& style, const DrawOptions& options)
    : grammar_(resolved(grammar, options)), style_(style), options_(options), spline_(style.line == Line::spline) {
    require_affordable(grammar_, true, options.budget);
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

const DrawnExtent& Drawing::extent() {
    if (extent_) return *extent_;
    // Straight lines that are all seen are folded for their extent; a spline without brackets is one stroke, and
    // is folded for whether it closes.
    const bool folds_extent = !spline_ && !has_areas_ && !has_widths_ && all_lines_are_seen();
    std::optional<Fold> folded;
    if (folds_extent || (spline_ && !has_brackets_)) folded = fold(grammar_);
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
        read(extent);
    }
    if (extent.box.empty()) {
        throw std::runtime_error(
            "there is nothing to draw: the word holds no step that draws, no polygon, no disc, or none in a "
            "colour that is seen");
    }
    return extent_.emplace(extent.box, extent.widest);
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
    report.overflows = report.size.x > print.page.width - 2 * print.page.margin + 1e-6 ||
                       report.size.y > print.page.height - 2 * print.page.margin + 1e-6;
    return report;
}

DrawReport Drawing::place(Print& print) {
    PlacementOptions placement = options_.placement;
    placement.scale = scale();
    return place_print(print, extent(), style_.stroke, placement);
}

void Drawing::read(PathSink& sink) const {
    if (!spline_) return read_straight(sink);
    SplineSink spline(sink, closed_);
    read_straight(spline);
}

void Drawing::read_straight(PathSink& sink) const {
    const auto turtle = Turtle::drawing(grammar_, sink, spline_);
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.watch = options_.watch;
    derive(grammar_, *turtle, derivation);
}

/// In every colour that may occur.
bool Drawing::all_lines_are_seen() const {
    const int colours = has_colours_ ? static_cast<int>(style_.palette.size()) : 1;
    for (int colour = 0; colour < colours; ++colour) {
        if (!style_.draws(Pen{.colour = colour})) return false;
    }
    return true;
}

std::optional<PrintFormat> print_format(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    if (extension == ".svg") return PrintFormat::svg;
    if (extension == ".pdf") return PrintFormat::pdf;
    if (extension == ".png") return PrintFormat::png;
    if (extension == ".tif" || extension == ".tiff") return PrintFormat::tiff;
    if (extension == ".jpg" || extension == ".jpeg") return PrintFormat::jpeg;
    if (extension == ".exr") return PrintFormat::exr;
    return std::nullopt;
}

DrawReport draw(const Grammar& given, Print print, const DrawOptions& options, const std::filesystem::path& file) {
    // Once for both roads.
    const Grammar grammar = resolved(given, options);
    if (auto report = draw_view(grammar, print, options, file)) return *report;
    Drawing drawing(grammar, print.style, options);
    OutputFile output(file);
    DrawReport report = drawing.place(print);
    if (options.format == PrintFormat::svg || options.format == PrintFormat::pdf) {
        const auto writer = options.format == PrintFormat::svg ? write_svg(print, output) : write_pdf(print, output);
        drawing.read(*writer);
        writer->finish();
    } else {
        draw_pixels(drawing, print, options, output, file);
        report.leaves_pattern_out = !keeps_text(image_format(options.format), print.pattern);
    }
    output.commit();
    return report;
}

}  // namespace sikku
