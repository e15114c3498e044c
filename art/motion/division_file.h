// art/motion/division_file.h: animations in which tiles divide.
#pragma once

#include "art/motion/division_time.h"
#include "art/writer/draw.h"

#include <cstdint>
#include <filesystem>

namespace sikku {

struct DivisionOptions {
    std::int64_t first = 0, last = 0;  ///< derivation lengths, both included
    bool is_gif = false;               ///< else an animated SVG
    DivisionTimes times;
};

/// Maximum numbers of tiles, in all generations together. Browsers cannot animate more of them smoothly.
constexpr double most_tiles_of_gif = 500'000, most_tiles_of_svg = 20'000;

/// Draws generations of tiles, each of which divides into the next, as one animation that is repeated for ever. All
/// generations cover the same region, as far as a scale permits. For GIF, `print` and `options` have the same meaning
/// as for a PNG on white paper.
/// @return report about the last generation
/// @throws as draw() and make_division(); DivisionError for splines and lines drawn by hand
DrawReport draw_division(const Grammar& grammar, const Print& print, const DrawOptions& options,
                         const DivisionOptions& division, const std::filesystem::path& file,
                         Destination& destination = file_system());

}  // namespace sikku
