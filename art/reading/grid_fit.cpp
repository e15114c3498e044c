#include "art/reading/grid_fit.h"

#include "art/reading/lattice_steps.h"

#include <algorithm>
#include <map>

namespace sikku {
namespace {

/// Fits that are compared by the lines around their dots.
constexpr std::size_t most_fits = 4;

/// Shifts that move many turned dots onto dots of the grid found, those that move most of them first.
std::vector<LatticeSteps> best_shifts(const std::vector<LatticeSteps>& turned,
                                      const std::vector<LatticeSteps>& found) {
    constexpr std::size_t most_samples = 64;
    const std::size_t stride = std::max<std::size_t>(1, found.size() / most_samples);
    std::map<LatticeSteps, std::size_t> votes;
    for (std::size_t i = 0; i < found.size(); i += stride) {
        for (const LatticeSteps& from : turned) {
            ++votes[{found[i].first - from.first, found[i].second - from.second}];
        }
    }
    std::vector<std::pair<LatticeSteps, std::size_t>> order(votes.begin(), votes.end());
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    order.resize(std::min(order.size(), 2 * most_fits));
    std::vector<LatticeSteps> shifts;
    for (const auto& [shift, count] : order) shifts.push_back(shift);
    return shifts;
}

GridFit fit_at(const std::vector<LatticeSteps>& turned, const LatticeSteps& shift, const StepFrame& frame,
               const DotGrid& found) {
    GridFit fit;
    for (const LatticeSteps& from : turned) {
        const GridDot place = frame.place({from.first + shift.first, from.second + shift.second});
        fit.places.push_back(place);
        fit.agreed += found.dot_at(place).has_value();
    }
    std::sort(fit.places.begin(), fit.places.end());
    fit.surplus = found.dots().size() - fit.agreed;
    return fit;
}

}  // namespace

bool GridFit::is_plausible() const {
    return 2 * agreed >= places.size() && surplus <= std::max<std::size_t>(2, places.size() / 10);
}

std::vector<GridFit> fit_grid(const DotGrid& wanted, const DotGrid& found) {
    if (wanted.lattice() != found.lattice()) return {};
    // Too few or too many dots for any plausible fit.
    GridFit limit{wanted.dots(), std::min(wanted.dots().size(), found.dots().size()), 0};
    limit.surplus = found.dots().size() - limit.agreed;
    if (!limit.is_plausible()) return {};
    const StepFrame from(wanted.lattice(), wanted.dots().front());
    const StepFrame to(found.lattice(), found.dots().front());
    std::vector<LatticeSteps> dots;
    for (const GridDot dot : found.dots()) dots.push_back(to.steps(dot));
    std::vector<GridFit> fits;
    for (const LatticeTurn& turn : rotations_of(wanted.lattice())) {
        std::vector<LatticeSteps> turned;
        for (const GridDot dot : wanted.dots()) turned.push_back(turn(from.steps(dot)));
        for (const LatticeSteps& shift : best_shifts(turned, dots)) fits.push_back(fit_at(turned, shift, to, found));
    }
    // Symmetric grids fit alike in several rotations.
    const auto changes = [](const GridFit& fit) { return fit.lost() + fit.surplus; };
    std::stable_sort(fits.begin(), fits.end(),
                     [&](const GridFit& a, const GridFit& b) { return changes(a) < changes(b); });
    std::vector<GridFit> best;
    for (GridFit& fit : fits) {
        if (best.size() == most_fits) break;
        const bool is_new =
            std::none_of(best.begin(), best.end(), [&](const GridFit& other) { return other.places == fit.places; });
        if (is_new) best.push_back(std::move(fit));
    }
    return best;
}

}  // namespace sikku
