// studio/bridge_grid.cpp: kolams on grids of dots, for the kolam bench.
#include "art/kolam/dot_grid.h"
#include "art/kolam/dot_grid_pattern.h"
#include "engine/base/text.h"
#include "studio/bridge_answers.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

constexpr std::size_t most_dots = 10'000;  // on the kolam bench

/// The lines as points: the midpoints of the sides of dots that they cross.
Json strands(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor) {
    Json all = Json::array();
    for (const ArcStep& start : line_starts(grid, crossings, monitor)) {
        Json points = Json::array();
        ArcStep step = start;
        do {
            static constexpr std::array<GridDot, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
            const GridDot dot = grid.dots()[step.dot];
            const GridDot side = sides[step.entry()];
            points.push_back({dot.x + side.x, dot.y + side.y});
            step = next_step(grid, crossings, step);
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
    if (request.contains("seed")) random.seed = whole_of(request["seed"], "seed");

    const std::string given = text_of(request, "crossings", "");
    Crossings crossings = given.empty() ? random_crossings(grid, random) : parse_crossings(grid, given);
    Json answer = Json::object();
    std::size_t changed = 0;
    if (flag_of(request, "single_line")) {
        const auto obstacle = single_line_obstacle(grid, random.symmetry);
        if (obstacle) answer["obstacle"] = *obstacle;
        if (!obstacle && random.symmetry == GridSymmetry::none) {
            changed = make_single_line(grid, crossings, random.seed, monitor);
        } else if (!obstacle) {
            constexpr int attempts = 300;
            auto found = find_single_line(grid, random, attempts, monitor);
            if (found) {
                crossings = std::move(found->crossings);
                changed = found->changed;
            } else {
                answer["obstacle"] = fmt::format("no single line with the symmetry {} was found in {} attempts",
                                                 grid_symmetry_name(random.symmetry), attempts);
            }
        }
    }
    const std::size_t lines = count_lines(grid, crossings, monitor);
    const auto crossed = std::count(crossings.begin(), crossings.end(), 1);
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
        gaps.push_back({{"from", gap.from}, {"to", gap.to}, {"is_crossed", crossings[i] != 0}, {"orbit", orbits[i]}});
    }
    answer["text"] = kolam_pattern(grid, crossings, options).text;
    answer["rows"] = grid.rows();
    answer["dots"] = std::move(dots);
    answer["gaps"] = std::move(gaps);
    answer["crossings"] = crossings_text(grid, crossings);
    answer["lines"] = lines;
    answer["changed"] = changed;
    answer["strands"] = strands(grid, crossings, monitor);
    return answer;
}

}  // namespace sikku
