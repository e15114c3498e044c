#include "art/writer/tiled_print.h"

#include "art/drawing/faint_inks.h"
#include "art/print/clip.h"
#include "art/print/tiles.h"
#include "art/vector/vector_formats.h"
#include "art/writer/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// A rendering placed on a sheet of paper, with marks on top.
class SheetOfPixels : public Rendering {
public:
    /// @param left, top  position of the rendering on the sheet, in pixels
    SheetOfPixels(std::unique_ptr<Rendering> base, PixelSize base_size, int left, int top, PixelSize size,
                  std::unique_ptr<Raster> marks)
        : base_(std::move(base)),
          base_size_(base_size),
          left_(left),
          top_(top),
          size_(size),
          marks_(std::move(marks)),
          channels_(base_->channels() == 4 ? 4 : 3) {}

    /// Number of channels: 4 if the ground of the print, and therefore the paper, is transparent.
    int channels() const override { return channels_; }
    void watch(std::function<void()> watch) override { base_->watch(std::move(watch)); }
    void render(int threads, const RowSink& rows) override {
        int next = 0;
        blank_rows(next, top_, rows);
        base_->render(threads, [&](int, int count, std::span<const std::uint8_t> pixels) {
            deliver(next, count, pixels, base_->channels(), rows);
            next += count;
        });
        blank_rows(next, size_.height, rows);
    }
    void render_rows(int first, int end, int, const RowSink& rows) const override {
        const int low = std::clamp(first - top_, 0, base_size_.height) / 128 * 128;
        const int high = std::clamp((end - top_ + 127) / 128 * 128, 0, base_size_.height);
        int next = first;
        blank_rows(next, std::min(end, top_), rows);
        if (low < high) {
            base_->render_rows(low, high, channels_, [&](int from, int count, std::span<const std::uint8_t> pixels) {
                const int skipped = std::clamp(next - top_ - from, 0, count);
                const int used = std::clamp(end - next, 0, count - skipped);
                const std::size_t row = pixels.size() / static_cast<std::size_t>(count);
                if (used > 0) {
                    deliver(next, used, pixels.subspan(row * static_cast<std::size_t>(skipped)), channels_, rows);
                }
                next += used;
            });
        }
        blank_rows(next, end, rows);
    }

private:
    /// Delivers blank paper with its marks from row `next` up to `end`.
    void blank_rows(int& next, int end, const RowSink& rows) const {
        for (; next < end; next += std::min(128, end - next)) deliver(next, std::min(128, end - next), {}, 0, rows);
    }

    /// @param pixels  rows of the base with `channels` channels; empty: blank paper
    void deliver(int first, int count, std::span<const std::uint8_t> pixels, int channels,
                 const RowSink& rows) const {
        const auto out = static_cast<std::size_t>(channels_);
        const auto in = static_cast<std::size_t>(channels);
        const auto width = static_cast<std::size_t>(size_.width);
        std::vector<std::uint8_t> sheet(width * static_cast<std::size_t>(count) * out, channels_ == 4 ? 0 : 255);
        for (int row = 0; row < count && !pixels.empty(); ++row) {
            const std::uint8_t* from =
                &pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(base_size_.width) * in];
            std::uint8_t* to =
                &sheet[(static_cast<std::size_t>(row) * width + static_cast<std::size_t>(left_)) * out];
            for (int x = 0; x < std::min(base_size_.width, size_.width - left_); ++x, from += in, to += out) {
                for (std::size_t channel = 0; channel < out; ++channel) to[channel] = from[in < 3 ? 0 : channel];
            }
        }
        lay_marks(first, count, sheet);
        rows(first, count, sheet);
    }

    void lay_marks(int first, int count, std::vector<std::uint8_t>& sheet) const {
        const auto out = static_cast<std::size_t>(channels_);
        const auto width = static_cast<std::size_t>(size_.width);
        const int low = first / 128 * 128;
        const int high = std::min((first + count + 127) / 128 * 128, size_.height);
        marks_->render_rows(low, high, 4, [&](int from, int marked, std::span<const std::uint8_t> pixels) {
            for (int row = std::max(first, from); row < std::min(first + count, from + marked); ++row) {
                const std::uint8_t* mark = &pixels[static_cast<std::size_t>(row - from) * width * 4];
                std::uint8_t* to = &sheet[static_cast<std::size_t>(row - first) * width * out];
                for (std::size_t x = 0; x < width; ++x, mark += 4, to += out) {
                    const unsigned alpha = mark[3];
                    if (alpha == 0) continue;
                    const unsigned under = out == 4 ? to[3] * (255U - alpha) / 255U : 255U - alpha;
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        to[channel] = static_cast<std::uint8_t>((mark[channel] * alpha + to[channel] * under) /
                                                                (alpha + under));
                    }
                    if (out == 4) to[3] = static_cast<std::uint8_t>(alpha + under);
                }
            }
        });
    }

    std::unique_ptr<Rendering> base_;
    PixelSize base_size_;
    int left_, top_;
    PixelSize size_;
    std::unique_ptr<Raster> marks_;
    int channels_;
};

/// Moves the print onto a sheet whose top left corner is at `corner` of the print.
Print moved(const Print& print, glm::dvec2 corner) {
    Print part = print;
    part.placement.to_page[2] -= corner;
    part.floor_corner += corner;
    return part;
}

Window moved(Window window, glm::dvec2 corner) {
    window.left -= corner.x;
    window.top -= corner.y;
    return window;
}

/// The data that all sheets share.
struct TileWork {
    const Drawing& drawing;
    const Print& print;  ///< the whole print, placed
    const DrawOptions& options;
    const Tiling& tiling;
    double pen;  ///< width of the widest pen in millimetres
};

/// The sheet without the drawing.
Print sheet_of(const TileWork& work, const Tile& tile) {
    Print sheet = work.print;
    sheet.page = work.tiling.sheet;
    sheet.title = fmt::format("{} ({}-{})", work.print.title, tile.row, tile.column);
    sheet.style.ground.reset();
    return sheet;
}

/// @return the number of polygons
std::uint64_t write_vector_tile(const TileWork& work, const Tile& tile, Output& output) {
    const glm::dvec2 corner = tile_corner(work.tiling, tile);
    const Print sheet = sheet_of(work, tile);
    const auto writer = write_vectors(work.options.format, sheet, output);
    Print part = moved(work.print, corner);
    part.title = sheet.title;
    const Window shown = moved(tile.shown, corner);
    writer->begin_part(part, shown);
    ClipSink clip(*writer, seen_box(part, shown, work.pen));
    work.drawing.read(part, moved(whole_page(work.print.page), corner), clip);
    const std::uint64_t polygons = writer->polygons();  // without those of the marks
    const Print marks = mark_print(sheet.page, sheet.dpi, work.print.style.ground);
    writer->begin_part(marks, whole_page(marks.page));
    draw_tile_marks(work.tiling, tile, work.print.title, *writer);
    writer->finish();
    return polygons;
}

void write_picture_tile(const TileWork& work, const Tile& tile, Output& output, const std::filesystem::path& name) {
    const glm::dvec2 corner = tile_corner(work.tiling, tile);
    const Print sheet = sheet_of(work, tile);
    const double millimetre = sheet.dpi / 25.4;
    const Window shown = moved(tile.shown, corner);
    const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * millimetre)); };
    const int left = pixels(shown.left), top = pixels(shown.top);
    const glm::dvec2 base_corner = corner + glm::dvec2(left / millimetre, top / millimetre);
    Print part = moved(work.print, base_corner);
    part.page = {std::max(1, pixels(shown.left + shown.width) - left) / millimetre,
                 std::max(1, pixels(shown.top + shown.height) - top) / millimetre, 0.0};
    part = as_picture(part);
    const Print marks = as_picture(mark_print(sheet.page, sheet.dpi, work.print.style.ground));
    Print paper = marks;
    paper.style.ground.reset();
    auto overlay = make_raster(paper);
    draw_tile_marks(work.tiling, tile, work.print.title, *overlay);
    SheetOfPixels rendering(work.drawing.rendering(part, moved(whole_page(work.print.page), base_corner)),
                            pixel_size(part.page, part.dpi), left, top, pixel_size(sheet.page, sheet.dpi),
                            std::move(overlay));
    write_picture(rendering, sheet, work.options, output, name);
}

/// @return the number of polygons
std::uint64_t write_pdf_tiles(const TileWork& work, Output& output) {
    const auto writer = write_pdf_pages(work.print, output);
    work.drawing.read(work.print, *writer);
    const std::uint64_t polygons = writer->polygons();  // without those of the marks
    const Page& sheet = work.tiling.sheet;
    const Page& page = work.print.page;
    Print marks = mark_print(sheet, work.print.dpi, work.print.style.ground);
    constexpr double header = 14.0;  // millimetres
    const double room_x = sheet.width - 2 * sheet.margin, room_y = sheet.height - 2 * sheet.margin - header;
    const double scale = std::min(room_x / page.width, room_y / page.height);
    const Window place{sheet.margin + (room_x - scale * page.width) / 2, sheet.margin + header, scale * page.width,
                       scale * page.height};
    marks.title = "overview";
    writer->begin_page(marks, whole_page(page), {place.left, place.top}, scale);
    draw_tile_overview(work.tiling, page, place, work.print.title, *writer);
    for (const Tile& tile : work.tiling.tiles) {
        const Window on_sheet = moved(tile.shown, tile_corner(work.tiling, tile));
        Print numbered = marks;
        numbered.title = fmt::format("marks {}-{}", tile.row, tile.column);
        writer->begin_page(numbered, tile.shown, {on_sheet.left, on_sheet.top}, 1.0);
        draw_tile_marks(work.tiling, tile, work.print.title, *writer);
    }
    writer->finish();
    return polygons;
}

}  // namespace

DrawReport place_whole(Drawing& drawing, Print& print) {
    DrawReport report = drawing.place(print);
    if (!drawing.fixed_step()) return report;
    for (int i = 0; i < 20; ++i) {
        const double around = 2 * (print.page.margin + drawing.border_space(print.page));
        print.page.width = report.size.x + around;
        print.page.height = report.size.y + around + drawing.text_space(print.page).total();
    }
    return drawing.place(print);
}

DrawReport draw_tiles(Drawing& drawing, Print print, const DrawOptions& options, const std::filesystem::path& file,
                      Destination& destination) {
    DrawReport report = place_whole(drawing, print);
    print.style = drawing.style();
    check_spots(print.press, print.style);
    const Tiling tiling = tiling_of(print.page, *options.tiles);
    const DrawnExtent& seen = drawing.seen();
    const double widest = std::max(seen.widest, seen.around);
    const TileWork work{drawing, print, options, tiling,
                        widest * (print.style.stroke.in_steps ? print.placement.step : 1.0)};
    std::vector<std::unique_ptr<Output>> outputs;
    if (options.format == PrintFormat::pdf) {
        outputs.push_back(destination.open(file));
        report.polygons = write_pdf_tiles(work, *outputs.back());
    } else {
        for (const Tile& tile : tiling.tiles) {
            const std::filesystem::path name = tile_file(file, tile);
            outputs.push_back(destination.open(name));
            if (is_vector(options.format)) {
                report.polygons += write_vector_tile(work, tile, *outputs.back());
            } else {
                write_picture_tile(work, tile, *outputs.back(), name);
            }
        }
    }
    for (const auto& output : outputs) output->commit();
    drawing.report(report);
    report.faint = faint_inks(drawing, print);
    report.leaves_pattern_out =
        !is_vector(options.format) && !keeps_text(info(options.format).extension, print.pattern);
    report.overflows = false;
    report.sheets = static_cast<int>(tiling.tiles.size());
    report.sheet_rows = tiling.rows;
    report.left_out = {tiling.tiles.front().shown.left, tiling.tiles.front().shown.top};
    return report;
}

}  // namespace sikku
