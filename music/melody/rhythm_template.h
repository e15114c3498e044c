// music/melody/rhythm_template.h: rhythms laid over the steps of a curve.
#pragma once

#include "music/score/score.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Onsets in a cycle of equal slots. The steps of a curve take them in turn, cyclically.
struct RhythmTemplate {
    struct Hit {
        std::int64_t onset = 0;   ///< slots from the beginning of the cycle
        std::int64_t length = 1;  ///< slots that sound: up to the next hit, or to the rest before it
        Stress stress = Stress::plain;
        std::uint8_t percent = 100;  ///< probability that it sounds
    };
    std::vector<Hit> hits;  ///< by onset, the first at 0; none: every step lasts a slot
    std::int64_t slots = 0;

    bool empty() const { return hits.empty(); }
    /// The slot in which step `index`, counted from 0, begins.
    std::int64_t onset(std::int64_t index) const {
        const auto count = static_cast<std::int64_t>(hits.size());
        return index / count * slots + hits[static_cast<std::size_t>(index % count)].onset;
    }
    /// The slot at which a note that ends with step `index` - 1 ends.
    std::int64_t end(std::int64_t index) const {
        if (index <= 0) return 0;
        const Hit& last = hits[static_cast<std::size_t>((index - 1) % static_cast<std::int64_t>(hits.size()))];
        return onset(index - 1) + last.length;
    }
    const Hit& hit(std::int64_t index) const { return hits[static_cast<std::size_t>(index) % hits.size()]; }
    /// True if some notes sound by chance.
    bool has_chance() const {
        return std::any_of(hits.begin(), hits.end(), [](const Hit& hit) { return hit.percent < 100; });
    }
};

/// Reads `x..x..x.` (x a note, X an accented one, o a ghost note, . holds it, ~ is silent; blanks and | do not
/// count), in which `x?` and `x?30` sound by chance, half of the time or 30 % of it, and `(x.x.)3` is repeated;
/// `E(3,8)` or `E(3,8,2)` (Bjorklund's distribution of 3 notes over 8 slots, rotated by 2), the groups of a tala such
/// as `4+2+2`, or a tala's name; a tala has a note for each group, the first accented.
/// @param problem  receives the problem if the result is empty
/// Source: Toussaint 2005 for E(k,n).
RhythmTemplate read_rhythm_template(std::string_view text, std::string& problem);

}  // namespace sikku
