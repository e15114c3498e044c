// art/drawing/line_work.h: the fields, the weave and the parallel lines of a drawing.
#pragma once

#include "art/drawing/line_bands.h"
#include "art/drawing/word_drawing.h"
#include "art/kolam/fields.h"
#include "art/kolam/kolam.h"
#include "art/plotter/clear_hatch.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sikku {

/// True if a style requests fields, a weave or parallel lines.
bool has_line_work(const Style& style);

/// Cost of a segment of line work in nodes, by memory and time.
constexpr double nodes_of_worked_segment = 400;

/// The lines of a drawing as curves, with their fields, weave and parallel lines.
class LineWork {
public:
    /// Reads the drawing once and finds where its lines meet, and its fields.
    /// @param style  of the pattern, with its own palette
    /// @throws BudgetError; std::runtime_error if curved lines run along each other, or if a weave cannot alternate
    LineWork(const WordDrawing& drawing, const KolamExamination& examination, const Style& style,
             const ReadingLimits& limits);
    LineWork(const LineWork&) = delete;
    LineWork& operator=(const LineWork&) = delete;

    /// True if the lines are drawn by draw_lines(), and not as the pattern draws them.
    bool draws_lines() const { return bands_ != nullptr; }
    std::size_t lines() const { return lines_.lines.size(); }
    std::size_t fields() const { return fields_.size(); }
    std::size_t crossings() const { return bands_ ? bands_->crossings() : 0; }
    /// Appends the colours of the fields to a palette. @param others  colours of the lines
    /// and the ground, which sets of powders avoid
    void add_colours(std::vector<Colour>& palette, std::span<const Colour> others);
    /// Fills the fields, with colours of that palette.
    void draw_fields(PathSink& sink) const;
    /// Fills the fields for a plotter: with lines of one pen that end where the ink of lines and dots begins, without
    /// outlines, which would run along the lines. @param print  placed @param plot  with a hatch
    /// @param ink  lines and discs that are drawn over the fields, in steps, each with half its own width
    void hatch_fields(const Print& print, const PlotPen& plot, const Monitor& monitor,
                      const std::vector<Obstacle>& ink, PathSink& sink) const;
    /// Palette indices of the fields that are filled.
    const std::vector<int>& field_colours() const { return colours_; }
    /// @param colours  palette indices of the orbits of lines, repeated from the end; empty: of the pens
    void draw_lines(const Print& print, std::span<const int> colours, PathSink& sink) const;
    /// Maximum width that a band of parallel lines adds to its pen, in the unit of the style's stroke.
    double parallel_width() const;
    /// Strands of a print; only if draws_lines().
    BandLook look(const Print& print) const { return bands_->look(print); }

private:
    std::vector<std::size_t> fields_by_colour() const;

    Style style_;
    CurvedLines lines_;
    CurveMeetings meetings_;
    std::vector<Field> fields_;
    std::vector<std::uint32_t> classes_;
    std::vector<int> colours_;  ///< palette index of each field, or -1
    std::unique_ptr<LineBands> bands_;
};

/// Collects the ink of lines and discs, in steps, as a plotter draws it.
class InkSink : public PathSink {
public:
    /// @param pen  width of the plotter's pen in millimetres; 0: each line has a pen of its own width
    InkSink(const Print& print, double pen) : print_(print), pen_(pen) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void area(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    std::vector<Obstacle> ink;

private:
    const Print& print_;
    double pen_;
    glm::dvec2 at_{0.0};
    double radius_ = 0;  ///< radius of the current line; 0: it is invisible
};

/// Forwards only polygons, discs and labels.
class OnlyAreas : public WithoutStrokes<PathFilter> {
public:
    using WithoutStrokes::WithoutStrokes;
    void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) override {
        sink_.label(text, centre, height, pen);
    }
};

}  // namespace sikku
