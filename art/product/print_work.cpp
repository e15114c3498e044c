#include "art/product/print_work.h"

#include "art/drawing/drawing.h"
#include "art/drawing/word_drawing.h"
#include "art/product/border_files.h"
#include "art/product/highlight.h"
#include "art/product/plot_remarks.h"
#include "art/writer/picture.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lettering.h"
#include "engine/language/surface.h"
#include "engine/language/undrawn.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {

PrintWork::PrintWork(PrintRequest request)
    : document_(request.settings.keys.empty() ? request.document : request.document.with(request.settings.keys)),
      format_(request.format),
      settings_(std::move(request.settings)),
      given_(std::move(request.given)),
      folder_(std::move(request.folder)) {
    print_.style = read_print_style(document_, settings_);
    static_cast<WriterOptions&>(print_) = settings_.paper;
    print_.title = request.document.text("title");
    print_.pattern = request.document.source().text();
    print_.made = recipe(document_, given_.recipe);
    plan_drawing();
    check_drawing();
    drop_border();
    drop_floor();
    load_border(print_.style, document_, settings_, folder_, drawing_,
                [this](const std::string& name, const std::string& text) { files_.emplace_back(name, text); });
    drawing_.font = load_font(settings_.look.font_name, folder_);
    for (const auto& surface : request.document.grammar().surfaces()) {
        if (surface->source) files_.emplace_back(surface->source->name(), surface->source->text());
    }
}

void PrintWork::plan_drawing() {
    static_cast<DrawingOptions&>(drawing_) = drawing_options(settings_, document_);
    const bool is_solid = info(format_).kind == FormatKind::model;
    drawing_.format = format_ == PrintFormat::gif ? PrintFormat::png : is_solid ? PrintFormat::svg : format_;
    if (is_relief(settings_, format_)) drawing_.relief = relief_options(settings_, format_);
    drawing_.budget = settings_.work.budget;
    if (settings_.place.swatch_place) place_swatch(*settings_.place.swatch_place);
    static_cast<PictureOptions&>(drawing_) = settings_.work;
    if (!drawing_.compression) drawing_.compression = usual_compression(print_.style);
    drawing_.lists_contents = needs_contents(given_);
    if (settings_.paper.tile) drawing_.tiles = tile_options(settings_);
    static_cast<PlotSetup&>(drawing_) = plot_setup(settings_, format_);
}

void PrintWork::place_swatch(const Swatch& swatch) {
    drawing_.placement.rotate += swatch.turn;
    drawing_.window = swatch.window();
    drawing_.frame = DrawnExtent{swatch.frame};
    drawing_.stretch = settings_.place.swatch_stretch;
    if (swatch.has_tile_period) drawing_.tile_period = swatch.cell.sides;
    if (!swatch.is_rectangle) drawing_.cell = swatch.cell;
}

/// A border frames a whole print: elsewhere that of the pattern is not drawn, and a warning says why.
void PrintWork::drop_border() {
    if (!print_.style.border) return;
    const char* why = settings_.place.swatch_place   ? "a swatch is a part of the drawing"
                      : settings_.place.fills_page   ? "a filled page shows only part of the drawing"
                      : settings_.look.window        ? "a window shows only part of the drawing"
                      : settings_.time.lesson        ? "a lesson teaches the lines of the drawing"
                      : is_model(settings_, format_) ? "a model has no page"
                                                     : nullptr;
    if (!why) return;
    print_.style.border.reset();
    dropped_.push_back(fmt::format("the border of the pattern is not drawn: {}", why));
}

/// A floor is the ground of pictures in the plane: elsewhere its mean colour is, and a warning says why.
void PrintWork::drop_floor() {
    const FormatKind kind = info(format_).kind;
    if (!print_.style.floor || (kind != FormatKind::pixels && kind != FormatKind::animation)) return;
    const char* why = settings_.place.swatch_place       ? "a swatch repeats, and the floor does not"
                      : kind == FormatKind::animation    ? "an animation has too few colours for its texture"
                      : document_.grammar().is_spatial() ? "drawings in space stand on a plain ground"
                                                         : nullptr;
    if (!why) return;
    print_.style.floor.reset();
    dropped_.push_back(fmt::format("the floor is drawn in its mean colour: {}", why));
}

/// Checks that the settings apply to this drawing. @throws SettingError, PatternError
void PrintWork::check_drawing() const {
    if (settings_.time.generations && document_.has_override("derivation length")) {
        refuse_option("generations", "", "cannot be combined with a derivation length");
    }
    const TileEdges edges = print_.style.tile_edges;
    if (settings_.look.kerf > 0 && edges != TileEdges::once && edges != TileEdges::border) {
        refuse_option("kerf", "", "needs 'tile-edges' once or border, which draw each edge once");
    }
    if (document_.map()) {
        check_map_settings(settings_);
        refuse_line_work("a map has");
    }
    if (!document_.grammar().is_spatial()) return;
    require_plain("drawings in space have no hand-drawn lines; set hand to 0");
    refuse_line_work("drawings in space have");
    require_straight("drawings in space have straight lines, not splines; set line to straight");
    check_space_settings(settings_, format_);
}

void PrintWork::require_straight(const std::string& message) const {
    if (print_.style.line == Line::spline) refuse_key("line", message);
}

void PrintWork::require_plain(const std::string& message) const {
    if (print_.style.hand > 0) refuse_key("hand", message);
}

/// Keys that the pattern does not have are options, which have been checked.
void PrintWork::refuse_key(const char* name, const std::string& message) const {
    const Key* key = document_.pattern().find(name);
    if (!key) return;
    Diagnostics diagnostics;
    diagnostics.error(key->value, message);
    diagnostics.throw_if_errors();
}

void PrintWork::refuse_line_work(const char* subject) const {
    const auto refuse = [&](bool is_set, const char* feature, const char* name, const char* off) {
        if (is_set) refuse_key(name, fmt::format("{} no {}; set {} to {}", subject, feature, name, off));
    };
    refuse(print_.style.fields.has_value(), "fields", "fields", "none");
    refuse(print_.style.weave.has_value(), "weave", "weave", "none");
    refuse(print_.style.parallel.count > 1, "parallel lines", "parallel", "1");
    refuse(print_.style.tile_colours.has_value(), "colours of tiles", "tile colours", "none");
    refuse(print_.style.decoration.is_set(), "decorated tiles", "decorate", "none");
    refuse(print_.style.tile_edges != TileEdges::each, "edges of tiles", "tile edges", "each");
}

namespace {

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

/// Filled pages and swatches determine their own derivation length, which is the last that the document was given.
void warn_of_length(const Document& document, const DrawSettings& settings, Made& made) {
    const bool is_swatch = settings.place.swatch_place.has_value();
    if (!settings.place.fills_page && !is_swatch) return;
    const char* option = is_swatch ? "swatch" : "fill-page";
    for (const Setting& setting : document.overrides().settings) {
        if (setting.key != "derivation length" || setting.origin == option) continue;
        made.warn(
            fmt::format("the derivation length {} is not used: '{}' determines its own", setting.value, option));
    }
}

}  // namespace

Made PrintWork::make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                     int threads) try {
    Made made;
    for (const std::string& warning : dropped_) made.warn(warning);
    warn_of_letters(document_.grammar(), made);
    warn_of_length(document_, settings_, made);
    if (!no_steps().empty()) made.warn(no_steps());
    DrawOptions options = drawing_;
    if (threads > 0) options.threads = threads;
    options.monitor = monitor;
    options.watch = [&](std::uint64_t symbols) { monitor.advance(symbols); };
    const auto& tables = document_.grammar().tables();
    if (settings_.time.generations && !document_.map() &&
        std::all_of(tables.begin(), tables.end(), [](const Table& table) { return table.productions().empty(); })) {
        made.warn_of_unused("generations", "the pattern has no productions");
    }
    if (settings_.look.highlight) light_up(monitor, made);
    options.begin = [&](int passes) { monitor.expect(passes * expected_symbols(document_.grammar(), true)); };
    make_product(destination, name, options, made);
    const bool is_spatial = document_.grammar().is_spatial();
    for (const std::string& text : space_warnings(settings_, is_spatial, format_)) made.warn(text);
    if (is_spatial && needs_contents(given_)) report.contents = contents_in_space(document_.grammar());
    warn_of_unused(given_, settings_, print_.style, format_, is_spatial, report, made);
    return made;
} catch (const NothingDrawn& error) {
    throw std::runtime_error(error.what() +
                             (no_steps().empty() ? undrawn_hint(document_.grammar()) : "; " + no_steps()));
}

void PrintWork::light_up(const Monitor& monitor, Made& made) {
    LitDrawing lit =
        lit_drawing(document_.grammar(), print_.style, *settings_.look.highlight, settings_.work.budget, monitor);
    lit_ = std::move(lit.grammar);
    print_.style = std::move(lit.style);
    made.fact(std::move(lit.fact));
}

void PrintWork::pass_pixels(std::function<void(Rendering& rendering, const PixelSize& size)> receive) {
    const char* const why = "makes several pictures or sheets; only one picture can be drawn in memory";
    if (settings_.time.generations) refuse_option("generations", "", why);
    if (settings_.paper.tile) refuse_option("tile", "", why);
    if (settings_.time.lesson) refuse_option("lesson", "", why);
    drawing_.show_pixels = std::move(receive);
}

void report_text(const DrawReport& report, const std::filesystem::path& name, Made& made) {
    if (!report.leaves_pattern_out) return;
    made.warn(
        fmt::format("{} does not contain the text of the pattern, which is longer than 60,000 bytes", name.string()));
}

void report_overflow(const DrawReport& report, Made& made) {
    if (report.overflows) made.warn("the drawing is larger than the page within its margins and is cut off");
}

}  // namespace sikku
