#include "art/reading/read_kolam.h"

#include "art/kolam/dot_grid_symmetry.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace sikku {
namespace {

/// Fewer certain pairs of images do not make a symmetry.
constexpr std::size_t least_pairs = 6;

}  // namespace

std::vector<std::uint32_t> ReadKolam::doubtful() const {
    std::vector<std::uint32_t> gaps;
    for (std::uint32_t gap = 0; gap < certainty.size(); ++gap) {
        if (is_doubtful(gap)) gaps.push_back(gap);
    }
    return gaps;
}

std::vector<GapPlace> gap_places(const DotGrid& grid) {
    std::vector<GapPlace> places;
    places.reserve(grid.gaps().size());
    GapPlace place{1, 0};
    for (std::size_t i = 0; i < grid.gaps().size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        if (i > 0) {
            const GridGap& before = grid.gaps()[i - 1];
            if ((gap.side == 0) != (before.side == 0) || grid.dots()[gap.from].y != grid.dots()[before.from].y) {
                place = {place.row + 1, 0};
            }
        }
        ++place.number;
        places.push_back(place);
    }
    return places;
}

std::size_t repair_by_symmetry(ReadKolam& kolam) {
    const std::vector<std::uint32_t> doubts = kolam.doubtful();
    if (doubts.empty()) return 0;
    std::vector<std::vector<std::uint32_t>> symmetries;
    for (std::vector<std::uint32_t>& images : grid_symmetries(kolam.grid)) {
        std::size_t pairs = 0;
        bool agrees = true;
        for (std::uint32_t gap = 0; gap < images.size() && agrees; ++gap) {
            const std::uint32_t image = images[gap];
            if (image == gap || kolam.is_doubtful(gap) || kolam.is_doubtful(image)) continue;
            ++pairs;
            agrees = kolam.states[gap] == kolam.states[image];
        }
        // A pair is met from both of its sides, or from one of its three or more.
        if (agrees && pairs >= 2 * least_pairs && 4 * pairs >= images.size()) symmetries.push_back(std::move(images));
    }
    std::size_t changed = 0;
    const std::vector<GapPlace> places = gap_places(kolam.grid);
    for (const std::uint32_t gap : doubts) {
        std::array<std::size_t, 3> votes{};
        for (const auto& images : symmetries) {
            if (!kolam.is_doubtful(images[gap])) ++votes[static_cast<std::size_t>(kolam.states[images[gap]])];
        }
        const auto best = std::max_element(votes.begin(), votes.end());
        if (*best == 0 || std::accumulate(votes.begin(), votes.end(), std::size_t{0}) != *best) continue;
        const auto state = static_cast<GapState>(best - votes.begin());
        if (state == kolam.states[gap]) continue;
        kolam.notes.push_back(fmt::format("row {}, gap {}: read as {}, changed to {} by symmetry", places[gap].row,
                                          places[gap].number, gap_state_name(kolam.states[gap]),
                                          gap_state_name(state)));
        kolam.states[gap] = state;
        kolam.repaired.push_back(gap);
        ++changed;
    }
    std::sort(kolam.repaired.begin(), kolam.repaired.end());
    return changed;
}

std::string_view gap_state_name(GapState state) {
    return gap_state_names[static_cast<std::size_t>(state)].name;
}

std::optional<GapState> state_of_letter(char letter) {
    for (std::size_t i = 0; i < gap_state_names.size(); ++i) {
        if (gap_state_names[i].letter == letter) return static_cast<GapState>(i);
    }
    return std::nullopt;
}

}  // namespace sikku
