#include "engine/tiling/tile_plane.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr std::int64_t largest_coordinate = std::int64_t{1} << 26;
/// Relative error of determinants in doubles that counts as certain.
constexpr double certain = 1e-9;

}  // namespace

TilePlane::TilePlane(const Lattice& lattice, bool exact)
    : lattice_(lattice),
      numbers_(exact && lattice.rank > 0 ? std::optional<Cyclotomic>(lattice) : std::nullopt),
      rank_(numbers_ ? numbers_->rank() : 0),
      tolerance_(least_tolerance),
      exact_points_(rank_),
      points_(0, tolerance_),
      vectors_(rank_, 4 * tolerance_) {
    for (std::size_t i = 0; i < rank_; ++i) basis_[i] = lattice_.unit * lattice_.basis(static_cast<int>(i));
}

TilePlane::TilePlane(double tolerance)
    : rank_(0), tolerance_(tolerance), exact_points_(0), points_(0, tolerance), vectors_(0, 4 * tolerance) {}

TilePlane::Coordinates TilePlane::small(std::span<const std::int64_t> coordinates) const {
    Coordinates small{};
    for (std::size_t i = 0; i < rank_; ++i) {
        if (coordinates[i] > largest_coordinate || coordinates[i] < -largest_coordinate) throw OutOfRange();
        small[i] = static_cast<std::int32_t>(coordinates[i]);
    }
    return small;
}

std::uint32_t TilePlane::point(std::span<const std::int64_t> coordinates, glm::dvec2 place) {
    if (!is_exact()) return points_.add(nullptr, place);
    const Coordinates exact = small(coordinates);
    return exact_points_.add(exact.data(), place_of(exact.data()));
}

std::uint32_t TilePlane::find(const Cyclotomic::Number& coordinates, glm::dvec2 place) const {
    if (!is_exact()) return points_.find(nullptr, place);
    try {
        const Coordinates exact = small(coordinates);
        return exact_points_.find(exact.data(), place_of(exact.data()));
    } catch (const OutOfRange&) {
        return no_number;
    }
}
std::uint32_t TilePlane::find_vector(const Cyclotomic::Number& coordinates, glm::dvec2 place) const {
    try {
        return vectors_.find(small(coordinates).data(), place);
    } catch (const OutOfRange&) {
        return no_number;
    }
}

Cyclotomic::Number TilePlane::number(const std::int32_t* coordinates) const {
    Cyclotomic::Number result{};
    std::copy_n(coordinates, rank_, result.begin());
    return result;
}
Cyclotomic::Number TilePlane::coordinates(std::uint32_t point) const {
    return number(exact_points_.coordinates(point));
}
Cyclotomic::Number TilePlane::way(std::uint32_t from, std::uint32_t to) const {
    const std::int32_t *begin = exact_points_.coordinates(from), *end = exact_points_.coordinates(to);
    Cyclotomic::Number result{};
    for (std::size_t i = 0; i < rank_; ++i) result[i] = end[i] - begin[i];
    return result;
}
Cyclotomic::Number TilePlane::vector_coordinates(std::uint32_t vector) const {
    return number(vectors_.coordinates(vector));
}

std::uint32_t TilePlane::vector(std::uint32_t from, std::uint32_t to) {
    if (!is_exact()) return vectors_.add(nullptr, at(to) - at(from));
    const Cyclotomic::Number difference = way(from, to);
    Coordinates narrow{};
    for (std::size_t i = 0; i < rank_; ++i) narrow[i] = static_cast<std::int32_t>(difference[i]);
    return vectors_.add(narrow.data(), place_of(difference.data()));
}

int TilePlane::side(std::uint32_t origin, std::uint32_t along, std::uint32_t to) const {
    const glm::dvec2 a = at(along) - at(origin), b = at(to) - at(origin);
    const double length = std::sqrt(scalar_product(a, a));
    const double height = determinant(a, b) / length;
    if (!is_exact()) return height > tolerance_ ? 1 : height < -tolerance_ ? -1 : 0;
    const double size = length + std::sqrt(scalar_product(b, b));
    if (std::fabs(height) > certain * (1 + size)) return height > 0 ? 1 : -1;
    return numbers_->sign_imaginary(numbers_->conjugate_product(way(origin, along), way(origin, to)));
}

int TilePlane::turn(std::uint32_t first, std::uint32_t second) const {
    const glm::dvec2 a = vector_at(first), b = vector_at(second);
    const double sine = determinant(a, b) / std::sqrt(scalar_product(a, a) * scalar_product(b, b));
    if (std::fabs(sine) > 1e-3) return sine > 0 ? 1 : -1;
    return numbers_->sign_imaginary(
        numbers_->conjugate_product(vector_coordinates(first), vector_coordinates(second)));
}

void TilePlane::sort_directions() {
    // Each vector in the half turn from the x axis on; the other half are opposites.
    struct Ray {
        double angle;
        std::uint32_t vector;
        bool is_opposite;
    };
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < vectors(); ++i) {
        glm::dvec2 along = vector_at(i);
        const bool is_opposite = along.y < 0 || (along.y == 0 && along.x < 0);
        if (is_opposite) along = -along;
        rays.push_back({std::atan2(along.y, along.x), i, is_opposite});
    }
    std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) {
        return a.angle != b.angle ? a.angle < b.angle : a.vector < b.vector;
    });
    // Directions that doubles do not distinguish are sorted by signs.
    const auto parallel = [&](const Ray& a, const Ray& b) { return turn(a.vector, b.vector) == 0; };
    const auto order = [&](const Ray& a, const Ray& b) {
        const int sign = turn(a.vector, b.vector) * (a.is_opposite == b.is_opposite ? 1 : -1);
        return sign != 0 ? sign > 0 : a.vector < b.vector;
    };
    constexpr double close = 1e-9;
    for (auto begin = rays.begin(); begin != rays.end();) {
        auto end = begin + 1;
        while (end != rays.end() && end->angle - (end - 1)->angle < close) ++end;
        std::sort(begin, end, order);
        begin = end;
    }
    std::vector<std::uint32_t> half(rays.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i > 0 && !parallel(rays[i - 1], rays[i])) ++count;
        half[i] = count;
    }
    const std::uint32_t last = count;
    // The first and the last may be one direction, near the x axis.
    const bool wraps = last > 0 && parallel(rays.back(), rays.front());
    count = rays.empty() ? 0 : last + (wraps ? 0 : 1);
    directions_ = 2 * count;
    direction_.assign(rays.size(), 0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool is_wrapped = wraps && half[i] == last;
        const std::uint32_t opposite = (rays[i].is_opposite ? count : 0U) + (is_wrapped ? count : 0U);
        direction_[rays[i].vector] = ((is_wrapped ? 0 : half[i]) + opposite) % directions_;
    }
}

}  // namespace sikku
