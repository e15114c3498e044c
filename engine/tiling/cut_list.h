// engine/tiling/cut_list.h: lists the pieces of a tiling by kind, for cutting.
#pragma once

#include "engine/tiling/tiling.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Pieces of one shape, hand and colour.
struct CutKind {
    std::string name;           ///< A, B, … Z, AA, … in the order of their first tiles
    std::uint32_t shape = 0;    ///< index into TilingExamination::shapes
    bool is_reflected = false;  ///< the mirror image of the first tile of its shape
    std::int32_t colour = 0;
    std::uint64_t pieces = 0;
    double area = 0;                  ///< of a piece, in square millimetres
    std::vector<glm::dvec2> corners;  ///< of its first tile, anticlockwise, in millimetres
};

/// Sorts tiles into kinds. Cost: linear.
/// @param step  millimetres
/// @param keeps_direction  pieces turned against each other by angles other than 180 degrees are of different kinds
std::vector<CutKind> cut_list(const TilingResult& result, double step, bool keeps_direction = false);

/// Describes polygons that are left out or overlap, as one line; empty if all polygons are tiles that do not
/// overlap.
std::string missing_pieces(const TilingExamination& examination);

/// Formats a table with one line for each kind, and the sums.
/// @param title  title of the pattern
/// @param n  derivation length, if there is one
std::string cut_list_text(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                          double step);
/// The same as one line of JSON.
std::string cut_list_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                          double step);

}  // namespace sikku
