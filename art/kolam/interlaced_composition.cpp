#include "art/kolam/interlaced_composition.h"

#include "engine/base/chance.h"
#include "engine/base/union_find.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

namespace sikku {
namespace {

constexpr std::uint32_t sides = 6;
constexpr std::uint32_t no_dot = UINT32_MAX;

/// Weights of the faults and merits of a composition, set by eye on hundreds of kolams.
struct Costs {
    double straight = 0.5;  ///< times the square of the crossings beyond four that a line runs straight through
    double parallel = 3;    ///< three parallel straight strands
    double ring = 0.6;      ///< a line around a single dot
    double many_rings = 3;  ///< each beyond one dot in fourteen
    double rim_ring = 2;    ///< at the rim
    double neighbouring_rings = 1;
    double piece = 2;             ///< each beyond the first
    double closed_rim = 0.7;      ///< a dot of the rim without a loop
    double open_triangle = 0.09;  ///< two gaps of three are crossed
    double star = -0.5;           ///< all six gaps of a dot are crossed
    double density = 6;           ///< for each gap, times the square of the difference from the share wanted
};
constexpr Costs costs;

/// Gaps whose states change together.
using Motif = std::vector<std::uint32_t>;

class Composition {
public:
    /// @param columns  above 0: motifs that repeat by this number of columns are one
    Composition(const DotGrid& grid, GridSymmetry symmetry, std::uint32_t columns)
        : grid_(grid),
          columns_(columns),
          crossings_(grid.gaps().size()),
          neighbours_(sides * grid.dots().size(), no_dot) {
        for (const GridGap& gap : grid.gaps()) {
            neighbours_[sides * gap.from + gap.side] = gap.to;
            neighbours_[sides * gap.to + (gap.side + sides / 2) % sides] = gap.from;
        }
        find_triangles();
        find_motifs(symmetry);
        find_courses();
        find_distances();
    }

    std::size_t triangle_motifs() const { return triangle_motifs_; }
    std::size_t motifs() const { return motifs_.size(); }
    void change(std::size_t motif) {
        is_chosen_[motif] ^= 1;
        for (const std::uint32_t gap : motifs_[motif]) crossings_[gap] += is_chosen_[motif] ? 1U : UINT32_MAX;
    }
    /// Shares of crossed gaps in rings of equal width, from the centre outwards.
    void aim_at(std::vector<double> densities) { wanted_ = std::move(densities); }

    double cost() {
        return cost_of_dots() + cost_of_triangles() + cost_of_courses() + cost_of_pieces() + cost_of_density();
    }
    GapStates states() const {
        GapStates states(crossings_.size());
        for (std::size_t i = 0; i < states.size(); ++i) {
            states[i] = crossings_[i] > 0 ? GapState::crossed : GapState::turned;
        }
        return states;
    }

private:
    bool is_crossed(std::int32_t gap) const { return gap >= 0 && crossings_[static_cast<std::size_t>(gap)] > 0; }
    std::uint32_t neighbour(std::uint32_t dot, std::uint32_t side) const {
        return neighbours_[sides * dot + side % sides];
    }

    void find_triangles() {
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            for (std::uint32_t side = 0; side < sides; ++side) {
                const std::uint32_t a = neighbour(dot, side), b = neighbour(dot, side + 1);
                if (a == no_dot || b == no_dot || dot > a || dot > b) continue;
                triangles_.push_back({static_cast<std::uint32_t>(grid_.gap(dot, side)),
                                      static_cast<std::uint32_t>(grid_.gap(dot, (side + 1) % sides)),
                                      static_cast<std::uint32_t>(grid_.gap(a, (side + 2) % sides))});
                corners_.push_back(grid_.dots()[dot] + grid_.dots()[a] + grid_.dots()[b]);
            }
        }
    }
    /// Orbits of triangles, then orbits of gaps.
    void find_motifs(GridSymmetry symmetry) {
        const std::vector<std::uint32_t> orbits = gap_orbits(grid_, symmetry);
        std::map<std::array<std::uint32_t, 3>, std::uint32_t> numbers;
        const auto sorted = [](std::array<std::uint32_t, 3> gaps) {
            std::sort(gaps.begin(), gaps.end());
            return gaps;
        };
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) numbers[sorted(triangles_[i])] = i;
        UnionFind images(triangles_.size());
        for (const std::vector<std::uint32_t>& image : grid_symmetries(grid_)) {
            bool is_one = true;  // of the symmetries wanted
            for (std::size_t i = 0; i < orbits.size() && is_one; ++i) is_one = orbits[image[i]] == orbits[i];
            if (!is_one) continue;
            for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
                std::array<std::uint32_t, 3> gaps = triangles_[i];
                for (std::uint32_t& gap : gaps) gap = image[gap];
                images.join(i, numbers.at(sorted(gaps)));
            }
        }
        if (columns_ > 0) join_columns(images);
        const std::vector<std::uint32_t> classes = images.set_numbers();
        for (std::size_t i = 0; i < classes.size(); ++i) {
            if (classes[i] == motifs_.size()) motifs_.emplace_back();
            motifs_[classes[i]].insert(motifs_[classes[i]].end(), triangles_[i].begin(), triangles_[i].end());
        }
        triangle_motifs_ = motifs_.size();
        const std::vector<std::uint32_t> repeated = columns_ > 0 ? gap_orbits(grid_, symmetry, columns_) : orbits;
        for (std::uint32_t i = 0; i < repeated.size(); ++i) {
            if (triangle_motifs_ + repeated[i] == motifs_.size()) motifs_.emplace_back();
            motifs_[triangle_motifs_ + repeated[i]].push_back(i);
        }
        is_chosen_.assign(motifs_.size(), 0);
    }
    void join_columns(UnionFind& images) {
        std::map<GridDot, std::uint32_t> at;
        for (std::uint32_t i = 0; i < corners_.size(); ++i) at[corners_[i]] = i;
        const GridDot step{6 * static_cast<std::int32_t>(columns_), 0};  // of three corners
        for (const auto& [sum, i] : at) {
            const auto found = at.find(sum + step);
            if (found != at.end()) images.join(i, found->second);
        }
    }
    /// The gaps that a line from rim to rim runs straight through where all are crossed.
    void find_courses() {
        const GapStates all(grid_.gaps().size(), GapState::crossed);
        std::vector<char> is_seen(sides * grid_.dots().size());
        for (std::uint32_t arc = 0; arc < is_seen.size(); ++arc) {
            for (const bool anticlockwise : {true, false}) {
                ArcStep step{arc / sides, arc % sides, anticlockwise};
                if (is_seen[arc] || grid_.gap(step.dot, entry(grid_, step)) >= 0) continue;
                while (true) {
                    is_seen[sides * step.dot + step.arc] = 1;
                    const std::int32_t gap = grid_.gap(step.dot, exit(grid_, step));
                    if (gap < 0) break;
                    courses_.push_back(gap);
                    step = next_step(grid_, all, step);
                }
                courses_.push_back(-1);
            }
        }
    }
    /// Distances of gaps from the centre, 0 to below 1.
    void find_distances() {
        const glm::dvec2 centre = centre_of(grid_);
        std::vector<double> squares;
        double most = 0.1;
        for (const GridGap& gap : grid_.gaps()) {
            const glm::dvec2 from = 0.5 * (dot_place(grid_, gap.from) + dot_place(grid_, gap.to)) - centre;
            squares.push_back(from.x * from.x + from.y * from.y);
            most = std::max(most, squares.back());
        }
        for (const double square : squares) distances_.push_back(std::sqrt(square / (most * 1.0001)));
    }

    double cost_of_dots() {
        const auto count = static_cast<std::uint32_t>(grid_.dots().size());
        crossed_sides_.assign(count, 0);
        for (std::uint32_t dot = 0; dot < count; ++dot) {
            for (std::uint32_t side = 0; side < sides; ++side) {
                if (is_crossed(grid_.gap(dot, side))) crossed_sides_[dot] |= 1U << side;
            }
        }
        double cost = 0;
        std::uint32_t rings = 0;
        for (std::uint32_t dot = 0; dot < count; ++dot) {
            std::uint32_t near = 0;
            for (std::uint32_t side = 0; side < sides; ++side) near += neighbour(dot, side) != no_dot;
            const std::uint32_t crossed = static_cast<std::uint32_t>(std::popcount(crossed_sides_[dot]));
            const bool is_rim = near < sides;
            if (crossed == 0) {
                ++rings;
                cost += costs.ring + (is_rim ? costs.rim_ring : 0);
                for (std::uint32_t side = 0; side < sides / 2; ++side) {
                    const std::uint32_t other = neighbour(dot, side);
                    if (other != no_dot && crossed_sides_[other] == 0) cost += costs.neighbouring_rings;
                }
            } else if (crossed == sides) {
                cost += costs.star;
            } else if (is_rim && near > 2 && crossed == near) {
                cost += costs.closed_rim;
            }
            cost += cost_of_parallels(dot);
        }
        return cost + costs.many_rings * std::max(0.0, rings - 0.07 * count);
    }
    /// Straight strands on both sides of a dot, parallel to a side.
    bool has_pair(std::uint32_t dot, std::uint32_t side) const {
        constexpr std::uint32_t pair = 0b110110;  // for side 0: sides 1, 2, 4, 5
        const std::uint32_t wanted = ((pair << side) | (pair >> (sides - side))) & 0b111111;
        return (crossed_sides_[dot] & wanted) == wanted;
    }
    double cost_of_parallels(std::uint32_t dot) const {
        double cost = 0;
        for (std::uint32_t side = 0; side < sides / 2; ++side) {
            if (!has_pair(dot, side)) continue;
            for (const std::uint32_t beside : {side + 1, side + 2}) {
                const std::uint32_t other = neighbour(dot, beside);
                if (other != no_dot && has_pair(other, side)) cost += costs.parallel;
            }
        }
        return cost;
    }
    double cost_of_triangles() const {
        double cost = 0;
        for (const std::array<std::uint32_t, 3>& gaps : triangles_) {
            int crossed = 0;
            for (const std::uint32_t gap : gaps) crossed += crossings_[gap] > 0;
            if (crossed == 2) cost += costs.open_triangle;
        }
        return cost;
    }
    double cost_of_courses() const {
        double cost = 0;
        int run = 0;
        for (const std::int32_t gap : courses_) {
            if (is_crossed(gap)) {
                ++run;
                continue;
            }
            if (run > 4) cost += costs.straight * (run - 4) * (run - 4);
            run = 0;
        }
        return cost;
    }
    double cost_of_pieces() const {
        UnionFind pieces(grid_.dots().size());
        for (std::size_t i = 0; i < crossings_.size(); ++i) {
            if (crossings_[i] > 0) pieces.join(grid_.gaps()[i].from, grid_.gaps()[i].to);
        }
        std::uint32_t count = 0;
        for (std::uint32_t dot = 0; dot < crossed_sides_.size(); ++dot) {
            count += crossed_sides_[dot] != 0 && pieces.find(dot) == dot;
        }
        return count > 1 ? costs.piece * (count - 1) : 0;
    }
    double cost_of_density() const {
        std::vector<std::pair<double, double>> rings(wanted_.size());  // gaps, crossed ones
        for (std::size_t i = 0; i < crossings_.size(); ++i) {
            auto& [gaps, crossed] =
                rings[static_cast<std::size_t>(distances_[i] * static_cast<double>(rings.size()))];
            ++gaps;
            crossed += crossings_[i] > 0;
        }
        double cost = 0;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const auto& [gaps, crossed] = rings[i];
            if (gaps == 0) continue;
            const double apart = crossed / gaps - wanted_[i];
            cost += costs.density * gaps * apart * apart;
        }
        return cost;
    }

    const DotGrid& grid_;
    std::uint32_t columns_;
    std::vector<std::uint32_t> crossings_;                 // by gap: chosen motifs that cross it
    std::vector<std::uint32_t> neighbours_;                // by dot and side
    std::vector<std::array<std::uint32_t, 3>> triangles_;  // their gaps
    std::vector<GridDot> corners_;                         // by triangle: the sum of its corners
    std::vector<Motif> motifs_;
    std::size_t triangle_motifs_ = 0;
    std::vector<char> is_chosen_;
    std::vector<std::int32_t> courses_;  // -1 after each
    std::vector<double> distances_;
    std::vector<double> wanted_;
    std::vector<std::uint32_t> crossed_sides_;  // by dot, as bits
};

/// Shares of crossed gaps for one to three rings around the centre.
std::vector<double> random_densities(std::size_t dots, SplitMix& chance) {
    std::vector<double> densities(1 + chance.below(dots < 30 ? 2 : 3));
    if (densities.size() == 1) return {0.38 + 0.2 * chance.fraction()};
    const double dense = 0.5 + 0.15 * chance.fraction(), sparse = 0.28 + 0.12 * chance.fraction();
    const std::size_t first = chance.below(2);
    for (std::size_t i = 0; i < densities.size(); ++i) densities[i] = i % 2 == first ? dense : sparse;
    return densities;
}

}  // namespace

GapStates composed_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed, std::size_t tries,
                          std::uint32_t period) {
    constexpr double begun_triangles = 0.28;  // share of those chosen at first
    constexpr std::size_t most_proposals = 1500;
    SplitMix chance(seed);
    Composition composition(grid, symmetry, period);
    composition.aim_at(random_densities(grid.dots().size(), chance));
    for (std::size_t i = 0; i < composition.triangle_motifs(); ++i) {
        if (chance.fraction() < begun_triangles) composition.change(i);
    }
    if (composition.motifs() == 0) return composition.states();
    double cost = composition.cost();
    const std::size_t proposals =
        std::min({most_proposals, tries * composition.motifs(), most_composed_dots / grid.dots().size()});
    std::array<std::size_t, 2> changes;
    for (std::size_t i = 0; i < proposals; ++i) {
        const double kind = chance.fraction();
        const bool is_gap = kind < 0.15 || composition.triangle_motifs() == 0;
        const std::size_t first = is_gap ? composition.triangle_motifs() : 0;
        const std::size_t end = is_gap ? composition.motifs() : composition.triangle_motifs();
        const std::size_t count = !is_gap && kind < 0.3 ? 2 : 1;
        for (std::size_t k = 0; k < count; ++k) changes[k] = first + chance.below(end - first);
        for (std::size_t k = 0; k < count; ++k) composition.change(changes[k]);
        const double changed = composition.cost();
        if (changed <= cost) {
            cost = changed;
        } else {
            for (std::size_t k = 0; k < count; ++k) composition.change(changes[k]);
        }
    }
    return composition.states();
}

}  // namespace sikku
