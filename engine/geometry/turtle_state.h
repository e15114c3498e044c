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

/// Changes the pen if `action` sets its width or colour; `value` is finite.
inline void change_pen(Pen& pen, Action action, double value) {
    if (action == Action::width_set) {
        pen.width = std::min(std::fabs(value), 1e9);
        pen.width_set = true;
    } else if (action == Action::width_factor) {
        pen.width = std::min(pen.width * value, 1e9);
    } else if (action == Action::colour_step || action == Action::colour_set) {
        const double base = action == Action::colour_step ? pen.colour : 0;
        pen.colour = static_cast<int>(std::clamp(std::round(base + value), -1e9, 1e9));
    }
}

/// The text that a label shows. @throws WordError for a parameter that is not finite
inline std::string text_at(const LabelText& label, std::span<const double> arguments, std::uint64_t position) {
    const auto shown = arguments.first(label.parameters());
    if (!std::all_of(shown.begin(), shown.end(), [](double value) { return std::isfinite(value); })) {
        throw_at(position, "its parameter is not finite");
    }
    return label.text(arguments);
}

/// Refuses a parameter of `{` other than 0, which is the type of a cylinder in cpfg.
inline void refuse_cylinder(std::uint64_t position, double type) {
    if (type == 0) return;
    throw_at(position,
             "'{' with a parameter begins a generalised cylinder, which is not supported; '{' alone begins "
             "a polygon");
}

constexpr std::size_t deepest_nesting = std::size_t{1} << 20;

/// The states that `[` saves for `]`.
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

/// The open polygons between `{` and `}`, which do not depend on branches. An outline begins with the place of `{`; a
/// polygon of a framework has only the vertices that are added, of which successive equal ones are merged.
template <class Place, class Point>
class PolygonStack {
public:
    bool empty() const { return open_.empty(); }
    void begin(const Place& place, bool is_outline, std::uint64_t position) {
        if (open_.size() >= deepest_nesting) throw_at(position, "braces nest deeper than 1,048,576");
        open_.push_back({{}, place, place, is_outline, position});
    }
    /// Adds a vertex; `point_of` makes a Point of a Place.
    template <class PointOf>
    void add(const Place& place, PointOf&& point_of) {
        Polygon& polygon = open_.back();
        if (polygon.is_outline) {
            if (polygon.vertices.empty()) polygon.vertices.push_back(point_of(polygon.first));
        } else if (polygon.vertices.empty()) {
            polygon.first = place;
        } else if (polygon.last.same_place(place)) {
            return;
        }
        polygon.vertices.push_back(point_of(place));
        polygon.last = place;
    }
    /// Ends the last polygon and returns its vertices, without the first repeated at the end.
    std::vector<Point> end(std::uint64_t position) {
        if (open_.empty()) throw_at(position, "'}' without '{'");
        Polygon polygon = std::move(open_.back());
        open_.pop_back();
        const bool returns = polygon.vertices.size() > 1 && polygon.first.same_place(polygon.last);
        was_closed_ = returns || !polygon.is_outline;
        if (returns) polygon.vertices.pop_back();
        return std::move(polygon.vertices);
    }
    /// True if the last outline ended where it began; frameworks always close.
    bool was_closed() const { return was_closed_; }
    void finish() const {
        if (!open_.empty()) throw_at(open_.back().position, "this '{' is not closed");
    }

private:
    struct Polygon {
        std::vector<Point> vertices;
        Place first;
        Place last;  // of the last vertex
        bool is_outline;
        std::uint64_t position;
    };
    std::vector<Polygon> open_;
    bool was_closed_ = true;
};

/// The places that a walker visited, as a tree, and the open inserted edges. Closing an edge closes a cycle in the
/// tree: from the beginning of the edge back to the branching point and on to its end. Memory: that of the branches
/// that lead to the walker and to the ends of open edges.
template <class Place>
class InsertedEdges {
public:
    explicit InsertedEdges(const Grammar& grammar) {
        for (const SymbolInfo& symbol : grammar.symbols()) {
            in_use_ = in_use_ || symbol.command.action == Action::edge_begin;
        }
    }
    bool in_use() const { return in_use_; }
    /// Call first.
    void start(const Place& place) {
        if (in_use_) nodes_.push_back({place, 0, 0});
    }
    /// Call after each step. `node` belongs to the walker's state.
    void step(const Place& place, std::size_t& node, std::uint64_t position) {
        if (!in_use_) return;
        if (nodes_.size() >= most) throw_at(position, "more than 16,777,216 steps lead to inserted edges");
        nodes_.push_back({place, node, nodes_[node].depth + 1});
        node = nodes_.size() - 1;
    }
    /// Number of places so far, for pop().
    std::size_t size() const { return nodes_.size(); }
    /// Call when the walker is back from a branch that began when there were `size` places.
    void pop(std::size_t size) {
        if (in_use_ && (open_.empty() || open_.back().newest < size)) nodes_.resize(size);
    }
    void open(std::size_t node, std::uint64_t position) {
        if (open_.size() >= deepest_nesting) throw_at(position, "inserted edges nest deeper than 1,048,576");
        open_.push_back({node, open_.empty() ? node : std::max(node, open_.back().newest), position});
    }
    /// Ends an edge and returns the places of its cycle, from its beginning to its end.
    std::vector<Place> close(std::size_t node, std::uint64_t position) {
        if (open_.empty()) throw_at(position, "the end of an inserted edge without its beginning");
        std::size_t first = open_.back().node;
        open_.pop_back();
        std::vector<Place> cycle, rest;
        while (first != node) {
            const bool back = nodes_[first].depth >= nodes_[node].depth;
            std::size_t& deeper = back ? first : node;
            add(nodes_[deeper].place, back ? cycle : rest);
            deeper = nodes_[deeper].parent;
            if (++visited_ > most) throw_at(position, "inserted edges bound more than 16,777,216 steps in all");
        }
        add(nodes_[node].place, cycle);
        for (; !rest.empty(); rest.pop_back()) add(rest.back(), cycle);
        return cycle;
    }
    void finish() const {
        if (!open_.empty()) throw_at(open_.back().position, "this inserted edge has no end");
    }

private:
    static constexpr std::size_t most = std::size_t{1} << 24;
    static void add(const Place& place, std::vector<Place>& list) {
        if (list.empty() || !list.back().same_place(place)) list.push_back(place);
    }
    struct Node {
        Place place;
        std::size_t parent;
        std::size_t depth;
    };
    struct Open {
        std::size_t node;
        std::size_t newest;  ///< node of all open edges
        std::uint64_t position;
    };
    bool in_use_ = false;
    std::vector<Node> nodes_;
    std::vector<Open> open_;
    std::size_t visited_ = 0;
};

}  // namespace sikku
