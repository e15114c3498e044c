// art/drawing/drawing_report.h: findings about a finished drawing.
#pragma once

#include "art/style/colour.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

/// Parallel lines as they were drawn, in millimetres.
struct ParallelReport {
    double spacing = 0.0;  ///< from the middle of one to the next
    double wanted = 0.0;   ///< the requested spacing, which is larger where there was no room
    double width = 0.0;    ///< width of each line
};

/// A colour that is hardly visible on its ground.
struct FaintInk {
    enum class Kind : std::uint8_t { lines, discs, areas };
    Kind kind = Kind::lines;
    Colour ink, ground;
};

/// The kinds of shapes in a drawing, and the palette indices they are drawn in.
struct Contents {
    bool has_polygons = false, has_areas = false, has_discs = false;
    std::vector<int> lines, fills;  ///< sorted
    bool has_fills() const { return has_polygons || has_areas || has_discs; }
};

/// The closed regions of a colouring page.
struct RegionReport {
    std::size_t count = 0;
    double least = 0.0;  ///< area of the smallest between the lines, in mm²
};

/// Findings about a finished drawing.
struct DrawingReport {
    double step = 0.0;                       ///< millimetres of one turtle step
    glm::dvec2 size{0.0};                    ///< size of the drawing with its pen, in millimetres
    glm::dvec2 room{0.0};                    ///< room on the page, within margins and border
    bool overflows = false;                  ///< it is larger than the page within its margins (a step was given)
    std::size_t dots = 0;                    ///< number of kolam dots drawn
    double covered = 0;                      ///< share of a wallpaper that the copies cover, by their convex hulls
    double covered_if_packed = 0;            ///< the same for `packed`
    std::size_t copies = 0;                  ///< number of copies of a repeated drawing
    std::optional<std::size_t> strokes;      ///< number of lines of all copies, or of a weave before it is cut
    std::size_t fields = 0;                  ///< number of fields between lines, filled or not
    std::optional<std::size_t> woven;        ///< number of crossings of a weave
    std::optional<ParallelReport> parallel;  ///< report of parallel lines
    std::optional<RegionReport> regions;     ///< regions of a colouring page
    bool tiles_are_alike = false;            ///< `tile colours` gave all tiles, more than one, the same colour
    bool lacks_worms = false;                ///< worms were requested, but no tiles form any
    std::uint64_t replaced = 0;              ///< parts too small to be resolved, replaced by their appearance
    std::size_t cells = 0;                   ///< number of cells of a map
    bool has_one_strand_colour =
        false;                    ///< colours by strand are those of the drawing: there is one strand, or orbit
    bool crosses_itself = false;  ///< the outline of a map crosses itself
    bool cuts_title = false;      ///< the title line is too long for its place
    bool cuts_edition = false;    ///< the edition is too long for its place
    bool is_empty = false;        ///< the window contains no part of the drawing
};

}  // namespace sikku
