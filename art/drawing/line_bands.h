// art/drawing/line_bands.h: draws lines as bands of parallel lines that pass over and under each other.
#pragma once

#include "art/drawing/line_tips.h"
#include "art/kolam/curve_meetings.h"
#include "art/print/print.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// The parallel lines of a band in one print, in turtle steps.
struct BandLook {
    int count = 1;
    double spacing = 0.0;  ///< from the middle of one line to the next
    double wanted = 0.0;   ///< the spacing that the style requests
    double width = 0.0;    ///< width of a line
    double thinner = 1.0;  ///< factor of the widths of pens, where the lines would run into each other
    double gap = 0.0;      ///< gap beside an upper band
    double band() const { return (count - 1) * spacing + width; }
};

/// Lines with the places where they pass under others. Strands are parallel to the line they belong to, within 0.5
/// percent of their width. Lower bands are interrupted where they come nearer to the upper line than half its band
/// and a gap, measured to the round ends of its lines.
class LineBands {
public:
    /// Keeps references to the lines and meetings. Parallel lines are limited by the tightest turn but for pointed
    /// tips, inside of which they end where they cross, and by the least distance of lines beside each other.
    /// @throws std::runtime_error if the style requests a weave that cannot alternate; Stopped
    LineBands(const CurvedLines& lines, const CurveMeetings& meetings, const Style& style, const Monitor& monitor);

    /// @param print  placed
    /// @throws std::runtime_error if there is no room for parallel lines
    BandLook look(const Print& print) const;
    /// Draws all lines. @param colour  palette index of a line's number, or -1 for that of its pen
    void draw(const Print& print, const std::function<int(std::size_t)>& colour, PathSink& sink) const;
    std::size_t crossings() const { return diagram_.diagram.crossings(); }

private:
    struct Part {
        Bezier curve;
        const CurvePiece* piece;
    };
    void weave(const Monitor& monitor);
    void measure_tips(double step, const Monitor& monitor);
    void measure_turns(const Monitor& monitor);
    std::vector<bool> places_in_tips(std::size_t line) const;
    void measure_distance(const Monitor& monitor, double most);
    void measure_crossings();
    /// Positions along a line from which to which something is drawn, or left out.
    using Sections = std::vector<std::pair<double, double>>;
    std::span<const LineTip> tips_of(std::size_t line) const;
    Sections sections(std::size_t line, double offset, const Sections& omitted, const BandLook& look) const;
    double cut(std::size_t line, std::size_t pass, bool is_forward, double offset, const BandLook& look) const;
    Sections left_out(std::size_t line, double offset) const;
    void draw_section(std::size_t line, std::pair<double, double> section, double offset, const Sections& omitted,
                      const BandLook& look, int colour, PathSink& sink) const;

    const CurvedLines& lines_;
    const CurveMeetings& meetings_;
    Style style_;
    CurveDiagram diagram_;
    std::vector<std::size_t> upper_;                         ///< for each crossing the mark of the upper strand
    std::vector<LineTip> tips_;                              ///< sorted by line
    double least_tip_ = std::numeric_limits<double>::max();  ///< farthest parallel inside of every tip
    double least_radius_ = std::numeric_limits<double>::max();
    double least_distance_ = std::numeric_limits<double>::max();  ///< between lines beside each other
    double least_corner_ = std::numeric_limits<double>::max();    ///< farthest parallel with corners in their order
    double least_run_ = std::numeric_limits<double>::max();       ///< along a line from crossing to crossing
};

}  // namespace sikku
