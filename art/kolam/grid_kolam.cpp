#include "art/kolam/grid_kolam.h"

#include "art/kolam/dot_rectangle.h"
#include "art/kolam/interlaced_states.h"
#include "engine/base/chance.h"
#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// A random kolam, with symmetry and density from the options or else chosen by the seed.
struct Choice {
    RandomKolam random;
    std::vector<GridSymmetry> symmetries;  ///< in the order in which they are tried
};

/// True if there are so many dots that only the largest symmetry shows a figure.
bool is_large(const DotGrid& grid) {
    constexpr std::size_t fewest_aligned_dots = 80;
    return grid.lattice() == DotLattice::square ? grid.dots().size() >= fewest_aligned_dots : is_framed(grid);
}

Choice choice_of(const DotGrid& grid, const GridKolamOptions& options, std::uint64_t seed) {
    Choice choice{{.seed = seed, .joined = options.joined, .period = options.period, .composed = !options.density},
                  {}};
    SplitMix chance(scrambled(seed));
    choice.random.density = options.density.value_or(choice.random.density + 0.2 * (chance.fraction() - 0.5));
    if (options.symmetry) {
        choice.symmetries = {*options.symmetry};
        return choice;
    }
    choice.symmetries = usual_symmetries(grid, options.single_line);
    // Three of four kolams have the largest symmetry, and all large ones, where another hides the figure. Kolams
    // without half turns and with few images of a motif look accidental, and are made only where no others can be
    // had.
    const GridSymmetry largest = choice.symmetries.front();
    const auto end =
        std::stable_partition(choice.symmetries.begin(), choice.symmetries.end(), [&](GridSymmetry other) {
            return other == largest ||
                   (grid_symmetry_order(other) >= 4 && has_half_turn(other) == has_half_turn(largest));
        });
    const auto large = static_cast<std::size_t>(end - choice.symmetries.begin());
    if (large > 1 && !is_large(grid) && chance.below(4) == 0) {
        const auto chosen = choice.symmetries.begin() + static_cast<std::ptrdiff_t>(1 + chance.below(large - 1));
        std::rotate(choice.symmetries.begin(), chosen, chosen + 1);
    }
    return choice;
}

/// Names the nearest rectangles on which a single line can have the symmetry, if the grid is one.
std::string possible_sizes(const DotGrid& grid, GridSymmetry symmetry, bool joined) {
    const auto rectangle = rectangle_of(grid);
    if (!rectangle) return "";
    const std::vector<DotRectangle> others = nearest_rectangles(*rectangle, [&](const DotGrid& other) {
        return has_symmetry(other, symmetry) && !single_line_obstacle(other, symmetry, joined);
    });
    if (others.empty()) return "";
    return fmt::format("; possible on {}{}", name_of(others.front()),
                       others.size() > 1 ? " and " + name_of(others.back()) : "");
}

/// Steps along lines and attempts for single lines.
struct Effort {
    int attempts;
    std::uint64_t steps;
};

std::optional<GridKolam> make_single(const DotGrid& grid, const Choice& choice, Effort& effort,
                                     const Monitor& monitor) {
    RandomKolam random = choice.random;
    for (const GridSymmetry symmetry : choice.symmetries) {
        random.symmetry = symmetry;
        if (const auto obstacle = single_line_obstacle(grid, symmetry, random.joined > 0)) {
            throw std::runtime_error(*obstacle + possible_sizes(grid, symmetry, random.joined > 0));
        }
        // If no symmetry is requested, the next one is tried sooner.
        const int attempts = choice.symmetries.size() == 1 ? effort.attempts : std::min(effort.attempts, 100);
        auto found = find_single_line(grid, random, attempts, monitor, &effort.steps);
        if (found) {
            return GridKolam{.states = std::move(found->states),
                             .symmetry = symmetry,
                             .changed = found->changed,
                             .attempt = found->attempt};
        }
    }
    return std::nullopt;
}

std::optional<GridKolam> make_by_chance(const DotGrid& grid, const GridKolamOptions& options, std::uint64_t seed,
                                        Effort& effort, const Monitor& monitor) {
    Choice choice = choice_of(grid, options, seed);
    if (options.single_line) return make_single(grid, choice, effort, monitor);
    choice.random.symmetry = choice.symmetries.front();
    return GridKolam{.states = random_states(grid, choice.random), .symmetry = choice.random.symmetry};
}

/// The number of seeds, from 0 on, of which each is to give another kolam: as many as take a fraction of a second.
std::uint64_t different_seeds(const DotGrid& grid, const GridKolamOptions& options, const GridKolam& kolam) {
    constexpr std::size_t most_gaps = 150, most_framed_gaps = 350;
    if (grid.gaps().size() <= most_gaps) return 101;
    const bool is_framed =
        grid.lattice() == DotLattice::triangular && is_large(grid) && !options.density && !options.single_line;
    const bool is_soon_made = grid.gaps().size() <= most_framed_gaps && grid_symmetry_order(kolam.symmetry) >= 4;
    return is_framed && is_soon_made ? 31 : 0;
}

/// Replaces a kolam that an earlier seed gives by another, as long as one is found soon: small grids have few.
void replace_known(const DotGrid& grid, const GridKolamOptions& options, GridKolam& kolam, const Monitor& monitor) {
    constexpr std::uint64_t most_attempts = 200;
    if (options.seed >= different_seeds(grid, options, kolam)) return;
    Effort effort{20, 20'000'000};
    std::map<GapStates, std::uint64_t> seeds;  // of canonical states
    const auto find_new = [&](std::uint64_t seed) -> std::optional<GridKolam> {
        for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
            monitor.check();
            GridKolamOptions other = options;
            // There may be few symmetric ones.
            if (!other.symmetry && 2 * attempt >= most_attempts) other.symmetry = GridSymmetry::none;
            auto made = make_by_chance(grid, other, seed + attempt * 0x9E3779B97F4A7C15U, effort, monitor);
            if (made && seeds.emplace(canonical_states(grid, made->states), seed).second) return made;
        }
        return std::nullopt;
    };
    // Where one seed finds nothing new, the others take what chance gives.
    bool are_more = true;
    for (std::uint64_t seed = 0; seed < options.seed && are_more; ++seed) are_more = find_new(seed).has_value();
    const auto known = seeds.find(canonical_states(grid, kolam.states));
    if (known == seeds.end()) return;
    const std::uint64_t same = known->second;
    if (auto other = are_more ? find_new(options.seed) : std::nullopt) {
        kolam = std::move(*other);
    } else {
        kolam.same_seed = same;
        kolam.different = seeds.size();
    }
}

GridKolam make_by_seed(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor) {
    // Large grids seldom have a symmetric line that can be found; all symmetries together take at most seconds.
    Effort effort{options.attempts, options.symmetry ? 3'000'000'000U : 100'000'000U};
    auto made = make_by_chance(grid, options, options.seed, effort, monitor);
    if (!made) {
        const std::string period =
            options.period > 0 ? fmt::format(" and a period of {}", counted(options.period, "column")) : "";
        throw std::runtime_error(
            fmt::format("no single line with the symmetry {}{} was found in {}; try another 'seed' or 'density', or "
                        "more 'attempts'",
                        grid_symmetry_name(options.symmetry.value_or(GridSymmetry::none)), period,
                        counted(options.attempts, "attempt")));
    }
    replace_known(grid, options, *made, monitor);
    return std::move(*made);
}

/// Refuses periods that nothing repeats.
void check_period(const DotGrid& grid, std::uint32_t period) {
    const auto [first, last] =
        std::minmax_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.x < b.x; });
    const std::uint32_t columns = static_cast<std::uint32_t>(last->x - first->x) / 2 + 1;
    if (period < columns) return;
    throw std::runtime_error(
        fmt::format("a period of {} on {}, which has {}: nothing repeats; expected fewer than {}",
                    counted(period, "column"), grid.name(), counted(columns, "column"), columns));
}

GridKolam choose_gaps(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor) {
    if (!options.gaps) return make_by_seed(grid, options, monitor);
    GridKolam kolam{.states = *options.gaps};
    if (!options.single_line) return kolam;
    if (const auto obstacle = single_line_obstacle(grid, GridSymmetry::none)) throw std::runtime_error(*obstacle);
    kolam.changed = make_single_line(grid, kolam.states, options.seed, monitor);
    return kolam;
}

/// The second count, if it takes seconds at most.
std::optional<std::size_t> second_count(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    const std::vector<std::uint32_t> rows = grid.rows();
    const std::size_t longest = *std::max_element(rows.begin(), rows.end());
    const bool has_joined = std::find(states.begin(), states.end(), GapState::joined) != states.end();
    const auto dots = static_cast<double>(grid.dots().size());
    const double width = has_joined ? dots : static_cast<double>(std::min(rows.size(), longest));
    if (dots * width * width > 1e12) return std::nullopt;
    return laplacian_nullity(grid, states, monitor);
}

}  // namespace

GridKolam make_grid_kolam(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor) {
    if (options.period > 0) check_period(grid, options.period);
    GridKolam kolam = choose_gaps(grid, options, monitor);
    kolam.lines = count_lines(grid, kolam.states, monitor);
    kolam.nullity = second_count(grid, kolam.states, monitor);
    if (kolam.nullity && *kolam.nullity != kolam.lines) {
        throw std::logic_error(
            fmt::format("{} by following them, but {} by the Laplacian", kolam.lines, *kolam.nullity));
    }
    return kolam;
}

KolamPatternOptions describe_grid_kolam(const DotGrid& grid, const GridKolamOptions& options,
                                        const GridKolam& kolam) {
    // A shape is too long to name.
    const std::string dots = counted(grid.dots().size(), "dot");
    KolamPatternOptions pattern;
    pattern.title = fmt::format("Kolam on {}", grid.is_solid() ? printable(grid.text(), 80) + " dots" : dots);
    pattern.description = fmt::format("{}, {}, {}", dots, summary_of(kolam.states), counted(kolam.lines, "line"));
    if (options.gaps) return pattern;
    pattern.description += fmt::format("; seed {}", options.seed);
    if (options.density) pattern.description += fmt::format(", density {}", *options.density);
    if (options.joined > 0) pattern.description += fmt::format(", joined {}", options.joined);
    if (options.period > 0) pattern.description += fmt::format(", period {}", counted(options.period, "column"));
    if (kolam.symmetry != GridSymmetry::none) {
        pattern.description += fmt::format(", symmetry {}", grid_symmetry_name(kolam.symmetry));
    }
    return pattern;
}

std::string grid_kolam_json(const DotGrid& grid, const GridKolam& kolam) {
    const auto count = [&](GapState state) { return std::count(kolam.states.begin(), kolam.states.end(), state); };
    return JsonText::object("grid", grid.text(), "dots", grid.dots().size(), "gaps", grid.gaps().size(), "crossed",
                            count(GapState::crossed), "joined", count(GapState::joined), "lines", kolam.lines,
                            "laplacian_nullity", kolam.nullity, "symmetry", grid_symmetry_name(kolam.symmetry),
                            "code", kolam_code(grid, kolam.states), "changed", kolam.changed, "attempt",
                            kolam.attempt, "crossings", gap_states_text(grid, kolam.states))
        .line();
}

}  // namespace sikku
