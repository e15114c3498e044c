#include "art/print/tiles.h"

#include "art/print/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr double mark = 4.0;    // millimetres, half of a cross
constexpr double letter = 2.5;  // millimetres
constexpr int most_sheets = 400;

}  // namespace

std::vector<Tile> tiles_of(const Page& page, const TileOptions& options) {
    const glm::dvec2 room{options.sheet.width - 2 * options.sheet.margin,
                          options.sheet.height - 2 * options.sheet.margin};
    const glm::dvec2 way = room - options.overlap;
    if (!(options.overlap >= 0 && way.x > 0 && way.y > 0)) {
        throw std::runtime_error(
            fmt::format("sheets of {:g} x {:g} mm within their margins have no room for an overlap "
                        "of {:g} mm",
                        room.x, room.y, options.overlap));
    }
    const auto count = [&](double length, double shown, double next) {
        return std::max(1.0, std::ceil((length - shown) / next - 1e-9) + 1);
    };
    const double columns = count(page.width, room.x, way.x);
    const double rows = count(page.height, room.y, way.y);
    if (columns * rows > most_sheets) {
        throw std::runtime_error(fmt::format("{:.0f} sheets: at most {} are made", columns * rows, most_sheets));
    }
    // What is left over is shared by the outer sides.
    const glm::dvec2 all{room.x + (columns - 1) * way.x, room.y + (rows - 1) * way.y};
    const glm::dvec2 first = (glm::dvec2(page.width, page.height) - all) / 2.0;
    std::vector<Tile> tiles;
    for (int row = 0; row < static_cast<int>(rows); ++row) {
        for (int column = 0; column < static_cast<int>(columns); ++column) {
            tiles.push_back(
                {row + 1, column + 1, {first.x + column * way.x, first.y + row * way.y, room.x, room.y, false}});
        }
    }
    return tiles;
}

std::filesystem::path tile_file(const std::filesystem::path& file, const Tile& tile) {
    std::filesystem::path named = file;
    named.replace_filename(
        fmt::format("{}-{}-{}{}", file.stem().string(), tile.row, tile.column, file.extension().string()));
    return named;
}

Print tile_print(const Print& print, const Tile& tile, const TileOptions& options) {
    Print sheet = print;
    sheet.page = options.sheet;
    sheet.title = fmt::format("{} ({}-{})", print.title, tile.row, tile.column);
    sheet.placement.to_page[2] +=
        glm::dvec2(options.sheet.margin - tile.shown.left, options.sheet.margin - tile.shown.top);
    return sheet;
}

void draw_tile_marks(const Print& sheet, const Tile& tile, const TileOptions& options, int colour, PathSink& sink) {
    const Placement& placement = sheet.placement;
    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(placement.to_page[0], placement.to_page[1]));
    const auto drawn = [&](glm::dvec2 point) { return back * (point - placement.to_page[2]); };
    const StrokeWidth& stroke = sheet.style.stroke;
    const Pen pen{0.1 / (stroke.in_steps ? placement.step : 1.0) / stroke.unit, true, colour};
    const auto line = [&](glm::dvec2 from, glm::dvec2 to) {
        sink.begin_stroke(drawn(from), pen);
        const std::array<glm::dvec2, 1> end = {drawn(to)};
        sink.lines(end);
        sink.end_stroke(false);
    };
    const double left = options.sheet.margin;
    const double top = options.sheet.margin;
    const double right = left + tile.shown.width;
    const double bottom = top + tile.shown.height;
    for (const glm::dvec2 corner :
         {glm::dvec2(left, top), glm::dvec2(right, top), glm::dvec2(right, bottom), glm::dvec2(left, bottom)}) {
        line(corner - glm::dvec2(mark, 0), corner + glm::dvec2(mark, 0));
        line(corner - glm::dvec2(0, mark), corner + glm::dvec2(0, mark));
    }
    // Letters are written with y up.
    class Lettering : public PathSink {
    public:
        using Place = std::function<glm::dvec2(glm::dvec2)>;
        Lettering(PathSink& sink, Place place) : sink_(sink), place_(std::move(place)) {}
        void begin_stroke(glm::dvec2 start, const Pen& with) override { sink_.begin_stroke(place_(start), with); }
        void lines(std::span<const glm::dvec2> ends) override { sink_.lines(placed(ends)); }
        void curves(std::span<const glm::dvec2> controls) override { sink_.curves(placed(controls)); }
        void change_pen(const Pen& with) override { sink_.change_pen(with); }
        void end_stroke(bool closed) override { sink_.end_stroke(closed); }
        void polygon(std::span<const glm::dvec2>, const Pen&) override {}
        void disc(glm::dvec2, double, const Pen&) override {}

    private:
        std::span<const glm::dvec2> placed(std::span<const glm::dvec2> points) {
            points_.clear();
            for (const glm::dvec2 point : points) points_.push_back(place_(point));
            return points_;
        }
        PathSink& sink_;
        Place place_;
        std::vector<glm::dvec2> points_;
    } lettering(sink, [&](glm::dvec2 p) { return drawn({p.x, -p.y}); });
    write_text(sheet.title, {left + 2 * mark, -(bottom + letter + 1.0)}, letter, pen, lettering);
}

bool ClipSink::sees(std::span<const glm::dvec2> points) const {
    Box box;
    box.add(at_);
    for (const glm::dvec2 point : points) box.add(point);
    return box.low.x <= box_.high.x && box.high.x >= box_.low.x && box.low.y <= box_.high.y &&
           box.high.y >= box_.low.y;
}

void ClipSink::lift(bool closed) {
    if (is_down_) sink_.end_stroke(closed);
    is_down_ = false;
}

void ClipSink::start() {
    if (!is_down_) sink_.begin_stroke(at_, pen_);
    is_down_ = true;
}

void ClipSink::begin_stroke(glm::dvec2 start_at, const Pen& pen) {
    at_ = start_at;
    pen_ = pen;
    is_whole_ = true;
}

void ClipSink::lines(std::span<const glm::dvec2> ends) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto end = ends.subspan(i, 1);
        if (sees(end)) {
            start();
            sink_.lines(end);
        } else {
            lift(false);
            is_whole_ = false;
        }
        at_ = end.front();
    }
}

void ClipSink::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        const auto curve = controls.subspan(i, 3);
        if (sees(curve)) {
            start();
            sink_.curves(curve);
        } else {
            lift(false);
            is_whole_ = false;
        }
        at_ = curve.back();
    }
}

void ClipSink::change_pen(const Pen& pen) {
    pen_ = pen;
    if (is_down_) sink_.change_pen(pen);
}

void ClipSink::end_stroke(bool closed) {
    lift(closed && is_whole_);
}

void ClipSink::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    sink_.polygon(vertices, pen);
}

void ClipSink::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    sink_.area(outline, pen);
}

void ClipSink::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    sink_.disc(centre, radius, pen);
}

}  // namespace sikku
