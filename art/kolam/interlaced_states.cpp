#include "art/kolam/interlaced_states.h"

#include "art/kolam/interlaced_frame.h"
#include "engine/base/chance.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Some dots of a grid, as a grid of their own.
class Middle {
public:
    /// @param dots  at least one, ascending
    Middle(const DotGrid& grid, std::vector<std::uint32_t> dots)
        : outer_(grid), inner_(DotLattice::triangular, columns(grid, dots)), dots_(std::move(dots)) {}
    const DotGrid& grid() const { return inner_; }
    const std::vector<std::uint32_t>& dots() const { return dots_; }
    /// Copies states of its gaps to the grid that it is the middle of.
    void copy(const GapStates& from, GapStates& to) const {
        for (std::size_t i = 0; i < from.size(); ++i) {
            const GridGap& gap = inner_.gaps()[i];
            to[static_cast<std::size_t>(outer_.gap(dots_[gap.from], gap.side))] = from[i];
        }
    }

private:
    static std::vector<std::vector<std::int32_t>> columns(const DotGrid& grid,
                                                          const std::vector<std::uint32_t>& dots) {
        const std::int32_t top = grid.dots().front().y;
        std::vector<std::vector<std::int32_t>> columns(
            static_cast<std::size_t>((top - grid.dots().back().y) / 2 + 1));
        for (const std::uint32_t dot : dots) {
            const GridDot place = grid.dots()[dot];
            columns[static_cast<std::size_t>((top - place.y) / 2)].push_back(place.x);
        }
        return columns;
    }

    const DotGrid& outer_;
    DotGrid inner_;
    std::vector<std::uint32_t> dots_;  // of the outer grid, in the order of the inner one
};

/// Chooses how many layers frame a middle of about the size that is composed well.
std::uint32_t random_width(const std::vector<std::uint32_t>& layers, SplitMix& chance) {
    constexpr std::size_t fewest = 19, most = 61;  // as many dots as 5-3 and 9-5
    constexpr std::size_t most_share = 6;          // of the dots; a smaller middle would drown in its frame
    struct WeightedWidth {
        std::uint32_t width;
        std::size_t weight;  ///< the larger a middle, the more kolams there are of it
    };
    std::vector<std::size_t> dots(*std::max_element(layers.begin(), layers.end()) + std::size_t{1});  // by layer
    for (const std::uint32_t layer : layers) ++dots[layer];
    std::vector<WeightedWidth> choices;
    std::uint32_t widest = 0;
    std::size_t within = layers.size(), sum = 0;
    for (std::uint32_t width = 0; width < dots.size() && within >= fewest; within -= dots[width++]) {
        widest = width;
        if (width == 0 || within > most || (!choices.empty() && most_share * within < layers.size())) continue;
        choices.push_back({width, within});
        sum += within;
    }
    if (choices.empty()) return widest;
    std::size_t left = chance.below(sum);
    std::size_t chosen = 0;
    while (left >= choices[chosen].weight) left -= choices[chosen++].weight;
    return choices[chosen].width;
}

/// The dot nearest to the centroid among those that the symmetry maps onto themselves.
std::optional<GridDot> fixed_dot(const DotGrid& grid, GridSymmetry symmetry) {
    const std::vector<std::uint32_t> orbits = dot_orbits(grid, symmetry);
    std::vector<std::uint32_t> sizes(orbits.size());
    for (const std::uint32_t orbit : orbits) ++sizes[orbit];
    const glm::dvec2 centre = centre_of(grid);
    std::optional<GridDot> found;
    double least = 0;
    for (std::uint32_t dot = 0; dot < orbits.size(); ++dot) {
        if (sizes[orbits[dot]] > 1) continue;
        const glm::dvec2 way = dot_place(grid, dot) - centre;
        const double square = way.x * way.x + way.y * way.y;
        if (found && square >= least) continue;
        found = grid.dots()[dot];
        least = square;
    }
    return found;
}

/// Steps from a dot to another.
std::size_t steps_between(GridDot from, GridDot to) {
    const std::int32_t rows = std::abs(to.y - from.y) / 2;
    return static_cast<std::size_t>(std::max(rows, (std::abs(to.x - from.x) + rows) / 2));
}

/// The dots of the largest hexagon of these dots in the middle of the grid, or all if that would leave many.
std::vector<std::uint32_t> hexagon_within(const DotGrid& grid, GridSymmetry symmetry,
                                          const std::vector<std::uint32_t>& dots) {
    constexpr std::size_t fewest = 19;  // as many as 5-3
    constexpr double least_share = 0.6;
    const std::optional<GridDot> centre = fixed_dot(grid, symmetry);
    if (!centre) return dots;
    std::vector<std::vector<std::uint32_t>> rings;  // by distance
    for (const std::uint32_t dot : dots) {
        const std::size_t ring = steps_between(*centre, grid.dots()[dot]);
        if (ring >= rings.size()) rings.resize(ring + 1);
        rings[ring].push_back(dot);
    }
    std::vector<std::uint32_t> hexagon;
    for (std::size_t i = 0; i < rings.size() && rings[i].size() == std::max<std::size_t>(1, 6 * i); ++i) {
        hexagon.insert(hexagon.end(), rings[i].begin(), rings[i].end());
    }
    const double share = static_cast<double>(hexagon.size()) / static_cast<double>(dots.size());
    if (hexagon.size() < fewest || share < least_share) return dots;
    std::sort(hexagon.begin(), hexagon.end());
    return hexagon;
}

/// The largest symmetry of a hexagon that has mirrors if this one has.
GridSymmetry of_hexagon(GridSymmetry symmetry) {
    switch (symmetry) {
        case GridSymmetry::none:
            return GridSymmetry::none;
        case GridSymmetry::c2:
        case GridSymmetry::c3:
        case GridSymmetry::c6:
            return GridSymmetry::c6;
        default:
            return GridSymmetry::d6;
    }
}

struct GapCount {
    double gaps = 0, crossed = 0;
    double share() const { return gaps > 0 ? crossed / gaps : 0; }
};

/// How clearly a ring along a layer stands out, from 0 to 1: its dots are linked to each other, and on one side not
/// to those of the next layer.
double clarity(const DotGrid& grid, const GapStates& states) {
    const std::vector<std::uint32_t> layers = dot_layers(grid);
    const std::size_t count = *std::max_element(layers.begin(), layers.end()) + std::size_t{1};
    std::vector<GapCount> along(count), across(count);  // by layer, and to the next one inwards
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::uint32_t from = layers[grid.gaps()[i].from], to = layers[grid.gaps()[i].to];
        GapCount& counted = from == to ? along[from] : across[std::min(from, to)];
        ++counted.gaps;
        counted.crossed += states[i] == GapState::crossed;
    }
    double clearest = 0;
    for (std::size_t layer = 0; layer + 2 < count; ++layer) {  // a ring around the centre is too small
        const double crossed = std::min(across[layer].share(), layer > 0 ? across[layer - 1].share() : 1.0);
        clearest = std::max(clearest, std::min(along[layer].share(), 1 - crossed));
    }
    return clearest;
}

/// Composes a small kolam with a ring that stands out, if one is found soon.
GapStates clear_states(const DotGrid& grid, GridSymmetry symmetry, SplitMix& chance) {
    constexpr std::size_t tries = 16;  // more would cost time and give fewer kolams
    constexpr int attempts = 4;
    constexpr double clear = 0.9;
    constexpr std::size_t fewest_dots = 40;  // smaller ones are clear by themselves
    GapStates best = composed_states(grid, symmetry, chance.next(), tries);
    if (grid.dots().size() < fewest_dots) return best;
    double most = clarity(grid, best);
    for (int attempt = 1; attempt < attempts && most < clear; ++attempt) {
        GapStates other = composed_states(grid, symmetry, chance.next(), tries);
        const double found = clarity(grid, other);
        if (found <= most) continue;
        most = found;
        best = std::move(other);
    }
    return best;
}

void cross_orbit(const std::vector<std::uint32_t>& orbits, std::uint32_t orbit, GapStates& states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (orbits[i] == orbit) states[i] = GapState::crossed;
    }
}

/// Links the dots beside a hexagon to each other, and by an orbit of gaps or none to the hexagon; those that
/// would be alone, always.
void link_beside(const DotGrid& grid, GridSymmetry symmetry, const std::vector<std::uint32_t>& beside,
                 const std::vector<std::uint32_t>& hexagon, SplitMix& chance, GapStates& states) {
    enum class Place : std::uint8_t { outside, between, inside };
    std::vector<Place> places(grid.dots().size(), Place::outside);
    for (const std::uint32_t dot : beside) places[dot] = Place::between;
    for (const std::uint32_t dot : hexagon) places[dot] = Place::inside;
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, symmetry);
    std::vector<std::uint32_t> found;  // orbits between the two
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto [outer, inner] = std::minmax(places[grid.gaps()[i].from], places[grid.gaps()[i].to]);
        if (outer != Place::between) continue;
        if (inner == Place::between) states[i] = GapState::crossed;
        if (inner == Place::inside) found.push_back(orbits[i]);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    const std::size_t chosen = chance.below(found.size() + 1);
    if (chosen < found.size()) cross_orbit(orbits, found[chosen], states);
    // Dots without neighbours among them would be rings beside the figure.
    for (std::uint32_t dot = 0; dot < places.size(); ++dot) {
        if (places[dot] != Place::between || !is_lonely(grid, dot, states)) continue;
        std::vector<std::uint32_t> own;  // its orbits
        for (std::size_t i = 0; i < states.size(); ++i) {
            const GridGap& gap = grid.gaps()[i];
            const std::uint32_t other = gap.from == dot ? gap.to : gap.to == dot ? gap.from : dot;
            if (other != dot && places[other] == Place::inside) own.push_back(orbits[i]);
        }
        if (!own.empty()) cross_orbit(orbits, own[chance.below(own.size())], states);
    }
}

/// Composes dots within a frame.
void compose_middle(const DotGrid& grid, GridSymmetry symmetry, const std::vector<std::uint32_t>& dots,
                    SplitMix& chance, GapStates& states) {
    const Middle middle(grid, hexagon_within(grid, symmetry, dots));
    const bool is_all = middle.dots().size() == dots.size();
    if (!is_all) link_beside(grid, symmetry, dots, middle.dots(), chance, states);
    middle.copy(clear_states(middle.grid(), is_all ? symmetry : of_hexagon(symmetry), chance), states);
}

}  // namespace

bool is_framed(const DotGrid& grid) {
    constexpr std::size_t fewest = 70, fewest_beside_hexagons = 44;
    const std::size_t dots = grid.dots().size();
    if (grid.lattice() != DotLattice::triangular || dots < fewest_beside_hexagons) return false;
    return dots >= fewest || !has_symmetry(grid, GridSymmetry::c3);
}

GapStates interlaced_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed, std::uint32_t period) {
    constexpr std::size_t tries = 1500;
    if (period > 0 || !is_framed(grid)) return composed_states(grid, symmetry, seed, tries, period);
    SplitMix chance(child_place(seed, grid.dots().size()));  // so that a seed gives other figures on other grids
    GapStates states(grid.gaps().size(), GapState::turned);
    const std::vector<std::uint32_t> layers = dot_layers(grid);
    const std::uint32_t width = random_width(layers, chance);
    if (width > 0) cross_frame(grid, symmetry, layers, width, chance, states);
    std::vector<std::uint32_t> within;
    for (std::uint32_t dot = 0; dot < layers.size(); ++dot) {
        if (layers[dot] >= width) within.push_back(dot);
    }
    compose_middle(grid, symmetry, within, chance, states);
    return states;
}

}  // namespace sikku
