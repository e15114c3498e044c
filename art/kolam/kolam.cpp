#include "art/kolam/kolam.h"

#include "art/kolam/kolam_plane.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace sikku {
namespace {

using namespace kolam_plane;

/// Strokes as the nodes that they visit.
struct Strokes {
    std::vector<std::uint32_t> nodes;
    std::vector<std::size_t> begins;  ///< into `nodes`; one more than there are strokes
    std::vector<bool> closed;
    std::size_t count() const { return closed.size(); }
    std::span<const std::uint32_t> stroke(std::size_t i) const {
        return {nodes.data() + begins[i], begins[i + 1] - begins[i]};
    }
};

template <class Plane>
class StrokeReader : public PathSink, public PlaceSink {
public:
    StrokeReader(Plane& plane, int rank, double most_segments, const std::function<bool(const Pen&)>& draws)
        : plane_(plane), rank_(static_cast<std::size_t>(rank)), most_(most_segments), draws_(draws) {}

    void places(std::span<const std::int64_t> coordinates) override { coordinates_ = coordinates; }
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        at_coordinates_.assign(coordinates_.begin(), coordinates_.end());
        is_seen_ = false;
        change_pen(pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        if (ends.empty()) return;
        at_ = ends.back();
        const auto last = coordinates_.last(rank_);
        at_coordinates_.assign(last.begin(), last.end());
        if (!is_seen_) return;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const std::uint32_t node = plane_.node(coordinates_.subspan(i * rank_, rank_), ends[i]);
            if (node == strokes.nodes.back()) continue;  // a step of length 0
            strokes.nodes.push_back(node);
            if (static_cast<double>(strokes.nodes.size()) > most_) {
                throw BudgetError(
                    fmt::format("the drawing has more than {:.0f} segments, which takes more than the "
                                "budget; -n with a smaller number, or a larger --budget, helps",
                                most_));
            }
        }
    }
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen& pen) override {
        const bool is_seen = !draws_ || draws_(pen);
        if (is_seen == is_seen_) return;
        if (is_seen) {
            strokes.begins.push_back(strokes.nodes.size());
            strokes.nodes.push_back(plane_.node(at_coordinates_, at_));
        } else {
            end_seen();
        }
        is_seen_ = is_seen;
    }
    void end_stroke(bool) override {
        if (is_seen_) end_seen();
        is_seen_ = false;
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}

    Strokes finish() {
        strokes.begins.push_back(strokes.nodes.size());
        return std::move(strokes);
    }

private:
    void end_seen() {
        const std::size_t begin = strokes.begins.back();
        if (strokes.nodes.size() - begin < 2) {  // it went nowhere
            strokes.nodes.resize(begin);
            strokes.begins.pop_back();
        } else {
            strokes.closed.push_back(strokes.nodes[begin] == strokes.nodes.back());
        }
    }
    Plane& plane_;
    std::size_t rank_;
    double most_;
    const std::function<bool(const Pen&)>& draws_;
    std::span<const std::int64_t> coordinates_;
    glm::dvec2 at_{0.0};
    std::vector<std::int64_t> at_coordinates_;
    bool is_seen_ = false;
    Strokes strokes;
};

/// Sets of numbers that are joined.
class Union {
public:
    explicit Union(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The smaller number stands for both.
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// Which lines are images of each other.
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

    /// Joins each line with the one onto which `map`, from node to node or none, puts most of it.
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
    std::vector<std::uint32_t> orbits() {
        std::vector<std::uint32_t> numbers(lengths_.size());
        std::uint32_t sets = 0;
        for (std::uint32_t line = 0; line < numbers.size(); ++line) {
            const std::uint32_t first = joined_.find(line);
            numbers[line] = first == line ? sets++ : numbers[first];
        }
        return numbers;
    }

private:
    using Piece = std::array<std::uint32_t, 3>;  // two nodes, the smaller one first, and the line
    static Piece piece(std::uint32_t a, std::uint32_t b, std::uint32_t line) {
        return {std::min(a, b), std::max(a, b), line};
    }
    std::vector<Piece> pieces_;
    std::vector<std::uint64_t> lengths_;  // of lines, in pieces
    Union joined_;
};

/// A square grid over the drawing, and which segments come near each of its cells.
class Grid {
public:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t item = 0;
        bool operator<(const Entry& other) const { return key != other.key ? key < other.key : item < other.item; }
    };

    Grid(glm::dvec2 low, glm::dvec2 high, double cell, double pad) : low_(low - glm::dvec2(2 * pad)), pad_(pad) {
        const double widest = std::max(high.x - low.x, high.y - low.y) + 4 * pad;
        cell_ = std::max({cell, 4 * pad, widest / 1e9});
    }
    void add(std::uint32_t item, glm::dvec2 a, glm::dvec2 b) {
        if (a.x > b.x) std::swap(a, b);
        const std::uint64_t first = column(a.x - pad_);
        const std::uint64_t last = column(b.x + pad_);
        for (std::uint64_t x = first; x <= last; ++x) {
            double y0 = a.y;
            double y1 = b.y;
            if (b.x > a.x) {  // what of it lies in this column
                const double left = low_.x + static_cast<double>(x) * cell_ - 2 * pad_;
                const double slope = (b.y - a.y) / (b.x - a.x);
                if (left > a.x) y0 = a.y + (std::min(left, b.x) - a.x) * slope;
                if (left + cell_ + 4 * pad_ < b.x) y1 = a.y + (std::max(left + cell_ + 4 * pad_, a.x) - a.x) * slope;
            }
            const std::uint64_t top = row(std::max(y0, y1) + 2 * pad_);
            for (std::uint64_t y = row(std::min(y0, y1) - 2 * pad_); y <= top; ++y) {
                entries_.push_back({x << 32 | y, item});
            }
        }
    }
    void sort(const Monitor& monitor) {
        std::sort(entries_.begin(), entries_.end(), stoppable(monitor, std::less<>()));
    }
    const std::vector<Entry>& entries() const { return entries_; }
    double cell() const { return cell_; }
    std::uint64_t column(double x) const { return place(x, low_.x); }
    std::uint64_t row(double y) const { return place(y, low_.y); }
    /// Entries of the cells of a column from that row on downwards are those before this one.
    std::size_t end_of(std::uint64_t x, std::uint64_t y) const {
        const auto above = [](std::uint64_t key, const Entry& entry) { return key < entry.key; };
        return static_cast<std::size_t>(std::upper_bound(entries_.begin(), entries_.end(), x << 32 | y, above) -
                                        entries_.begin());
    }

    /// Hands over what was added to the cells that the box of `points` meets.
    template <class Visitor>
    void visit(std::span<const glm::dvec2> points, const Visitor& visitor) const {
        glm::dvec2 low = points.front();
        glm::dvec2 high = low;
        for (const glm::dvec2 point : points) {
            low = {std::min(low.x, point.x), std::min(low.y, point.y)};
            high = {std::max(high.x, point.x), std::max(high.y, point.y)};
        }
        const auto below = [](const Entry& entry, std::uint64_t key) { return entry.key < key; };
        for (std::uint64_t x = column(low.x); x <= column(high.x); ++x) {
            const std::size_t end = end_of(x, row(high.y));
            for (auto i = static_cast<std::size_t>(
                     std::lower_bound(entries_.begin(), entries_.end(), x << 32 | row(low.y), below) -
                     entries_.begin());
                 i < end; ++i) {
                visitor(entries_[i].item);
            }
        }
    }

private:
    std::uint64_t place(double value, double low) const {
        return static_cast<std::uint64_t>(std::clamp((value - low) / cell_, 0.0, 4e9));
    }
    glm::dvec2 low_;
    double pad_;
    double cell_;
    std::vector<Entry> entries_;
};

/// The ends of `begins` are where groups of a sorted list begin.
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

/// The drawing as a graph in the plane. Half-edges 2e and 2e+1 run along edge e, the one as its segment does, the
/// other back.
template <class Plane>
class Examiner {
public:
    Examiner(const Plane& plane, const Strokes& strokes, const KolamOptions& options)
        : plane_(plane), strokes_(strokes), options_(options), pulse_(options.monitor) {}

    KolamExamination examine() {
        result_.is_exact = Plane::is_exact;
        result_.tolerance = Plane::is_exact ? 0.0 : steps_are_one;
        result_.is_spline = options_.spline;
        result_.strokes = strokes_.count();
        result_.segments = strokes_.nodes.size() - strokes_.count();
        gather_segments();
        fill_grid();
        cut_segments();
        make_edges();
        sort_around_vertices();
        follow_strokes();
        look_at_meetings();
        follow_straight();
        find_faces();
        find_symmetry();
        set_dots();
        return std::move(result_);
    }

private:
    struct Pass {
        std::uint32_t vertex = 0;
        std::uint32_t a = 0;  // half-edges that leave the vertex
        std::uint32_t b = 0;
    };
    using Element = std::array<std::uint32_t, 3>;

    void breathe() const {
        options_.monitor.check();
        if (options_.watch) options_.watch(0);
    }
    /// std::sort() that can be stopped.
    template <class Range, class Less = std::less<>>
    void sort(Range& range, Less less = {}) const {
        std::sort(range.begin(), range.end(), stoppable(options_.monitor, less));
    }
    std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges_.size()); }
    std::uint32_t tail(std::uint32_t half) const {
        return half % 2 == 0 ? edges_[half / 2].first : edges_[half / 2].second;
    }
    std::uint32_t head(std::uint32_t half) const { return tail(half ^ 1); }
    double direction(std::uint32_t half) const {
        const double along = segments_[edge_segment_[half / 2]].direction;
        return half % 2 == 0 ? along : reversed(along);
    }
    double reversed(double direction) const {
        const double turned = direction + plane_.turn() / 2;
        return turned >= plane_.turn() ? turned - plane_.turn() : turned;
    }
    bool are_opposite(std::uint32_t a, std::uint32_t b) const {
        return plane_.same_direction(direction(a), reversed(direction(b)));
    }
    bool are_perpendicular(std::uint32_t a, std::uint32_t b) const {
        const double first = std::fmod(direction(a) + plane_.turn() / 4, plane_.turn());
        return plane_.same_direction(first, direction(b)) || plane_.same_direction(reversed(first), direction(b));
    }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return {around_.data() + around_begins_[vertex], around_begins_[vertex + 1] - around_begins_[vertex]};
    }
    /// The half-edge that goes on straight behind the tail of `half`; or none.
    std::uint32_t behind(std::uint32_t half) const {
        const auto list = around(tail(half));
        const double wanted = reversed(direction(half));
        const double margin = Plane::is_exact ? 0.5 : steps_are_one;
        auto found = std::lower_bound(list.begin(), list.end(), wanted - margin,
                                      [this](std::uint32_t a, double value) { return direction(a) < value; });
        if (found == list.end()) found = list.begin();
        return plane_.same_direction(direction(*found), wanted) ? *found : none;
    }

    /// Each pair of nodes that a step joins is one segment.
    void gather_segments() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        pairs.reserve(result_.segments);
        for (std::size_t i = 0; i < strokes_.count(); ++i) {
            const auto nodes = strokes_.stroke(i);
            for (std::size_t j = 1; j < nodes.size(); ++j) {
                pulse_();
                pairs.push_back(std::minmax({nodes[j - 1], nodes[j]}));
            }
        }
        sort(pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        segments_.reserve(pairs.size());
        for (const auto& [from, to] : pairs) {
            pulse_();
            segments_.push_back({from, to, plane_.direction(from, to)});
        }
        breathe();
    }
    std::uint32_t segment_between(std::uint32_t a, std::uint32_t b) const {
        const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(a, b);
        return static_cast<std::uint32_t>(std::lower_bound(segments_.begin(), segments_.end(), key,
                                                           [](const Segment& segment, const auto& wanted) {
                                                               return std::pair(segment.from, segment.to) < wanted;
                                                           }) -
                                          segments_.begin());
    }

    /// With cells as wide as segments are long, there are not many more entries than segments.
    void fill_grid() {
        glm::dvec2 low = plane_.at(segments_.front().from);
        glm::dvec2 high = low;
        double length = 0;
        for (const Segment& segment : segments_) {
            pulse_();
            const glm::dvec2 a = plane_.at(segment.from);
            const glm::dvec2 b = plane_.at(segment.to);
            length += std::hypot(b.x - a.x, b.y - a.y);
            low = {std::min({low.x, a.x, b.x}), std::min({low.y, a.y, b.y})};
            high = {std::max({high.x, a.x, b.x}), std::max({high.y, a.y, b.y})};
        }
        rounding_ = 4 * plane_.rounding();
        grid_.emplace(low, high, length / static_cast<double>(segments_.size()), rounding_);
        for (std::uint32_t i = 0; i < segments_.size(); ++i) {
            pulse_();
            grid_->add(i, plane_.at(segments_[i].from), plane_.at(segments_[i].to));
        }
        breathe();
        grid_->sort(options_.monitor);
        breathe();
    }

    void cut_segments() {
        const auto& entries = grid_->entries();
        double pairs = 0;
        for (std::size_t begin = 0; begin < entries.size();) {
            std::size_t end = begin + 1;
            while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t j = i + 1; j < end; ++j) meet(entries[i].item, entries[j].item);
                pairs += static_cast<double>(end - i - 1);
                if (pairs > options_.budget || 10 * static_cast<double>(cuts_.size()) > options_.budget) {
                    throw BudgetError(
                        "so many segments of the drawing meet that examining it takes more than the "
                        "budget; -n with a smaller number, or a larger --budget, helps");
                }
                if (((i - begin) & 1023) == 1023) breathe();
            }
            pulse_();
            if ((begin & 0xffff) < end - begin) breathe();
            begin = end;
        }
        sort(cuts_, [this](const Cut& a, const Cut& b) {
            if (a.segment != b.segment) return a.segment < b.segment;
            return compare(a, b) < 0;
        });
        breathe();
    }
    /// As Plane::compare, looking closely only where doubles do not tell; no angle is so small that they would be
    /// off by more than this.
    int compare(const Cut& a, const Cut& b) const {
        if (Plane::is_exact && std::fabs(a.along - b.along) > 1000 * rounding_) return a.along < b.along ? -1 : 1;
        return plane_.compare(segments_, a, b);
    }
    bool are_one(const Cut& a, const Cut& b) const {
        if (a.segment != b.segment) return false;
        return Plane::is_exact ? compare(a, b) == 0 : std::fabs(a.along - b.along) <= steps_are_one;
    }

    /// As Plane::side, looking closely only where doubles do not tell.
    int side(const Segment& line, std::uint32_t node) const {
        const glm::dvec2 along = plane_.at(line.to) - plane_.at(line.from);
        const glm::dvec2 way = plane_.at(node) - plane_.at(line.from);
        const double product = cross(along, way);
        const double doubt = (rounding_ + 1e-15 * (std::fabs(way.x) + std::fabs(way.y))) * 4 *
                             (std::fabs(along.x) + std::fabs(along.y) + std::fabs(way.x) + std::fabs(way.y));
        return std::fabs(product) > doubt ? sign_of(product) : plane_.side(line, node);
    }

    void meet(std::uint32_t first, std::uint32_t second) {
        const Segment& s = segments_[first];
        const Segment& t = segments_[second];
        const glm::dvec2 a = plane_.at(s.from);
        const glm::dvec2 b = plane_.at(s.to);
        const glm::dvec2 c = plane_.at(t.from);
        const glm::dvec2 d = plane_.at(t.to);
        for (int axis = 0; axis < 2; ++axis) {
            if (std::max(a[axis], b[axis]) + rounding_ < std::min(c[axis], d[axis])) return;
            if (std::max(c[axis], d[axis]) + rounding_ < std::min(a[axis], b[axis])) return;
        }
        if (plane_.same_direction(s.direction, t.direction) ||
            plane_.same_direction(s.direction, reversed(t.direction))) {
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
            const double whole = cross(b - a, d - c);
            const double part = std::clamp(cross(c - a, d - c) / whole, 0.0, 1.0);
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
        const glm::dvec2 way = plane_.at(node) - plane_.at(segments_[segment].from);
        cuts_.push_back({segment, node, node, false, std::hypot(way.x, way.y)});
    }

    void make_edges() {
        Union same(plane_.size() + crossings_.size());
        for (std::size_t i = 1; i < cuts_.size(); ++i) {
            pulse_();
            if (are_one(cuts_[i - 1], cuts_[i])) same.join(cuts_[i - 1].vertex, cuts_[i].vertex);
        }
        // Pieces of all segments, of which those that lie on each other become one edge.
        struct Piece {
            std::uint32_t a, b, segment, number;
        };
        std::vector<Piece> pieces;
        pieces.reserve(segments_.size() + cuts_.size());
        std::size_t next_cut = 0;
        piece_begins_.reserve(segments_.size() + 1);
        for (std::uint32_t i = 0; i < segments_.size(); ++i) {
            pulse_();
            piece_begins_.push_back(static_cast<std::uint32_t>(pieces.size()));
            std::uint32_t last = same.find(segments_[i].from);
            const auto add = [&](std::uint32_t vertex) {
                if (vertex != last) pieces.push_back({last, vertex, i, static_cast<std::uint32_t>(pieces.size())});
                last = vertex;
            };
            for (; next_cut < cuts_.size() && cuts_[next_cut].segment == i; ++next_cut) {
                add(same.find(cuts_[next_cut].vertex));
            }
            add(same.find(segments_[i].to));
        }
        piece_begins_.push_back(static_cast<std::uint32_t>(pieces.size()));
        cuts_ = {};
        if (pieces.size() >= none / 4) throw BudgetError("the drawing has too many edges to be examined");
        sort(pieces, [](const Piece& p, const Piece& q) {
            return std::tuple(std::minmax(p.a, p.b), p.number) < std::tuple(std::minmax(q.a, q.b), q.number);
        });
        piece_half_.assign(pieces.size(), 0);
        std::vector<std::uint32_t> dense(plane_.size() + crossings_.size(), none);
        const auto vertex_of = [&](std::uint32_t id) {
            if (dense[id] == none) {
                dense[id] = static_cast<std::uint32_t>(places_.size());
                places_.push_back(id < plane_.size() ? plane_.at(id) : crossings_[id - plane_.size()]);
                node_.push_back(id < plane_.size() ? id : none);
            }
            return dense[id];
        };
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pulse_();
            const Piece& piece = pieces[i];
            if (i == 0 || std::minmax(piece.a, piece.b) != std::minmax(pieces[i - 1].a, pieces[i - 1].b)) {
                edges_.emplace_back(vertex_of(piece.a), vertex_of(piece.b));
                edge_segment_.push_back(piece.segment);
            }
            const std::uint32_t edge = edge_count() - 1;
            piece_half_[piece.number] = 2 * edge + (dense[piece.a] == edges_[edge].first ? 0 : 1);
        }
        result_.edges = edges_.size();
        result_.vertices = places_.size();
        breathe();
    }
    std::span<const std::uint32_t> pieces(std::uint32_t segment) const {
        return {piece_half_.data() + piece_begins_[segment], piece_begins_[segment + 1] - piece_begins_[segment]};
    }

    void sort_around_vertices() {
        around_.resize(2 * edges_.size());
        std::iota(around_.begin(), around_.end(), 0u);
        around_begins_ = group_begins<std::uint32_t>(around_, places_.size(), options_.monitor,
                                                     [this](auto half) { return tail(half); });
        std::vector<std::uint32_t> next(around_begins_.begin(), around_begins_.end() - 1);
        for (std::uint32_t half = 0; half < 2 * edge_count(); ++half) {
            pulse_();
            around_[next[tail(half)]++] = half;
        }
        rank_.resize(around_.size());
        for (std::uint32_t vertex = 0; vertex < places_.size(); ++vertex) {
            pulse_();
            const auto begin = around_.begin() + around_begins_[vertex];
            const auto end = around_.begin() + around_begins_[vertex + 1];
            std::sort(begin, end, [this](std::uint32_t a, std::uint32_t b) {
                return std::pair(direction(a), a) < std::pair(direction(b), b);
            });
            for (auto i = begin; i != end; ++i) rank_[*i] = static_cast<std::uint32_t>(i - begin);
        }
        breathe();
    }

    /// The strokes as half-edges; how often each edge is drawn; which strokes make up a line.
    void follow_strokes() {
        std::vector<std::uint32_t> uses;
        std::vector<std::uint32_t> first_uses;
        std::vector<std::uint32_t>
            link;  // end 2u is where use u begins, 2u+1 where it ends: the end that it goes on at
        const auto join = [&](std::uint32_t a, std::uint32_t b) {
            link[a] = b;
            link[b] = a;
        };
        for (std::size_t i = 0; i < strokes_.count(); ++i) {
            const auto nodes = strokes_.stroke(i);
            const auto first = static_cast<std::uint32_t>(uses.size());
            first_uses.push_back(first);
            for (std::size_t j = 1; j < nodes.size(); ++j) {
                pulse_();
                const std::uint32_t segment = segment_between(nodes[j - 1], nodes[j]);
                const auto halves = pieces(segment);
                const bool forward = segments_[segment].from == nodes[j - 1];
                for (std::size_t k = 0; k < halves.size(); ++k) {
                    uses.push_back(forward ? halves[k] : halves[halves.size() - 1 - k] ^ 1);
                }
            }
            if (uses.size() >= none / 4) throw BudgetError("the drawing has too many edges to be examined");
            const auto last = static_cast<std::uint32_t>(uses.size());
            link.resize(2 * uses.size(), none);
            for (std::uint32_t use = first; use + 1 < last; ++use) {
                pulse_();
                join(2 * use + 1, 2 * use + 2);
            }
            if (strokes_.closed[i] && last > first) join(2 * last - 1, 2 * first);
        }
        breathe();
        const auto leaving = [&](std::uint32_t end) { return end % 2 == 0 ? uses[end / 2] : uses[end / 2] ^ 1; };

        // Ends of strokes at one vertex go on into each other: first those that do so straight on.
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;  // vertex, end
        for (std::uint32_t end = 0; end < link.size(); ++end) {
            if (link[end] == none) ends.emplace_back(tail(leaving(end)), end);
        }
        sort(ends, [&](const auto& a, const auto& b) {
            return std::tuple(a.first, rank_[leaving(a.second)], a.second) <
                   std::tuple(b.first, rank_[leaving(b.second)], b.second);
        });
        for (std::size_t begin = 0; begin < ends.size();) {
            std::size_t end = begin + 1;
            while (end < ends.size() && ends[end].first == ends[begin].first) ++end;
            std::vector<std::uint32_t> left;
            for (std::size_t i = begin; i < end; ++i) {
                pulse_();
                const std::uint32_t ahead = behind(leaving(ends[i].second));
                if (link[ends[i].second] != none || ahead == none) continue;
                const auto wanted = std::pair(ends[i].first, rank_[ahead]);
                for (auto other = std::lower_bound(ends.begin() + static_cast<std::ptrdiff_t>(begin),
                                                   ends.begin() + static_cast<std::ptrdiff_t>(end), wanted,
                                                   [&](const auto&a, const auto&key) {
                                                       return std::pair(a.first, rank_[leaving(a.second)]) < key;
                                                   });
                     other != ends.begin() + static_cast<std::ptrdiff_t>(end) && leaving(other->second) == ahead;
                     ++other) {
                    if (link[other->second] != none) continue;
                    join(ends[i].second, other->second);
                    break;
                }
            }
            for (std::size_t i = begin; i < end; ++i) {
                if (link[ends[i].second] == none) left.push_back(ends[i].second);
            }
            if (left.size() % 2 == 0) {
                for (std::size_t i = 0; i < left.size() / 2; ++i) join(left[i], left[i + left.size() / 2]);
            }
            begin = end;
        }

        breathe();
        Union lines(uses.size());
        for (std::uint32_t end = 0; end < link.size(); ++end) {
            pulse_();
            if (link[end] != none) lines.join(end / 2, link[end] / 2);
        }
        std::vector<char> is_open(uses.size(), 0);
        for (std::uint32_t end = 0; end < link.size(); ++end) {
            if (link[end] == none) is_open[lines.find(end / 2)] = 1;
        }
        for (const std::uint32_t use : first_uses) is_of_open_line_.push_back(is_open[lines.find(use)] != 0);
        std::unordered_map<std::uint32_t, std::uint32_t> numbers;
        for (const std::uint32_t use : first_uses) {
            const auto [found, is_new] =
                numbers.try_emplace(lines.find(use), static_cast<std::uint32_t>(numbers.size()));
            result_.line_of_stroke.push_back(found->second);
        }
        times_.assign(edges_.size(), 0);
        closed_times_.assign(edges_.size(), 0);
        for (std::uint32_t use = 0; use < uses.size(); ++use) {
            pulse_();
            const std::uint32_t line = lines.find(use);
            if (line == use) {
                ++result_.lines;
                result_.open_lines += static_cast<std::uint64_t>(is_open[line]);
            }
            ++times_[uses[use] / 2];
            if (!is_open[line]) closed_times_[uses[use] / 2] ^= 1;
        }
        for (const std::uint32_t times : times_) result_.reused_edges += times > 1 ? 1 : 0;
        for (std::uint32_t end = 0; end < link.size(); ++end) {
            pulse_();
            const std::uint32_t half = leaving(end);
            if (link[end] == none) passes_.push_back({tail(half), half, none});
            if (link[end] != none && end < link[end]) passes_.push_back({tail(half), half, leaving(link[end])});
        }
        sort(passes_, [](const Pass& a, const Pass& b) { return a.vertex < b.vertex; });
        breathe();
    }

    void look_at_meetings() {
        for (std::size_t begin = 0; begin < passes_.size();) {
            std::size_t end = begin + 1;
            while (end < passes_.size() && passes_[end].vertex == passes_[begin].vertex) ++end;
            pulse_();
            const std::size_t count = end - begin;
            if (count > 1) ++result_.meetings;
            if (count > 2) ++result_.multiple;
            if (count == 2) look_at(passes_[begin], passes_[begin + 1]);
            begin = end;
        }
        passes_ = {};
    }
    void look_at(const Pass& p, const Pass& q) {
        for (const std::uint32_t half : {p.a, p.b, q.a, q.b}) {
            if (half != none && times_[half / 2] > 1) return;  // they run along each other
        }
        if (p.b == none || q.b == none) {
            ++result_.touchings;
            return;
        }
        const auto [low, high] = std::minmax(rank_[p.a], rank_[p.b]);
        const auto lies_between = [low = low, high = high](std::uint32_t rank) { return low < rank && rank < high; };
        if (lies_between(rank_[q.a]) == lies_between(rank_[q.b])) {
            ++result_.touchings;
            return;
        }
        ++result_.crossings;
        if (node_[p.vertex] == none) ++result_.mid_crossings;
        if (!are_opposite(p.a, p.b) || !are_opposite(q.a, q.b) || !are_perpendicular(p.a, q.a)) ++result_.skew;
    }

    void follow_straight() {
        Union lines(edges_.size());
        for (std::uint32_t vertex = 0; vertex < places_.size(); ++vertex) {
            pulse_();
            const auto list = around(vertex);
            for (std::size_t i = 0; i < list.size(); ++i) {
                const std::uint32_t ahead =
                    list.size() % 2 == 0 ? list[(i + list.size() / 2) % list.size()] : behind(list[i]);
                if (ahead != none) lines.join(list[i] / 2, ahead / 2);
            }
        }
        for (std::uint32_t edge = 0; edge < edge_count(); ++edge) {
            result_.straight_lines += lines.find(edge) == edge ? 1 : 0;
        }
    }

    /// Cycles of half-edges with a face on their left: the outline of each bounded face, and, for each component, one
    /// that runs around all of it.
    void find_faces() {
        cycle_.assign(2 * edges_.size(), none);
        std::vector<double> area;
        for (std::uint32_t first = 0; first < cycle_.size(); ++first) {
            if (cycle_[first] != none) continue;
            const auto number = static_cast<std::uint32_t>(cycle_begins_.size());
            cycle_begins_.push_back(first);
            const glm::dvec2 origin = places_[tail(first)];
            double twice = 0;
            std::uint32_t half = first;
            do {
                pulse_();
                cycle_[half] = number;
                twice += cross(places_[tail(half)] - origin, places_[head(half)] - origin);
                half = next(half);
            } while (half != first);
            area.push_back(twice / 2);
        }
        breathe();

        Union components(places_.size());
        for (const auto& [a, b] : edges_) components.join(a, b);
        component_.resize(places_.size());
        std::vector<std::uint32_t> lowest;  // vertex of each component
        std::vector<std::uint32_t> number(places_.size(), none);
        const auto is_lower = [this](std::uint32_t a, std::uint32_t b) {
            return std::pair(places_[a].y, places_[a].x) < std::pair(places_[b].y, places_[b].x);
        };
        for (std::uint32_t vertex = 0; vertex < places_.size(); ++vertex) {
            pulse_();
            const std::uint32_t root = components.find(vertex);
            if (number[root] == none) {
                number[root] = static_cast<std::uint32_t>(lowest.size());
                lowest.push_back(vertex);
            }
            component_[vertex] = number[root];
            std::uint32_t& low = lowest[number[root]];
            if (is_lower(vertex, low)) low = vertex;
        }
        outer_.assign(lowest.size(), none);
        for (std::uint32_t cycle = 0; cycle < cycle_begins_.size(); ++cycle) {
            std::uint32_t& outer = outer_[component_[tail(cycle_begins_[cycle])]];
            if (outer == none || area[cycle] < area[outer]) outer = cycle;
        }
        result_.components = lowest.size();
        result_.faces = cycle_begins_.size() - lowest.size();

        // From below, so that what a component lies in is known before it.
        std::vector<std::uint32_t> order(lowest.size());
        std::iota(order.begin(), order.end(), 0u);
        sort(order, [&](std::uint32_t a, std::uint32_t b) { return is_lower(lowest[a], lowest[b]); });
        container_.assign(lowest.size(), none);
        odd_.assign(cycle_begins_.size(), 0);
        has_holes_.assign(cycle_begins_.size(), 0);
        std::vector<char> reached(cycle_begins_.size(), 0);
        std::vector<std::uint32_t> front;
        for (const std::uint32_t component : order) {
            pulse_();
            if (lowest.size() > 1) container_[component] = face_at(places_[lowest[component]]);
            const std::uint32_t container = container_[component];
            if (container != none) has_holes_[container] = 1;
            odd_[outer_[component]] = container == none ? 0 : odd_[container];
            reached[outer_[component]] = 1;
            front = {outer_[component]};
            while (!front.empty()) {
                const std::uint32_t first = cycle_begins_[front.back()];
                const char odd = odd_[front.back()];
                front.pop_back();
                std::uint32_t half = first;
                do {
                    pulse_();
                    const std::uint32_t beyond = cycle_[half ^ 1];
                    if (!reached[beyond]) {
                        reached[beyond] = 1;
                        odd_[beyond] = static_cast<char>(odd ^ closed_times_[half / 2]);
                        front.push_back(beyond);
                    }
                    half = next(half);
                } while (half != first);
            }
        }
        breathe();
    }
    std::uint32_t next(std::uint32_t half) const {
        const auto list = around(head(half));
        const std::uint32_t back = rank_[half ^ 1];
        return list[back == 0 ? list.size() - 1 : back - 1];
    }

    /// The bounded face in which a point lies that is on no edge; none outside. Looks down until an edge is met; an
    /// edge covers its left end and not its right one.
    std::uint32_t face_at(glm::dvec2 point) const {
        const auto& entries = grid_->entries();
        const std::uint64_t column = grid_->column(point.x);
        std::uint32_t found = none;
        double found_y = 0;
        double found_slope = 0;
        for (std::size_t i = grid_->end_of(column, grid_->row(point.y)); i > 0; --i) {
            const std::uint64_t key = entries[i - 1].key;
            if (key >> 32 != column) break;
            if (found != none && (key & 0xffffffff) < grid_->row(found_y)) break;
            const auto halves = pieces(entries[i - 1].item);
            const Segment& segment = segments_[entries[i - 1].item];
            const bool rightward = plane_.at(segment.from).x < plane_.at(segment.to).x;
            const auto piece = std::partition_point(halves.begin(), halves.end(), [&](std::uint32_t half) {
                return rightward ? places_[head(half)].x <= point.x : places_[head(half)].x > point.x;
            });
            if (piece == halves.end()) continue;
            const std::uint32_t half = rightward ? *piece : *piece ^ 1;
            const glm::dvec2 a = places_[tail(half)];
            const glm::dvec2 b = places_[head(half)];
            if (!(a.x <= point.x && point.x < b.x)) continue;
            const double slope = (b.y - a.y) / (b.x - a.x);
            const double y = a.y + (point.x - a.x) * slope;
            if (!(y < point.y - rounding_)) continue;
            const bool is_same = found != none && std::fabs(y - found_y) <= rounding_;
            if (found == none || (is_same ? slope > found_slope : y > found_y)) {
                found = half;
                found_y = y;
                found_slope = slope;
            }
        }
        if (found == none) return none;
        const std::uint32_t cycle = cycle_[found];
        const std::uint32_t component = component_[tail(found)];
        return cycle == outer_[component] ? container_[component] : cycle;
    }

    /// Of straight lines the longest straight pieces must be mapped onto each other, of splines the control points
    /// with both neighbours.
    void find_symmetry() {
        result_.orbit_of_line.resize(result_.lines);
        std::iota(result_.orbit_of_line.begin(), result_.orbit_of_line.end(), 0U);
        std::vector<Element> elements;
        if (options_.spline) {
            for (std::size_t i = 0; i < strokes_.count(); ++i) {
                const auto nodes = strokes_.stroke(i);
                const std::size_t last = nodes.size() - 1;
                for (std::size_t j = 1; j < last; ++j) elements.push_back({nodes[j - 1], nodes[j], nodes[j + 1]});
                if (strokes_.closed[i]) {
                    elements.push_back({nodes[last - 1], nodes[last], nodes[1]});
                } else {
                    elements.push_back({nodes[1], nodes[0], none});
                    elements.push_back({nodes[last - 1], nodes[last], none});
                }
            }
        } else {
            for (std::uint32_t half = 0; half < 2 * edge_count(); ++half) {
                pulse_();
                if (behind(half) != none) continue;
                std::uint32_t last = half;
                while (true) {
                    const std::uint32_t ahead = behind(last ^ 1);
                    if (ahead == none) break;
                    last = ahead;
                }
                const Element element = {node_[tail(half)], none, node_[head(last)]};
                if (element[0] == none || element[2] == none) return;
                if (element[0] < element[2]) elements.push_back(element);
            }
        }
        for (Element& element : elements) order(element);
        sort(elements);
        std::vector<std::uint32_t> nodes;
        for (const Element& element : elements) {
            for (const std::uint32_t node : element) {
                if (node != none) nodes.push_back(node);
            }
        }
        sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        if (nodes.empty()) return;
        const typename Plane::Images images(plane_, nodes);
        result_.centre = images.centre;

        std::vector<std::uint32_t> image(plane_.size(), none);
        const auto maps_onto_itself = [&](const auto& map) {
            breathe();
            for (const std::uint32_t node : nodes) {
                pulse_();
                image[node] = map(node);
                if (image[node] == none) return false;
            }
            std::vector<Element> mapped = elements;
            for (Element& element : mapped) {
                pulse_();
                for (std::uint32_t& node : element) node = node == none ? none : image[node];
                order(element);
            }
            sort(mapped);
            return mapped == elements;
        };
        KolamSymmetry& symmetry = result_.symmetry;
        LineImages lines(strokes_, result_.line_of_stroke, result_.lines);
        for (const std::uint32_t order : images.orders()) {
            if (maps_onto_itself([&](std::uint32_t node) { return images.rotation(node, order); })) {
                symmetry.rotations = order;
                lines.join([&](std::uint32_t node) { return images.rotation(node, order); });
                break;
            }
        }
        for (std::uint32_t which = 0; which < images.mirrors(symmetry.rotations); ++which) {
            if (maps_onto_itself([&](std::uint32_t node) { return images.mirror(node, which); })) {
                symmetry.mirrors = symmetry.rotations;
                lines.join([&](std::uint32_t node) { return images.mirror(node, which); });
                break;
            }
        }
        result_.orbit_of_line = lines.orbits();
    }
    static void order(Element& element) {
        if (element[0] > element[2]) std::swap(element[0], element[2]);
    }

    void set_dots() {
        std::vector<glm::dvec2> outline;
        for (std::uint32_t cycle = 0; cycle < cycle_begins_.size(); ++cycle) {
            pulse_();
            const std::uint32_t first = cycle_begins_[cycle];
            if (!odd_[cycle] || outer_[component_[tail(first)]] == cycle) continue;
            outline.clear();
            std::uint32_t half = first;
            do {
                outline.push_back(places_[tail(half)]);
                half = next(half);
            } while (half != first);
            KolamDot mark{centroid(outline), true, false};
            mark.is_alone = !has_holes_[cycle] && sees_all(mark.at, outline);
            if (!mark.is_alone && face_at(mark.at) != cycle) {
                mark.is_enclosed = false;
                for (const double inward : {0.9, 0.5, 0.1, 0.01, 1e-4}) {
                    if (find_place(cycle, outline, inward, mark.at)) {
                        mark.is_enclosed = true;
                        break;
                    }
                }
            }
            result_.dots.push_back(mark);
        }
        if (options_.spline) ask_the_curve();
        // Rounding must not put the dots of one row out of order.
        const auto key = [](const KolamDot& mark) {
            return std::pair(std::round(mark.at.y * 1e6), std::round(mark.at.x * 1e6));
        };
        sort(result_.dots, [&](const KolamDot& a, const KolamDot& b) { return key(a) < key(b); });
    }
    static glm::dvec2 centroid(std::span<const glm::dvec2> outline) {
        const glm::dvec2 origin = outline.front();
        glm::dvec2 sum(0.0);
        double area = 0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 a = outline[i] - origin;
            const glm::dvec2 b = outline[(i + 1) % outline.size()] - origin;
            area += cross(a, b);
            sum += cross(a, b) * (a + b);
        }
        return area == 0 ? origin : origin + sum / (3 * area);
    }
    bool sees_all(glm::dvec2 point, std::span<const glm::dvec2> outline) const {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 a = outline[i];
            const glm::dvec2 along = outline[(i + 1) % outline.size()] - a;
            if (cross(along, point - a) <= rounding_ * (std::fabs(along.x) + std::fabs(along.y))) return false;
        }
        return true;
    }
    /// A point of the face in one of its corners.
    bool find_place(std::uint32_t cycle, std::span<const glm::dvec2> outline, double inward,
                    glm::dvec2& place) const {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 corner = outline[i];
            const glm::dvec2 before = outline[(i + outline.size() - 1) % outline.size()];
            const glm::dvec2 after = outline[(i + 1) % outline.size()];
            if (cross(corner - before, after - corner) <= 0) continue;
            place = corner + inward / 3 * ((before - corner) + (after - corner));
            if (face_at(place) == cycle) return true;
        }
        return false;
    }

    /// Of a spline the dots have to lie within the curve, not only within its control polygon. Between the two, at
    /// each span, lies a small loop; a dot in it changes sides.
    void ask_the_curve() {
        constexpr int chords = 16;
        if (result_.dots.empty()) return;
        glm::dvec2 low = result_.dots.front().at;
        glm::dvec2 high = low;
        for (const KolamDot& mark : result_.dots) {
            low = {std::min(low.x, mark.at.x), std::min(low.y, mark.at.y)};
            high = {std::max(high.x, mark.at.x), std::max(high.y, mark.at.y)};
        }
        Grid near(low, high, grid_->cell(), 0.0);
        for (std::uint32_t i = 0; i < result_.dots.size(); ++i) near.add(i, result_.dots[i].at, result_.dots[i].at);
        near.sort(options_.monitor);
        std::vector<char> flips(result_.dots.size(), 0);
        std::vector<glm::dvec2> loop;
        for (std::size_t i = 0; i < strokes_.count(); ++i) {
            if (is_of_open_line_[i]) continue;
            const auto nodes = strokes_.stroke(i);
            const auto count = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
            const bool closed = strokes_.closed[i];
            const auto control = [&](std::ptrdiff_t j) {
                j = closed ? (j % count + count) % count : std::clamp<std::ptrdiff_t>(j, 0, count);
                return plane_.at(nodes[static_cast<std::size_t>(j)]);
            };
            for (std::ptrdiff_t j = closed ? 0 : -1; j < (closed ? count : count + 1); ++j) {
                pulse_();
                const std::array<glm::dvec2, 4> p = {control(j - 1), control(j), control(j + 1), control(j + 2)};
                const std::array<glm::dvec2, 4> reach = {p[1], p[2], (p[0] + 4.0 * p[1] + p[2]) / 6.0,
                                                         (p[1] + 4.0 * p[2] + p[3]) / 6.0};
                bool reaches_dots = false;
                const auto [left, right] = std::minmax({reach[0].x, reach[1].x, reach[2].x, reach[3].x});
                const auto [bottom, top] = std::minmax({reach[0].y, reach[1].y, reach[2].y, reach[3].y});
                near.visit(reach, [&, left = left, right = right, bottom = bottom, top = top](std::uint32_t number) {
                    const glm::dvec2 at = result_.dots[number].at;
                    reaches_dots |= left <= at.x && at.x <= right && bottom <= at.y && at.y <= top;
                });
                if (!reaches_dots) continue;
                loop = {p[2], p[1]};
                for (int k = 0; k <= chords; ++k) {
                    const double t = static_cast<double>(k) / chords;
                    const double s = 1 - t;
                    loop.push_back((s * s * s * p[0] + (3 * t * t * t - 6 * t * t + 4) * p[1] +
                                    (3 * s * s * s - 6 * s * s + 4) * p[2] + t * t * t * p[3]) /
                                   6.0);
                }
                flip_within(loop, near, flips);
            }
        }
        for (std::size_t i = 0; i < flips.size(); ++i) {
            if (flips[i]) result_.dots[i].is_enclosed = !result_.dots[i].is_enclosed;
        }
    }
    void flip_within(std::span<const glm::dvec2> loop, const Grid& near, std::vector<char>& flips) const {
        near.visit(loop, [&](std::uint32_t number) {
            const glm::dvec2 at = result_.dots[number].at;
            bool inside = false;
            for (std::size_t j = 0; j < loop.size(); ++j) {
                const glm::dvec2 a = loop[j];
                const glm::dvec2 b = loop[(j + 1) % loop.size()];
                if ((a.y > at.y) == (b.y > at.y)) continue;
                if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
            }
            if (inside) flips[number] ^= 1;
        });
    }

    const Plane& plane_;
    const Strokes& strokes_;
    const KolamOptions& options_;
    Pulse pulse_;
    KolamExamination result_;
    double rounding_ = 0.0;

    std::vector<Segment> segments_;  // by nodes
    std::optional<Grid> grid_;
    std::vector<Cut> cuts_;
    std::vector<glm::dvec2> crossings_;  // where segments cross within both

    std::vector<glm::dvec2> places_;                              // of vertices
    std::vector<std::uint32_t> node_;                             // of a vertex, or none
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  // vertices, as the edge's segment runs
    std::vector<std::uint32_t> edge_segment_;
    std::vector<std::uint32_t> piece_begins_;  // for each segment, into piece_half_
    std::vector<std::uint32_t> piece_half_;    // along the segment
    std::vector<std::uint32_t> around_begins_;
    std::vector<std::uint32_t> around_;  // half-edges by the vertex that they leave, anticlockwise
    std::vector<std::uint32_t> rank_;    // of a half-edge among those
    std::vector<std::uint32_t> times_;   // how often an edge is drawn
    std::vector<char> closed_times_;     // by closed lines, modulo 2
    std::vector<bool> is_of_open_line_;  // for each stroke
    std::vector<Pass> passes_;

    std::vector<std::uint32_t> cycle_;         // of a half-edge
    std::vector<std::uint32_t> cycle_begins_;  // one of its half-edges
    std::vector<std::uint32_t> component_;     // of a vertex
    std::vector<std::uint32_t> outer_;         // cycle around a component
    std::vector<std::uint32_t> container_;     // the face that a component lies in, or none
    std::vector<char> odd_;                    // of a cycle's face
    std::vector<char> has_holes_;
};

template <class Plane>
KolamExamination examine_in(Plane& plane, int rank, const Grammar& grammar, const KolamOptions& options) {
    StrokeReader<Plane> reader(plane, rank, options.budget / 40, options.draws);
    const auto turtle = Turtle::tracing(grammar, reader, reader, options.spline && !options.moves_lift);
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.limit_whole_words(options.budget);
    derivation.watch = options.watch;
    derive(grammar, *turtle, derivation);
    const Strokes strokes = reader.finish();
    if (strokes.count() == 0) {
        throw std::runtime_error("there is nothing to examine: the word holds no step that draws");
    }
    return Examiner<Plane>(plane, strokes, options).examine();
}

template <typename Number>
std::string counted(Number count, std::string_view one, std::string_view many) {
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

}  // namespace

std::string KolamSymmetry::name() const {
    return fmt::format("{}{}", mirrors > 0 ? 'D' : 'C', rotations);
}

std::uint64_t KolamExamination::loose_dots() const {
    return static_cast<std::uint64_t>(std::count_if(
        dots.begin(), dots.end(), [](const KolamDot& mark) { return !mark.is_enclosed || !mark.is_alone; }));
}

std::vector<std::string> KolamExamination::faults() const {
    std::vector<std::string> faults;
    if (open_lines > 0) {
        faults.push_back(
            lines == 1 ? "the line is open"
                       : fmt::format("{} of {} lines {} open", open_lines, lines, open_lines == 1 ? "is" : "are"));
    }
    if (reused_edges > 0) {
        faults.push_back(counted(reused_edges, "edge is drawn more than once", "edges are drawn more than once"));
    }
    if (dots.empty()) {
        faults.emplace_back("no closed line goes around a dot");
    } else if (const std::uint64_t loose = loose_dots(); loose > 0) {
        faults.push_back(fmt::format("{} of {} {} not circumscribed: the line wanders out of {} sight", loose,
                                     counted(dots.size(), "dot", "dots"), loose == 1 ? "is" : "are",
                                     loose == 1 ? "its" : "their"));
    }
    return faults;
}

std::vector<std::string> KolamExamination::remarks() const {
    std::vector<std::string> remarks;
    if (lines > 1) remarks.push_back(fmt::format("there are {} lines", lines));
    if (skew > 0) {
        remarks.push_back(counted(skew, "crossing is not at right angles", "crossings are not at right angles"));
    }
    if (multiple > 0) {
        remarks.push_back(
            counted(multiple, "point is visited more than twice", "points are visited more than twice"));
    }
    return remarks;
}

KolamExamination examine_kolam(const Grammar& given, const KolamOptions& options) {
    if (given.is_spatial())
        throw std::runtime_error("a kolam lies in the plane: this drawing pitches, rolls or bends");
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    const Grammar grammar = resolve_contexts(shorten(given), whole_words);
    require_affordable(grammar, true, options.budget);
    const Lattice lattice = make_lattice(grammar);
    if (lattice.rank > 0) {
        ExactPlane plane(lattice);
        try {
            return examine_in(plane, lattice.rank, grammar, options);
        } catch (const ExactPlane::OutOfRange&) {
        }
    }
    RoughPlane plane;
    return examine_in(plane, 0, grammar, options);
}

std::vector<glm::dvec2> dot_places(const KolamExamination& examination) {
    std::vector<glm::dvec2> places;
    for (const KolamDot& mark : examination.dots) places.push_back(mark.at);
    return places;
}

}  // namespace sikku
