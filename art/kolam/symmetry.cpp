#include "art/kolam/symmetry.h"

#include "engine/base/union_find.h"

#include <array>
#include <numeric>
#include <optional>

namespace sikku::kolam_plane {
namespace {

/// Groups lines that are images of each other.
class LineImages {
public:
    LineImages(const Strokes& strokes, std::span<const std::uint32_t> line_of_stroke, std::uint64_t lines)
        : lengths_(lines, 0), joined_(lines) {
        if (lines < 2) return;
        for (std::size_t i = 0; i < strokes.count(); ++i) {
            const auto nodes = strokes.stroke(i);
            for (std::size_t j = 1; j < nodes.size(); ++j)
                pieces_.push_back(piece(nodes[j - 1], nodes[j], line_of_stroke[i]));
            lengths_[line_of_stroke[i]] += nodes.size() - 1;
        }
        std::sort(pieces_.begin(), pieces_.end());
    }

    /// Joins each line with the one onto which `map`, from node to node or none, maps most of it.
    template <class Map>
    void join(const Map& map) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> images;
        for (const Piece& from : pieces_) {
            const std::uint32_t first = map(from[0]);
            const std::uint32_t second = map(from[1]);
            if (first == none || second == none) continue;
            const Piece wanted = piece(first, second, 0);
            const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), wanted);
            if (found == pieces_.end() || (*found)[0] != wanted[0] || (*found)[1] != wanted[1]) continue;
            images.emplace_back(from[2], (*found)[2]);
        }
        std::sort(images.begin(), images.end());
        for (auto begin = images.begin(); begin != images.end();) {
            const auto end = std::upper_bound(begin, images.end(), *begin);
            if (2 * static_cast<std::uint64_t>(end - begin) > lengths_[begin->first]) {
                joined_.join(begin->first, begin->second);
            }
            begin = end;
        }
    }

    /// For each line the number of its set, in the order of their first lines.
    std::vector<std::uint32_t> orbits() { return joined_.set_numbers(); }

private:
    using Piece = std::array<std::uint32_t, 3>;  // two nodes, the smaller one first, and the line
    static Piece piece(std::uint32_t a, std::uint32_t b, std::uint32_t line) {
        return {std::min(a, b), std::max(a, b), line};
    }
    std::vector<Piece> pieces_;
    std::vector<std::uint64_t> lengths_;  // lengths of lines, in pieces
    UnionFind joined_;
};

/// Nodes that a symmetry maps together: the ends of a straight piece with no node between them, or a control point
/// with its neighbours.
using Element = std::array<std::uint32_t, 3>;

void order(Element& element) {
    if (element[0] > element[2]) std::swap(element[0], element[2]);
}

/// The control points of splines with both neighbours.
std::vector<Element> spline_elements(const Strokes& strokes) {
    std::vector<Element> elements;
    for (std::size_t i = 0; i < strokes.count(); ++i) {
        const auto nodes = strokes.stroke(i);
        const std::size_t last = nodes.size() - 1;
        for (std::size_t j = 1; j < last; ++j) elements.push_back({nodes[j - 1], nodes[j], nodes[j + 1]});
        if (strokes.closed[i]) {
            elements.push_back({nodes[last - 1], nodes[last], nodes[1]});
        } else {
            elements.push_back({nodes[1], nodes[0], none});
            elements.push_back({nodes[last - 1], nodes[last], none});
        }
    }
    return elements;
}

/// The maximal straight pieces; nullopt if one ends at a crossing that is not a node, which cannot be mapped.
std::optional<std::vector<Element>> straight_elements(const PlanarGraph& graph, const KolamOptions& options) {
    std::vector<Element> elements;
    Pulse pulse(options.monitor);
    for (std::uint32_t half = 0; half < 2 * graph.edge_count(); ++half) {
        pulse();
        if (graph.behind(half) != none) continue;
        std::uint32_t last = half;
        while (true) {
            const std::uint32_t ahead = graph.behind(last ^ 1);
            if (ahead == none) break;
            last = ahead;
        }
        const Element element = {graph.node[graph.tail(half)], none, graph.node[graph.head(last)]};
        if (element[0] == none || element[2] == none) return std::nullopt;
        if (element[0] < element[2]) elements.push_back(element);
    }
    return elements;
}

}  // namespace

template <class Plane>
SymmetryFound find_symmetry(const Plane& plane, const PlanarGraph& graph, const Strokes& strokes, const Lines& lines,
                            const KolamOptions& options) {
    SymmetryFound found;
    Pulse pulse(options.monitor);
    found.orbit_of_line.resize(lines.count);
    std::iota(found.orbit_of_line.begin(), found.orbit_of_line.end(), 0U);
    auto chosen = options.spline ? std::optional(spline_elements(strokes)) : straight_elements(graph, options);
    if (!chosen) return found;
    std::vector<Element>& elements = *chosen;
    for (Element& element : elements) order(element);
    sort(options, elements);
    std::vector<std::uint32_t> nodes;
    for (const Element& element : elements) {
        for (const std::uint32_t node : element) {
            if (node != none) nodes.push_back(node);
        }
    }
    sort(options, nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty()) return found;
    const typename Plane::Images images(plane, nodes);
    found.centre = images.centre;

    std::vector<std::uint32_t> image(plane.size(), none);
    const auto maps_onto_itself = [&](const auto& map) {
        breathe(options);
        for (const std::uint32_t node : nodes) {
            pulse();
            image[node] = map(node);
            if (image[node] == none) return false;
        }
        std::vector<Element> mapped = elements;
        for (Element& element : mapped) {
            pulse();
            for (std::uint32_t& node : element) node = node == none ? none : image[node];
            order(element);
        }
        sort(options, mapped);
        return mapped == elements;
    };
    KolamSymmetry& symmetry = found.group;
    LineImages line_images(strokes, lines.line_of_stroke, lines.count);
    for (const std::uint32_t order : images.orders()) {
        if (maps_onto_itself([&](std::uint32_t node) { return images.rotation(node, order); })) {
            symmetry.rotations = order;
            line_images.join([&](std::uint32_t node) { return images.rotation(node, order); });
            break;
        }
    }
    for (std::uint32_t which = 0; which < images.mirrors(symmetry.rotations); ++which) {
        if (maps_onto_itself([&](std::uint32_t node) { return images.mirror(node, which); })) {
            symmetry.mirrors = symmetry.rotations;
            symmetry.axis = images.axis(which);
            line_images.join([&](std::uint32_t node) { return images.mirror(node, which); });
            break;
        }
    }
    found.orbit_of_line = line_images.orbits();
    return found;
}

template SymmetryFound find_symmetry(const ExactPlane&, const PlanarGraph&, const Strokes&, const Lines&,
                                     const KolamOptions&);
template SymmetryFound find_symmetry(const RoughPlane&, const PlanarGraph&, const Strokes&, const Lines&,
                                     const KolamOptions&);

}  // namespace sikku::kolam_plane
