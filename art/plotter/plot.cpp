#include "art/plotter/plot.h"

#include "art/plotter/plot_join.h"
#include "art/plotter/plot_route.h"
#include "engine/geometry/lattice.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

using Index = std::uint32_t;
constexpr Index none = PlotSegment::none;
constexpr std::size_t most_points = 1'000'000'000;
constexpr std::size_t points_in_block = 1024;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    std::uint64_t hash = (a * 0x9e3779b97f4a7c15U) ^ (b + 0x632be59bd9b4e019U);
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9U;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebU;
    return hash ^ (hash >> 31);
}

std::size_t table_size(std::size_t entries) {
    std::size_t size = 16;
    while (size < 2 * entries) size *= 2;
    return size;
}

/// Numbers for points; those less than `tolerance` apart along both axes have the same.
class Nodes {
public:
    explicit Nodes(double tolerance) : tolerance_(tolerance), table_(table_size(0), none) {}

    Index at(glm::dvec2 point) {
        // Most points lie far enough inside their cell for no other to count.
        const glm::dvec2 cell = cell_of(point);
        const glm::dvec2 inside = point / cell_size() - cell;
        const auto other = [](double share) { return share < 1 / cells ? -1.0 : share > 1 - 1 / cells ? 1.0 : 0.0; };
        const glm::dvec2 beside(other(inside.x), other(inside.y));
        std::size_t free = 0;
        Index found = find(point, cell, free);
        if (found == none && beside.x != 0) found = find(point, cell + glm::dvec2(beside.x, 0), free);
        if (found == none && beside.y != 0) found = find(point, cell + glm::dvec2(0, beside.y), free);
        if (found == none && beside.x != 0 && beside.y != 0) found = find(point, cell + beside, free);
        if (found != none) return found;
        found = static_cast<Index>(points.size());
        points.push_back(point);
        if (2 * points.size() > table_.size()) {
            table_.assign(2 * table_.size(), none);
            for (Index i = 0; i < points.size(); ++i) enter(i);
        } else {
            enter(found);
        }
        return found;
    }

    std::vector<glm::dvec2> points;

private:
    static constexpr double cells = 16.0;  // side of a cell, in tolerances

    double cell_size() const { return cells * tolerance_; }
    glm::dvec2 cell_of(glm::dvec2 point) const {
        return {std::floor(point.x / cell_size()), std::floor(point.y / cell_size())};
    }
    std::size_t slot(glm::dvec2 cell) const {
        return mixed(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x)),
                     static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y))) &
               (table_.size() - 1);
    }
    /// A node near `point` among those of a cell, and of cells that share its place in the table.
    Index find(glm::dvec2 point, glm::dvec2 cell, std::size_t& free) const {
        for (free = slot(cell); table_[free] != none; free = (free + 1) & (table_.size() - 1)) {
            const glm::dvec2 gap = points[table_[free]] - point;
            if (std::fabs(gap.x) < tolerance_ && std::fabs(gap.y) < tolerance_) return table_[free];
        }
        return none;
    }
    void enter(Index node) {
        std::size_t at = slot(cell_of(points[node]));
        while (table_[at] != none) at = (at + 1) & (table_.size() - 1);
        table_[at] = node;
    }

    double tolerance_;
    std::vector<Index> table_;
};

/// A set of segments without duplicates.
class SegmentSet {
public:
    SegmentSet(std::vector<PlotSegment>& segments, std::size_t most)
        : segments_(segments), table_(table_size(most), none) {}

    bool add(const PlotSegment& segment) {
        const auto key = [](const PlotSegment& s) { return mixed(mixed(s.from, s.to), mixed(s.first, s.second)); };
        const PlotSegment back = segment.backwards();
        std::size_t at = (key(segment) + key(back)) & (table_.size() - 1);
        for (; table_[at] != none; at = (at + 1) & (table_.size() - 1)) {
            const PlotSegment& other = segments_[table_[at]];
            if (other == segment || other == back) return false;
        }
        table_[at] = static_cast<Index>(segments_.size());
        segments_.push_back(segment);
        return true;
    }

private:
    std::vector<PlotSegment>& segments_;
    std::vector<Index> table_;
};

}  // namespace

/// What was drawn with one pen: stretches of points, in drawing order.
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

    Pen pen;
    Box box;
    std::vector<glm::dvec2> points;
    std::vector<Run> runs;
};

/// What one pen draws.
struct PlotPlan::Layer {
    Pen pen;
    PlotGraph graph;
    PlotStrokes strokes;
    std::vector<PlotSegment> repeated;  // while it is being arranged: what was drawn again

    void read(Gathered& from, double tolerance, glm::dvec2& at, PlotReport& report, double millimetres,
              const Monitor& monitor);
};

/// Numbers the points and leaves out what is drawn twice. `at` is where the last pen was lifted.
void PlotPlan::Layer::read(Gathered& from, double tolerance, glm::dvec2& at, PlotReport& report, double millimetres,
                           const Monitor& monitor) {
    pen = from.pen;
    std::size_t count = 0;
    for (const auto& run : from.runs) {
        count += run.kind == Gathered::Kind::curves  ? run.points / 3
                 : run.kind == Gathered::Kind::lines ? run.points
                                                     : 0;
    }
    Nodes table(tolerance);
    SegmentSet set(graph.segments, count);
    Pulse pulse(monitor);
    Index here = 0;
    const glm::dvec2* next = from.points.data();
    for (const auto& run : from.runs) {
        const std::size_t stride = run.kind == Gathered::Kind::curves ? 3 : 1;
        for (std::size_t i = 0; i < run.points; i += stride, next += stride) {
            pulse();
            const Index end = table.at(next[stride - 1]);
            if (run.kind == Gathered::Kind::start) {
                report.before.travelled += millimetres * glm::distance(at, *next);
                ++report.before.lifts;
            } else {
                PlotSegment segment{here, end};
                if (run.kind == Gathered::Kind::curves) {
                    segment.first = table.at(next[0]);
                    segment.second = table.at(next[1]);
                    report.before.drawn += millimetres * bezier_length({at, next[0], next[1], next[2]});
                } else {
                    report.before.drawn += millimetres * glm::distance(at, *next);
                }
                if (!set.add(segment)) repeated.push_back(segment);
            }
            here = end;
            at = next[stride - 1];
        }
    }
    report.segments += count;
    graph.points = std::move(table.points);
    from = {};
}

double plot_seconds(const PlotTally& tally, const PlotSpeeds& speeds) {
    for (const double speed : {speeds.drawing, speeds.travelling}) {
        if (!(speed >= 1e-3 && speed <= 1e6)) {
            throw std::runtime_error("a plotter's speeds are between 0.001 and 1000000 mm/s");
        }
    }
    if (!(speeds.lift >= 0 && speeds.lift <= 3600)) {
        throw std::runtime_error("the time for lifting the pen is between 0 and 3600 s");
    }
    return tally.drawn / speeds.drawing + tally.travelled / speeds.travelling +
           static_cast<double>(tally.lifts) * speeds.lift;
}

PlotPlan::PlotPlan(const Print& print, const PlotOptions& options)
    : print_(print), options_(options), slots_(print.style.line_slots()) {
    if (!(std::isfinite(options.split) && options.split >= 0)) {
        throw std::runtime_error("the length at which strokes are split is finite and at least 0 mm");
    }
}

PlotPlan::~PlotPlan() = default;

PlotPlan::Gathered& PlotPlan::gathered(const Pen& pen) {
    const auto index = static_cast<std::size_t>(print_.style.index(pen));
    const int slot = index < slots_.size() ? slots_[index] : 0;
    auto& found = gathered_[slot];
    if (!found) {
        found = std::make_unique<Gathered>();
        found->pen = pen;
        found->pen.colour = slot;
    }
    return *found;
}

void PlotPlan::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start;
    change_pen(pen);
}

void PlotPlan::change_pen(const Pen& pen) {
    Gathered* const into = print_.style.draws(pen) ? &gathered(pen) : nullptr;
    down_ = down_ && into == into_;
    into_ = into;
}

void PlotPlan::add(std::span<const glm::dvec2> points, bool curves) {
    if (points.empty()) return;
    if (into_) {
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
void PlotPlan::end_stroke(bool) {
    down_ = false;
}

void PlotPlan::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (!options_.outlines || vertices.size() < 2 || print_.style.fill_colour(pen).alpha == 0) return;
    // A stroke may be going on with this very pen.
    down_ = false;
    Gathered& into = gathered(pen);
    into.add(Gathered::Kind::start, vertices.first(1));
    into.add(Gathered::Kind::lines, vertices.subspan(1));
    into.add(Gathered::Kind::lines, vertices.first(1));
}

void PlotPlan::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (!options_.outlines || outline.size() < 4 || print_.style.fill_colour(pen).alpha == 0) return;
    down_ = false;
    Gathered& into = gathered(pen);
    into.add(Gathered::Kind::start, outline.first(1));
    into.add(Gathered::Kind::curves, outline.subspan(1));
    if (outline.back() != outline.front()) into.add(Gathered::Kind::lines, outline.first(1));
}

void PlotPlan::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    const double step = print_.placement.step;
    // Around a dot of twice its width the pen goes in the middle.
    const double pen_radius = 0.5 * print_.style.line_width(pen, step) / step;
    const double r = radius > 0.0 ? std::max(radius - pen_radius, 0.25 * radius)
                                  : 0.5 * print_.style.disc_radius(radius, pen, step) / step;
    if (print_.style.fill_colour(pen).alpha == 0 || !(r > 0.0)) return;
    down_ = false;
    // Eighths of a circle, to 0.0004 percent of its radius.
    constexpr std::size_t eighths = 8;
    const double handle = 4.0 / 3.0 * std::tan(std::numbers::pi / 16);
    std::array<glm::dvec2, 3 * eighths> controls;
    for (std::size_t i = 0; i < eighths; ++i) {
        const glm::dvec2 from = unit_vector(45.0 * static_cast<double>(i));
        const glm::dvec2 to = unit_vector(45.0 * static_cast<double>((i + 1) % eighths));
        controls[3 * i] = centre + r * (from + handle * glm::dvec2(-from.y, from.x));
        controls[3 * i + 1] = centre + r * (to - handle * glm::dvec2(-to.y, to.x));
        controls[3 * i + 2] = centre + r * to;
    }
    Gathered& into = gathered(pen);
    into.add(Gathered::Kind::start, {&controls.back(), 1});
    into.add(Gathered::Kind::curves, controls);
}

glm::dvec2 PlotPlan::origin() const {
    const glm::dmat3x2& matrix = print_.placement.to_page;
    const glm::dmat2 turned(matrix[0], matrix[1]);
    if (glm::determinant(turned) == 0) return {0, 0};
    return glm::inverse(turned) * (glm::dvec2(0.0, print_.page.height) - matrix[2]);
}

void PlotPlan::arrange() {
    const double step = print_.placement.step;
    Box box;
    for (const auto& [slot, pen] : gathered_) {
        if (pen->box.empty()) continue;
        box.add(pen->box.low);
        box.add(pen->box.high);
    }
    const glm::dvec2 size = box.high - box.low;
    const glm::dvec2 far = glm::max(glm::abs(box.low), glm::abs(box.high));
    // Not below what doubles tell apart.
    const double tolerance = std::max({1e-9 * std::max(size.x, size.y), 4e-15 * std::max(far.x, far.y), 1e-290});
    glm::dvec2 drawn_at = origin();
    glm::dvec2 at = drawn_at;
    for (auto& [slot, pen] : gathered_) {
        if (pen->runs.empty()) continue;
        Layer& layer = *layers_.emplace_back(std::make_unique<Layer>());
        const PlotTally before = report_.before;
        layer.read(*pen, tolerance, drawn_at, report_, step, options_.monitor);
        PlotStrokes joined = join_segments(layer.graph, options_.monitor);
        if (joined.strokes.size() > report_.before.lifts - before.lifts) {
            // What was left out had led from one stroke to the next.
            auto& segments = layer.graph.segments;
            segments.insert(segments.end(), layer.repeated.begin(), layer.repeated.end());
            joined = join_segments(layer.graph, options_.monitor);
        } else {
            report_.duplicates += layer.repeated.size();
        }
        layer.repeated = {};
        layer.strokes = sort_strokes(layer.graph, joined, at, (report_.before.travelled - before.travelled) / step,
                                     options_.monitor);
        at = layer.graph.point(layer.strokes.order.back() ^ 1U);
    }
    gathered_.clear();
    into_ = nullptr;
    Pulse pulse(options_.monitor);
    for_each_stroke([&](const Layer& layer, std::span<const PlotEnd> ends, bool) {
        for (const PlotEnd end : ends) {
            pulse();
            report_.after.drawn += step * layer.graph.length(end);
        }
        ++report_.after.lifts;
    });
    for (const PlotTravel& travel : travels()) {
        report_.after.travelled += step * glm::distance(travel.from, travel.to);
    }
}

template <class Visit>
void PlotPlan::for_each_stroke(Visit&& visit) const {
    Pulse pulse(options_.monitor);
    for (const auto& layer : layers_) {
        for (const PlotStroke& stroke : layer->strokes.strokes) {
            pulse();
            const auto ends = layer->strokes.ends(stroke);
            std::size_t begin = 0;
            double length = 0;
            for (std::size_t i = 0; i < ends.size() && options_.split > 0; ++i) {
                pulse();
                const double more = print_.placement.step * layer->graph.length(ends[i]);
                if (i > begin && length + more > options_.split) {
                    visit(*layer, ends.subspan(begin, i - begin), false);
                    begin = i;
                    length = 0;
                }
                length += more;
            }
            visit(*layer, ends.subspan(begin), stroke.closed && begin == 0);
        }
    }
}

void PlotPlan::draw(PathSink& sink) const {
    std::vector<glm::dvec2> points;
    for_each_stroke([&](const Layer& layer, std::span<const PlotEnd> ends, bool closed) {
        bool curves = false;
        const auto flush = [&] {
            options_.monitor.check();
            if (!points.empty()) curves ? sink.curves(points) : sink.lines(points);
            points.clear();
        };
        sink.begin_stroke(layer.graph.point(ends.front()), layer.pen);
        for (const PlotEnd end : ends) {
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
        sink.end_stroke(closed);
    });
}

std::vector<PlotTravel> PlotPlan::travels() const {
    std::vector<PlotTravel> list;
    glm::dvec2 at = origin();
    for_each_stroke([&](const Layer& layer, std::span<const PlotEnd> ends, bool) {
        const glm::dvec2 start = layer.graph.point(ends.front());
        if (start != at) list.push_back({at, start});
        at = layer.graph.point(ends.back() ^ 1U);
    });
    return list;
}

void PlotWriter::change_pen(const Pen& pen) {
    // The stroke ends and goes on as another one.
    end_stroke(false);
    begin_stroke(here_, pen);
}

int PlotWriter::number(const Pen& pen) {
    const int next = static_cast<int>(numbers_.size()) + 1;
    return numbers_.try_emplace(print_.style.index(pen), next).first->second;
}

glm::dvec2 PlotWriter::on_page(glm::dvec2 point) const {
    const glm::dvec2 down = print_.placement.to_page * glm::dvec3(point, 1.0);
    return {down.x, print_.page.height - down.y};
}

int PlotWriter::chords(const Bezier& b, double tolerance) {
    const double bend = std::max(glm::length(b[0] - 2.0 * b[1] + b[2]), glm::length(b[1] - 2.0 * b[2] + b[3]));
    const double count = std::ceil(std::sqrt(0.75 * bend / tolerance));
    return static_cast<int>(std::clamp(count, 1.0, 1e6));
}

glm::dvec2 PlotWriter::at(const Bezier& b, double t) {
    const double s = 1 - t;
    return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}

void PlotWriter::require_on_page(glm::dvec2 millimetres) const {
    constexpr double slack = 1e-6;
    const auto inside = [](double value, double most) { return value >= -slack && value <= most + slack; };
    if (!inside(millimetres.x, print_.page.width) || !inside(millimetres.y, print_.page.height)) {
        throw std::runtime_error("the drawing is larger than the page: a plotter does not cut off what lies outside");
    }
}

}  // namespace sikku
