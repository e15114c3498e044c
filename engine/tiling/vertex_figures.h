// engine/tiling/vertex_figures.h: the vertices of a tiling, by the angles of the tiles around them.
#pragma once

#include "engine/tiling/tiling.h"

#include <vector>

namespace sikku {

/// Counts the figures of vertices with tiles all around, and numbers them by points in `figure_of`. Cost: linear.
std::vector<VertexFigure> find_figures(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                                       std::vector<std::uint32_t>& figure_of, const Monitor& monitor);

}  // namespace sikku
