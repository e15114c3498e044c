// art/kolam/field_classes.cpp: divides the fields of a drawing into classes of one colour.
#include "art/kolam/fields.h"
#include "engine/geometry/box.h"
#include "engine/geometry/point_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::uint32_t no_field = std::numeric_limits<std::uint32_t>::max();
constexpr double alike = 1e-4;  // in steps: centroids as near as this are one

/// Numbers groups of fields, those with a dot even, the others odd, each in the order of `key`.
template <class Key>
std::vector<std::uint32_t> numbered(const std::vector<Field>& fields, const Key& key) {
    std::array<std::map<decltype(key(0U)), std::uint32_t>, 2> numbers;
    for (std::uint32_t i = 0; i < fields.size(); ++i) numbers[fields[i].is_odd ? 0 : 1].try_emplace(key(i), 0);
    for (std::uint32_t parity = 0; parity < 2; ++parity) {
        std::uint32_t number = parity;
        for (auto& [value, own] : numbers[parity]) own = std::exchange(number, number + 2);
    }
    std::vector<std::uint32_t> classes;
    for (std::uint32_t i = 0; i < fields.size(); ++i) classes.push_back(numbers[fields[i].is_odd ? 0 : 1][key(i)]);
    return classes;
}

/// Numbers sizes, from the smallest; areas that differ by less than 2 percent from the next are one size.
std::vector<std::uint32_t> sizes_of(const std::vector<Field>& fields, const Monitor& monitor) {
    constexpr double least_ratio = 1.02;
    std::vector<std::uint32_t> order(fields.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), stoppable(monitor, [&](std::uint32_t a, std::uint32_t b) {
                  return std::pair(fields[a].area, a) < std::pair(fields[b].area, b);
              }));
    std::vector<std::uint32_t> sizes(fields.size());
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && fields[order[i]].area > least_ratio * fields[order[i - 1]].area) ++size;
        sizes[order[i]] = size;
    }
    return sizes;
}

/// The number of lines to cross on the way from the fields nearest to the centre.
std::vector<std::uint32_t> distances_from(glm::dvec2 centre, const std::vector<Field>& fields, Pulse& pulse) {
    std::vector<double> away;
    for (const Field& field : fields) {
        // Distance to the nearest point of the outline; 0 inside.
        double least = std::numeric_limits<double>::max();
        double turn = 0;
        for (std::size_t i = 0; i + 3 < field.outline.size(); i += 3) {
            constexpr int parts = 4;
            for (int part = 0; part < parts; ++part) {
                pulse();
                const Bezier curve = {field.outline[i], field.outline[i + 1], field.outline[i + 2],
                                      field.outline[i + 3]};
                const glm::dvec2 a = point_of(curve, static_cast<double>(part) / parts) - centre;
                const glm::dvec2 b = point_of(curve, static_cast<double>(part + 1) / parts) - centre;
                least = std::min({least, std::hypot(a.x, a.y), std::hypot(b.x, b.y)});
                turn += std::atan2(determinant(a, b), scalar_product(a, b));
            }
        }
        away.push_back(std::fabs(turn) > std::numbers::pi ? 0 : least);
    }
    std::vector<std::uint32_t> distance(fields.size(), no_field);
    if (fields.empty()) return distance;
    const double least = *std::min_element(away.begin(), away.end());
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < fields.size(); ++i) {
        if (away[i] > least + alike) continue;
        distance[i] = 0;
        front.push_back(i);
    }
    for (std::size_t i = 0; i < front.size(); ++i) {
        pulse();
        for (const std::uint32_t other : fields[front[i]].beside) {
            if (distance[other] != no_field) continue;
            distance[other] = distance[front[i]] + 1;
            front.push_back(other);
        }
    }
    // Parts of the drawing that are not connected with the centre.
    for (std::uint32_t i = 0; i < fields.size(); ++i) {
        if (distance[i] == no_field) distance[i] = fields[i].distance - 1;
    }
    return distance;
}

/// The field of the kind of another one with its centroid at a place, or `none`.
std::uint32_t field_at(glm::dvec2 place, const Field& like, const std::vector<Field>& fields, const PointGrid& grid) {
    std::uint32_t found = no_field;
    grid.visit(place, 1, [&](std::uint32_t i) {
        const glm::dvec2 gap = fields[i].centroid - place;
        const bool is_alike =
            fields[i].is_odd == like.is_odd && std::fabs(fields[i].area - like.area) <= alike * (1 + like.area);
        if (found == no_field && is_alike && std::hypot(gap.x, gap.y) <= alike) found = i;
    });
    return found;
}

/// For each field the first of its images under the symmetries.
std::vector<std::uint32_t> orbits(const std::vector<Field>& fields, const KolamSymmetry& symmetry, glm::dvec2 centre,
                                  Pulse& pulse) {
    std::vector<glm::dvec2> centroids;
    for (const Field& field : fields) centroids.push_back(field.centroid);
    const PointGrid grid(centroids, 2 * alike);
    std::vector<std::uint32_t> first(fields.size());
    const auto turned = [&](glm::dvec2 place, double angle, bool is_mirrored) {
        if (is_mirrored) place.y = -place.y;
        return complex_product(place, {std::cos(angle), std::sin(angle)});
    };
    for (std::uint32_t i = 0; i < fields.size(); ++i) {
        first[i] = i;
        for (std::uint32_t k = 0; k < symmetry.rotations; ++k) {
            const double angle = 2 * std::numbers::pi * k / symmetry.rotations;
            for (const bool is_mirrored : {false, true}) {
                if (is_mirrored && symmetry.mirrors == 0) continue;
                pulse();
                const double turn = angle + (is_mirrored ? 2 * symmetry.axis : 0);
                const glm::dvec2 place = centre + turned(centroids[i] - centre, turn, is_mirrored);
                const std::uint32_t image = field_at(place, fields[i], fields, grid);
                if (image < first[i]) first[i] = image;
            }
        }
        first[i] = first[first[i]];
    }
    return first;
}

}  // namespace

std::vector<std::uint32_t> classify(const std::vector<Field>& fields, FieldsBy by, const KolamSymmetry& symmetry,
                                    glm::dvec2 centre, const Monitor& monitor) {
    Pulse pulse(monitor);
    std::vector<std::uint32_t> classes(fields.size(), 0);
    switch (by) {
        case FieldsBy::chessboard:
            for (std::size_t i = 0; i < fields.size(); ++i) classes[i] = fields[i].is_odd ? 0 : 1;
            return classes;
        case FieldsBy::kind: {
            const std::vector<std::uint32_t> sizes = sizes_of(fields, monitor);
            return numbered(fields, [&](std::uint32_t i) { return std::pair(fields[i].corners, sizes[i]); });
        }
        case FieldsBy::distance:
            for (std::size_t i = 0; i < fields.size(); ++i) classes[i] = fields[i].distance - 1;
            return classes;
        case FieldsBy::centre:
            return distances_from(centre, fields, pulse);
        case FieldsBy::strand:
            for (std::size_t i = 0; i < fields.size(); ++i) classes[i] = fields[i].orbit;
            return classes;
        case FieldsBy::symmetry:
            break;
    }
    const std::vector<std::uint32_t> first = orbits(fields, symmetry, centre, pulse);
    return numbered(fields, [&](std::uint32_t i) {
        const glm::dvec2 away = fields[first[i]].centroid - centre;
        return std::pair(std::llround(std::hypot(away.x, away.y) / alike), first[i]);
    });
}

}  // namespace sikku
