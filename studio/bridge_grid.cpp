// studio/bridge_grid.cpp: grids of dots and the kolams on them, for the kolam bench.
#include "art/kolam/dot_grid_making.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/rounded_lines.h"
#include "engine/base/text.h"
#include "studio/bridge_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <span>

namespace sikku {
namespace {

/// @throws BadRequest if the pattern of a kolam on this grid would not list its gaps, so that the bench could not
/// read it
void require_readable(const DotGrid& grid) {
    if (grid.gaps().size() <= most_listed_gaps) return;
    throw BadRequest(
        fmt::format("this grid has {} dots and {} gaps between them; the bench takes up to {} gaps, as "
                    "22x22 or 21-11 idukku has",
                    grid.dots().size(), grid.gaps().size(), most_listed_gaps));
}

/// Places of the lattice: `[[x, y], …]`; none if the member is missing.
std::vector<GridDot> places_of(const Json& request, const std::string& name) {
    std::vector<GridDot> places;
    if (!request.contains(name)) return places;
    for (const Json& pair : request[name]) {
        if (!pair.is_array() || pair.size() != 2) throw BadRequest(name + ": expected pairs of numbers");
        const auto coordinate = [&](const Json& value) {
            constexpr double farthest = 10'000;
            const double number = value.is_number() ? value.get<double>() : farthest + 1;
            if (std::abs(number) > farthest || number != std::floor(number)) {
                throw BadRequest(name + ": expected whole numbers of half spacings");
            }
            return static_cast<std::int32_t>(number);
        };
        places.push_back({coordinate(pair[0]), coordinate(pair[1])});
    }
    return places;
}

Json places(std::span<const GridDot> dots) {
    Json all = Json::array();
    for (const GridDot& dot : dots) all.push_back({dot.x, dot.y});
    return all;
}

struct EditedGrid {
    DotGrid grid;
    GridDot moved;  ///< from a dot's place before to its place now, relative to the middle of the grid's box
};

/// Adds and removes dots, with their images under the symmetry.
EditedGrid edited(const DotGrid& grid, const Json& request) {
    const GridSymmetry symmetry = parse_grid_symmetry(text_of(request, "symmetry", "none"));
    std::map<std::int32_t, std::set<std::int32_t>, std::greater<>> rows;  // x by y, from the top
    for (const GridDot& dot : grid.dots()) rows[dot.y].insert(dot.x);
    for (const GridDot& place : places_of(request, "add")) {
        if ((place.y - grid.dots().front().y) % 2 != 0) throw BadRequest("add: a dot between two rows");
        for (const GridDot& image : place_images(grid, place, symmetry)) rows[image.y].insert(image.x);
    }
    for (const GridDot& place : places_of(request, "remove")) {
        for (const GridDot& image : place_images(grid, place, symmetry)) {
            const auto row = rows.find(image.y);
            if (row != rows.end()) row->second.erase(image.x);
        }
    }
    std::erase_if(rows, [](const auto& row) { return row.second.empty(); });
    if (rows.empty()) throw BadRequest("a grid needs a dot: the last one stays");
    std::vector<std::vector<std::int32_t>> columns;
    const GridDot first{*rows.begin()->second.begin(), rows.begin()->first};
    for (const auto& [y, row] : rows) {
        columns.resize(static_cast<std::size_t>((first.y - y) / 2));
        columns.emplace_back(row.begin(), row.end());
    }
    DotGrid made(grid.lattice(), columns);
    const GridDot now = made.dots().front();
    return {std::move(made), {now.x - first.x, now.y - first.y}};
}

Json symmetries_of(const DotGrid& grid) {
    Json all = Json::array();
    for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
        Json one = {{"name", grid_symmetry_name(symmetry)}, {"orbits", gap_orbits(grid, symmetry)}};
        if (const auto obstacle = single_line_obstacle(grid, symmetry)) one["obstacle"] = *obstacle;
        if (const auto obstacle = single_line_obstacle(grid, symmetry, true)) one["joined_obstacle"] = *obstacle;
        all.push_back(std::move(one));
    }
    return all;
}

/// The lines as the control points of their splines, in the units of GridDot: on straight dots with a round rim the
/// midpoints of the sides of dots that they pass.
Json strands(const DotGrid& grid, const GapStates& states, RimStyle style, const Monitor& monitor) {
    Json all = Json::array();
    Pulse pulse(monitor);
    const KolamRim rim(grid, states, style);
    const bool is_square = grid.lattice() == DotLattice::square;
    for (const ArcStep& start : line_starts(grid, states, monitor)) {
        Json points = Json::array();
        if (!is_square || rim.shaped() > 0) {
            for (const glm::dvec2 place : rounded_line(grid, states, start, rim, pulse)) {
                points.push_back({2 * place.x, (is_square ? 2 : 4 / std::numbers::sqrt3) * place.y});
            }
            all.push_back(std::move(points));
            continue;
        }
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

Json answer_dots(const Json& request) {
    const DotGrid before = parse_dot_grid(text_of(request, "grid"));
    require_readable(before);
    const bool is_edited = request.contains("add") || request.contains("remove");
    const EditedGrid result = is_edited ? edited(before, request) : EditedGrid{before, {}};
    const DotGrid& grid = result.grid;
    require_readable(grid);
    Json gaps = Json::array();
    for (const GridGap& gap : grid.gaps()) gaps.push_back({gap.from, gap.to, gap.side});
    return {{"grid", grid.text()},
            {"lattice", grid.lattice() == DotLattice::square ? "square" : "triangular"},
            {"rows", grid.rows()},
            {"is_solid", grid.is_solid()},
            {"dots", places(grid.dots())},
            {"gaps", std::move(gaps)},
            {"symmetries", symmetries_of(grid)},
            {"gap_images", grid_symmetries(grid)},
            {"arc_images", arc_symmetries(grid)},
            {"moved", {result.moved.x, result.moved.y}}};
}

Json answer_grid(const Json& request, const Monitor& monitor) {
    const DotGrid grid = parse_dot_grid(text_of(request, "grid"));
    require_readable(grid);
    RandomKolam random;
    random.symmetry = parse_grid_symmetry(text_of(request, "symmetry", "none"));
    require_symmetry(grid, random.symmetry);
    random.density = number_of(request, "density", random.density);
    random.joined = number_of(request, "joined", random.joined);
    random.composed = flag_of(request, "composed");
    if (request.contains("seed")) random.seed = whole_of(request["seed"], "seed");

    const std::string given = text_of(request, "gaps", "");
    const bool is_given = request.contains("gaps");
    GapStates states = is_given ? parse_gap_states(grid, given) : random_states(grid, random);
    Json answer = Json::object();
    std::size_t changed = 0;
    if (flag_of(request, "single_line")) {
        const bool has_joined =
            random.joined > 0 || std::find(states.begin(), states.end(), GapState::joined) != states.end();
        const auto obstacle = single_line_obstacle(grid, random.symmetry, has_joined);
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
    KolamPatternOptions options;
    const std::string name = grid.is_solid() ? grid.text() + " dots" : counted(grid.dots().size(), "dot");
    options.title = text_of(request, "title", "Kolam on " + name);
    options.description =
        fmt::format("{}, {}, {}", counted(grid.dots().size(), "dot"), summary_of(states), counted(lines, "line"));
    options.coloured = flag_of(request, "coloured");
    options.rim = parse_rim_style(text_of(request, "rim", "round"));
    options.centred_dots = flag_of(request, "centred");
    options.monitor = monitor;

    const KolamPattern pattern = kolam_pattern(grid, states, options);
    answer["text"] = pattern.text;
    answer["shaped"] = pattern.shaped;
    answer["grid"] = grid.text();
    answer["gaps"] = gap_states_text(grid, states);
    answer["lines"] = lines;
    answer["changed"] = changed;
    if (flag_of(request, "strands")) {
        answer["strands"] = strands(grid, states, options.rim, monitor);
        answer["line_orbits"] = line_orbits(grid, states, monitor);
        answer["centred"] = places(crossed_cells(grid, states));
    }
    return answer;
}

}  // namespace sikku
