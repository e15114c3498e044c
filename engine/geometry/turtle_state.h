// engine/geometry/turtle_state.h: the state of a turtle besides its position: pen, open brackets, open polygons.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/geometry/path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// @throws WordError that names the symbol, counted from 1
[[noreturn]] void throw_at(std::uint64_t position, std::string_view what);

/// What `action` does to the pen; `value` is finite. Nothing, if it is none of width and colour.
inline void change_pen(Pen& pen, Action action, double value) {
    switch (action) {
        case Action::width_set:
            pen.width = std::min(std::fabs(value), 1e9);
            pen.width_set = true;
            break;
        case Action::width_factor:
            pen.width = std::min(pen.width * value, 1e9);
            break;
        case Action::colour_step:
        case Action::colour_set: {
            const double base = action == Action::colour_step ? pen.colour : 0;
            pen.colour = static_cast<int>(std::clamp(std::round(base + value), -1e9, 1e9));
            break;
        }
        default:
            break;
    }
}

constexpr std::size_t deepest_nesting = std::size_t{1} << 20;

/// The states that `[` keeps for `]`.
template <class State>
class BracketStack {
public:
    void push(const State& state, std::uint64_t position) {
        if (saved_.size() >= deepest_nesting) throw_at(position, "brackets nest deeper than 1,048,576");
        saved_.push_back({state, position});
    }
    State pop(std::uint64_t position) {
        if (saved_.empty()) throw_at(position, "']' without '['");
        State state = std::move(saved_.back().state);
        saved_.pop_back();
        return state;
    }
    std::int64_t depth() const { return static_cast<std::int64_t>(saved_.size()); }
    void finish() const {
        if (!saved_.empty()) throw_at(saved_.back().position, "this '[' is not closed");
    }

private:
    struct Saved {
        State state;
        std::uint64_t position;
    };
    std::vector<Saved> saved_;
};

/// The polygons between `{` and `}`, of vertices that a walker's places lead to.
template <class Place, class Point>
class PolygonStack {
public:
    bool empty() const { return open_.empty(); }
    void begin(const Place& place, std::uint64_t position) {
        if (open_.size() >= deepest_nesting) throw_at(position, "braces nest deeper than 1,048,576");
        open_.push_back({{}, place, place, position});
    }
    /// After each step; `point_of` makes a Point of a Place.
    template <class PointOf>
    void add(const Place& place, PointOf&& point_of) {
        Polygon& polygon = open_.back();
        if (polygon.vertices.empty()) polygon.vertices.push_back(point_of(polygon.first));
        polygon.vertices.push_back(point_of(place));
        polygon.last = place;
    }
    /// Its vertices, without the first repeated at the end.
    std::vector<Point> end(std::uint64_t position) {
        if (open_.empty()) throw_at(position, "'}' without '{'");
        Polygon polygon = std::move(open_.back());
        open_.pop_back();
        if (polygon.vertices.size() > 1 && polygon.first.same_place(polygon.last)) polygon.vertices.pop_back();
        return std::move(polygon.vertices);
    }
    void finish() const {
        if (!open_.empty()) throw_at(open_.back().position, "this '{' is not closed");
    }

private:
    struct Polygon {
        std::vector<Point> vertices;
        Place first;
        Place last;  // of the last vertex
        std::uint64_t position;
    };
    std::vector<Polygon> open_;
};

}  // namespace sikku
