#include "art/prints.h"

#include "art/border_files.h"
#include "art/draw_settings.h"
#include "art/drawing/division.h"
#include "art/drawing/division_file.h"
#include "art/drawing/draw.h"
#include "art/drawing/drawing.h"
#include "art/drawing/drawing_cost.h"
#include "art/drawing/faint_inks.h"
#include "art/drawing/growth.h"
#include "art/drawing/lesson.h"
#include "art/drawing/lesson_drawing.h"
#include "art/drawing/window_drawing.h"
#include "art/drawing/word_drawing.h"
#include "art/image/image_file.h"
#include "art/plot_remarks.h"
#include "art/print_cell.h"
#include "art/raster/raster.h"
#include "art/sheet/sheet.h"
#include "art/unused_options.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lettering.h"
#include "engine/language/surface.h"
#include "engine/language/undrawn.h"
#include "engine/map/map_measurement.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

void report_sheets(const DrawReport& report, Made& made) {
    if (report.sheets == 1) return made.warn("'tile' has no effect: the print fits on one sheet");
    made.fact(fmt::format("{} sheets, {} x {}", report.sheets, report.sheet_rows, report.sheets / report.sheet_rows));
    constexpr double least = 0.05;
    const auto left_out = [&](double length, const char* sides) {
        if (length < least) return;
        made.fact(fmt::format("{:.1f} mm of the margin at the {} do not fit on the sheets and are left out", length,
                              sides));
    };
    left_out(report.left_out.x, "left and right");
    left_out(report.left_out.y, "top and bottom");
}

void report_text(const DrawReport& report, const std::filesystem::path& name, Made& made) {
    if (!report.leaves_pattern_out) return;
    made.warn(
        fmt::format("{} does not contain the text of the pattern, which is longer than 60,000 bytes", name.string()));
}

void report_swatch(const Swatch& swatch, const Print& print, glm::dvec2 stretch, Made& made) {
    made.fact(fmt::format("{}: {}, {:.6g} x {:.6g} mm", swatch.is_rectangle ? "a rectangle" : "a parallelogram",
                          counted(swatch.tiles, "tile"), print.page.width, print.page.height));
    if (swatch.turn != 0) made.fact(fmt::format("the tiling is turned by {:.6g} degrees", swatch.turn));
    if (!swatch.is_rectangle) {
        made.warn(fmt::format("no rectangle of this tiling repeats: copies lie {:.6g} and {:.6g} steps apart",
                              glm::length(swatch.cell.sides[0]), glm::length(swatch.cell.sides[1])));
    }
    const glm::dvec2 parts = 100.0 * (stretch - 1.0);
    if (std::max(std::fabs(parts.x), std::fabs(parts.y)) < 0.01) return;
    made.fact(fmt::format("stretched to whole pixels by {:.2g} % across and {:.2g} % down", parts.x, parts.y));
}

/// Whether a style has colours that a format without opacity can only mix.
bool has_translucent_colours(const Style& style) {
    const auto mixes = [](const Colour& colour) { return colour.alpha > 0 && colour.alpha < 255; };
    if (style.ground && mixes(*style.ground)) return true;
    for (int index = 0; index < std::max(static_cast<int>(style.palette.size()), 1); ++index) {
        const Pen pen{.colour = index};
        if ((style.stroked && mixes(style.line_colour(pen))) || mixes(style.fill_colour(pen))) return true;
    }
    return false;
}

void report_relief(const ReliefReport& report, Made& made) {
    constexpr std::size_t most_named = 8;
    constexpr double thin = 0.4;  // width in mm that the usual nozzle of a 3-D printer can draw
    made.fact(fmt::format("{}, {:g} x {:g} x {:g} mm, {:.1f} cm³", counted(report.triangles, "triangle"),
                          report.size.x, report.size.y, report.size.z, report.volume / 1000));
    const auto tell = [&](const char* what, const std::vector<std::pair<Colour, double>>& heights) {
        std::string list;
        for (std::size_t i = 0; i < std::min(heights.size(), most_named); ++i) {
            list += fmt::format("{}{} {:g} mm", list.empty() ? "" : ", ", hex(heights[i].first), heights[i].second);
        }
        if (!list.empty()) made.fact(what + list + (heights.size() > most_named ? ", …" : ""));
    };
    tell("heights: ", report.heights);
    tell("heights of lines: ", report.ridges);
    if (report.lost > 0) {
        made.warn(fmt::format("{} narrower than the groove and left out",
                              report.lost == 1 ? "1 polygon is" : fmt::format("{} polygons are", report.lost)));
    }
    if (report.narrowest > 0 && report.narrowest < thin - 1e-9) {
        made.warn(fmt::format("the narrowest lines are {:.2g} mm wide; many 3-D printers need {:g} mm",
                              report.narrowest, thin));
    }
}

/// A planned print or model.
class PrintWork : public Work {
public:
    /// @throws SettingError, PatternError
    PrintWork(const Document& document, PrintFormat format, DrawSettings settings, GivenOptions given,
              const std::filesystem::path& folder)
        : document_(settings.keys.empty() ? document : document.with(settings.keys)),
          format_(format),
          settings_(std::move(settings)),
          given_(std::move(given)),
          folder_(folder) {
        print_.style = read_print_style(document_, settings_);
        print_.page = settings_.page;
        print_.dpi = settings_.dpi;
        print_.title = document.text("title");
        print_.pattern = document.source().text();
        print_.made = made_with(document.grammar());
        print_.press = settings_.press;
        print_.animation = settings_.animation;
        print_.names_tiles = settings_.names_tiles;
        plan_drawing();
        check_drawing();
        drop_border();
        load_border(print_.style, document_, settings_, folder, drawing_,
                    [this](const std::string& name, const std::string& text) { files_.emplace_back(name, text); });
        for (const auto& surface : document.grammar().surfaces()) {
            if (surface->source) files_.emplace_back(surface->source->name(), surface->source->text());
        }
    }

    Cost forecast() const override;
    std::vector<std::pair<std::string, std::string>> read_files() const override { return files_; }
    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override;
    DrawnPixels make_pixels(const Monitor& monitor);

private:
    bool is_relief() const { return sikku::is_relief(settings_, format_); }
    bool is_model() const { return info(format_).kind == FormatKind::model && !is_relief(); }
    bool is_growth() const { return (format_ == PrintFormat::gif && !settings_.lesson) || settings_.frames; }
    std::pair<std::int64_t, std::int64_t> divided_generations() const {
        return settings_.generations.value_or(std::pair(std::int64_t{0}, document_.grammar().steps()));
    }

    std::string made_with(const Grammar& grammar) const {
        std::string own;
        if (settings_.swatch_place) own += settings_.swatch == SwatchChoice::turned ? " --swatch=turn" : " --swatch";
        if (!settings_.window_text.empty()) own += " --window " + settings_.window_text;
        if (!settings_.view.empty()) own += " --view " + settings_.view;
        if (!settings_.light.empty()) own += " --light " + settings_.light;
        return recipe(document_, grammar, own);
    }

    void plan_drawing() {
        static_cast<DrawingOptions&>(drawing_) = drawing_options(settings_, document_);
        const bool is_solid = info(format_).kind == FormatKind::model;
        drawing_.format = format_ == PrintFormat::gif ? PrintFormat::png : is_solid ? PrintFormat::svg : format_;
        if (is_relief()) drawing_.relief = relief_options(settings_, format_);
        drawing_.dot_spacing = settings_.dot_spacing;
        if (settings_.swatch_place) take_swatch(*settings_.swatch_place);
        drawing_.threads = settings_.threads;
        drawing_.lists_contents = needs_contents(given_);
        drawing_.compression = settings_.compression.value_or(print_.style.hand > 0 ? 4 : 6);
        if (settings_.tile) drawing_.tiles = tile_options(settings_);
        static_cast<PlotSetup&>(drawing_) = plot_setup(settings_, format_);
    }

    void take_swatch(const Swatch& swatch) {
        drawing_.placement.rotate += swatch.turn;
        drawing_.window = swatch.window();
        drawing_.frame = DrawnExtent{swatch.frame};
        drawing_.stretch = settings_.swatch_stretch;
        if (swatch.has_tile_period) drawing_.tile_period = swatch.cell.sides;
        if (!swatch.is_rectangle) drawing_.cell = swatch.cell;
    }

    /// A border frames a whole print: elsewhere that of the pattern is not drawn, and a warning says why.
    void drop_border() {
        if (!print_.style.border) return;
        const char* why = settings_.swatch_place ? "a swatch is a part of the drawing"
                          : settings_.window     ? "a window shows only part of the drawing"
                          : settings_.lesson     ? "a lesson teaches the lines of the drawing"
                          : is_model()           ? "a model has no page"
                                                 : nullptr;
        if (!why) return;
        print_.style.border.reset();
        dropped_border_ = fmt::format("the border of the pattern is not drawn: {}", why);
    }

    /// Checks that the settings apply to a map.
    void check_map() const {
        constexpr const char* kolams = "applies to the lines of a turtle, and a map has none";
        if (is_model()) require_turtle(document_, "it cannot be a model");
        if (settings_.division) refuse_option("divide", "", "a .gif of a map always shows how cells divide");
        if (settings_.dots || settings_.only_dots) refuse_option("dots", "", kolams);
        if (settings_.dot_spacing) refuse_option("dot-spacing", "", kolams);
        if (settings_.colours_strokes) refuse_option("colour-by", "", kolams);
        if (settings_.lesson) refuse_option("lesson", "", kolams);
        refuse_line_work("a map has");
    }

    /// Checks that the settings apply to this drawing. @throws SettingError, PatternError
    void check_drawing() const {
        const bool is_spatial = document_.grammar().is_spatial();
        if (is_model()) require_plain("models have no hand-drawn lines; set hand to 0");
        if (is_model()) require_straight("models have straight lines, not splines; set line to straight");
        if (settings_.generations && document_.has_override("derivation length")) {
            refuse_option("generations", "", "cannot be combined with a derivation length");
        }
        const TileEdges edges = print_.style.tile_edges;
        if (settings_.kerf > 0 && edges != TileEdges::once && edges != TileEdges::border) {
            refuse_option("kerf", "", "needs 'tile-edges' once or border, which draw each edge once");
        }
        if (is_model()) refuse_line_work("a model has");
        if (settings_.division) require_plain("tiles that divide are not drawn by hand; set hand to 0");
        if (settings_.division) require_straight("tiles that divide have straight edges; set line to straight");
        if (document_.map()) check_map();
        if (!is_spatial) return;
        require_plain("drawings in space have no hand-drawn lines; set hand to 0");
        refuse_line_work("drawings in space have");
        require_straight("drawings in space have straight lines, not splines; set line to straight");
        constexpr const char* plane =
            "applies only to drawings in the plane; this one pitches, rolls, bends or has surfaces";
        const auto refuse = [](const char* option, const char* why) { refuse_option(option, "", why); };
        if (is_relief()) refuse("relief", plane);
        if (settings_.window) refuse("window", plane);
        if (settings_.dots || settings_.dot_spacing) refuse("dots", plane);
        if (settings_.border && *settings_.border != "none") refuse("border", plane);
        if (settings_.repeat) refuse("repeat", plane);
        if (settings_.title_line) refuse("title-line", plane);
        if (!settings_.edition.empty()) refuse("edition", plane);
        if (settings_.lesson) refuse("lesson", plane);
        if (settings_.colours_strokes) refuse("colour-by", plane);
        if (settings_.animation) refuse("animate", plane);
        if (settings_.division) refuse("divide", plane);
        if (settings_.tile && !is_vector(format_))
            refuse("tile", "drawings in space can be cut into sheets only as SVG, PDF or EPS");
        if (!settings_.press.spots.empty() && !drawing_.plot) {
            refuse("spot", "drawings in space have more shades of light than there are inks");
        }
    }

    void require_straight(const std::string& message) const {
        refuse_key("line", print_.style.line == Line::spline, message);
    }
    void require_plain(const std::string& message) const { refuse_key("hand", print_.style.hand > 0, message); }

    void refuse_key(const char* name, bool is_refused, const std::string& message) const {
        const Key* key = document_.pattern().find(name);
        if (!is_refused || !key) return;
        Diagnostics diagnostics;
        diagnostics.error(key->value, message);
        diagnostics.throw_if_errors();
    }

    void refuse_line_work(const char* subject) const {
        const auto refuse = [&](bool is_set, const char* feature, const char* name, const char* off) {
            const Key* key = document_.pattern().find(name);
            if (!is_set || !key) return;
            Diagnostics diagnostics;
            diagnostics.error(key->value, fmt::format("{} no {}; set {} to {}", subject, feature, name, off));
            diagnostics.throw_if_errors();
        };
        refuse(print_.style.fields.has_value(), "fields", "fields", "none");
        refuse(print_.style.weave.has_value(), "weave", "weave", "none");
        refuse(print_.style.parallel.count > 1, "parallel lines", "parallel", "1");
        refuse(print_.style.tile_colours.has_value(), "colours of tiles", "tile colours", "none");
        refuse(print_.style.decoration.is_set(), "decorated tiles", "decorate", "none");
        refuse(print_.style.tile_edges != TileEdges::each, "edges of tiles", "tile edges", "each");
    }

    void make_model(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                    Made& made);
    void make_growth(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                     Made& made);
    void make_division(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                       Made& made);
    void make_sheet(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                    const std::vector<SheetCell>& cells, Made& made);
    SheetOptions sheet_options() const;
    GrowthOptions growth_options() const {
        GrowthOptions growth;
        std::tie(growth.first, growth.last) = *settings_.generations;
        growth.seconds = settings_.frame_time.value_or(growth.seconds);
        growth.hold = settings_.hold.value_or(growth.hold);
        growth.fits_each = settings_.fit_frames;
        growth.is_animation = format_ == PrintFormat::gif;
        return growth;
    }
    DivisionOptions division_options() const {
        DivisionOptions division;
        std::tie(division.first, division.last) = divided_generations();
        division.is_gif = format_ == PrintFormat::gif;
        division.times.division = *settings_.division;
        division.times.rest = settings_.frame_time.value_or(division.times.rest);
        division.times.hold = settings_.hold.value_or(division.times.hold);
        return division;
    }
    std::vector<SheetCell> generation_cells() const;
    std::vector<SheetCell> lesson_cells(const DrawOptions& options) const;
    void make_lesson(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                     Made& made);
    void make_print(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                    Made& made);

    Document document_;
    PrintFormat format_;
    DrawSettings settings_;
    GivenOptions given_;
    Print print_;
    DrawOptions drawing_;
    std::filesystem::path folder_;
    DrawReport report_;                                       ///< of the drawing, once it is made
    std::string dropped_border_;                              ///< warning; empty: none
    std::vector<std::pair<std::string, std::string>> files_;  ///< of borders and surfaces
};

void PrintWork::make_model(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                           Made& made) {
    const ModelReport report = draw_model(document_.grammar(), print_, options, format_, name, destination);
    if (options.lists_contents) {
        const auto drawing = make_drawing(document_.grammar(), print_.style, options);
        Print print = print_;
        drawing->place(print);
        print.style = drawing->style();
        report_.contents = contents_of(*drawing, print);
    }
    made.fact(counted(report.triangles, "triangle") + ", " + counted(report.materials, "material"));
}

/// Makes an animation of several generations, or a file for each.
void PrintWork::make_growth(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                            Made& made) {
    GrowthOptions growth = growth_options();
    growth.made = [this](const Grammar& generation) { return made_with(generation); };
    const DrawReport report = draw_growth(document_.grammar(), print_, options, growth, name, destination);
    report_text(report, name, made);
    if (report.overflows) {
        made.warn("the largest generation is larger than the page within its margins and is cut off");
    }
}

/// Makes an animation in which tiles divide.
void PrintWork::make_division(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                              Made& made) {
    DrawReport report;
    try {
        report = draw_division(document_.grammar(), print_, options, division_options(), name, destination);
    } catch (const DivisionError& error) {
        refuse_option("divide", "", error.what());
    }
    if (report.overflows) made.warn("the drawing is larger than the page within its margins and is cut off");
}

std::vector<SheetCell> PrintWork::generation_cells() const {
    const auto [first, last] = *settings_.generations;
    SheetCell cell = print_cell(document_, settings_, folder_);
    cell.may_be_empty = true;
    return generations(cell, first, last);
}

/// A cell for each step; without dots, the first step is left out.
std::vector<SheetCell> PrintWork::lesson_cells(const DrawOptions& options) const {
    DrawOptions drawing = options;
    drawing.begin = nullptr;
    drawing.most_steps = most_lesson_cells;
    drawing.lesson_memo = std::make_shared<LessonMemo>();
    const LessonLength length = lesson_length(document_.grammar(), print_, drawing);
    std::vector<SheetCell> cells;
    for (std::size_t step = length.first; step < length.count; ++step) {
        SheetCell& cell = cells.emplace_back(print_cell(document_, settings_, folder_));
        cell.lesson_step = step;
        cell.most_steps = drawing.most_steps;
        cell.lesson_memo = drawing.lesson_memo;
        cell.style.border.reset();
        cell.caption = {step == 0 ? "dots" : step + 1 == length.count ? "whole" : std::to_string(step)};
    }
    return cells;
}

/// Makes a sheet of drawings side by side.
void PrintWork::make_sheet(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                           const std::vector<SheetCell>& cells, Made& made) {
    if (!print_.press.cmyk.empty()) check_cmyk_profile(print_.press.cmyk);
    SheetOptions sheet = sheet_options();
    sheet.threads = options.threads;
    sheet.monitor = options.monitor;
    sheet.watch = options.watch;
    const SheetLayout layout = draw_sheet(cells, sheet, name, destination);
    warn_of_letters(layout.missing_letters, made);
    std::vector<FaintInk> faint;
    for (const DrawReport& report : layout.reports)
        faint.insert(faint.end(), report.faint.begin(), report.faint.end());
    warn_of_faint_inks(faint, made);
}

void PrintWork::make_lesson(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                            Made& made) {
    const Style& style = print_.style;
    if (style.ground && style.ground->alpha == 255 && is_faint(style.line_colour({}), *style.ground)) {
        made.warn(faint_text({FaintInk::Kind::lines, style.line_colour({}), *style.ground}));
    }
    if (info(format_).kind == FormatKind::pixels)
        return make_sheet(destination, name, options, lesson_cells(options), made);
    LessonOptions lesson;
    lesson.seconds = *settings_.lesson * 2 / 3;
    lesson.pause = *settings_.lesson / 3;
    lesson.hold = settings_.hold.value_or(lesson.hold);
    const DrawReport report = draw_lesson(document_.grammar(), print_, options, lesson, name, destination);
    if (report.dots == 0) made.warn("the lesson has no page of dots, because the lines enclose none");
    if (report.overflows) made.warn("the drawing is larger than the page within its margins and is cut off");
}

void PrintWork::make_print(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                           Made& made) {
    // Before the drawing, which may take long.
    if (!print_.press.cmyk.empty()) check_cmyk_profile(print_.press.cmyk);
    report_ = draw(document_.grammar(), print_, options, name, destination);
    const DrawReport& report = report_;
    report_text(report, name, made);
    std::vector<std::string> texts = {options.title_line, options.edition, report.sheets > 1 ? print_.title : ""};
    for (const LabelText& label : document_.grammar().labels()) {
        for (const LabelText::Part& part : label.parts) texts.push_back(part.text);
    }
    warn_of_letters(missing_letters(texts), made);
    warn_of_faint_inks(report.faint, made);
    if (report.copies > 0) {
        made.fact(fmt::format("{}: {}, {}", settings_.repeat->group,
                              report.copies == 1 ? "1 copy" : fmt::format("{} copies", report.copies),
                              counted(report.strokes.value_or(0), "line")));
    }
    constexpr double half = 0.55, most = 0.7;
    if (report.copies > 0 && report.covered > 0 && report.covered < half && report.covered_by_moves > most) {
        made.fact(
            fmt::format("the copies cover only {:.0f} % of {}, whose units have another shape than the drawing; "
                        "p1 covers {:.0f} %",
                        100 * report.covered, settings_.repeat->group, 100 * report.covered_by_moves));
    }
    for (const std::string& warning : drawing_warnings(report, print_.style, settings_, report.plot.has_value())) {
        made.warn(warning);
    }
    if (format_ == PrintFormat::eps && has_translucent_colours(print_.style)) {
        made.warn("an EPS has no opacity: translucent colours are mixed with that of the ground, or with white");
    }
    if (settings_.kerf > 0 && print_.style.tile_edges == TileEdges::once) {
        made.warn(fmt::format(
            "neighbours share their cuts, so that each tile loses {:g} mm along its inner edges; pieces that keep "
            "their size have to be laid apart, as on cutting sheets",
            settings_.kerf / 2));
    }
    if (document_.map()) {
        const std::string remark = undivided_remark(report.cells, *document_.map(), document_.grammar().steps());
        if (!remark.empty()) made.warn(remark);
    }
    if (report.crosses_itself) {
        made.warn("the outline crosses itself, so that parts of the map overlap: a smaller 'growth' prevents that");
    }
    if (report.is_empty) {
        made.warn("the window contains no part of the drawing");
    } else if (report.is_blank) {
        made.warn(fmt::format(
            "the picture looks empty: lines {:.2g} mm wide leave too little ink on pixels of {:.2g} mm; use {} or a "
            "shorter derivation",
            print_.style.line_width({}, report.step), 25.4 / print_.dpi,
            print_.style.stroke.in_steps ? "a pen in millimetres (stroke: 0.3mm)" : "a wider pen (stroke: 0.5mm)"));
    }
    if (report.relief) report_relief(*report.relief, made);
    if (report.plot) report_plot(*report.plot, settings_.speeds, settings_.pen_rules, made);
    if (report.plot && settings_.hatch && report.plot->fills == 0 && report.fields == 0) {
        made.warn("'hatch' has no effect: this drawing has no fills");
    }
    if (!report.is_empty) warn_of_no_tiles(report.polygons, settings_, made);
    if (report.plot && format_ == PrintFormat::hpgl) report_hpgl(*report.plot, settings_, options.hpgl, made);
    if (report.sheets > 0) report_sheets(report, made);
    if (settings_.swatch_place) report_swatch(*settings_.swatch_place, print_, settings_.swatch_stretch, made);
    if (settings_.fills_page) made.fact(fmt::format("derivation length {}", document_.grammar().steps()));
    if (report.overflows && report.sheets == 0 && !settings_.swatch_place) {
        made.warn(fmt::format(
            "the drawing is {:.1f} x {:.1f} mm, but the page has room for {:.1f} x {:.1f}: the rest is cut off",
            report.size.x, report.size.y, report.room.x, report.room.y));
    }
}

/// Labels with characters that are drawn as boxes.
void warn_of_letters(const Grammar& grammar, Made& made) {
    for (const LabelText& label : grammar.labels()) {
        if (std::all_of(label.parts.begin(), label.parts.end(),
                        [](const LabelText::Part& part) { return has_letters(part.text); })) {
            continue;
        }
        made.warn(fmt::format("the label of '{}' has characters that the lettering font lacks: boxes replace them",
                              label.letter));
    }
}

Made PrintWork::make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                     int threads) try {
    Made made;
    if (!dropped_border_.empty()) made.warn(dropped_border_);
    warn_of_letters(document_.grammar(), made);
    DrawOptions options = drawing_;
    if (threads > 0) options.threads = threads;
    options.monitor = monitor;
    options.watch = [&](std::uint64_t symbols) { monitor.advance(symbols); };
    const auto& tables = document_.grammar().tables();
    if (settings_.generations && !document_.map() &&
        std::all_of(tables.begin(), tables.end(), [](const Table& table) { return table.productions().empty(); })) {
        made.warn("'generations' has no effect: the pattern has no productions");
    }
    options.begin = [&](int passes) { monitor.expect(passes * expected_symbols(document_.grammar(), true)); };
    if (is_model()) {
        make_model(destination, name, options, made);
    } else if (settings_.division) {
        make_division(destination, name, options, made);
    } else if (is_growth()) {
        make_growth(destination, name, options, made);
    } else if (settings_.lesson) {
        make_lesson(destination, name, options, made);
    } else if (settings_.generations) {
        make_sheet(destination, name, options, generation_cells(), made);
    } else {
        make_print(destination, name, options, made);
    }
    const bool is_spatial = document_.grammar().is_spatial();
    for (const std::string& text : space_warnings(settings_, is_spatial, format_)) made.warn(text);
    if (is_spatial && needs_contents(given_)) report_.contents = contents_in_space(document_.grammar());
    for (const std::string& text : unused_options(given_, settings_, print_.style, format_, is_spatial, report_)) {
        made.warn(text);
    }
    return made;
} catch (const NothingDrawn& error) {
    throw std::runtime_error(error.what() + undrawn_hint(document_.grammar()));
}

DrawnPixels PrintWork::make_pixels(const Monitor& monitor) {
    const char* const why = "makes several pictures or sheets; only one picture can be drawn in memory";
    if (settings_.generations) refuse_option("generations", "", why);
    if (settings_.tile) refuse_option("tile", "", why);
    if (settings_.lesson) refuse_option("lesson", "", why);
    constexpr std::size_t bytes_of_pixel = 4;
    DrawnPixels pixels;
    drawing_.show_pixels = [&](Rendering& rendering, const PixelSize& size) {
        pixels.width = size.width;
        pixels.height = size.height;
        pixels.bytes.resize(bytes_of_pixel * static_cast<std::size_t>(size.width) *
                            static_cast<std::size_t>(size.height));
        const auto channels = static_cast<std::size_t>(rendering.channels());
        std::uint8_t* to = pixels.bytes.data();
        rendering.watch([&] { monitor.check(); });
        rendering.render(drawing_.threads, [&](int, int, std::span<const std::uint8_t> rows) {
            for (std::size_t i = 0; i < rows.size(); i += channels, to += bytes_of_pixel) {
                const std::uint8_t* from = &rows[i];
                to[0] = from[0];
                to[1] = from[channels < 3 ? 0 : 1];
                to[2] = from[channels < 3 ? 0 : 2];
                to[3] = channels == bytes_of_pixel ? from[3] : 255;
            }
        });
    };
    MemoryDestination nowhere;
    pixels.remarks = make(nowhere, "pixels", monitor, drawing_.threads).remarks;
    return pixels;
}

SheetOptions PrintWork::sheet_options() const {
    SheetOptions sheet;
    sheet.format = drawing_.format;
    sheet.page = print_.page;
    sheet.dpi = print_.dpi;
    sheet.title = print_.title;
    sheet.animation = print_.animation;
    sheet.names_tiles = print_.names_tiles;
    sheet.press = print_.press;
    // Captions are short, and are read from the same distance as the drawings.
    sheet.letters = std::clamp(std::min(print_.page.width, print_.page.height) * 0.016, 2.0, 12.0);
    sheet.inset = 0.055;
    sheet.pattern = print_.pattern;
    sheet.made = print_.made;
    sheet.compression = drawing_.compression;
    return sheet;
}

Cost PrintWork::forecast() const {
    const Grammar grammar = shorten(document_.grammar());
    if (is_model() || is_relief()) return solid_cost(grammar, print_, drawing_, format_);
    if (settings_.division) return division_cost(grammar, print_, drawing_, division_options());
    if (is_growth()) return growth_cost(grammar, print_, drawing_, growth_options());
    if (settings_.lesson) return lesson_cost(grammar, print_, drawing_, format_ == PrintFormat::gif);
    if (settings_.generations) return sheet_cost(generation_cells(), sheet_options());
    return print_cost(grammar, print_, drawing_);
}

/// Sets the window of the settings to a place of a tiling that covers the page. Returns the document with the
/// derivation length that it takes. @throws SettingError if there is none
Document fill_page(const Document& document, DrawSettings& settings) {
    constexpr double steps_across = 40;
    const Page& page = settings.page;
    const double step = settings.step.value_or(std::min(page.width, page.height) / steps_across);
    const Document styled = settings.keys.empty() ? document : document.with(settings.keys);
    if (styled.grammar().is_spatial() || styled.grammar().map()) {
        refuse_option("fill-page", "", "applies only to tilings in the plane");
    }
    DrawOptions options;
    options.budget = settings.budget;
    std::string why;
    const glm::dvec2 size = (glm::dvec2(page.width, page.height) - 2 * page.margin) / step;
    const double around = (page.margin + settings.press.bleed) / step;
    const auto found =
        find_filled_page(styled.grammar(), read_print_style(document, settings), size, around, options, why);
    if (!found) refuse_option("fill-page", "", why);
    settings.step.reset();
    settings.window = found->window;
    return document.with({Setting{"fill-page", "derivation length", std::to_string(found->steps)}});
}

/// Sets the page and the place of the settings to the repeating part of a tiling. Returns the document with the
/// derivation length it needs. @throws SettingError if there is none
Document take_swatch(const Document& document, DrawSettings& settings, PrintFormat format) {
    constexpr double steps_across = 40, most_millimetres = 10'000;
    Page& page = settings.page;
    const double step = settings.step.value_or(std::min(page.width, page.height) / steps_across);
    const Document styled = settings.keys.empty() ? document : document.with(settings.keys);
    DrawOptions options;
    static_cast<DrawingOptions&>(options) = drawing_options(settings, document);
    try {
        settings.swatch_place = find_swatch(styled.grammar(), read_print_style(styled, settings), options,
                                            settings.swatch == SwatchChoice::turned);
    } catch (const SwatchError& error) {
        refuse_option("swatch", "", error.what());
    }
    const Swatch& swatch = *settings.swatch_place;
    const glm::dvec2 size = (swatch.frame.high - swatch.frame.low) * step;
    if (!(std::max(size.x, size.y) <= most_millimetres)) {
        refuse_option("swatch", "",
                      fmt::format("the part that repeats would be {:.3g} x {:.3g} m", size.x / 1000, size.y / 1000));
    }
    settings.step = step;
    page = {size.x, size.y, 0};
    if (!is_vector(format) && info(format).kind != FormatKind::model) {
        const PixelSize pixels = pixel_size(page, settings.dpi);
        page = {pixels.width * 25.4 / settings.dpi, pixels.height * 25.4 / settings.dpi, 0};
        settings.swatch_stretch = glm::dvec2(page.width, page.height) / size;
    }
    check_draw_settings(settings, format);
    return document.with({Setting{"swatch", "derivation length", std::to_string(swatch.steps)}});
}

/// Unless `values` names a resolution, the longer side of a .gif has 640 pixels: at 300 dpi, an animation of A4 would
/// take ten minutes.
OptionValues with_resolution(const OptionValues& values, PrintFormat format) {
    const auto is_dpi = [](const OptionValue& value) { return value.name == "dpi"; };
    if (format != PrintFormat::gif || std::any_of(values.begin(), values.end(), is_dpi)) return values;
    const Page page = read_draw_settings(values).page;
    const double dpi = 640 * 25.4 / std::max(page.width, page.height);
    OptionValues result = values;
    result.push_back({"dpi", fmt::format("{}", std::clamp(dpi, 1.0, 300.0))});
    return result;
}

/// @throws SettingError, PatternError
std::unique_ptr<PrintWork> plan_print(const Document& document, PrintFormat format, const OptionValues& values,
                                      const std::filesystem::path& folder = {}) {
    DrawSettings settings = read_draw_settings(with_resolution(values, format), &folder);
    if (!settings.press.cmyk.empty()) settings.press.cmyk = folder / settings.press.cmyk;
    check_draw_settings(settings, format);
    GivenOptions given = given_options(values, document.source().text());
    if (settings.swatch != SwatchChoice::none) {
        const Document longer = take_swatch(document, settings, format);
        return std::make_unique<PrintWork>(longer, format, std::move(settings), std::move(given), folder);
    }
    if (settings.fills_page) {
        const Document longer = fill_page(document, settings);
        return std::make_unique<PrintWork>(longer, format, std::move(settings), std::move(given), folder);
    }
    return std::make_unique<PrintWork>(document, format, std::move(settings), std::move(given), folder);
}

class Prints : public Interpreter {
public:
    Prints() {
        for (const FormatInfo& row : print_formats()) {
            // An OBJ has its materials beside it.
            const bool is_several = row.kind == FormatKind::animation || row.format == PrintFormat::obj;
            formats_.push_back({row.extension, row.label, row.alias, is_several, row.is_text});
        }
        for (const Option<DrawSettings>& row : draw_options()) options_.push_back(&row.info);
    }
    KeyOwner owner() const override { return KeyOwner::art; }
    void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const override {
        read_style(pattern, 96, diagnostics);  // errors do not depend on the resolution
    }
    std::span<const FormatName> formats() const override { return formats_; }
    std::span<const OptionInfo* const> options() const override { return options_; }
    void check(std::string_view format, const OptionValues& values) const override {
        const PrintFormat named = known(format);
        check_draw_settings(read_draw_settings(with_resolution(values, named)), named);
    }
    std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues& values,
                               const std::filesystem::path& folder) const override {
        return plan_print(document, known(format), values, folder);
    }

private:
    static PrintFormat known(std::string_view format) {
        if (const auto found = named_format(format)) return *found;
        refuse_option("format", std::string(format), "unknown format");
    }
    std::vector<FormatName> formats_;
    std::vector<const OptionInfo*> options_;
};

}  // namespace

const Interpreter& prints() {
    static const Prints interpreter;
    return interpreter;
}

std::string draw(const Document& document, std::string_view format, const OptionValues& values,
                 const Monitor& monitor) {
    return make_in_memory(prints(), document, format, values, monitor);
}

DrawnPixels draw_pixels(const Document& document, const OptionValues& values, const Monitor& monitor) {
    const Assignment assigned = assign(prints(), document, values);
    return plan_print(assigned.document, PrintFormat::png, assigned.options)->make_pixels(monitor);
}

}  // namespace sikku
