#include "art/kolam/lines.h"

#include "engine/base/union_find.h"

#include <tuple>
#include <unordered_map>

namespace sikku::kolam_plane {
namespace {

/// Lists the uses of edges in drawing order, and links each with its continuation.
class LineFollower {
public:
    LineFollower(const PlanarGraph& graph, const Strokes& strokes, const KolamOptions& options)
        : graph_(graph), strokes_(strokes), options_(options), pulse_(options.monitor) {}

    Lines follow() {
        follow_strokes();
        join_ends();
        number_lines();
        find_passes();
        find_order();
        return std::move(lines_);
    }

private:
    void join(std::uint32_t a, std::uint32_t b) {
        link_[a] = b;
        link_[b] = a;
    }
    /// The half-edge of an end that leaves its vertex.
    std::uint32_t leaving(std::uint32_t end) const { return end % 2 == 0 ? uses_[end / 2] : uses_[end / 2] ^ 1; }

    /// Lists the uses and links those of each stroke.
    void follow_strokes() {
        for (std::size_t i = 0; i < strokes_.count(); ++i) {
            const auto nodes = strokes_.stroke(i);
            const auto first = static_cast<std::uint32_t>(uses_.size());
            first_uses_.push_back(first);
            for (std::size_t j = 1; j < nodes.size(); ++j) {
                pulse_();
                const std::uint32_t segment = graph_.segment_between(nodes[j - 1], nodes[j]);
                const auto halves = graph_.pieces(segment);
                const bool forward = graph_.segments[segment].from == nodes[j - 1];
                for (std::size_t k = 0; k < halves.size(); ++k) {
                    uses_.push_back(forward ? halves[k] : halves[halves.size() - 1 - k] ^ 1);
                }
            }
            if (uses_.size() >= none / 4) throw BudgetError("the drawing has too many edges to be examined");
            const auto last = static_cast<std::uint32_t>(uses_.size());
            link_.resize(2 * uses_.size(), none);
            for (std::uint32_t use = first; use + 1 < last; ++use) {
                pulse_();
                join(2 * use + 1, 2 * use + 2);
            }
            if (strokes_.closed[i] && last > first) join(2 * last - 1, 2 * first);
        }
        breathe(options_);
    }

    /// Joins the ends of strokes that meet at a vertex, straight continuations first.
    void join_ends() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;  // vertex, end
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            if (link_[end] == none) ends.emplace_back(graph_.tail(leaving(end)), end);
        }
        sort(options_, ends, [&](const auto& a, const auto& b) {
            return std::tuple(a.first, graph_.rank[leaving(a.second)], a.second) <
                   std::tuple(b.first, graph_.rank[leaving(b.second)], b.second);
        });
        for (std::size_t begin = 0; begin < ends.size();) {
            std::size_t end = begin + 1;
            while (end < ends.size() && ends[end].first == ends[begin].first) ++end;
            std::vector<std::uint32_t> left;
            for (std::size_t i = begin; i < end; ++i) {
                pulse_();
                const std::uint32_t ahead = graph_.behind(leaving(ends[i].second));
                if (link_[ends[i].second] != none || ahead == none) continue;
                const auto wanted = std::pair(ends[i].first, graph_.rank[ahead]);
                for (auto other = std::lower_bound(ends.begin() + static_cast<std::ptrdiff_t>(begin),
                                                   ends.begin() + static_cast<std::ptrdiff_t>(end), wanted,
                                                   [&](const auto&a, const auto&key) {
                                                       return std::pair(a.first, graph_.rank[leaving(a.second)]) <
                                                              key;
                                                   });
                     other != ends.begin() + static_cast<std::ptrdiff_t>(end) && leaving(other->second) == ahead;
                     ++other) {
                    if (link_[other->second] != none) continue;
                    join(ends[i].second, other->second);
                    break;
                }
            }
            for (std::size_t i = begin; i < end; ++i) {
                if (link_[ends[i].second] == none) left.push_back(ends[i].second);
            }
            if (left.size() % 2 == 0) {
                for (std::size_t i = 0; i < left.size() / 2; ++i) join(left[i], left[i + left.size() / 2]);
            }
            begin = end;
        }

        breathe(options_);
    }

    void number_lines() {
        UnionFind lines(uses_.size());
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            pulse_();
            if (link_[end] != none) lines.join(end / 2, link_[end] / 2);
        }
        std::vector<char> is_open(uses_.size(), 0);
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            if (link_[end] == none) is_open[lines.find(end / 2)] = 1;
        }
        for (const std::uint32_t use : first_uses_)
            lines_.is_stroke_of_open_line.push_back(is_open[lines.find(use)] != 0);
        std::unordered_map<std::uint32_t, std::uint32_t> numbers;
        for (const std::uint32_t use : first_uses_) {
            const auto [found, is_new] =
                numbers.try_emplace(lines.find(use), static_cast<std::uint32_t>(numbers.size()));
            lines_.line_of_stroke.push_back(found->second);
        }
        lines_.times.assign(graph_.edges.size(), 0);
        lines_.closed_times.assign(graph_.edges.size(), 0);
        for (std::uint32_t use = 0; use < uses_.size(); ++use) {
            pulse_();
            const std::uint32_t line = lines.find(use);
            if (line == use) {
                ++lines_.count;
                lines_.open += static_cast<std::uint64_t>(is_open[line]);
            }
            ++lines_.times[uses_[use] / 2];
            if (!is_open[line]) lines_.closed_times[uses_[use] / 2] ^= 1;
        }
    }

    void find_passes() {
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            pulse_();
            const std::uint32_t half = leaving(end);
            if (link_[end] == none) lines_.passes.push_back({graph_.tail(half), half, none});
            if (link_[end] != none && end < link_[end])
                lines_.passes.push_back({graph_.tail(half), half, leaving(link_[end])});
        }
        sort(options_, lines_.passes, [](const Pass& a, const Pass& b) { return a.vertex < b.vertex; });
        breathe(options_);
    }

    /// Walks along each line, in the direction of its first stroke; open lines from their beginning.
    void find_order() {
        std::vector<std::uint32_t> stroke_of_end(link_.size(), none);
        for (std::uint32_t i = 0; i < first_uses_.size(); ++i) {
            const std::uint32_t last = (i + 1 < first_uses_.size() ? first_uses_[i + 1] : count_uses()) - 1;
            stroke_of_end[2 * std::size_t{first_uses_[i]}] = 2 * i;
            stroke_of_end[2 * std::size_t{last} + 1] = 2 * i + 1;
        }
        lines_.continuation.assign(2 * first_uses_.size(), none);
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            if (stroke_of_end[end] == none || link_[end] == none) continue;
            lines_.continuation[stroke_of_end[end]] = stroke_of_end[link_[end]];
        }
        std::vector<bool> is_walked(lines_.count, false);
        for (std::size_t i = 0; i < first_uses_.size(); ++i) {
            const std::uint32_t line = lines_.line_of_stroke[i];
            if (is_walked[line]) continue;
            is_walked[line] = true;
            walk(2 * first_uses_[i], lines_.is_stroke_of_open_line[i]);
        }
        lines_.order_begins.push_back(lines_.order.size());
        breathe(options_);
    }
    /// Walks on from the end at which a use begins.
    void walk(std::uint32_t first, bool is_open) {
        lines_.order_begins.push_back(lines_.order.size());
        lines_.is_open.push_back(is_open);
        while (is_open && link_[first] != none) {
            pulse_();
            first = link_[first] ^ 1;
        }
        std::uint32_t end = first;
        do {
            pulse_();
            lines_.order.push_back(leaving(end));
            end = link_[end ^ 1];
        } while (end != none && end != first);
    }
    std::uint32_t count_uses() const { return static_cast<std::uint32_t>(uses_.size()); }

    const PlanarGraph& graph_;
    const Strokes& strokes_;
    const KolamOptions& options_;
    Pulse pulse_;
    std::vector<std::uint32_t> uses_;        // half-edges
    std::vector<std::uint32_t> first_uses_;  // first use of each stroke
    std::vector<std::uint32_t> link_;  // for end 2u, the beginning of use u, and 2u + 1: the end that continues it
    Lines lines_;
};

/// True if two strands that share no edge cross at their vertex.
bool do_cross(const PlanarGraph& graph, const Pass& p, const Pass& q) {
    if (p.b == none || q.b == none) return false;
    const auto [low, high] = std::minmax(graph.rank[p.a], graph.rank[p.b]);
    const auto lies_between = [low = low, high = high](std::uint32_t rank) { return low < rank && rank < high; };
    return lies_between(graph.rank[q.a]) != lies_between(graph.rank[q.b]);
}

/// Counts one vertex that two strands visit.
void count_pair(const PlanarGraph& graph, const Lines& lines, const Pass& p, const Pass& q, Meetings& found) {
    for (const std::uint32_t half : {p.a, p.b, q.a, q.b}) {
        if (half != none && lines.times[half / 2] > 1) return;  // the strands share an edge
    }
    if (!do_cross(graph, p, q)) {
        ++found.touchings;
        return;
    }
    ++found.crossings;
    if (graph.node[p.vertex] == none) ++found.mid_crossings;
    const bool is_straight = graph.are_opposite(p.a, p.b) && graph.are_opposite(q.a, q.b);
    if (is_straight && graph.are_at(p.a, q.a, graph.turn / 4)) return;
    ++found.skew;
    if (is_straight && graph.are_at(p.a, q.a, graph.turn / 6)) ++found.sixty;
}

}  // namespace

Lines follow_strokes(const PlanarGraph& graph, const Strokes& strokes, const KolamOptions& options) {
    return LineFollower(graph, strokes, options).follow();
}

Meetings count_meetings(const PlanarGraph& graph, const Lines& lines, const KolamOptions& options) {
    Meetings found;
    Pulse pulse(options.monitor);
    for (std::size_t begin = 0; begin < lines.passes.size();) {
        std::size_t end = begin + 1;
        while (end < lines.passes.size() && lines.passes[end].vertex == lines.passes[begin].vertex) ++end;
        pulse();
        const std::size_t count = end - begin;
        if (count > 1) ++found.all;
        if (count > 2) ++found.multiple;
        if (count == 2) count_pair(graph, lines, lines.passes[begin], lines.passes[begin + 1], found);
        begin = end;
    }
    return found;
}

std::optional<LinkDiagram> make_diagram(const PlanarGraph& graph, const Lines& lines, const KolamOptions& options,
                                        std::string& why) {
    const auto none_because = [&](std::string reason) {
        why = std::move(reason);
        return std::nullopt;
    };
    if (lines.open > 0) return none_because("a line is open");
    if (std::any_of(lines.times.begin(), lines.times.end(), [](std::uint32_t times) { return times > 1; })) {
        return none_because("an edge is drawn more than once");
    }
    constexpr std::uint8_t no_strand = 2;
    Pulse pulse(options.monitor);
    LinkDiagram diagram;
    std::vector<std::uint32_t> crossing(graph.places.size(), none);
    std::vector<std::uint8_t> strand(2 * graph.edges.size(), no_strand);  // by half-edge that leaves a crossing
    std::uint32_t crossings = 0;
    for (std::size_t begin = 0, end = 0; begin < lines.passes.size(); begin = end) {
        pulse();
        while (end < lines.passes.size() && lines.passes[end].vertex == lines.passes[begin].vertex) ++end;
        if (end - begin > 2) return none_because("more than two strands meet at one point");
        if (end - begin < 2 || !do_cross(graph, lines.passes[begin], lines.passes[begin + 1])) continue;
        crossing[lines.passes[begin].vertex] = crossings++;
        for (std::size_t i = 0; i < 2; ++i) {
            strand[lines.passes[begin + i].a] = strand[lines.passes[begin + i].b] = static_cast<std::uint8_t>(i);
        }
    }
    std::vector<std::uint32_t> first_out(crossings, none);
    diagram.turns_left.assign(crossings, false);
    for (std::uint64_t line = 0; line < lines.count; ++line) {
        LinkDiagram::Line& passes = diagram.lines.emplace_back();
        for (std::size_t i = lines.order_begins[line]; i < lines.order_begins[line + 1]; ++i) {
            pulse();
            const std::uint32_t out = lines.order[i];
            const std::uint32_t number = crossing[graph.tail(out)];
            if (number == none) continue;
            passes.passes.push_back({number, strand[out]});
            const std::uint32_t first = std::exchange(first_out[number], out);
            if (first == none) continue;
            const auto [zero, one] = strand[out] == 0 ? std::pair(out, first) : std::pair(first, out);
            const auto list = graph.around(graph.tail(out));
            diagram.turns_left[number] = list[(graph.rank[zero] + 1) % list.size()] == one;
        }
    }
    return diagram;
}

std::uint64_t count_straight_lines(const PlanarGraph& graph, const KolamOptions& options) {
    Pulse pulse(options.monitor);
    UnionFind joined(graph.edges.size());
    for (std::uint32_t vertex = 0; vertex < graph.places.size(); ++vertex) {
        pulse();
        const auto list = graph.around(vertex);
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::uint32_t ahead =
                list.size() % 2 == 0 ? list[(i + list.size() / 2) % list.size()] : graph.behind(list[i]);
            if (ahead != none) joined.join(list[i] / 2, ahead / 2);
        }
    }
    return joined.count();
}

}  // namespace sikku::kolam_plane
