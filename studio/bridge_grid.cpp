// studio/bridge_grid.cpp: kolams on grids of dots, for the kolam bench.
#include "art/kolam/dot_grid_making.h"
#include "art/kolam/dot_grid_pattern.h"
#include "engine/base/text.h"
#include "studio/bridge_answers.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

constexpr std::size_t most_dots = 10'000;  // on the kolam bench

/// The lines as points: the midpoints of the sides of dots that they pass, in the units of GridDot.
Json strands(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    Json all = Json::array();
    for (const ArcStep& start : line_starts(grid, states, monitor)) {
        Json points = Json::array();
        ArcStep step = start;
        do {
            const GridDot dot = grid.dots()[step.dot];
            const GridDot way = grid.step(entry(grid, step));
            points.push_back({dot.x + way.x / 2.0, dot.y + way.y / 2.0});
            step = next_step(grid, states, step);
        } while (!(step == start));
        all.push_back(std::move(points));
    }
    return all;
}

}  // namespace

Json answer_grid(const Json& request, const Monitor& monitor) {
    const DotGrid grid = parse_dot_grid(text_of(request, "grid"));
    if (grid.dots().size() > most_dots) throw BadRequest(fmt::format("a grid has at most {} dots", most_dots));
    RandomKolam random;
    random.symmetry = parse_grid_symmetry(text_of(request, "symmetry", "none"));
    require_symmetry(grid, random.symmetry);
    random.density = number_of(request, "density", random.density);
    random.joined = number_of(request, "joined", random.joined);
    random.connects = flag_of(request, "connects");
    if (request.contains("seed")) random.seed = whole_of(request["seed"], "seed");

    const std::string given = text_of(request, "crossings", "");
    GapStates states = given.empty() ? random_states(grid, random) : parse_gap_states(grid, given);
    Json answer = Json::object();
    std::size_t changed = 0;
    if (flag_of(request, "single_line")) {
        const auto obstacle = single_line_obstacle(grid, random.symmetry, random.joined > 0);
        if (obstacle) answer["obstacle"] = *obstacle;
        if (!obstacle && random.symmetry == GridSymmetry::none) {
            changed = make_single_line(grid, states, random.seed, monitor);
        } else if (!obstacle) {
            constexpr int attempts = 300;
            auto found = find_single_line(grid, random, attempts, monitor);
            if (found) {
                states = std::move(found->states);
                changed = found->changed;
            } else {
                answer["obstacle"] = fmt::format("no single line with the symmetry {} was found in {} attempts",
                                                 grid_symmetry_name(random.symmetry), attempts);
            }
        }
    }
    const std::size_t lines = count_lines(grid, states, monitor);
    const auto crossed = std::count(states.begin(), states.end(), GapState::crossed);
    KolamPatternOptions options;
    options.title = text_of(request, "title", fmt::format("Kolam on {} dots", grid.text()));
    options.description = fmt::format("{}, {} of {} gaps crossed, {}", counted(grid.dots().size(), "dot"), crossed,
                                      grid.gaps().size(), counted(lines, "line"));
    options.coloured = flag_of(request, "coloured");
    options.monitor = monitor;

    Json dots = Json::array();
    for (const GridDot& dot : grid.dots()) dots.push_back({dot.x, dot.y});
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, random.symmetry);
    Json gaps = Json::array();
    for (std::size_t i = 0; i < grid.gaps().size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        gaps.push_back(
            {{"from", gap.from}, {"to", gap.to}, {"state", static_cast<int>(states[i])}, {"orbit", orbits[i]}});
    }
    answer["text"] = kolam_pattern(grid, states, options).text;
    answer["grid"] = grid.text();
    answer["lattice"] = grid.lattice() == DotLattice::square ? "square" : "triangular";
    answer["rows"] = grid.rows();
    answer["dots"] = std::move(dots);
    answer["gaps"] = std::move(gaps);
    answer["crossings"] = gap_states_text(grid, states);
    answer["lines"] = lines;
    answer["changed"] = changed;
    answer["strands"] = strands(grid, states, monitor);
    return answer;
}

}  // namespace sikku
