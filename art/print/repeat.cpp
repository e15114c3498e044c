#include "art/print/repeat.h"

#include "art/print/crop.h"
#include "art/print/packing.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

/// An operation x' = a x + b y + c, y' = d x + e y + f in coordinates of the cell, or of a rectangular unit.
struct Operation {
    double a, b, c, d, e, f;
};

enum class LatticeKind { rectangular, square, hexagonal, densest };

/// A group of the plane. The asymmetric unit of a rectangular one is a rectangle of any proportions, in which
/// coordinates are measured; the others have a polygon in coordinates of the cell.
/// Source: International Tables for Crystallography, vol. A, 2002, part 6: the plane groups.
struct Group {
    std::string_view name;
    LatticeKind lattice = LatticeKind::rectangular;
    int wide = 1, high = 1;  ///< size of a rectangular cell, in units
    std::vector<Operation> operations{};
    std::vector<glm::dvec2> unit{};  ///< corners of the asymmetric unit
    bool is_frieze = false;
};

constexpr Operation identity{1, 0, 0, 0, 1, 0};

std::vector<Group> make_groups() {
    const auto half_turn = [](double x, double y) { return Operation{-1, 0, x, 0, -1, y}; };
    const auto flip_x = [](double x, double y) { return Operation{-1, 0, x, 0, 1, y}; };
    const auto flip_y = [](double x, double y) { return Operation{1, 0, x, 0, -1, y}; };
    const std::vector<Operation> pmm = {identity, flip_x(2, 0), flip_y(0, 2), half_turn(2, 2)};
    const std::vector<Operation> pmg = {identity, flip_x(2, 0), flip_y(2, 1), half_turn(4, 1)};
    const std::vector<Operation> p4 = {identity, {0, -1, 0, 1, 0, 0}, half_turn(0, 0), {0, 1, 0, -1, 0, 0}};
    const std::vector<Operation> p3 = {identity, {0, -1, 0, 1, -1, 0}, {-1, 1, 0, -1, 0, 0}};
    const std::vector<Operation> p3m1 = {{0, -1, 0, -1, 0, 0}, {-1, 1, 0, 0, 1, 0}, {1, 0, 0, 1, -1, 0}};
    const std::vector<Operation> p31m = {{0, 1, 0, 1, 0, 0}, {1, -1, 0, 0, -1, 0}, {-1, 0, 0, -1, 1, 0}};
    const auto with = [](std::vector<Operation> all, const std::vector<Operation>& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const auto turned = [](std::vector<Operation> all) {
        for (Operation& each : all) each = {-each.a, -each.b, each.c, -each.d, -each.e, each.f};
        return all;
    };
    const std::vector<Operation> p4m =
        with(p4, {flip_x(0, 0), flip_y(0, 0), {0, 1, 0, 1, 0, 0}, {0, -1, 0, -1, 0, 0}});
    const std::vector<Operation> p4g =
        with(p4, {flip_x(0.5, 0.5), flip_y(0.5, 0.5), {0, 1, 0.5, 1, 0, 0.5}, {0, -1, 0.5, -1, 0, 0.5}});
    const std::vector<glm::dvec2> sixth = {{0, 0}, {0.5, 0}, {2. / 3, 1. / 3}, {0.5, 0.5}};
    using enum LatticeKind;
    return {
        {"p1", rectangular, 1, 1, {identity}},
        {"p2", rectangular, 2, 1, {identity, half_turn(2, 1)}},
        {"pm", rectangular, 2, 1, {identity, flip_x(2, 0)}},
        {"pg", rectangular, 2, 1, {identity, flip_y(1, 1)}},
        {"cm", rectangular, 2, 2, {identity, flip_x(2, 0), {1, 0, 1, 0, 1, 1}, flip_x(1, 1)}},
        {"pmm", rectangular, 2, 2, pmm},
        {"pmg", rectangular, 4, 1, pmg},
        {"pgg", rectangular, 2, 2, {identity, flip_y(1, 1), flip_x(1, 1), half_turn(2, 2)}},
        {"cmm",
         rectangular,
         4,
         2,
         {identity,
          flip_x(0, 0),
          flip_y(0, 0),
          half_turn(0, 0),
          {1, 0, 2, 0, 1, 1},
          flip_x(2, 1),
          flip_y(2, 1),
          half_turn(2, 1)}},
        {"p4", square, 1, 1, p4, {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}},
        {"p4m", square, 1, 1, p4m, {{0, 0}, {0.5, 0}, {0.5, 0.5}}},
        {"p4g", square, 1, 1, p4g, {{0, 0}, {0.5, 0}, {0, 0.5}}},
        {"p3", hexagonal, 1, 1, p3, {{0, 0}, {0.5, 0}, {2. / 3, 1. / 3}, {1. / 3, 2. / 3}, {0, 0.5}}},
        {"p3m1", hexagonal, 1, 1, with(p3, p3m1), {{0, 0}, {2. / 3, 1. / 3}, {1. / 3, 2. / 3}}},
        {"p31m", hexagonal, 1, 1, with(p3, p31m), sixth},
        {"p6", hexagonal, 1, 1, with(p3, turned(p3)), sixth},
        {"p6m", hexagonal, 1, 1, with(with(p3, turned(p3)), with(p3m1, p31m)), {{0, 0}, {0.5, 0}, {2. / 3, 1. / 3}}},
        {"packed", densest, 1, 1, {identity}},
        {"frieze", rectangular, 1, 1, {identity}, {}, true},
        {"frieze-p11g", rectangular, 2, 1, {identity, flip_y(1, 1)}, {}, true},
        {"frieze-p1m1", rectangular, 2, 1, {identity, flip_x(2, 0)}, {}, true},
        {"frieze-p11m", rectangular, 1, 2, {identity, flip_y(0, 2)}, {}, true},
        {"frieze-p2", rectangular, 2, 1, {identity, half_turn(2, 1)}, {}, true},
        {"frieze-p2mg", rectangular, 4, 1, pmg, {}, true},
        {"frieze-p2mm", rectangular, 2, 2, pmm, {}, true},
    };
}

const std::vector<Group>& groups() {
    static const std::vector<Group> all = make_groups();
    return all;
}

const Group* find_group(std::string_view name) {
    const auto found =
        std::find_if(groups().begin(), groups().end(), [&](const Group& group) { return group.name == name; });
    return found == groups().end() ? nullptr : &*found;
}

constexpr std::string_view ring = "ring";

/// A polygon as half planes.
std::vector<HalfPlane> half_planes(const std::vector<glm::dvec2>& corners) {
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 one = corners[i], two = corners[(i + 1) % corners.size()];
        area += one.x * two.y - two.x * one.y;
    }
    std::vector<HalfPlane> planes;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
        const glm::dvec2 normal = glm::normalize(glm::dvec2(side.y, -side.x)) * (area < 0 ? -1.0 : 1.0);
        planes.push_back({normal, glm::dot(normal, corners[i])});
    }
    return planes;
}

/// Extent of points in a direction.
double reach(std::span<const glm::dvec2> points, glm::dvec2 direction) {
    double most = -1e300;
    for (const glm::dvec2 point : points) most = std::max(most, glm::dot(point, direction));
    return most;
}

/// The least multiple of a polygon with room for a hull with half a gap around it, and the hull's place.
struct Fit {
    double size = 0;
    glm::dvec2 shift{0.0};
};

/// A linear program in three variables: its optimum lies where three sides are touched.
Fit fit_hull(std::span<const glm::dvec2> hull, const std::vector<glm::dvec2>& corners, double gap) {
    const std::vector<HalfPlane> planes = half_planes(corners);
    std::vector<double> reaches;
    for (const HalfPlane& plane : planes) reaches.push_back(reach(hull, plane.normal) + gap / 2);
    Fit best{1e300, {}};
    const auto tolerance = [](double size) { return 1e-9 * std::max(1.0, std::fabs(size)); };
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                // Rows: normal . shift - offset * size = -reach.
                glm::dmat3 rows(0.0);
                glm::dvec3 right(0.0);
                int row = 0;
                for (const std::size_t at : {i, j, k}) {
                    rows[0][row] = planes[at].normal.x;
                    rows[1][row] = planes[at].normal.y;
                    rows[2][row] = -planes[at].offset;
                    right[row++] = -reaches[at];
                }
                if (std::fabs(glm::determinant(rows)) < 1e-12) continue;
                const glm::dvec3 found = glm::inverse(rows) * right;
                const auto has_room = [&](std::size_t at) {
                    return glm::dot(planes[at].normal, glm::dvec2(found)) + reaches[at] <=
                           planes[at].offset * found.z + tolerance(found.z);
                };
                bool fits = found.z < best.size;
                for (std::size_t at = 0; at < planes.size() && fits; ++at) fits = has_room(at);
                if (fits) best = {found.z, glm::dvec2(found)};
            }
        }
    }
    if (!(best.size < 1e300)) throw std::logic_error("a hull has no room in a unit");
    return best;
}

glm::dmat3x2 compose(const glm::dmat3x2& outer, const glm::dmat3x2& inner) {
    const glm::dmat2x2 linear(outer[0], outer[1]);
    return {linear * inner[0], linear * inner[1], linear * inner[2] + outer[2]};
}

/// An operation in coordinates of two vectors, after a shift.
glm::dmat3x2 placed(const Operation& operation, glm::dvec2 a, glm::dvec2 b, glm::dvec2 shift) {
    const glm::dmat2x2 basis(a, b);
    const glm::dmat2x2 linear(glm::dvec2(operation.a, operation.d), glm::dvec2(operation.b, operation.e));
    glm::dmat2x2 turned = basis * linear * glm::inverse(basis);
    // Halves and wholes are exact, so that quarter turns keep lines straight.
    for (int column = 0; column < 2; ++column) {
        for (int row = 0; row < 2; ++row) {
            const double exact = std::round(2 * turned[column][row]) / 2 + 0.0;
            if (std::fabs(turned[column][row] - exact) < 1e-9) turned[column][row] = exact;
        }
    }
    const glm::dmat3x2 map(turned[0], turned[1], basis * glm::dvec2(operation.c, operation.f));
    return compose(map, {{1, 0}, {0, 1}, shift});
}

std::vector<glm::dmat3x2> ring_of(int count, std::span<const glm::dvec2> hull, const Box& box, double gap) {
    const glm::dvec2 centre = (box.low + box.high) / 2.0;
    const double half = std::numbers::pi / count;
    double radius = 0;
    for (const glm::dvec2 point : hull) {
        if (count == 1) break;
        const glm::dvec2 from = point - centre;
        const double side = count == 2 ? 0.0 : std::fabs(from.x) * std::cos(half);
        radius = std::max(radius, (side + gap / 2) / std::sin(half) - from.y);
    }
    std::vector<glm::dmat3x2> copies;
    for (int i = 0; i < count; ++i) {
        PlacementOptions turn;
        turn.rotate = -360.0 * i / count;
        copies.push_back(compose(orientation(turn), {{1, 0}, {0, 1}, glm::dvec2(0, radius) - centre}));
    }
    return copies;
}

bool read_count(std::string_view text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value >= 1 && value <= most_copies;
}

/// Parses `3x4`, `fill` or `3xfill`; for a frieze, `3` or `fill`; for a ring, `3`.
bool read_cells(std::string_view text, bool is_row, Repeat& repeat) {
    if (is_row && repeat.group != ring && text == "fill") {
        repeat.columns = 1;
        repeat.fills = true;
        return true;
    }
    if (is_row) return read_count(text, repeat.columns);
    const std::size_t x = std::min(text.find('x'), text.size());
    repeat.fills = text == "fill" || (x < text.size() && text.substr(x + 1) == "fill");
    if (text == "fill") return true;
    if (x == text.size() || !read_count(text.substr(0, x), repeat.columns)) return false;
    if (!repeat.fills) return read_count(text.substr(x + 1), repeat.rows);
    // An upright page of paper is 1.41 times as high as wide.
    repeat.rows = repeat.columns + (repeat.columns + 1) / 2;
    return true;
}

}  // namespace

int Repeat::copies() const {
    if (group == ring) return columns;
    return columns * rows * static_cast<int>(find_group(group)->operations.size());
}

std::optional<Repeat> parse_repeat(std::string_view text) {
    Repeat repeat;
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view head = trimmed(text.substr(0, comma));
    const std::size_t colon = std::min(head.find(':'), head.size());
    repeat.group = lower_case(trimmed(head.substr(0, colon)));
    const Group* group = find_group(repeat.group);
    const bool is_ring = repeat.group == ring;
    if (!group && !is_ring) return std::nullopt;
    const bool is_row = is_ring || group->is_frieze;
    repeat.columns = is_ring ? 8 : is_row ? 5 : 3;
    repeat.rows = is_row ? 1 : 3;
    if (colon < head.size()) {
        const bool is_read = read_cells(lower_case(trimmed(head.substr(colon + 1))), is_row, repeat);
        if (!is_read) return std::nullopt;
    }
    if (comma < text.size()) {
        std::string gap = lower_case(trimmed(text.substr(comma + 1)));
        if (!gap.starts_with("gap=")) return std::nullopt;
        gap.erase(0, 4);
        repeat.gap_is_in_steps = !gap.ends_with('%');
        if (!repeat.gap_is_in_steps) gap.pop_back();
        if (!read_number(gap, repeat.gap) || !(std::fabs(repeat.gap) <= 1e6)) return std::nullopt;
        if (!repeat.gap_is_in_steps) repeat.gap /= 100;
    }
    const double copies = static_cast<double>(repeat.columns) * repeat.rows *
                          (group ? static_cast<double>(group->operations.size()) : 1.0);
    if (copies > most_copies) return std::nullopt;
    return repeat;
}

std::vector<std::string_view> repeat_groups() {
    std::vector<std::string_view> names;
    for (const Group& group : groups()) names.push_back(group.name);
    names.push_back(ring);
    return names;
}

Wallpaper wallpaper_of(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink) {
    Box box;
    for (const glm::dvec2 point : hull) box.add(point);
    const glm::dvec2 size = box.high - box.low;
    const double gap = ink + repeat.gap * (repeat.gap_is_in_steps ? 1.0 : std::max(size.x, size.y));
    const Group& group = *find_group(repeat.group);
    Wallpaper wallpaper;
    wallpaper.is_row = group.is_frieze;
    glm::dvec2 a, b, shift;
    if (group.lattice == LatticeKind::rectangular) {
        // Copies may overlap, but the vectors between cells keep their directions.
        const glm::dvec2 unit(std::max(size.x + gap, 1e-9), std::max(size.y + gap, 1e-9));
        a = {unit.x, 0};
        b = {0, unit.y};
        wallpaper.across = static_cast<double>(group.wide) * a;
        wallpaper.up = static_cast<double>(group.high) * b;
        shift = unit / 2.0 - (box.low + box.high) / 2.0;
    } else if (group.lattice == LatticeKind::densest) {
        const PlaneLattice lattice = densest_lattice(hull, gap);
        wallpaper.across = a = lattice.across;
        wallpaper.up = b = lattice.up;
        shift = -(box.low + box.high) / 2.0;
    } else {
        a = {1, 0};
        b = group.lattice == LatticeKind::square ? glm::dvec2(0, 1) : glm::dvec2(-0.5, std::sqrt(0.75));
        std::vector<glm::dvec2> unit;
        for (const glm::dvec2 corner : group.unit) unit.push_back(corner.x * a + corner.y * b);
        const Fit fit = fit_hull(hull, unit, gap);
        const double cell = std::max(fit.size, 1e-9);
        a *= cell;
        b *= cell;
        wallpaper.across = a;
        wallpaper.up = b;
        shift = fit.shift;
    }
    for (const Operation& operation : group.operations) wallpaper.cell.push_back(placed(operation, a, b, shift));
    return wallpaper;
}

std::vector<glm::dmat3x2> copies_of(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink) {
    if (repeat.group == ring) {
        Box box;
        for (const glm::dvec2 point : hull) box.add(point);
        const glm::dvec2 size = box.high - box.low;
        const double gap = ink + repeat.gap * (repeat.gap_is_in_steps ? 1.0 : std::max(size.x, size.y));
        return ring_of(repeat.columns, hull, box, gap);
    }
    const Wallpaper wallpaper = wallpaper_of(repeat, hull, ink);
    const LatticeKind lattice = find_group(repeat.group)->lattice;
    const double shift = glm::dot(wallpaper.up, wallpaper.across) / glm::dot(wallpaper.across, wallpaper.across);
    std::vector<glm::dmat3x2> copies;
    copies.reserve(static_cast<std::size_t>(repeat.copies()));
    for (int row = repeat.rows - 1; row >= 0; --row) {
        for (int column = 0; column < repeat.columns; ++column) {
            // Oblique rows are moved back, so that the whole is about a rectangle.
            const double back = lattice == LatticeKind::hexagonal ? std::floor(row / 2.0)
                                : lattice == LatticeKind::densest ? -std::floor(row * shift + 1e-9)
                                                                  : 0;
            const glm::dvec2 cell = (column + back) * wallpaper.across + static_cast<double>(row) * wallpaper.up;
            for (glm::dmat3x2 copy : wallpaper.cell) {
                copy[2] += cell;
                copies.push_back(copy);
            }
        }
    }
    return copies;
}

double covered_share(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink) {
    const Wallpaper wallpaper = wallpaper_of(repeat, hull, ink);
    const glm::dvec2 a = wallpaper.across, b = wallpaper.up;
    const double cell = std::fabs(a.x * b.y - a.y * b.x);
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 from = hull[i], to = hull[(i + 1) % hull.size()];
        twice += from.x * to.y - from.y * to.x;
    }
    return std::min(1.0, std::fabs(twice) / 2 * static_cast<double>(wallpaper.cell.size()) / cell);
}

std::vector<glm::dmat3x2> covering_copies(const Wallpaper& wallpaper, const Box& box, const Box& area) {
    std::vector<Box> one;  // box of each copy in the cell
    Box cell;
    for (const glm::dmat3x2& copy : wallpaper.cell) {
        Box& of_copy = one.emplace_back();
        for (const double x : {box.low.x, box.high.x}) {
            for (const double y : {box.low.y, box.high.y}) of_copy.add(copy * glm::dvec3(x, y, 1));
        }
        cell.add(of_copy.low);
        cell.add(of_copy.high);
    }
    // The translations that may bring the cell into the area.
    const glm::dmat2x2 to_lattice = glm::inverse(glm::dmat2x2(wallpaper.across, wallpaper.up));
    Box range;
    for (const double x : {area.low.x - cell.high.x, area.high.x - cell.low.x}) {
        for (const double y : {area.low.y - cell.high.y, area.high.y - cell.low.y}) {
            range.add(to_lattice * glm::dvec2(x, y));
        }
    }
    constexpr double slack = 1e-9;
    glm::dvec2 low = glm::ceil(range.low - slack), high = glm::floor(range.high + slack);
    if (wallpaper.is_row) low.y = high.y = 0;
    const auto refuse = [] {
        throw std::runtime_error(fmt::format(
            "the page would be filled with more than {} copies: a longer step or fewer columns are needed",
            most_copies));
    };
    if (!((high.x - low.x + 1) * (high.y - low.y + 1) <= 16.0 * most_copies)) refuse();
    std::vector<glm::dmat3x2> copies;
    for (double row = high.y; row >= low.y; --row) {
        for (double column = low.x; column <= high.x; ++column) {
            const glm::dvec2 shift = column * wallpaper.across + row * wallpaper.up;
            for (std::size_t i = 0; i < one.size(); ++i) {
                const glm::dvec2 from = one[i].low + shift, to = one[i].high + shift;
                if (from.x > area.high.x || from.y > area.high.y || to.x < area.low.x || to.y < area.low.y) continue;
                copies.push_back(wallpaper.cell[i]);
                copies.back()[2] += shift;
                if (copies.size() > static_cast<std::size_t>(most_copies)) refuse();
            }
        }
    }
    return copies;
}

}  // namespace sikku
