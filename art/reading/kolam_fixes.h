// art/reading/kolam_fixes.h: changes by hand to a kolam that was read.
#pragma once

#include "art/kolam/dot_grid_lines.h"
#include "art/reading/read_kolam.h"

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Thrown for a fix that cannot be read or applied; its message quotes the fix.
class FixError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The place of a dot, or of an empty place, for users: its row, from 1 at the top, and its number among all places
/// of the row, from 1 at the left side of the grid's box. 0 is the row above, and the place to the left.
struct DotAddress {
    std::int32_t row = 0;
    std::int32_t number = 0;
    bool operator==(const DotAddress&) const = default;
};
DotAddress address_of(const DotGrid& grid, GridDot place);
GridDot place_at(const DotGrid& grid, DotAddress address);

/// Collects fixes of a grid: `dot 0,3` and `no dot 2,1` add and remove dots by address, `3,4: cross` sets a gap by
/// GapPlace. Each of them counts rows and numbers in the grid that those before it have made.
class KolamFixes {
public:
    explicit KolamFixes(const DotGrid& grid) : grid_(grid) {}

    /// Adds fixes, separated by semicolons. @throws FixError
    void add(std::string_view text);

    /// All dots, as places of the grid that was given to the constructor.
    std::vector<GridDot> places() const;
    /// The dots that were added, and the places from which dots were removed, in the same places.
    const std::vector<GridDot>& added() const { return added_; }
    const std::vector<GridDot>& removed() const { return removed_; }
    bool changes_dots() const { return !added_.empty() || !removed_.empty(); }
    /// Sets the gaps. The gaps become certain and are listed as repaired.
    /// @param kolam  on the dots of places()
    void set_gaps(ReadKolam& kolam) const;

private:
    void add_one(std::string_view text);
    void change_dot(std::string_view text, std::string_view address, bool is_added);
    void set_gap(std::string_view text);

    using Side = std::pair<GridDot, std::uint32_t>;  // a place and its side

    DotGrid grid_;    ///< with the dots so far
    GridDot origin_;  ///< its place (0, 0) in the grid given to the constructor
    std::vector<GridDot> added_, removed_;
    std::map<Side, GapState> gaps_;
};

}  // namespace sikku
