// engine/tiling/tile_plane.h: the points of a tiling, numbered: whole coordinates of a lattice, or doubles with a
// tolerance; and the directions of its edges.
#pragma once

#include "engine/geometry/cyclotomic.h"
#include "engine/geometry/place_table.h"
#include "engine/tiling/point_blocks.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Points and edges of tiles in the plane. Exact on a lattice: equality and collinearity are decided by whole
/// numbers, signs by intervals that are refined until they exclude 0. Otherwise points within tolerance() of each
/// other are one.
class TilePlane {
public:
    /// Thrown by point(): coordinates of the lattice are larger than 2^26.
    struct OutOfRange {};
    /// Tolerance for positions that a turtle computed, in steps.
    static constexpr double least_tolerance = 1e-6;

    /// @param exact  use the lattice, if it has coordinates
    TilePlane(const Lattice& lattice, bool exact);
    /// A plane for points that were measured or rounded. @param tolerance  greater than 0
    explicit TilePlane(double tolerance);

    bool is_exact() const { return numbers_.has_value(); }
    /// True if positions were measured or rounded, or computed with errors for which least_tolerance is too small or
    /// too large.
    bool is_rough() const { return !is_exact() && tolerance_ != least_tolerance; }
    /// Distance within which points are one, if the plane is not exact.
    double tolerance() const { return tolerance_; }
    const Lattice& lattice() const { return lattice_; }
    /// Only for an exact plane.
    const Cyclotomic& numbers() const { return *numbers_; }

    /// The number of a point. @param coordinates  those of the lattice; ignored if the plane is not exact
    std::uint32_t point(std::span<const std::int64_t> coordinates, glm::dvec2 place);
    /// The number of a known point, or no_number. An exact plane ignores `place`, another one `coordinates`.
    std::uint32_t find(const Cyclotomic::Number& coordinates, glm::dvec2 place) const;
    /// Reserves memory for a number of points in an exact plane.
    void expect_points(std::size_t points) { exact_points_.reserve(points); }
    std::size_t points() const { return is_exact() ? exact_points_.size() : points_.size(); }
    glm::dvec2 at(std::uint32_t point) const {
        return is_exact() ? place_of(exact_points_.coordinates(point)) : points_.at(point);
    }
    Cyclotomic::Number coordinates(std::uint32_t point) const;
    /// Adds the coordinates of a point of an exact plane to a sum.
    void add_to(Cyclotomic::Number& sum, std::uint32_t point) const {
        const std::int32_t* const coordinates = exact_points_.coordinates(point);
        for (std::size_t i = 0; i < rank_; ++i) sum[i] += coordinates[i];
    }
    /// The coordinates of a point relative to another.
    Cyclotomic::Number way(std::uint32_t from, std::uint32_t to) const;

    /// The number of the vector between two points; equal vectors have one number.
    std::uint32_t vector(std::uint32_t from, std::uint32_t to);
    /// The number of a known vector, or no_number; as find().
    std::uint32_t find_vector(const Cyclotomic::Number& coordinates, glm::dvec2 place) const;
    std::size_t vectors() const { return vectors_.size(); }
    glm::dvec2 vector_at(std::uint32_t vector) const { return vectors_.at(vector); }
    Cyclotomic::Number vector_coordinates(std::uint32_t vector) const;

    /// 1 if `to` lies left of the line from `origin` through `along`, 0 on it, -1 right of it.
    int side(std::uint32_t origin, std::uint32_t along, std::uint32_t to) const;
    /// The same for two vectors of an exact plane: 1 if the second is turned to the left of the first by less than
    /// 180 degrees.
    int turn(std::uint32_t first, std::uint32_t second) const;

    /// Sorts the directions of all vectors and their opposites anticlockwise. Only for an exact plane: rounded ones
    /// have no clear number of directions. Cost: v log v.
    void sort_directions();
    /// Number of different directions, even; the opposite of d is d + directions() / 2.
    std::uint32_t directions() const { return directions_; }
    std::uint32_t direction(std::uint32_t vector) const { return direction_[vector]; }

private:
    using Coordinates = std::array<std::int32_t, 8>;
    Coordinates small(std::span<const std::int64_t> coordinates) const;
    Cyclotomic::Number number(const std::int32_t* coordinates) const;
    /// The same as the place of a turtle with these coordinates.
    template <class Number>
    glm::dvec2 place_of(const Number* coordinates) const {
        glm::dvec2 sum(0.0);
        for (std::size_t i = 0; i < rank_; ++i) sum += static_cast<double>(coordinates[i]) * basis_[i];
        return sum;
    }

    Lattice lattice_;
    std::optional<Cyclotomic> numbers_;
    std::size_t rank_;
    std::array<glm::dvec2, 8> basis_{};
    double tolerance_;
    PointBlocks exact_points_;
    PlaceTable<std::int32_t> points_;  // if the plane is not exact
    PlaceTable<std::int32_t> vectors_;
    std::vector<std::uint32_t> direction_;  // of vectors
    std::uint32_t directions_ = 0;
};

}  // namespace sikku
