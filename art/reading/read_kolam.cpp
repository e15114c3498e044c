#include "art/reading/read_kolam.h"

#include "art/kolam/dot_grid_symmetry.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace sikku {
namespace {

/// Fewer certain pairs of images do not make a symmetry.
constexpr std::size_t least_pairs = 6;

[[noreturn]] void refuse_fix(std::string_view text) {
    throw std::runtime_error(
        fmt::format("'{}': expected ROW,GAP: STATE such as '3,4: cross'; the states are cross, "
                    "turn and join",
                    printable(text, 80)));
}

std::optional<GapState> parse_state(std::string_view word) {
    for (const auto& [verb, name, letter] : gap_state_names) {
        if (word == verb || word == name || word == std::string_view(&letter, 1)) return state_of_letter(letter);
    }
    return std::nullopt;
}

/// Takes a whole number up to a mark, and the mark, from the beginning of `text`.
std::uint32_t take_number(std::string_view& text, char mark, std::string_view whole) {
    const std::size_t at = text.find(mark);
    const std::string_view digits = trimmed(text.substr(0, at));
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (at == std::string_view::npos || error != std::errc() || end != digits.data() + digits.size())
        refuse_fix(whole);
    text.remove_prefix(at + 1);
    return number;
}

void fix_one(ReadKolam& kolam, std::string_view given, const std::vector<GapPlace>& places) {
    std::string_view text = given;
    GapPlace place;
    place.row = take_number(text, ',', given);
    place.number = take_number(text, ':', given);
    const auto state = parse_state(lower_case(trimmed(text)));
    if (!state) refuse_fix(given);
    const auto found = std::find(places.begin(), places.end(), place);
    if (found == places.end()) {
        const std::uint32_t rows = places.empty() ? 0 : places.back().row;
        if (place.row == 0 || place.row > rows) {
            throw std::runtime_error(
                fmt::format("'{}': rows of gaps are numbered 1 to {}", printable(given, 80), rows));
        }
        const auto in_row =
            std::count_if(places.begin(), places.end(), [&](const GapPlace& at) { return at.row == place.row; });
        throw std::runtime_error(fmt::format("'{}': row {} has {}", printable(given, 80), place.row,
                                             counted(static_cast<std::uint64_t>(in_row), "gap")));
    }
    const auto gap = static_cast<std::uint32_t>(found - places.begin());
    kolam.states[gap] = *state;
    if (!kolam.certainty.empty()) kolam.certainty[gap] = 1;
    const auto at = std::lower_bound(kolam.repaired.begin(), kolam.repaired.end(), gap);
    if (at == kolam.repaired.end() || *at != gap) kolam.repaired.insert(at, gap);
}

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

void fix_gaps(ReadKolam& kolam, std::string_view text) {
    const std::vector<GapPlace> places = gap_places(kolam.grid);
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(';', at), text.size());
        const std::string_view part = trimmed(text.substr(at, end - at));
        if (!part.empty() || end == text.size()) fix_one(kolam, part, places);
        at = end + 1;
        if (trimmed(text.substr(std::min(at, text.size()))).empty()) break;
    }
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
