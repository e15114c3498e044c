#include "art/print/format.h"

#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sikku {
namespace {

using enum PrintFormat;
using enum FormatKind;

constexpr auto table = std::to_array<FormatInfo>({
    {.format = svg,
     .kind = vectors,
     .label = "SVG",
     .extension = "svg",
     .is_animated = true,
     .has_pages = true,
     .has_names = true,
     .is_text = true},
    {.format = pdf,
     .kind = vectors,
     .label = "PDF",
     .extension = "pdf",
     .has_pages = true,
     .has_names = true,
     .has_plates = true},
    {.format = eps, .kind = vectors, .label = "EPS", .extension = "eps", .has_opacity = false, .is_text = true},
    {.format = png, .kind = pixels, .label = "PNG", .extension = "png"},
    {.format = tiff, .kind = pixels, .label = "TIFF", .extension = "tif", .alias = "tiff", .has_inks = true},
    {.format = jpeg, .kind = pixels, .label = "JPEG", .extension = "jpg", .alias = "jpeg"},
    {.format = exr, .kind = pixels, .label = "EXR", .extension = "exr"},
    {.format = gif, .kind = animation, .label = "GIF", .extension = "gif"},
    {.format = hpgl, .kind = plot, .label = "HP-GL", .extension = "hpgl", .alias = "plt", .is_text = true},
    {.format = gcode, .kind = plot, .label = "G-code", .extension = "gcode", .alias = "nc", .is_text = true},
    {.format = dxf, .kind = plot, .label = "DXF", .extension = "dxf", .has_names = true, .is_text = true},
    {.format = obj, .kind = model, .label = "OBJ", .extension = "obj", .is_text = true},
    {.format = glb, .kind = model, .label = "glTF", .extension = "glb"},
    {.format = stl, .kind = model, .label = "STL", .extension = "stl"},
});

/// The forecast of a format.
template <class Cost>
struct CostOf {
    PrintFormat format;
    Cost cost;
};
constexpr auto line_costs = std::to_array<CostOf<LineCost>>({
    {svg, {20e-9, 80e-9, 5, 30, 3e-6, 90, 700}},
    {pdf, {80e-9, 250e-9, 3, 12, 14e-6, 35, 2000}},
    {eps, {40e-9, 120e-9, 15, 45, 5e-6, 110, 1200}},
    {hpgl, {100e-9, 2e-6, 12, 60, 0, 0, 500}},
    {gcode, {250e-9, 2e-6, 20, 60, 0, 0, 500}},
    {dxf, {200e-9, 2e-6, 40, 400, 0, 0, 500}},
});
constexpr auto pixel_costs = std::to_array<CostOf<PixelCost>>({
    {png, {3e-9, 25e-9, 0.01}},
    {tiff, {14e-9, 40e-9, 0.01}},
    {jpeg, {3e-9, 15e-9, 0.03}},
    {exr, {34e-9, 40e-9, 0.01}},
});

constexpr auto found(const auto& list, PrintFormat format) {
    return std::find_if(list.begin(), list.end(), [format](const auto& row) { return row.format == format; });
}
const auto& cost_in(const auto& list, PrintFormat format) {
    const auto row = found(list, format);
    if (row == list.end()) throw std::logic_error("the cost of a print is forecast for its kind of format");
    return row->cost;
}
// Every format of lines or pixels has its forecast.
static_assert(std::all_of(table.begin(), table.end(), [](const FormatInfo& row) {
    return (row.kind == vectors || row.kind == plot) == (found(line_costs, row.format) != line_costs.end()) &&
           (row.kind == pixels) == (found(pixel_costs, row.format) != pixel_costs.end());
}));

}  // namespace

std::span<const FormatInfo> print_formats() {
    return table;
}

const FormatInfo& info(PrintFormat format) {
    return *found(table, format);
}

const LineCost& line_cost(PrintFormat format) {
    return cost_in(line_costs, format);
}

const PixelCost& pixel_cost(PrintFormat format) {
    return cost_in(pixel_costs, format);
}

std::optional<PrintFormat> named_format(std::string_view name) {
    const std::string extension = lower_case(name);
    for (const FormatInfo& row : table) {
        if (extension == row.extension || (!row.alias.empty() && extension == row.alias)) return row.format;
    }
    return std::nullopt;
}

std::optional<PrintFormat> print_format(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension.empty() ? std::nullopt : named_format(std::string_view(extension).substr(1));
}

}  // namespace sikku
