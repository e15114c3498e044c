// art/kolam/fields.h: the fields between the drawn lines, bounded by their curves.
#pragma once

#include "art/kolam/curve_meetings.h"
#include "art/style/style.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// A bounded region between closed lines, without lines inside.
struct Field {
    /// The start of the outline, then three control points for each Bézier, anticlockwise. Holes are part of it,
    /// joined by a line to and fro.
    std::vector<glm::dvec2> outline;
    bool is_straight = false;   ///< all Béziers are straight lines
    bool is_odd = false;        ///< an odd number of lines lies between it and the outside: it has a dot
    std::uint32_t corners = 0;  ///< corners of its outline, without holes
    double area = 0.0;          ///< in square steps, without its holes
    glm::dvec2 centroid{0.0};
    std::uint32_t distance = 0;         ///< fewest lines to cross on the way outside, 1 or more
    std::uint32_t orbit = 0;            ///< orbit of the line that runs along most of its outline
    std::vector<std::uint32_t> beside;  ///< fields across a line, sorted
};

/// Finds the fields of a drawing. Open lines do not bound fields.
/// Cost: O(n log n) for n pieces and meetings.
/// @throws Stopped
std::vector<Field> find_fields(const CurvedLines& lines, const CurveMeetings& meetings, const Monitor& monitor);

/// Divides fields into classes, numbered from 0. Neighbours across a line are in classes of different parity for
/// chessboard, kind and symmetry: fields with a dot are in even ones.
std::vector<std::uint32_t> classify(const std::vector<Field>& fields, FieldsBy by, const KolamSymmetry& symmetry,
                                    glm::dvec2 centre, const Monitor& monitor);

}  // namespace sikku
