#include "art/plotter/clear_hatch.h"

#include "art/plotter/shading.h"
#include "engine/geometry/box.h"
#include "engine/geometry/simple_polygon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_meetings = 20'000'000;  // meetings of lines with sides and obstacles: some 500 MB

double distance_of_segments(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    const bool crosses = side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
    if (crosses) return 0;
    return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                     distance_to_segment(d, a, b)});
}

struct ClearInterval {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    bool is_empty() const { return !(from < to); }
    void add(double at) {
        from = std::min(from, at);
        to = std::max(to, at);
    }
};

/// The part of the line at that height that lies within an obstacle, in coordinates along and across the hatching.
ClearInterval part_within(const Obstacle& obstacle, double height) {
    ClearInterval part;
    const auto disc = [&](glm::dvec2 centre) {
        const double off = height - centre.y;
        if (std::fabs(off) >= obstacle.radius) return;
        const double half = std::sqrt(obstacle.radius * obstacle.radius - off * off);
        part.add(centre.x - half);
        part.add(centre.x + half);
    };
    disc(obstacle.from);
    disc(obstacle.to);
    const glm::dvec2 way = obstacle.to - obstacle.from;
    const double length = glm::length(way);
    if (!(length > 0)) return part;
    // The sides, which are parallel to the line.
    const glm::dvec2 side = obstacle.radius / length * glm::dvec2(-way.y, way.x);
    for (const glm::dvec2 off : {side, -side}) {
        const glm::dvec2 a = obstacle.from + off, b = obstacle.to + off;
        if ((a.y > height) == (b.y > height)) continue;
        part.add(a.x + (height - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    return part;
}

struct Stretch {
    double from = 0, to = 0;
    bool is_drawn = false;
    double end(int side) const { return side == 0 ? from : to; }
};

class ClearHatcher {
public:
    ClearHatcher(std::span<const glm::dvec2> vertices, std::span<const Obstacle> obstacles, glm::dvec2 along,
                 double spacing, double tolerance, const Monitor& monitor)
        : along_(along), across_(-along.y, along.x), spacing_(spacing), tolerance_(tolerance), pulse_(monitor) {
        for (const glm::dvec2 vertex : vertices) vertices_.push_back(turned(vertex));
        for (const Obstacle& obstacle : obstacles) {
            obstacles_.push_back({turned(obstacle.from), turned(obstacle.to), obstacle.radius});
        }
    }

    std::vector<std::vector<glm::dvec2>> lines() {
        std::vector<std::vector<glm::dvec2>> result;
        if (vertices_.size() < 3) return result;
        find_rows();
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            for (Stretch& stretch : rows_[row]) {
                if (stretch.is_drawn) continue;
                const std::vector<glm::dvec2> line = zigzag(row, stretch);
                if (line.size() == 2 && glm::distance(line[0], line[1]) < spacing_ / 2) continue;
                std::vector<glm::dvec2>& back = result.emplace_back();
                for (const glm::dvec2 point : line) back.push_back(point.x * along_ + point.y * across_);
            }
        }
        return result;
    }

private:
    glm::dvec2 turned(glm::dvec2 point) const { return {glm::dot(point, along_), glm::dot(point, across_)}; }
    double height(std::size_t row) const {
        return (static_cast<double>(first_) + static_cast<double>(row) + 0.5) * spacing_;
    }
    /// The rows whose lines lie in a half-open range of heights.
    std::pair<std::size_t, std::size_t> rows_between(double low, double high) const {
        const auto row = [&](double at) {
            const double number = std::ceil(at / spacing_ - 0.5) - static_cast<double>(first_);
            return static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(rows_.size())));
        };
        return {row(low), row(high)};
    }

    std::pair<std::size_t, std::size_t> rows_at(const Obstacle& obstacle) const {
        return rows_between(std::min(obstacle.from.y, obstacle.to.y) - obstacle.radius,
                            std::max(obstacle.from.y, obstacle.to.y) + obstacle.radius);
    }
    /// Refuses hatching that would not fit in memory, before any is used.
    void limit_meetings() {
        std::size_t meetings = 0;
        const auto add = [&](std::pair<std::size_t, std::size_t> rows) {
            pulse_();
            meetings += rows.second - rows.first + 1;
            if (meetings > most_meetings) {
                throw std::runtime_error(
                    "hatching meets the lines around one shape over 20 million times; use a wider spacing");
            }
        };
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const auto [low, high] = std::minmax(vertices_[i].y, vertices_[(i + 1) % vertices_.size()].y);
            add(rows_between(low, high));
        }
        for (const Obstacle& obstacle : obstacles_) add(rows_at(obstacle));
    }

    void find_rows() {
        const auto [low, high] = hatched_heights(vertices_, {0, 1}, spacing_);
        first_ = static_cast<std::int64_t>(std::floor(low / spacing_));
        rows_.resize(static_cast<std::size_t>(std::ceil(high / spacing_) - std::floor(low / spacing_)) + 1);
        near_.resize(rows_.size());
        limit_meetings();

        std::vector<std::vector<std::pair<double, int>>> crossings(rows_.size());
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const glm::dvec2 a = vertices_[i], b = vertices_[(i + 1) % vertices_.size()];
            const auto [begin, end] = rows_between(std::min(a.y, b.y), std::max(a.y, b.y));
            for (std::size_t row = begin; row < end; ++row) {
                pulse_();
                const double share = std::clamp((height(row) - a.y) / (b.y - a.y), 0.0, 1.0);
                crossings[row].emplace_back(a.x + share * (b.x - a.x), b.y > a.y ? 1 : -1);
            }
        }
        std::vector<std::vector<ClearInterval>> kept(rows_.size());
        for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
            const Obstacle& obstacle = obstacles_[i];
            const auto [begin, end] = rows_at(obstacle);
            // Between a row and the next.
            for (std::size_t row = begin > 0 ? begin - 1 : 0; row < end; ++row) near_[row].push_back(i);
            for (std::size_t row = begin; row < end; ++row) {
                pulse_();
                const ClearInterval part = part_within(obstacle, height(row));
                if (!part.is_empty()) kept[row].push_back(part);
            }
        }
        for (std::size_t row = 0; row < rows_.size(); ++row) find_stretches(crossings[row], kept[row], rows_[row]);
    }

    /// The stretches inside the outline and outside all obstacles.
    static void find_stretches(std::vector<std::pair<double, int>>& crossings, std::vector<ClearInterval>& kept,
                               std::vector<Stretch>& stretches) {
        std::sort(crossings.begin(), crossings.end());
        std::sort(kept.begin(), kept.end(), [](const ClearInterval& a, const ClearInterval& b) {
            return a.from != b.from ? a.from < b.from : a.to < b.to;
        });
        std::vector<ClearInterval> inside;
        int winding = 0;
        double begin = 0;
        for (const auto& [at, turn] : crossings) {
            if (winding == 0) begin = at;
            winding += turn;
            if (winding != 0 || !(at > begin)) continue;
            // Nothing lies between two parts that touch, such as those beside the way to a hole.
            if (!inside.empty() && inside.back().to == begin) {
                inside.back().to = at;
            } else {
                inside.push_back({begin, at});
            }
        }
        auto obstacle = kept.begin();
        double free = -std::numeric_limits<double>::infinity();  // all obstacles before end here
        for (const ClearInterval& part : inside) {
            double at = std::max(part.from, free);
            while (obstacle != kept.end() && obstacle->from < part.to) {
                if (obstacle->from > at) stretches.push_back({at, obstacle->from});
                at = std::max(at, obstacle->to);
                free = std::max(free, obstacle->to);
                ++obstacle;
            }
            if (part.to > at) stretches.push_back({at, part.to});
        }
    }

    /// Joins stretches upwards into one line.
    std::vector<glm::dvec2> zigzag(std::size_t row, Stretch& first) {
        std::vector<glm::dvec2> points;
        Stretch* stretch = &first;
        for (int side = 0; stretch; side = 1 - side, ++row) {
            pulse_();
            stretch->is_drawn = true;
            if (points.empty()) points.emplace_back(stretch->end(side), height(row));
            points.emplace_back(stretch->end(1 - side), height(row));
            stretch = next(row, *stretch, 1 - side, points);
        }
        return points;
    }

    /// Finds the stretch of the next row that an end of another reaches, and adds the points of the path.
    Stretch* next(std::size_t row, const Stretch& stretch, int side, std::vector<glm::dvec2>& points) {
        constexpr std::size_t most_tried = 3;
        if (row + 1 == rows_.size()) return nullptr;
        const double from = stretch.end(side);
        std::vector<std::pair<double, Stretch*>> reachable;
        for (Stretch& other : rows_[row + 1]) {
            // Only stretches above this one: a longer join along the row would not be shorter than pen-up travel.
            if (other.is_drawn || other.to < stretch.from || other.from > stretch.to) continue;
            reachable.emplace_back(std::fabs(other.end(side) - from), &other);
        }
        std::sort(reachable.begin(), reachable.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        reachable.resize(std::min(reachable.size(), most_tried));
        const std::size_t count = points.size();
        for (const auto& [distance, other] : reachable) {
            if (join(row, points.back(), {other->end(side), height(row + 1)}, side == 0 ? 1.0 : -1.0, 3, points)) {
                return other;
            }
            points.resize(count);
        }
        return nullptr;
    }

    /// Adds a path to a point that keeps clear of all obstacles: straight, or bent inwards.
    bool join(std::size_t row, glm::dvec2 from, glm::dvec2 to, double inwards, int depth,
              std::vector<glm::dvec2>& points) {
        if (is_clear(row, from, to)) {
            points.push_back(to);
            return true;
        }
        if (depth == 0) return false;
        glm::dvec2 middle = (from + to) / 2.0;
        for (bool moved = true; moved;) {
            moved = false;
            for (const std::uint32_t i : near_[row]) {
                pulse_();
                const ClearInterval part = part_within(obstacles_[i], middle.y);
                if (part.is_empty() || !(middle.x > part.from && middle.x < part.to)) continue;
                middle.x = inwards > 0 ? part.to : part.from;
                moved = true;
            }
        }
        return join(row, from, middle, inwards, depth - 1, points) &&
               join(row, middle, to, inwards, depth - 1, points);
    }

    bool is_clear(std::size_t row, glm::dvec2 from, glm::dvec2 to) {
        return std::all_of(near_[row].begin(), near_[row].end(), [&](std::uint32_t i) {
            pulse_();
            const Obstacle& obstacle = obstacles_[i];
            return distance_of_segments(from, to, obstacle.from, obstacle.to) >= obstacle.radius - tolerance_;
        });
    }

    glm::dvec2 along_, across_;
    double spacing_, tolerance_;
    Pulse pulse_;
    std::vector<glm::dvec2> vertices_;  ///< along and across the hatching, like all members below
    std::vector<Obstacle> obstacles_;
    std::int64_t first_ = 0;  ///< number of the first row
    std::vector<std::vector<Stretch>> rows_;
    std::vector<std::vector<std::uint32_t>> near_;  ///< obstacles between each row and the next
};

}  // namespace

std::vector<std::vector<glm::dvec2>> clear_hatch_lines(std::span<const glm::dvec2> vertices,
                                                       std::span<const Obstacle> obstacles, glm::dvec2 along,
                                                       double spacing, double tolerance, const Monitor& monitor) {
    return ClearHatcher(vertices, obstacles, along, spacing, tolerance, monitor).lines();
}

}  // namespace sikku
