// art/plotter/passes.h: strokes that are wider than the pen, as parallel passes of it.
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
    bool is_closed = false;  ///< it ends where it began
};

/// Offsets to the left of the passes that cover a stroke, from the right to the left: as few as there can be, at most
/// one pen apart. A width that exceeds the last pass by less than a tenth of the pen is not covered. One pass in the
/// middle for strokes as wide as the pen or narrower. At most 10^5.
std::vector<double> pass_offsets(double width, double pen);

/// How many passes these are, without making them.
std::size_t pass_count(double width, double pen);
/// Checks the passes of one stroke. @throws std::runtime_error for more than 20 million pieces
void require_few_passes(std::size_t pieces, std::size_t passes);

/// Passes that cover a stroke of that width with a pen: an open stroke is one path to and fro, a closed one a closed
/// path for each pass. Ends and outer corners are round, as those of the stroke; the rims of ends are scalloped by
/// less than a pen. Nothing reaches beyond the stroke by more than `tolerance`, within which offsets of curves are
/// followed, too. A stroke without length becomes a spiral. All lengths are in one unit. Cost: linear in passes times
/// pieces. Source: Tiller & Hanson, Offsets of two-dimensional profiles, 1984.
std::vector<PenPath> pen_passes(const PenPath& stroke, double width, double pen, double tolerance);

}  // namespace sikku
