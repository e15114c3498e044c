// art/cutting/no_fit.h: where a piece overlaps another: the no-fit polygon of two outlines.
#pragma once

#include "engine/geometry/box.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace sikku {

using Outline = std::vector<glm::dvec2>;

/// Divides a simple polygon into convex ones: triangles, joined as long as they stay convex. Cost: k^3 at most, for k
/// corners. @param corners  anticlockwise
std::vector<Outline> convex_parts(std::span<const glm::dvec2> corners);

/// The displacements by which one polygon, moved, overlaps another that stays: the union of the Minkowski sums of
/// their convex parts, one of them turned by 180 degrees (Lozano-Pérez 1983). Its border includes that of holes, and
/// single points where the moved polygon just fits.
class NoFit {
public:
    /// Polygons that overlap by less touch. Millimetres.
    static constexpr double touching = 1e-7;
    struct Side {
        glm::dvec2 from, to;
    };

    /// Cost: (p q)^2 for p and q parts of few corners.
    NoFit(const std::vector<Outline>& fixed, const std::vector<Outline>& moved);

    bool overlaps(glm::dvec2 displacement) const;
    const std::vector<Side>& sides() const { return sides_; }          ///< of the border
    const std::vector<glm::dvec2>& points() const { return points_; }  ///< corners of the border, and single points
    const Box& box() const { return box_; }

private:
    /// A half plane: the points whose product with the normal is less than the limit.
    struct Half {
        glm::dvec2 normal;
        double limit;
    };
    struct Sum {
        Box box;
        std::size_t begin, end;  ///< its sides, in halves_
    };
    void add_sum(const Outline& fixed, const Outline& moved, std::vector<Outline>& sums);
    void find_border(const std::vector<Outline>& sums);

    std::vector<Half> halves_;
    std::vector<Sum> sums_;
    std::vector<Side> sides_;
    std::vector<glm::dvec2> points_;
    Box box_;
};

}  // namespace sikku
