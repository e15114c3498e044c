#include "art/reading/kolam_edge.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sikku {
bool is_inside(const GreyPicture& picture, glm::dvec2 at) {
    return at.x >= 0 && at.y >= 0 && at.x < static_cast<double>(picture.width) &&
           at.y < static_cast<double>(picture.height);
}

double line_level(const GreyPicture& ink, const FoundGrid& found) {
    std::vector<double> values;
    const DotLattice lattice = found.grid().lattice();
    const double reach = lattice == DotLattice::square ? 0.5 : 0.29;
    const std::size_t stride = std::max<std::size_t>(1, found.grid().gaps().size() / 200);
    for (std::size_t i = 0; i < found.grid().gaps().size(); i += stride) {
        const GridGap& gap = found.grid().gaps()[i];
        const glm::dvec2 from = lattice_point(lattice, found.grid().dots()[gap.from]);
        const glm::dvec2 along = lattice_point(lattice, found.grid().dots()[gap.to]) - from;
        const glm::dvec2 aside(-along.y, along.x);
        // Between a gap and the middle of a face both strands are crossed, if there are any.
        double most = -1e300;
        for (int k = -10; k <= 10; ++k) {
            for (const double part : {0.36, 0.64}) {
                most = std::max(
                    most, static_cast<double>(ink.at(found.map(from + part * along + 0.1 * k * reach * aside))));
            }
        }
        values.push_back(most);
    }
    return median(std::move(values));
}

bool reaches_edge(const GreyPicture& ink, const FoundGrid& found, double level) {
    const DotGrid& grid = found.grid();
    // The part of the way that lies in the picture.
    const auto leaves_at = [&](glm::dvec2 from, glm::dvec2 along) {
        double part = 0;
        while (part < 1 && is_inside(ink, found.map(from + part * along))) part += 0.02;
        return part;
    };
    const auto has_line = [&](glm::dvec2 from, glm::dvec2 along, double leaves) {
        constexpr double beyond_loops = 0.56;
        const glm::dvec2 aside(-along.y, along.x);
        std::size_t inked = 0;
        for (double part = std::max(beyond_loops, leaves - 0.12); part < leaves - 0.02; part += 0.02) {
            for (double off = -0.4; off <= 0.4; off += 0.02) {
                const glm::dvec2 at = found.map(from + part * along + off * aside);
                inked += is_inside(ink, at) && ink.at(at) > 0.5 * level;
            }
        }
        return inked > 3;
    };
    std::size_t ways = 0;
    std::size_t lines = 0;
    for (const GridDot dot : grid.dots()) {
        const glm::dvec2 from = lattice_point(grid.lattice(), dot);
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            const glm::dvec2 along = lattice_point(grid.lattice(), grid.step(side));
            if (grid.dot_at(dot + grid.step(side)) || is_inside(ink, found.map(from + along))) continue;
            constexpr double loop = 0.35;
            const double leaves = leaves_at(from, along);
            if (leaves < loop) return true;
            ++ways;
            lines += has_line(from, along, leaves);
        }
    }
    return lines > 0 && 6 * lines >= ways;
}

}  // namespace sikku
