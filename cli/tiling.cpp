// cli/tiling.cpp: `sikku tiling`: examines whether the polygons of a pattern or a file tile a region.
#include "engine/tiling/tiling.h"
#include "art/reading/polygon_files.h"
#include "art/style/length.h"
#include "art/tile_templates.h"
#include "cli/command.h"
#include "engine/base/input_file.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/cut_list.h"
#include "engine/tiling/tile_origins.h"
#include "engine/tiling/tiling_text.h"

#include <fmt/format.h>

namespace sikku {
namespace {

/// How a file of polygons is named.
bool has_polygons(const std::string& name) {
    const std::string extension = lower_case(std::filesystem::path(name).extension().string());
    return extension == ".json" || extension == ".svg";
}

void write_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                const TileGrowth& growth, const TileOrigins* origins, const Monitor& monitor) {
    const auto path = [origins](std::uint32_t number) { return origins ? origins->path_text(number) : ""; };
    write_tiling_json(title, n, result, growth, path, [&monitor](std::string_view text) {
        monitor.check();
        std::fwrite(text.data(), 1, text.size(), stdout);
    });
}

/// Examines the polygons of a file. @param tolerance  0: the usual one
void examine_file(const std::string& file, double tolerance, bool as_json, bool quiet) {
    Progress progress(quiet);
    TilingOptions how;
    how.monitor = progress.monitor();
    const std::string text = read_file(file, file, most_polygon_bytes, how.monitor);
    const auto examine = [&] {
        if (text.size() > most_polygon_bytes) {
            throw std::runtime_error(fmt::format("larger than {} MB", most_polygon_bytes >> 20U));
        }
        const bool is_svg = lower_case(std::filesystem::path(file).extension().string()) == ".svg";
        const PolygonList polygons =
            is_svg ? read_polygons_svg(text, how.monitor) : read_polygons_json(text, how.monitor);
        for (const std::string& note : polygons.notes) tell_unless(quiet, "{}: {}\n", file, note);
        const double within = tolerance > 0 || polygons.size() == 0 ? tolerance : usual_tolerance(polygons);
        if (polygons.size() == 0) throw std::runtime_error("the list has no polygons");
        return std::pair(polygons.title, examine_polygons(polygons, within, how));
    };
    const auto result = [&] {
        try {
            return examine();
        } catch (const Stopped&) {
            throw;
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
        }
    }();
    const std::string title = result.first.empty() ? std::filesystem::path(file).filename().string() : result.first;
    TileGrowth growth;
    growth.unknown = growth.no_limit = growth.no_length = "a file of polygons has no productions";
    if (as_json) return write_json(title, std::nullopt, result.second, growth, nullptr, how.monitor);
    fmt::print("{}", tiling_text(title, std::nullopt, result.second.examination, growth));
}

/// Options for those who cut the pieces.
struct CutOptions {
    bool lists = false;
    std::string step = "10mm";
    std::string seam;  ///< empty: no templates
    std::string kerf = "0mm";
    std::string output;
};

double length_in(const char* option, const std::string& text, double least, double most) {
    const auto length = parse_length(text, 300);
    if (!length || !(*length >= least && *length <= most)) {
        throw UsageError(fmt::format("--{} {}: expected a length from {} mm to {} mm", option, text, least, most));
    }
    return *length;
}

/// Prints the list of pieces, or writes their templates.
void cut(const CutOptions& options, bool as_json, const Document& document, const TilingResult& result) {
    const double step = length_in("step", options.step, 0.001, 10'000);
    const std::string title = document.text("title");
    const std::int64_t n = document.grammar().steps();
    if (options.lists) {
        fmt::print("{}", as_json ? cut_list_json(title, n, result, step) : cut_list_text(title, n, result, step));
    }
    if (options.seam.empty()) return;
    TemplateOptions templates;
    templates.seam = length_in("templates", options.seam, 0, 100);
    templates.kerf = length_in("kerf", options.kerf, 0, 10);
    templates.title = title;
    templates.pattern = document.source().text();
    write_templates(cut_list(result, step), templates, *print_format(options.output), options.output, file_system());
}

/// Checks what can be checked before anything is derived.
void check(const CutOptions& options) {
    const auto format = print_format(options.output);
    if (options.seam.empty()) return;
    if (format != PrintFormat::svg && format != PrintFormat::pdf && format != PrintFormat::dxf) {
        throw UsageError(fmt::format("--templates needs -o with a name that ends in .svg, .pdf or .dxf{}",
                                     options.output.empty() ? "" : ", not '" + options.output + "'"));
    }
}

}  // namespace

void add_tiling(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("tiling", "Examine whether the polygons of a pattern or a file tile a region");
    auto options = std::make_shared<PatternOptions>();
    auto counts = std::make_shared<bool>(false);
    auto as_json = std::make_shared<bool>(false);
    auto budget = std::make_shared<double>(200e6);
    auto tolerance = std::make_shared<double>(0);
    add_pattern_options(*command, *options);
    command->get_option("PATTERN")->description(
        "pattern file, name of a bundled pattern, studio link, - for standard input, or a .json or .svg file of "
        "polygons");
    command->add_flag("--counts", *counts, "count the tiles and find their growth from the productions alone");
    command->add_flag("--json", *as_json, "print one line of JSON, with all tiles");
    command
        ->add_option("--tolerance", *tolerance,
                     "distance within which corners of a .json or .svg file are one, in its units (a 500th of the "
                     "median edge)")
        ->type_name("LENGTH")
        ->check([](const std::string& text) {
            double value = 0;
            return read_number(text, value) && value > 0 ? "" : "expected a number above 0, not " + printable(text);
        });
    auto cutting = std::make_shared<CutOptions>();
    auto* lists = command->add_flag("--cut-list", cutting->lists,
                                    "list the pieces by kind: number, hand, colour, area and sides");
    auto* seam = command->add_option("--templates", cutting->seam,
                                     "draw an outline of each shape with this seam allowance, 0 to 100mm, into -o");
    command->add_option("--step", cutting->step, "length of a step, for --cut-list and --templates (10mm)");
    command->add_option("--kerf", cutting->kerf, "width of the cut, 0 to 10mm: templates grow by half of it (0mm)")
        ->needs(seam);
    command->add_option("-o,--output", cutting->output, "file of the templates: .svg, .pdf or .dxf")->needs(seam);
    lists->excludes("--counts");
    seam->excludes("--counts");
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
        "The polygons of other programs are examined with a tolerance, because their corners are rounded. A .json "
        "file is a list of polygons, each a list of corners [x, y], or what --json writes. In an .svg file the "
        "filled "
        "polygons are the tiles: paths of straight lines, polygon and rect, with their transforms; without fills, "
        "all "
        "closed lines. Curves are refused with their line. Such a file has no n and no growth.\n\n"
        "Templates are for single pieces: --kerf moves their outlines outwards by half the width of the cut. In a "
        "drawing of the whole tiling neighbours share their edges, so the kerf cannot be made up for. Labels give "
        "the "
        "names in --cut-list and the numbers of pieces. Seams are dashed.\n\n"
        "The exit status is 0 whether or not the drawing is a tiling. Keys of --json: title, n, tiling, exact, "
        "tolerance, lattice (k, rank, basis: where the coordinates' units point), polygons, tiles, violations, "
        "violation_list (fault: open, empty, crossing, duplicate or overlap; tile, other, at, origins: lines and "
        "columns "
        "of the pattern, with paths), regions, gaps, area, "
        "euler (V - E + F = regions - gaps), areas_agree, shapes (area_4i: 4 i times the area in the lattice's "
        "coordinates), edges (pieces between corners), inner_edges, "
        "border_edges, edges_cut, vertices, inner_vertices, figures, neighbours (pairs), neighbour_counts, "
        "least_colours, most_colours, symmetry, rotations, mirrors, centre, growth, border (loops of points), list "
        "(tile, shape, reflected, orientation, colour, corners, exact, neighbours, neighbour_colour, path: the "
        "symbols from the axiom to the tile, each with its place in the word that holds it).\n\n"
        "Examples:\n"
        "  sikku tiling penrose-rhombs\n"
        "  sikku tiling hat -n 4\n"
        "  sikku tiling spectre -n 60 --counts\n"
        "  sikku tiling chair --json\n"
        "  sikku tiling polygons.svg --tolerance 0.01\n"
        "  sikku tiling penrose-rhombs --cut-list --step 40mm\n"
        "  sikku tiling hat --templates 6mm --step 20mm -o hat.pdf");
    command->callback([command, options, counts, as_json, budget, tolerance, cutting, &quiet] {
        if (has_polygons(options->pattern)) {
            for (const char* name : {"--steps", "--set", "--variant", "--seed", "--counts", "--budget", "--cut-list",
                                     "--templates", "--step"}) {
                if (command->count(name) == 0) continue;
                throw UsageError(fmt::format("{} applies to patterns, not to a file of polygons", name));
            }
            return examine_file(options->pattern, *tolerance, *as_json, quiet);
        }
        if (*tolerance > 0) {
            throw UsageError("--tolerance applies to a .json or .svg file of polygons, not to patterns");
        }
        check(*cutting);
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
        if (cutting->lists || !cutting->seam.empty()) return cut(*cutting, *as_json, loaded, result);
        find_origins(loaded, result.examination, how.monitor);
        if (!*as_json) {
            fmt::print("{}", tiling_text(title, n, result.examination, growth));
            return;
        }
        write_json(title, n, result, growth, TileOrigins::make(loaded, how.monitor).get(), how.monitor);
    });
}

}  // namespace sikku
