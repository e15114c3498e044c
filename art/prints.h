// art/prints.h: prints and models of a document: the public interface of art.
#pragma once

#include "engine/interpreter.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Draws documents: SVG, PDF, PNG, TIFF, JPEG, EXR, GIF, HP-GL, G-code, DXF, OBJ, glTF and STL.
const Interpreter& prints();

/// Returns the bytes of a print. Names in `values` are options of prints() or keys and defines of the pattern:
/// `draw(koch, "svg", {{"size", "A3"}, {"stroke", "0.3mm navy"}})`.
/// @param format  a name from prints().formats() whose print is a single file
/// @throws SettingError, PatternError, BudgetError, WordError; std::runtime_error if nothing is drawn
std::string draw(const Document& document, std::string_view format, const OptionValues& values = {},
                 const Monitor& monitor = {});

/// A picture in memory.
struct DrawnPixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;  ///< rows from the top; red, green, blue, straight alpha
    std::vector<Remark> remarks;
};

/// Draws the pixels that a PNG would have into memory. @param values  as for draw() @throws as draw()
DrawnPixels draw_pixels(const Document& document, const OptionValues& values, const Monitor& monitor = {});

}  // namespace sikku
