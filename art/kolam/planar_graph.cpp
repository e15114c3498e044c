#include "art/kolam/planar_graph.h"

#include "engine/base/union_find.h"

#include <numeric>
#include <tuple>

namespace sikku::kolam_plane {
namespace {

/// The index at which each group of a sorted list begins, and the end of the list.
template <class Item, class Key>
std::vector<std::uint32_t> group_begins(std::span<const Item> sorted, std::size_t groups, const Monitor& monitor,
                                        Key key) {
    std::vector<std::uint32_t> begins(groups + 1, 0);
    Pulse pulse(monitor);
    for (const Item& item : sorted) {
        pulse();
        ++begins[key(item) + 1];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    return begins;
}

template <class Plane>
class GraphMaker {
public:
    GraphMaker(const Plane& plane, const Strokes& strokes, const KolamOptions& options)
        : plane_(plane), strokes_(strokes), options_(options), pulse_(options.monitor) {}

    PlanarGraph make() {
        graph_.is_exact = Plane::is_exact;
        graph_.turn = plane_.turn();
        graph_.node_places = plane_.places();
        gather_segments();
        fill_grid();
        cut_segments();
        make_edges();
        sort_around_vertices();
        return std::move(graph_);
    }

private:
    /// Each pair of nodes that a step joins is one segment.
    void gather_segments() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        pairs.reserve(strokes_.nodes.size() - strokes_.count());
        for (std::size_t i = 0; i < strokes_.count(); ++i) {
            const auto nodes = strokes_.stroke(i);
            for (std::size_t j = 1; j < nodes.size(); ++j) {
                pulse_();
                pairs.push_back(std::minmax({nodes[j - 1], nodes[j]}));
            }
        }
        sort(options_, pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        graph_.segments.reserve(pairs.size());
        for (const auto& [from, to] : pairs) {
            pulse_();
            graph_.segments.push_back({from, to, plane_.direction(from, to)});
        }
        breathe(options_);
    }

    /// With cells as wide as segments are long, there are not many more entries than segments.
    void fill_grid() {
        Box box;
        double length = 0;
        for (const Segment& segment : graph_.segments) {
            pulse_();
            const glm::dvec2 a = plane_.at(segment.from);
            const glm::dvec2 b = plane_.at(segment.to);
            length += std::hypot(b.x - a.x, b.y - a.y);
            box.add(a);
            box.add(b);
        }
        graph_.rounding = 4 * plane_.rounding();
        graph_.grid.emplace(box, length / static_cast<double>(graph_.segments.size()), graph_.rounding);
        for (std::uint32_t i = 0; i < graph_.segments.size(); ++i) {
            pulse_();
            graph_.grid->add(i, plane_.at(graph_.segments[i].from), plane_.at(graph_.segments[i].to));
        }
        breathe(options_);
        graph_.grid->sort(options_.monitor);
        breathe(options_);
    }

    void cut_segments() {
        const auto& entries = graph_.grid->entries();
        double pairs = 0;
        for (std::size_t begin = 0; begin < entries.size();) {
            std::size_t end = begin + 1;
            while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t j = i + 1; j < end; ++j) meet(entries[i].item, entries[j].item);
                pairs += static_cast<double>(end - i - 1);
                if (pairs > options_.budget || 10 * static_cast<double>(cuts_.size()) > options_.budget) {
                    throw BudgetError(
                        "so many segments of the drawing meet that examining it exceeds the budget; "
                        "use a shorter derivation or a larger budget");
                }
                if (((i - begin) & 1023) == 1023) breathe(options_);
            }
            pulse_();
            if ((begin & 0xffff) < end - begin) breathe(options_);
            begin = end;
        }
        sort(options_, cuts_, [this](const Cut& a, const Cut& b) {
            if (a.segment != b.segment) return a.segment < b.segment;
            return compare(a, b) < 0;
        });
        breathe(options_);
    }
    /// Plane::compare(), computed exactly only where doubles do not decide; angles are never so small that the error
    /// of doubles exceeds this bound.
    int compare(const Cut& a, const Cut& b) const {
        if (Plane::is_exact && std::fabs(a.along - b.along) > 1000 * graph_.rounding)
            return a.along < b.along ? -1 : 1;
        return plane_.compare(graph_.segments, a, b);
    }
    bool are_one(const Cut& a, const Cut& b) const {
        if (a.segment != b.segment) return false;
        return Plane::is_exact ? compare(a, b) == 0 : std::fabs(a.along - b.along) <= steps_are_one;
    }

    /// Plane::side(), computed exactly only where doubles do not decide.
    int side(const Segment& line, std::uint32_t node) const {
        const glm::dvec2 along = plane_.at(line.to) - plane_.at(line.from);
        const glm::dvec2 way = plane_.at(node) - plane_.at(line.from);
        const double product = determinant(along, way);
        const double doubt = (graph_.rounding + 1e-15 * (std::fabs(way.x) + std::fabs(way.y))) * 4 *
                             (std::fabs(along.x) + std::fabs(along.y) + std::fabs(way.x) + std::fabs(way.y));
        return std::fabs(product) > doubt ? sign_of(product) : plane_.side(line, node);
    }

    void meet(std::uint32_t first, std::uint32_t second) {
        const Segment& s = graph_.segments[first];
        const Segment& t = graph_.segments[second];
        const glm::dvec2 a = plane_.at(s.from);
        const glm::dvec2 b = plane_.at(s.to);
        const glm::dvec2 c = plane_.at(t.from);
        const glm::dvec2 d = plane_.at(t.to);
        for (int axis = 0; axis < 2; ++axis) {
            if (std::max(a[axis], b[axis]) + graph_.rounding < std::min(c[axis], d[axis])) return;
            if (std::max(c[axis], d[axis]) + graph_.rounding < std::min(a[axis], b[axis])) return;
        }
        if (plane_.same_direction(s.direction, t.direction) ||
            plane_.same_direction(s.direction, graph_.reversed(t.direction))) {
            if (side(s, t.from) != 0) return;
            for (const std::uint32_t end : {t.from, t.to}) {
                if (lies_within(s, end)) cut(first, end);
            }
            for (const std::uint32_t end : {s.from, s.to}) {
                if (lies_within(t, end)) cut(second, end);
            }
            return;
        }
        if (s.from == t.from || s.from == t.to || s.to == t.from || s.to == t.to) return;
        const int from_side = side(s, t.from);
        const int to_side = side(s, t.to);
        if (from_side * to_side > 0) return;
        const int other_from_side = side(t, s.from);
        const int other_to_side = side(t, s.to);
        if (other_from_side * other_to_side > 0) return;
        const bool ends_on_first = from_side == 0 || to_side == 0;
        const bool ends_on_second = other_from_side == 0 || other_to_side == 0;
        if (ends_on_first && ends_on_second) return;  // corner to corner, which only a tolerance makes two nodes
        if (ends_on_first) {
            cut(first, from_side == 0 ? t.from : t.to);
        } else if (ends_on_second) {
            cut(second, other_from_side == 0 ? s.from : s.to);
        } else {
            const double whole = determinant(b - a, d - c);
            const double part = std::clamp(determinant(c - a, d - c) / whole, 0.0, 1.0);
            const glm::dvec2 place = a + part * (b - a);
            const auto vertex = static_cast<std::uint32_t>(plane_.size() + crossings_.size());
            crossings_.push_back(place);
            cuts_.push_back({first, second, vertex, true, std::hypot(place.x - a.x, place.y - a.y)});
            cuts_.push_back({second, first, vertex, true, std::hypot(place.x - c.x, place.y - c.y)});
        }
    }
    bool lies_within(const Segment& segment, std::uint32_t node) const {
        return node != segment.from && node != segment.to && plane_.order(segment, segment.from, node) > 0 &&
               plane_.order(segment, node, segment.to) > 0;
    }
    void cut(std::uint32_t segment, std::uint32_t node) {
        const glm::dvec2 way = plane_.at(node) - plane_.at(graph_.segments[segment].from);
        cuts_.push_back({segment, node, node, false, std::hypot(way.x, way.y)});
    }

    void make_edges() {
        UnionFind same(plane_.size() + crossings_.size());
        for (std::size_t i = 1; i < cuts_.size(); ++i) {
            pulse_();
            if (are_one(cuts_[i - 1], cuts_[i])) same.join(cuts_[i - 1].vertex, cuts_[i].vertex);
        }
        // Pieces of all segments, of which those that lie on each other become one edge.
        struct Piece {
            std::uint32_t a, b, segment, number;
        };
        std::vector<Piece> pieces;
        pieces.reserve(graph_.segments.size() + cuts_.size());
        std::size_t next_cut = 0;
        graph_.piece_begins.reserve(graph_.segments.size() + 1);
        for (std::uint32_t i = 0; i < graph_.segments.size(); ++i) {
            pulse_();
            graph_.piece_begins.push_back(static_cast<std::uint32_t>(pieces.size()));
            std::uint32_t last = same.find(graph_.segments[i].from);
            const auto add = [&](std::uint32_t vertex) {
                if (vertex != last) pieces.push_back({last, vertex, i, static_cast<std::uint32_t>(pieces.size())});
                last = vertex;
            };
            for (; next_cut < cuts_.size() && cuts_[next_cut].segment == i; ++next_cut) {
                add(same.find(cuts_[next_cut].vertex));
            }
            add(same.find(graph_.segments[i].to));
        }
        graph_.piece_begins.push_back(static_cast<std::uint32_t>(pieces.size()));
        cuts_ = {};
        if (pieces.size() >= none / 4) throw BudgetError("the drawing has too many edges to be examined");
        sort(options_, pieces, [](const Piece& p, const Piece& q) {
            return std::tuple(std::minmax(p.a, p.b), p.number) < std::tuple(std::minmax(q.a, q.b), q.number);
        });
        graph_.piece_half.assign(pieces.size(), 0);
        std::vector<std::uint32_t> dense(plane_.size() + crossings_.size(), none);
        const auto vertex_of = [&](std::uint32_t id) {
            if (dense[id] == none) {
                dense[id] = static_cast<std::uint32_t>(graph_.places.size());
                graph_.places.push_back(id < plane_.size() ? plane_.at(id) : crossings_[id - plane_.size()]);
                graph_.node.push_back(id < plane_.size() ? id : none);
            }
            return dense[id];
        };
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pulse_();
            const Piece& piece = pieces[i];
            if (i == 0 || std::minmax(piece.a, piece.b) != std::minmax(pieces[i - 1].a, pieces[i - 1].b)) {
                graph_.edges.emplace_back(vertex_of(piece.a), vertex_of(piece.b));
                graph_.edge_segment.push_back(piece.segment);
            }
            const std::uint32_t edge = graph_.edge_count() - 1;
            graph_.piece_half[piece.number] = 2 * edge + (dense[piece.a] == graph_.edges[edge].first ? 0 : 1);
        }
        breathe(options_);
    }

    void sort_around_vertices() {
        graph_.around_half.resize(2 * graph_.edges.size());
        std::iota(graph_.around_half.begin(), graph_.around_half.end(), 0u);
        graph_.around_begins = group_begins<std::uint32_t>(graph_.around_half, graph_.places.size(), options_.monitor,
                                                           [this](auto half) { return graph_.tail(half); });
        std::vector<std::uint32_t> next(graph_.around_begins.begin(), graph_.around_begins.end() - 1);
        for (std::uint32_t half = 0; half < 2 * graph_.edge_count(); ++half) {
            pulse_();
            graph_.around_half[next[graph_.tail(half)]++] = half;
        }
        graph_.rank.resize(graph_.around_half.size());
        for (std::uint32_t vertex = 0; vertex < graph_.places.size(); ++vertex) {
            pulse_();
            const auto begin = graph_.around_half.begin() + graph_.around_begins[vertex];
            const auto end = graph_.around_half.begin() + graph_.around_begins[vertex + 1];
            std::sort(begin, end, [this](std::uint32_t a, std::uint32_t b) {
                return std::pair(graph_.direction(a), a) < std::pair(graph_.direction(b), b);
            });
            for (auto i = begin; i != end; ++i) graph_.rank[*i] = static_cast<std::uint32_t>(i - begin);
        }
        breathe(options_);
    }

    const Plane& plane_;
    const Strokes& strokes_;
    const KolamOptions& options_;
    Pulse pulse_;
    PlanarGraph graph_;
    std::vector<Cut> cuts_;
    std::vector<glm::dvec2> crossings_;  // points where segments cross within both
};

}  // namespace

template <class Plane>
PlanarGraph make_graph(const Plane& plane, const Strokes& strokes, const KolamOptions& options) {
    return GraphMaker<Plane>(plane, strokes, options).make();
}
template PlanarGraph make_graph(const ExactPlane&, const Strokes&, const KolamOptions&);
template PlanarGraph make_graph(const RoughPlane&, const Strokes&, const KolamOptions&);

}  // namespace sikku::kolam_plane
