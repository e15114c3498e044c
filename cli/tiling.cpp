// cli/tiling.cpp: `sikku tiling`: examines whether the polygons of a pattern or a file tile a region.
#include "engine/tiling/tiling.h"
#include "art/reading/polygon_files.h"
#include "cli/mistakes.h"
#include "cli/piece_options.h"
#include "engine/base/input_file.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/tile_origins.h"
#include "engine/tiling/tiling_text.h"

#include <fmt/format.h>

namespace sikku {
namespace {

struct TilingCommand : ExaminationOptions {
    bool counts = false;
    double tolerance = 0;  ///< 0: the default
    PieceOptions pieces;
};

/// True for the name of a file of polygons.
bool has_polygons(const std::string& name) {
    return extension_of(name) == ".json" || extension_of(name) == ".svg";
}

void write_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                const TileGrowth& growth, const TileOrigins* origins, const Monitor& monitor) {
    const auto path = [origins](std::uint32_t number) { return origins ? origins->path_text(number) : ""; };
    write_tiling_json(title, n, result, growth, path, [&monitor](std::string_view text) {
        monitor.check();
        std::fwrite(text.data(), 1, text.size(), stdout);
    });
}

/// Reads a file of polygons and examines them. @param tolerance  0: the default
std::pair<PolygonList, TilingResult> read_polygons(const std::string& file, double tolerance,
                                                   const TilingOptions& how, bool quiet) {
    const std::string text = read_file(file, file, most_polygon_bytes, how.monitor);
    try {
        if (text.size() > most_polygon_bytes) {
            throw std::runtime_error(fmt::format("larger than {} MB", most_polygon_bytes >> 20U));
        }
        const bool is_svg = extension_of(file) == ".svg";
        PolygonList polygons = is_svg ? read_polygons_svg(text, how.monitor) : read_polygons_json(text, how.monitor);
        for (const std::string& note : polygons.notes)
            tell_unless(quiet, "{}: {}\n", printable(file, 2000), printable(note));
        if (polygons.size() == 0) throw std::runtime_error("the list has no polygons");
        TilingResult result = examine_polygons(polygons, tolerance > 0 ? tolerance : usual_tolerance(polygons), how);
        return {std::move(polygons), std::move(result)};
    } catch (const Stopped&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
    }
}

/// Examines the polygons of a file, or cuts them.
void examine_file(const std::string& file, double tolerance, const PieceOptions& pieces, bool as_json, bool quiet) {
    Progress progress(quiet);
    TilingOptions how;
    how.monitor = progress.monitor();
    const auto [polygons, result] = read_polygons(file, tolerance, how, quiet);
    const std::string title =
        polygons.title.empty() ? std::filesystem::path(file).filename().string() : polygons.title;
    if (pieces.any()) {
        const auto colour_name = [&names = polygons.colour_names](std::int32_t colour) {
            const auto index = static_cast<std::size_t>(colour);
            return index < names.size() ? fmt::format("{} {}", colour, names[index]) : std::to_string(colour);
        };
        return cut_pieces(pieces, {title, std::nullopt, "", colour_name}, result, as_json, how.monitor, quiet);
    }
    TileGrowth growth;
    growth.unknown = growth.no_limit = growth.no_length = "a file of polygons has no productions";
    if (as_json) return write_json(title, std::nullopt, result, growth, nullptr, how.monitor);
    fmt::print("{}", tiling_text(title, std::nullopt, result.examination, growth));
}

}  // namespace

void add_tiling(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("tiling", "Examine whether the polygons of a pattern or a file tile a region");
    auto options = std::make_shared<TilingCommand>();
    add_pattern_options(*command, *options);
    command->get_option("PATTERN")->description(
        "pattern file, name of a bundled pattern, studio link, - for standard input, or a .json or .svg file of "
        "polygons");
    command->add_flag("--counts", options->counts,
                      "count the tiles and find their growth from the productions alone");
    command->add_flag("--json", options->as_json, "print one line of JSON, with all tiles");
    command
        ->add_option("--tolerance", options->tolerance,
                     "distance within which corners of a .json or .svg file are one, in its units (a 500th of the "
                     "median edge)")
        ->type_name("LENGTH")
        ->check(above_zero);
    add_piece_options(*command, options->pieces);
    for (const char* name : {"--cut-list", "--templates", "--cutting-sheet"}) {
        command->get_option(name)->excludes("--counts");
    }
    add_budget_option(*command, options->budget);
    command->footer(
        "A tile is a closed polygon { }; its corners are the points where it turns. Tiles form a tiling of a region "
        "if they neither overlap nor leave gaps: every piece of an edge between corners is used at most once in "
        "each direction, the tiles around each vertex do not overlap, the border does not cross itself, and no "
        "place that is enclosed by tiles is left open, also where they touch at corners only. Polygons that are "
        "open or cross themselves, and tiles drawn twice, are reported and left out. Tiles are numbered in drawing "
        "order. Positions are in turtle steps; the turtle starts at 0 0; the examination is exact where angles and "
        "lengths fit a lattice.\n\n"
        "The growth is found from the productions: the factor of lengths, where the moves are multiplied by one "
        "number, and the shares of shapes, hands and colours in the limit. Up to 10,000,000 tiles are examined; "
        "--counts derives nothing, so that n = 60 costs as little as n = 6.\n\n"
        "The polygons of other programs are examined with a tolerance, because their corners are rounded. A .json "
        "file is a list of polygons, each a list of corners [x, y], or what --json writes. In an .svg file the "
        "filled polygons are the tiles: paths of straight lines, polygon and rect, with their transforms, and their "
        "copies by use; without fills, all closed lines. Fills are read from attributes, styles and style sheets "
        "with simple selectors. Circles no larger than the smallest tile are markers; other curves are refused with "
        "their line. What is left out is counted. Such a file has no n and no growth.\n\n"
        "--cut-list counts the pieces, --templates draws each shape and hand once, and --cutting-sheet lays all of "
        "them on sheets of material, separate for each colour (of the pattern, or of its tile colours), in rows "
        "that fit into each other, with every second piece turned by 180 degrees if that saves material, or one by "
        "one in many directions if that saves more. Mirror images are kept apart, because most materials have a "
        "right side. A sheet that is cut several times is drawn once. Files are numbered, x-1.svg, or are pages of "
        "one PDF. The list shows how much of the material "
        "is in use.\n\n"
        "Outlines lie half the width of the cut, --kerf, outside the finished size and its seam allowance. Pieces "
        "without a gap share their cuts, which are drawn once. Labels give the names in --cut-list; seams are "
        "dashed. Pens and layers are labels, seams and cuts, in this order.\n\n"
        "The exit status is 0 whether or not the drawing is a tiling. Keys of --json: title, n, tiling, exact, "
        "inexact (why), tolerance, lattice (k, rank, basis: where the coordinates' units point), polygons, tiles, "
        "violations (a lower bound from 100,000 on), violation_list (fault: open, empty, too fine, crossing, "
        "duplicate or overlap; tile, other, at, origins: line, column and path of what drew the tiles), regions "
        "(joined by edges), components (joined by edges or at corners), gaps (area; centre: a point of the gap), "
        "area, euler (V - E + F = components - gaps), areas_agree, shapes (area_4i: 4 i times the area in the "
        "lattice's coordinates), edges (pieces between corners), inner_edges, border_edges, edges_cut, vertices, "
        "inner_vertices, figures, neighbours (pairs), neighbour_counts, least_colours, most_colours, symmetry, "
        "rotations, mirrors, centre, growth (counts and shares by shape, hand and colour; frequencies, reflected: "
        "of the shapes; colours), border (loops of points around the tiles and around gaps), list (tile, shape, "
        "reflected, orientation, colour, corners, exact, neighbours, neighbour_colour: neighbours differ in it; "
        "path: the symbols from the axiom to the tile, each with its place in the word that contains it). Regions, "
        "components and gaps are null if tiles overlap.\n\n"
        "Examples:\n"
        "  sikku tiling penrose-rhombs\n"
        "  sikku tiling hat -n 4\n"
        "  sikku tiling spectre -n 60 --counts\n"
        "  sikku tiling chair --json\n"
        "  sikku tiling polygons.svg --tolerance 0.01\n"
        "  sikku tiling penrose-rhombs --cut-list --step 40mm\n"
        "  sikku tiling hat --templates 6mm --step 20mm -o hat.pdf\n"
        "  sikku tiling hat --cutting-sheet 50x110cm --seam 6mm --step 20mm -o fabric.pdf\n"
        "  sikku tiling chair --cutting-sheet A3 --kerf 0.2mm --gap 1mm -o wood.dxf\n"
        "  sikku tiling polygons.svg --cut-list --step 1mm");
    command->callback([command, options, &quiet] {
        const PieceOptions& pieces = options->pieces;
        const bool as_json = options->as_json;
        if (has_polygons(options->pattern)) {
            for (const char* name : {"--steps", "--set", "--variant", "--seed", "--counts", "--budget"}) {
                if (command->count(name) == 0) continue;
                throw UsageError(fmt::format("{} applies to patterns, not to a file of polygons", name));
            }
            check_piece_options(*command, pieces);
            keep_input("-o", pieces.output, options->pattern);
            return examine_file(options->pattern, options->tolerance, pieces, as_json, quiet);
        }
        if (options->tolerance > 0) {
            throw UsageError("--tolerance applies to a .json or .svg file of polygons, not to patterns");
        }
        check_piece_options(*command, pieces);
        const Document loaded = load(*options, quiet);
        require_turtle(loaded, "it draws no tiles");
        const std::string title = loaded.text("title");
        const std::int64_t n = loaded.grammar().steps();
        const TileGrowth growth = find_growth(loaded.grammar());
        if (options->counts) {
            fmt::print("{}", as_json ? tile_counts_json(title, n, growth) : tile_counts_text(title, n, growth));
            return;
        }
        Progress progress(quiet);
        TilingOptions how;
        how.limits.nodes = options->budget;
        how.monitor = progress.monitor();
        const auto examine = [&] {
            try {
                return examine_tiling(loaded.grammar(), how);
            } catch (const BudgetError& error) {
                throw BudgetError(fmt::format("{}; --counts counts the tiles without deriving them", error.what()));
            }
        };
        TilingResult result = examine();
        if (pieces.any()) {
            const PieceSource source{title, n, loaded.source().text(),
                                     colour_as_drawn(loaded, result, options->budget, how.monitor)};
            return cut_pieces(pieces, source, result, as_json, how.monitor, quiet);
        }
        find_origins(loaded, result.examination, how.monitor);
        if (!as_json) {
            fmt::print("{}", tiling_text(title, n, result.examination, growth));
            return;
        }
        write_json(title, n, result, growth, TileOrigins::make(loaded, how.monitor).get(), how.monitor);
    });
}

}  // namespace sikku
