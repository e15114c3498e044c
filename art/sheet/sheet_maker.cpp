#include "art/sheet/sheet_maker.h"

#include "art/drawing/faint_inks.h"
#include "art/sheet/sheet_cells.h"
#include "art/writer/colouring.h"
#include "art/writer/make_drawing.h"
#include "engine/base/option.h"
#include "engine/base/text.h"
#include "engine/base/threads.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

constexpr double fitted_side = 190.0;    // millimetres of an A4 page within its margins, for which pens are meant
constexpr double border_margin = 0.045;  // space around a cell's border, as part of the cell's shorter side
constexpr double finest_line = 0.1;      // millimetres that every printer can print
constexpr double widest_line = 0.035;    // as part of a cell, for early generations, whose steps are long
constexpr double line_pitch = 1.75;      // distance of lines of text, as part of the height of their capitals
constexpr double small_letters = 0.78;   // height of a caption's later lines, as part of its first
constexpr double stem = 0.085;           // stem of letters, as part of their height
constexpr double title_stem = 0.055;

Pen text_pen(double width, bool pale) {
    return {.width = width, .width_set = true, .colour = pale ? 1 : 0};
}

}  // namespace

SheetMaker::SheetMaker(const std::vector<SheetCell>& cells, const SheetOptions& options)
    : cells_(cells), options_(options), letters_(options.font) {
    if (cells.empty()) throw SettingError("", "", "a sheet needs at least one drawing");
    if (options_.format != PrintFormat::pdf) {
        // Only PDF has a separate box for the bleed.
        const double bleed = std::exchange(options_.press.bleed, 0.0);
        options_.page.width += 2 * bleed;
        options_.page.height += 2 * bleed;
        options_.page.margin += bleed;
    }
    static_cast<WriterOptions&>(print_) = options_;
    print_.title = options.title;
    print_.pattern = options.pattern;
    print_.made = options.made;
    print_.style.ground = options.ground;
    print_.style.floor = options.floor;
    print_.style.stroke = {1.0, false, 1.0};
    print_.style.palette = {options.ink, options.pale_ink};
    // Text is laid out in millimetres.
    print_.placement.to_page[1].y = -1.0;
    print_.placement.step = 1.0;
    if (options_.format != PrintFormat::pdf) print_ = as_picture(print_);
    options_.ground = print_.style.ground;
    measure();
}

std::vector<DrawReport> SheetMaker::reports() const {
    std::vector<DrawReport> all(subjects_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        subjects_[i].drawing->report(all[i]);
        all[i].regions = regions_[i];
        // Lessons draw over pale lines.
        const bool is_seen = !options_.plot && !is_for_plotters(options_.format) && !cells_[i].lesson_step;
        if (is_seen) all[i].faint = faint_inks(*subjects_[i].drawing, plan_.cells[i].print);
    }
    return all;
}

std::string SheetMaker::missing() const {
    std::vector<std::string> texts;
    for (const TextLine& line : plan_.texts) texts.push_back(line.text);
    return letters_.missing(texts);
}

/// Measures the drawings in parallel.
void SheetMaker::measure() {
    subjects_.resize(cells_.size());
    std::size_t row = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (i > 0 && !cells_[i].heading.empty()) ++row;
        subjects_[i].row = row;
    }
    for_each_index(cells_.size(), [&](std::size_t i) {
        const SheetCell& cell = cells_[i];
        named_cell(cell, [&] {
            DrawOptions drawing = cell_options(cell, options_);
            if (options_.watch) drawing.watch = [this](std::uint64_t symbols) { watch(symbols); };
            Subject& subject = subjects_[i];
            const Grammar grammar = shorten(*cell.grammar);
            subject.cost =
                drawing_cost(grammar, cell_print(cell, options_, cells_.size()), drawing, drawing.reading());
            subject.drawing = make_drawing(grammar, cell.style, drawing);
            subject.extent = cell.may_be_empty ? subject.drawing->seen() : subject.drawing->extent();
            if (cell.frame) subject.extent = *cell.frame;
            if (subject.extent.box.empty()) subject.extent.box = {glm::dvec2(0.0), glm::dvec2(0.0)};
            const Box& box = subject.extent.box;
            subject.size = box.high - box.low;
        });
    });
    std::vector<double> shapes;
    for (const Subject& subject : subjects_) {
        const double least = std::max(1e-9, 0.05 * std::max(subject.size.x, subject.size.y));
        shapes.push_back(std::max(subject.size.y, least) / std::max(subject.size.x, least));
    }
    // Rather too high than too low: a wide drawing leaves room above and below, which looks good.
    const auto at = shapes.begin() + static_cast<std::ptrdiff_t>((shapes.size() - 1) * 6 / 10);
    std::nth_element(shapes.begin(), at, shapes.end());
    usual_shape_ = *at;
}

/// All possible arrangements.
std::vector<SheetMaker::Grid> SheetMaker::grids() const {
    std::vector<int> groups;
    for (const Subject& subject : subjects_) {
        if (groups.size() <= subject.row) groups.push_back(0);
        ++groups[subject.row];
    }
    const bool headed =
        std::any_of(cells_.begin(), cells_.end(), [](const SheetCell& cell) { return !cell.heading.empty(); });
    const int longest = *std::max_element(groups.begin(), groups.end());
    int from = 1, to = std::min(longest, 1000);
    if (options_.columns > 0) {
        from = to = std::min(options_.columns, longest);
    }
    std::vector<Grid> result;
    for (int columns = from; columns <= to; ++columns) {
        Grid grid{columns, {}, {}};
        for (const int group : groups) {
            // Rows differ by at most one cell, with longer rows first, so that no cell stands alone below full rows.
            const int rows = (group + columns - 1) / columns;
            for (int row = 0; row < rows; ++row) {
                grid.headed.push_back(headed && row == 0);
                grid.rows.push_back(group / rows + (row < group % rows ? 1 : 0));
            }
        }
        // As few columns as that number of rows allows: the last row is then as full as possible.
        if (result.empty() || result.back().rows.size() != grid.rows.size()) result.push_back(std::move(grid));
    }
    return result;
}

double SheetMaker::letters_of(double width) const {
    return options_.letters ? *options_.letters : std::clamp(width * 0.036, 0.9, 7.0);
}

/// Height of the longest caption and its distance from the cell.
double SheetMaker::caption_height(double width, double letters) const {
    double most = 0;
    for (const SheetCell& cell : cells_) {
        double height = 0;
        std::size_t lines = 0;
        for (std::size_t i = 0; i < cell.caption.size() && lines < options_.caption_lines; ++i) {
            const double size = i == 0 ? letters : small_letters * letters;
            const auto parts =
                letters_.wrapped(cell.caption[i], size, width, i == 0 ? 2 : options_.caption_lines - lines);
            lines += parts.size();
            height += static_cast<double>(parts.size()) * size * line_pitch;
        }
        if (lines > 0) height += letters * 0.4;
        most = std::max(most, height);
    }
    return most;
}

SheetMaker::Measures SheetMaker::measures(const Grid& grid) const {
    constexpr double gap_share = 0.1;
    constexpr double shape_slack = 1.12;
    const Page& page = options_.page;
    const double width = page.width - 2 * page.margin, height = page.height - 2 * page.margin;
    const double shorter = std::min(page.width, page.height);
    Measures m;
    const double columns = grid.columns, rows = static_cast<double>(grid.rows.size());
    m.width = options_.gap ? (width - (columns - 1) * *options_.gap) / columns
                           : width / (columns + (columns - 1) * gap_share);
    if (columns == 1 && !options_.gap) m.width = width;
    if (!(m.width > 0)) return {};
    const double gap = options_.gap ? *options_.gap : std::min(gap_share * m.width, 0.04 * shorter);
    const double title = sheet_title_height(options_.page);
    if (!options_.title.empty()) m.title = title * (options_.subtitle.empty() ? sheet_title_room : 3.1);
    const auto headings = static_cast<double>(std::count(grid.headed.begin(), grid.headed.end(), true));
    // Cells are about as high as their drawings; the remaining space widens the gaps, or stays free on both sides.
    const double shape = std::clamp(usual_shape_, 0.6, 1.7);
    const double full = m.width;
    // A narrower cell has more lines below it, which leave less height: narrows it until its caption fits.
    for (bool has_room = false; !has_room;) {
        m.letters = letters_of(m.width);
        if (headings > 0) m.heading = m.letters * 1.35 * 2.1;
        m.caption = std::max(m.caption, caption_height(m.width, m.letters));
        // Only the margin is kept free under the last captions.
        const double room = height - m.title - headings * m.heading - rows * m.caption - (rows - 1) * gap;
        m.height = std::min(room / rows, full * shape * shape_slack);
        m.width = std::min(m.width, m.height / shape * shape_slack);
        if (!m.fits()) return m;
        m.letters = letters_of(m.width);
        has_room = caption_height(m.width, m.letters) <= m.caption;
    }
    m.across = m.width + (columns > 1 ? (columns * full + (columns - 1) * (width - columns * full) / (columns - 1) -
                                         columns * m.width) /
                                            (columns - 1)
                                      : 0.0);
    // A gap wider than a third of a cell would tear the sheet apart.
    m.across = std::min(m.across, m.width + std::max(gap, 0.35 * m.width));
    const double spare = height - m.title - headings * m.heading - rows * (m.caption + m.height);
    const double pitch_gap = rows > 1 ? std::min(spare / (rows - 1), std::max(1.6 * gap, gap + 0.2 * m.height)) : 0;
    m.down = m.height + m.caption + pitch_gap;
    if (options_.gap) {
        m.across = m.width + gap;
        m.down = m.height + m.caption + gap;
        m.first.x = page.margin + (width - (columns - 1) * m.across - m.width) / 2;
        m.first.y = page.margin + m.title + std::max(0.0, spare - (rows - 1) * gap) * (m.title > 0 ? 0.3 : 0.5);
        return m;
    }
    m.first.x = page.margin + (width - (columns - 1) * m.across - m.width) / 2;
    m.first.y = page.margin + m.title + std::max(0.0, spare - (rows - 1) * pitch_gap) * (m.title > 0 ? 0.3 : 0.5);
    return m;
}

/// Millimetres of a step of a drawing that is fitted into a cell.
double SheetMaker::drawn_step(const Subject& subject, double width, double height, double factor) const {
    const Style& style = cells_[static_cast<std::size_t>(&subject - subjects_.data())].style;
    const double widest = subject.extent.widest;
    Page page{width, height, options_.inset * std::min(width, height)};
    const double border = subject.drawing->border_space(page);
    if (border > 0) page.margin = border + border_margin * std::min(width, height);
    page.height -= subject.drawing->text_space(page).total();
    const double ink_steps = style.stroke.in_steps ? widest / 2 : 0;
    const double ink_millimetres = style.stroke.in_steps ? 0 : widest / 2 * factor;
    PlacementOptions fitted = subject.drawing->placement();
    fitted.step.reset();
    fitted.scale = std::min(1.0, subject.drawing->scale());
    return place(subject.extent.box, page, fitted, ink_steps, ink_millimetres).step;
}

/// Factor of the widths of pens, compared with a page of their own.
double SheetMaker::pen_factor(const SheetCell& cell, double width, double height) const {
    const double side = (1 - 2 * options_.inset) * std::min(width, height);
    const double factor = side / fitted_side;
    const double pen = cell.style.stroke.value;
    if (cell.style.stroke.in_steps || !(pen > 0)) return factor;
    if (cell.colouring.value_or(0) > 0) return 1;  // its lines have a least width
    return std::max(factor, std::min(1.0, finest_line / pen));
}

/// The area of all drawings, or a negative number if they do not fit.
double SheetMaker::score(const Grid& grid) const {
    const Measures m = measures(grid);
    if (!m.fits()) return -1;
    double area = 0;
    for (const Subject& subject : subjects_) {
        const double step =
            std::min(m.width / std::max(subject.size.x, 1e-9), m.height / std::max(subject.size.y, 1e-9));
        area += step * step * std::max(subject.size.x, 0.05 * subject.size.y) *
                std::max(subject.size.y, 0.05 * subject.size.x);
    }
    return area;
}

void SheetMaker::write_caption(const SheetCell& cell, const Window& window, double letters) {
    double y = window.top + window.height + letters * 0.4;
    std::size_t lines = 0;
    for (std::size_t i = 0; i < cell.caption.size() && lines < options_.caption_lines; ++i) {
        const double height = i == 0 ? letters : small_letters * letters;
        for (std::string& line :
             letters_.wrapped(cell.caption[i], height, window.width, i == 0 ? 2 : options_.caption_lines - lines)) {
            y += height * line_pitch;
            const double left = aligned(line, height, window.left, window.width);
            plan_.texts.push_back({std::move(line), {left, y}, height, text_pen(stem * height, i > 0)});
            ++lines;
        }
    }
}

const SheetLayout& SheetMaker::arrange() {
    const auto has_slot = [](const SheetCell& cell) { return cell.slot.has_value(); };
    if (std::all_of(cells_.begin(), cells_.end(), has_slot)) {
        arrange_slots();
    } else if (std::none_of(cells_.begin(), cells_.end(), has_slot)) {
        arrange_rows();
    } else {
        const auto missing = std::find_if_not(cells_.begin(), cells_.end(), has_slot);
        throw SettingError(
            "", "",
            fmt::format("'{}' has no place on the sheet; if one drawing has a place, all need one", missing->title));
    }
    write_footer();
    place_drawings();
    check_colouring();
    check_inks();
    return plan_.layout;
}

/// Puts each cell into its slot.
void SheetMaker::arrange_slots() {
    plan_.layout.columns = static_cast<int>(cells_.size());
    plan_.layout.rows = 1;
    write_title(options_.page.margin);
    for (const SheetCell& given : cells_) {
        PlacedCell cell;
        cell.window = *given.slot;
        cell.window.margin = border_margin * std::min(cell.window.width, cell.window.height);
        plan_.layout.letters = letters_of(cell.window.width);
        write_caption(given, cell.window, plan_.layout.letters);
        plan_.layout.windows.push_back(cell.window);
        plan_.cells.push_back(std::move(cell));
        const auto overlaps = [&](const PlacedCell& other) {
            const Window &a = other.window, &b = plan_.cells.back().window;
            return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
                   b.top < a.top + a.height;
        };
        const auto last = plan_.cells.end() - 1;
        const auto found = std::find_if(plan_.cells.begin(), last, overlaps);
        if (is_vector(options_.format) || found == last) continue;
        throw SettingError(
            "", "",
            fmt::format("the places of '{}' and '{}' overlap; in pictures each has its own ground",
                        cells_[static_cast<std::size_t>(found - plan_.cells.begin())].title, given.title));
    }
}

void SheetMaker::arrange_rows() {
    const std::vector<Grid> all = grids();
    const Grid* best = nullptr;
    double most = 0;
    for (const Grid& grid : all) {
        options_.monitor.check();
        const double area = score(grid);
        if (area > most * (1 + 1e-9)) {
            most = area;
            best = &grid;
        }
    }
    if (!best) {
        throw SettingError("", "",
                           fmt::format("{} with their captions do not fit on a sheet of {:g} x {:g} mm",
                                       counted(cells_.size(), "drawing"), options_.page.width, options_.page.height));
    }
    const Measures m = measures(*best);
    lay_out(*best, m);
}

/// Lays out texts and cells, without their drawings.
void SheetMaker::lay_out(const Grid& grid, const Measures& m) {
    const Page& page = options_.page;
    write_title(m.first.x);
    plan_.layout.columns = grid.columns;
    plan_.layout.rows = static_cast<int>(grid.rows.size());
    plan_.layout.letters = m.letters;
    double top = m.first.y;
    std::size_t next = 0;
    for (std::size_t row = 0; row < grid.rows.size(); ++row) {
        if (grid.headed[row]) {
            const double height = m.letters * 1.35;
            plan_.texts.push_back(
                {letters_.shortened(cells_[next].heading, height, page.width - page.margin - m.first.x),
                 {m.first.x, top + height},
                 height,
                 text_pen(title_stem * 1.3 * height, false)});
            top += m.heading;
        }
        // Rows under a heading begin below it, others stand in the middle.
        const bool is_headed = std::find(grid.headed.begin(), grid.headed.end(), true) != grid.headed.end();
        const double indent = is_headed ? 0.0 : (grid.columns - grid.rows[row]) * m.across / 2;
        for (int column = 0; column < grid.rows[row]; ++column, ++next) {
            PlacedCell cell;
            cell.window = {m.first.x + indent + column * m.across,     top, m.width, m.height, false,
                           border_margin * std::min(m.width, m.height)};
            cell.row = static_cast<int>(row);
            write_caption(cells_[next], cell.window, m.letters);
            plan_.layout.windows.push_back(cell.window);
            plan_.cells.push_back(std::move(cell));
        }
        top += m.down;
    }
}

/// Writes the title above all cells.
void SheetMaker::write_title(double left) {
    const Page& page = options_.page;
    if (!options_.title.empty()) {
        const double room = page.width - 2 * page.margin;
        double height = sheet_title_height(page);
        height = std::min(height, height * room / letters_.width(options_.title, height));
        const auto begin = [&](const std::string& text, double size) {
            return options_.is_centred ? aligned(text, size, page.margin, room) : left;
        };
        plan_.texts.push_back({options_.title,
                               {begin(options_.title, height), page.margin + height},
                               height,
                               text_pen(title_stem * height, false)});
        const double small = height * 0.36;
        std::string subtitle = letters_.shortened(options_.subtitle, small, room);
        const double subtitle_left = begin(subtitle, small);
        plan_.texts.push_back({std::move(subtitle),
                               {subtitle_left, page.margin + height + small * 2.4},
                               small,
                               text_pen(stem * small, true)});
    }
}

/// Writes the line in the bottom margin.
void SheetMaker::write_footer() {
    if (options_.footer.empty()) return;
    constexpr double most_letters = 3.0, share = 0.3;
    const Page& page = options_.page;
    double height = std::min(most_letters, share * page.margin);
    double width = letters_.width(options_.footer, height);
    // A long line has smaller letters.
    const double room = page.width - 2 * page.margin;
    if (width > room && room > 0) {
        height *= room / width;
        width = letters_.width(options_.footer, height);
    }
    const double left = (page.width - width) / 2;
    plan_.texts.push_back({options_.footer,
                           {left, page.height - 0.5 * page.margin + height / 2},
                           height,
                           text_pen(stem * height, true)});
}

/// The unit that drawings of one scale share, in steps of each: the distance between dots if all in a row have them,
/// else the step.
std::vector<double> SheetMaker::shared_units() const {
    std::vector<char> have_dots;
    for (const Subject& subject : subjects_) {
        if (have_dots.size() <= subject.row) have_dots.push_back(1);
        if (!(subject.drawing->dot_distance() > 0)) have_dots.back() = 0;
    }
    std::vector<double> units;
    for (const Subject& subject : subjects_) {
        units.push_back(have_dots[subject.row] ? subject.drawing->dot_distance() : 1.0);
    }
    return units;
}

/// Places the drawings in their cells.
void SheetMaker::place_drawings() {
    const std::vector<double> units = shared_units();
    std::vector<double> steps(cells_.size()), least;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        named_cell(cells_[i], [&] {
            const Window& window = plan_.cells[i].window;
            const std::optional<double> fixed = subjects_[i].drawing->fixed_step();
            steps[i] = fixed ? *fixed
                             : drawn_step(subjects_[i], window.width, window.height,
                                          pen_factor(cells_[i], window.width, window.height));
        });
        const double unit = steps[i] * units[i];
        if (least.size() <= subjects_[i].row) least.push_back(unit);
        least.back() = std::min(least.back(), unit);
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        PlacedCell& cell = plan_.cells[i];
        Print& print = cell.print;
        const double width = cell.window.width, height = cell.window.height;
        const double factor = pen_factor(cells_[i], width, height);
        print.style = subjects_[i].drawing->style();
        print.title = cells_[i].title;
        print.dpi = options_.dpi;
        print.page = {width, height, 0.0};
        PlacementOptions placement = subjects_[i].drawing->placement();
        placement.step = options_.same_scale ? least[subjects_[i].row] / units[i] : steps[i];
        const TextSpace text = subjects_[i].drawing->text_space(print.page);
        print.page.height -= text.total();
        print.placement = place(subjects_[i].extent.box, print.page, placement, 0.0, 0.0);
        print.placement.to_page[2] += glm::dvec2(cell.window.left, cell.window.top + text.above);
        print.page = options_.page;
        const double widest = subjects_[i].extent.widest;
        double pen = widest * (print.style.stroke.in_steps ? *placement.step : factor);
        double thinner = print.style.stroke.in_steps ? 1.0 : factor;
        const double widest_pen = widest_line * std::min(width, height);
        if (print.style.stroke.in_steps && pen > widest_pen) {
            thinner = widest_pen / pen;
            pen = widest_pen;
        }
        print.style.stroke.value *= thinner;
        print.style.stroke.unit *= thinner;
        if (print.style.dots && print.style.dots->size && !print.style.dots->size->in_steps) {
            print.style.dots->size->value *= factor;
        }
        const glm::dvec2 size = subjects_[i].size * *placement.step + pen;
        const bool is_filled = cells_[i].repeat && cells_[i].repeat->fills;
        cell.window.clips = cells_[i].window || is_filled || size.x > width || size.y > height;
        print.press = options_.press;
        if (options_.format != PrintFormat::pdf) print = as_picture(print);
    }
}

/// Measures the regions of colouring pages, and fills their specks. @throws SettingError if one is too small
void SheetMaker::check_colouring() {
    regions_.resize(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (!cells_[i].colouring) continue;
        named_cell(cells_[i], [&] {
            const Window& window = plan_.cells[i].window;
            Print print = plan_.cells[i].print;
            print.page = {window.width, window.height, 0.0};
            print.placement.to_page[2] -= glm::dvec2(window.left, window.top);
            const Grammar grammar = shorten(*cells_[i].grammar);
            DrawOptions options = cell_options(cells_[i], options_);
            ColouringCheck check = check_regions(grammar, cells_[i].style, options, print, options_.page);
            regions_[i] = check.regions;
            if (check.specks.empty()) return;
            options.specks = std::move(check.specks);
            subjects_[i].drawing = make_drawing(grammar, cells_[i].style, options);
        });
    }
}

/// Checks the spot colours. @throws std::runtime_error if one does not occur in any cell
void SheetMaker::check_inks() const {
    Style all = print_.style;
    for (const PlacedCell& cell : plan_.cells) {
        const Style& style = cell.print.style;
        if (style.ground) all.palette.push_back(*style.ground);
        for (int i = 0; i < static_cast<int>(style.palette.size()); ++i) {
            if (style.stroked) all.palette.push_back(style.line_colour(Pen{.colour = i}));
            all.palette.push_back(style.fill_colour(Pen{.colour = i}));
        }
    }
    check_spots(options_.press, all);
}

}  // namespace sikku
