// cli/tiling.cpp: `sikku tiling`: examines whether the polygons of a pattern tile a region.
#include "engine/tiling/tiling.h"
#include "cli/command.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/tiling_text.h"

#include <fmt/format.h>

namespace sikku {

void add_tiling(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("tiling", "Examine whether the polygons of a pattern tile a region");
    auto options = std::make_shared<PatternOptions>();
    auto counts = std::make_shared<bool>(false);
    auto as_json = std::make_shared<bool>(false);
    auto budget = std::make_shared<double>(200e6);
    add_pattern_options(*command, *options);
    command->add_flag("--counts", *counts, "count the tiles and find their growth from the productions alone");
    command->add_flag("--json", *as_json, "print one line of JSON, with all tiles");
    add_budget_option(*command, *budget);
    command->footer(
        "A tile is a closed polygon { }; its corners are the points where it turns. Tiles form a tiling of a region "
        "if they neither overlap nor leave gaps: every piece of an edge between corners is used at most once in each "
        "direction, the tiles around each vertex do not overlap, and the border splits into loops that do not cross, "
        "around regions and around gaps. Polygons that are open or cross themselves, and tiles drawn twice, are "
        "reported and left out. Tiles are numbered in drawing order. Positions are in turtle steps; the turtle "
        "starts "
        "at 0 0; the examination is exact where angles and lengths fit a lattice.\n\n"
        "The growth is found from the productions: the factor of lengths, where the moves are multiplied by one "
        "number, and the frequencies of shapes in the limit. Up to 10,000,000 tiles are examined; --counts derives "
        "nothing, so that n = 60 costs as little as n = 6.\n\n"
        "The exit status is 0 whether or not the drawing is a tiling. Keys of --json: title, n, tiling, exact, "
        "tolerance, lattice (k, rank, basis: where the coordinates' units point), polygons, tiles, violations, "
        "violation_list (fault: open, empty, crossing, duplicate or overlap; tile, other, at, origins: lines and "
        "columns "
        "of the pattern), regions, gaps, area, "
        "euler (V - E + F = regions - gaps), areas_agree, shapes, edges (pieces between corners), inner_edges, "
        "border_edges, edges_cut, vertices, inner_vertices, figures, neighbours (pairs), neighbour_counts, "
        "least_colours, most_colours, symmetry, rotations, mirrors, centre, growth, border (loops of points), list "
        "(tile, shape, reflected, orientation, colour, corners, exact, neighbours, neighbour_colour).\n\n"
        "Examples:\n"
        "  sikku tiling penrose-rhombs\n"
        "  sikku tiling hat -n 4\n"
        "  sikku tiling spectre -n 60 --counts\n"
        "  sikku tiling chair --json");
    command->callback([options, counts, as_json, budget, &quiet] {
        const Document loaded = load(*options, quiet);
        require_turtle(loaded, "it draws no tiles");
        const std::string title = loaded.text("title");
        const std::int64_t n = loaded.grammar().steps();
        const TileGrowth growth = find_growth(loaded.grammar());
        if (*counts) {
            fmt::print("{}", *as_json ? tile_counts_json(title, n, growth) : tile_counts_text(title, n, growth));
            return;
        }
        Progress progress(quiet);
        TilingOptions how;
        how.limits.nodes = *budget;
        how.monitor = progress.monitor();
        const auto examine = [&] {
            try {
                return examine_tiling(loaded.grammar(), how);
            } catch (const BudgetError& error) {
                throw BudgetError(fmt::format("{}; --counts counts the tiles without deriving them", error.what()));
            }
        };
        TilingResult result = examine();
        find_origins(loaded, result.examination, how.monitor);
        if (!*as_json) {
            fmt::print("{}", tiling_text(title, n, result.examination, growth));
            return;
        }
        write_tiling_json(title, n, result, growth, [&how](std::string_view text) {
            how.monitor.check();
            std::fwrite(text.data(), 1, text.size(), stdout);
        });
    });
}

}  // namespace sikku
