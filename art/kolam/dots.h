// art/kolam/dots.h: places the dots of a kolam as tradition does.
#pragma once

#include "art/kolam/faces.h"
#include "art/kolam/lines.h"

#include <span>
#include <vector>

namespace sikku::kolam_plane {

/// Places one dot in each odd face, sorted by y, then by x.
std::vector<KolamDot> set_dots(const PlanarGraph& graph, const Faces& faces, const Strokes& strokes,
                               const Lines& lines, const KolamOptions& options);

/// True if there are three discs or more and one of them lies where no dot is set.
bool has_dots_elsewhere(std::span<const glm::dvec2> discs, const std::vector<KolamDot>& set);

/// Encloses dots of the pattern that lie alone in a field between lines and see all of its outline. Lines run around
/// such a field, even if none of them runs around the dot in one direction.
void enclose_in_fields(const PlanarGraph& graph, const Faces& faces, std::vector<KolamDot>& dots);

/// Returns the discs of the pattern as dots, each once, sorted as above. A dot is on a line within steps_are_one.
/// Cost: for each step, O(log n + the number of dots at its height).
std::vector<KolamDot> own_dots(const PlanarGraph& graph, const Strokes& strokes, const Lines& lines,
                               const KolamOptions& options);

}  // namespace sikku::kolam_plane
