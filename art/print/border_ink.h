// art/print/border_ink.h: draws the parts of borders in the coordinates of the sides of the frame.
#pragma once

#include "art/print/border.h"
#include "art/print/print.h"

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// A side of the frame, clockwise. Coordinates are millimetres along it from its outer corner, and inwards from its
/// outer edge.
struct BorderSide {
    glm::dvec2 corner;
    glm::dvec2 along, inwards;
    double length = 0;
    glm::dvec2 at(glm::dvec2 point) const { return corner + point.x * along + point.y * inwards; }
};

/// The sides of the area within the margin of a window: top, right, bottom, left.
inline std::array<BorderSide, 4> border_sides(const Window& window) {
    const double left = window.left + window.margin, top = window.top + window.margin;
    const double width = window.width - 2 * window.margin, height = window.height - 2 * window.margin;
    return {{{{left, top}, {1, 0}, {0, 1}, width},
             {{left + width, top}, {0, 1}, {-1, 0}, height},
             {{left + width, top + height}, {-1, 0}, {0, -1}, width},
             {{left, top + height}, {0, -1}, {1, 0}, height}}};
}

/// Converts millimetres of the page, y down, into a drawing. Colour 0 is the first colour of the border.
class BorderInk {
public:
    BorderInk(const Print& print, int colour, PathSink& sink)
        : sink_(sink),
          placement_(print.placement),
          stroke_(print.style.stroke),
          back_(glm::inverse(glm::dmat2x2(placement_.to_page[0], placement_.to_page[1]))),
          colour_(colour) {}

    /// Converts a point of the page to the coordinates of the drawing.
    glm::dvec2 drawn(glm::dvec2 page) const { return back_ * (page - placement_.to_page[2]); }
    /// The map from millimetres of the page to the drawing.
    glm::dmat3x2 from_page() const { return {back_[0], back_[1], -1.0 * (back_ * placement_.to_page[2])}; }
    Pen pen(double millimetres, int colour) const {
        return {millimetres / (stroke_.in_steps ? placement_.step : 1.0) / stroke_.unit, true, colour_ + colour};
    }

    void begin(glm::dvec2 at, double width, int colour) { sink_.begin_stroke(drawn(at), pen(width, colour)); }
    void line(glm::dvec2 to) {
        const glm::dvec2 end = drawn(to);
        sink_.lines({&end, 1});
    }
    void curve(glm::dvec2 one, glm::dvec2 two, glm::dvec2 to) {
        const std::array<glm::dvec2, 3> controls = {drawn(one), drawn(two), drawn(to)};
        sink_.curves(controls);
    }
    void end(bool closed) { sink_.end_stroke(closed); }
    /// Draws quarters of a circle. @param from, heading  unit vectors from the centre and along the circle
    void arc(glm::dvec2 centre, double radius, glm::dvec2 from, glm::dvec2 heading, int quarters) {
        const double handle = 0.5522847498307936 * radius;
        for (int quarter = 0; quarter < quarters; ++quarter) {
            curve(centre + radius * from + handle * heading, centre + radius * heading + handle * from,
                  centre + radius * heading);
            from = std::exchange(heading, -from);
        }
    }

    void disc(glm::dvec2 centre, double radius, int colour) {
        sink_.disc(drawn(centre), radius / placement_.step, pen(1.0, colour));
    }
    void polygon(std::span<const glm::dvec2> corners, int colour) {
        points_.clear();
        for (const glm::dvec2 corner : corners) points_.push_back(drawn(corner));
        sink_.polygon(points_, pen(1.0, colour));
    }
    /// @param outline  a point, then three controls for each curve
    void area(std::span<const glm::dvec2> outline, int colour) {
        points_.clear();
        for (const glm::dvec2 point : outline) points_.push_back(drawn(point));
        sink_.area(points_, pen(1.0, colour));
    }
    PathSink& sink() { return sink_; }

private:
    PathSink& sink_;
    Placement placement_;
    StrokeWidth stroke_;
    glm::dmat2x2 back_;
    int colour_;
    std::vector<glm::dvec2> points_;
};

namespace border {

inline constexpr int flour = 0, earth = 1;  ///< colours of BorderInk

inline const BorderSide& next(std::span<const BorderSide, 4> sides, std::size_t side) {
    return sides[(side + 1) % 4];
}

/// The repeats of both kinds of sides, whose corners take `corner` of each end; `multiple` of them belong together.
inline BorderRepeats repeats_of(std::span<const BorderSide, 4> sides, double corner, double length,
                                int multiple = 1) {
    BorderRepeats repeats =
        border_repeats(sides[0].length - 2 * corner, sides[1].length - 2 * corner, multiple * length);
    repeats.across *= multiple;
    repeats.down *= multiple;
    return repeats;
}

inline int count_of(const BorderRepeats& repeats, std::size_t side) {
    return side % 2 == 0 ? repeats.across : repeats.down;
}

/// A closed line at a distance from the outer edge.
inline void draw_rectangle(std::span<const BorderSide, 4> sides, double inset, double width, int colour,
                           BorderInk& ink) {
    ink.begin(sides[0].at({inset, inset}), width, colour);
    for (std::size_t i = 0; i < 4; ++i) ink.line(next(sides, i).at({inset, inset}));
    ink.end(true);
}

}  // namespace border

/// Draw the borders of BorderKind with these names within `sides`, at this depth in millimetres.
void draw_padi(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_lotus(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_rope(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_diamonds(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_waves(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_marigolds(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);
void draw_lamps(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink);

}  // namespace sikku
