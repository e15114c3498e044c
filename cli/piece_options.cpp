#include "cli/piece_options.h"

#include "art/cutting/cutting_sheets.h"
#include "art/cutting/tile_templates.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "art/product/plot_remarks.h"
#include "art/style/length.h"
#include "art/writer/make_drawing.h"
#include "engine/geometry/lettering.h"
#include "engine/tiling/cut_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

double length_in(const char* option, const std::string& text, double least, double most) {
    const auto length = parse_length(text, 300);
    if (!length || !(*length >= least && *length <= most)) {
        throw UsageError(fmt::format("--{} {}: expected a length from {} mm to {} mm", option, text, least, most));
    }
    return *length;
}

/// Options of prints that apply to sheets of pieces.
std::vector<const OptionInfo*> print_options() {
    std::vector<const OptionInfo*> chosen;
    for (const OptionInfo* row : prints().options()) {
        const bool is_of_plots = row->group == "Plotters" && row->scope != Scope::strokes;
        if (row->group == "Pictures" || is_of_plots) chosen.push_back(row);
    }
    return chosen;
}

PrintFormat format_of(const PieceOptions& options) {
    const auto format = print_format(options.output);
    if (!format || !(is_vector(*format) || info(*format).kind == FormatKind::pixels)) {
        throw UsageError(
            fmt::format("--{} needs -o with the name of an SVG, PDF, EPS, picture, HP-GL, G-code or DXF{}",
                        options.sheet.empty() ? "templates" : "cutting-sheet",
                        options.output.empty() ? "" : ", not '" + options.output + "'"));
    }
    return *format;
}

Page sheet_of(const PieceOptions& options) {
    constexpr double longest = 10'000;
    const auto size = parse_size(options.sheet, 300);
    if (!size || !(size->x >= 1 && size->y >= 1 && size->x <= longest && size->y <= longest)) {
        throw UsageError(
            fmt::format("--cutting-sheet {}: expected A3, letter or another page size, or WIDTHxHEIGHT such "
                        "as 110x100cm, from 1 mm to 10 m",
                        printable(options.sheet)));
    }
    const double margin = length_in("margin", options.margin, 0, longest);
    if (!(2 * margin < std::min(size->x, size->y))) {
        throw UsageError(fmt::format("--margin {}: nothing is left of sheets of {:g} x {:g} mm", options.margin,
                                     size->x, size->y));
    }
    return {size->x, size->y, margin};
}

PieceWriting writing_of(const PieceOptions& options, const PieceSource& source, const Monitor& monitor) {
    const PrintFormat format = format_of(options);
    const std::filesystem::path here;
    const DrawSettings settings = read_draw_settings(options.print.values(), &here);
    PieceWriting writing;
    writing.title = source.title;
    writing.pattern = source.pattern;
    writing.dpi = settings.paper.dpi;
    static_cast<PlotSetup&>(writing.drawing) = plot_setup(settings, format);
    writing.drawing.format = format;
    static_cast<PictureOptions&>(writing.drawing) = settings.work;
    writing.drawing.monitor = monitor;
    return writing;
}

void report(const PieceOptions& options, const std::vector<DrawReport>& reports, bool quiet) {
    if (quiet) return;
    const DrawSettings settings = read_draw_settings(options.print.values());
    Made made;
    for (const DrawReport& each : reports) {
        if (each.plot) report_plot(*each.plot, settings.plot.speeds, settings.plot.pen_rules, made);
    }
    report(made);
}

void write_sheets(const PieceOptions& options, const PieceSource& source, const TilingResult& result, double step,
                  bool as_json, const Monitor& monitor, bool quiet) {
    CuttingOptions cutting;
    cutting.sheet = sheet_of(options);
    cutting.seam = length_in("seam", options.seam, 0, 100);
    cutting.kerf = length_in("kerf", options.kerf, 0, 10);
    cutting.gap = length_in("gap", options.gap, 0, 100);
    cutting.grain = options.grain;
    const CuttingPlan plan = plan_cutting(cut_list(result, step, cutting.grain), cutting, monitor);
    const PieceWriting writing = writing_of(options, source, monitor);
    std::vector<std::string> materials, files;
    for (const CuttingSheet& sheet : plan.sheets) materials.push_back(source.colour_name(sheet.colour));
    const std::filesystem::path output(options.output);
    const auto names = sheet_files(output, has_several_files(writing) ? plan.sheets.size() : 1);
    for (std::size_t i = 0; i < plan.sheets.size(); ++i) {
        files.push_back(names.size() > 1 || plan.sheets.size() == 1
                            ? names[i].filename().string()
                            : fmt::format("{}, page {}", output.filename().string(), i + 1));
    }
    const auto reports =
        write_cutting_sheets(plan, cutting, materials, options.labels, writing, output, file_system());
    fmt::print("{}", as_json ? cutting_json(source.title, cutting, plan, materials, files)
                             : cutting_text(source.title, cutting, plan, materials, files));
    report(options, reports, quiet);
    constexpr double little = 0.3;
    const bool has_colours = std::any_of(plan.sheets.begin(), plan.sheets.end(), [&](const CuttingSheet& sheet) {
        return sheet.colour != plan.sheets.front().colour;
    });
    if (has_colours && plan.in_use < little && !quiet) {
        tell(
            "sikku: note: each colour has sheets of its own; --set 'tile colours=blank' lays all pieces on the "
            "same\n");
    }
    const std::string missing = options.labels ? missing_letters({source.title}) : "";
    if (!missing.empty() && !quiet) tell("sikku: warning: {}\n", letters_warning(missing));
}

/// Collects the colours of polygons in their order.
class ColourReader : public PolygonSink {
public:
    std::vector<std::int32_t> colours;
    void polygon(std::span<const glm::dvec2>, const Pen& pen) override { colours.push_back(pen.colour); }
};

}  // namespace

void add_piece_options(CLI::App& command, PieceOptions& options) {
    const OptionGroup group{command, "Pieces to cut"};
    group.flag("--cut-list", options.lists, "list the pieces by kind: number, hand, colour, area and sides");
    group.add("--templates", options.templates, "SEAM",
              "draw an outline of each shape with this seam allowance, 0 to 100mm, and write it to -o");
    group.add("--cutting-sheet", options.sheet, "SIZE",
              "lay all pieces on sheets of material of this size, such as A3 or 110x100cm, and write them to -o");
    group.add("--step", options.step, "LENGTH", "length of a step, or of a unit of a file (10mm)");
    group.add("--seam", options.seam, "LENGTH",
              "seam allowance around each piece on a cutting sheet, 0 to 100mm (0mm)");
    group.add("--kerf", options.kerf, "LENGTH", "width of the cut, 0 to 10mm: outlines grow by half of it (0mm)");
    group.add("--gap", options.gap, "LENGTH",
              "distance between pieces on a cutting sheet, 0 to 100mm; at 0mm, neighbours share cuts (0mm)");
    group.add("--margin", options.margin, "LENGTH", "margin of a cutting sheet (10mm)");
    group.flag("--grain", options.grain,
               "keep the direction of pieces on a cutting sheet, for material with a grain: turn them only by 180 "
               "degrees");
    group.flag("--labels,!--no-labels", options.labels, "write names on the pieces of a cutting sheet (default)");
    group.add("-o,--output", options.output, "FILE", "file of the drawings; its extension selects the format");
    options.print.add(command, print_options());
}

void check_piece_options(const CLI::App& command, const PieceOptions& options) {
    const auto given = [&](const char* name) { return command.count(name) > 0; };
    const auto need = [&](std::initializer_list<const char*> names, bool is_met, const char* what) {
        for (const char* name : names) {
            if (given(name) && !is_met) throw UsageError(fmt::format("{} needs {}", name, what));
        }
    };
    need({"--seam", "--gap", "--margin", "--grain", "--labels"}, !options.sheet.empty(), "--cutting-sheet");
    need({"--kerf", "--output"}, options.draws(), "--templates or --cutting-sheet");
    need({"--step"}, options.any(), "--cut-list, --templates or --cutting-sheet");
    if (const OptionValues values = options.print.values(); !values.empty() && !options.draws()) {
        throw UsageError(fmt::format("--{} needs --templates or --cutting-sheet", values.front().name));
    }
    if (!options.templates.empty() && !options.sheet.empty()) {
        throw UsageError("--templates excludes --cutting-sheet: both write into -o");
    }
    if (!options.sheet.empty() && options.lists) {
        throw UsageError("--cut-list excludes --cutting-sheet: both print a list");
    }
    length_in("step", options.step, 0.001, 10'000);
    if (!options.draws()) return;
    const PrintFormat format = format_of(options);
    length_in("kerf", options.kerf, 0, 10);
    if (!options.templates.empty()) length_in("templates", options.templates, 0, 100);
    length_in("seam", options.seam, 0, 100);
    length_in("gap", options.gap, 0, 100);
    DrawSettings settings = read_draw_settings(options.print.values());
    if (!options.sheet.empty()) {
        settings.paper.page = sheet_of(options);
        settings.paper.page.margin = 0;
    }
    check_draw_settings(settings, format);
}

void cut_pieces(const PieceOptions& options, const PieceSource& source, const TilingResult& result, bool as_json,
                const Monitor& monitor, bool quiet) {
    const double step = length_in("step", options.step, 0.001, 10'000);
    // The list contains this message itself.
    if (const std::string missing = missing_pieces(result.examination);
        !missing.empty() && (as_json || !options.lists)) {
        tell("sikku: warning: {}\n", missing);
    }
    if (options.lists) {
        fmt::print("{}", as_json ? cut_list_json(source.title, source.n, result, step)
                                 : cut_list_text(source.title, source.n, result, step));
    }
    if (!options.sheet.empty()) return write_sheets(options, source, result, step, as_json, monitor, quiet);
    if (options.templates.empty()) return;
    TemplateOptions templates;
    templates.seam = length_in("templates", options.templates, 0, 100);
    templates.kerf = length_in("kerf", options.kerf, 0, 10);
    const auto reports = write_templates(cut_list(result, step), templates, writing_of(options, source, monitor),
                                         options.output, file_system());
    report(options, reports, quiet);
}

std::function<std::string(std::int32_t)> colour_as_drawn(const Document& document, TilingResult& result,
                                                         double budget, const Monitor& monitor) {
    DrawSettings settings;
    settings.work.budget = budget;
    Style style = read_print_style(document, settings);
    TileSet& all = result.patch.tiles;
    if (style.tile_colours == TileColours::blank) {
        // Blank tiles have one material.
        std::fill(all.colour.begin(), all.colour.end(), 0);
        return [](std::int32_t) { return std::string("blank"); };
    }
    if (style.tile_colours) {
        DrawOptions options;
        static_cast<DrawingOptions&>(options) = drawing_options(settings, document);
        options.budget = settings.work.budget;
        options.monitor = monitor;
        options.watch = [&](std::uint64_t symbols) { monitor.advance(symbols); };
        const auto drawing = make_drawing(document.grammar(), style, options);
        Print print;
        print.style = style;
        drawing->place(print);
        style = drawing->style();
        print.style = style;
        ColourReader reader;
        drawing->read(print, reader);
        // Blades are polygons, but not tiles.
        if (reader.colours.size() == all.polygons) {
            for (std::uint32_t tile = 0; tile < all.tiles(); ++tile) {
                all.colour[tile] = reader.colours[all.number[tile] - 1];
            }
        }
    }
    // Indices of one colour are one material.
    const std::vector<int> slots = style.fill_slots();
    for (std::int32_t& colour : all.colour) {
        colour = slots[static_cast<std::size_t>(style.index({.colour = colour}))];
    }
    return [style](std::int32_t colour) {
        return fmt::format("{} {}", colour, hex(style.fill_colour({.colour = colour})));
    };
}

}  // namespace sikku
