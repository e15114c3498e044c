// art/tile_templates.h: templates of the pieces of a tiling, for quilters and cutters.
#pragma once

#include "art/print/format.h"
#include "engine/base/output.h"
#include "engine/tiling/cut_list.h"

#include <filesystem>
#include <span>
#include <string>

namespace sikku {

struct TemplateOptions {
    double seam = 6;  ///< seam allowance around each piece, in millimetres, 0 to 100
    double kerf = 0;  ///< width of a cut, in millimetres, 0 to 10: outlines grow by half of it
    std::string title;
    std::string pattern;  ///< text of the pattern file, stored in the output
};

/// An outline moved outwards by a distance. Corners are mitred; the tips of those whose mitre would be longer than
/// twice the distance are cut off there. @param corners  anticlockwise
/// @throws std::runtime_error if the result crosses itself, as in notches narrower than twice the distance
std::vector<glm::dvec2> offset_outline(std::span<const glm::dvec2> corners, double distance);

/// Writes one template for each shape and hand, in rows on one page that is as large as they need: the outline to
/// cut, the finished size dashed within it, and the names of its kinds with their numbers of pieces. In DXF they are
/// the layers CUT, SEAM and LABEL.
/// @param format  svg, pdf or dxf
/// @throws std::runtime_error for more than 1,000 templates, for one with more than 2,000 corners, for a page wider
/// or higher than 10 m, and as offset_outline()
void write_templates(const std::vector<CutKind>& kinds, const TemplateOptions& options, PrintFormat format,
                     const std::filesystem::path& file, Destination& destination);

}  // namespace sikku
