// art/cutting/nested_sheets.h: plans sheets of pieces of different shapes that are placed one by one.
#pragma once

#include "art/cutting/piece_nest.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Pieces on a sheet, and the number of such sheets.
struct SheetDraft {
    std::vector<NestedPiece> pieces;
    std::uint64_t copies = 1;
};

/// Pieces of one outline.
struct NestKind {
    Outline outline;  ///< anticlockwise, with half of the gap between pieces
    std::uint64_t pieces = 0;
    const PieceRows* rows = nullptr;
};

/// Fills one sheet after another: with rows of the largest kind and other pieces beside them, or with pieces that lie
/// as high as possible, whichever leaves less for the next sheet. Then repeatedly takes out the pieces in a small
/// window and lays them anew, unless the result is worse ("ruin and recreate", Schrimpf et al. 2000); continues
/// longer where that may save a sheet. The windows are pseudo-random; the plan is the same in every run. Cost: some
/// seconds.
/// @param kinds  the largest first  @param rows  a plan of these pieces  @param area  of a sheet, within its margins
/// @param effort  share of the usual effort, up to 1
/// @param sheet_limit  number of different sheets after which nothing is returned
/// @return empty if pieces have too many corners, if there are more than 1,500 on a sheet of `rows`, or if sheets
/// would take too long  @throws Stopped
std::vector<SheetDraft> nest_sheets(std::span<const NestKind> kinds, const std::vector<SheetDraft>& rows,
                                    const Box& area, bool keeps_direction, double effort, std::size_t sheet_limit,
                                    const Monitor& monitor);

/// The least y coordinate of the outlines of pieces.
double lowest_of(std::span<const NestKind> kinds, const std::vector<NestedPiece>& pieces);

/// The number of sheets, with copies.
std::uint64_t count_of(const std::vector<SheetDraft>& sheets);

/// True if sheets are fewer than others, or as many, and more of one of them is left below its pieces.
bool needs_less(std::span<const NestKind> kinds, const std::vector<SheetDraft>& sheets,
                const std::vector<SheetDraft>& others);

}  // namespace sikku
