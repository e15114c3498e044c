// art/relief/shapes.h: the visible shapes of a drawing in millimetres, collected for a relief.
#pragma once

#include "art/plotter/plot_layer.h"
#include "art/print/print.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

struct ReliefShape {
    enum class Kind : std::uint8_t { polygon, area, disc, line };
    Kind kind = Kind::polygon;
    bool is_closed = false;          ///< a line that ends where it begins, with that point again at the end
    int colour = 0;                  ///< index of the first equal colour in the palette
    double radius = 0;               ///< radius of a disc; half the width of a line
    std::size_t begin = 0, end = 0;  ///< range of its points
};

/// Deviation of chords from curves in millimetres.
constexpr double relief_tolerance = 0.01;

/// Collects shapes from the bottom left corner of the page, y up, with curves as chords.
class ReliefShapes : public PathSink {
public:
    /// @param print  placed; kept by reference  @param most  maximum number of points
    ReliefShapes(const Print& print, std::size_t most);

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    /// Removes lines that run along edges of polygons. Cost: n log n. @throws Stopped
    void drop_edges(const Monitor& monitor);

    const std::vector<ReliefShape>& shapes() const { return shapes_; }
    std::span<const glm::dvec2> points(const ReliefShape& shape) const {
        return std::span(points_).subspan(shape.begin, shape.end - shape.begin);
    }
    Colour colour(const ReliefShape& shape) const;

private:
    glm::dvec2 place(glm::dvec2 point) const;
    void require_room() const;
    void add(glm::dvec2 point);
    void add_to_line(glm::dvec2 point);
    void take(const Pen& pen);
    void start_line();
    void end_line(bool closed);
    void end_shape(ReliefShape shape);

    const Print& print_;
    std::size_t most_;
    std::vector<int> line_slots_, fill_slots_;
    std::vector<glm::dvec2> points_;
    std::vector<ReliefShape> shapes_;
    // The line that is being drawn.
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool is_visible_ = false, is_whole_ = true;
    std::vector<glm::dvec2> line_;  ///< its points; other shapes may arrive in between
    PlotNodes corners_;             ///< corners of polygons, shared by neighbours
};

}  // namespace sikku
