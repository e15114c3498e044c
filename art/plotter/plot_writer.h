// art/plotter/plot_writer.h: the common base of the writers of HP-GL, G-code and DXF.
#pragma once

#include "art/print/print.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <array>
#include <map>
#include <span>

namespace sikku {

/// Writes all strokes it receives from PlotPlan::draw() in the language of a plotter, in the colours of their pens.
/// Ignores areas, discs and widths, and polygons unless the format has layers for tiles.
class PlotWriter : public PathSink {
public:
    void change_pen(const Pen& pen) final;
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void area(std::span<const glm::dvec2>, const Pen&) final {}
    void disc(glm::dvec2, double, const Pen&) final {}

    /// Numbers the pens from 1 before they are used, so that a plot that is resumed keeps its numbers.
    void number_pens(std::span<const Pen> pens);
    /// Dips the pen at a place in millimetres from the bottom left corner of the page, y up.
    virtual void dip(glm::dvec2 place, const Pen& pen) = 0;
    /// Completes the file; to be called once, after the last stroke.
    virtual void finish() = 0;

protected:
    explicit PlotWriter(const Print& print) : print_(print) {}

    using Bezier = std::array<glm::dvec2, 4>;
    /// Millimetres from the bottom left corner of the page, y up.
    glm::dvec2 on_page(glm::dvec2 point) const;
    /// Number of a pen, from 1 in the order of appearance; plotters hold six or eight pens.
    int number(const Pen& pen);
    /// The numbers given so far, by colour index.
    const std::map<int, int>& numbers() const { return numbers_; }
    /// Number of equal steps of its parameter for which the chords of a curve stay within `tolerance`.
    /// Source: Wang, Proc. SPIE, 1984: by the second differences.
    static int chords(const Bezier& bezier, double tolerance);
    static glm::dvec2 at(const Bezier& bezier, double t);
    /// @throws std::runtime_error  off the page, where a plotter would run against its stops
    void require_on_page(glm::dvec2 millimetres) const;

    const Print& print_;
    glm::dvec2 here_{0.0};  ///< end of the stroke so far, in pattern units

private:
    std::map<int, int> numbers_;  ///< numbers of pens, by colour index
};

}  // namespace sikku
