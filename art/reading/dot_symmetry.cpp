#include "art/reading/dot_symmetry.h"

#include "art/reading/lattice_steps.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

namespace sikku {
std::vector<GridDot> places_by_symmetry(const DotGrid& grid) {
    const std::vector<GridDot>& dots = grid.dots();
    constexpr std::size_t least_dots = 8;
    if (dots.size() < least_dots) return {};
    const StepFrame frame(grid.lattice(), dots.front());
    std::set<LatticeSteps> all;
    for (const GridDot dot : dots) all.insert(frame.steps(dot));
    constexpr std::size_t most_samples = 64;
    const std::size_t stride = std::max<std::size_t>(1, dots.size() / most_samples);
    std::set<LatticeSteps> proposed;
    for (const LatticeTurn& turn : turns_of(grid.lattice())) {
        // The shift that maps most of the turned dots to dots.
        std::map<LatticeSteps, std::size_t> votes;
        for (std::size_t i = 0; i < dots.size(); i += stride) {
            const LatticeSteps turned = turn(frame.steps(dots[i]));
            for (const LatticeSteps& to : all) ++votes[{to.first - turned.first, to.second - turned.second}];
        }
        const auto best = std::max_element(votes.begin(), votes.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        std::vector<LatticeSteps> missing;
        for (const LatticeSteps& from : all) {
            const LatticeSteps turned = turn(from);
            const LatticeSteps to{turned.first + best->first.first, turned.second + best->first.second};
            if (!all.contains(to)) missing.push_back(to);
        }
        if (missing.size() > std::max<std::size_t>(1, dots.size() / 12)) continue;
        proposed.insert(missing.begin(), missing.end());
    }
    std::vector<GridDot> places;
    for (const LatticeSteps& s : proposed) places.push_back(frame.place(s));
    std::sort(places.begin(), places.end(), is_before);
    return places;
}

}  // namespace sikku
