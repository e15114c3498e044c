#include "engine/geometry/polylines.h"

#include "engine/base/memory.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/space_turtle.h"
#include "engine/geometry/turtle.h"

#include <string>

namespace sikku {
namespace {

/// Stores strokes in up to half of the memory.
template <class Point>
class Keeper {
public:
    explicit Keeper(const std::function<bool(const Pen&)>& draws)
        : draws_(draws), most_(static_cast<std::size_t>(available_memory() / 2 / sizeof(Point))) {}

    /// @throws BudgetError if there are too many points
    void reserve(double points) {
        if (points > static_cast<double>(most_)) refuse();
        lines_.points.reserve(static_cast<std::size_t>(points));
    }
    void set_pen(const Pen& pen) { is_visible_ = !draws_ || draws_(pen); }
    void begin(const Point& start) {
        at_ = start;
        is_open_ = false;
    }
    void add(std::span<const Point> ends) {
        if (ends.empty()) return;
        if (is_visible_) {
            if (lines_.points.size() + ends.size() >= most_) refuse();
            if (!is_open_) {
                lines_.begins.push_back(static_cast<std::int64_t>(lines_.points.size()));
                lines_.points.push_back(at_);
            }
            lines_.points.insert(lines_.points.end(), ends.begin(), ends.end());
        }
        is_open_ = is_visible_;
        at_ = ends.back();
    }
    Polylines<Point> finish() {
        lines_.begins.push_back(static_cast<std::int64_t>(lines_.points.size()));
        return std::move(lines_);
    }

private:
    [[noreturn]] void refuse() const {
        throw BudgetError("the drawing has more than " + std::to_string(most_) +
                          " points, which would fill half of the memory");
    }

    const std::function<bool(const Pen&)>& draws_;
    std::size_t most_;
    Polylines<Point> lines_;
    Point at_{0.0};
    bool is_visible_ = true;
    bool is_open_ = false;
};

class PlaneKeeper : public PolygonSink {
public:
    explicit PlaneKeeper(const TraceOptions& options) : kept(options.draws) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        kept.set_pen(pen);
        kept.begin(start);
    }
    void lines(std::span<const glm::dvec2> ends) override { kept.add(ends); }
    void change_pen(const Pen& pen) override { kept.set_pen(pen); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void label(std::string_view, glm::dvec2, double, const Pen&) override {}

    Keeper<glm::dvec2> kept;
};

class SpaceKeeper : public SpaceSink {
public:
    explicit SpaceKeeper(const TraceOptions& options) : kept(options.draws) {}
    void segment(const glm::dvec3& from, const Pen&, const glm::dvec3& to, const Pen& pen, bool goes_on) override {
        kept.set_pen(pen);
        if (!goes_on) kept.begin(from);
        kept.add(std::span(&to, 1));
    }
    void polygon(std::span<const glm::dvec3>, const Pen&) override {}
    void surface(const Surface&, const glm::dmat4x3&, const Pen&) override {}
    void sphere(const glm::dvec3&, double, const Pen&) override {}
    void label(std::string_view, const glm::dvec3&, double, const Pen&) override {}

    Keeper<glm::dvec3> kept;
};

/// Derives the word for a turtle that draws into a store of strokes.
template <class Point, class MakeTurtle>
Polylines<Point> traced(const Grammar& given, const TraceOptions& options, Keeper<Point>& kept,
                        const MakeTurtle& make_turtle) {
    const Grammar grammar = shorten(given);
    require_affordable(grammar, true, options.budget);
    if (const auto known = estimate(grammar, true)) kept.reserve(drawn_symbols(grammar, *known) + 1);
    const auto turtle = make_turtle(grammar);
    derive(grammar, *turtle, DerivationOptions::within(options.budget, options.watch));
    return kept.finish();
}

}  // namespace

Polylines<glm::dvec2> trace(const Grammar& grammar, const TraceOptions& options) {
    PlaneKeeper keeper(options);
    return traced(grammar, options, keeper.kept,
                  [&](const Grammar& shortened) { return Turtle::drawing(shortened, keeper, options.moves_draw); });
}

Polylines<glm::dvec3> trace_in_space(const Grammar& grammar, const TraceOptions& options) {
    SpaceKeeper keeper(options);
    return traced(grammar, options, keeper.kept,
                  [&](const Grammar& shortened) { return SpaceTurtle::make(shortened, &keeper); });
}

}  // namespace sikku
