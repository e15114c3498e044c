// art/motion/division.h: generations of tiles that divide, in one place.
#pragma once

#include "art/drawing/drawing_options.h"
#include "art/drawing/reading.h"
#include "art/motion/division_time.h"
#include "engine/geometry/recorded_path.h"
#include "engine/tiling/polygon_list.h"

#include <glm/mat3x2.hpp>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sikku {

/// A generation of tiles, in coordinates and steps of its own.
struct DivisionStage {
    /// Motion of a tile that emerges from the one that divides.
    struct Part {
        glm::dvec2 middle{0.0};  ///< centre of its change of size
        glm::dvec2 way{0.0};     ///< vector from there to where it begins, or towards its family
        Colour from;             ///< colour of its parent
    };
    std::int64_t steps = 0;
    RecordedPath picture;  ///< the complete drawing
    PolygonList tiles;
    std::vector<Colour> colours;  ///< colours of the tiles
    glm::dmat3x2 place{1.0};      ///< map to the coordinates of the last stage
    double scale = 1;             ///< length of a step in steps of the last stage
    std::optional<Pen> outline;   ///< pen of each tile's outline, if outlines are drawn
    bool has_more_lines = false;  ///< lines or discs besides the outlines are drawn

    std::vector<Part> parts;  ///< for each tile; empty in the first stage
    DivisionKind kind = DivisionKind::cut;
};

struct Division {
    std::vector<DivisionStage> stages;  ///< at least 2
    Style style;                        ///< style of all pictures
    DrawnExtent seen;                   ///< extent of all stages together, in the orientation of the page
    double scale = 1;                   ///< share of the page that it fills
};

/// Thrown if the tiles of a drawing do not divide; the message gives the reason.
class DivisionError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Draws all generations from `first` on; those without tiles before the first with tiles are left out.
/// @param most_tiles  limit for all generations together
/// @throws BudgetError, WordError, Stopped, DivisionError
Division make_division(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                       const Reading& reading, std::int64_t first, std::int64_t last, double most_tiles);

}  // namespace sikku
