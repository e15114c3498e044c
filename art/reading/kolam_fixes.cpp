#include "art/reading/kolam_fixes.h"

#include "art/reading/kolam_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

namespace sikku {
namespace {

[[noreturn]] void refuse_fix(std::string_view text) {
    throw FixError(
        fmt::format("'{}': expected ROW,GAP: STATE such as '3,4: cross', or 'dot ROW,PLACE' or 'no dot "
                    "ROW,PLACE'; the states are cross, turn and join",
                    printable(text, 80)));
}
[[noreturn]] void refuse_fix(std::string_view text, std::string_view why) {
    throw FixError(fmt::format("'{}': {}", printable(text, 80), why));
}

std::optional<GapState> parse_state(std::string_view word) {
    for (const auto& [verb, name, letter] : gap_state_names) {
        if (word == verb || word == name || word == std::string_view(&letter, 1)) return state_of_letter(letter);
    }
    return std::nullopt;
}

/// Reads a whole number that blanks may surround.
std::optional<std::int32_t> whole_number_of(std::string_view text) {
    const std::string_view digits = trimmed(text);
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return number;
}

/// Reads two whole numbers separated by a comma.
std::optional<DotAddress> two_numbers_of(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    const auto row = whole_number_of(text.substr(0, comma));
    const auto number = whole_number_of(text.substr(comma + 1));
    return row && number ? std::optional(DotAddress{*row, *number}) : std::nullopt;
}

std::int32_t left_of(const DotGrid& grid) {
    return std::min_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.x < b.x; })
        ->x;
}
/// Half spacings by which the places of a row lie to the right of those of the first dot's row.
std::int32_t shift_of(const DotGrid& grid, std::int32_t row) {
    const GridDot first = grid.dots().front();
    const bool is_shifted = grid.lattice() == DotLattice::triangular && row % 2 == 0;
    return (first.x + (is_shifted ? 1 : 0) - left_of(grid)) & 1;
}

/// Removes a place from a list; true if it was there.
bool take_out(std::vector<GridDot>& list, GridDot place) {
    return std::erase(list, place) > 0;
}

/// The gap at a place of a grid's gaps. @throws FixError if there is none
std::uint32_t gap_at(const DotGrid& grid, DotAddress address, std::string_view text) {
    const std::vector<GapPlace> places = gap_places(grid);
    const std::uint32_t rows = places.empty() ? 0 : places.back().row;
    if (address.row < 1 || address.row > static_cast<std::int64_t>(rows)) {
        refuse_fix(text, fmt::format("rows of gaps are numbered 1 to {}", rows));
    }
    const auto row = static_cast<std::uint32_t>(address.row);
    const auto first =
        std::find_if(places.begin(), places.end(), [&](const GapPlace& place) { return place.row == row; });
    const auto count =
        std::count_if(places.begin(), places.end(), [&](const GapPlace& place) { return place.row == row; });
    if (address.number < 1 || address.number > count) {
        refuse_fix(text, fmt::format("row {} has {}", row, counted(static_cast<std::uint64_t>(count), "gap")));
    }
    return static_cast<std::uint32_t>(first - places.begin() + address.number - 1);
}

/// True if a place lies within two steps of a dot.
bool is_beside(const DotGrid& grid, GridDot place) {
    return std::any_of(grid.dots().begin(), grid.dots().end(), [&](GridDot dot) {
        return std::abs(std::int64_t{dot.x} - place.x) <= 4 && std::abs(std::int64_t{dot.y} - place.y) <= 4;
    });
}

}  // namespace

DotAddress address_of(const DotGrid& grid, GridDot place) {
    const std::int32_t row = (grid.dots().front().y - place.y) / 2 + 1;
    return {row, (place.x - left_of(grid) - shift_of(grid, row)) / 2 + 1};
}

GridDot place_at(const DotGrid& grid, DotAddress address) {
    return {left_of(grid) + shift_of(grid, address.row) + 2 * (address.number - 1),
            grid.dots().front().y - 2 * (address.row - 1)};
}

void KolamFixes::add(std::string_view text) {
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(';', at), text.size());
        const std::string_view part = trimmed(text.substr(at, end - at));
        if (!part.empty() || end == text.size()) add_one(part);
        at = end + 1;
        if (trimmed(text.substr(std::min(at, text.size()))).empty()) break;
    }
}

void KolamFixes::add_one(std::string_view text) {
    constexpr std::string_view dot = "dot ";
    constexpr std::string_view no_dot = "no dot ";
    if (text.starts_with(dot)) return change_dot(text, text.substr(dot.size()), true);
    if (text.starts_with(no_dot)) return change_dot(text, text.substr(no_dot.size()), false);
    set_gap(text);
}

void KolamFixes::change_dot(std::string_view text, std::string_view given, bool is_added) {
    constexpr std::int32_t farthest = 100'000;
    const auto address = two_numbers_of(given);
    if (!address) refuse_fix(text);
    if (std::abs(std::int64_t{address->row}) > farthest || std::abs(std::int64_t{address->number}) > farthest) {
        refuse_fix(text, "no dot is near");
    }
    const GridDot place = place_at(grid_, *address);
    const bool is_dot = grid_.dot_at(place).has_value();
    if (is_added && is_dot) refuse_fix(text, "there is a dot already");
    if (is_added && !is_beside(grid_, place)) refuse_fix(text, "no dot is near");
    if (!is_added && !is_dot) refuse_fix(text, "the place is empty");
    if (!is_added && grid_.dots().size() == 1) refuse_fix(text, "it is the only dot");
    std::vector<GridDot> dots = grid_.dots();
    if (is_added) {
        dots.push_back(place);
    } else {
        std::erase(dots, place);
    }
    const GridDot whole = place + origin_;
    if (!take_out(is_added ? removed_ : added_, whole)) (is_added ? added_ : removed_).push_back(whole);
    PlacedGrid placed = place_grid(grid_.lattice(), std::move(dots));
    grid_ = std::move(placed.grid);
    origin_ = origin_ + placed.origin;
}

void KolamFixes::set_gap(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) refuse_fix(text);
    const auto address = two_numbers_of(text.substr(0, colon));
    const auto state = parse_state(lower_case(trimmed(text.substr(colon + 1))));
    if (!address || !state) refuse_fix(text);
    const GridGap& gap = grid_.gaps()[gap_at(grid_, *address, text)];
    gaps_[{grid_.dots()[gap.from] + origin_, gap.side}] = *state;
}

std::vector<GridDot> KolamFixes::places() const {
    std::vector<GridDot> all;
    for (const GridDot dot : grid_.dots()) all.push_back(dot + origin_);
    return all;
}

void KolamFixes::set_gaps(ReadKolam& kolam) const {
    for (const auto& [side, state] : gaps_) {
        const auto dot = grid_.dot_at(side.first - origin_);
        const std::int32_t found = dot ? grid_.gap(*dot, side.second) : -1;
        if (found < 0) continue;  // one of its dots was removed
        const auto gap = static_cast<std::uint32_t>(found);
        kolam.states[gap] = state;
        if (!kolam.certainty.empty()) kolam.certainty[gap] = 1;
        const auto at = std::lower_bound(kolam.repaired.begin(), kolam.repaired.end(), gap);
        if (at == kolam.repaired.end() || *at != gap) kolam.repaired.insert(at, gap);
    }
}

namespace {

/// The kolam with other dots: gaps between dots of both keep their states, the others turn back and are doubtful.
void change_dots(ReadKolam& kolam, const KolamFixes& fixes) {
    PlacedGrid placed = place_grid(kolam.grid.lattice(), fixes.places());
    const DotGrid& grid = placed.grid;
    ReadKolam changed{grid, GapStates(grid.gaps().size()), std::vector<float>(grid.gaps().size(), 0.0F)};
    for (std::uint32_t i = 0; i < grid.gaps().size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        const auto from = kolam.grid.dot_at(grid.dots()[gap.from] + placed.origin);
        const std::int32_t before = from ? kolam.grid.gap(*from, gap.side) : -1;
        if (before < 0) continue;
        const auto old = static_cast<std::uint32_t>(before);
        changed.states[i] = kolam.states[old];
        changed.certainty[i] = kolam.certainty.empty() ? 1.0F : kolam.certainty[old];
        if (std::binary_search(kolam.repaired.begin(), kolam.repaired.end(), old)) changed.repaired.push_back(i);
    }
    changed.notes = std::move(kolam.notes);
    changed.title = std::move(kolam.title);
    kolam = std::move(changed);
}

}  // namespace

void fix_gaps(ReadKolam& kolam, std::string_view text) {
    KolamFixes fixes(kolam.grid);
    fixes.add(text);
    if (fixes.changes_dots()) change_dots(kolam, fixes);
    fixes.set_gaps(kolam);
}

}  // namespace sikku
