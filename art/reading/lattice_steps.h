// art/reading/lattice_steps.h: places of a lattice in steps, which rotations and mirrors map linearly.
#pragma once

#include "art/kolam/dot_grid.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sikku {

/// Steps from a base to a place: to the right, and up (square) or up to the right (triangular).
using LatticeSteps = std::pair<std::int32_t, std::int32_t>;

/// Converts places of a lattice to steps from a base and back.
class StepFrame {
public:
    StepFrame(DotLattice lattice, GridDot base) : base_(base), is_square_(lattice == DotLattice::square) {}
    LatticeSteps steps(GridDot dot) const {
        const std::int32_t up = (dot.y - base_.y) / 2;
        return {(dot.x - base_.x - (is_square_ ? 0 : up)) / 2, up};
    }
    GridDot place(LatticeSteps s) const {
        return {base_.x + 2 * s.first + (is_square_ ? 0 : s.second), base_.y + 2 * s.second};
    }

private:
    GridDot base_;
    bool is_square_;
};

/// A linear map of steps.
struct LatticeTurn {
    std::array<std::int32_t, 4> m = {1, 0, 0, 1};
    LatticeSteps operator()(LatticeSteps s) const {
        return {m[0] * s.first + m[1] * s.second, m[2] * s.first + m[3] * s.second};
    }
    /// The map that applies `first` and then this one.
    LatticeTurn after(const LatticeTurn& first) const;
};

/// All rotations of a lattice: the identity, then anticlockwise.
std::vector<LatticeTurn> rotations_of(DotLattice lattice);
/// All rotations and mirrors of a lattice except the identity.
std::vector<LatticeTurn> turns_of(DotLattice lattice);

}  // namespace sikku
