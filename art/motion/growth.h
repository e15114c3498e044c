// art/motion/growth.h: animations and series of generations with a fixed camera.
#pragma once

#include "art/writer/draw.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sikku {

/// Maximum number of generations; more are rejected.
constexpr std::int64_t most_frames = 10'000;

struct GrowthOptions {
    std::int64_t first = 0, last = 0;  ///< derivation lengths, both included
    double seconds = 0.5;              ///< display time of each generation
    double hold = 2.0;                 ///< minimum display time of the last one
    bool fits_each = false;            ///< scale each to the page instead of sharing one scale and position
    bool is_animation = false;         ///< one animated GIF instead of a file for each generation
};

/// Names the file of a generation: `growth.png` becomes `growth-07.png`, with as many digits as `last` has.
std::filesystem::path frame_file(const std::filesystem::path& file, std::int64_t generation, std::int64_t last);

/// Draws each generation like draw(), but all with one scale and position, chosen for the largest of them and the
/// area they cover together (unless `fits_each`): as one animated GIF, or as one file for each
/// (frame_file()). For GIF, `print` and `options` have the same meaning as for a PNG on white paper.
/// Generations that draw nothing are empty pages. Separate files appear one after the other, each whole; an error in
/// a later one leaves earlier ones in place.
/// @return report about the last generation
/// @throws as draw(); std::runtime_error if all are empty or there are more than most_frames
DrawReport draw_growth(const Grammar& grammar, const Print& print, const DrawOptions& options,
                       const GrowthOptions& growth, const std::filesystem::path& file,
                       Destination& destination = file_system());

}  // namespace sikku
