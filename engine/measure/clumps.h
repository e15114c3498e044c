// engine/measure/clumps.h: groups the parts of a drawing with the short pieces between them.
#pragma once

#include "engine/measure/parts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A stretch of a successor that holds one large part at most, and around it turns, symbols that draw nothing, and
/// parts a sixteenth as large: what can be looked at as one.
struct Clump {
    const Symbol* begin = nullptr;
    const Symbol* end = nullptr;
    DrawnPart<double> part;
};

/// The successors of all parts that draw, in clumps: there are half as many as symbols, or fewer. Brackets and steps
/// that do not draw stand alone.
class Clumps {
public:
    /// `parts` must outlive them. Cost: O(parts x length of their successors), in time and memory.
    explicit Clumps(const Grammar& grammar, const Parts<double>& parts);

    /// The clumps that the part with that index becomes. Valid for parts that draw, above level 0.
    std::span<const Clump> below(std::size_t part) const {
        return std::span(clumps_).subspan(below_[part].first, below_[part].count);
    }
    const std::vector<Clump>& all() const { return clumps_; }

private:
    std::vector<Symbol> itself_;  // each symbol, for those that become themselves
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Range> below_;
    std::vector<Clump> clumps_;
};

}  // namespace sikku
