// music/melody/walks.h: tracks the position of a turtle for readers: in whole numbers on a square grid, or in
// doubles.
#pragma once

#include "engine/geometry/lattice.h"
#include "engine/measure/fold.h"
#include "music/melody/melody_fold.h"
#include "music/score/score.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace sikku::mapping {

constexpr std::int64_t farthest = std::int64_t{1} << 61;  // limit of coordinates and of times in steps
constexpr std::int64_t latest = std::int64_t{1} << 62;    // limit of ticks

/// Coordinates on the square grid, counted in steps, headings in quarter turns.
class GridWalk {
public:
    using Number = std::int64_t;
    struct Position {
        std::int64_t x = 0, y = 0;
        std::uint32_t heading = 0;
    };
    struct Step {
        std::int64_t x, y;
    };
    GridWalk(const Grammar&, const Lattice& lattice, int first) : lattice_(lattice) {
        start.heading = static_cast<std::uint32_t>(first);
    }
    std::int64_t steps(Symbol symbol) const { return lattice_.length[symbol]; }
    std::uint32_t quarters(Symbol symbol) const { return lattice_.turn[symbol]; }
    Step step(const Position& at, Symbol symbol) const { return ahead(at, steps(symbol)); }
    Step ahead(const Position& at, std::int64_t length) const { return along(at.heading, length); }
    void turn(Position& at, Symbol symbol) const { at.heading = (at.heading + lattice_.turn[symbol]) & 3; }
    static void skip(Position& at, const GridStretch& stretch) {
        for (std::uint32_t axis = 0; axis < 2; ++axis) {
            const Integer& by = stretch.move[axis];
            if (abs(by) >= farthest) {
                throw ScoreError("the curve is too large to be played from its middle: a smaller n is needed");
            }
            const Step step = along((at.heading + axis) & 3, by.convert_to<std::int64_t>());
            at.x += step.x;
            at.y += step.y;
        }
        at.heading = (at.heading + static_cast<std::uint32_t>(stretch.turn)) & 3;
    }
    static bool is_level(std::int64_t rise) { return rise == 0; }
    /// Compares two steps along an axis, neither of which is 0. Uses doubles, as products may overflow.
    static bool same_direction(const Step& a, const Step& b) {
        return static_cast<double>(a.x) * static_cast<double>(b.x) +
                   static_cast<double>(a.y) * static_cast<double>(b.y) >
               0;
    }
    static std::int64_t ticks(std::int64_t steps, std::int64_t unit) {
        std::int64_t product = 0;
        // Checking for overflow by division would cost more than all other work for a note.
        return __builtin_mul_overflow(steps, unit, &product) || product > latest ? latest : product;
    }
    static std::int64_t length(const Step& step) { return std::abs(step.x) + std::abs(step.y); }
    static std::int64_t degree(std::int64_t twice) { return twice >= 0 ? (twice + 1) / 2 : -((-twice) / 2); }
    static bool in_range(const Position& at) {
        return at.x < farthest && at.x > -farthest && at.y < farthest && at.y > -farthest;
    }

    Position start;

private:
    static Step along(std::uint32_t heading, std::int64_t length) {
        switch (heading) {
            case 0:
                return {length, 0};
            case 1:
                return {0, length};
            case 2:
                return {-length, 0};
            default:
                return {0, -length};
        }
    }
    const Lattice& lattice_;
};

/// Coordinates in doubles, for any angle.
class PlaneWalk {
public:
    using Number = double;
    struct Position {
        double x = 0, y = 0;
        std::uint32_t heading = 0;
        double degrees = 0;
    };
    struct Step {
        double x, y;
    };
    PlaneWalk(const Grammar& grammar, const Lattice& lattice, int) : grammar_(grammar), lattice_(lattice) {}
    Step step(const Position& at, Symbol symbol) const {
        const double length = grammar_.symbols()[symbol].command.value;
        const glm::dvec2 ahead =
            lattice_.headings > 0 ? lattice_.direction[at.heading] : unit_vector(lattice_.first_heading + at.degrees);
        return {length * ahead.x, length * ahead.y};
    }
    void turn(Position& at, Symbol symbol) const {
        if (lattice_.headings > 0) {
            at.heading = (at.heading + lattice_.turn[symbol]) % lattice_.headings;
        } else {
            at.degrees = std::fmod(at.degrees + grammar_.symbols()[symbol].command.angle.degrees, 360.0);
        }
    }
    static bool is_level(double rise) { return std::fabs(rise) < 1e-9; }
    static bool same_direction(const Step& a, const Step& b) {
        const double dot = a.x * b.x + a.y * b.y;
        const double cross = a.x * b.y - a.y * b.x;
        return dot > 0 && std::fabs(cross) <= 1e-9 * dot;
    }
    static std::int64_t ticks(double steps, std::int64_t unit) {
        return std::llround(std::min(steps * static_cast<double>(unit), static_cast<double>(latest)));
    }
    static double length(const Step& step) { return std::hypot(step.x, step.y); }
    static std::int64_t degree(double twice) {
        return static_cast<std::int64_t>(std::clamp(std::floor(twice / 2 + 0.5), -1e15, 1e15));
    }
    static bool in_range(const Position& at) { return std::isfinite(at.x) && std::isfinite(at.y); }

    Position start;

private:
    const Grammar& grammar_;
    const Lattice& lattice_;
};

}  // namespace sikku::mapping
