// art/hand/hand_line.h: the lines of a drawing as sampled curves, gathered and put in order for a hand to draw.
#pragma once

#include "art/style/style.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/path.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// A point of a line. Lengths are turtle steps.
struct HandNode {
    glm::dvec2 at{0.0};
    double along = 0;     ///< length of the line up to here
    double half = 0;      ///< half of its width
    double room = 1e300;  ///< distance to the nearest line that runs beside it
    double flow = 1;      ///< flour, relative to that of a full hand
    double fresh = 0;     ///< 1 where a pinch of flour begins, 0 half a loop later
};

/// A line of one colour. The nodes of a closed line do not repeat the first one at the end.
struct HandLine {
    std::vector<HandNode> nodes;
    double length = 0;  ///< length; for a closed line, back to its first node
    bool closed = false;
    Pen pen;                   ///< pen at its beginning; nodes contain the widths
    std::uint64_t number = 0;  ///< position in the drawing, which seeds its random choices
    double loop = 1;           ///< diameter of a circle that bends as much as the line does on average

    std::size_t size() const { return nodes.size(); }
    /// Index of a neighbour: closed lines go round, open ones end.
    std::size_t next(std::size_t i) const { return i + 1 < size() ? i + 1 : closed ? 0 : i; }
    std::size_t previous(std::size_t i) const { return i > 0 ? i - 1 : closed ? size() - 1 : 0; }
    /// Length from a node to the next one.
    double step(std::size_t i) const {
        return i + 1 < size() ? nodes[i + 1].along - nodes[i].along : closed ? length - nodes[i].along : 0;
    }
};

/// A dot: the centre and the radius of a disc, in steps.
struct HandDot {
    glm::dvec2 at{0.0};
    double radius = 0;
    Pen pen;
};

/// A filled shape under the lines: the vertices of a polygon, or the outline of an area for PathSink::area().
struct HandFill {
    std::vector<glm::dvec2> outline;
    bool is_polygon = false;
    Pen pen;
};

/// Direction of the line at a node, of length about 1.
glm::dvec2 hand_direction(const HandLine& line, std::size_t i);
/// The same, of length 1.
glm::dvec2 hand_unit_direction(const HandLine& line, std::size_t i);
/// The angle in radians by which the line turns to the left at a node.
double hand_turn(const HandLine& line, std::size_t i);
/// Computes the lengths along the line from the places of its nodes.
void measure_again(HandLine& line);

/// Puts lines into the order of a hand and gives each a start and a direction, seen with y up, before the drawing is
/// rotated or mirrored on its page:
/// - A closed line begins in a run at the upper left of its box and goes round anticlockwise. An open one begins at
///   its upper left end. People begin at the top left and, with the right hand, draw circles anticlockwise.
/// - Lines follow each other from the centre of the drawing outwards, as around the first dots. Lines of equal length
///   and distance from the centre, images of each other, form a group that is drawn anticlockwise from the top left.
/// Cost: O(n log n). Source: Goodnow & Levine, The grammar of action, Cognitive Psychology 4 (1973); van Sommers,
/// Drawing and Cognition, 1984.
void order_by_hand(std::vector<HandLine>& lines);

/// Gathers the visible lines, dots and fills of a drawing. Corners become short bends; a line ends where its colour
/// changes. Edges of fills are divided into pieces that a line can take along.
class HandGatherer : public PathSink {
public:
    /// @param step  millimetres of a turtle step  @param most  maximum number of curves; more throw BudgetError
    HandGatherer(const Style& style, double step, double most)
        : style_(style), step_(step), most_(most), most_points_(8 * most) {}
    /// Limits the size of a drawing for a lesson. @param lines, points  maximum numbers; more throw BudgetError
    void limit(std::size_t lines, double points) {
        most_lines_ = lines;
        most_points_ = std::min(most_points_, points);
    }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    std::vector<HandLine> gathered;
    std::vector<HandDot> dots;
    std::vector<HandFill> fills;

private:
    struct Piece {
        Bezier curve;
        double length;
        double half;
    };
    static double loop_of(const std::vector<Piece>& pieces, bool closed);
    void add(const Bezier& curve);
    void finish(bool closed);
    void count_points(double more);
    bool fills_with(const Pen& pen) const { return style_.fill_colour(pen).alpha > 0; }
    double half_width() const { return style_.line_width(pen_, step_) / step_ / 2; }

    const Style& style_;
    double step_;
    double most_, most_points_;
    std::optional<std::size_t> most_lines_;
    double count_ = 0, points_ = 0;
    std::vector<Piece> pieces_;
    Pen pen_, first_pen_;
    glm::dvec2 at_{0.0}, start_{0.0};
    bool is_whole_ = false;  ///< the stroke has had one colour so far
};

}  // namespace sikku
