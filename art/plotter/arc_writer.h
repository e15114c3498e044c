// art/plotter/arc_writer.h: the common base of the writers that approximate curves by few arcs and lines.
#pragma once

#include "art/plotter/plot_writer.h"

#include <vector>

namespace sikku {

/// An arc from one point to another around a centre, anticlockwise if `is_left`.
struct PlotArc {
    glm::dvec2 centre{0.0};
    bool is_left = false;
};

/// Follows curves by lines and arcs that stay within 0.0075 mm of them, with radii up to 1 m and less than 270
/// degrees each, with a greedy search. Lengths are millimetres.
class ArcWriter : public PlotWriter {
public:
    void lines(std::span<const glm::dvec2> ends) final;

protected:
    /// @param arcs  false: lines only @param least  shorter arcs become lines
    ArcWriter(const Print& print, Output& file, bool arcs, double least);

    void curve_point(glm::dvec2 point) override;
    /// Begins a curve at a point.
    void begin_curve(glm::dvec2 at) { points_ = {at}; }
    /// Passes on all pending points. A line or a curve may follow.
    void finish_curve() { follow(true); }
    virtual void line_to(glm::dvec2 end) = 0;
    virtual void arc_to(const PlotArc& arc, glm::dvec2 end) = 0;

private:
    void follow(bool is_all);
    bool is_short(std::span<const glm::dvec2> points) const;

    bool arcs_;
    double least_;
    std::vector<glm::dvec2> points_;  ///< from the end of the last line or arc passed on
};

}  // namespace sikku
