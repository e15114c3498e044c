// art/deep/spline_pieces.h: draws the visible pieces of splines.
#pragma once

#include "art/print/print.h"
#include "engine/geometry/spline.h"

#include <vector>

namespace sikku {

/// Turns the visible strokes of a View into splines. Where a line leaves or enters the visible area, its curve is
/// wrong for six steps; at its real ends it equals that of SplineSink, and a closed line is smooth where it closes,
/// however many pieces of it are visible. Memory: the first piece of a line, which waits for the line's end.
class SplinePieces : public BlotSink {
public:
    /// @param tolerance  distance in steps within which points are the same
    SplinePieces(PathSink& sink, double tolerance) : spline_(sink, closed_), tolerance_(tolerance) {}

    void begin_line(glm::dvec2 at) override;
    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void end_line(glm::dvec2 at) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;
    void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) override;
    std::size_t prepare(const Blot&, const Pen&) override { return 0; }
    void blot(std::size_t, glm::dvec2) override {}

private:
    bool same(glm::dvec2 a, glm::dvec2 b) const;
    void begin(glm::dvec2 start, bool closed);
    void end_last();

    std::vector<bool> closed_;  // for each stroke begun
    SplineSink spline_;
    double tolerance_;
    Pen pen_;
    glm::dvec2 line_start_{0.0};
    std::vector<glm::dvec2> first_;  // points of the piece with which the line begins, if it is visible
    bool is_first_ = false;          // that piece is being gathered
    bool is_open_ = false;           // another piece has been begun and not ended
    bool may_be_first_ = false;      // no piece of this line has been visible
    glm::dvec2 at_{0.0};
};

}  // namespace sikku
