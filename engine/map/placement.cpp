#include "engine/map/placement.h"

#include "engine/map/conjugate_gradients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t least_corners = 3;

/// Conjugate gradients that solve the equations of gravity for the inner vertices.
class Gravity {
public:
    Gravity(const Map& map, std::vector<glm::dvec2> vertices)
        : map_(map), vertices_(std::move(vertices)), is_outer_(map.vertices(), 0) {
        for (const HalfEdge half : map.outer()) is_outer_[map.start(half)] = 1;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (!is_outer_[i]) vertices_[i] = glm::dvec2(0.0);
        }
    }

    std::vector<glm::dvec2> solve(const Monitor& monitor) {
        constexpr double tolerance = 1e-14;
        std::vector<glm::dmat2> inverses(vertices_.size(), glm::dmat2(0.0));
        for (const MapEdge& edge : map_.edges()) {
            if (edge.tail == edge.head) continue;
            inverses[edge.tail] += glm::dmat2(1.0);
            inverses[edge.head] += glm::dmat2(1.0);
        }
        for (glm::dmat2& block : inverses) block = glm::inverse(block);
        VertexVector pull(vertices_.size());
        apply(vertices_, pull);
        for (glm::dvec2& one : pull) one = -one;
        const VertexVector moved =
            conjugate_gradients([this](const VertexVector& from, VertexVector& to) { apply(from, to); }, inverses,
                                pull, tolerance, 10 * vertices_.size(), monitor);
        for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i] += moved[i];
        return std::move(vertices_);
    }

private:
    /// The number of neighbours times the distance from their mean, for inner vertices.
    void apply(const VertexVector& from, VertexVector& to) const {
        std::fill(to.begin(), to.end(), glm::dvec2(0.0));
        for (const MapEdge& edge : map_.edges()) {
            const glm::dvec2 difference = from[edge.tail] - from[edge.head];
            if (!is_outer_[edge.tail]) to[edge.tail] += difference;
            if (!is_outer_[edge.head]) to[edge.head] -= difference;
        }
    }

    const Map& map_;
    std::vector<glm::dvec2> vertices_;
    std::vector<char> is_outer_;
};

/// A vector turned by the direction of a unit vector.
glm::dvec2 turned_by(glm::dvec2 unit, glm::dvec2 vector) {
    return {unit.x * vector.x - unit.y * vector.y, unit.y * vector.x + unit.x * vector.y};
}

/// Centroid of the area that the outline surrounds.
glm::dvec2 centroid_of_outline(const Map& map, const std::vector<glm::dvec2>& vertices) {
    const glm::dvec2 origin = vertices[map.start(map.outer().front())];
    double area = 0;
    glm::dvec2 moment(0.0);
    for (const HalfEdge half : map.outer()) {
        const glm::dvec2 a = vertices[map.start(half)] - origin, b = vertices[map.end(half)] - origin;
        const double part = a.x * b.y - b.x * a.y;
        area += part;
        moment += part * (a + b);
    }
    return origin + moment / (3 * area);
}

/// Moves the centroid of the outline to 0 0 and turns vertex 0 into the direction `first`.
std::vector<glm::dvec2> upright(const Map& map, std::vector<glm::dvec2> vertices, const glm::dvec2& first) {
    const glm::dvec2 centre = centroid_of_outline(map, vertices);
    const glm::dvec2 now = glm::normalize(vertices.front() - centre);
    const glm::dvec2 turn(glm::dot(now, first), now.x * first.y - now.y * first.x);
    for (glm::dvec2& vertex : vertices) vertex = turned_by(turn, vertex - centre);
    return vertices;
}

}  // namespace

std::vector<glm::dvec2> axiom_polygon(const MapSystem& system) {
    const std::size_t size = system.axiom.size();
    const double step = 2 * std::numbers::pi / static_cast<double>(size);
    std::vector<glm::dvec2> vertices;
    for (std::size_t i = 0; i < size; ++i) {
        // From below, clockwise.
        const double walked = step * static_cast<double>(i);
        const double angle = (size % 2 == 0 ? step / 2 : 0) + (system.is_clockwise ? walked : -walked);
        vertices.emplace_back(0.0 - std::sin(angle), 0.0 - std::cos(angle));
    }
    return vertices;
}

std::vector<glm::dvec2> placed_by_gravity(const Map& map, std::vector<glm::dvec2> outline, const Monitor& monitor) {
    return Gravity(map, std::move(outline)).solve(monitor);
}

std::vector<glm::dvec2> outline_on_circle(const Map& map, const glm::dvec2& first) {
    std::vector<glm::dvec2> vertices(map.vertices(), glm::dvec2(0.0));
    const auto wall = map.outer();
    const auto start =
        std::find_if(wall.begin(), wall.end(), [&](HalfEdge half) { return map.start(half) == 0; }) - wall.begin();
    const double step = 2 * std::numbers::pi / static_cast<double>(wall.size());
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const HalfEdge half = wall[(static_cast<std::size_t>(start) + i) % wall.size()];
        const double angle = step * static_cast<double>(i);
        vertices[map.start(half)] = turned_by({std::cos(angle), std::sin(angle)}, first);
    }
    return vertices;
}

PlacedMap::PlacedMap(const Grammar& grammar, const MapLimits& limits, const Monitor& monitor)
    : system_(*grammar.map()), monitor_(monitor), derivation_(grammar, limits, monitor) {
    if (system_.axiom.size() < least_corners) {
        throw PlacementError(
            fmt::format("a map is drawn from a polygon, and this axiom has {} {}; expected 3 or more",
                        system_.axiom.size(), system_.axiom.size() == 1 ? "edge" : "edges"));
    }
    std::vector<glm::dvec2> polygon = axiom_polygon(system_);
    if (system_.placing == Placing::pressure) {
        pressed_.emplace(map(), std::move(polygon));
        relax();
    } else {
        straight_ = std::move(polygon);
    }
}

bool PlacedMap::next() {
    const Map before = map();
    if (!derivation_.next()) return false;
    if (pressed_) {
        pressed_->follow(before, map(), derivation_.origins(), system_.growth);
        relax();
    } else {
        straight_ = divided_equally(before, derivation_.origins(), straight_);
    }
    return true;
}

void PlacedMap::relax() {
    for (std::size_t i = 0; i < map().cells(); ++i) {
        if (map().cell(i).size() < least_corners) {
            throw PlacementError(
                fmt::format("pressure cannot open cell {} in step {}: it has {} edges; `place: "
                            "straight` and `place: gravity` draw it flat",
                            i, derivation_.steps(), map().cell(i).size()));
        }
    }
    if (pressed_->cell_without_area(map())) {
        const glm::dvec2 first = axiom_polygon(system_).front();
        pressed_->set_vertices(placed_by_gravity(map(), outline_on_circle(map(), first), monitor_));
        if (const auto flat = pressed_->cell_without_area(map())) {
            throw PlacementError(
                fmt::format("pressure cannot open cell {} in step {}: it has no area under gravity "
                            "either",
                            *flat, derivation_.steps()));
        }
    }
    pressed_->relax(map(), monitor_);
}

std::vector<glm::dvec2> PlacedMap::vertices() const {
    std::vector<glm::dvec2> vertices;
    if (pressed_) {
        vertices = upright(map(), pressed_->vertices(), axiom_polygon(system_).front());
    } else if (system_.placing == Placing::straight) {
        vertices = straight_;
    } else if (system_.outline == MapOutline::polygon) {
        vertices = placed_by_gravity(map(), straight_, monitor_);
    } else {
        vertices = placed_by_gravity(map(), outline_on_circle(map(), axiom_polygon(system_).front()), monitor_);
    }
    for (glm::dvec2& vertex : vertices) vertex.y *= system_.stretch;
    return vertices;
}

}  // namespace sikku
