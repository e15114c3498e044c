// art/draw.h: from a grammar and its style to a finished print in a file.
#pragma once

#include "art/print.h"
#include "engine/grammar.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace sikku {

enum class PrintFormat { svg, pdf, png, tiff, jpeg, exr };

/// By the file's extension (any case); nullopt for one that no writer knows.
std::optional<PrintFormat> print_format(const std::filesystem::path& file);

struct DrawOptions {
    PrintFormat format = PrintFormat::svg;
    PlacementOptions placement;
    int threads = 0;        ///< for raster formats; 0: all cores
    double budget = 200e6;  ///< most nodes of the derivation that are visited in one pass
    /// Called once, before the word is read, with how many times it will be. `watch` may have been called before.
    std::function<void(int passes)> begin;
    /// Called with the number of symbols read since the last call, and with 0 for each band of pixels; may throw to
    /// stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// What became of it.
struct DrawReport {
    double step = 0.0;                ///< millimetres of one turtle step
    glm::dvec2 size{0.0};             ///< of the drawing with its pen, in millimetres
    bool overflows = false;           ///< it is larger than the page within its margins (a step was given)
    bool leaves_pattern_out = false;  ///< its text is too long for the format
};

/// Draws into `file`, which appears whole or not at all. `print` comes with page, style, dpi and texts; its placement
/// is worked out here: from the fold where only straight lines are drawn and all are seen, else from one pass over
/// the word. What leaves nothing on paper (`stroke: none`, transparent colours) does not count.
/// @throws BudgetError, WordError; std::runtime_error if nothing is drawn or the file cannot be written
DrawReport draw(const Grammar& grammar, Print print, const DrawOptions& options, const std::filesystem::path& file);

}  // namespace sikku
