// art/cutting/cutting_plan.h: lays the pieces of a tiling on sheets of material.
#pragma once

#include "art/cutting/piece_rows.h"
#include "engine/tiling/cut_list.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Lengths are millimetres.
struct CuttingOptions {
    Page sheet;          ///< the material; its margin stays empty
    double seam = 0;     ///< allowance around each piece, 0 to 100
    double kerf = 0;     ///< width of a cut, 0 to 10; outlines grow by half of it
    double gap = 0;      ///< distance between the outlines of neighbours, 0 to 100; at 0 they share cuts
    bool grain = false;  ///< pieces keep their direction, or are turned by 180 degrees
};

/// A piece in the direction in which it is laid. Millimetres, y up.
struct PieceForm {
    std::size_t kind = 0;               ///< index into CuttingPlan::kinds
    std::vector<glm::dvec2> cut, seam;  ///< the outline to cut, and the finished size within it
};
struct PlacedForm {
    std::size_t form = 0;  ///< index into CuttingPlan::forms
    glm::dvec2 at{0.0};    ///< position from the bottom left corner of the sheet
};

/// A sheet of material of one colour.
struct CuttingSheet {
    std::int32_t colour = 0;
    std::vector<PlacedForm> pieces;
    std::uint64_t copies = 1;                                   ///< number of identical sheets
    std::vector<std::pair<std::size_t, std::uint64_t>> counts;  ///< kinds and their pieces on one sheet
    double in_use = 0;                                          ///< area of the outlines to cut, as part of the sheet
    double length = 0;  ///< length from the top of the sheet to the lowest piece, including the upper margin
};

struct CuttingPlan {
    std::vector<CutKind> kinds;
    std::vector<PieceForm> forms;
    std::vector<CuttingSheet> sheets;  ///< sheets of the same colour are adjacent
    std::uint64_t sheet_count = 0;     ///< including copies
    double in_use = 0;                 ///< area of the outlines to cut, as part of all sheets
};

/// Lays pieces in rows, the largest first, with separate sheets for each colour, or as nest_sheets() where that needs
/// fewer sheets or, if there is a gap, a shorter one. Equal sheets are planned once, so the cost does not depend on
/// the number of pieces.
/// @param kinds  result of cut_list(), with directions if the options keep them
/// @throws std::runtime_error for a piece that is larger than a sheet, for more than 1,000 kinds, 2,000 corners of a
/// piece, 400 different sheets, and 200,000 pieces on one sheet, and as offset_outline(); Stopped
CuttingPlan plan_cutting(std::vector<CutKind> kinds, const CuttingOptions& options, const Monitor& monitor);

/// The outline of a piece that is `growth` larger on all sides. @param what  the outline in messages: `a template`
/// @throws std::runtime_error for more than 2,000 corners, and as offset_outline()
std::vector<glm::dvec2> cut_outline(const CutKind& piece, double growth, std::string_view what);

}  // namespace sikku
