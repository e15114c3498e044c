#include "art/print/tiles.h"

#include "art/style/white_paper.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr double arm = 4.0;     // millimetres, half of a cross
constexpr double letter = 2.5;  // millimetres
constexpr double least_letter = 1.2;
constexpr double halo_width = 0.7;  // millimetres added to the width of lines
constexpr double ink_width = 0.2;
constexpr int most_sheets = 400;

/// A row of sheets along one axis.
struct Row {
    int count = 0;
    double first = 0;  ///< beginning of the part that the first sheet shows
};

/// @param length  length of the page, including `margin` on both sides, which may remain off the sheets
Row row_of(double length, double margin, double room, double overlap) {
    const double inner = length - 2 * margin;
    const double count = std::max(1.0, std::ceil((inner - room) / (room - overlap) - 1e-9) + 1);
    const double all = room + (count - 1) * (room - overlap);
    return {static_cast<int>(std::min(count, 1e6)), (length - all) / 2};
}

/// Draws a thin line over a wide one in the paper's colour, so that it is visible on any drawing.
void draw_mark(glm::dvec2 from, glm::dvec2 to, double width, PathSink& sink) {
    for (const Pen& pen : {Pen{width + halo_width, true, 0}, Pen{width, true, 1}}) {
        sink.begin_stroke({from.x, -from.y}, pen);
        const std::array<glm::dvec2, 1> end = {glm::dvec2(to.x, -to.y)};
        sink.lines(end);
        sink.end_stroke(false);
    }
}

/// Rotates text to read upwards, around its starting point.
class Upwards : public PathSink {
public:
    Upwards(PathSink& sink, glm::dvec2 start) : sink_(sink), start_(start) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(turned(start), pen); }
    void lines(std::span<const glm::dvec2> ends) override { sink_.lines(all(ends)); }
    void curves(std::span<const glm::dvec2> controls) override { sink_.curves(all(controls)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(pen); }
    void end_stroke(bool closed) override { sink_.end_stroke(closed); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}

private:
    glm::dvec2 turned(glm::dvec2 point) const {
        const glm::dvec2 way = point - start_;
        return start_ + glm::dvec2(-way.y, way.x);
    }
    std::span<const glm::dvec2> all(std::span<const glm::dvec2> points) {
        points_.clear();
        for (const glm::dvec2 point : points) points_.push_back(turned(point));
        return points_;
    }
    PathSink& sink_;
    glm::dvec2 start_;
    std::vector<glm::dvec2> points_;
};

/// Writes on blank paper. @param start  y down
void write_plain(const std::string& text, glm::dvec2 start, double height, PathSink& sink) {
    write_text(text, {start.x, -start.y}, height, Pen{0.09 * height, true, 2}, sink);
}

/// Writes over the print, with a halo. @param start  y down
void write_mark(const std::string& text, glm::dvec2 start, double height, bool upwards, PathSink& sink) {
    const glm::dvec2 from(start.x, -start.y);
    Upwards turned(sink, from);
    PathSink& letters = upwards ? turned : sink;
    for (const Pen& pen : {Pen{0.45 * height + halo_width, true, 0}, Pen{0.1 * height, true, 1}}) {
        write_text(text, from, height, pen, letters);
    }
}

/// Writes the sheet's number into a strip that is cut off or covered by a neighbour, otherwise into the margin.
void write_number(const Tiling& tiling, const Tile& tile, const std::string& title, PathSink& sink) {
    const glm::dvec2 corner = tile_corner(tiling, tile);
    const Window& area = tile.area;
    const double strip = tiling.overlap / 2;
    const double height = std::min(letter, 0.55 * strip);
    const std::string number = fmt::format("{}-{}", tile.row, tile.column);
    const auto text = [&](double size, double room) {
        const double rest = room - text_width(" " + number, size);
        return title.empty() || rest <= 0 ? number : shortened(title, size, rest) + " " + number;
    };
    const glm::dvec2 at = glm::dvec2(area.left, area.top) - corner;
    const double inset = 2 * arm + strip;
    if (height < least_letter || (tiling.rows == 1 && tiling.columns == 1)) {
        const double size = std::min(letter, 0.6 * tiling.sheet.margin);
        if (size < least_letter) return;
        return write_plain(text(size, area.width - 2 * inset),
                           at + glm::dvec2(inset, area.height + 0.8 * tiling.sheet.margin), size, sink);
    }
    const double base = (strip + height) / 2;
    if (tile.row < tiling.rows || tile.row > 1) {
        const double y = tile.row < tiling.rows ? area.height - strip + base : base;
        return write_mark(text(height, area.width - 2 * inset), at + glm::dvec2(inset, y), height, false, sink);
    }
    const double x = tile.column < tiling.columns ? area.width - strip + base : base;
    write_mark(text(height, area.height - 2 * inset), at + glm::dvec2(x, area.height - inset), height, true, sink);
}

}  // namespace

Tiling tiling_of(const Page& page, const TileOptions& options) {
    Tiling best;
    double least = 0;
    for (const bool is_turned : {false, true}) {
        Tiling tiling;
        tiling.sheet = options.sheet;
        tiling.overlap = options.overlap;
        if (is_turned) std::swap(tiling.sheet.width, tiling.sheet.height);
        const glm::dvec2 room = glm::dvec2(tiling.sheet.width, tiling.sheet.height) - 2 * tiling.sheet.margin;
        if (!(options.overlap >= 0 && options.overlap < std::min(room.x, room.y))) {
            throw std::runtime_error(
                fmt::format("sheets of {:g} x {:g} mm within their margins are too small for an overlap "
                            "of {:g} mm",
                            room.x, room.y, options.overlap));
        }
        const Row across = row_of(page.width, page.margin, room.x, options.overlap);
        const Row down = row_of(page.height, page.margin, room.y, options.overlap);
        const double count = static_cast<double>(across.count) * down.count;
        if (is_turned && count >= least) break;
        least = count;
        tiling.columns = across.count;
        tiling.rows = down.count;
        if (count > most_sheets) {
            best = tiling;
            continue;
        }
        // Returns an interval of the page that the sheets show.
        const auto part = [](double from, double to, double length) {
            return glm::dvec2(std::clamp(from, 0.0, length), std::clamp(to, 0.0, length));
        };
        const double half = options.overlap / 2;
        const glm::dvec2 way = room - options.overlap;
        for (int row = 0; row < down.count; ++row) {
            for (int column = 0; column < across.count; ++column) {
                const double x = across.first + column * way.x, y = down.first + row * way.y;
                const glm::dvec2 shown_x = part(x, x + room.x, page.width);
                const glm::dvec2 shown_y = part(y, y + room.y, page.height);
                const glm::dvec2 cut_x(column > 0 ? x + half : shown_x.x,
                                       column + 1 < across.count ? x + room.x - half : shown_x.y);
                const glm::dvec2 cut_y(row > 0 ? y + half : shown_y.x,
                                       row + 1 < down.count ? y + room.y - half : shown_y.y);
                const auto window = [](glm::dvec2 of_x, glm::dvec2 of_y) {
                    return Window{of_x.x, of_y.x, of_x.y - of_x.x, of_y.y - of_y.x, true};
                };
                tiling.tiles.push_back({row + 1, column + 1, window({x, x + room.x}, {y, y + room.y}),
                                        window(shown_x, shown_y), window(cut_x, cut_y)});
            }
        }
        best = std::move(tiling);
    }
    if (least > most_sheets) {
        throw std::runtime_error(fmt::format("{:.0f} sheets: expected at most {}", least, most_sheets));
    }
    return best;
}

std::filesystem::path tile_file(const std::filesystem::path& file, const Tile& tile) {
    std::filesystem::path named = file;
    named.replace_filename(
        fmt::format("{}-{}-{}{}", file.stem().string(), tile.row, tile.column, file.extension().string()));
    return named;
}

glm::dvec2 tile_corner(const Tiling& tiling, const Tile& tile) {
    return {tile.area.left - tiling.sheet.margin, tile.area.top - tiling.sheet.margin};
}

Print mark_print(const Page& page, double dpi, const std::optional<Colour>& ground) {
    Print print;
    print.page = page;
    print.dpi = dpi;
    print.title = "marks";
    const Colour halo = ground_or_white(ground);
    const Colour ink = lightness(halo) < 0.6 ? Colour{255, 255, 255, 255} : Colour{0, 0, 0, 255};
    print.style.palette = {{halo.red, halo.green, halo.blue, 255}, ink, {0x20, 0x20, 0x20, 255}};
    print.style.stroke = {1.0, false, 1.0};
    print.placement.to_page[1].y = -1.0;
    return print;
}

void draw_tile_marks(const Tiling& tiling, const Tile& tile, const std::string& title, PathSink& sink) {
    const glm::dvec2 corner = tile_corner(tiling, tile);
    const Window& area = tile.area;
    const glm::dvec2 low = glm::dvec2(area.left, area.top), high = low + glm::dvec2(area.width, area.height);
    const Window& cut = tile.cut;
    for (const double x : {cut.left, cut.left + cut.width}) {
        for (const double y : {cut.top, cut.top + cut.height}) {
            const auto within = [&](double dx, double dy) {
                return glm::clamp(glm::dvec2(x + dx, y + dy), low, high) - corner;
            };
            draw_mark(within(-arm, 0), within(arm, 0), ink_width, sink);
            draw_mark(within(0, -arm), within(0, arm), ink_width, sink);
        }
    }
    write_number(tiling, tile, title, sink);
}

void draw_tile_overview(const Tiling& tiling, const Page& page, const Window& place, const std::string& title,
                        PathSink& sink) {
    const double scale = place.width / page.width;
    const double width = tiling.sheet.width - 2 * tiling.sheet.margin;
    double y = place.top;
    const auto write = [&](const std::string& text, double height) {
        y -= 0.9 * height;
        write_plain(shortened(text, height, width), {tiling.sheet.margin, y}, height, sink);
        y -= height;
    };
    write(fmt::format("{} sheets of {:g} x {:g} mm; sheets overlap by {:g} mm; cut or fold at the crosses",
                      tiling.tiles.size(), tiling.sheet.width, tiling.sheet.height, tiling.overlap),
          letter);
    if (!title.empty()) write(title, 2 * letter);
    for (const Tile& tile : tiling.tiles) {
        const Window& cut = tile.cut;
        const auto on_sheet = [&](double px, double py) {
            return glm::dvec2(place.left + px * scale, place.top + py * scale);
        };
        const glm::dvec2 low = on_sheet(cut.left, cut.top);
        const glm::dvec2 high = on_sheet(cut.left + cut.width, cut.top + cut.height);
        draw_mark(low, {high.x, low.y}, ink_width, sink);
        draw_mark({high.x, low.y}, high, ink_width, sink);
        draw_mark(high, {low.x, high.y}, ink_width, sink);
        draw_mark({low.x, high.y}, low, ink_width, sink);
        // In a corner of the sheet, on a ground of its own, so that lines of the drawing do not run through it.
        const std::string number = fmt::format("{}-{}", tile.row, tile.column);
        const double height = 0.11 * std::min(high.y - low.y, high.x - low.x);
        const glm::dvec2 from = low + glm::dvec2(0.6 * height);
        const glm::dvec2 size(text_width(number, height) + 0.8 * height, 1.8 * height);
        const std::array<glm::dvec2, 4> corners = {glm::dvec2(from.x, -from.y), glm::dvec2(from.x + size.x, -from.y),
                                                   glm::dvec2(from.x + size.x, -from.y - size.y),
                                                   glm::dvec2(from.x, -from.y - size.y)};
        sink.polygon(corners, Pen{.colour = 0});
        write_mark(number, from + glm::dvec2(0.4, 1.4) * height, height, false, sink);
    }
}

}  // namespace sikku
