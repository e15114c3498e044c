// art/draw_view.h: prints through a view, so that their cost is what is seen.
#pragma once

#include "art/draw.h"

#include <filesystem>
#include <optional>

namespace sikku {

/// As draw(), of a grammar whose contexts are resolved, for what a View can be made of: lines in one pen,
/// straight or splines.
/// Taken for a window, and for pictures of words of more than `most_read_symbols`; else nullopt, and nothing is
/// written. Pictures are made in strips, each from a walk of its own that passes over what lies outside. Under a pen
/// of a pixel, parts up to half a pixel become blots of their ink; under a wider one, parts up to a quarter of its
/// width (an eighth under two pixels) become chords. In vector prints through a window, chords alone. Memory: a strip
/// for each thread, whatever the word.
/// @throws std::runtime_error for a window on a drawing that has no view, or on nothing
std::optional<DrawReport> draw_view(const Grammar& grammar, Print print, const DrawOptions& options,
                                    const std::filesystem::path& file);

constexpr double most_read_symbols = 4e6;

}  // namespace sikku
