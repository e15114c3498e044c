// art/reading/read_kolam.h: a kolam read from a file, with the certainty of each gap.
#pragma once

#include "art/kolam/dot_grid_lines.h"
#include "art/kolam/dot_grid_pattern.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A kolam that was read, with the certainty of its gaps.
struct ReadKolam {
    DotGrid grid;
    GapStates states;
    /// For each gap 0 (guessed) to 1 (certain); below doubtful_below the gap is doubtful. Empty: all are certain.
    std::vector<float> certainty = {};
    std::vector<std::uint32_t> repaired = {};  ///< gaps changed by symmetry or by hand, ascending
    std::vector<std::string> notes = {};       ///< notes for the user: assumptions, repairs, omissions
    std::string title = {};                    ///< title in the file; may be empty
    RimStyle rim = RimStyle::round;            ///< shape of the loops at the rim that the pattern states
    bool has_centred_dots = false;             ///< the pattern states dots between crossed gaps

    static constexpr float doubtful_below = 0.5F;
    bool is_doubtful(std::uint32_t gap) const { return !certainty.empty() && certainty[gap] < doubtful_below; }
    /// Doubtful gaps, ascending.
    std::vector<std::uint32_t> doubtful() const;
};

/// The place of a gap for users: its row, and its number in the row, both from 1. Rows of gaps are the words of
/// gap_states_text(): from the top, the gaps within a row of dots, then those to the next row; numbers count from the
/// left.
struct GapPlace {
    std::uint32_t row = 0;
    std::uint32_t number = 0;
    bool operator==(const GapPlace&) const = default;
};
/// The place of each gap, in the order of DotGrid::gaps().
std::vector<GapPlace> gap_places(const DotGrid& grid);

/// Changes a kolam as `text` says, several fixes separated by semicolons. `3,4: cross` sets a gap; the states are
/// cross, turn and join (or crossed, turned, joined, x, p, j). `dot 0,3` and `no dot 2,1` add and remove dots by row
/// and place; rows of dots count from 1 at the top, places from 1 at the left side of the grid's box. Each fix counts
/// in the grid that those before it have made. Gaps that are set become certain and are listed as repaired; those of
/// added dots turn back and are doubtful.
/// @throws std::runtime_error for anything else, and for places without a gap or dot
void fix_gaps(ReadKolam& kolam, std::string_view text);

/// Replaces the states of doubtful gaps by those of their certain images under those symmetries of the grid that all
/// certain gaps have, at least six pairs of them. Repaired gaps stay doubtful, and are noted.
/// @return the number of gaps that changed
std::size_t repair_by_symmetry(ReadKolam& kolam);

struct GapStateNames {
    std::string_view verb, name;
    char letter;
};
/// In the order of GapState.
constexpr std::array<GapStateNames, 3> gap_state_names = {
    {{"turn", "turned", 'p'}, {"cross", "crossed", 'x'}, {"join", "joined", 'j'}}};

/// Returns `crossed`, `turned` or `joined`.
std::string_view gap_state_name(GapState state);
std::optional<GapState> state_of_letter(char letter);

}  // namespace sikku
