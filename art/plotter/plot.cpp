#include "art/plotter/plot.h"

#include "art/plotter/pens.h"
#include "art/plotter/plot_course.h"
#include "art/plotter/plot_join.h"
#include "art/plotter/plot_layer.h"
#include "art/plotter/plot_route.h"
#include "engine/base/option.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/contours.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

using Index = std::uint32_t;
constexpr std::size_t most_points = 1'000'000'000;
constexpr std::size_t points_in_block = 1024;
constexpr double thinnest = 0.05;  // millimetres; least pen width for fills

}  // namespace

/// The drawing of one pen: stretches of points, in drawing order.
struct PlotPlan::Gathered {
    enum class Kind : std::uint8_t { start, lines, curves };
    struct Run {
        Kind kind;
        Index points;
    };
    void add(Kind kind, std::span<const glm::dvec2> more) {
        for (const glm::dvec2 point : more) {
            if (!(std::fabs(point.x) < 1e300 && std::fabs(point.y) < 1e300)) {
                throw std::runtime_error("a point of the drawing is not finite: it cannot be plotted");
            }
            box.add(point);
        }
        if (points.size() + more.size() > most_points) {
            throw std::runtime_error("the drawing has too many points to be arranged for a plotter");
        }
        if (kind == Kind::start || runs.empty() || runs.back().kind != kind) runs.push_back({kind, 0});
        runs.back().points += static_cast<Index>(more.size());
        points.insert(points.end(), more.begin(), more.end());
    }

    /// Calls `visit(kind, from, points)` for each line and curve, and for each start with its point twice.
    template <class Visit>
    void for_each(Visit&& visit) const {
        const glm::dvec2* next = points.data();
        glm::dvec2 at(0.0);
        for (const Run& run : runs) {
            const std::size_t stride = run.kind == Kind::curves ? 3 : 1;
            for (std::size_t i = 0; i < run.points; i += stride, next += stride) {
                visit(run.kind, run.kind == Kind::start ? *next : at, std::span(next, stride));
                at = next[stride - 1];
            }
        }
    }
    void append(const Gathered& other) {
        if (points.size() + other.points.size() > most_points) {
            throw std::runtime_error("the drawing has too many points to be arranged for a plotter");
        }
        points.insert(points.end(), other.points.begin(), other.points.end());
        runs.insert(runs.end(), other.runs.begin(), other.runs.end());
        has_lines |= other.has_lines;
        has_discs |= other.has_discs;
        has_hatch |= other.has_hatch;
        if (other.widths.most > 0) {
            add_width(other.widths.least, other.pen);
            widths.most = std::max(widths.most, other.widths.most);
        }
    }
    std::size_t segments() const {
        std::size_t count = 0;
        for (const Run& run : runs) {
            count += run.kind == Kind::curves ? run.points / 3 : run.kind == Kind::lines ? run.points : 0;
        }
        return count;
    }

    /// Adds the width of a stroke; the pen takes the least width.
    void add_width(double width, const Pen& of) {
        if (widths.most == 0 || width < widths.least) {
            widths.least = width;
            pen.width = of.width;
            pen.width_set = of.width_set;
        }
        widths.most = std::max(widths.most, width);
    }

    Pen pen;
    StrokeWidths widths;
    Box box;
    std::vector<glm::dvec2> points;
    std::vector<Run> runs;
    bool has_lines = false;  ///< draws lines
    bool has_discs = false;  ///< fills discs
    bool has_hatch = false;
};

namespace {

/// Calls `visit(from, points)` for a line or a curve, cut into parts of at most `longest`.
template <class Visit>
void cut(glm::dvec2 from, std::span<const glm::dvec2> points, double longest, Visit&& visit) {
    if (points.size() == 1) {
        const double count = std::ceil(glm::distance(from, points[0]) / longest);
        if (!(count > 1)) return visit(from, points);
        glm::dvec2 at = from;
        for (double i = 1; i <= count; ++i) {
            const glm::dvec2 end = i < count ? from + (points[0] - from) * (i / count) : points[0];
            visit(at, std::span(&end, 1));
            at = end;
        }
        return;
    }
    const CubicBezier whole = {from, points[0], points[1], points[2]};
    const double count = std::ceil(bezier_length(whole) / longest);
    if (!(count > 1)) return visit(from, points);
    // Parts of equal steps of the parameter differ in length.
    const CubicBezier first = part_of(whole, 0, 0.5), second = part_of(whole, 0.5, 1);
    cut(from, std::span(first).subspan(1), longest, visit);
    cut(first[3], std::span(second).subspan(1), longest, visit);
}

/// The pen-up travel and the lifts of strokes in their order, and their end.
struct PlotWay {
    PlotTally tally;
    glm::dvec2 end{0.0};
};
PlotWay way_of(const PlotGraph& graph, const PlotStrokes& strokes, glm::dvec2 from, double millimetres,
               const Monitor& monitor) {
    PlotWay way{{}, from};
    Pulse pulse(monitor);
    for (const PlotStroke& stroke : strokes.strokes) {
        const auto ends = strokes.ends(stroke);
        way.tally.travelled += millimetres * glm::distance(way.end, graph.point(ends.front()));
        ++way.tally.lifts;
        for (const PlotEnd end : ends) {
            pulse();
            way.tally.drawn += millimetres * graph.length(end);
        }
        way.end = graph.point(ends.back() ^ 1U);
    }
    return way;
}

/// True if the plot takes longer or lifts the pen more often than another. Points that were merged move lines by less
/// than a billionth.
bool is_worse(const PlotTally& plot, const PlotTally& other, const PlotSpeeds& speeds) {
    constexpr double slack = 1 + 1e-6;
    return plot.lifts > other.lifts || plot_seconds(plot, speeds) > slack * plot_seconds(other, speeds);
}

}  // namespace

/// Numbers the points and leaves out repeated segments. `at` is the place where the last pen was lifted.
void PlotPlan::read_layer(Gathered& from, double tolerance, glm::dvec2& at, PlotLayer& layer) {
    const double millimetres = print_.placement.step;
    const std::optional<Refill>& refill = layer.settings.refill ? layer.settings.refill : options_.refill;
    const double longest = refill ? refill->length / millimetres : std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    from.for_each([&](Gathered::Kind kind, glm::dvec2 begin, std::span<const glm::dvec2> next) {
        if (kind != Gathered::Kind::start) cut(begin, next, longest, [&](auto, auto) { ++count; });
        if (count > most_points) throw std::runtime_error("the drawing is too long to be cut for refilling the pen");
    });
    PlotNodes table(tolerance, count);
    PlotSegmentSet set(layer.graph.segments, count);
    layer.graph.segments.reserve(count);
    PlotStrokes& drawn = layer.as_drawn;
    drawn.order.reserve(count);
    Pulse pulse(options_.monitor);
    Index here = 0;
    const auto add = [&](glm::dvec2 begin, std::span<const glm::dvec2> next) {
        const Index end = table.at(next.back());
        PlotSegment segment{here, end};
        if (next.size() == 3) {
            ++report_.curves;
            segment.first = table.at(next[0]);
            segment.second = table.at(next[1]);
            report_.before.drawn += millimetres * bezier_length({begin, next[0], next[1], next[2]});
        } else {
            report_.before.drawn += millimetres * glm::distance(begin, next[0]);
        }
        const auto [entered, is_new] = set.add_or_find(segment);
        if (!is_new) layer.repeated.push_back(segment);
        drawn.order.push_back(entered);
        ++drawn.strokes.back().count;
        here = end;
    };
    constexpr std::ptrdiff_t later = 32, soon = 12;  // points to be numbered until then
    const glm::dvec2* const last = from.points.data() + from.points.size();
    from.for_each([&](Gathered::Kind kind, glm::dvec2 begin, std::span<const glm::dvec2> next) {
        pulse();
        if (last - next.data() > later) table.expect(next.data()[later], next.data()[soon]);
        if (kind == Gathered::Kind::start) {
            report_.before.travelled += millimetres * glm::distance(at, next[0]);
            ++report_.before.lifts;
            here = table.at(next[0]);
            drawn.strokes.push_back({static_cast<Index>(drawn.order.size()), 0, false});
        } else {
            cut(begin, next, longest, add);
        }
        at = next.back();
    });
    report_.segments += count;
    layer.graph.points = std::move(table.points);
    for (PlotStroke& stroke : drawn.strokes) {
        const auto ends = drawn.ends(stroke);
        stroke.closed = layer.graph.point(ends.front()) == layer.graph.point(ends.back() ^ 1U);
    }
    from = {};
}

double plot_seconds(const PlotTally& tally, const std::vector<PenTally>& pens, const PlotSpeeds& speeds) {
    double seconds = plot_seconds(tally, speeds);
    for (const PenTally& pen : pens) {
        if (pen.speed) seconds += pen.drawn / *pen.speed - pen.drawn / speeds.drawing;
        // Lifting and lowering, each with its pause.
        if (pen.pause) seconds += 2 * static_cast<double>(pen.lifts) * *pen.pause;
    }
    return seconds;
}

double plot_seconds(const PlotTally& tally, const PlotSpeeds& speeds) {
    for (const double speed : {speeds.drawing, speeds.travelling}) {
        if (!(speed >= 1e-3 && speed <= 1e6)) {
            throw std::runtime_error("a plotter's speeds must be between 0.001 and 1000000 mm/s");
        }
    }
    if (!(speeds.lift >= 0 && speeds.lift <= 3600)) {
        throw std::runtime_error("the time for lifting the pen must be between 0 and 3600 s");
    }
    return tally.drawn / speeds.drawing + tally.travelled / speeds.travelling +
           static_cast<double>(tally.lifts) * speeds.lift;
}

Style with_fill_pens(const Style& style) {
    Style result = style;
    const std::vector<int> pens = fill_pens(style);
    for (int i = 0; i < static_cast<int>(pens.size()); ++i) {
        const Colour colour = style.fill_colour(Pen{.colour = i});
        if (colour.alpha > 0 && style.line_colour(Pen{.colour = pens[static_cast<std::size_t>(i)]}) != colour) {
            result.palette.push_back(colour);
        }
    }
    return result;
}

std::vector<int> fill_pens(const Style& style) {
    std::vector<int> pens;
    const auto count = static_cast<int>(style.palette.size());
    for (int i = 0; i < count; ++i) {
        const Colour colour = style.fill_colour(Pen{.colour = i});
        int pen = i;
        for (int k = 0; k < count && style.line_colour(Pen{.colour = pen}) != colour; ++k) {
            if (style.line_colour(Pen{.colour = k}) == colour) pen = k;
        }
        pens.push_back(pen);
    }
    return pens;
}

PlotPlan::PlotPlan(const Print& print, const PlotOptions& options)
    : print_(print), options_(options), slots_(print.style.line_slots()) {
    const std::pair<double, const char*> lengths[] = {
        {options.split, "length at which strokes are split"},
        {options.pen_width, "width of the pen"},
        {options.hatch ? options.hatch->spacing : 0.0, "spacing of hatching"},
        {options.resume, "length after which a plot resumes"}};
    for (const auto& [length, name] : lengths) {
        if (std::isfinite(length) && length >= 0) continue;
        throw std::runtime_error(fmt::format("the {} must be finite and at least 0 mm", name));
    }
    for (const int pen : fill_pens(print.style)) {
        fill_slots_.push_back(slots_[static_cast<std::size_t>(pen)]);
    }
}

PlotPlan::~PlotPlan() = default;

int PlotPlan::slot_of(const Pen& pen, bool fills) const {
    const auto index = static_cast<std::size_t>(print_.style.index(pen));
    const std::vector<int>& slots = fills ? fill_slots_ : slots_;
    return index < slots.size() ? slots[index] : 0;
}

PlotPlan::Gathered& PlotPlan::gathered(const Pen& pen, bool fills) {
    const int slot = slot_of(pen, fills);
    auto& found = gathered_[slot];
    if (!found) {
        found = std::make_unique<Gathered>();
        found->pen = real_pen(pen);
        found->pen.colour = slot;
    }
    return *found;
}

bool PlotPlan::is_hatching(const Pen& pen) const {
    const std::vector<int>& hatched = options_.hatched;
    return std::find(hatched.begin(), hatched.end(), print_.style.index(pen)) != hatched.end();
}

/// The width of a pen that fills, in steps.
double PlotPlan::pen_steps(const Pen& pen) const {
    const double step = print_.placement.step;
    return std::max(options_.pen_width > 0 ? options_.pen_width : print_.style.line_width(pen, step), thinnest) /
           step;
}

Pen PlotPlan::real_pen(const Pen& pen) const {
    const StrokeWidth& stroke = print_.style.stroke;
    if (!(options_.pen_width > 0)) return pen;
    const double width = options_.pen_width / (stroke.in_steps ? print_.placement.step : 1.0) / stroke.unit;
    return {width, true, pen.colour};
}

bool PlotPlan::is_wide(const Pen& pen) const {
    return options_.pen_width > 0 &&
           pass_offsets(print_.style.line_width(pen, print_.placement.step), options_.pen_width).size() > 1;
}

void PlotPlan::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start;
    change_pen(pen);
    is_whole_ = true;
}

void PlotPlan::change_pen(const Pen& pen) {
    draw_wide(false);
    is_whole_ = false;
    Gathered* const into = print_.style.draws(pen) ? &gathered(pen) : nullptr;
    if (into) {
        (is_hatching(pen) ? into->has_hatch : into->has_lines) = true;
        if (!(options_.pen_width > 0)) into->add_width(print_.style.line_width(pen, print_.placement.step), pen);
    }
    down_ = down_ && into == into_;
    into_ = into;
    pen_ = pen;
    if (!into_ || !is_wide(pen)) return;
    wide_.emplace().start = at_;
    down_ = false;
}

void PlotPlan::add(std::span<const glm::dvec2> points, bool curves) {
    if (points.empty()) return;
    if (wide_) {
        const std::size_t stride = curves ? 3 : 1;
        for (std::size_t i = 0; i < points.size(); i += stride) {
            if (curves) {
                wide_->pieces.push_back({true, points[i], points[i + 1], points[i + 2]});
            } else {
                wide_->pieces.push_back({false, {}, {}, points[i]});
            }
        }
    } else if (into_) {
        if (!down_) into_->add(Gathered::Kind::start, {&at_, 1});
        down_ = true;
        into_->add(curves ? Gathered::Kind::curves : Gathered::Kind::lines, points);
    }
    at_ = points.back();
}
void PlotPlan::lines(std::span<const glm::dvec2> ends) {
    add(ends, false);
}
void PlotPlan::curves(std::span<const glm::dvec2> controls) {
    add(controls.first(controls.size() / 3 * 3), true);
}
void PlotPlan::end_stroke(bool closed) {
    draw_wide(closed && is_whole_);
    down_ = false;
}

/// Replaces the stroke gathered so far by its passes.
void PlotPlan::draw_wide(bool closed) {
    if (!wide_) return;
    PenPath path = std::move(*wide_);
    wide_.reset();
    if (path.pieces.empty()) return;
    path.is_closed = closed;
    const auto add = [](Gathered& into, const PenPath& pass) {
        into.add(Gathered::Kind::start, {&pass.start, 1});
        for (const PenPath::Piece& piece : pass.pieces) {
            const std::array<glm::dvec2, 3> points = {piece.first, piece.second, piece.end};
            into.add(piece.is_curve ? Gathered::Kind::curves : Gathered::Kind::lines,
                     std::span(points).subspan(piece.is_curve ? 0 : 2));
        }
    };
    if (!covered_) covered_ = std::make_unique<Gathered>();
    add(*covered_, path);
    const double step = print_.placement.step;
    constexpr double tolerance = 0.005;  // millimetres
    for (const PenPath& pass :
         pen_passes(path, print_.style.line_width(pen_, step) / step, options_.pen_width / step, tolerance / step)) {
        options_.monitor.check();
        add(*into_, pass);
    }
}

PlotPlan::Gathered& PlotPlan::outlines(const Pen& pen) {
    gathered(pen, true);  // reserves the layer to which outlines are added when all lines are known
    auto& found = outlines_[slot_of(pen, true)];
    if (!found) found = std::make_unique<Gathered>();
    return *found;
}

void PlotPlan::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (vertices.size() < 2 || print_.style.fill_colour(pen).alpha == 0) return;
    if (options_.leaves_tiles && vertices.size() > 2) {
        ++report_.tiles;
        kinds_.kind_of(vertices, print_.style.fill_colour(pen));
        return;
    }
    Gathered& into = outlines(pen);
    ++report_.fills;
    into.add(Gathered::Kind::start, vertices.first(1));
    into.add(Gathered::Kind::lines, vertices.subspan(1));
    into.add(Gathered::Kind::lines, vertices.first(1));
    hatch(vertices, pen);
}

void PlotPlan::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (outline.size() < 4 || print_.style.fill_colour(pen).alpha == 0) return;
    Gathered& into = outlines(pen);
    ++report_.fills;
    each_contour(
        outline, [&](glm::dvec2 at) { into.add(Gathered::Kind::start, std::span(&at, 1)); },
        [&](std::span<const glm::dvec2> curve) { into.add(Gathered::Kind::curves, curve); });
    if (outline.back() != outline.front()) into.add(Gathered::Kind::lines, outline.first(1));
    if (!options_.hatch) return;
    std::vector<glm::dvec2> vertices = {outline.front()};
    constexpr double tolerance = 0.005;  // millimetres
    for (std::size_t i = 0; i + 3 < outline.size(); i += 3) {
        flatten(outline[i], outline[i + 1], outline[i + 2], outline[i + 3], tolerance / print_.placement.step,
                [&](glm::dvec2 end) { vertices.push_back(end); });
    }
    hatch(vertices, pen);
}

void PlotPlan::hatch(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (!options_.hatch) return;
    const double width = pen_steps(pen);
    const double spacing = options_.hatch->spacing > 0 ? options_.hatch->spacing / print_.placement.step : width;
    if (!(spacing > 0)) return;
    // A stroke with this pen may be in progress.
    down_ = false;
    Gathered& into = gathered(pen, true);
    into.has_hatch = true;
    for (const glm::dvec2 along : hatch_directions(*options_.hatch, print_.placement)) {
        for (const auto& line : hatch_lines(vertices, along, spacing, width / 2, options_.monitor)) {
            into.add(Gathered::Kind::start, std::span(line).first(1));
            into.add(Gathered::Kind::lines, std::span(line).subspan(1));
        }
    }
}

void PlotPlan::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    const double step = print_.placement.step;
    const double wide = print_.style.disc_radius(radius, pen, step) / step;
    if (print_.style.fill_colour(pen).alpha == 0 || !(wide > 0.0)) return;
    down_ = false;
    ++report_.fills;
    const bool is_circle = options_.draws_circles && !(options_.pen_width > 0);
    const std::vector<glm::dvec2> path = spiral(centre, wide, is_circle ? 0.0 : pen_steps(pen));
    Gathered& into = gathered(pen, true);
    into.has_discs = true;
    into.add(Gathered::Kind::start, std::span(path).first(1));
    into.add(Gathered::Kind::curves, std::span(path).subspan(1));
}

glm::dvec2 PlotPlan::drawn_at(glm::dvec2 millimetres) const {
    const glm::dmat3x2& matrix = print_.placement.to_page;
    const glm::dmat2 turned(matrix[0], matrix[1]);
    if (glm::determinant(turned) == 0) return {0, 0};
    return glm::inverse(turned) * (glm::dvec2(millimetres.x, print_.page.height - millimetres.y) - matrix[2]);
}

/// Distance below which points are merged.
double PlotPlan::tolerance() const {
    Box box;
    for (const auto* list : {&gathered_, &outlines_}) {
        for (const auto& [slot, pen] : *list) {
            if (pen->box.empty()) continue;
            box.add(pen->box.low);
            box.add(pen->box.high);
        }
    }
    const glm::dvec2 size = box.high - box.low;
    const glm::dvec2 far = glm::max(glm::abs(box.low), glm::abs(box.high));
    // Not below the resolution of doubles.
    return std::max({1e-9 * std::max(size.x, size.y), 4e-15 * std::max(far.x, far.y), 1e-290});
}

/// Adds the outlines of fills, except edges that lie on lines or other outlines.
void PlotPlan::add_outlines(double tolerance) {
    if (outlines_.empty()) return;
    std::size_t count = covered_ ? covered_->segments() : 0;
    for (const auto* list : {&gathered_, &outlines_}) {
        for (const auto& [slot, pen] : *list) count += pen->segments();
    }
    PlotNodes nodes(tolerance);
    std::vector<PlotSegment> segments;
    PlotSegmentSet set(segments, count);
    Pulse pulse(options_.monitor);
    const auto is_new = [&](Gathered::Kind kind, glm::dvec2 from, std::span<const glm::dvec2> points) {
        pulse();
        if (kind == Gathered::Kind::start) return false;
        PlotSegment segment{nodes.at(from), nodes.at(points.back())};
        if (kind == Gathered::Kind::curves) {
            segment.first = nodes.at(points[0]);
            segment.second = nodes.at(points[1]);
        }
        return set.add(segment);
    };
    const auto note = [&](auto kind, glm::dvec2 from, auto points) { is_new(kind, from, points); };
    for (const auto& [slot, pen] : gathered_) pen->for_each(note);
    if (covered_) covered_->for_each(note);
    for (const auto& [slot, pen] : outlines_) {
        Gathered& into = *gathered_.at(slot);
        bool is_down = false;
        pen->for_each([&](auto kind, glm::dvec2 from, std::span<const glm::dvec2> points) {
            const bool is_drawn = is_new(kind, from, points);
            if (kind == Gathered::Kind::start) {
                is_down = false;
                return;
            }
            if (is_drawn && !is_down) into.add(Gathered::Kind::start, {&from, 1});
            if (is_drawn) into.add(kind, points);
            is_down = is_drawn;
        });
    }
    outlines_.clear();
    covered_.reset();
}

/// Slots of the pens in the order in which they draw.
std::vector<int> PlotPlan::slots_in_order() const {
    const auto layer = [](const Gathered& pen) {
        return pen.has_lines || pen.has_hatch == pen.has_discs ? 1 : pen.has_hatch ? 0 : 2;
    };
    std::vector<int> slots;
    for (const auto& [slot, pen] : gathered_) slots.push_back(slot);
    std::stable_sort(slots.begin(), slots.end(),
                     [&](int a, int b) { return layer(*gathered_.at(a)) < layer(*gathered_.at(b)); });
    return slots;
}

/// Merges colours until there are at most as many as pens.
void PlotPlan::merge_colours() {
    std::erase_if(gathered_, [](const auto& entry) { return entry.second->runs.empty(); });
    report_.colours = gathered_.size();
    if (options_.pens <= 0 || gathered_.size() <= static_cast<std::size_t>(options_.pens)) return;
    std::vector<PenColour> colours;
    std::vector<int> slots;
    Pulse pulse(options_.monitor);
    for (const auto& [slot, pen] : gathered_) {
        PenColour& colour = colours.emplace_back(PenColour{print_.style.line_colour(pen->pen)});
        slots.push_back(slot);
        pen->for_each([&](auto, glm::dvec2 from, std::span<const glm::dvec2> p) {
            pulse();
            colour.drawn += print_.placement.step *
                            (p.size() == 3 ? bezier_length({from, p[0], p[1], p[2]}) : glm::distance(from, p[0]));
        });
    }
    const std::vector<std::size_t> pens = merge_pens(colours, static_cast<std::size_t>(options_.pens));
    for (std::size_t i = 0; i < pens.size(); ++i) {
        if (pens[i] == i) continue;
        gathered_.at(slots[pens[i]])->append(*gathered_.at(slots[i]));
        report_.merged.push_back({colours[i].colour, colours[pens[i]].colour, slots[pens[i]], colours[i].drawn});
    }
    for (std::size_t i = 0; i < pens.size(); ++i) {
        if (pens[i] != i) gathered_.erase(slots[i]);
    }
    // Numbers the pens as PlotWriter does.
    const std::vector<int> order = slots_in_order();
    for (MergedPen& merged : report_.merged) {
        merged.number = 1 + static_cast<int>(std::find(order.begin(), order.end(), merged.number) - order.begin());
    }
}

void PlotPlan::arrange() {
    const double step = print_.placement.step;
    const double tolerance = this->tolerance();
    add_outlines(tolerance);
    merge_colours();
    const glm::dvec2 start = drawn_at(options_.start);
    glm::dvec2 last = start;
    glm::dvec2 at = start;
    for (const int slot : slots_in_order()) {
        const std::unique_ptr<Gathered>& pen = gathered_.at(slot);
        if (!layers_.empty() && options_.park) {
            const glm::dvec2 park = drawn_at(*options_.park);
            report_.before.travelled += step * glm::distance(last, park);
            last = at = park;
        }
        PlotLayer& layer = *layers_.emplace_back(std::make_unique<PlotLayer>());
        layer.pen = pen->pen;
        if (!options_.draws_circles) layer.widths = pen->widths;  // lasers have a fixed width
        layer.number = static_cast<int>(layers_.size());
        layer.settings = pen_settings(options_.rules, layer.number, print_.style.line_colour(layer.pen));
        const PlotTally before = report_.before;
        read_layer(*pen, tolerance, last, layer);
        arrange_layer(layer, at, (report_.before.travelled - before.travelled) / step);
        at = layer.graph.point(layer.strokes.order.back() ^ 1U);
    }
    gathered_.clear();
    into_ = nullptr;
    report_.returns = options_.home.has_value();
    if (options_.home) report_.before.travelled += step * glm::distance(last, drawn_at(*options_.home));
    const PlotTally arranged = tally({.step = step}, report_.pens);
    const bool stays = is_worse(arranged, report_.before, options_.speeds);
    if (stays) {
        report_.duplicates = 0;
        for (const auto& layer : layers_) layer->strokes = layer->as_drawn;
    }
    tally_as_drawn();
    for (const auto& layer : layers_) layer->as_drawn = {};
    const bool is_known = !stays && options_.split <= 0 && options_.resume <= 0 && !options_.refill;
    report_.after = is_known ? arranged : tally(course(), report_.pens);
    if (options_.resume > 0 && !layers_.empty()) {
        std::vector<PenTally> pens;
        const double whole = tally({.step = step}, pens).drawn;
        report_.skipped = whole - report_.after.drawn;
        if (report_.after.lifts > 0) return;
        refuse_option("resume", fmt::format("{:g}m", options_.resume / 1000),
                      fmt::format("the whole plot draws only {:.2f} m", whole / 1000));
    }
}

/// Joins and orders the strokes of a pen, or leaves them as they were drawn if that is better. `drawn` is the pen-up
/// travel as drawn, in turtle steps.
void PlotPlan::arrange_layer(PlotLayer& layer, glm::dvec2 start, double drawn) {
    const double step = print_.placement.step;
    std::uint64_t duplicates = layer.repeated.size();
    PlotStrokes joined = join_segments(layer.graph, options_.monitor);
    if (joined.strokes.size() > layer.as_drawn.strokes.size()) {
        // The omitted segments connected one stroke with the next.
        auto& segments = layer.graph.segments;
        segments.insert(segments.end(), layer.repeated.begin(), layer.repeated.end());
        duplicates = 0;
        joined = join_segments(layer.graph, options_.monitor);
    }
    layer.repeated = {};
    layer.strokes = sort_strokes(layer.graph, joined, start, options_.home && slots_in_order().size() == 1, drawn,
                                 options_.monitor);
    const PlotWay way = way_of(layer.graph, layer.strokes, start, step, options_.monitor);
    const PlotWay as_drawn = way_of(layer.graph, layer.as_drawn, start, step, options_.monitor);
    if (is_worse(way.tally, as_drawn.tally, options_.speeds)) {
        layer.strokes = layer.as_drawn;
        duplicates = 0;
    }
    report_.duplicates += duplicates;
}

PlotCourse PlotPlan::course() const {
    return {print_.placement.step, options_.split, options_.resume, options_.refill};
}

/// Tallies the strokes as they were drawn. Without refills, the lengths were measured while they were read.
void PlotPlan::tally_as_drawn() {
    const auto exchange = [&] {
        for (const auto& layer : layers_) std::swap(layer->strokes, layer->as_drawn);
    };
    exchange();
    const bool refills = options_.refill || std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) {
                             return layer->settings.refill.has_value();
                         });
    const PlotTally tallied = tally({.step = print_.placement.step, .refill = options_.refill}, report_.pens_before);
    if (refills) report_.before = tallied;
    exchange();
}

/// Visits the pen-up movements and the pieces of a course, in order.
template <class Travel, class Visit>
void PlotPlan::follow(const PlotCourse& course, const Travel& add_travel, const Visit& visit) const {
    glm::dvec2 at = drawn_at(options_.start);
    const auto travel = [&](glm::dvec2 to) {
        if (to != at) add_travel(PlotTravel{at, to});
        at = to;
    };
    const PlotLayer* pen = nullptr;
    follow_course(layers_, course, options_.monitor, [&](const PlotPiece& piece) {
        if (pen && pen != &piece.layer && options_.park) travel(drawn_at(*options_.park));
        pen = &piece.layer;
        if (piece.dip) {
            travel(drawn_at(*piece.dip));
        } else {
            travel(piece.layer.graph.point(piece.ends.front()));
            at = piece.layer.graph.point(piece.ends.back() ^ 1U);
        }
        visit(piece);
    });
    if (options_.home) travel(drawn_at(*options_.home));
}

/// Lengths and lifts along a course, as travels() counts them. @param pens  receives the tallies of single pens
PlotTally PlotPlan::tally(const PlotCourse& course, std::vector<PenTally>& pens) const {
    PlotTally result;
    pens.clear();
    for (const auto& layer : layers_) {
        pens.push_back({layer->number, print_.style.line_colour(layer->pen), 0.0, 0, layer->settings.speed,
                        layer->settings.pause, layer->widths});
    }
    Pulse pulse(options_.monitor);
    const auto add_travel = [&](const PlotTravel& travel) {
        result.travelled += course.step * glm::distance(travel.from, travel.to);
    };
    follow(course, add_travel, [&](const PlotPiece& piece) {
        PenTally& pen = pens[static_cast<std::size_t>(piece.layer.number - 1)];
        for (const PlotEnd end : piece.ends) {
            pulse();
            const double length = course.step * piece.layer.graph.length(end);
            result.drawn += length;
            pen.drawn += length;
        }
        ++result.lifts;
        ++pen.lifts;
    });
    return result;
}

void PlotPlan::draw(PathSink& sink, const std::function<void(glm::dvec2, const Pen&)>& dip) const {
    std::vector<glm::dvec2> points;
    follow_course(layers_, course(), options_.monitor, [&](const PlotPiece& piece) {
        const PlotLayer& layer = piece.layer;
        if (piece.dip) {
            if (dip) dip(*piece.dip, layer.pen);
            return;
        }
        bool curves = false;
        const auto flush = [&] {
            options_.monitor.check();
            if (!points.empty()) curves ? sink.curves(points) : sink.lines(points);
            points.clear();
        };
        sink.begin_stroke(layer.graph.point(piece.ends.front()), layer.pen);
        for (const PlotEnd end : piece.ends) {
            const bool is_curve = layer.graph.segments[end / 2].is_curve();
            if (is_curve != curves || points.size() >= points_in_block) flush();
            curves = is_curve;
            if (curves) {
                const CubicBezier bezier = layer.graph.bezier(end);
                points.insert(points.end(), bezier.begin() + 1, bezier.end());
            } else {
                points.push_back(layer.graph.point(end ^ 1U));
            }
        }
        flush();
        sink.end_stroke(piece.closed);
    });
}

std::vector<PlotPlan::PlottedPen> PlotPlan::pens() const {
    std::vector<PlottedPen> pens;
    for (const auto& layer : layers_) pens.push_back({layer->pen, layer->number, layer->settings});
    return pens;
}

std::vector<PlotTravel> PlotPlan::travels() const {
    return travels(course());
}

std::vector<PlotTravel> PlotPlan::travels(const PlotCourse& course) const {
    std::vector<PlotTravel> list;
    follow(
        course, [&](const PlotTravel& travel) { list.push_back(travel); }, [](const PlotPiece&) {});
    return list;
}

}  // namespace sikku
