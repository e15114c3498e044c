// art/plotter/passes.h: covers wide strokes with parallel passes of a narrower pen.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <vector>

namespace sikku {

/// A stroke of lines and Béziers.
struct PenPath {
    struct Piece {
        bool is_curve = false;
        glm::dvec2 first{0.0}, second{0.0};  ///< control points of a Bézier
        glm::dvec2 end{0.0};
    };
    glm::dvec2 start{0.0};
    std::vector<Piece> pieces;
    bool is_closed = false;  ///< true if it ends where it began
};

/// Offsets of the passes that cover a stroke, positive to the left, from right to left: as few as possible, at most
/// one pen apart. A rest of less than a tenth of the pen is not covered. Strokes no wider than the pen have one pass
/// in the middle. At most 10^5.
std::vector<double> pass_offsets(double width, double pen);

/// The number of these passes, without computing them.
std::size_t pass_count(double width, double pen);
/// Checks the passes of one stroke. @throws std::runtime_error for more than 20 million pieces
void require_few_passes(std::size_t pieces, std::size_t passes);

/// Passes that cover a stroke of that width: an open stroke is one path back and forth, a closed one has a closed
/// path for each pass. Ends and outer corners are round, like those of the stroke; the rims of ends are scalloped by
/// less than a pen. No pass exceeds the stroke by more than `tolerance`, which also bounds the error of offset
/// curves. A stroke without length becomes a spiral. All lengths are in one unit. Cost: linear in passes times
/// pieces. Source: Tiller & Hanson, Offsets of two-dimensional profiles, 1984.
std::vector<PenPath> pen_passes(const PenPath& stroke, double width, double pen, double tolerance);

}  // namespace sikku
