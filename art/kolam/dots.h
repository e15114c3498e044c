// art/kolam/dots.h: places the dots of a kolam as tradition does.
#pragma once

#include "art/kolam/faces.h"
#include "art/kolam/lines.h"

#include <vector>

namespace sikku::kolam_plane {

/// Places one dot in each odd face, sorted by y, then by x.
std::vector<KolamDot> set_dots(const PlanarGraph& graph, const Faces& faces, const Strokes& strokes,
                               const Lines& lines, const KolamOptions& options);

}  // namespace sikku::kolam_plane
