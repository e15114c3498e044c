#include "art/print/packing.h"
#include "engine/geometry/box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sikku {
namespace {

constexpr int direction_count = 64;  // on either side of the x axis
constexpr double most_waste = 0.1;   // of a level lattice whose rows stand above each other, or in each other's gaps

/// A unit vector with rational coordinates, from -90 to 90 degrees for steps from -direction_count on.
glm::dvec2 direction(int step) {
    const double t = static_cast<double>(step) / direction_count;
    return glm::dvec2(1 - t * t, 2 * t) / (1 + t * t);
}

/// The normals of the sides of a hull that are long enough to touch a neighbour along them.
std::vector<glm::dvec2> side_normals(std::span<const glm::dvec2> hull) {
    const double least = 0.01 * box_of(hull).longest();
    std::vector<glm::dvec2> normals;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 side = hull[(i + 1) % hull.size()] - hull[i];
        if (glm::length(side) > least) normals.push_back(left_of(glm::normalize(side)));
    }
    return normals;
}

/// The difference body of a hull, widened by a gap, as the intersection of strips about the origin.
class DifferenceBody {
public:
    DifferenceBody(std::span<const glm::dvec2> hull, double gap) {
        for (int step = -direction_count; step < direction_count; ++step) add(direction(step), hull, gap);
        for (const glm::dvec2 normal : side_normals(hull)) add(normal, hull, gap);
    }

    /// The least length of a step in a direction that is not inside.
    double reach(glm::dvec2 direction) const {
        double least = 1e300;
        for (const Strip& strip : strips_) {
            const double share = std::fabs(glm::dot(strip.normal, direction));
            if (share > 1e-12) least = std::min(least, strip.half_width / share);
        }
        return least;
    }

    struct Interval {
        double low, high;
    };
    /// The part of a parallel to `along`, `height` to its left, that is inside; nullopt if none is.
    std::optional<Interval> section(glm::dvec2 along, double height) const {
        Interval inside{-1e300, 1e300};
        for (const Strip& strip : strips_) {
            const double share = glm::dot(strip.normal, along);
            const double middle = height * glm::dot(strip.normal, left_of(along));
            if (std::fabs(share) < 1e-12) {
                if (std::fabs(middle) >= strip.half_width) return std::nullopt;
                continue;
            }
            const double a = (-strip.half_width - middle) / share, b = (strip.half_width - middle) / share;
            inside.low = std::max(inside.low, std::min(a, b));
            inside.high = std::min(inside.high, std::max(a, b));
        }
        if (inside.low >= inside.high) return std::nullopt;
        return inside;
    }

private:
    struct Strip {
        glm::dvec2 normal;
        double half_width;
    };
    void add(glm::dvec2 normal, std::span<const glm::dvec2> hull, double gap) {
        double low = 1e300, high = -1e300;
        for (const glm::dvec2 point : hull) {
            low = std::min(low, glm::dot(point, normal));
            high = std::max(high, glm::dot(point, normal));
        }
        strips_.push_back({normal, std::max(high - low + gap, 1e-9)});
    }
    std::vector<Strip> strips_;
};

/// The tightest lattice whose copies touch in rows along a direction.
struct RowPacking {
    glm::dvec2 along{0.0};
    double length = 0;  ///< of a step along a row
    double height = 0;  ///< distance of rows
    double shift = 0;   ///< of the next row, at most half a step either way

    double area() const { return length * height; }
};

RowPacking packed_rows(const DifferenceBody& body, glm::dvec2 along) {
    RowPacking rows{along, body.reach(along)};
    // The copies of the first row leave room for the next one where a section is not longer than their distance.
    double low = 0, high = body.reach(left_of(along));
    while (body.section(along, high)) high *= 2;
    for (int step = 0; step < 50; ++step) {
        const double middle = (low + high) / 2;
        const auto section = body.section(along, middle);
        const bool has_room = !section || section->high - section->low <= rows.length;
        (has_room ? high : low) = middle;
    }
    rows.height = high;
    if (const auto section = body.section(along, high)) {
        rows.shift = section->high - rows.length * std::round(section->high / rows.length);
    }
    return rows;
}

/// Slope of a vector to the right, in tenths of a degree, rounded.
int slope_of(glm::dvec2 vector) {
    constexpr double tenth_of_a_degree = 0.001745;
    return static_cast<int>(std::round(std::fabs(vector.y) / glm::length(vector) / tenth_of_a_degree));
}

/// How far rows are from standing above each other or in each other's gaps, in thousandths of a step.
int unevenness(const PlaneLattice& lattice) {
    const double shift = glm::dot(lattice.up, lattice.across) / glm::dot(lattice.across, lattice.across);
    const double part = std::fabs(shift - std::round(shift));
    return static_cast<int>(std::round(1000 * std::min(part, 0.5 - part)));
}

/// The basis of a lattice with the most level short step.
PlaneLattice levelled(const RowPacking& rows) {
    const glm::dvec2 a = rows.length * rows.along, b = rows.shift * rows.along + rows.height * left_of(rows.along);
    const double longest = 2.1 * std::max(glm::length(a), glm::length(b));
    PlaneLattice best;
    double least = 1e300;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            const glm::dvec2 across = static_cast<double>(i) * a + static_cast<double>(j) * b;
            const double length = glm::length(across);
            if (across.x <= 0 || length > longest) continue;
            const double cost = slope_of(across) + length / longest / 2;
            if (cost >= least) continue;
            for (int k = -3; k <= 3; ++k) {
                for (int l = -3; l <= 3; ++l) {
                    if (std::abs(i * l - j * k) != 1) continue;
                    const glm::dvec2 up = static_cast<double>(k) * a + static_cast<double>(l) * b;
                    const bool is_shorter = cost < least || glm::length(up) < glm::length(best.up) - 1e-9 * longest;
                    if (up.y <= 0 || !is_shorter) continue;
                    best = {across, up};
                    least = cost;
                }
            }
        }
    }
    return best;
}

/// The same for a hull whose size is about 1.
PlaneLattice unit_lattice(std::span<const glm::dvec2> hull, double gap) {
    const DifferenceBody body(hull, gap);
    std::vector<glm::dvec2> directions = {{1, 0}};
    for (int step = -direction_count; step < direction_count; ++step) directions.push_back(direction(step));
    for (const glm::dvec2 normal : side_normals(hull)) directions.push_back(normal);
    std::vector<RowPacking> packings;
    for (const glm::dvec2 along : directions) packings.push_back(packed_rows(body, along));
    const auto tightest =
        std::min_element(packings.begin(), packings.end(),
                         [](const RowPacking& a, const RowPacking& b) { return a.area() < b.area(); });
    const double most_area = (1 + most_waste) * tightest->area();
    PlaneLattice best;
    double least = 1e300;
    for (const RowPacking& rows : packings) {
        if (rows.area() > most_area) continue;
        const PlaneLattice lattice = levelled(rows);
        const bool is_even = slope_of(lattice.across) == 0 && unevenness(lattice) <= 10;
        if (!is_even && rows.area() > 1.001 * tightest->area()) continue;
        const double cost = unevenness(lattice) + slope_of(lattice.across) + rows.area() / most_area;
        if (cost >= least) continue;
        best = lattice;
        least = cost;
    }
    return best;
}

}  // namespace

PlaneLattice densest_lattice(std::span<const glm::dvec2> hull, double gap) {
    const Box box = box_of(hull);
    const double size = std::max({box.longest(), std::fabs(gap), 1e-9});
    if (!std::isfinite(size)) throw std::runtime_error("the drawing is too large to be packed");
    const double unit = std::scalbn(1.0, std::ilogb(size));  // a power of two keeps the bits
    std::vector<glm::dvec2> scaled;
    for (const glm::dvec2 point : hull) scaled.push_back((point - box.low) / unit);
    const PlaneLattice found = unit_lattice(scaled, gap / unit);
    return {unit * found.across, unit * found.up};
}

}  // namespace sikku
