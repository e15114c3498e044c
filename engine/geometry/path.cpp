#include "engine/geometry/path.h"

#include "engine/geometry/bezier.h"
#include "engine/geometry/box.h"
#include "engine/geometry/lettering.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace sikku {

void PathSink::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (outline.empty()) return;
    const double tolerance = std::max(box_of(outline).longest() / 1000, std::numeric_limits<double>::min());
    std::vector<glm::dvec2> vertices = {outline.front()};
    for (std::size_t i = 0; i + 3 < outline.size(); i += 3) {
        flatten(outline[i], outline[i + 1], outline[i + 2], outline[i + 3], tolerance,
                [&](glm::dvec2 end) { vertices.push_back(end); });
    }
    if (vertices.back() == vertices.front()) vertices.pop_back();
    if (vertices.size() >= 3) polygon(vertices, pen);
}

void PathSink::label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) {
    write_text(text, centre - glm::dvec2(text_width(text, height), height) / 2.0, height, pen, *this);
}

}  // namespace sikku
