#include "art/cutting/no_fit.h"

#include "engine/geometry/simple_polygon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace sikku {
namespace {

/// Twice the area below which three corners lie on a line, in square millimetres.
constexpr double flat_ear = 1e-9;

/// Cuts off ears: triangles of successive corners without other corners within.
std::vector<Outline> ears_of(Outline corners) {
    std::vector<Outline> found;
    while (corners.size() > 3) {
        const std::size_t count = corners.size();
        const auto at = [&](std::size_t i) { return corners[i % count]; };
        std::size_t best = count;
        double largest = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = at(i + count - 1), b = at(i), c = at(i + 1);
            const double area = side_of(a, b, c);
            if (area <= flat_ear) {
                // Corners on straight stretches and rounding errors are left out first.
                if (area > -flat_ear) {
                    best = i;
                    break;
                }
                continue;
            }
            const bool is_ear = std::none_of(corners.begin(), corners.end(), [&](glm::dvec2 p) {
                return p != a && p != b && p != c && side_of(a, b, p) >= 0 && side_of(b, c, p) >= 0 &&
                       side_of(c, a, p) >= 0;
            });
            // The ear whose longest side is shortest for its area.
            const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            if (is_ear && area / (longest * longest) > largest) {
                largest = area / (longest * longest);
                best = i;
            }
        }
        if (best == count) return {};
        if (side_of(at(best + count - 1), at(best), at(best + 1)) > flat_ear) {
            found.push_back({at(best + count - 1), at(best), at(best + 1)});
        }
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(best));
    }
    if (side_of(corners[0], corners[1], corners[2]) > flat_ear) found.push_back(corners);
    return found;
}

/// Joins two convex polygons with a common side if the result is convex.
std::optional<Outline> joined_parts(const Outline& a, const Outline& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < b.size(); ++k) {
            if (a[i] != b[(k + 1) % b.size()] || a[(i + 1) % a.size()] != b[k]) continue;
            Outline both;
            for (std::size_t n = 1; n <= a.size(); ++n) both.push_back(a[(i + n) % a.size()]);
            for (std::size_t n = 2; n < b.size(); ++n) both.push_back(b[(k + n) % b.size()]);
            for (std::size_t n = 0; n < both.size(); ++n) {
                const std::size_t next = (n + 1) % both.size(), after = (n + 2) % both.size();
                if (side_of(both[n], both[next], both[after]) < 0) return std::nullopt;
            }
            return both;
        }
    }
    return std::nullopt;
}

/// 0 for directions from 0 to below 180 degrees, else 1.
int half_turn_of(glm::dvec2 direction) {
    return direction.y > 0 || (direction.y == 0 && direction.x > 0) ? 0 : 1;
}

/// The corner from which the directions of a convex polygon's sides ascend from 0 to 360 degrees.
std::size_t lowest_corner(const Outline& corners) {
    return static_cast<std::size_t>(
        std::min_element(corners.begin(), corners.end(),
                         [](glm::dvec2 a, glm::dvec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }) -
        corners.begin());
}

/// The Minkowski sum of two convex polygons.
Outline minkowski_sum(const Outline& a, const Outline& b) {
    const std::size_t first = lowest_corner(a), second = lowest_corner(b);
    Outline sum;
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
        const glm::dvec2 p = a[(first + i) % a.size()], q = b[(second + k) % b.size()];
        sum.push_back(p + q);
        const glm::dvec2 along = a[(first + i + 1) % a.size()] - p, other = b[(second + k + 1) % b.size()] - q;
        const double turn = determinant(along, other);
        const double parallel = 1e-12 * glm::length(along) * glm::length(other);
        if (i == a.size()) {
            ++k;
        } else if (k == b.size()) {
            ++i;
        } else if (std::fabs(turn) <= parallel && scalar_product(along, other) > 0) {
            ++i;
            ++k;
        } else if (half_turn_of(along) != half_turn_of(other) ? half_turn_of(along) < half_turn_of(other)
                                                              : turn > 0) {
            ++i;
        } else {
            ++k;
        }
    }
    return sum;
}

}  // namespace

std::vector<Outline> convex_parts(std::span<const glm::dvec2> corners) {
    std::vector<Outline> parts = ears_of({corners.begin(), corners.end()});
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = i + 1; k < parts.size();) {
            if (auto both = joined_parts(parts[i], parts[k])) {
                parts[i] = std::move(*both);
                parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
                k = i + 1;
            } else {
                ++k;
            }
        }
    }
    return parts;
}

NoFit::NoFit(const std::vector<Outline>& fixed, const std::vector<Outline>& moved) {
    std::vector<Outline> sums;
    for (const Outline& a : fixed) {
        for (const Outline& b : moved) add_sum(a, b, sums);
    }
    find_border(sums);
}

void NoFit::add_sum(const Outline& fixed, const Outline& moved, std::vector<Outline>& sums) {
    Outline turned;
    for (const glm::dvec2 corner : moved) turned.push_back(-corner);
    const Outline& sum = sums.emplace_back(minkowski_sum(fixed, turned));
    Sum& added = sums_.emplace_back();
    added.box = box_of(sum);
    added.begin = halves_.size();
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const glm::dvec2 side = sum[(i + 1) % sum.size()] - sum[i];
        const double length = glm::length(side);
        if (length < 1e-12) continue;
        const glm::dvec2 normal(side.y / length, -side.x / length);
        halves_.push_back({normal, scalar_product(normal, sum[i])});
    }
    added.end = halves_.size();
    box_.add(added.box.low);
    box_.add(added.box.high);
}

bool NoFit::overlaps(glm::dvec2 displacement) const {
    const auto is_within = [&](const Box& box) {
        return displacement.x > box.low.x + touching && displacement.x < box.high.x - touching &&
               displacement.y > box.low.y + touching && displacement.y < box.high.y - touching;
    };
    if (!is_within(box_)) return false;
    for (const Sum& sum : sums_) {
        if (!is_within(sum.box)) continue;
        std::size_t i = sum.begin;
        while (i < sum.end && scalar_product(halves_[i].normal, displacement) < halves_[i].limit - touching) ++i;
        if (i == sum.end) return true;
    }
    return false;
}

void NoFit::find_border(const std::vector<Outline>& sums) {
    constexpr double same = 1e-9;  // millimetres
    std::vector<double> places;    // along a side
    for (std::size_t s = 0; s < sums.size(); ++s) {
        for (std::size_t i = 0; i < sums[s].size(); ++i) {
            const glm::dvec2 from = sums[s][i], to = sums[s][(i + 1) % sums[s].size()];
            const glm::dvec2 along = to - from;
            const double length = glm::length(along);
            if (length < same) continue;
            Box box;
            box.add(from);
            box.add(to);
            places = {0, 1};
            for (std::size_t other = 0; other < sums_.size(); ++other) {
                const Sum& sum = sums_[other];
                if (other == s || sum.box.low.x > box.high.x || sum.box.high.x < box.low.x ||
                    sum.box.low.y > box.high.y || sum.box.high.y < box.low.y) {
                    continue;
                }
                // The part of the side within the other sum.
                double first = 0, last = 1;
                for (std::size_t h = sum.begin; h < sum.end; ++h) {
                    const double speed = scalar_product(halves_[h].normal, along);
                    const double room = halves_[h].limit - scalar_product(halves_[h].normal, from);
                    if (std::fabs(speed) < 1e-12 * length) {
                        if (room < 0) first = 2;
                    } else if (speed > 0) {
                        last = std::min(last, room / speed);
                    } else {
                        first = std::max(first, room / speed);
                    }
                }
                if (first > last) continue;
                places.push_back(first);
                places.push_back(last);
            }
            std::sort(places.begin(), places.end());
            std::size_t kept = 1;
            for (const double place : places) {
                if ((place - places[kept - 1]) * length > same) places[kept++] = place;
            }
            places.resize(kept);
            const auto at = [&](double place) { return place == 1 ? to : from + place * along; };
            bool is_border = false;
            glm::dvec2 start(0.0);  // of the current part of the border
            for (std::size_t k = 0; k < places.size(); ++k) {
                const bool goes_on = k + 1 < places.size() && !overlaps(at((places[k] + places[k + 1]) / 2));
                if (goes_on && !is_border) {
                    is_border = true;
                    start = at(places[k]);
                    points_.push_back(start);
                } else if (!goes_on && is_border) {
                    sides_.push_back({start, at(places[k])});
                    points_.push_back(at(places[k]));
                    is_border = false;
                } else if (!goes_on && !overlaps(at(places[k]))) {
                    points_.push_back(at(places[k]));
                }
            }
        }
    }
    const auto before = [](glm::dvec2 a, glm::dvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    const auto is_near = [](glm::dvec2 a, glm::dvec2 b) {
        return std::fabs(a.x - b.x) < same && std::fabs(a.y - b.y) < same;
    };
    std::sort(points_.begin(), points_.end(), before);
    std::vector<glm::dvec2> different;
    for (const glm::dvec2 point : points_) {
        bool is_known = false;
        for (std::size_t k = different.size(); k > 0 && point.x - different[k - 1].x < same && !is_known; --k) {
            is_known = is_near(point, different[k - 1]);
        }
        if (!is_known) different.push_back(point);
    }
    points_ = std::move(different);
    std::vector<Side> sides;
    for (const Side& side : sides_) {
        const bool is_known = std::any_of(sides.begin(), sides.end(), [&](const Side& other) {
            return is_near(side.from, other.from) && is_near(side.to, other.to);
        });
        if (!is_known) sides.push_back(side);
    }
    sides_ = std::move(sides);
}

}  // namespace sikku
