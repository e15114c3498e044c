// art/hand/pinches.h: the pinches of flour with which a hand strews a line.
#pragma once

#include "engine/base/chance.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// The flour that falls along a line: the hand takes a pinch, begins a stretch with a small heap, and runs dry
/// towards its end, some stretches more than others. A pinch lasts 4 to 9 loops: 20 to 60 cm on a floor with dots 6
/// cm apart.
class Pinches {
public:
    /// @param length, loop  of the line, in steps  @param strength  of the hand, 0 to 1
    Pinches(std::uint64_t seed, double length, double loop, double strength);

    /// The flour at a length along the line, relative to a full hand: 0.4 to 1.35. Cost: O(log pinches).
    double flow(double along) const;
    /// How close the beginning of a pinch is: 1 where it begins, 0 from half a loop on.
    double beginning(double along) const;

private:
    struct Pinch {
        double begin = 0, length = 0;
        double dryness = 0;  ///< share of the flour that is missing at its end
    };
    const Pinch& at(double along) const;

    std::vector<Pinch> pinches_;
    double loop_, strength_;
};

}  // namespace sikku
