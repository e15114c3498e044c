#include "art/sheets.h"

#include "art/font/letters.h"
#include "art/image/image_file.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "art/product/plot_remarks.h"
#include "art/product/print_cell.h"
#include "art/sheet/sheet.h"
#include "art/style/length.h"
#include "art/writer/picture.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <utility>

namespace sikku {
namespace {

enum class Titles { none, title, caption };

struct SheetSettings {
    double dpi = 300.0;
    int columns = 0;
    std::optional<double> gutter;
    Titles titles = Titles::none;
    bool same_scale = false;
    std::string heading, subheading;
    std::optional<Colour> ground;
    bool has_ground = false;
};

/// Place of a drawing on the sheet, in millimetres.
struct PlaceSettings {
    double dpi = 300.0;
    std::optional<double> x, y, width, height;
    std::optional<std::string> title;
};

double length(const char* option, const std::string& text, double dpi, double least) {
    const auto value = parse_length(text, dpi);
    if (!value || !(*value >= least && *value <= 10'000)) {
        refuse_option(option, text,
                      fmt::format("expected a length {}, at most 10 m",
                                  least > 0 ? "of at least 1mm" : "such as 20mm, 0 or more"));
    }
    return *value;
}

using P = PlaceSettings;
using Text = const std::string&;
using enum OptionKind;

const std::array sheet_rows = {
    Option<SheetSettings>{{.name = "columns",
                           .help = "number of columns (the number for which the drawings are largest)",
                           .value = "N",
                           .kind = whole,
                           .least = 1,
                           .most = 1000},
                          [](SheetSettings& s, Text t) { s.columns = static_cast<int>(to_number(t)); }},
    Option<SheetSettings>{
        {.name = "gutter", .help = "space between the drawings (about a tenth of their width)", .value = "LENGTH"},
        [](SheetSettings& s, Text t) { s.gutter = length("gutter", t, s.dpi, 0); }},
    Option<SheetSettings>{
        {.name = "titles",
         .help = "text below each drawing: none, its title, or a caption with its productions (none)",
         .value = "none|title|caption"},
        [](SheetSettings& s, Text t) {
            const std::array<std::pair<const char*, Titles>, 3> known = {
                {{"none", Titles::none}, {"title", Titles::title}, {"caption", Titles::caption}}};
            for (const auto& [name, titles] : known) {
                if (t == name) return void(s.titles = titles);
            }
            refuse_option("titles", t, "expected none, title or caption");
        }},
    Option<SheetSettings>{
        {.name = "same-scale",
         .help =
             "draw all at one scale, at which the largest fills its place, instead of each as large as fits: with "
             "one distance between dots if all have dots, otherwise with one step length",
         .kind = flag},
        [](SheetSettings& s, Text t) { s.same_scale = t == "true"; }},
    Option<SheetSettings>{{.name = "heading", .help = "title of the sheet, above the drawings", .value = "TEXT"},
                          [](SheetSettings& s, Text t) { s.heading = t; }},
    Option<SheetSettings>{{.name = "subheading", .help = "smaller line below the heading", .value = "TEXT"},
                          [](SheetSettings& s, Text t) { s.subheading = t; }},
    Option<SheetSettings>{
        {.name = "sheet-ground",
         .help =
             "colour between the drawings, or none (the ground of the drawings if they share one, otherwise paper)",
         .value = "COLOUR"},
        [](SheetSettings& s, Text t) {
            s.has_ground = true;
            if (lower_case(trimmed(t)) == "none") return;
            s.ground = parse_colour(trimmed(t));
            if (!s.ground) refuse_option("sheet-ground", t, "expected a colour such as navy or #8c3b2a, or none");
        }},
};

const std::array place_rows = {
    Option<P>{{.name = "x", .help = "distance of its place from the left edge of the sheet", .value = "LENGTH"},
              [](P& p, Text t) { p.x = length("x", t, p.dpi, 0); }},
    Option<P>{{.name = "y", .help = "distance of its place from the top edge", .value = "LENGTH"},
              [](P& p, Text t) { p.y = length("y", t, p.dpi, 0); }},
    Option<P>{{.name = "width", .help = "width of its place (up to the right margin)", .value = "LENGTH"},
              [](P& p, Text t) { p.width = length("width", t, p.dpi, 1); }},
    Option<P>{{.name = "height", .help = "height of its place (up to the bottom margin)", .value = "LENGTH"},
              [](P& p, Text t) { p.height = length("height", t, p.dpi, 1); }},
    Option<P>{{.name = "title", .help = "title of the drawing, instead of the pattern's", .value = "TEXT"},
              [](P& p, Text t) { p.title = t; }},
};

template <typename Rows>
std::vector<const OptionInfo*> infos(const Rows& rows) {
    std::vector<const OptionInfo*> list;
    for (const auto& row : rows) list.push_back(&row.info);
    return list;
}

/// Values of the options in a table; the rest stays.
OptionValues take(OptionValues& values, std::span<const OptionInfo* const> table) {
    OptionValues taken;
    for (const OptionValue& value : values) {
        if (find_option(table, value.name)) taken.push_back(value);
    }
    std::erase_if(values, [&](const OptionValue& value) { return find_option(table, value.name); });
    return taken;
}

/// Options of prints that a sheet cannot have.
void refuse_alone(const OptionValues& values) {
    for (const OptionValue& value : values) {
        const OptionInfo* option = find_option(prints().options(), value.name);
        if (!option) continue;
        const char* why = option->scope == Scope::sheets   ? "a sheet of several drawings cannot be cut into tiles"
                          : option->scope == Scope::lesson ? "a lesson has pages of its own; draw makes it"
                          : value.name == "rule"           ? "a sheet shows words; draw shows productions"
                          : option->scope == Scope::time   ? "a sheet shows one derivation length of each drawing"
                          : value.name == "window"         ? "a place on a sheet shows a whole drawing"
                                                           : nullptr;
        if (why) refuse_option(value.name, "", why);
    }
}

/// Title, grid, and the description up to its first semicolon: productions of kolams are long words.
std::vector<std::string> kolam_caption(const Document& document, const std::string& title, const std::string& grid) {
    std::vector<std::string> caption = {title};
    // A shape is too long for a caption.
    constexpr std::size_t most = 40;
    if (!grid.empty() && grid.size() <= most && title.find(grid) == std::string::npos) caption.push_back(grid);
    const std::string description = document.text("description");
    if (!description.empty()) caption.push_back(description.substr(0, description.find(';')));
    return caption;
}

/// Settings that the sheet and its prints share.
struct Shared {
    SheetSettings sheet;
    DrawSettings print;
    OptionValues cells;  ///< options of each drawing, without the font
    std::string font;    ///< font of all texts; empty: single strokes
};

/// Takes the font out of options.
std::string take_font(OptionValues& values) {
    std::string font;
    for (const OptionValue& value : values) {
        if (value.name != "font") continue;
        if (value.text.empty()) refuse_option("font", "", "expected the name of an installed font, or a file");
        font = value.text;
    }
    std::erase_if(values, [](const OptionValue& value) { return value.name == "font"; });
    return font;
}

bool has_option(const OptionValues& values, std::initializer_list<std::string_view> names) {
    return std::any_of(values.begin(), values.end(), [&](const OptionValue& value) {
        return std::find(names.begin(), names.end(), value.name) != names.end();
    });
}

/// @param folder  of the file that describes a plotter; null: it is not read
Shared read_shared(OptionValues values, const std::filesystem::path* folder = nullptr) {
    Shared shared;
    refuse_alone(values);
    const OptionValues own = take(values, sheet_options());
    OptionValues wide;
    for (OptionValue& value : values) (is_sheet_wide(value.name) ? wide : shared.cells).push_back(value);
    check_names(prints().options(), shared.cells);
    shared.font = take_font(shared.cells);
    shared.print = read_draw_settings(wide, folder);
    shared.sheet.dpi = shared.print.paper.dpi;
    apply_options(std::span<const Option<SheetSettings>>(sheet_rows), own, shared.sheet);
    return shared;
}

PrintFormat known_format(std::string_view name) {
    const auto format = named_format(name);
    if (!format || info(*format).kind == FormatKind::animation || info(*format).kind == FormatKind::model) {
        throw SettingError("", "",
                           fmt::format("a sheet is SVG, PDF, a picture, HP-GL, G-code or DXF, not .{}", name));
    }
    return *format;
}

/// A planned sheet.
class SheetWork : public Work {
public:
    SheetWork(const std::vector<SheetItem>& items, std::string_view format, const OptionValues& values,
              const std::filesystem::path& folder)
        : format_(known_format(format)), shared_(read_shared(values, &folder)) {
        if (items.empty()) throw SettingError("", "", "a sheet needs at least one drawing");
        DrawSettings& print = shared_.print;
        if (!print.paper.press.cmyk.empty()) print.paper.press.cmyk = folder / print.paper.press.cmyk;
        check_draw_settings(print, format_);
        for (const SheetItem& item : items) add_named_cell(item, folder);
        set_options(items);
        set_font(folder);
    }

    Cost forecast() const override { return sheet_cost(cells_, options_); }

    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override {
        if (!options_.press.cmyk.empty()) check_cmyk_profile(options_.press.cmyk);
        SheetOptions options = options_;
        if (threads > 0) options.threads = threads;
        options.monitor = monitor;
        options.watch = [&](std::uint64_t symbols) { monitor.advance(symbols); };
        Made made;
        const SheetLayout layout = draw_sheet(cells_, options, name, destination);
        if (layout.plot) report_plot(*layout.plot, shared_.print.plot.speeds, shared_.print.plot.pen_rules, made);
        if (layout.plot && format_ == PrintFormat::hpgl) {
            report_hpgl(*layout.plot, shared_.print, options_.hpgl, made);
        }
        report_drawings(layout, made);
        return made;
    }

private:
    /// Warns once of each thing, with the titles of the drawings that it concerns.
    void report_drawings(const SheetLayout& layout, Made& made) const {
        std::vector<std::pair<std::string, std::string>> warnings;  // with titles
        const auto warn = [&](const std::string& text, const std::string& title) {
            const auto found =
                std::find_if(warnings.begin(), warnings.end(), [&](const auto& one) { return one.first == text; });
            if (found == warnings.end()) {
                warnings.emplace_back(text, fmt::format("'{}'", title));
            } else {
                found->second += fmt::format(", '{}'", title);
            }
        };
        bool has_fields = false;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const SheetCell& cell = cells_[i];
            const DrawReport& report = layout.reports[i];
            has_fields = has_fields || report.fields > 0;
            const bool fills_page = cell.repeat && cell.repeat->fills;
            const std::string missing = Letters(cell.font).missing({cell.title_line.value_or(""), cell.edition});
            if (!missing.empty()) warn(missing, cell.title);
            if (layout.windows[i].clips && !fills_page) warn("larger than its place and cut off", cell.title);
            for (const std::string& text :
                 drawing_warnings(report, cell.style, settings_[i], layout.plot.has_value()))
                warn(text, cell.title);
            for (const FaintInk& ink : report.faint) warn(faint_text(ink), cell.title);
            for (const std::string& text : space_warnings(settings_[i], cell.grammar->is_spatial(), format_)) {
                warn(text, cell.title);
            }
        }
        warn_of_letters(layout.letters_warning, made);
        for (const auto& [text, titles] : warnings) made.warn(fmt::format("{}: {}", titles, text));
        if (layout.plot && shared_.print.plot.hatch && layout.plot->fills == 0 && !has_fields) {
            made.warn_of_unused("hatch", "these drawings have no fills");
        }
        warn_of_no_tiles(layout.polygons, shared_.print, made);
    }

    /// add_cell(), whose errors name the drawing.
    void add_named_cell(const SheetItem& item, const std::filesystem::path& folder) {
        try {
            add_cell(item, folder);
        } catch (const SettingError& error) {
            const std::string name = std::filesystem::path(item.document.source().name()).filename().string();
            throw SettingError(error.option(), error.value(),
                               fmt::format("{} (drawing '{}')", error.message(), name));
        }
    }

    void add_cell(const SheetItem& item, const std::filesystem::path& folder) {
        OptionValues own = item.values;
        PlaceSettings place;
        place.dpi = shared_.print.paper.dpi;
        apply_options(std::span<const Option<P>>(place_rows), take(own, place_options()), place);
        refuse_alone(own);
        for (const OptionValue& value : own) {
            if (is_sheet_wide(value.name)) {
                refuse_option(value.name, value.text, "applies to the whole sheet, not to one drawing");
            }
        }
        Assignment assigned = assign(prints(), item.document, own);
        OptionValues values = shared_.cells;
        std::erase_if(values, [&](const OptionValue& value) {
            return std::any_of(assigned.options.begin(), assigned.options.end(),
                               [&](const OptionValue& other) { return other.name == value.name; });
        });
        values.insert(values.end(), assigned.options.begin(), assigned.options.end());
        values.push_back({"dpi", fmt::format("{}", shared_.print.paper.dpi)});
        if (!shared_.font.empty() && !has_option(values, {"font"}) && has_option(values, {"title-line", "edition"})) {
            values.push_back({"font", shared_.font});
        }
        const DrawSettings settings = read_draw_settings(values);
        check_draw_settings(settings, format_);
        const Document document = settings.keys.empty() ? assigned.document : assigned.document.with(settings.keys);
        SheetCell cell = print_cell(document, settings, folder, shared_font(settings.look.font_name, folder));
        const std::string grid(kolam_comment(document.source().text(), "grid"));
        if (cell.title.empty()) cell.title = std::filesystem::path(document.source().name()).stem().string();
        if ((cell.title.empty() || cell.title == "-") && !grid.empty()) cell.title = grid;
        if (const std::string& variant = document.overrides().variant; !variant.empty()) cell.title += ", " + variant;
        if (place.title) cell.title = *place.title;
        if (shared_.sheet.titles == Titles::title || (place.title && shared_.sheet.titles == Titles::none)) {
            cell.caption = {cell.title};
        } else if (shared_.sheet.titles == Titles::caption) {
            cell.caption = grid.empty() && cell.grammar->steps() > 0
                               ? caption_of(*cell.grammar, cell.title, document.pattern())
                               : kolam_caption(document, cell.title, grid);
        }
        set_slot(place, cell);
        cells_.push_back(std::move(cell));
        settings_.push_back(settings);
        settings_.back().plot.hatch = shared_.print.plot.hatch;
    }

    void set_slot(const PlaceSettings& place, SheetCell& cell) const {
        if (!place.x && !place.y) {
            if (place.width) refuse_option("width", "", "needs 'x' and 'y'");
            if (place.height) refuse_option("height", "", "needs 'x' and 'y'");
            return;
        }
        const Page& page = shared_.print.paper.page;
        Window slot;
        slot.left = place.x.value_or(page.margin);
        slot.top = place.y.value_or(page.margin);
        slot.width = place.width.value_or(page.width - page.margin - slot.left);
        slot.height = place.height.value_or(page.height - page.margin - slot.top);
        if (!(slot.width >= 1 && slot.height >= 1 && slot.left + slot.width <= page.width + 1e-9 &&
              slot.top + slot.height <= page.height + 1e-9)) {
            throw SettingError(place.x ? "x" : "y", "",
                               fmt::format("the place of '{}' does not lie on the sheet of {:g} x {:g} mm",
                                           cell.title, page.width, page.height));
        }
        cell.slot = slot;
    }

    void set_options(const std::vector<SheetItem>& items) {
        const DrawSettings& print = shared_.print;
        options_.is_centred = true;
        options_.format = format_;
        static_cast<WriterOptions&>(options_) = print.paper;
        static_cast<PictureOptions&>(options_) = print.work;
        options_.title = shared_.sheet.heading;
        options_.subtitle = shared_.sheet.subheading;
        options_.columns = shared_.sheet.columns;
        options_.gap = shared_.sheet.gutter;
        options_.same_scale = shared_.sheet.same_scale;
        if (!options_.compression) {
            for (const SheetCell& cell : cells_) {
                const auto usual = usual_compression(cell.style);
                options_.compression = std::min(usual, options_.compression.value_or(usual));
            }
        }
        const bool is_one = std::all_of(items.begin(), items.end(), [&](const SheetItem& item) {
            return item.document.source().text() == items.front().document.source().text();
        });
        // Several patterns are not one.
        if (is_one) options_.pattern = items.front().document.source().text();
        options_.made = fmt::format("sikku {}, sheet of {}", SIKKU_VERSION, counted(items.size(), "drawing"));
        set_ground();
        static_cast<PlotSetup&>(options_) = plot_setup(print, format_);
    }

    void set_font(const std::filesystem::path& folder) {
        const bool is_used =
            !options_.title.empty() || std::any_of(cells_.begin(), cells_.end(), [](const auto& cell) {
                return cell.title_line || !cell.edition.empty() || !cell.caption.empty();
            });
        if (!shared_.font.empty() && !is_used) {
            refuse_option("font", "", "needs 'titles', 'heading', 'title-line' or 'edition'");
        }
        options_.font = shared_font(shared_.font, folder);
    }

    /// Opens a font once for all texts. @param name  empty: single strokes
    std::shared_ptr<const Font> shared_font(const std::string& name, const std::filesystem::path& folder) {
        std::shared_ptr<const Font>& font = fonts_[name];
        if (!font) font = load_font(name, folder);
        return font;
    }

    /// One ground under all drawings if they share it; texts stand out from it.
    void set_ground() {
        const Style& first = cells_.front().style;
        const bool is_shared = std::all_of(cells_.begin(), cells_.end(), [&](const SheetCell& cell) {
            return cell.style.ground == first.ground && cell.style.floor == first.floor;
        });
        if (shared_.sheet.has_ground) {
            options_.ground = shared_.sheet.ground;
        } else if (is_shared) {
            options_.ground = first.ground;
            options_.floor = first.floor;
        }
        if (options_.ground && options_.ground->alpha > 0 && lightness(*options_.ground) < 0.6) {
            options_.ink = {0xff, 0xfa, 0xf0, 255};
            options_.pale_ink = {0xe6, 0xd8, 0xc8, 255};
        }
    }

    PrintFormat format_;
    Shared shared_;
    std::vector<SheetCell> cells_;
    std::vector<DrawSettings> settings_;                        ///< of the drawings
    std::map<std::string, std::shared_ptr<const Font>> fonts_;  ///< by their names
    SheetOptions options_;
};

}  // namespace

std::span<const OptionInfo* const> sheet_options() {
    static const std::vector<const OptionInfo*> table = infos(sheet_rows);
    return table;
}

std::span<const OptionInfo* const> place_options() {
    static const std::vector<const OptionInfo*> table = infos(place_rows);
    return table;
}

bool is_sheet_wide(std::string_view option) {
    const OptionInfo* row = find_option(prints().options(), option);
    if (!row) return false;
    switch (row->scope) {
        case Scope::page:
        case Scope::file:
        case Scope::plot:
        case Scope::strokes:
        case Scope::pens:
        case Scope::gcode:
        case Scope::hpgl:
        case Scope::machine:
        case Scope::press:
        case Scope::trim:
        case Scope::pixels:
        case Scope::threads:
            return true;
        default:
            return false;
    }
}

void check_sheet(std::string_view format, const OptionValues& values) {
    const Shared shared = read_shared(values);
    check_draw_settings(shared.print, known_format(format));
    check_draw_settings(read_draw_settings(shared.cells), known_format(format));
}

std::unique_ptr<Work> plan_sheet(const std::vector<SheetItem>& items, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder) {
    return std::make_unique<SheetWork>(items, format, values, folder);
}

}  // namespace sikku
