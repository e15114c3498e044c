// art/tiles/tile_drawing.h: a drawing whose polygons are coloured as tiles and whose edges are drawn once.
#pragma once

#include "art/drawing/drawing.h"
#include "art/tiles/united_lines.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

class TileGatherer;
class TilePainter;

/// True if a style requests colours or decorations of tiles, or edges other than those of each tile.
bool has_tile_work(const Style& style);

/// Cost of a tile's edge in nodes, by memory and time.
constexpr double nodes_of_tile_edge = 20;

/// Colours the polygons of another drawing by `tile colours`, and draws edges as `tile edges` requests: first the
/// polygons, then their edges and all other straight lines, each piece once and joined into long strokes; then their
/// decoration.
class TileDrawing : public DerivedDrawing {
public:
    /// @param seed  seed of decorations  @throws std::runtime_error if the lines are splines
    TileDrawing(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const DrawingOptions& options,
                const Reading& reading);

    /// Reads the drawing once, and once more if colours depend on neighbours or edges are not those of each tile, and
    /// once more for a decoration.
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawingReport& report) const override;

private:
    std::vector<std::uint32_t> numbers(const TileGatherer& gatherer, const UnitedLines& united,
                                       const UnitedLines::Result& found,
                                       const std::vector<glm::dvec2>& middles) const;
    void add_layers();
    void note(const TilePainter& painter) const;
    void decorate(const Print& print, const Window& window, PathSink& sink) const;

    std::uint64_t seed_;
    std::size_t first_colour_ = 0;  ///< index of the first of the added colours
    std::size_t colours_ = 0;       ///< number of these colours
    /// The findings of the reads so far.
    mutable std::atomic<bool> has_tiles_{false}, differs_{false}, has_worms_{false};
    std::optional<int> layers_;  ///< colour of inner edges in layers for cutting; that of the border is the next
};

}  // namespace sikku
