#include "art/sheet/sheet.h"

#include "art/image/image_file.h"
#include "art/raster/raster.h"
#include "art/sheet/sheet_cells.h"
#include "art/sheet/sheet_maker.h"
#include "art/sheet/sheet_plot.h"
#include "art/vector/vector_formats.h"
#include "art/writer/picture.h"
#include "art/writer/press_inks.h"
#include "engine/base/output.h"
#include "engine/base/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

[[noreturn]] void refuse_memory(double needed, double memory) {
    throw std::runtime_error(fmt::format("it needs about {:.0f} MB of memory; only {:.0f} MB are available",
                                         std::ceil(needed / 1e6), memory / 1e6));
}

}  // namespace

/// Writes the texts that are visible between two heights, in millimetres.
void SheetMaker::write_texts(double top, double bottom, PathSink& sink) const {
    for (const TextLine& line : plan_.texts) {
        if (line.at.y + line.height < top || line.at.y - 2 * line.height > bottom) continue;
        letters_.write(line.text, {line.at.x, -line.at.y}, line.height, line.pen, sink);
    }
}

void SheetMaker::write_vectors(PrintWriter& writer) const {
    write_texts(0.0, options_.page.height, writer);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        writer.begin_part(plan_.cells[i].print, plan_.cells[i].window);
        named_cell(cells_[i],
                   [&] { subjects_[i].drawing->read_visible(plan_.cells[i].print, plan_.cells[i].window, writer); });
    }
    writer.finish();
}

void SheetMaker::move(glm::dvec2 by) {
    print_.placement.to_page[2] += by;
    for (PlacedCell& cell : plan_.cells) {
        cell.print.placement.to_page[2] += by;
        cell.window.left += by.x;
        cell.window.top += by.y;
    }
}

void SheetMaker::write_parts(PrintWriter& writer) const {
    const glm::dvec2 at = print_.placement.to_page[2];
    writer.begin_part(print_, {at.x, at.y, options_.page.width, options_.page.height, false, 0.0});
    write_texts(0.0, options_.page.height, writer);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        writer.begin_part(plan_.cells[i].print, plan_.cells[i].window);
        named_cell(cells_[i],
                   [&] { subjects_[i].drawing->read_visible(plan_.cells[i].print, plan_.cells[i].window, writer); });
    }
}

DrawReport SheetMaker::write_plot(Output& output) const {
    std::vector<PlacedDrawing> drawings;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        drawings.push_back({subjects_[i].drawing.get(), &plan_.cells[i].print, plan_.cells[i].window});
    }
    DrawOptions options;
    options.format = options_.format;
    static_cast<PlotSetup&>(options) = options_;
    options.monitor = options_.monitor;
    const SheetDrawing all(
        std::move(drawings), print_, [this](PathSink& sink) { write_texts(0.0, options_.page.height, sink); },
        options, options.reading());
    Print print = print_;
    print.style = all.style();
    DrawReport report;
    draw_plot(all, print, options, output, report);
    return report;
}

/// The rows of the sheet, cut between the rows of its cells.
std::vector<Strip> SheetMaker::strips(PixelSize size, Colour ground) const {
    const double millimetre = options_.dpi / 25.4;
    const auto pixels = [&](double millimetres, int most) {
        return static_cast<int>(std::clamp(std::round(millimetres * millimetre), 0.0, static_cast<double>(most)));
    };
    std::vector<Strip> strips(static_cast<std::size_t>(plan_.layout.rows));
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
        const PlacedCell& placed = plan_.cells[i];
        const Window& window = placed.window;
        CellPicture cell;
        cell.cell = i;
        cell.print = placed.print;
        cell.print.style.ground = over(placed.print.style.ground.value_or(Colour{0, 0, 0, 0}), ground);
        cell.left = pixels(window.left, size.width - 1);
        cell.right = std::max(cell.left + 1, pixels(window.left + window.width, size.width));
        cell.top = pixels(window.top, size.height - 1);
        cell.bottom = std::max(cell.top + 1, pixels(window.top + window.height, size.height));
        cell.print.page = {(cell.right - cell.left) / millimetre, (cell.bottom - cell.top) / millimetre,
                           window.margin};
        const glm::dvec2 corner(cell.left / millimetre, cell.top / millimetre);
        cell.print.placement.to_page[2] -= corner;
        cell.print.floor_corner += corner;
        strips[static_cast<std::size_t>(placed.row)].cells.push_back(std::move(cell));
    }
    for (std::size_t row = 1; row < strips.size(); ++row) {
        const int above = strips[row - 1].cells.front().bottom, below = strips[row].cells.front().top;
        // Multiples of 32 if possible, for TIFF.
        const int even = below / 32 * 32;
        strips[row - 1].bottom = strips[row].top = even >= above ? even : std::max(above, below);
    }
    strips.back().bottom = size.height;
    return strips;
}

void SheetMaker::write_pixels(Output& output, const std::filesystem::path& file) const {
    const PixelSize size = pixel_size(options_.page, options_.dpi);
    const double millimetre = options_.dpi / 25.4;
    const Colour ground = options_.ground.value_or(Colour{255, 255, 255, 0});
    const std::vector<Strip> all = strips(size, ground);
    DrawOptions drawing;
    drawing.format = options_.format;
    static_cast<PictureOptions&>(drawing) = options_;
    const int channels = ground.alpha < 255 ? 4 : 3;
    const std::size_t stride = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels);
    const Room room = this->room(all, static_cast<double>(stride));
    const bool is_one_channel = options_.press.bits == 1 && options_.press.screen == Screen{};
    Picture picture(print_, drawing, is_one_channel ? 1 : channels, output, file);
    for (const Strip& strip : all) {
        if (strip.bottom == strip.top) continue;
        Print print = print_;
        print.style.ground = ground;
        print.page = {size.width / millimetre, (strip.bottom - strip.top) / millimetre, 0.0};
        print.placement.to_page[2].y -= strip.top / millimetre;
        print.floor_corner.y += strip.top / millimetre;
        const auto texts = make_raster(print);
        write_texts(strip.top / millimetre, strip.bottom / millimetre, *texts);
        texts->watch([&] { watch(0); });
        std::vector<std::unique_ptr<Rendering>> rasters(strip.cells.size());
        const int rows = room.rows > 0 ? room.rows : strip.bottom - strip.top;
        for (int top = strip.top; top < strip.bottom; top += rows) {
            SheetBand band{top, std::min(top + rows, strip.bottom), {}};
            band.pixels.resize(stride * static_cast<std::size_t>(band.bottom - band.top));
            render_part(*texts, 0, strip.top, strip.bottom - strip.top, channels, stride, band);
            on_threads(room.readers, [&] {
                for_each_index(strip.cells.size(), [&](std::size_t i) {
                    const CellPicture& cell = strip.cells[i];
                    if (cell.bottom <= band.top || cell.top >= band.bottom) return;
                    named_cell(cells_[cell.cell], [&] {
                        if (!rasters[i]) {
                            rasters[i] = subjects_[cell.cell].drawing->rendering(cell.print);
                            rasters[i]->watch([&] { watch(0); });
                        }
                        render_part(*rasters[i], cell.left, cell.top, cell.bottom - cell.top, channels, stride, band);
                    });
                    if (cell.bottom <= band.bottom) rasters[i].reset();
                });
            });
            if (is_one_channel) keep_first_channel(band.pixels, channels);
            picture.rows(band.top, band.bottom - band.top, band.pixels);
        }
    }
    picture.close();
}

/// Computes how many drawings and rows fit in memory: whole strips, rendered one drawing at a time; otherwise bands
/// of strips, with all drawings of the strip in memory. @throws std::runtime_error if there is too little memory
SheetMaker::Room SheetMaker::room(const std::vector<Strip>& strips, double stride) const {
    const int threads = available_threads();
    if (!(options_.memory > 0)) return {threads, 0};
    double most = 1, thread = 1;
    double memory = options_.memory;  // excluding the memory that drawings keep
    for (const Subject& subject : subjects_) memory -= subject.cost.kept_memory;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        named_cell(cells_[i], [&] {
            const DrawingCost& cost = subjects_[i].cost;
            if (cost.memory - cost.kept_memory > memory) refuse_memory(cost.memory, options_.memory);
        });
        most = std::max(most, subjects_[i].cost.memory - subjects_[i].cost.kept_memory);
        thread = std::max(thread, subjects_[i].cost.thread_memory);
    }
    double pixels = 0, kept = 0;
    for (const Strip& strip : strips) {
        double lines = 0;
        for (const CellPicture& cell : strip.cells) lines += subjects_[cell.cell].cost.lines_memory;
        kept = std::max(kept, lines);
        pixels = std::max(pixels, (strip.bottom - strip.top) * stride);
    }
    const auto readers = [&](double room, double each) {
        return static_cast<int>(std::clamp(room / each, 1.0, static_cast<double>(threads)));
    };
    if (pixels + most <= memory) return {readers(memory - pixels, most), 0};
    const double left = memory - kept - most;
    const double rows = std::floor(left / 2 / stride / 128) * 128;
    if (rows < 128) refuse_memory(kept + most + 256 * stride, options_.memory);
    return {readers(left / 2, thread), static_cast<int>(std::min(rows, 4096.0))};
}

SheetLayout draw_sheet(const std::vector<SheetCell>& cells, const SheetOptions& given,
                       const std::filesystem::path& file, Destination& destination) {
    SheetOptions options = given;
    load_inks(options.press, options.format);
    if (uses_image_module(options.format)) prepare_images(options.threads);
    SheetLayout layout;
    on_threads(options.threads, [&] {
        SheetMaker sheet(cells, options);
        layout = sheet.arrange();
        const auto opened = destination.open(file);
        Output& output = *opened;
        if (options.plot || is_for_plotters(options.format)) {
            const DrawReport report = sheet.write_plot(output);
            layout.plot = report.plot;
            layout.polygons = report.polygons;
        } else if (info(options.format).kind == FormatKind::vectors) {
            const auto writer = write_vectors(options.format, sheet.print(), output);
            sheet.write_vectors(*writer);
            layout.polygons = writer->polygons();
        } else {
            sheet.write_pixels(output, file);
        }
        output.commit();
        layout.reports = sheet.reports();
        layout.letters_warning = sheet.missing();
    });
    return layout;
}

}  // namespace sikku
