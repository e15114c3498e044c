// art/kolam/kolam_plane.h: geometric predicates for examinations, in exact whole numbers, and in doubles with a
// tolerance.
#pragma once

#include "engine/base/numbers.h"
#include "engine/geometry/cyclotomic.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/place_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku::kolam_plane {

using Wide = Int128;

constexpr std::uint32_t none = no_number;
constexpr double steps_are_one = 1e-6;
constexpr long double pi = 3.141592653589793238462643383279502884L;  // libc++ 13 has only double precision

inline int sign_of(double value) {
    return (value > 0) - (value < 0);
}

/// A straight piece from node to node. Directions are anticlockwise, in units of which Plane::turn() are a full turn.
struct Segment {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double direction = 0.0;
};

/// A point of a segment where it is cut: a node, or where another segment crosses it.
struct Cut {
    std::uint32_t segment = 0;
    std::uint32_t other = 0;  ///< node, or the segment that crosses
    std::uint32_t vertex = 0;
    bool is_crossing = false;
    double along = 0.0;  ///< roughly, in steps from the segment's beginning
};

/// Points of Z[zeta]; all predicates are computed without rounding.
class ExactPlane {
public:
    explicit ExactPlane(const Lattice& lattice)
        : lattice_(lattice), numbers_(lattice), turn_(numbers_.roots()), rank_(numbers_.rank()), nodes_(rank_, 0) {}

    /// Thrown by node() if sums of coordinates might not fit into 64 bits.
    struct OutOfRange {};

    static constexpr bool is_exact = true;
    double turn() const { return turn_; }
    bool same_direction(double a, double b) const { return a == b; }
    /// Maximum error of coordinates in doubles.
    double rounding() const { return 1e-15 * static_cast<double>(rank_) * largest_ * lattice_.unit + 1e-300; }
    std::size_t size() const { return nodes_.size(); }
    glm::dvec2 at(std::uint32_t node) const { return nodes_.at(node); }
    std::span<const glm::dvec2> places() const { return nodes_.places(); }

    std::uint32_t node(std::span<const std::int64_t> coordinates, glm::dvec2 place) {
        const std::size_t known = nodes_.size();
        const std::uint32_t node = nodes_.add(coordinates.data(), place);
        if (nodes_.size() == known) return node;
        for (const std::int64_t coordinate : coordinates) {
            largest_ = std::max(largest_, std::fabs(static_cast<double>(coordinate)));
        }
        if (largest_ > 0x1p52) throw OutOfRange();
        return node;
    }

    /// Direction of a step, which is a power of zeta.
    double direction(std::uint32_t from, std::uint32_t to) const {
        const long double turned = numbers_.angle(between(from, to)) / (2 * pi) * turn_;
        return static_cast<double>((std::llround(turned) + turn_) % turn_);
    }

    /// 1 if the node lies left of the segment's line, 0 on it, -1 right of it.
    int side(const Segment& line, std::uint32_t node) const {
        return numbers_.sign_imaginary(numbers_.rotated(between(line.from, node), -index(line)));
    }
    /// 1 if `b` lies farther along the line than `a`, 0 if neither does.
    int order(const Segment& line, std::uint32_t a, std::uint32_t b) const {
        return numbers_.sign_real(numbers_.rotated(between(a, b), -index(line)));
    }
    /// Order of two cuts along their segment: negative, 0 (they are one point), positive.
    int compare(std::span<const Segment> segments, const Cut& a, const Cut& b) const {
        const Segment& line = segments[a.segment];
        if (!a.is_crossing && !b.is_crossing) return a.other == b.other ? 0 : -order(line, a.other, b.other);
        if (a.is_crossing != b.is_crossing) {
            const Cut& crossing = a.is_crossing ? a : b;
            const std::uint32_t node = a.is_crossing ? b.other : a.other;
            const Segment& other = segments[crossing.other];
            const int node_is_behind = side(other, node) * sign_of_sine(index(line) - index(other));
            return a.is_crossing ? -node_is_behind : node_is_behind;
        }
        // Let y be the vector to the other line, and w the direction of this one, both turned by the direction of the
        // other line: the crossing lies Im y / Im w along; 2 Im y Im w = Re(y conj(w)) - Re(y w).
        const Segment& first = segments[a.other];
        const Segment& second = segments[b.other];
        const Vector way_1 = numbers_.rotated(between(line.from, first.from), -index(first));
        const Vector way_2 = numbers_.rotated(between(line.from, second.from), -index(second));
        const int turn_1 = index(line) - index(first);
        const int turn_2 = index(line) - index(second);
        const Vector a_1 = numbers_.rotated(way_1, -turn_2);
        const Vector a_2 = numbers_.rotated(way_1, turn_2);
        const Vector b_1 = numbers_.rotated(way_2, -turn_1);
        const Vector b_2 = numbers_.rotated(way_2, turn_1);
        Vector difference{};
        for (std::size_t i = 0; i < rank_; ++i) difference[i] = (a_1[i] - a_2[i]) - (b_1[i] - b_2[i]);
        return numbers_.sign_real(difference) * sign_of_sine(turn_1) * sign_of_sine(turn_2);
    }

    /// Images of nodes under the symmetries about the centroid of `nodes`.
    class Images {
    public:
        Images(const ExactPlane& plane, std::span<const std::uint32_t> nodes)
            : plane_(plane), count_(static_cast<std::int64_t>(nodes.size())) {
            for (const std::uint32_t node : nodes) {
                for (std::size_t i = 0; i < plane.rank_; ++i) sum_[i] += plane.coordinates_of(node)[i];
            }
            for (std::size_t i = 0; i < plane.rank_; ++i) {
                centre += static_cast<double>(sum_[i]) / static_cast<double>(count_) *
                          (plane.lattice_.unit * plane.lattice_.basis(static_cast<int>(i)));
            }
        }
        /// Orders that the group of rotations may have: rotations map directions of steps onto such directions.
        std::vector<std::uint32_t> orders() const {
            std::vector<std::uint32_t> divisors;
            for (int order = plane_.turn_; order > 1; --order) {
                if (plane_.turn_ % order == 0) divisors.push_back(static_cast<std::uint32_t>(order));
            }
            return divisors;
        }
        /// Number of mirrors that remain to be tried once that many rotations are known.
        std::uint32_t mirrors(std::uint32_t rotations) const {
            return static_cast<std::uint32_t>(plane_.turn_) / rotations;
        }
        std::uint32_t rotation(std::uint32_t node, std::uint32_t order) const {
            return image(node, plane_.turn_ / static_cast<int>(order), false);
        }
        std::uint32_t mirror(std::uint32_t node, std::uint32_t which) const {
            return image(node, static_cast<int>(which), true);
        }
        /// The direction of a mirror, in radians.
        double axis(std::uint32_t which) const {
            const glm::dvec2 along = plane_.lattice_.basis(0);
            return std::atan2(along.y, along.x) + which * std::numbers::pi / plane_.turn_;
        }
        glm::dvec2 centre{0.0};

    private:
        using Vector = std::array<Wide, 8>;
        std::uint32_t image(std::uint32_t node, int index, bool mirrored) const {
            Vector from_centre{};
            const auto coordinates = plane_.coordinates_of(node);
            for (std::size_t i = 0; i < plane_.rank_; ++i) from_centre[i] = Wide(count_) * coordinates[i] - sum_[i];
            if (mirrored) from_centre = plane_.numbers_.conjugate(from_centre);
            const Vector turned = plane_.numbers_.rotated(from_centre, index);
            std::array<std::int64_t, 8> found{};
            for (std::size_t i = 0; i < plane_.rank_; ++i) {
                const Wide scaled = turned[i] + sum_[i];
                if (scaled % count_ != 0) return none;
                found[i] = static_cast<std::int64_t>(scaled / count_);
            }
            return plane_.nodes_.find(found.data(), {});
        }
        const ExactPlane& plane_;
        std::int64_t count_;
        Vector sum_{};
    };

private:
    using Vector = Cyclotomic::Number;

    static int index(const Segment& segment) { return static_cast<int>(segment.direction); }
    std::span<const std::int64_t> coordinates_of(std::uint32_t node) const {
        return {nodes_.coordinates(node), rank_};
    }

    Vector between(std::uint32_t from, std::uint32_t to) const {
        Vector step{};
        for (std::size_t i = 0; i < rank_; ++i) step[i] = coordinates_of(to)[i] - coordinates_of(from)[i];
        return step;
    }
    int sign_of_sine(int count) const {
        count = (count % turn_ + turn_) % turn_;
        return 2 * count % turn_ == 0 ? 0 : (2 * count < turn_ ? 1 : -1);
    }

    const Lattice& lattice_;
    Cyclotomic numbers_;
    int turn_;
    std::size_t rank_;
    PlaceTable<std::int64_t> nodes_;
    double largest_ = 0.0;
};

/// Points in doubles; points within the tolerance of each other are one.
class RoughPlane {
public:
    static constexpr bool is_exact = false;
    double turn() const { return 2 * std::numbers::pi; }
    bool same_direction(double a, double b) const {
        return std::fabs(std::remainder(a - b, 2 * std::numbers::pi)) <= steps_are_one;
    }
    double rounding() const { return 2 * steps_are_one; }
    std::size_t size() const { return nodes_.size(); }
    glm::dvec2 at(std::uint32_t node) const { return nodes_.at(node); }
    std::span<const glm::dvec2> places() const { return nodes_.places(); }

    std::uint32_t node(std::span<const std::int64_t>, glm::dvec2 place) {
        if (!(std::fabs(place.x) < 1e9 && std::fabs(place.y) < 1e9)) {
            throw std::runtime_error(
                "the drawing extends more than 1e9 steps from its beginning, where a tolerance "
                "of 1e-6 steps is meaningless");
        }
        return nodes_.add(nullptr, place);
    }
    double direction(std::uint32_t from, std::uint32_t to) const {
        const glm::dvec2 step = at(to) - at(from);
        const double angle = std::atan2(step.y, step.x);
        return angle < 0 ? angle + turn() : angle;
    }
    int side(const Segment& line, std::uint32_t node) const {
        const double distance = determinant(unit(line), at(node) - at(line.from));
        return std::fabs(distance) <= steps_are_one ? 0 : sign_of(distance);
    }
    int order(const Segment& line, std::uint32_t a, std::uint32_t b) const {
        const double distance = scalar_product(unit(line), at(b) - at(a));
        return std::fabs(distance) <= steps_are_one ? 0 : sign_of(distance);
    }
    int compare(std::span<const Segment>, const Cut& a, const Cut& b) const { return sign_of(a.along - b.along); }

    class Images {
    public:
        Images(const RoughPlane& plane, std::span<const std::uint32_t> nodes) : plane_(plane) {
            for (const std::uint32_t node : nodes) centre += plane.at(node) / static_cast<double>(nodes.size());
            // Points are mapped onto others at the same distance: the rarest distance leaves the fewest choices.
            std::vector<std::pair<double, std::uint32_t>> distances;
            for (const std::uint32_t node : nodes) {
                distances.emplace_back(std::hypot(plane.at(node).x - centre.x, plane.at(node).y - centre.y), node);
            }
            std::sort(distances.begin(), distances.end());
            distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
            std::size_t least = std::numeric_limits<std::size_t>::max();
            for (std::size_t begin = 0; begin < distances.size();) {
                std::size_t end = begin + 1;
                while (end < distances.size() && distances[end].first - distances[end - 1].first < steps_are_one)
                    ++end;
                if (distances[begin].first > 100 * steps_are_one && end - begin < least) {
                    least = end - begin;
                    alike_.clear();
                    for (std::size_t i = begin; i < end; ++i) alike_.push_back(distances[i].second);
                }
                begin = end;
            }
        }
        std::vector<std::uint32_t> orders() const {
            std::vector<std::uint32_t> divisors;
            const auto count = static_cast<std::uint32_t>(alike_.size());
            for (std::uint32_t order = count; order > 1; --order) {
                if (count % order == 0) divisors.push_back(order);
            }
            return divisors;
        }
        std::uint32_t mirrors(std::uint32_t) const { return static_cast<std::uint32_t>(alike_.size()); }
        std::uint32_t rotation(std::uint32_t node, std::uint32_t order) const {
            const double angle = 2 * std::numbers::pi / order;
            return image(plane_.at(node) - centre, {std::cos(angle), std::sin(angle)});
        }
        /// The mirror that maps the first of alike_ onto another of them.
        std::uint32_t mirror(std::uint32_t node, std::uint32_t which) const {
            const glm::dvec2 from = plane_.at(alike_.front()) - centre;
            const glm::dvec2 to = plane_.at(alike_[which]) - centre;
            const glm::dvec2 factor =
                complex_product(to, from) / (std::hypot(from.x, from.y) * std::hypot(to.x, to.y));
            const glm::dvec2 place = plane_.at(node) - centre;
            return image({place.x, -place.y}, factor);
        }
        double axis(std::uint32_t which) const {
            const glm::dvec2 from = plane_.at(alike_.front()) - centre;
            const glm::dvec2 to = plane_.at(alike_[which]) - centre;
            return (std::atan2(from.y, from.x) + std::atan2(to.y, to.x)) / 2;
        }
        glm::dvec2 centre{0.0};

    private:
        std::uint32_t image(glm::dvec2 a, glm::dvec2 b) const {
            return plane_.nodes_.find(nullptr, centre + complex_product(a, b));
        }
        const RoughPlane& plane_;
        std::vector<std::uint32_t> alike_;
    };

private:
    glm::dvec2 unit(const Segment& line) const { return {std::cos(line.direction), std::sin(line.direction)}; }

    PlaceTable<std::int64_t> nodes_{0, steps_are_one};
};

}  // namespace sikku::kolam_plane
