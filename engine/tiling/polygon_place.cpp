#include "engine/tiling/polygon_place.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sikku {
namespace {

/// The distance of a point from the outline of a polygon.
double distance_to(std::span<const glm::dvec2> corners, glm::dvec2 point) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 from = corners[i], along = corners[(i + 1) % corners.size()] - from;
        const double square = scalar_product(along, along);
        const double share = square > 0 ? std::clamp(scalar_product(point - from, along) / square, 0.0, 1.0) : 0;
        const glm::dvec2 gap = point - from - share * along;
        nearest = std::min(nearest, std::sqrt(scalar_product(gap, gap)));
    }
    return nearest;
}

}  // namespace

PolygonMass mass_of(std::span<const glm::dvec2> corners) {
    PolygonMass mass;
    glm::dvec2 mean(0.0);
    for (const glm::dvec2 corner : corners) mean += corner / static_cast<double>(corners.size());
    glm::dvec2 moment(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i] - mean, b = corners[(i + 1) % corners.size()] - mean;
        mass.area += determinant(a, b) / 2;
        moment += (a + b) * (determinant(a, b) / 6);
    }
    mass.centre = mean;
    if (mass.area != 0) mass.centre += moment / mass.area;
    mass.area = std::fabs(mass.area);
    return mass;
}

bool contains(std::span<const glm::dvec2> corners, glm::dvec2 point, double margin) {
    return contains(corners, point) || distance_to(corners, point) <= margin;
}

glm::dvec2 inner_middle(std::span<const glm::dvec2> corners) {
    constexpr double drawn_to_centroid = 1e-3;
    const glm::dvec2 centroid = mass_of(corners).centre;
    const Box box = box_of(corners);
    const auto worth = [&](glm::dvec2 point) {
        const double nearest = distance_to(corners, point);
        const glm::dvec2 way = point - centroid;
        return (contains(corners, point) ? nearest : -nearest) -
               drawn_to_centroid * std::sqrt(scalar_product(way, way));
    };
    glm::dvec2 best = centroid;
    double most = worth(best);
    const auto try_point = [&](glm::dvec2 point) {
        const double found = worth(point);
        if (!(found > most)) return false;
        most = found;
        best = point;
        return true;
    };
    for (const glm::dvec2 point : points_within(corners)) try_point(point);
    const double size = box.longest();
    for (double step = size / 8; step > size / 2000;) {
        bool is_better = false;
        for (int direction = 0; direction < 8 && !is_better; ++direction) {
            const double angle = direction * std::numbers::pi / 4;
            is_better = try_point(best + step * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        if (!is_better) step /= 2;
    }
    return best;
}

std::vector<glm::dvec2> points_within(std::span<const glm::dvec2> corners) {
    constexpr int side = 5;
    const Box box = box_of(corners);
    std::vector<glm::dvec2> points;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            // Slightly off the middle, so that lines of symmetry contain none.
            const glm::dvec2 share((column + 0.47) / side, (row + 0.52) / side);
            const glm::dvec2 point = box.low + box.size() * share;
            if (contains(corners, point)) points.push_back(point);
        }
    }
    if (points.empty()) points.push_back(mass_of(corners).centre);
    return points;
}

PolygonFinder::PolygonFinder(const PolygonList& polygons)
    : polygons_(polygons),
      box_(polygons.corners.empty() ? Box{glm::dvec2(0.0), glm::dvec2(0.0)} : box_of(polygons.corners)),
      grid_(box_, polygons.size()),
      lists_(grid_.cells()) {
    const auto each = [&](auto&& visit) {
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const Box box = box_of(polygons.polygon(i));
            grid_.over(box, [&](std::size_t cell) { visit(cell, static_cast<std::uint32_t>(i)); });
        }
    };
    each([&](std::size_t cell, std::uint32_t) { lists_.count(cell); });
    lists_.start();
    each([&](std::size_t cell, std::uint32_t polygon) { lists_.add(cell, polygon); });
}

std::uint32_t PolygonFinder::at(glm::dvec2 point) const {
    if (!box_.contains(point)) return no_number;
    std::uint32_t found = no_number;
    lists_.visit(grid_.cell(point), [&](std::uint32_t polygon) {
        if (found == no_number && contains(polygons_.polygon(polygon), point)) found = polygon;
    });
    return found;
}

}  // namespace sikku
