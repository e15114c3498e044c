#include "art/draw_view.h"

#include "art/output_file.h"
#include "art/pdf.h"
#include "art/picture.h"
#include "art/raster.h"
#include "art/spline_pieces.h"
#include "art/svg.h"
#include "art/threads.h"
#include "art/view.h"
#include "engine/derivation.h"
#include "engine/fold.h"
#include "engine/forecast.h"
#include "engine/turtle.h"

#include <oneapi/tbb/parallel_pipeline.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double nodes_a_pixel = 32;  // that are always allowed for
constexpr double strip_chords = 4e6;  // about as many are kept at a time
constexpr double strip_pixels = 4e6;
constexpr int row_block = 32;  // strips are multiples of it: TIFF compresses so many rows at a time

/// Takes blots for nothing: for writers of lines, to whom none is sent.
class LinesOnly : public BlotSink {
public:
    explicit LinesOnly(PathSink& sink) : sink_(sink) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, pen); }
    void lines(std::span<const glm::dvec2> ends) override { sink_.lines(ends); }
    void curves(std::span<const glm::dvec2> controls) override { sink_.curves(controls); }
    void change_pen(const Pen& pen) override { sink_.change_pen(pen); }
    void end_stroke(bool closed) override { sink_.end_stroke(closed); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { sink_.polygon(vertices, pen); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override { sink_.disc(centre, radius, pen); }
    std::size_t prepare(const Blot&, const Pen&) override { return 0; }
    void blot(std::size_t, glm::dvec2) override {}

private:
    PathSink& sink_;
};

/// What lies on the page between two heights (millimetres from its top), as the drawing sees it.
Box seen_box(const Print& print, double top, double bottom, double around) {
    const glm::dmat3x2& to_page = print.placement.to_page;
    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(to_page[0], to_page[1]));
    Box box;
    for (const double x : {-around, print.page.width + around}) {
        for (const double y : {top - around, bottom + around}) box.add(back * (glm::dvec2(x, y) - to_page[2]));
    }
    return box;
}

/// Length of what passes; of curves by chords of an eighth.
class LengthSink : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) add(end);
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const glm::dvec2 start = at_;
            for (int k = 1; k <= 8; ++k) {
                const double t = k / 8.0;
                const double u = 1 - t;
                add(u * u * u * start + 3 * u * u * t * controls[i] + 3 * u * t * t * controls[i + 1] +
                    t * t * t * controls[i + 2]);
            }
        }
    }
    void change_pen(const Pen&) override {}
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}

    double length = 0;

private:
    void add(glm::dvec2 point) {
        length += glm::length(point - at_);
        at_ = point;
    }
    glm::dvec2 at_{0.0};
};

/// How much shorter splines are than the lines through their control points: of the largest derivation length that
/// costs little.
double spline_share(const Grammar& grammar) {
    constexpr double little = 3e5;
    for (std::int64_t n = std::min<std::int64_t>(grammar.steps(), 64); n >= 0; --n) {
        const auto smaller = grammar.with_steps(n);
        if (!smaller) continue;
        const auto cost = estimate(*smaller, true);
        if (!cost || cost->nodes > little) continue;
        LengthSink straight;
        LengthSink curved;
        const std::vector<bool> all_open;
        SplineSink spline(curved, all_open);
        DerivationOptions interpreted;
        interpreted.interpreted = true;
        derive(*smaller, *Turtle::drawing(*smaller, straight, true), interpreted);
        derive(*smaller, *Turtle::drawing(*smaller, spline, true), interpreted);
        if (straight.length > 0) return curved.length / straight.length;
    }
    return 1;
}

class ViewDrawer {
public:
    ViewDrawer(const Grammar& grammar, Print& print, const DrawOptions& options)
        : grammar_(grammar), print_(print), options_(options), spline_(print.style.line == Line::spline) {}

    /// False if the drawing has no view.
    bool look() {
        view_ = View::make(grammar_, options_.window, spline_);
        return view_ != nullptr;
    }

    DrawReport place() {
        const glm::dmat3x2 turned = orientation(options_.placement);
        DrawnExtent seen;
        const auto add = [&](glm::dvec2 corner) { seen.box.add(turned * glm::dvec3(corner, 1.0)); };
        if (options_.window) {
            const auto width = static_cast<double>(options_.window->x1 - options_.window->x0);
            const auto height = static_cast<double>(options_.window->y1 - options_.window->y0);
            for (const glm::dvec2 corner :
                 {glm::dvec2(0, 0), glm::dvec2(width, 0), glm::dvec2(0, height), glm::dvec2(width, height)}) {
                add(corner);
            }
        } else {
            const auto folded = fold(grammar_);
            if (!folded) throw std::runtime_error("the drawing is too large for its extent to be worked out");
            for (const glm::dvec2 corner : spline_ ? folded->box_hull : folded->ink_hull) add(corner);
        }
        if (seen.box.empty()) throw std::runtime_error("there is nothing to draw: the word holds no step that draws");
        // What a window shows goes on around it.
        seen.widest = options_.window ? 0 : print_.style.pen_width({});
        PlacementOptions placement = options_.placement;
        placement.scale *= grammar_.scale_percent() / 100;
        const DrawReport report = place_print(print_, seen, print_.style.stroke, placement);
        width_ = print_.style.line_width({}, report.step);
        return report;
    }

    /// Longest part, in millimetres, that is replaced; by chords under a pen of a pixel and more.
    double limit(double pixel) const {
        const double pixels = width_ / pixel;
        return pixels < 1 ? pixel / 2 : pixels < 2 ? width_ / 8 : width_ / 4;
    }

    /// Ink, in steps, of a line that leaves nothing to see: a hundred thousandth of a pixel, or what is that much
    /// shorter than a line is wide.
    double least(double pixel) const {
        return (width_ < pixel ? 1e-5 * pixel * pixel / width_ : width_ / 256) / print_.placement.step;
    }

    ViewReport draw_lines(PrintWriter& writer) const {
        Sight sight;
        sight.box = seen_box(print_, 0, print_.page.height, width_ + print_.press.bleed);
        sight.chord = width_ / 4 / print_.placement.step;
        sight.least = width_ / 256 / print_.placement.step;
        LinesOnly lines(writer);
        return read(sight, lines, options_.budget, options_.watch);
    }

    ViewReport draw_pixels(OutputFile& output, const std::filesystem::path& file) {
        const PixelSize size = pixel_size(print_.page, print_.dpi);
        const double pixel = 25.4 / print_.dpi;
        const double longest = limit(pixel);
        const bool has_blots = width_ < pixel;
        if (has_blots && spline_) spline_share_ = spline_share(grammar_);
        // Parts that are replaced may be a third of the limit.
        const double density = std::max(1.0, (3 * pixel / longest) * (3 * pixel / longest));
        const double pixels = has_blots ? strip_pixels : strip_chords / density;
        const int blocks = static_cast<int>(std::clamp(pixels / size.width / row_block, 1.0, 64.0));
        const int rows = blocks * row_block;
        most_nodes_ = std::max(options_.budget, nodes_a_pixel * size.width * size.height);

        const int channels = make_strip(0, row_block).raster->channels();
        Picture picture(print_, options_, channels, output, file);
        const int threads = thread_count(options_.threads);
        struct Rows {
            int first = 0;
            int count = 0;
            std::vector<std::uint8_t> pixels;
        };
        using Token = std::shared_ptr<Rows>;
        ViewReport all;
        int next = 0;
        using oneapi::tbb::filter_mode;
        const auto strips = oneapi::tbb::make_filter<void, Token>(
            filter_mode::serial_in_order, [&](oneapi::tbb::flow_control& control) -> Token {
                if (next >= size.height) {
                    control.stop();
                    return nullptr;
                }
                auto strip = std::make_shared<Rows>(Rows{next, std::min(rows, size.height - next), {}});
                next += strip->count;
                return strip;
            });
        const auto draw = oneapi::tbb::make_filter<Token, Token>(filter_mode::parallel, [&](Token strip) {
            const Strip made = make_strip(strip->first, strip->count);
            Sight sight;
            const double top = strip->first * pixel;
            sight.box = seen_box(print_, top, top + strip->count * pixel, width_ + 2 * pixel);
            (has_blots ? sight.blot : sight.chord) = longest / print_.placement.step;
            sight.least = least(pixel);
            const ViewReport report = read(sight, *made.raster, most_nodes_, [&](std::uint64_t n) { watch(n); });
            strip->pixels.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels) *
                                  static_cast<std::size_t>(strip->count));
            made.raster->render(1, [&](int, int, std::span<const std::uint8_t> part) {
                strip->pixels.insert(strip->pixels.end(), part.begin(), part.end());
            });
            const std::scoped_lock lock(mutex_);
            all.visited += report.visited;
            all.chords += report.chords;
            all.blots += report.blots;
            return strip;
        });
        const auto hand_on = oneapi::tbb::make_filter<Token, void>(
            filter_mode::serial_in_order,
            [&](const Token& strip) { picture.rows(strip->first, strip->count, strip->pixels); });
        on_threads(threads, [&] {
            oneapi::tbb::parallel_pipeline(static_cast<std::size_t>(threads), strips & draw & hand_on);
        });
        picture.close();
        return all;
    }

private:
    /// Curves are told from the lines through their control points only where steps are.
    ViewReport read(Sight sight, BlotSink& sink, double budget,
                    const std::function<void(std::uint64_t)>& watch) const {
        if (!spline_ || longest_step() <= std::max(sight.chord, sight.blot)) {
            sight.ink = spline_share_;
            return view_->read(sight, sink, budget, watch);
        }
        sight.chord = sight.blot = -1;
        sight.least = 0;
        // Where a line enters what is seen, its curve is wrong for a few steps.
        const glm::dvec2 around(6 * longest_step());
        sight.box.low -= around;
        sight.box.high += around;
        SplinePieces pieces(sink, 1e-6 * longest_step());
        return view_->read(sight, pieces, budget, watch);
    }

    double longest_step() const {
        double longest = 0;
        const std::vector<char> reached = grammar_.reachable();
        for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
            const Command& command = grammar_.symbols()[symbol].command;
            if (reached[symbol] && (command.action == Action::draw || command.action == Action::move)) {
                longest = std::max(longest, std::fabs(command.value));
            }
        }
        return longest;
    }

    /// A page of some rows of the page.
    struct Strip {
        std::unique_ptr<Print> print;
        std::unique_ptr<Raster> raster;
    };
    Strip make_strip(int first, int count) const {
        Strip strip;
        strip.print = std::make_unique<Print>(print_);
        strip.print->page.height = count * 25.4 / print_.dpi;
        strip.print->placement.to_page[2].y -= first * 25.4 / print_.dpi;
        strip.raster = make_raster(*strip.print);
        strip.raster->expect({});
        return strip;
    }

    void watch(std::uint64_t nodes) {
        const std::scoped_lock lock(mutex_);
        nodes_ += static_cast<double>(nodes);
        if (nodes_ > most_nodes_) throw too_much(most_nodes_);
        if (options_.watch) options_.watch(nodes);
    }

    const Grammar& grammar_;
    Print& print_;
    const DrawOptions& options_;
    std::unique_ptr<View> view_;
    bool spline_;
    double spline_share_ = 1;
    double width_ = 0;  ///< of the pen, millimetres
    double most_nodes_ = 0;
    double nodes_ = 0;
    std::mutex mutex_;
};

}  // namespace

std::optional<DrawReport> draw_view(const Grammar& grammar, Print print, const DrawOptions& options,
                                    const std::filesystem::path& file) {
    const bool is_vector = options.format == PrintFormat::svg || options.format == PrintFormat::pdf;
    const auto none = [&](const char* why) -> std::optional<DrawReport> {
        if (options.window) throw std::runtime_error(std::string("--window: ") + why);
        return std::nullopt;
    };
    if (is_vector && !options.window) return std::nullopt;
    if (!print.style.draws({})) return none("lines that leave no ink are not seen");
    if (!options.window) {
        const auto cost = estimate(grammar, true);
        if (cost && cost->nodes <= most_read_symbols) return std::nullopt;
    }
    ViewDrawer drawer(grammar, print, options);
    if (!drawer.look()) {
        return none(
            "only drawings in one pen, without polygons and discs, whose brackets close in the word in which they "
            "open, are seen through a window");
    }
    if (options.begin) options.begin(1);
    OutputFile output(file);
    DrawReport report = drawer.place();
    check_spots(print.press, print.style);
    if (options.format != PrintFormat::pdf) print = as_picture(std::move(print));
    ViewReport seen;
    if (is_vector) {
        const auto writer = options.format == PrintFormat::svg ? write_svg(print, output) : write_pdf(print, output);
        seen = drawer.draw_lines(*writer);
        writer->finish();
    } else {
        seen = drawer.draw_pixels(output, file);
        report.leaves_pattern_out = !keeps_text(image_format(options.format), print.pattern);
    }
    report.replaced = seen.chords + seen.blots;
    output.commit();
    return report;
}

}  // namespace sikku
