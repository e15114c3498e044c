// art/print/format.h: the file formats of prints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace sikku {

enum class PrintFormat : std::uint8_t { svg, pdf, eps, png, tiff, jpeg, exr, gif, hpgl, gcode, dxf, obj, glb, stl };

/// Contents of a format, which determine how it is drawn.
enum class FormatKind : std::uint8_t { vectors, pixels, plot, animation, model };

/// Forecast of formats that draw lines: seconds and bytes for each point of a straight line or, three for each step,
/// of a curve, and for each polygon in a shade of its own; bytes of a file.
struct LineCost {
    double line_seconds = 0, curve_seconds = 0, line_bytes = 0, curve_bytes = 0;
    double shade_seconds = 0, shade_bytes = 0, bytes = 0;
};
/// Forecast of pictures: seconds for each pixel and for each with ink, bytes for each pixel.
struct PixelCost {
    double seconds = 0, ink_seconds = 0, bytes = 0;
};

/// One file format. All code that depends on the format reads this row.
struct FormatInfo {
    PrintFormat format = PrintFormat::svg;
    FormatKind kind = FormatKind::vectors;
    std::string_view label{};      ///< name in messages and texts: `HP-GL`
    std::string_view extension{};  ///< without the dot
    std::string_view alias{};      ///< another extension of the same format, or empty
    bool is_animated = false;      ///< can draw itself, stroke by stroke
    bool has_pages = false;        ///< several drawings: pages, or steps that follow each other
    bool has_names = false;        ///< names or layers for polygons
    bool has_opacity = true;       ///< translucent colours
    bool has_plates = false;       ///< spot colours and crop marks
    bool has_inks = false;         ///< CMYK and one bit per pixel
    bool is_text = false;          ///< UTF-8 text
};

/// All formats of prints that this build writes (the web build leaves out EPS), in the order in which texts list
/// them.
std::span<const FormatInfo> print_formats();
const FormatInfo& info(PrintFormat format);
/// @param format  of the kind `vectors` or `plot`
const LineCost& line_cost(PrintFormat format);
/// @param format  of the kind `pixels`
const PixelCost& pixel_cost(PrintFormat format);

/// The format of a file by its extension (any case), or nullopt.
std::optional<PrintFormat> print_format(const std::filesystem::path& file);
/// The format with this name or extension (`svg`, `plt`; any case), or nullopt.
std::optional<PrintFormat> named_format(std::string_view name);

/// SVG, PDF, EPS, HP-GL, G-code and DXF: lines rather than pixels.
inline bool is_vector(PrintFormat format) {
    const FormatKind kind = info(format).kind;
    return kind == FormatKind::vectors || kind == FormatKind::plot;
}
/// Pictures that OpenImageIO writes: all but PNG.
inline bool uses_image_module(PrintFormat format) {
    return info(format).kind == FormatKind::pixels && format != PrintFormat::png;
}
/// HP-GL, G-code and DXF, which describe movements of a pen or another tool.
inline bool is_for_plotters(PrintFormat format) {
    return info(format).kind == FormatKind::plot;
}

}  // namespace sikku
