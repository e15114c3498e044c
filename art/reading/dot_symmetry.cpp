#include "art/reading/dot_symmetry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace sikku {
namespace {

/// A place in steps of the lattice: to the right, and up (square) or up to the right (triangular).
using Steps = std::pair<std::int32_t, std::int32_t>;

/// A linear map of steps.
struct Turn {
    std::array<std::int32_t, 4> m;
    Steps operator()(Steps s) const { return {m[0] * s.first + m[1] * s.second, m[2] * s.first + m[3] * s.second}; }
};

/// All rotations and mirrors of a lattice except the identity.
std::vector<Turn> turns_of(DotLattice lattice) {
    const bool is_square = lattice == DotLattice::square;
    const Turn rotation = is_square ? Turn{{0, -1, 1, 0}} : Turn{{0, -1, 1, 1}};
    const Turn mirror{{0, 1, 1, 0}};
    const auto after = [](const Turn& a, const Turn& b) {
        return Turn{{a.m[0] * b.m[0] + a.m[1] * b.m[2], a.m[0] * b.m[1] + a.m[1] * b.m[3],
                     a.m[2] * b.m[0] + a.m[3] * b.m[2], a.m[2] * b.m[1] + a.m[3] * b.m[3]}};
    };
    std::vector<Turn> turns;
    Turn turn{{1, 0, 0, 1}};
    for (int i = 0; i < (is_square ? 4 : 6); ++i) {
        if (i > 0) turns.push_back(turn);
        turns.push_back(after(turn, mirror));
        turn = after(rotation, turn);
    }
    return turns;
}

}  // namespace

std::vector<GridDot> places_by_symmetry(const DotGrid& grid) {
    const std::vector<GridDot>& dots = grid.dots();
    constexpr std::size_t least_dots = 8;
    if (dots.size() < least_dots) return {};
    const GridDot base = dots.front();
    const bool is_square = grid.lattice() == DotLattice::square;
    const auto steps = [&](GridDot dot) {
        const std::int32_t up = (dot.y - base.y) / 2;
        return Steps{(dot.x - base.x - (is_square ? 0 : up)) / 2, up};
    };
    const auto place = [&](Steps s) {
        return GridDot{base.x + 2 * s.first + (is_square ? 0 : s.second), base.y + 2 * s.second};
    };
    std::set<Steps> all;
    for (const GridDot dot : dots) all.insert(steps(dot));
    constexpr std::size_t most_samples = 64;
    const std::size_t stride = std::max<std::size_t>(1, dots.size() / most_samples);
    std::set<Steps> proposed;
    for (const Turn& turn : turns_of(grid.lattice())) {
        // The shift that maps most of the turned dots to dots.
        std::map<Steps, std::size_t> votes;
        for (std::size_t i = 0; i < dots.size(); i += stride) {
            const Steps turned = turn(steps(dots[i]));
            for (const Steps& to : all) ++votes[{to.first - turned.first, to.second - turned.second}];
        }
        const auto best = std::max_element(votes.begin(), votes.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        std::vector<Steps> missing;
        for (const Steps& from : all) {
            const Steps turned = turn(from);
            const Steps to{turned.first + best->first.first, turned.second + best->first.second};
            if (!all.contains(to)) missing.push_back(to);
        }
        if (missing.size() > std::max<std::size_t>(1, dots.size() / 12)) continue;
        proposed.insert(missing.begin(), missing.end());
    }
    std::vector<GridDot> places;
    for (const Steps& s : proposed) places.push_back(place(s));
    std::sort(places.begin(), places.end(), is_before);
    return places;
}

}  // namespace sikku
