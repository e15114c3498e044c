#include "art/print/format.h"

#include "engine/base/text.h"

#include <algorithm>
#include <array>

namespace sikku {
namespace {

using enum PrintFormat;
using enum FormatKind;

constexpr auto table = std::to_array<FormatInfo>({
    {.format = svg, .kind = vectors, .label = "SVG", .extension = "svg", .is_animated = true, .is_text = true},
    {.format = pdf, .kind = vectors, .label = "PDF", .extension = "pdf", .has_plates = true},
    {.format = eps, .kind = vectors, .label = "EPS", .extension = "eps", .is_text = true},
    {.format = png, .kind = pixels, .label = "PNG", .extension = "png"},
    {.format = tiff, .kind = pixels, .label = "TIFF", .extension = "tif", .alias = "tiff", .has_inks = true},
    {.format = jpeg, .kind = pixels, .label = "JPEG", .extension = "jpg", .alias = "jpeg"},
    {.format = exr, .kind = pixels, .label = "EXR", .extension = "exr"},
    {.format = gif, .kind = animation, .label = "GIF", .extension = "gif"},
    {.format = hpgl, .kind = plot, .label = "HP-GL", .extension = "hpgl", .alias = "plt", .is_text = true},
    {.format = gcode, .kind = plot, .label = "G-code", .extension = "gcode", .alias = "nc", .is_text = true},
    {.format = dxf, .kind = plot, .label = "DXF", .extension = "dxf", .is_text = true},
    {.format = obj, .kind = model, .label = "OBJ", .extension = "obj", .is_text = true},
    {.format = glb, .kind = model, .label = "glTF", .extension = "glb"},
    {.format = stl, .kind = model, .label = "STL", .extension = "stl"},
});

}  // namespace

std::span<const FormatInfo> print_formats() {
    return table;
}

const FormatInfo& info(PrintFormat format) {
    return *std::find_if(table.begin(), table.end(), [&](const FormatInfo& row) { return row.format == format; });
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
