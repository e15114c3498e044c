#include "art/reading/lattice.h"

#include "engine/geometry/box.h"
#include "engine/geometry/point_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

using LatticePlace = std::pair<std::int32_t, std::int32_t>;  // steps along the two vectors of a basis

/// Converts a whole number to an integer, limited to ±10^8, because wrong fits can reach infinity.
std::int32_t whole(double number) {
    constexpr double farthest = 1e8;
    return static_cast<std::int32_t>(number < farthest ? std::max(number, -farthest) : farthest);
}

/// Solves a system of 8 equations by elimination with pivots; false if it is singular.
template <std::size_t n>
bool solve(std::array<std::array<double, n + 1>, n>& rows) {
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t pivot = column;
        for (std::size_t r = column + 1; r < n; ++r) {
            if (std::fabs(rows[r][column]) > std::fabs(rows[pivot][column])) pivot = r;
        }
        if (std::fabs(rows[pivot][column]) < 1e-10) return false;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == column) continue;
            const double factor = rows[r][column] / rows[column][column];
            for (std::size_t c = column; c <= n; ++c) rows[r][c] -= factor * rows[column][c];
        }
    }
    for (std::size_t r = 0; r < n; ++r) rows[r][n] /= rows[r][r];
    return true;
}

/// Moves points to a mean of 0 and a mean distance of 1.
struct Scaling {
    glm::dvec2 centre{0.0};
    double size = 1.0;
    explicit Scaling(std::span<const glm::dvec2> points) {
        for (const glm::dvec2 point : points) centre += point;
        centre /= static_cast<double>(points.size());
        double sum = 0;
        for (const glm::dvec2 point : points) sum += glm::distance(point, centre);
        size = std::max(sum / static_cast<double>(points.size()), 1e-12);
    }
    glm::dvec2 operator()(glm::dvec2 point) const { return (point - centre) / size; }
};

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
    std::array<double, 9> result{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < 3; ++k) result[3 * r + c] += a[3 * r + k] * b[3 * k + c];
        }
    }
    return result;
}

/// Grows a patch of the lattice from a point.
class Patch {
public:
    Patch(const std::vector<glm::dvec2>& points, const PointGrid& index) : points_(points), index_(index) {}

    std::map<LatticePlace, std::uint32_t> grow(std::uint32_t seed, glm::dvec2 first, glm::dvec2 second) const {
        std::map<LatticePlace, std::uint32_t> places{{{0, 0}, seed}};
        std::vector<char> is_used(points_.size());
        is_used[seed] = 1;
        struct Step {
            LatticePlace place;
            glm::dvec2 first, second;  // steps at the point
        };
        std::vector<Step> queue = {{{0, 0}, first, second}};
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const Step at = queue[head];
            const glm::dvec2 from = points_[places[at.place]];
            for (int side = 0; side < 4; ++side) {
                const int sign = side < 2 ? 1 : -1;
                const bool along_first = side % 2 == 0;
                const LatticePlace to = along_first ? LatticePlace{at.place.first + sign, at.place.second}
                                                    : LatticePlace{at.place.first, at.place.second + sign};
                if (places.contains(to)) continue;
                const glm::dvec2 way = along_first ? at.first : at.second;
                const std::int64_t found =
                    index_.nearest(from + static_cast<double>(sign) * way, 0.22 * glm::length(way));
                if (found < 0 || is_used[static_cast<std::size_t>(found)] != 0) continue;
                const auto point = static_cast<std::uint32_t>(found);
                is_used[point] = 1;
                places.emplace(to, point);
                Step next{to, at.first, at.second};
                const glm::dvec2 taken = static_cast<double>(sign) * (points_[point] - from);
                (along_first ? next.first : next.second) = 0.5 * way + 0.5 * taken;
                queue.push_back(next);
            }
        }
        return places;
    }

private:
    const std::vector<glm::dvec2>& points_;
    const PointGrid& index_;
};

/// Points between the places of a patch: many of them mean that its steps are multiples of those of the lattice.
std::size_t points_between(const std::map<LatticePlace, std::uint32_t>& patch, const std::vector<glm::dvec2>& points,
                           const PointGrid& index) {
    std::vector<char> is_place(points.size());
    for (const auto& [place, point] : patch) is_place[point] = 1;
    std::size_t count = 0;
    const auto look = [&](glm::dvec2 at, double reach) {
        const std::int64_t found = index.nearest(at, reach);
        if (found < 0 || is_place[static_cast<std::size_t>(found)] != 0) return;
        is_place[static_cast<std::size_t>(found)] = 1;
        ++count;
    };
    for (const auto& [place, point] : patch) {
        const auto right = patch.find({place.first + 1, place.second});
        const auto up = patch.find({place.first, place.second + 1});
        for (const auto& next : {right, up}) {
            if (next == patch.end()) continue;
            const glm::dvec2 way = points[next->second] - points[point];
            look(points[point] + 0.5 * way, 0.2 * glm::length(way));
        }
    }
    return count;
}

/// The two shortest steps of the lattice that two steps span, 60 to 90 degrees apart (Gauss).
void reduce(glm::dvec2& first, glm::dvec2& second) {
    for (int i = 0; i < 64; ++i) {
        if (glm::length(second) < glm::length(first)) std::swap(first, second);
        const double times = std::round(glm::dot(first, second) / glm::dot(first, first));
        if (times == 0) break;
        second -= times * first;
    }
    if (glm::dot(first, second) < 0) second = -second;
}

double angle_between(glm::dvec2 a, glm::dvec2 b) {
    return std::acos(std::clamp(glm::dot(a, b) / (glm::length(a) * glm::length(b)), -1.0, 1.0)) * 180 /
           std::numbers::pi;
}

/// The typical distance of neighbours.
double typical_distance(const std::vector<glm::dvec2>& points) {
    const double side = std::max(box_of(points).longest(), 1e-9);
    const PointGrid index(points, side / std::max(1.0, std::sqrt(static_cast<double>(points.size()))));
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto nearest = index.neighbours(i, 1);
        if (!nearest.empty()) distances.push_back(glm::distance(points[i], points[nearest[0]]));
    }
    if (distances.empty()) return side;
    return std::max(median(std::move(distances)), 1e-9 * side);
}

/// Points to try as seeds: those nearest to the middle, where all neighbours exist, and some from everywhere.
std::vector<std::uint32_t> seeds(const std::vector<glm::dvec2>& points) {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2 point : points) middle += point / static_cast<double>(points.size());
    std::vector<std::uint32_t> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double to_a = glm::distance(points[a], middle);
        const double to_b = glm::distance(points[b], middle);
        return to_a != to_b ? to_a < to_b : a < b;
    });
    constexpr std::size_t near = 16;
    constexpr std::size_t others = 24;
    std::vector<std::uint32_t> chosen(order.begin(),
                                      order.begin() + static_cast<std::ptrdiff_t>(std::min(near, order.size())));
    const std::size_t stride = std::max<std::size_t>(1, order.size() / others);
    for (std::size_t i = near; i < order.size(); i += stride) chosen.push_back(order[i]);
    return chosen;
}

/// The largest patch that grows from any of the seeds.
std::map<LatticePlace, std::uint32_t> largest_patch(const std::vector<glm::dvec2>& points, std::optional<double> step,
                                                    const Monitor& monitor) {
    const double distance = typical_distance(points);
    const PointGrid index(points, 2 * distance);
    const Patch patch(points, index);
    std::map<LatticePlace, std::uint32_t> best;
    std::size_t best_size = 0;
    double best_area = 0;
    for (const std::uint32_t seed : seeds(points)) {
        monitor.check();
        const auto near = index.neighbours(seed, 8);
        for (std::size_t i = 0; i < near.size(); ++i) {
            for (std::size_t k = i + 1; k < near.size(); ++k) {
                const glm::dvec2 first = points[near[i]] - points[seed];
                const glm::dvec2 second = points[near[k]] - points[seed];
                const double angle = angle_between(first, second);
                if (angle < 45 || angle > 135 || glm::length(second) > 1.9 * glm::length(first)) continue;
                if (step && (glm::length(first) < 0.7 * *step || glm::length(first) > 1.4 * *step)) continue;
                auto places = patch.grow(seed, first, second);
                // Among equal patches, the one with shorter steps leaves fewer places empty.
                const double area = std::fabs(determinant(first, second));
                if (places.size() < best_size) continue;
                const std::size_t between = points_between(places, points, index);
                const std::size_t size = places.size() - std::min(places.size(), between);
                if (size > best_size || (size == best_size && area < 0.9 * best_area)) {
                    best = std::move(places);
                    best_size = size;
                    best_area = area;
                }
            }
        }
        if (10 * best.size() >= 9 * points.size()) break;
    }
    return best;
}

/// Dots in one row: the other step is at right angles.
std::map<LatticePlace, std::uint32_t> row_of(const std::vector<glm::dvec2>& points) {
    const double distance = typical_distance(points);
    const PointGrid index(points, 2 * distance);
    std::map<LatticePlace, std::uint32_t> best;
    for (const std::uint32_t seed : seeds(points)) {
        for (const std::uint32_t near : index.neighbours(seed, 2)) {
            const glm::dvec2 first = points[near] - points[seed];
            auto places = Patch(points, index).grow(seed, first, {-first.y, first.x});
            if (places.size() > best.size()) best = std::move(places);
        }
    }
    return best;
}

/// The mean steps of a patch.
struct PatchSteps {
    glm::dvec2 first{0.0};
    glm::dvec2 second{0.0};
    bool is_row = false;  ///< only one of them is known; the other is at right angles
};
PatchSteps steps_of(const std::map<LatticePlace, std::uint32_t>& patch, const std::vector<glm::dvec2>& points) {
    PatchSteps steps;
    double firsts = 0;
    double seconds = 0;
    for (const auto& [place, point] : patch) {
        const glm::dvec2 from = points[point];
        const auto add = [&](const LatticePlace& next, glm::dvec2& sum, double& count) {
            const auto found = patch.find(next);
            if (found == patch.end()) return;
            sum += points[found->second] - from;
            ++count;
        };
        add({place.first + 1, place.second}, steps.first, firsts);
        add({place.first, place.second + 1}, steps.second, seconds);
    }
    if (firsts > 0) steps.first /= firsts;
    if (seconds > 0) steps.second /= seconds;
    if (firsts == 0) steps.first = {steps.second.y, -steps.second.x};
    if (seconds == 0) steps.second = {-steps.first.y, steps.first.x};
    steps.is_row = firsts == 0 || seconds == 0;
    return steps;
}

/// The axes of a lattice as people write grids: one to the right, the other upwards, of its shortest steps.
struct Axes {
    DotLattice lattice = DotLattice::square;
    double angle = 90;  ///< between the shortest steps
    glm::dvec2 right{0.0};
    glm::dvec2 up{0.0};

    /// @param first, second  steps of a patch, with y up
    Axes(glm::dvec2 first, glm::dvec2 second, std::optional<DotLattice> wanted) : right(first), up(second) {
        reduce(right, up);
        angle = angle_between(right, up);
        lattice = wanted.value_or(angle < 75 ? DotLattice::triangular : DotLattice::square);
        std::vector<glm::dvec2> sides = {right, up, -right, -up};
        // Six sides: the third is the shorter diagonal.
        if (lattice == DotLattice::triangular) sides.insert(sides.end(), {up - right, right - up});
        const auto heading = [](glm::dvec2 w) { return std::fabs(std::atan2(w.y, w.x)); };
        right = *std::min_element(sides.begin(), sides.end(),
                                  [&](glm::dvec2 a, glm::dvec2 b) { return heading(a) < heading(b); });
        double nearest = 1e300;
        for (const glm::dvec2 side : sides) {
            const double turned = angle_between(right, side);
            if (determinant(right, side) > 0 && turned < nearest) {
                nearest = turned;
                up = side;
            }
        }
        first_ = coordinates(first);
        second_ = coordinates(second);
    }
    GridDot place(const LatticePlace& patch_place) const {
        const glm::dvec2 steps =
            static_cast<double>(patch_place.first) * first_ + static_cast<double>(patch_place.second) * second_;
        const std::int32_t a = whole(steps.x), b = whole(steps.y);
        return lattice == DotLattice::square ? GridDot{2 * a, 2 * b} : GridDot{2 * a + b, 2 * b};
    }

private:
    glm::dvec2 coordinates(glm::dvec2 w) const {
        return glm::round(glm::dvec2(determinant(w, up), determinant(right, w)) / determinant(right, up));
    }
    glm::dvec2 first_{0.0};
    glm::dvec2 second_{0.0};
};

/// Gives points the places of the lattice at which they lie under the map of a fit, one point for each place, and
/// collects both. @return false if the map cannot be inverted, or fewer than two points have places
bool assign_places(const std::vector<glm::dvec2>& points, LatticeFit& fit, std::vector<glm::dvec2>& from,
                   std::vector<glm::dvec2>& to) {
    const auto back = fit.map.inverse();
    if (!back) return false;
    fit.places.assign(points.size(), std::nullopt);
    fit.fitted = 0;
    std::map<LatticePlace, std::pair<double, std::uint32_t>> taken;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 at = (*back)(points[i]);
        if (!(std::fabs(at.x) < 1e6 && std::fabs(at.y) < 1e6)) continue;
        const GridDot place = nearest_place(fit.lattice, at);
        const double off = glm::distance(lattice_point(fit.lattice, place), at);
        if (off > 0.22) continue;
        const auto [found, is_new] = taken.emplace(LatticePlace{place.x, place.y}, std::pair(off, i));
        if (!is_new && off < found->second.first) found->second = {off, i};
    }
    from.clear();
    to.clear();
    for (const auto& [place, nearest_point] : taken) {
        const GridDot dot{place.first, place.second};
        fit.places[nearest_point.second] = dot;
        ++fit.fitted;
        from.push_back(lattice_point(fit.lattice, dot));
        to.push_back(points[nearest_point.second]);
    }
    return taken.size() >= 2;
}

}  // namespace

std::optional<Homography> Homography::fit(std::span<const glm::dvec2> from, std::span<const glm::dvec2> to) {
    if (from.size() < 3 || from.size() != to.size()) return std::nullopt;
    const Scaling scale_from(from);
    const Scaling scale_to(to);
    std::array<std::array<double, 9>, 8> rows{};
    std::array<std::array<double, 7>, 6> affine{};
    for (std::size_t i = 0; i < from.size(); ++i) {
        const glm::dvec2 p = scale_from(from[i]);
        const glm::dvec2 q = scale_to(to[i]);
        const std::array<std::array<double, 9>, 2> equations = {
            {{p.x, p.y, 1, 0, 0, 0, -q.x * p.x, -q.x * p.y, q.x},
             {0, 0, 0, p.x, p.y, 1, -q.y * p.x, -q.y * p.y, q.y}}};
        for (const auto& equation : equations) {
            for (std::size_t r = 0; r < 8; ++r) {
                for (std::size_t c = 0; c < 9; ++c) rows[r][c] += equation[r] * equation[c];
            }
            for (std::size_t r = 0; r < 6; ++r) {
                for (std::size_t c = 0; c < 6; ++c) affine[r][c] += equation[r] * equation[c];
                affine[r][6] += equation[r] * equation[8];
            }
        }
    }
    std::array<double, 9> h = {0, 0, 0, 0, 0, 0, 0, 0, 1};
    if (from.size() >= 4 && solve<8>(rows)) {
        for (std::size_t i = 0; i < 8; ++i) h[i] = rows[i][8];
    } else if (solve<6>(affine)) {
        for (std::size_t i = 0; i < 6; ++i) h[i] = affine[i][6];
    } else {
        return std::nullopt;
    }
    const double scale = 1 / scale_from.size;
    const double x = -scale_from.centre.x / scale_from.size, y = -scale_from.centre.y / scale_from.size;
    const std::array<double, 9> before = {scale, 0, x, 0, scale, y, 0, 0, 1};
    const std::array<double, 9> after = {
        scale_to.size, 0, scale_to.centre.x, 0, scale_to.size, scale_to.centre.y, 0, 0, 1};
    Homography map;
    map.m_ = product(after, product(h, before));
    return map;
}

glm::dvec2 Homography::operator()(glm::dvec2 p) const {
    const double w = m_[6] * p.x + m_[7] * p.y + m_[8];
    return {(m_[0] * p.x + m_[1] * p.y + m_[2]) / w, (m_[3] * p.x + m_[4] * p.y + m_[5]) / w};
}

std::array<glm::dvec2, 2> Homography::derivatives(glm::dvec2 p) const {
    const double w = m_[6] * p.x + m_[7] * p.y + m_[8];
    const glm::dvec2 q = (*this)(p);
    return {glm::dvec2(m_[0] - q.x * m_[6], m_[3] - q.y * m_[6]) / w,
            glm::dvec2(m_[1] - q.x * m_[7], m_[4] - q.y * m_[7]) / w};
}

std::optional<Homography> Homography::inverse() const {
    const auto minor = [this](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        return m_[a] * m_[b] - m_[c] * m_[d];
    };
    const double determinant = m_[0] * minor(4, 8, 5, 7) - m_[1] * minor(3, 8, 5, 6) + m_[2] * minor(3, 7, 4, 6);
    if (!(std::fabs(determinant) > 1e-300)) return std::nullopt;
    Homography map;
    map.m_ = {minor(4, 8, 5, 7), minor(2, 7, 1, 8), minor(1, 5, 2, 4), minor(5, 6, 3, 8), minor(0, 8, 2, 6),
              minor(2, 3, 0, 5), minor(3, 7, 4, 6), minor(1, 6, 0, 7), minor(0, 4, 1, 3)};
    for (double& value : map.m_) value /= determinant;
    return map;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

GridDot nearest_place(DotLattice lattice, glm::dvec2 point) {
    if (lattice == DotLattice::square) {
        return {2 * static_cast<std::int32_t>(std::lround(point.x)),
                2 * static_cast<std::int32_t>(std::lround(point.y))};
    }
    const double rows = std::numbers::sqrt3 / 2;
    GridDot best;
    double least = 1e300;
    const auto low = static_cast<std::int32_t>(std::floor(point.y / rows));
    for (std::int32_t row = low; row <= low + 1; ++row) {
        const double shift = row % 2 != 0 ? 0.5 : 0.0;
        const GridDot place{2 * static_cast<std::int32_t>(std::lround(point.x - shift)) + (row % 2 != 0 ? 1 : 0),
                            2 * row};
        const double distance = glm::distance(lattice_point(lattice, place), point);
        if (distance < least) {
            least = distance;
            best = place;
        }
    }
    return best;
}

std::optional<LatticeFit> fit_lattice(const std::vector<glm::dvec2>& points, bool y_down,
                                      std::optional<DotLattice> lattice, const Monitor& monitor,
                                      std::optional<double> step) {
    if (points.size() < 2) return std::nullopt;
    auto patch = largest_patch(points, step, monitor);
    if (patch.size() < 3 && !step) patch = row_of(points);
    if (patch.size() < 2) return std::nullopt;
    const PatchSteps steps = steps_of(patch, points);
    const auto upright = [y_down](glm::dvec2 v) { return y_down ? glm::dvec2(v.x, -v.y) : v; };
    const Axes axes(upright(steps.first), upright(steps.second), lattice);

    std::vector<glm::dvec2> from, to;
    for (const auto& [place, point] : patch) {
        from.push_back(lattice_point(axes.lattice, axes.place(place)));
        to.push_back(points[point]);
    }
    const bool is_affine = steps.is_row || patch.size() < 6;
    if (is_affine) {
        // A row, or so few that perspective cannot be distinguished from errors: auxiliary points make the map
        // affine.
        const glm::dvec2 at = to[0];
        const glm::dvec2 base = from[0];
        from.push_back(base + lattice_point(axes.lattice, {2, 0}));
        to.push_back(at + upright(axes.right));
        from.push_back(
            base + lattice_point(axes.lattice, axes.lattice == DotLattice::square ? GridDot{0, 2} : GridDot{1, 2}));
        to.push_back(at + upright(axes.up));
    }
    LatticeFit fit;
    fit.lattice = axes.lattice;
    fit.angle = axes.angle;
    auto map = Homography::fit(from, to);
    if (map) fit.patch_map = *map;
    fit.patch.resize(points.size());
    for (const auto& [place, point] : patch) fit.patch[point] = axes.place(place);
    for (int round = 0; round < 4 && map; ++round) {
        fit.map = *map;
        if (!assign_places(points, fit, from, to) || fit.fitted < 6 || steps.is_row) break;
        map = Homography::fit(from, to);
    }
    if (fit.fitted < 2) return std::nullopt;
    return fit;
}

}  // namespace sikku
