// art/growth.h: one generation after the other, before a camera that stands still.
#pragma once

#include "art/draw.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace sikku {

/// More generations are refused.
constexpr std::int64_t most_frames = 10'000;

struct GrowthOptions {
    std::int64_t first = 0, last = 0;  ///< derivation lengths, both included
    double seconds = 0.5;              ///< that each is shown
    double hold = 2.0;                 ///< that the last one is shown, if that is longer
    bool fits_each = false;            ///< each fills the page by itself, instead of all having one scale and place
    /// What Print::made says of a file of its own; null: as it stands.
    std::function<std::string(const Grammar& generation)> made{};
};

/// `growth.png` becomes `growth-07.png`, with as many digits as `last` has.
std::filesystem::path frame_file(const std::filesystem::path& file, std::int64_t generation, std::int64_t last);

/// Draws each generation as draw() would, but all where the largest of them, and what they cover together, ask for
/// (unless `fits_each`):
/// as an animated GIF where `file` ends in .gif, else as a file for each (frame_file()). Of GIF `print` and `options`
/// say what they say of a PNG, on white paper. Generations that draw nothing are empty pages. Files
/// of their own appear one after the other, each whole; what is wrong with a later one leaves those before it.
/// @return what became of the last
/// @throws as draw(); std::runtime_error if all are empty, or are more than most_frames
DrawReport draw_growth(const Grammar& grammar, const Print& print, const DrawOptions& options,
                       const GrowthOptions& growth, const std::filesystem::path& file);

}  // namespace sikku
