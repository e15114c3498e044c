// engine/measure/clumps.h: groups the parts of a drawing with the short pieces between them.
#pragma once

#include "engine/measure/parts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Consecutive symbols of a successor that can be treated as one: turns, symbols that draw nothing, and parts, of
/// which at most one is larger than a sixteenth of the largest part of the successor.
struct Clump {
    const Symbol* begin = nullptr;
    const Symbol* end = nullptr;
    DrawnPart<double> part;
};

/// Divides the successors of all parts that draw into clumps, typically half as many as symbols, or fewer. Brackets
/// and steps that do not draw form clumps of their own.
class Clumps {
public:
    /// `parts` must outlive this object. Cost: O(parts x length of their successors), in time and memory.
    explicit Clumps(const Grammar& grammar, const Parts<double>& parts);

    /// Clumps of the successor of the part with that index. Valid for parts that draw, above level 0.
    std::span<const Clump> below(std::size_t part) const {
        return std::span(clumps_).subspan(below_[part].first, below_[part].count);
    }
    const std::vector<Clump>& all() const { return clumps_; }

private:
    std::vector<Symbol> itself_;  // each symbol, as the successor of those without productions
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Range> below_;
    std::vector<Clump> clumps_;
};

}  // namespace sikku
