#include "art/kolam/grid_kolam.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

RandomKolam random_of(const GridKolamOptions& options) {
    RandomKolam random{.seed = options.seed, .joined = options.joined, .connects = !options.density};
    random.density = options.density.value_or(random.density);
    return random;
}

GridKolam make_single(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor) {
    RandomKolam random = random_of(options);
    const std::vector<GridSymmetry> symmetries =
        options.symmetry ? std::vector{*options.symmetry} : usual_symmetries(grid, true);
    // Large grids seldom have a symmetric line that can be found; all symmetries together take at most seconds.
    std::uint64_t steps = 100'000'000;
    for (const GridSymmetry symmetry : symmetries) {
        random.symmetry = symmetry;
        if (const auto obstacle = single_line_obstacle(grid, symmetry, random.joined > 0)) {
            throw std::runtime_error(*obstacle);
        }
        // If no symmetry is requested, the next one is tried sooner.
        const int attempts = options.symmetry ? options.attempts : std::min(options.attempts, 100);
        auto found = find_single_line(grid, random, attempts, monitor, options.symmetry ? nullptr : &steps);
        if (found) {
            return {.states = std::move(found->states),
                    .symmetry = symmetry,
                    .changed = found->changed,
                    .attempt = found->attempt};
        }
    }
    throw std::runtime_error(
        fmt::format("no single line with the symmetry {} was found in {}; try another 'seed' or 'density', or more "
                    "'attempts'",
                    grid_symmetry_name(random.symmetry), counted(options.attempts, "attempt")));
}

GridKolam choose_gaps(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor) {
    if (options.gaps) {
        GridKolam kolam{.states = *options.gaps};
        if (!options.single_line) return kolam;
        if (const auto obstacle = single_line_obstacle(grid, GridSymmetry::none)) throw std::runtime_error(*obstacle);
        kolam.changed = make_single_line(grid, kolam.states, options.seed, monitor);
        return kolam;
    }
    if (options.single_line) return make_single(grid, options, monitor);
    RandomKolam random = random_of(options);
    random.symmetry = options.symmetry.value_or(usual_symmetries(grid, false).front());
    return {.states = random_states(grid, random), .symmetry = random.symmetry};
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
    GridKolam kolam = choose_gaps(grid, options, monitor);
    kolam.lines = count_lines(grid, kolam.states, monitor);
    kolam.nullity = second_count(grid, kolam.states, monitor);
    if (kolam.nullity && *kolam.nullity != kolam.lines) {
        throw std::logic_error(
            fmt::format("{} by following them, but {} by the Laplacian", kolam.lines, *kolam.nullity));
    }
    return kolam;
}

std::optional<std::uint64_t> same_seed(const DotGrid& grid, const GridKolamOptions& options, const GridKolam& kolam,
                                       const Monitor& monitor) {
    constexpr std::uint64_t most_seeds = 100;
    constexpr std::size_t most_gaps = 1000;
    constexpr int most_attempts = 20;
    if (options.gaps || options.seed > most_seeds || grid.gaps().size() > most_gaps) return std::nullopt;
    const GapStates canonical = canonical_states(grid, kolam.states);
    RandomKolam random = random_of(options);
    random.symmetry = kolam.symmetry;
    std::uint64_t steps = 5'000'000;
    for (random.seed = 0; random.seed < options.seed; ++random.seed) {
        GapStates states;
        if (options.single_line) {
            auto found = find_single_line(grid, random, most_attempts, monitor, &steps);
            if (!found) continue;
            states = std::move(found->states);
        } else {
            states = random_states(grid, random);
        }
        if (canonical_states(grid, states) == canonical) return random.seed;
    }
    return std::nullopt;
}

KolamPatternOptions describe_grid_kolam(const DotGrid& grid, const GridKolamOptions& options,
                                        const GridKolam& kolam) {
    // A shape is too long to name.
    const std::string dots = counted(grid.dots().size(), "dot");
    KolamPatternOptions pattern;
    pattern.title = fmt::format("Kolam on {}", grid.is_solid() ? printable(grid.text(), 80) + " dots" : dots);
    pattern.description = fmt::format("{}, {}, {}", dots, summary_of(kolam.states), counted(kolam.lines, "line"));
    if (options.gaps) return pattern;
    pattern.description +=
        fmt::format("; seed {}, density {}", options.seed, options.density.value_or(RandomKolam().density));
    if (options.joined > 0) pattern.description += fmt::format(", joined {}", options.joined);
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
