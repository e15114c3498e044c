// tests/fuzz/grid_targets.h: fuzz targets that read arbitrary text as a grid of dots, the states of its gaps, and a
// radial kolam.
#pragma once

#include "art/kolam/dot_grid_making.h"
#include "art/kolam/radial_kolam.h"
#include "tests/fuzz/file_targets.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace sikku {
/// The text up to a NUL is a grid, what follows it are gaps.
inline void try_grid(std::string_view text) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    try {
        const DotGrid grid = parse_dot_grid(text.substr(0, end));
        must(parse_dot_grid(grid.text()).dots() == grid.dots(), "a grid does not come back");
        if (grid.dots().size() > 2000) return;
        const std::string_view gaps = end < text.size() ? text.substr(end + 1) : "all";
        const GapStates states = parse_gap_states(grid, gaps);
        must(parse_gap_states(grid, gap_states_text(grid, states)) == states, "gaps do not come back");
        must(count_lines(grid, states) == laplacian_nullity(grid, states), "two counts of lines differ");
        for (const GridSymmetry symmetry : usual_symmetries(grid, true)) {
            const auto found = find_single_line(grid, {.symmetry = symmetry}, 1);
            must(!found || count_lines(grid, found->states) == 1, "a single line is not single");
        }
    } catch (const std::runtime_error& error) {
        must_be_plain(error.what(), "an error");
    }
}

inline void try_radial(std::string_view text) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    try {
        const RadialKolam kolam =
            parse_radial_kolam(text.substr(0, end), end < text.size() ? text.substr(end + 1) : "");
        must(kolam.lines() >= 1 && kolam.lines() <= kolam.dots(), "a radial kolam has too many lines");
    } catch (const std::runtime_error& error) {
        must_be_plain(error.what(), "an error");
    }
}

}  // namespace sikku
