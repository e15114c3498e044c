#include "art/deep/seen_drawing.h"

#include "art/deep/spline_pieces.h"
#include "art/deep/view.h"
#include "art/deep/window_drawing.h"
#include "art/drawing/composition.h"
#include "art/drawing/drawing_cost.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/map_frames.h"
#include "art/drawing/repeated_drawing.h"
#include "art/drawing/word_drawing.h"
#include "art/raster/raster.h"
#include "art/tiles/tile_drawing.h"
#include "engine/base/threads.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/plain_form.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/clumps.h"
#include "engine/measure/fold.h"

#include <glm/geometric.hpp>
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

constexpr double nodes_a_pixel = 32;  // always allowed
constexpr double strip_chords = 4e6;  // approximate number kept at a time
constexpr double strip_pixels = 4e6;
constexpr int row_block = 32;  // strips are multiples of it: TIFF compresses this many rows at a time

constexpr double picture_bytes = 6e6;  // for the library, for each file
constexpr double clump_share = 0.6;    // share of clumps in the symbols that they contain

/// Ignores blots, for writers of lines, which never receive any.
class LinesOnly : public Forwarding<BlotSink> {
public:
    using Forwarding::Forwarding;
    std::size_t prepare(const Blot&, const Pen&) override { return 0; }
    void blot(std::size_t, glm::dvec2) override {}
};

/// Ignores everything.
class NothingSeen : public WithoutStrokes<BlotSink> {
public:
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
    std::size_t prepare(const Blot&, const Pen&) override { return 0; }
    void blot(std::size_t, glm::dvec2) override {}
};

/// Measures the length of lines; of curves by chords of an eighth.
class LengthSink : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { at_ = start; }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) add(end);
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Bezier curve{at_, controls[i], controls[i + 1], controls[i + 2]};
            for (int k = 1; k <= 8; ++k) add(point_of(curve, k / 8.0));
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

/// Ratio of the length of splines to that of the lines through their control points, computed for the largest
/// derivation length that costs little.
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

/// Longest part, in millimetres, that is replaced; with pens of a pixel or more, by chords.
double longest_replaced(double width, double pixel) {
    const double pixels = width / pixel;
    return pixels < 1 ? pixel / 2 : pixels < 2 ? width / 8 : width / 4;
}

/// Rows of pixels that are drawn at a time.
int strip_rows(double width, double pixel, PixelSize size) {
    const bool has_blots = width < pixel;
    // Parts that are replaced may be a third of the limit.
    const double share = 3 * pixel / longest_replaced(width, pixel);
    const double pixels = has_blots ? strip_pixels : strip_chords / std::max(1.0, share * share);
    return row_block * static_cast<int>(std::clamp(pixels / size.width / row_block, 1.0, 64.0));
}

/// Number of nodes allowed: by the budget, or at least some for each pixel.
double most_nodes(PixelSize size, double budget) {
    return std::max(budget, nodes_a_pixel * size.width * size.height);
}

/// True if the drawing contains more than a View shows.
bool is_composed(const Style& style, const DrawingOptions& options, const Reading& reading) {
    return has_ornaments(style, options) || has_tile_work(style) || style.hand > 0 || options.lesson_step ||
           options.colouring || has_frame(style, options) || options.repeat || reading.is_in_sheets ||
           reading.is_plot();
}

double longest_step(const Grammar& grammar) {
    double longest = 0;
    const std::vector<char> reached = grammar.reachable();
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
        const Command& command = grammar.symbols()[symbol].command;
        if (reached[symbol] && (command.action == Action::draw || command.action == Action::move)) {
            longest = std::max(longest, std::fabs(command.value));
        }
    }
    return longest;
}

DrawingReport place_seen(Print& print, const DrawnExtent& seen, const Grammar& grammar, PlacementOptions placement) {
    placement.scale *= grammar.scale_percent() / 100;
    return place_print(print, seen, print.style.stroke, placement);
}

/// Costs of a walk that replaces parts up to some extent.
struct WalkCount {
    double nodes = 0;     ///< examined
    double lines = 0;     ///< drawn, steps and chords
    double blots = 0;     ///< drawn
    double children = 0;  ///< children of all parts that may be entered
};
WalkCount count_walk(const Grammar& grammar, const Parts<double>& parts, double longest, bool has_blots) {
    struct Node {
        double nodes = 1, lines = 0, blots = 0;
    };
    std::vector<Node> all(parts.all().size());
    WalkCount count;
    std::vector<std::uint32_t> open;
    const auto sum = [&](const Word& word, int level, std::uint32_t heading) {
        Node node;
        open.clear();
        for (const Symbol child : word) {
            node.nodes += 1;
            if (grammar.is_push(child)) {
                open.push_back(heading);
            } else if (grammar.is_pop(child)) {
                heading = open.back();
                open.pop_back();
            } else if (!parts.occurs(level, heading)) {
                break;
            } else {
                const std::size_t index = parts.index(child, level, heading);
                node.nodes += all[index].nodes - 1;
                node.lines += all[index].lines;
                node.blots += all[index].blots;
                heading = (heading + parts.all()[index].turn) % parts.headings();
            }
        }
        return node;
    };
    for (int level = 0; level <= parts.levels(); ++level) {
        for (std::uint32_t heading = 0; heading < parts.headings(); ++heading) {
            if (!parts.occurs(level, heading)) continue;
            for (Symbol symbol = 0; symbol < grammar.symbols().size(); ++symbol) {
                const std::size_t index = parts.index(symbol, level, heading);
                const DrawnPart<double>& part = parts.all()[index];
                if (!part.draws()) continue;
                const Word* word = level > 0 ? parts.successor(symbol, level) : nullptr;
                if (level > 0) count.children += word ? static_cast<double>(word->size()) : 1;
                if (static_cast<double>(part.extent) <= longest) {
                    (has_blots ? all[index].blots : all[index].lines) = 1;
                } else if (level == 0) {
                    all[index].lines = 1;
                } else {
                    all[index] = word ? sum(*word, level - 1, heading) : all[parts.index(symbol, level - 1, heading)];
                }
            }
        }
    }
    const Node whole = sum(grammar.axiom(), parts.levels(), 0);
    count.nodes = whole.nodes;
    count.lines = whole.lines;
    count.blots = whole.blots;
    return count;
}

/// The extent of the window, or of the whole drawing within its box.
DrawnExtent extent_of(const DrawnPart<double>& whole, const Style& style, const DrawingOptions& options) {
    glm::dvec2 low = whole.low, high = whole.high;
    if (options.window) {
        low = glm::dvec2(0.0);
        high = {static_cast<double>(options.window->x1 - options.window->x0),
                static_cast<double>(options.window->y1 - options.window->y0)};
    }
    DrawnExtent seen;
    const glm::dmat3x2 turned = orientation(options.placement);
    if (options.window || whole.draws()) {
        for (const double x : {low.x, high.x}) {
            for (const double y : {low.y, high.y}) seen.box.add(turned * glm::dvec3(x, y, 1.0));
        }
    }
    // The drawing in a window continues around it.
    seen.widest = options.window ? 0 : style.pen_width({});
    return seen;
}

/// True if the drawing can be drawn from its parts; otherwise `why` receives the reason if there is a window.
bool may_be_seen(const Grammar& grammar, const Style& style, const DrawingOptions& options, const Reading& reading,
                 std::string& why) {
    const auto none = [&](const char* reason) {
        why = reason;
        return false;
    };
    if (reading.is_vector && !options.window) return false;
    if (grammar.is_spatial()) return none("drawings in space are always shown whole");
    if (is_composed(style, options, reading)) {
        return none(
            "dots, fields, weaves, parallel lines, borders, lines of text, repeats, colours by strand, hand-drawn "
            "lines, colours and edges of tiles, sheets and plots need the whole drawing");
    }
    if (style.moves_lift) return none("splines whose moves lift the pen need the whole drawing");
    if (!style.draws({})) return none("its lines are invisible");
    if (!options.window) {
        const auto cost = estimate(grammar, true);
        if (cost && cost->nodes <= most_read_symbols) return false;
    }
    return true;
}

}  // namespace

bool may_be_seen(const Grammar& grammar, const Style& style, const DrawingOptions& options, const Reading& reading) {
    std::string why;
    return may_be_seen(grammar, style, options, reading, why);
}

std::optional<Parts<double>> seen_parts(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                                        const Reading& reading, std::string& why) {
    if (!may_be_seen(grammar, style, options, reading, why)) return std::nullopt;
    auto parts = Parts<double>::make(grammar, style.line == Line::spline);
    if (!parts) {
        why =
            "a window needs a drawing in one pen, without polygons and discs, that turns by parts of 360 degrees and "
            "whose brackets close in the word in which they open";
    }
    return parts;
}

void require_window(const Grammar& grammar, const ReadingLimits& limits, const std::string& why) {
    if (grammar.is_spatial()) throw std::runtime_error("this drawing cannot be shown through a window: " + why);
    const auto plain = plain_form(grammar);
    try {
        require_affordable(plain ? *plain : grammar, true, limits.budget);
    } catch (const BudgetError&) {
        throw std::runtime_error("the window of this drawing needs its whole word, which is too long: " + why);
    }
}

DrawingCost seen_cost(const Grammar& grammar, const Parts<double>& parts, const Print& given,
                      const DrawingOptions& options, const Reading& reading) {
    Print print = given;
    place_seen(print, extent_of(parts.whole(), print.style, options), grammar, options.placement);
    const double step = print.placement.step;
    const double width = print.style.line_width({}, step);
    const bool has_pixels = !reading.is_vector;
    const double pixel = has_pixels ? 25.4 / print.dpi : 0;
    const bool has_blots = has_pixels && width < pixel;
    const double longest = has_pixels ? longest_replaced(width, pixel) : width / 4;
    // The lines of a spline are examined at its steps.
    const bool reads_steps = print.style.line == Line::spline && longest_step(grammar) > longest / step;
    const WalkCount walk = count_walk(grammar, parts, reads_steps ? -1.0 : longest / step, has_blots);
    const PixelSize size = pixel_size(print.page, print.dpi);
    const double allowed = has_pixels ? most_nodes(size, reading.budget) : reading.budget;
    DrawingCost cost;
    cost.nodes = walk.nodes;
    if (options.window) {
        const SeenDrawing drawing(std::make_shared<const Grammar>(grammar), parts, print.style, options, reading);
        cost.nodes = std::min(walk.nodes, drawing.expected_nodes(print, whole_page(print.page), pixel));
    }
    cost.nodes = std::min(cost.nodes, 2 * allowed);
    const double share = walk.nodes > 0 ? cost.nodes / walk.nodes : 0;
    cost.lines = cost.points = (walk.lines + walk.blots) * share;
    const double parts_count = static_cast<double>(parts.all().size());
    const double clumps = clump_share * walk.children;
    cost.kept_memory = parts_count * (options.window ? 320 : 224) + clumps * sizeof(Clump);
    cost.seconds = parts_count * seconds_of_part + walk.children * seconds_of_child + cost.nodes * seconds_of_node;
    cost.memory = cost.kept_memory + picture_bytes;
    if (!has_pixels) return cost;
    const double rows = std::min(strip_rows(width, pixel, size), size.height);
    const double lines = walk.lines * share * (reads_steps ? curve_lines(longest_step(grammar) * step / pixel) : 1);
    const double strips = std::max(1.0, size.height / rows);
    cost.points = lines + walk.blots * share;
    cost.lines_memory = lines * raster_line_bytes;
    cost.thread_memory = size.width * rows * (has_blots ? 7 : 3) + band_bytes({size.width, static_cast<int>(rows)}) +
                         std::min(lines, 2 * lines / strips) * raster_line_bytes;
    if (has_blots) cost.thread_memory += (parts_count + clumps) * 8 + std::min(parts_count + clumps, walk.blots) * 64;
    cost.memory += cost.thread_memory;
    // Each strip is walked into from above, and its pixels are drawn twice where there are blots.
    if (has_blots) cost.seconds += walk.blots * share * seconds_of_blot;
    return cost;
}

SeenDrawing::SeenDrawing(std::shared_ptr<const Grammar> grammar, Parts<double> parts, const Style& style,
                         const DrawingOptions& options, const Reading& reading)
    : Drawing(options, reading),
      grammar_(std::move(grammar)),
      style_(style),
      extent_(extent_of(parts.whole(), style, options)),
      spline_(style.line == Line::spline),
      longest_step_(longest_step(*grammar_)) {
    if (reading.begin) reading.begin(1);
    if (!options.window) {
        // Tighter than the box of all its headings.
        const auto folded = fold(*grammar_);
        if (!folded) throw std::runtime_error("the drawing is too large for its extent to be computed");
        const glm::dmat3x2 turned = orientation(options_.placement);
        extent_.box = {};
        for (const glm::dvec2 corner : spline_ ? folded->box_hull : folded->ink_hull) {
            extent_.box.add(turned * glm::dvec3(corner, 1.0));
        }
    }
    require_ink(extent_.box);
    if (spline_) spline_share_ = spline_share(*grammar_);
    view_ = View::make(*grammar_, std::move(parts), options_.window, spline_);
    if (!view_) throw std::runtime_error("the drawing is too large to be drawn");
}

Sight SeenDrawing::sight_of(const Print& print, const Window& window, double pixel) const {
    const double step = print.placement.step;
    const double width = print.style.line_width({}, step);
    const bool has_blots = width < pixel;
    Sight sight;
    sight.box = seen_box(print, window, width + 2 * pixel + print.press.bleed);
    (has_blots ? sight.blot : sight.chord) = (pixel > 0 ? longest_replaced(width, pixel) : width / 4) / step;
    // An invisible amount of ink: a hundred thousandth of a pixel, or a line shorter than 1/256 of its width.
    sight.least = (has_blots ? 1e-5 * pixel * pixel / width : width / 256) / step;
    return sight;
}

/// Curves differ from the lines through their control points only where steps are visible.
bool SeenDrawing::reads_steps(const Sight& sight) const {
    return spline_ && longest_step_ > std::max(sight.chord, sight.blot);
}

double SeenDrawing::expected_nodes(const Print& print, const Window& window, double pixel) const {
    constexpr double few = 1e6, coarser = 4;
    constexpr int most_tries = 64;
    Sight sight = sight_of(print, window, pixel);
    const bool has_blots = sight.blot >= 0, by_steps = reads_steps(sight);
    double& longest = has_blots ? sight.blot : sight.chord;
    const auto of_all = [&](double replaced) {
        return count_walk(*grammar_, view_->parts(), replaced, has_blots).nodes;
    };
    const double whole = of_all(by_steps ? -1.0 : longest);
    if (whole <= few) return whole;
    if (by_steps) {
        sight.least = 0;
        longest = longest_step_ / coarser;
    }
    const double fine = longest;
    for (int tries = 0; tries < most_tries; ++tries, longest *= coarser) {
        try {
            NothingSeen nothing;
            const auto seen = static_cast<double>(view_->read(sight, nothing, few, {}).visited);
            // A closer look increases the visible part by the same factor as the whole.
            const double more = whole / of_all(tries == 0 && by_steps ? -1.0 : longest);
            return seen * (std::isfinite(more) ? more : (longest / fine) * (longest / fine));
        } catch (const BudgetError&) {
            // Continues at a coarser level.
        }
    }
    return whole;
}

void SeenDrawing::require_affordable(const Print& print, const Window& window, double pixel, double budget) const {
    constexpr double certain = 1.5;  // the estimate is not exact
    if (expected_nodes(print, window, pixel) > certain * budget) throw too_much(budget);
}

void SeenDrawing::read(const Print& print, const Window& window, double pixel, BlotSink& sink, double budget,
                       const std::function<void(std::uint64_t)>& watch) const {
    Sight sight = sight_of(print, window, pixel);
    if (!reads_steps(sight)) {
        sight.ink = spline_ ? spline_share_ : 1;
        return add(view_->read(sight, sink, budget, watch));
    }
    sight.chord = sight.blot = -1;
    sight.least = 0;
    // Where a line enters the visible part, its curve is wrong for a few steps.
    const glm::dvec2 around(6 * longest_step_);
    sight.box.low -= around;
    sight.box.high += around;
    SplinePieces pieces(sink, 1e-6 * longest_step_);
    add(view_->read(sight, pieces, budget, watch));
}

void SeenDrawing::add(const ViewReport& report) const {
    const std::scoped_lock lock(reporting_);
    found_.lines += report.lines;
    found_.chords += report.chords;
    found_.blots += report.blots;
}

void SeenDrawing::report(DrawingReport& report) const {
    report.replaced = found_.chords + found_.blots;
    report.is_empty = options_.window && found_.lines + found_.blots == 0;
}

void SeenDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    require_affordable(print, window, 0, reading_.budget);
    LinesOnly lines(sink);
    read(print, window, 0, lines, reading_.budget, reading_.watch);
}

namespace {

/// A print of some rows of the page.
struct Strip {
    Strip(const Print& whole, int first, int count) : print(whole) {
        print.page.height = count * 25.4 / print.dpi;
        print.placement.to_page[2].y -= first * 25.4 / print.dpi;
        print.floor_corner.y += first * 25.4 / print.dpi;
        raster = make_raster(print);
        raster->expect({});
    }
    Strip(const Strip&) = delete;
    Strip& operator=(const Strip&) = delete;
    Print print;
    std::unique_ptr<Raster> raster;
};

/// A picture rendered in strips. Memory: the strips in progress; for render_rows(), all visible lines.
class StripRendering : public Rendering {
public:
    StripRendering(const SeenDrawing& drawing, const Print& print, const Window& window)
        : drawing_(drawing),
          print_(print),
          window_(window),
          size_(pixel_size(print.page, print.dpi)),
          pixel_(25.4 / print.dpi),
          most_(most_nodes(size_, drawing.reading().budget)) {}

    int channels() const override { return Strip(print_, 0, row_block).raster->channels(); }
    void watch(std::function<void()> watch) override { watch_ = std::move(watch); }
    void render(int threads, const RowSink& sink) override;
    void render_rows(int first, int end, int channels, const RowSink& rows) const override {
        whole().render_rows(first, end, channels, rows);
    }

private:
    struct Rows {
        int first = 0;
        int count = 0;
        std::vector<std::uint8_t> pixels;
    };
    void draw(Rows& rows);
    void count(std::uint64_t nodes);
    const Raster& whole() const;

    const SeenDrawing& drawing_;
    const Print print_;
    const Window window_;
    const PixelSize size_;
    const double pixel_;
    const double most_;
    std::function<void()> watch_;
    std::mutex counting_;
    double nodes_ = 0;
    mutable std::once_flag once_;
    mutable std::unique_ptr<Raster> whole_;
};

void StripRendering::count(std::uint64_t nodes) {
    {
        const std::scoped_lock lock(counting_);
        nodes_ += static_cast<double>(nodes);
        if (nodes_ > most_) throw too_much(most_);
    }
    if (drawing_.reading().watch) drawing_.reading().watch(nodes);
}

void StripRendering::draw(Rows& rows) {
    const Strip made(print_, rows.first, rows.count);
    drawing_.read(made.print, whole_page(made.print.page), pixel_, *made.raster, most_,
                  [this](std::uint64_t nodes) { count(nodes); });
    if (watch_) made.raster->watch(watch_);
    rows.pixels.reserve(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(made.raster->channels()) *
                        static_cast<std::size_t>(rows.count));
    made.raster->render(1, [&](int, int, std::span<const std::uint8_t> part) {
        rows.pixels.insert(rows.pixels.end(), part.begin(), part.end());
    });
}

void StripRendering::render(int threads, const RowSink& sink) {
    nodes_ = 0;
    const int rows = strip_rows(print_.style.line_width({}, print_.placement.step), pixel_, size_);
    threads = thread_count(threads);
    std::vector<Rows> strips(static_cast<std::size_t>(threads));
    on_threads(threads, [&] {
        in_order(
            static_cast<std::size_t>((size_.height + rows - 1) / rows), strips.size(),
            [&](std::size_t i, std::size_t place) {
                Rows& strip = strips[place];
                strip.first = static_cast<int>(i) * rows;
                strip.count = std::min(rows, size_.height - strip.first);
                strip.pixels.clear();
                draw(strip);
            },
            [&](std::size_t, std::size_t place) {
                sink(strips[place].first, strips[place].count, strips[place].pixels);
            });
    });
}

/// All visible lines, from a single walk.
const Raster& StripRendering::whole() const {
    std::call_once(once_, [this] {
        auto raster = make_raster(print_);
        raster->expect({});
        const Reading& reading = drawing_.reading();
        drawing_.read(print_, window_, pixel_, *raster, reading.budget, reading.watch);
        if (watch_) raster->watch(watch_);
        whole_ = std::move(raster);
    });
    return *whole_;
}

}  // namespace

std::unique_ptr<Rendering> SeenDrawing::rendering(const Print& print, const Window& window) const {
    require_affordable(print, window, 25.4 / print.dpi,
                       most_nodes(pixel_size(print.page, print.dpi), reading_.budget));
    return std::make_unique<StripRendering>(*this, print, window);
}

}  // namespace sikku
