// engine/geometry/contours.h: areas of several contours, as one outline for PathSink::area().
#pragma once

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace sikku {

/// True if a curve is a bridge, which leads from one contour of an area to another: a straight line whose control
/// points are exchanged, so that no other curve is equal to it. An outline crosses each bridge to a contour and back,
/// so that it encloses nothing; writers of files begin a new subpath instead.
inline bool is_bridge(glm::dvec2 start, glm::dvec2 first, glm::dvec2 second, glm::dvec2 end) {
    return first == end && second == start && start != end;
}

/// Adds a closed contour to an outline, with bridges from its start and back.
/// @param contour  its start, then three control points for each curve, of which the last ends at the start
inline void add_contour(std::span<const glm::dvec2> contour, std::vector<glm::dvec2>& outline) {
    if (contour.size() < 4) return;
    if (outline.empty()) return outline.assign(contour.begin(), contour.end());
    const glm::dvec2 from = outline.front(), to = contour.front();
    if (from != to) outline.insert(outline.end(), {to, from, to});
    outline.insert(outline.end(), contour.begin() + 1, contour.end());
    if (from != to) outline.insert(outline.end(), {from, to, from});
}

/// Calls `begin` with the start of each contour of an outline, and `curve` with the three control points of each
/// curve that follows, which is not a bridge.
template <class Begin, class Curve>
void each_contour(std::span<const glm::dvec2> outline, Begin&& begin, Curve&& curve) {
    glm::dvec2 here = outline.front();
    bool is_begun = false;
    for (std::size_t i = 1; i + 2 < outline.size(); i += 3) {
        if (is_bridge(here, outline[i], outline[i + 1], outline[i + 2])) {
            is_begun = false;
        } else {
            if (!is_begun) begin(here);
            is_begun = true;
            curve(outline.subspan(i, 3));
        }
        here = outline[i + 2];
    }
}

}  // namespace sikku
