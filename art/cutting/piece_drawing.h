// art/cutting/piece_drawing.h: draws pieces to cut on sheets, and writes them in all formats of prints.
#pragma once

#include "art/print/outline.h"
#include "art/writer/draw_options.h"
#include "engine/base/output.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sikku {

/// A piece in its direction. Millimetres, y up.
struct PieceShape {
    std::vector<glm::dvec2> cut;   ///< the outline to cut
    std::vector<glm::dvec2> seam;  ///< the finished size within it; empty: not drawn
    std::string label;
    LabelPlace place{};
};

struct PieceSheet {
    struct Piece {
        std::size_t shape = 0;
        glm::dvec2 at{0.0};  ///< from the bottom left corner of the sheet
    };
    struct Heading {
        std::string text;
        LabelPlace place{};
    };
    Page page;
    std::vector<Piece> pieces;
    std::vector<Heading> headings;
};

struct PieceWriting {
    std::string title;
    std::string pattern;  ///< text of the pattern file, stored in the output
    std::string made;     ///< the recipe
    double dpi = 300;
    bool shares_cuts = false;  ///< cuts that neighbours share are drawn once and joined into long strokes
    DrawOptions drawing{};     ///< with the format, the plot and the monitor
};

/// The names of several files: `x.svg` becomes `x-1.svg`, with as many digits as `count` has. A single file keeps its
/// name.
std::vector<std::filesystem::path> sheet_files(const std::filesystem::path& file, std::size_t count);

/// Writes sheets, each into its own file of sheet_files(), or as pages of one PDF. Labels, seams (dashed) and cuts
/// have separate pens, and in DXF the layers LABEL, SEAM and CUT, in this order, so that pieces are cut out last.
/// Files appear together or not at all. @throws as draw()
std::vector<DrawReport> write_pieces(const std::vector<PieceShape>& shapes, const std::vector<PieceSheet>& sheets,
                                     const PieceWriting& writing, const std::filesystem::path& file,
                                     Destination& destination);

/// True if each sheet has its own file; false if all are pages of one.
bool has_several_files(const PieceWriting& writing);

}  // namespace sikku
