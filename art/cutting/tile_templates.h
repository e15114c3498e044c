// art/cutting/tile_templates.h: templates of the pieces of a tiling, for quilters and cutters.
#pragma once

#include "art/cutting/piece_drawing.h"
#include "engine/base/output.h"
#include "engine/tiling/cut_list.h"

#include <filesystem>

namespace sikku {

struct TemplateOptions {
    double seam = 6;  ///< seam allowance around each piece, in millimetres, 0 to 100
    double kerf = 0;  ///< width of a cut, in millimetres, 0 to 10; outlines grow by half of it
};

/// Writes one template for each shape and hand, in rows on one page that is as large as they need: the outline to
/// cut, the finished size dashed within it, and the names of its kinds with the number of pieces of each.
/// @throws std::runtime_error for more than 1,000 templates, for one with more than 2,000 corners, for a page wider
/// or higher than 10 m, and as offset_outline() and write_pieces()
std::vector<DrawReport> write_templates(const std::vector<CutKind>& kinds, const TemplateOptions& options,
                                        PieceWriting writing, const std::filesystem::path& file,
                                        Destination& destination);

}  // namespace sikku
