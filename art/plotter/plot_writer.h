// art/plotter/plot_writer.h: the common base of the writers of HP-GL, G-code and DXF.
#pragma once

#include "art/print/print.h"
#include "engine/base/output.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <map>
#include <span>
#include <utility>

namespace sikku {

/// Writes all strokes it receives from PlotPlan::draw() in the language of a plotter, in the colours of their pens.
/// Ignores areas, discs and widths, and polygons unless the format has layers for tiles.
class PlotWriter : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void curves(std::span<const glm::dvec2> controls) final;
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
    /// @param tolerance  distance of curves from their chords, in millimetres @param least_chords  of a curve
    PlotWriter(const Print& print, Output& file, double tolerance, int least_chords)
        : print_(print), file_(file), tolerance_(tolerance), least_chords_(least_chords) {}

    /// Takes the pen of that number.
    virtual void take_pen(int next, Colour) { pen_ = next; }
    void take_pen(const Pen& pen) {
        if (const int next = number(pen); next != pen_) take_pen(next, print_.style.line_colour(pen));
    }
    /// Lowers the pen at here_, unless it is down. Called only when something is drawn, since a stroke may change its
    /// pen before.
    void start() {
        if (!std::exchange(started_, true)) put_down(on_page(here_));
    }
    virtual void put_down(glm::dvec2 millimetres) = 0;
    /// Receives the next point of a curve, in millimetres of the page.
    virtual void curve_point(glm::dvec2 point) = 0;

    /// Millimetres from the bottom left corner of the page, y up.
    glm::dvec2 on_page(glm::dvec2 point) const;
    /// Number of a pen, from 1 in the order of appearance; plotters hold six or eight pens.
    int number(const Pen& pen);
    /// The numbers given so far, by colour index.
    const std::map<int, int>& numbers() const { return numbers_; }
    /// @throws std::runtime_error  off the page, where a plotter would run against its stops
    void require_on_page(glm::dvec2 millimetres) const;

    const Print& print_;
    Output& file_;
    glm::dvec2 here_{0.0};  ///< end of the stroke so far, in pattern units
    int pen_ = 0;           ///< number of the current pen; 0: none yet
    bool started_ = false;  ///< the pen is down

private:
    double tolerance_;
    int least_chords_;
    std::map<int, int> numbers_;  ///< numbers of pens, by colour index
};

}  // namespace sikku
