#include "art/kolam/dot_grid.h"

#include "engine/base/union_find.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::array<GridDot, 4> square_steps = {{{2, 0}, {0, 2}, {-2, 0}, {0, -2}}};
constexpr std::array<GridDot, 6> triangular_steps = {{{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}}};

[[noreturn]] void refuse_size() {
    throw std::runtime_error(fmt::format(
        "a grid can have at most {} dots: a larger one and its lines would take more than {} MB of memory",
        DotGrid::most_dots, DotGrid::most_dots * 100 / 1'000'000));
}

std::uint32_t parity(std::int32_t number) {
    return static_cast<std::uint32_t>(number) & 1U;
}

bool is_odd_row(std::size_t row) {
    return row % 2 != 0;
}

/// The lattice of centred rows with these numbers of dots.
DotLattice lattice_of(const std::vector<std::uint32_t>& rows) {
    const DotLattice lattice =
        rows.size() > 1 && rows[0] % 2 != rows[1] % 2 ? DotLattice::triangular : DotLattice::square;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const bool differs = rows[r] % 2 != rows[r - 1] % 2;
        if (differs == (lattice == DotLattice::triangular)) continue;
        throw std::runtime_error(fmt::format(
            "row {} of the grid has {} dots and the row above it {}: the numbers of a straight grid are all odd or "
            "all even; those of an interlaced grid alternate between odd and even",
            r + 1, rows[r], rows[r - 1]));
    }
    return lattice;
}

/// True for the symmetric grid in which rows become shorter by `less` from the longest to the last, as in `A to B`.
bool is_spindle(const std::vector<std::uint32_t>& rows, std::uint32_t less) {
    if (rows.size() % 2 == 0 || rows.size() < 3) return false;
    const std::size_t middle = rows.size() / 2;
    for (std::size_t r = 0; r < middle; ++r) {
        if (rows[r] != rows[rows.size() - 1 - r] || rows[r] + less != rows[r + 1]) return false;
    }
    return true;
}

}  // namespace

DotGrid::DotGrid(std::vector<std::uint32_t> rows) {
    if (rows.empty()) throw std::runtime_error("a grid of dots needs at least one row");
    std::uint64_t count = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (rows[r] == 0) throw std::runtime_error(fmt::format("row {} of the grid has no dots", r + 1));
        count += rows[r];
        if (count > most_dots) refuse_size();
    }
    std::vector<std::vector<std::int32_t>> columns(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto length = static_cast<std::int32_t>(rows[r]);
        for (std::int32_t i = 0; i < length; ++i) columns[r].push_back(2 * i - (length - 1));
    }
    place(lattice_of(rows), columns);
    connect();
}

DotGrid::DotGrid(DotLattice lattice, const std::vector<std::vector<std::int32_t>>& columns) {
    std::uint64_t count = 0;
    std::optional<std::uint32_t> first;  // parity of x in even rows
    for (std::size_t r = 0; r < columns.size(); ++r) {
        count += columns[r].size();
        if (count > most_dots) refuse_size();
        for (const std::int32_t x : columns[r]) {
            const std::uint32_t shift = lattice == DotLattice::triangular && is_odd_row(r) ? 1 : 0;
            const std::uint32_t found = parity(x) ^ shift;
            if (first.value_or(found) != found) {
                throw std::runtime_error(
                    fmt::format("row {} of the grid has a dot between the points of the lattice", r + 1));
            }
            first = found;
        }
    }
    if (count == 0) throw std::runtime_error("a grid of dots needs at least one dot");
    place(lattice, columns);
    connect();
}

void DotGrid::place(DotLattice lattice, const std::vector<std::vector<std::int32_t>>& columns) {
    lattice_ = lattice;
    // Empty rows at the top and at the bottom do not count; those within do.
    std::size_t top = 0;
    std::size_t bottom = columns.size();
    while (columns[top].empty()) ++top;
    while (columns[bottom - 1].empty()) --bottom;
    std::int32_t left = INT32_MAX;
    std::int32_t right = INT32_MIN;
    for (const auto& row : columns) {
        if (row.empty()) continue;
        left = std::min(left, row.front());
        right = std::max(right, row.back());
    }
    // The middle of the box; if it lies between units, half a unit to its left.
    const std::int32_t middle = left + (right - left) / 2;
    const auto rows = static_cast<std::int32_t>(bottom - top);
    for (std::size_t r = top; r < bottom; ++r) {
        row_begin_.push_back(static_cast<std::uint32_t>(dots_.size()));
        const std::int32_t y = rows - 1 - 2 * static_cast<std::int32_t>(r - top);
        for (const std::int32_t x : columns[r]) dots_.push_back({x - middle, y});
    }
    row_begin_.push_back(static_cast<std::uint32_t>(dots_.size()));
}

void DotGrid::connect() {
    gap_at_.assign(sides() * dots_.size(), -1);
    gaps_.reserve(sides() / 2 * dots_.size());
    const auto add = [this](std::uint32_t from, std::uint32_t side) {
        const GridDot way = step(side);
        const auto to = dot_at({dots_[from].x + way.x, dots_[from].y + way.y});
        if (!to) return;
        const std::uint32_t back = (side + sides() / 2) % sides();
        gap_at_[sides() * from + side] = gap_at_[sides() * *to + back] = static_cast<std::int32_t>(gaps_.size());
        gaps_.push_back({from, *to, side});
    };
    for (std::size_t r = 0; r + 1 < row_begin_.size(); ++r) {
        for (std::uint32_t dot = row_begin_[r]; dot < row_begin_[r + 1]; ++dot) add(dot, 0);
        for (std::uint32_t dot = row_begin_[r]; dot < row_begin_[r + 1]; ++dot) {
            for (std::uint32_t side = sides() / 2 + 1; side < sides(); ++side) add(dot, side);
        }
    }
}

std::vector<std::uint32_t> DotGrid::rows() const {
    std::vector<std::uint32_t> counts;
    for (std::size_t r = 0; r + 1 < row_begin_.size(); ++r) counts.push_back(row_begin_[r + 1] - row_begin_[r]);
    return counts;
}

GridDot DotGrid::step(std::uint32_t side) const {
    return lattice_ == DotLattice::square ? square_steps[side] : triangular_steps[side];
}

std::optional<std::uint32_t> DotGrid::dot_at(GridDot place) const {
    const auto rows = static_cast<std::int32_t>(row_begin_.size()) - 1;
    const std::int32_t row = rows - 1 - place.y;
    if (row < 0 || row % 2 != 0 || row / 2 >= rows) return std::nullopt;
    const auto begin = dots_.begin() + row_begin_[static_cast<std::size_t>(row / 2)];
    const auto end = dots_.begin() + row_begin_[static_cast<std::size_t>(row / 2) + 1];
    if (begin == end || place.x < begin->x || place.x > (end - 1)->x) return std::nullopt;
    auto found = begin + std::min<std::ptrdiff_t>((place.x - begin->x) / 2, end - begin - 1);
    if (found->x != place.x) {  // the row has holes
        found = std::lower_bound(begin, end, place.x, [](const GridDot& dot, std::int32_t x) { return dot.x < x; });
        if (found == end || found->x != place.x) return std::nullopt;
    }
    return static_cast<std::uint32_t>(found - dots_.begin());
}

std::size_t DotGrid::groups() const {
    UnionFind sets(dots_.size());
    for (const GridGap& gap : gaps_) sets.join(gap.from, gap.to);
    return sets.count();
}

bool DotGrid::is_solid() const {
    for (std::size_t r = 0; r + 1 < row_begin_.size(); ++r) {
        const auto count = static_cast<std::int32_t>(row_begin_[r + 1] - row_begin_[r]);
        if (count == 0) return false;
        const std::int32_t first = dots_[row_begin_[r]].x;
        const std::int32_t last = dots_[row_begin_[r + 1] - 1].x;
        if (first != -last || last - first != 2 * (count - 1)) return false;
    }
    return true;
}

std::string DotGrid::name() const {
    constexpr std::size_t longest = 40;
    std::string notation = text();
    return notation.size() <= longest ? notation : fmt::format("a grid of {} dots", dots_.size());
}

std::string DotGrid::text() const {
    const std::vector<std::uint32_t> counts = rows();
    if (is_solid()) {
        if (lattice_ == DotLattice::square &&
            std::all_of(counts.begin(), counts.end(), [&](std::uint32_t row) { return row == counts[0]; })) {
            return fmt::format("{}x{}", counts.size(), counts[0]);
        }
        if (lattice_ == DotLattice::triangular && is_spindle(counts, 1)) {
            return fmt::format("{}-{} idukku", counts[counts.size() / 2], counts[0]);
        }
        return fmt::format("{}", fmt::join(counts, counts.size() == 2 ? "," : "-"));
    }
    const std::int32_t left =
        std::min_element(dots_.begin(), dots_.end(), [](GridDot a, GridDot b) { return a.x < b.x; })->x;
    const bool is_square = lattice_ == DotLattice::square;
    std::string text;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        if (r > 0) text += '/';
        std::string row;
        for (std::uint32_t dot = row_begin_[r]; dot < row_begin_[r + 1]; ++dot) {
            const std::int32_t x = dots_[dot].x - left;
            row.resize(static_cast<std::size_t>(is_square ? x / 2 : x), is_square ? '.' : ' ');
            row += 'o';
        }
        text += row;
    }
    return text;
}

glm::dvec2 lattice_ray(DotLattice lattice, std::uint32_t side) {
    constexpr double half = 0.5, high = std::numbers::sqrt3 / 2;
    static constexpr glm::dvec2 six[] = {{1, 0}, {half, high}, {-half, high}, {-1, 0}, {-half, -high}, {half, -high}};
    static constexpr glm::dvec2 four[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return lattice == DotLattice::square ? four[side % 4] : six[side % 6];
}

glm::dvec2 lattice_point(DotLattice lattice, GridDot place) {
    const double rows = lattice == DotLattice::square ? 0.5 : std::numbers::sqrt3 / 4;
    return {0.5 * place.x, rows * place.y};
}

glm::dvec2 dot_place(const DotGrid& grid, std::uint32_t dot) {
    return lattice_point(grid.lattice(), grid.dots()[dot]);
}

glm::dvec2 centre_of(const DotGrid& grid) {
    glm::dvec2 sum(0.0);
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) sum += dot_place(grid, dot);
    return sum / static_cast<double>(grid.dots().size());
}

}  // namespace sikku
