// art/drawing/map_drawing.h: maps with placed vertices: cells, walls and tissue.
#pragma once

#include "art/drawing/drawing.h"
#include "art/drawing/map_frames.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

/// Draws the tissue, then cells, then walls, according to the style's `map`. Each wall is drawn once, and two edges
/// that meet in a vertex without others become one stroke. Source: Prusinkiewicz & Lindenmayer, Fractals and plants,
/// section 5.
class MapDrawing : public Drawing {
public:
    /// @param scale_percent  share of the page that a fitted drawing fills
    MapDrawing(std::shared_ptr<const MapFrame> map, const Style& style, const DrawingOptions& options,
               const Reading& reading, double scale_percent);

    const DrawnExtent& seen() override;
    const Style& style() const override { return style_; }
    double scale() const override { return options_.placement.scale * scale_percent_ / 100; }
    Balance balance() const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawingReport& report) const override;

private:
    struct WallStroke {
        std::vector<std::uint32_t> vertices;
        std::uint32_t age = 1;  ///< age of its walls in steps, counted from 1
        bool is_closed = false;
        bool is_growing = false;  ///< one new wall, drawn in part
    };
    void add_colours();
    void chain_walls();
    Pen cell_pen(std::size_t cell) const;
    void read_cells(PathSink& sink) const;
    void read_walls(PathSink& sink) const;
    std::uint32_t wall_age(std::size_t edge) const;
    std::vector<glm::dvec2> corners(std::span<const HalfEdge> wall) const;

    std::shared_ptr<const MapFrame> map_;
    Style style_;  ///< with the colours of cells and tissue in its palette
    double scale_percent_ = 100;
    int first_class_ = 0;  ///< palette indices
    int tissue_ = 0;
    std::vector<WallStroke> walls_;  ///< thin ones first
    std::optional<DrawnExtent> extent_;
    bool is_outside_ = false;
};

/// A closed uniform Beta-spline with the corners as control points, as Béziers: the point where it begins, then three
/// control points for each piece. Bias 1. @param tension  0 or more; 0 is the B-spline
/// Source: Barsky 1981; The Algorithmic Beauty of Plants, 1990, section 7.
std::vector<glm::dvec2> closed_beta_spline(const std::vector<glm::dvec2>& corners, double tension);

}  // namespace sikku
