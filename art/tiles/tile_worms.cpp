#include "art/tiles/tile_worms.h"

#include "art/plotter/plot_layer.h"
#include "engine/base/union_find.h"
#include "engine/geometry/cross.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace sikku {
namespace {

constexpr double accuracy = 1e-6;  // relative, for sides; in radians, for angles

/// A corner of a rhomb, and the nodes to which its two sides lead.
struct RhombCorner {
    std::uint32_t tile = 0;
    double angle = 0;
    std::array<std::uint32_t, 2> sides{};  ///< nodes
};

/// The four corners of a rhomb; empty for other tiles.
std::vector<glm::dvec2> rhomb(std::span<const glm::dvec2> vertices) {
    std::vector<glm::dvec2> corners;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 before = vertices[i] - vertices[(i + vertices.size() - 1) % vertices.size()];
        const glm::dvec2 after = vertices[(i + 1) % vertices.size()] - vertices[i];
        const bool is_straight =
            std::fabs(cross(before, after)) <= accuracy * glm::length(before) * glm::length(after);
        if (!is_straight) corners.push_back(vertices[i]);
    }
    if (corners.size() != 4) return {};
    const double side = glm::distance(corners[0], corners[1]);
    for (std::size_t i = 1; i < 4; ++i) {
        if (std::fabs(glm::distance(corners[i], corners[(i + 1) % 4]) - side) > accuracy * side) return {};
    }
    return corners;
}

/// The links around a vertex with these corners.
class VertexLinks {
public:
    VertexLinks(const std::vector<glm::dvec2>& points, const std::vector<RhombCorner>& corners)
        : points_(points), corners_(corners) {}

    void add_to(std::uint32_t vertex, std::vector<WormLink>& links) const {
        if (corners_.size() != 3) return;
        double sum = 0;
        for (const RhombCorner& corner : corners_) sum += corner.angle;
        if (std::fabs(sum - 2 * std::numbers::pi) > 3 * accuracy) return;
        for (std::size_t i = 0; i < 3; ++i) {
            // The third rhomb has to lie between two congruent ones.
            const RhombCorner &a = corners_[(i + 1) % 3], &b = corners_[(i + 2) % 3];
            if (std::fabs(a.angle - b.angle) > accuracy) continue;
            const auto shared = std::find_first_of(a.sides.begin(), a.sides.end(), b.sides.begin(), b.sides.end());
            if (shared == a.sides.end()) continue;
            const glm::dvec2 half = (points_[*shared] - points_[vertex]) / 2.0;
            links.push_back({points_[other(a, *shared)] + half,
                             points_[other(b, *shared)] + half,
                             {a.tile, b.tile, corners_[i].tile}});
        }
    }

private:
    static std::uint32_t other(const RhombCorner& corner, std::uint32_t side) {
        return corner.sides[corner.sides[0] == side ? 1 : 0];
    }

    const std::vector<glm::dvec2>& points_;
    const std::vector<RhombCorner>& corners_;
};

double size_of(const std::vector<glm::dvec2>& points) {
    double size = 0;
    for (const glm::dvec2 point : points) size = std::max({size, std::fabs(point.x), std::fabs(point.y)});
    return size;
}

void count_links(double tolerance, std::vector<WormLink>& links) {
    PlotNodes ends(tolerance);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> of_links;
    of_links.reserve(links.size());
    for (const WormLink& link : links) of_links.emplace_back(ends.at(link.from), ends.at(link.to));
    UnionFind worms(ends.points.size());
    for (const auto& [from, to] : of_links) worms.join(from, to);
    std::vector<std::uint32_t> lengths(ends.points.size(), 0);
    for (const auto& [from, to] : of_links) ++lengths[worms.find(from)];
    for (std::size_t i = 0; i < links.size(); ++i) links[i].length = lengths[worms.find(of_links[i].first)];
}

}  // namespace

std::vector<WormLink> find_worms(const TileOutlines& tiles, const Monitor& monitor) {
    const double tolerance = std::max(1e-9 * size_of(tiles.vertices()), 1e-300);
    PlotNodes nodes(tolerance);
    std::vector<std::vector<RhombCorner>> at;
    Pulse pulse(monitor);
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
        pulse();
        const std::vector<glm::dvec2> corners = rhomb(tiles[tile]);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 ahead = corners[(i + 1) % 4] - corners[i], back = corners[(i + 3) % 4] - corners[i];
            const double angle = std::fabs(std::atan2(cross(ahead, back), glm::dot(ahead, back)));
            const std::uint32_t node = nodes.at(corners[i]);
            const RhombCorner corner{static_cast<std::uint32_t>(tile),
                                     angle,
                                     {nodes.at(corners[(i + 1) % 4]), nodes.at(corners[(i + 3) % 4])}};
            at.resize(nodes.points.size());
            at[node].push_back(corner);
        }
    }
    std::vector<WormLink> links;
    for (std::uint32_t vertex = 0; vertex < at.size(); ++vertex) {
        pulse();
        VertexLinks(nodes.points, at[vertex]).add_to(vertex, links);
    }
    count_links(tolerance, links);
    return links;
}

std::vector<std::uint32_t> ranks_of_worms(std::size_t tiles, const std::vector<WormLink>& links) {
    std::vector<std::uint32_t> ranks(tiles, 0);
    std::set<std::uint32_t> lengths;
    for (const WormLink& link : links) {
        lengths.insert(link.length);
        for (const std::uint32_t tile : link.tiles) ranks[tile] = std::max(ranks[tile], link.length);
    }
    for (std::uint32_t& rank : ranks) {
        if (rank == 0) continue;
        rank = 1 + static_cast<std::uint32_t>(std::distance(lengths.begin(), lengths.find(rank)));
    }
    return ranks;
}

}  // namespace sikku
