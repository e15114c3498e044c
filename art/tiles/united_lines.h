// art/tiles/united_lines.h: lines and the edges of tiles, each piece once, and the tiles on either side of it.
#pragma once

#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Unites straight lines that lie on each other, wholly or in part, and finds the pieces of edges that tiles share.
/// Lines count as one if they deviate by less than a billionth of the drawing's size.
class UnitedLines {
public:
    /// Pieces to keep. `all`; `apart`: all, without joining pieces between two tiles to others; `border`: those that
    /// do not lie between two tiles; `none`; `sides`: pieces of the edges of tiles, without lines; `cuts`: all, with
    /// each piece of the border by itself.
    enum class Kept : std::uint8_t { all, apart, border, none, sides, cuts };
    struct Line {
        glm::dvec2 from, to;
        Pen pen;
        bool is_inner = false;   ///< between two tiles
        bool is_border = false;  ///< with Kept::cuts: on the edge of one tile, which lies on its left
    };
    /// A piece of an edge, with the tiles on either side of it; at least one.
    struct Side {
        glm::dvec2 from, to;
        std::optional<std::uint32_t> left, right;
    };
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    struct Result {
        std::vector<Line> lines;  ///< in the order in which they were drawn first, with the pen that drew them first
        std::vector<Pair> neighbours;  ///< tiles that share a piece, the smaller number first; ascending, each once
        std::vector<std::uint32_t> border;  ///< tiles with a piece that no other tile shares, ascending
        std::vector<Side> sides;            ///< with Kept::sides, line by line
    };

    /// @param most  maximum number of edges and lines
    explicit UnitedLines(double most) : most_(most) {}

    /// @throws BudgetError if there are too many
    void add_line(glm::dvec2 from, glm::dvec2 to, const Pen& pen);
    /// Adds the edges of a polygon, whose number is the number of tiles so far. @throws BudgetError
    void add_tile(std::span<const glm::dvec2> corners);
    std::uint32_t tiles() const { return tiles_; }

    /// Unites all pieces. Cost: n log n. Memory: 80 bytes for each line and edge. @throws Stopped
    Result unite(Kept kept, const Monitor& monitor) const;

private:
    /// A line, or an edge of a tile with the tile on its left.
    struct Piece {
        glm::dvec2 from, to;
        std::uint32_t owner = 0;  ///< index of the pen, or number of the tile
        bool is_edge = false;
    };
    void add(const Piece& piece);

    double most_;
    std::uint32_t tiles_ = 0;
    std::vector<Piece> pieces_;
    std::vector<Pen> pens_;
};

/// Moves the pieces of the border outwards, into gaps between tiles, too; corners are mitred. Other lines, and pieces
/// that do not form loops, stay. @param lines  of UnitedLines::Kept::cuts  @param distance  in their unit
/// @throws std::runtime_error if a notch of the border is too narrow
std::vector<UnitedLines::Line> with_wider_border(const std::vector<UnitedLines::Line>& lines, double distance);

/// Draws lines, those of each pen joined into as few strokes as possible. @throws Stopped
void draw_lines(const std::vector<UnitedLines::Line>& lines, PathSink& sink, const Monitor& monitor);

}  // namespace sikku
