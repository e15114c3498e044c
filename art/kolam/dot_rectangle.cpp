#include "art/kolam/dot_rectangle.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

/// How many dots fewer a row has than the first one.
std::uint32_t shorter(const DotRectangle& rectangle, std::uint32_t row) {
    return rectangle.lattice == DotLattice::triangular ? row % 2 : 0;
}

DotRectangle resized(DotRectangle rectangle, std::int64_t rows, std::int64_t columns) {
    const auto sum = [](std::uint32_t side, std::int64_t more) {
        return static_cast<std::uint32_t>(std::max<std::int64_t>(0, side + more));
    };
    rectangle.rows = sum(rectangle.rows, rows);
    rectangle.columns = sum(rectangle.columns, columns);
    return rectangle;
}

}  // namespace

bool is_possible(const DotRectangle& rectangle) {
    const std::uint32_t least = 1 + (rectangle.rows > 1 ? shorter(rectangle, 1) : 0);
    return rectangle.rows > 0 && rectangle.columns >= least &&
           std::uint64_t{rectangle.rows} * rectangle.columns <= DotGrid::most_dots;
}

DotGrid dot_grid(const DotRectangle& rectangle) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < rectangle.rows; ++row)
        rows.push_back(rectangle.columns - shorter(rectangle, row));
    return DotGrid(std::move(rows));
}

std::string name_of(const DotRectangle& rectangle) {
    const auto [lattice, rows, columns] = rectangle;
    if (lattice == DotLattice::square) return fmt::format("{}x{}", rows, columns);
    if (rows <= columns) return fmt::format("{}x{} idukku", rows, columns);
    return fmt::format("{} interlaced rows of {} and {} dots", rows, columns, columns - 1);
}

std::optional<DotRectangle> rectangle_of(const DotGrid& grid) {
    const std::vector<std::uint32_t> rows = grid.rows();
    const DotRectangle rectangle{grid.lattice(), static_cast<std::uint32_t>(rows.size()), rows[0]};
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        if (rows[row] != rectangle.columns - shorter(rectangle, row)) return std::nullopt;
    }
    if (!grid.is_solid()) return std::nullopt;
    return rectangle;
}

std::vector<DotRectangle> nearest_rectangles(const DotRectangle& rectangle,
                                             const std::function<bool(const DotGrid&)>& is_good) {
    constexpr std::int64_t farthest = 4;
    std::vector<DotRectangle> found;
    for (const std::int64_t rows : {0, 1}) {
        for (std::int64_t more = 1; more <= farthest && found.size() < 2; ++more) {
            for (const std::int64_t columns : {-more, more}) {
                const DotRectangle other = resized(rectangle, rows * columns, columns);
                if (found.size() < 2 && is_possible(other) && is_good(dot_grid(other))) found.push_back(other);
            }
        }
        if (!found.empty()) break;
    }
    return found;
}

}  // namespace sikku
