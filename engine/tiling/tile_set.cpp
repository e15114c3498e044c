#include "engine/tiling/tile_set.h"

#include "engine/base/chance.h"
#include "engine/base/memory.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/polygon_classes.h"
#include "engine/geometry/turtle.h"
#include "engine/tiling/tile_repeats.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

namespace sikku {
namespace {

using Points = std::vector<std::uint32_t>;

/// Bytes that the examination needs for each corner of a tile, at most.
constexpr double bytes_of_corner = 120;

/// The place along the edge from a to b, from 0 to 1, where another edge crosses or touches it.
std::optional<double> meeting(const TilePlane& plane, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              std::uint32_t d) {
    const int c_side = plane.side(a, b, c), d_side = plane.side(a, b, d);
    if (c_side * d_side > 0) return std::nullopt;
    const int a_side = plane.side(c, d, a), b_side = plane.side(c, d, b);
    if (a_side * b_side > 0) return std::nullopt;
    const glm::dvec2 from = plane.at(a), along = plane.at(b) - from;
    const auto share = [&](std::uint32_t point) {
        return scalar_product(along, plane.at(point) - from) / scalar_product(along, along);
    };
    if (c_side == 0 && d_side == 0) {
        // On one line: apart, unless their intervals overlap.
        const double first = std::min(share(c), share(d)), last = std::max(share(c), share(d));
        if (last < 0 || first > 1) return std::nullopt;
        return std::max(first, 0.0);
    }
    if (c_side == 0) return share(c);
    if (d_side == 0) return share(d);
    const double first = determinant(along, plane.at(c) - from), second = determinant(along, plane.at(d) - from);
    const glm::dvec2 at = plane.at(c) + (first / (first - second)) * (plane.at(d) - plane.at(c));
    return scalar_product(along, at - from) / scalar_product(along, along);
}

/// Finds where an outline crosses or touches itself: the first place along its first edge with one. Cost: k^2.
std::optional<glm::dvec2> find_crossing(const TilePlane& plane, const Points& corners, const Monitor& monitor) {
    const std::size_t count = corners.size();
    Points sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) return plane.at(*twice);
    Pulse pulse(monitor);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % count];
        const glm::dvec2 from = plane.at(a), to = plane.at(b);
        const double margin = plane.tolerance();
        const double left = std::min(from.x, to.x) - margin, right = std::max(from.x, to.x) + margin;
        const double low = std::min(from.y, to.y) - margin, high = std::max(from.y, to.y) + margin;
        std::optional<double> first;
        for (std::size_t j = i + 2; j < count && j - i < count - 1; ++j) {
            pulse();
            const std::uint32_t c = corners[j], d = corners[(j + 1) % count];
            const glm::dvec2 p = plane.at(c), q = plane.at(d);
            if (std::min(p.x, q.x) > right || std::max(p.x, q.x) < left) continue;
            if (std::min(p.y, q.y) > high || std::max(p.y, q.y) < low) continue;
            const auto share = meeting(plane, a, b, c, d);
            if (share && (!first || *share < *first)) first = share;
        }
        if (first) return from + *first * (to - from);
    }
    return std::nullopt;
}

}  // namespace

std::size_t least_rotation(std::span<const std::uint32_t> sequence) {
    const std::size_t count = sequence.size();
    std::size_t i = 0, j = 1, same = 0;
    while (i < count && j < count && same < count) {
        const std::uint32_t a = sequence[(i + same) % count], b = sequence[(j + same) % count];
        if (a == b) {
            ++same;
            continue;
        }
        (a > b ? i : j) += same + 1;
        if (i == j) ++j;
        same = 0;
    }
    return std::min(i, j);
}

std::uint64_t hash_of(std::span<const std::uint32_t> sequence) {
    std::uint64_t hash = sequence.size();
    for (const std::uint32_t each : sequence) hash = scrambled(hash + 0x9e3779b97f4a7c15 + each);
    return hash;
}

class TileCollector::Implementation {
public:
    Implementation(TilePlane& plane, TileSet& tiles, double most_corners, const Monitor& monitor)
        : plane_(plane),
          tiles_(tiles),
          most_corners_(most_corners),
          monitor_(monitor),
          shapes_(plane_.is_rough() ? 4 * plane.tolerance() : 0) {
        tiles_.begin.assign(1, 0);
        angle_number(180, 0);
    }

    /// Adds a polygon of an exact plane by its coordinates. Outlines like earlier ones need no examination.
    void add(std::span<const std::int64_t> coordinates, std::span<const glm::dvec2> places, std::int32_t colour,
             bool is_closed) {
        const std::size_t rank = plane_.numbers().rank();
        key_.clear();
        for (std::size_t i = rank; i < coordinates.size(); ++i) {
            const std::int64_t way = coordinates[i] - coordinates[i % rank];
            if (way != static_cast<std::int32_t>(way)) throw TilePlane::OutOfRange();
            key_.push_back(static_cast<std::uint32_t>(way));
        }
        if (const auto at = outlines_.find(key_); is_closed && at != outlines_.end()) {
            ++tiles_.polygons;
            corners_.clear();
            for (const std::uint32_t corner : at->second.corners) {
                corners_.push_back(plane_.point(coordinates.subspan(corner * rank, rank), places[corner]));
            }
            return keep_tile(at->second.in_class, colour);
        }
        outline_points_.clear();
        for (std::size_t i = 0; i < places.size(); ++i) {
            outline_points_.push_back(plane_.point(coordinates.subspan(i * rank, rank), places[i]));
        }
        const std::size_t tiles = tiles_.tiles();
        add(outline_points_, colour, is_closed);
        if (tiles_.tiles() == tiles || outlines_.size() >= most_outlines) return;
        Outline& known = outlines_[key_];
        known.in_class = tiles_.in_class.back();
        for (const std::uint32_t corner : corners_) {
            const auto found = std::find(outline_points_.begin(), outline_points_.end(), corner);
            known.corners.push_back(static_cast<std::uint32_t>(found - outline_points_.begin()));
        }
    }

    void add(std::span<const std::uint32_t> points, std::int32_t colour, bool is_closed) {
        ++tiles_.polygons;
        if (!is_closed) return fault(TileFault::open, plane_.at(points.back()));
        take_corners(points);
        if (!corners_.empty() && has_spike_) return fault(TileFault::crossing, plane_.at(spike_));
        if (plane_.is_rough() && loses_area()) return fault(TileFault::too_fine, plane_.at(points.front()));
        if (corners_.size() < 3) return fault(TileFault::empty, plane_.at(points.front()));
        vectors_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            vectors_.push_back(plane_.vector(corners_[i], corners_[(i + 1) % corners_.size()]));
        }
        // Anticlockwise outlines of known classes need no examination.
        std::uint32_t in_class = find_class();
        if (in_class == no_number) {
            const double area = area_of(corners_);
            if (area < 0) {
                std::reverse(corners_.begin(), corners_.end());
                for (std::size_t i = 0; i < corners_.size(); ++i) {
                    vectors_[i] = plane_.vector(corners_[i], corners_[(i + 1) % corners_.size()]);
                }
                in_class = find_class();
            }
            if (in_class == no_number) {
                if (corners_.size() > most_corners_of_tile) {
                    throw BudgetError(fmt::format("polygon {} has {} corners; tiles have at most {}", tiles_.polygons,
                                                  corners_.size(), most_corners_of_tile));
                }
                if (const auto crossing = find_crossing(plane_, corners_, monitor_)) {
                    return fault(TileFault::crossing, *crossing);
                }
                if (std::fabs(area) < plane_.tolerance() * plane_.tolerance()) {
                    return fault(TileFault::empty, plane_.at(corners_.front()));
                }
                in_class = add_class();
            }
        }
        keep_tile(in_class, colour);
    }

    void expect(double polygons) { expected_ = polygons; }

    TileMark mark() const { return {tiles_.tiles(), tiles_.polygons}; }

    std::optional<std::uint32_t> keep_part(const TileMark& mark, const Cyclotomic::Number& origin) {
        if (tiles_.tiles() - mark.tiles != tiles_.polygons - mark.polygons) return std::nullopt;
        TilePart part;
        std::unordered_map<std::uint32_t, std::uint32_t> numbers;       // of points
        std::unordered_map<std::uint64_t, std::uint32_t> by_direction;  // edges by their ends; no_number: several
        const auto key = [](std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32U | to; };
        const std::uint32_t begin = tiles_.begin[mark.tiles];
        for (std::uint32_t tile = mark.tiles; tile < tiles_.tiles(); ++tile) {
            const auto corners = tiles_.corners(tile);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const auto edge = static_cast<std::uint32_t>(part.corner.size());
                const std::uint32_t to = corners[i + 1 < corners.size() ? i + 1 : 0];
                if (const auto [found, is_new] = by_direction.try_emplace(key(corners[i], to), edge); !is_new) {
                    found->second = no_number;
                }
                const auto [found, is_new] =
                    numbers.try_emplace(corners[i], static_cast<std::uint32_t>(numbers.size()));
                part.corner.push_back(found->second);
                if (!is_new) continue;
                const Cyclotomic::Number at = plane_.coordinates(corners[i]);
                for (std::size_t k = 0; k < plane_.numbers().rank(); ++k) {
                    const std::int64_t way = at[k] - origin[k];
                    if (way != static_cast<std::int32_t>(way)) return std::nullopt;
                    part.points.push_back(static_cast<std::int32_t>(way));
                }
            }
            part.in_class.push_back(tiles_.in_class[tile]);
            part.colour.push_back(tiles_.colour[tile]);
        }
        part.partner.assign(part.corner.size(), no_number);
        for (const auto& [ends, edge] : by_direction) {
            const auto other = by_direction.find(ends >> 32U | ends << 32U);
            if (edge != no_number && other != by_direction.end()) part.partner[edge] = other->second;
        }
        const auto number = static_cast<std::uint32_t>(tiles_.parts.size());
        tiles_.parts.push_back(std::move(part));
        tiles_.placed.push_back({begin, number});
        return number;
    }

    void add_part(std::uint32_t number, const Cyclotomic::Number& origin) {
        const TilePart& part = tiles_.parts[number];
        const std::size_t rank = plane_.numbers().rank();
        part_points_.clear();
        for (std::size_t i = 0; i < part.points.size(); i += rank) {
            Cyclotomic::Number at = origin;
            for (std::size_t k = 0; k < rank; ++k) at[k] += part.points[i + k];
            part_points_.push_back(plane_.point(at, {}));
        }
        const auto begin = static_cast<std::uint32_t>(tiles_.corner.size());
        auto corner = part.corner.begin();
        for (std::size_t tile = 0; tile < part.in_class.size(); ++tile) {
            ++tiles_.polygons;
            corners_.clear();
            for (std::size_t left = tiles_.classes[part.in_class[tile]].vectors.size(); left > 0; --left) {
                corners_.push_back(part_points_[*corner++]);
            }
            keep_tile(part.in_class[tile], part.colour[tile]);
        }
        // Only if no tile was left out as a duplicate.
        if (tiles_.corner.size() - begin == part.corner.size()) tiles_.placed.push_back({begin, number});
    }

private:
    /// An outline as it was drawn, and those of its vertices that are corners.
    struct Outline {
        std::uint32_t in_class = 0;
        Points corners;
    };
    struct Hash {
        std::size_t operator()(const Points& sequence) const { return static_cast<std::size_t>(hash_of(sequence)); }
    };
    static constexpr std::size_t most_outlines = 100'000;

    void keep_tile(std::uint32_t in_class, std::int32_t colour) {
        const std::uint32_t earlier = tiles_.anchors.add(in_class, corners_.front());
        if (earlier != no_number)
            return fault(TileFault::duplicate, plane_.at(corners_.front()), tiles_.number[earlier]);
        if (static_cast<double>(tiles_.corner.size() + corners_.size()) > most_corners_) {
            throw BudgetError(
                fmt::format("the tiles have more than {:.0f} corners, which exceeds the memory for "
                            "their examination; use a shorter derivation",
                            most_corners_));
        }
        tiles_.corner.insert(tiles_.corner.end(), corners_.begin(), corners_.end());
        tiles_.begin.push_back(static_cast<std::uint32_t>(tiles_.corner.size()));
        tiles_.in_class.push_back(in_class);
        tiles_.colour.push_back(colour);
        tiles_.number.push_back(tiles_.polygons);
        constexpr std::uint32_t sample = 1024;
        if (tiles_.tiles() == sample && expected_ > sample) reserve();
    }
    /// Reserves memory for the expected number of tiles that are like those so far.
    void reserve() {
        const double share =
            std::min(expected_ / tiles_.tiles(), most_corners_ / static_cast<double>(tiles_.corner.size()));
        const auto expected = [&](std::size_t size) {
            constexpr double most = 16e6;  // an estimate, which may be far too large
            return static_cast<std::size_t>(std::min(share * static_cast<double>(size), most)) + 1;
        };
        tiles_.corner.reserve(expected(tiles_.corner.size()));
        plane_.expect_points(expected(plane_.points()));
        for (auto* list : {&tiles_.begin, &tiles_.in_class, &tiles_.number}) list->reserve(expected(list->size()));
        tiles_.colour.reserve(expected(tiles_.colour.size()));
        use_large_pages(tiles_.corner);
    }

    void fault(TileFault fault, glm::dvec2 at, std::uint32_t other = 0) {
        tiles_.violations.add({fault, tiles_.polygons, other, at});
    }

    /// Sets `corners_` without points on straight stretches, and looks for points where the outline turns back.
    void take_corners(std::span<const std::uint32_t> points) {
        outline_.clear();
        for (const std::uint32_t point : points) {
            if (outline_.empty() || outline_.back() != point) outline_.push_back(point);
        }
        while (outline_.size() > 1 && outline_.front() == outline_.back()) outline_.pop_back();
        corners_.clear();
        has_spike_ = false;
        const std::size_t count = outline_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t before = outline_[(i + count - 1) % count], here = outline_[i],
                                after = outline_[(i + 1) % count];
            // A rounded point near a long edge may lie far from the line through a short one.
            const bool is_straight = before == after || (plane_.is_rough() ? plane_.side(before, after, here)
                                                                           : plane_.side(before, here, after)) == 0;
            const glm::dvec2 a = plane_.at(here) - plane_.at(before), b = plane_.at(after) - plane_.at(here);
            if (is_straight && scalar_product(a, b) < 0) {
                has_spike_ = true;
                spike_ = here;
            }
            if (!is_straight) corners_.push_back(here);
        }
    }

    /// True if the corners that were left out change the area of the outline by more than the tolerance allows.
    bool loses_area() const {
        if (corners_.size() == outline_.size() || outline_.size() < 3) return false;
        double length = 0;
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            length += glm::distance(plane_.at(outline_[i]), plane_.at(outline_[(i + 1) % outline_.size()]));
        }
        const double kept = corners_.size() < 3 ? 0 : area_of(corners_);
        return std::fabs(area_of(outline_) - kept) > plane_.tolerance() * length;
    }

    double area_of(const Points& corners) const {
        double area = 0;
        const glm::dvec2 origin = plane_.at(corners.front());
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            area += determinant(plane_.at(corners[i]) - origin, plane_.at(corners[i + 1]) - origin) / 2;
        }
        return area;
    }

    /// Rotates the outline to its least rotation; returns its class, or no_number.
    std::uint32_t find_class() {
        const std::size_t start = least_rotation(vectors_);
        std::rotate(vectors_.begin(), vectors_.begin() + static_cast<std::ptrdiff_t>(start), vectors_.end());
        std::rotate(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(start), corners_.end());
        const auto [begin, end] = by_hash_.equal_range(hash_of(vectors_));
        for (auto at = begin; at != end; ++at) {
            if (tiles_.classes[at->second].vectors == vectors_) return at->second;
        }
        return no_number;
    }

    /// Numbers of the squared length of each edge, and of its product with the next one: equal if and only if lengths
    /// and angles are.
    std::vector<std::int64_t> exact_signature() {
        std::vector<std::int64_t> signature;
        const auto number = [&](const Cyclotomic::Number& a, const Cyclotomic::Number& b) {
            const auto fresh = static_cast<std::int64_t>(products_.size());
            signature.push_back(products_.try_emplace(plane_.numbers().conjugate_product(a, b), fresh).first->second);
        };
        for (std::size_t i = 0; i < vectors_.size(); ++i) {
            const Cyclotomic::Number side = plane_.vector_coordinates(vectors_[i]);
            number(side, side);
            number(side, plane_.vector_coordinates(vectors_[(i + 1) % vectors_.size()]));
        }
        return signature;
    }

    std::uint32_t add_class() {
        TileClass added;
        added.vectors = vectors_;
        added.first = tiles_.tiles();
        std::vector<glm::dvec2> places;
        glm::dvec2 at(0.0);
        for (const std::uint32_t vector : vectors_) {
            places.push_back(at);
            at += plane_.vector_at(vector);
        }
        const PolygonClass found =
            plane_.is_exact() ? shapes_.classify(places, exact_signature()) : shapes_.classify(places);
        tiles_.shapes = static_cast<std::uint32_t>(shapes_.shapes());
        added.shape = found.shape;
        added.hand = found.hand;
        added.is_reflected = found.is_reflected;
        for (std::size_t i = 0; i < vectors_.size(); ++i) {
            const glm::dvec2 before = -plane_.vector_at(vectors_[(i + vectors_.size() - 1) % vectors_.size()]);
            const glm::dvec2 after = plane_.vector_at(vectors_[i]);
            const double angle = std::atan2(determinant(after, before), scalar_product(after, before));
            const double error = angle_error(plane_.tolerance(), glm::length(before), glm::length(after));
            added.angles.push_back(
                angle_number((angle < 0 ? angle + 2 * std::numbers::pi : angle) * 180 / std::numbers::pi, error));
            if (i > 0) added.area += determinant(places[i], places[(i + 1) % places.size()]) / 2;
        }
        if (plane_.is_exact()) {
            Cyclotomic::Number corner{};
            for (const std::uint32_t vector : vectors_) {
                Cyclotomic::Number next = plane_.vector_coordinates(vector);
                const Cyclotomic::Number product = plane_.numbers().conjugate_product(corner, next);
                const Cyclotomic::Number conjugate = plane_.numbers().conjugate(product);
                for (std::size_t i = 0; i < next.size(); ++i) {
                    added.area_4i[i] += product[i] - conjugate[i];
                    corner[i] += next[i];
                }
            }
        }
        const auto number = static_cast<std::uint32_t>(tiles_.classes.size());
        by_hash_.emplace(hash_of(vectors_), number);
        tiles_.classes.push_back(std::move(added));
        return number;
    }

    /// @param error  radians by which equal angles may differ, if positions are rough
    std::uint32_t angle_number(double degrees, double error) {
        if (plane_.is_rough()) {
            return rough_angles_.number(degrees, error * 180 / std::numbers::pi,
                                        [&](std::uint32_t) { tiles_.angles.push_back(degrees); });
        }
        constexpr double parts = 1e4;  // of a degree that are distinguished
        const auto key = static_cast<std::int64_t>(std::floor(degrees * parts + 0.3183));
        const auto [found, is_new] = angles_.try_emplace(key, static_cast<std::uint32_t>(tiles_.angles.size()));
        if (is_new) tiles_.angles.push_back(degrees);
        return found->second;
    }

    TilePlane& plane_;
    TileSet& tiles_;
    double most_corners_;
    double expected_ = 0;  // number of polygons
    const Monitor& monitor_;
    Points outline_, corners_, vectors_, key_, outline_points_, part_points_;
    std::unordered_map<Points, Outline, Hash> outlines_;  // by its vertices relative to the first one
    bool has_spike_ = false;
    std::uint32_t spike_ = 0;
    PolygonClasses shapes_;
    std::map<Cyclotomic::Number, std::int64_t> products_;  // numbers of products of edges of an exact plane
    std::unordered_multimap<std::uint64_t, std::uint32_t> by_hash_;
    std::unordered_map<std::int64_t, std::uint32_t> angles_;
    RoughNumbers rough_angles_;
};

TileCollector::TileCollector(TilePlane& plane, TileSet& tiles, double most_corners, const Monitor& monitor)
    : implementation_(std::make_unique<Implementation>(plane, tiles, most_corners, monitor)) {}
TileCollector::~TileCollector() = default;
void TileCollector::expect(double polygons) {
    implementation_->expect(polygons);
}
void TileCollector::add(std::span<const std::int64_t> coordinates, std::span<const glm::dvec2> places,
                        std::int32_t colour, bool is_closed) {
    implementation_->add(coordinates, places, colour, is_closed);
}
void TileCollector::add(std::span<const std::uint32_t> points, std::int32_t colour, bool is_closed) {
    implementation_->add(points, colour, is_closed);
}
TileMark TileCollector::mark() const {
    return implementation_->mark();
}
std::optional<std::uint32_t> TileCollector::keep_part(const TileMark& mark, const Cyclotomic::Number& origin) {
    return implementation_->keep_part(mark, origin);
}
void TileCollector::add_part(std::uint32_t part, const Cyclotomic::Number& origin) {
    implementation_->add_part(part, origin);
}

namespace {

/// Reads the polygons of a turtle.
class TileReader : public PolygonSink, public PlaceSink {
public:
    TileReader(TilePlane& plane, TileCollector& collector, TileScale& scale)
        : plane_(plane),
          collector_(collector),
          rank_(plane.is_exact() ? static_cast<std::size_t>(plane.lattice().rank) : 0),
          scale_(scale) {}

    void vertices(std::span<const std::int64_t> coordinates, std::uint64_t, bool is_closed) override {
        coordinates_ = coordinates;
        is_closed_ = is_closed;
        has_vertices_ = true;
    }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        // Inserted edges bound blades, not tiles.
        if (!std::exchange(has_vertices_, false)) return;
        if (rank_ > 0) return collector_.add(coordinates_, vertices, pen.colour, is_closed_);
        scale_.add(vertices);
        points_.clear();
        for (const glm::dvec2 vertex : vertices) points_.push_back(plane_.point({}, vertex));
        collector_.add(points_, pen.colour, is_closed_);
    }

private:
    TilePlane& plane_;
    TileCollector& collector_;
    std::size_t rank_;
    TileScale& scale_;
    std::span<const std::int64_t> coordinates_;
    bool is_closed_ = true;
    bool has_vertices_ = false;
    Points points_;
};

/// The number of polygons, if it is known before derivation, or 0.
double polygon_count(const Grammar& grammar) {
    const auto known = estimate(grammar, true);
    double polygons = 0;
    for (std::size_t i = 0; known && i < known->rough_counts.size(); ++i) {
        if (grammar.symbols()[i].command.action == Action::polygon_end) polygons += known->rough_counts[i];
    }
    return polygons;
}

}  // namespace

double most_corners(const TileLimits& limits) {
    const double bytes = limits.bytes > 0 ? limits.bytes : static_cast<double>(available_memory()) / 2;
    return std::min(bytes / bytes_of_corner, 1e9);
}

void TileScale::add(std::span<const glm::dvec2> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        farthest = std::max({farthest, std::fabs(corners[i].x), std::fabs(corners[i].y)});
        const double length = glm::distance(corners[i], corners[(i + 1) % corners.size()]);
        // Shorter edges are rounding errors.
        if (length > rounding * farthest) shortest = std::min(shortest, length);
    }
}

double TileScale::tolerance() const {
    constexpr double share = 0.01;  // of the shortest edge
    const double least = rounding * farthest, most = share * shortest;
    if (!(least <= most)) {
        throw BudgetError(fmt::format(
            "positions of up to {:.3g} steps are too large for doubles: edges are as short as {:.3g} steps; "
            "use a shorter derivation",
            farthest, shortest));
    }
    return std::clamp(TilePlane::least_tolerance, least, most);
}

TileSet collect_tiles(const Grammar& grammar, TilePlane& plane, const TileLimits& limits, TileScale& scale,
                      const Monitor& monitor) {
    const double polygons = polygon_count(grammar);
    if (polygons > limits.tiles) {
        throw BudgetError(fmt::format("n = {} makes about {:.3g} tiles; at most {:.0f} are examined", grammar.steps(),
                                      polygons, limits.tiles));
    }
    require_affordable(grammar, true, limits.nodes);
    TileSet tiles;
    TileCollector collector(plane, tiles, most_corners(limits), monitor);
    collector.expect(polygons);
    TileReader reader(plane, collector, scale);
    const auto turtle = Turtle::tracing(grammar, reader, reader, false);
    const auto watch = [&monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    monitor.expect(expected_symbols(grammar, true));
    DerivationOptions derivation = DerivationOptions::within(limits.nodes, watch);
    std::optional<TileRepeats> repeats;
    if (plane.is_exact()) derivation.pruner = &repeats.emplace(grammar, *turtle, collector, monitor);
    derive(grammar, *turtle, derivation);
    return tiles;
}

}  // namespace sikku
