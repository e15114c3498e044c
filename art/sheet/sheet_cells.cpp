#include "art/sheet/sheet_cells.h"

#include "art/raster/raster.h"
#include "art/writer/make_drawing.h"
#include "art/writer/print_cost.h"

#include <algorithm>
#include <cmath>

namespace sikku {

DrawOptions cell_options(const SheetCell& cell, const SheetOptions& options) {
    DrawOptions drawing;
    static_cast<DrawingOptions&>(drawing) = cell;
    drawing.format = options.format;
    drawing.monitor = options.monitor;
    drawing.budget = cell.budget;
    drawing.placement.scale = 1.0;
    drawing.plot = options.plot;
    return drawing;
}

Print cell_print(const SheetCell& cell, const SheetOptions& options, std::size_t count) {
    Print print;
    print.style = cell.style;
    print.dpi = options.dpi;
    const double side = std::sqrt(static_cast<double>(count));
    print.page = {std::max(options.page.width / side, 1.0), std::max(options.page.height / side, 1.0), 0.0};
    return print;
}

double sheet_memory(const std::vector<SheetCell>& cells, const SheetOptions& options) {
    double most = 0, lines = 0, kept = 0;
    for (const SheetCell& cell : cells) {
        named_cell(cell, [&] {
            const DrawOptions own = cell_options(cell, options);
            const DrawingCost cost =
                drawing_cost(*cell.grammar, cell_print(cell, options, cells.size()), own, own.reading());
            most = std::max(most, cost.memory - cost.kept_memory);
            lines += cost.lines_memory;
            kept += cost.kept_memory;
        });
    }
    if (is_vector(options.format)) return kept;
    const PixelSize size = pixel_size(options.page, options.dpi);
    const double stride = 3.0 * size.width;
    const double shape = options.page.height / options.page.width;
    const double rows = std::max(1.0, std::round(std::sqrt(static_cast<double>(cells.size()) * shape)));
    const double whole = stride * size.height / rows + most + kept;
    if (!(options.memory > 0) || whole <= options.memory) return whole;
    return lines / rows + most + kept + 256 * stride;
}

Cost sheet_cost(const std::vector<SheetCell>& cells, const SheetOptions& options) {
    Cost cost = base_cost(uses_image_module(options.format));
    cost.memory += sheet_memory(cells, options);
    double largest = 0;
    for (const SheetCell& cell : cells) {
        named_cell(cell, [&] {
            const Cost own =
                print_cost(*cell.grammar, cell_print(cell, options, cells.size()), cell_options(cell, options));
            cost.seconds += own.seconds - own.shared_seconds;
            cost.bytes += own.bytes;
            cost.is_doubtful |= own.is_doubtful;
            largest = std::max(largest, own.memory - own.shared_memory);
        });
    }
    // Cells are written one after another.
    if (is_vector(options.format)) cost.memory += largest;
    return cost;
}

}  // namespace sikku
