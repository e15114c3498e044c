// art/relief/windings.h: winding numbers of the outlines of layers around a place, in numbered sets.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace sikku {

/// The winding number of a layer's outlines around a place, anticlockwise; or, across an edge, that on its left minus
/// that on its right.
struct Winding {
    std::uint32_t layer = 0;
    std::int32_t count = 0;                            ///< not 0
    auto operator<=>(const Winding&) const = default;  // NOLINT(modernize-use-nullptr): no pointer is compared
};

/// Numbers sets of windings, so that triangles and edges store only numbers. 0 is the empty set.
class Windings {
public:
    using Id = std::uint32_t;

    Windings();
    Id of(std::uint32_t layer, std::int32_t count) { return number({{layer, count}}); }
    /// Adds two sets. Cost: a look-up, after the first time.
    Id sum(Id a, Id b);
    Id negative(Id id) const { return negatives_[id]; }
    /// The windings of a set, in the order of layers.
    std::span<const Winding> at(Id id) const { return sets_[id]; }
    std::size_t size() const { return sets_.size(); }

private:
    using Set = std::vector<Winding>;
    Id number(const Set& set);

    std::vector<Set> sets_;
    std::vector<Id> negatives_;
    std::map<Set, Id> ids_;
    std::unordered_map<std::uint64_t, Id> sums_;
};

}  // namespace sikku
