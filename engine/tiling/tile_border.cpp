#include "engine/tiling/tile_border.h"

#include "engine/base/numbers.h"
#include "engine/base/union_find.h"
#include "engine/tiling/place_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace sikku {
namespace {

class BorderFinder {
public:
    BorderFinder(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                 const TileNeighbours& neighbours, const Monitor& monitor)
        : plane_(plane), tiles_(tiles), pieces_(pieces), neighbours_(neighbours), pulse_(monitor), overlaps_(tiles) {
        for (std::uint32_t side = 0; side < pieces_.sides(); ++side) {
            if (is_border(side)) border_.push_back(side);
        }
        loop_of_.assign(border_.size(), no_number);
    }

    TileBorder find() {
        find_followers();
        for (std::size_t i = 0; i < border_.size(); ++i) {
            if (loop_of_[i] == no_number) follow(border_[i]);
        }
        for (TileLoop& loop : result_.loops) measure(loop);
        count_components();
        find_crossings();
        if (overlaps_.found.count == 0) check_nesting();
        if (overlaps_.found.count == 0) find_gaps();
        result_.overlaps = std::move(overlaps_.found);
        result_.areas_agree = areas_agree();
        return std::move(result_);
    }

private:
    bool is_border(std::uint32_t side) const { return pieces_.twin[side] == no_number; }
    std::uint32_t& loop_of(std::uint32_t side) { return loop_of_[index_of(side)]; }
    std::size_t index_of(std::uint32_t side) const {
        return static_cast<std::size_t>(std::lower_bound(border_.begin(), border_.end(), side) - border_.begin());
    }

    /// The border piece with which the fan of tiles around the end of a border piece begins, anticlockwise.
    std::uint32_t begin_of_fan(std::uint32_t side) const {
        std::uint32_t next = pieces_.next(side);
        while (!is_border(next)) next = pieces_.next(pieces_.twin[next]);
        return next;
    }
    /// Finds, for each border piece, the next one anticlockwise that begins at the same point: the complement lies
    /// between their tiles.
    void find_followers() {
        follower_.assign(border_.size(), no_number);
        for (std::size_t i = 0; i < border_.size(); ++i) {
            pulse_();
            if (follower_[i] != no_number) continue;
            std::uint32_t first = no_number, last = no_number;
            for (const std::uint32_t side : pieces_.out_of(pieces_.from[border_[i]])) {
                if (!is_border(side)) continue;
                if (first == no_number) first = side;
                if (last != no_number) follower_[index_of(last)] = side;
                last = side;
            }
            follower_[index_of(last)] = first;
        }
    }
    void follow(std::uint32_t first) {
        const auto number = static_cast<std::uint32_t>(result_.loops.size());
        const auto begin = static_cast<std::uint32_t>(result_.sides.size());
        double turning = 0;
        for (std::uint32_t side = first; loop_of(side) == no_number;) {
            pulse_();
            loop_of(side) = number;
            result_.sides.push_back(side);
            const std::uint32_t fan = begin_of_fan(side), next = follower_[index_of(fan)];
            turning += opening(side, fan, next) - std::numbers::pi;
            side = next;
        }
        const bool is_outer = turning > 0;
        result_.loops.push_back({begin, static_cast<std::uint32_t>(result_.sides.size()), 0, is_outer});
    }
    /// The angle in radians between the tiles around a point that end with a border piece and those that follow.
    double opening(std::uint32_t side, std::uint32_t fan, std::uint32_t next) const {
        constexpr double turn = 2 * std::numbers::pi;
        const glm::dvec2 along = end(fan) - start(fan);
        const auto turned = [&](glm::dvec2 way) {
            const double angle = std::atan2(determinant(along, way), scalar_product(along, way));
            return angle < 0 ? angle + turn : angle;
        };
        const double room = next == fan ? turn : turned(end(next) - start(next));
        return room - turned(start(side) - end(side));
    }
    glm::dvec2 start(std::uint32_t side) const { return plane_.at(pieces_.from[side]); }
    glm::dvec2 end(std::uint32_t side) const { return plane_.at(pieces_.to(side)); }

    /// Twice the area of a loop and six times the moment about an origin.
    std::pair<double, glm::dvec2> moments(const TileLoop& loop, glm::dvec2 origin) const {
        double twice = 0;
        glm::dvec2 moment(0.0);
        for (std::uint32_t i = loop.begin; i < loop.end; ++i) {
            const glm::dvec2 a = start(result_.sides[i]) - origin, b = end(result_.sides[i]) - origin;
            const double part = determinant(a, b);
            twice += part;
            moment += part * (a + b);
        }
        return {twice, moment};
    }
    void measure(TileLoop& loop) const { loop.area = moments(loop, start(result_.sides[loop.begin])).first / 2; }

    void count_components() {
        UnionFind groups(tiles_.tiles());
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            pulse_();
            for (const std::uint32_t other : neighbours_.of(tile)) {
                if (other < tile) groups.join(tile, other);
            }
        }
        result_.regions = groups.count();
        // Around other points, pieces join all tiles.
        for (std::size_t i = 0; i < border_.size(); ++i) {
            groups.join(pieces_.tile(border_[i]), pieces_.tile(follower_[i]));
        }
        result_.components = groups.count();
        const auto around = std::count_if(result_.loops.begin(), result_.loops.end(),
                                          [](const TileLoop& loop) { return loop.is_outer; });
        result_.loops_agree = static_cast<std::uint64_t>(around) == result_.components;
    }

    /// Pieces meet at corners only, so that they cross only where each has its ends on either side of the other.
    void find_crossings() {
        if (result_.sides.empty()) return;
        Box box;
        for (const std::uint32_t side : result_.sides) box.add(start(side));
        const PlaceGrid grid(box, result_.sides.size());
        CellLists<std::uint32_t> lists(grid.cells());
        const auto visit = [&](std::uint32_t side, auto&& take) {
            pulse_();
            grid.along(start(side), end(side), plane_.tolerance(), take);
        };
        for (const std::uint32_t side : result_.sides) visit(side, [&](std::size_t cell) { lists.count(cell); });
        lists.start();
        for (const std::uint32_t side : result_.sides) {
            if (overlaps_.found.count >= TileViolations::most_counted) return;
            visit(side, [&](std::size_t cell) {
                lists.visit_added(cell, [&](std::uint32_t other) {
                    pulse_();
                    const auto at = crossing(side, other);
                    if (at) overlaps_.add(pieces_.tile(side), pieces_.tile(other), *at);
                });
                lists.add(cell, side);
            });
        }
    }
    std::optional<glm::dvec2> crossing(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t p = pieces_.from[a], q = pieces_.to(a), r = pieces_.from[b], s = pieces_.to(b);
        if (p == r || p == s || q == r || q == s) return std::nullopt;
        const glm::dvec2 from = plane_.at(p), way = plane_.at(q) - from;
        const double first = determinant(way, plane_.at(r) - from), second = determinant(way, plane_.at(s) - from);
        // Both are far away on the same side.
        const double margin = plane_.tolerance() * std::sqrt(scalar_product(way, way));
        if ((first > margin && second > margin) || (first < -margin && second < -margin)) return std::nullopt;
        if (plane_.side(p, q, r) * plane_.side(p, q, s) >= 0) return std::nullopt;
        if (plane_.side(r, s, p) * plane_.side(r, s, q) >= 0) return std::nullopt;
        return plane_.at(r) + (first / (first - second)) * (plane_.at(s) - plane_.at(r));
    }

    /// Beside each loop, the winding number of the other ones must be 0, or 1 within a gap: then no tile covers the
    /// face that the loop bounds. Finds the gap in which each outer loop lies.
    void check_nesting() {
        const std::size_t count = result_.loops.size();
        gap_around_.assign(count, no_number);
        if (count < 2) return;
        // Pieces in levels of about their own height.
        Box box;
        for (const std::uint32_t side : result_.sides) box.add(start(side));
        const double low = box.low.y, high = box.high.y;
        const auto levels = static_cast<std::size_t>(std::sqrt(static_cast<double>(result_.sides.size()))) + 1;
        const double width = std::max((high - low) / static_cast<double>(levels), 1e-12);
        const auto level = [&](double y) {
            return std::min(static_cast<std::size_t>(std::max((y - low) / width, 0.0)), levels - 1);
        };
        CellLists<std::uint32_t> lists(levels);
        const auto visit = [&](std::uint32_t side, auto&& take) {
            const double a = start(side).y, b = end(side).y;
            for (std::size_t i = level(std::min(a, b)); i <= level(std::max(a, b)); ++i) take(i);
        };
        for (const std::uint32_t side : result_.sides) visit(side, [&](std::size_t i) { lists.count(i); });
        lists.start();
        for (const std::uint32_t side : result_.sides) visit(side, [&](std::size_t i) { lists.add(i, side); });
        std::vector<int> windings(count, 0);
        std::vector<std::uint32_t> crossed;
        for (std::uint32_t number = 0; number < count; ++number) {
            const TileLoop& loop = result_.loops[number];
            const std::uint32_t own = result_.sides[loop.begin];
            const glm::dvec2 middle = (start(own) + end(own)) / 2.0;
            int winding = 0;
            crossed.clear();
            lists.visit(level(middle.y), [&](std::uint32_t side) {
                pulse_();
                if (loop_of(side) == number) return;
                const glm::dvec2 a = start(side), b = end(side);
                if ((a.y > middle.y) == (b.y > middle.y)) return;
                // Counts crossings to the left of the middle.
                const int place = side_of_middle(side, own);
                const int step = b.y < a.y && place > 0 ? 1 : b.y > a.y && place < 0 ? -1 : 0;
                winding += step;
                windings[loop_of(side)] += step;
                crossed.push_back(loop_of(side));
            });
            for (const std::uint32_t other : crossed) {
                if (std::exchange(windings[other], 0) >= 0) continue;
                std::uint32_t& nearest = gap_around_[number];
                // The smallest of nested gaps.
                if (nearest == no_number || result_.loops[other].area > result_.loops[nearest].area) nearest = other;
            }
            if (winding == (loop.is_outer ? 0 : 1)) continue;
            const std::uint32_t tile = pieces_.tile(own);
            const std::uint32_t other =
                overlaps_.found.list.size() < TileViolations::most ? tile_around(middle, own) : no_number;
            if (other != no_number) {
                overlaps_.add(tile, other, middle);
            } else {
                overlaps_.found.add({TileFault::overlap, tiles_.number[tile], 0, middle});
            }
        }
    }
    /// 1 if the middle of the piece `own` lies left of a piece, 0 on its line, -1 right of it.
    int side_of_middle(std::uint32_t side, std::uint32_t own) const {
        const glm::dvec2 a = start(side), b = end(side), middle = (start(own) + end(own)) / 2.0;
        const double height = determinant(b - a, middle - a);
        if (!plane_.is_exact() ||
            std::fabs(height) > 1e-9 * (1 + scalar_product(b - a, b - a) + scalar_product(middle - a, middle - a))) {
            return height > 0 ? 1 : height < 0 ? -1 : 0;
        }
        const std::uint32_t from = pieces_.from[side];
        const Cyclotomic::Number along = plane_.way(from, pieces_.to(side)),
                                 second = plane_.way(from, pieces_.to(own));
        Cyclotomic::Number twice = plane_.way(from, pieces_.from[own]);
        for (std::size_t i = 0; i < twice.size(); ++i) twice[i] += second[i];
        return plane_.numbers().sign_imaginary(plane_.numbers().conjugate_product(along, twice));
    }
    /// A tile of another loop that contains a point of the border, or no_number.
    std::uint32_t tile_around(glm::dvec2 at, std::uint32_t side) const {
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            if (tile == pieces_.tile(side)) continue;
            const auto corners = tiles_.corners(tile);
            bool is_inside = false;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const glm::dvec2 a = plane_.at(corners[i]), b = plane_.at(corners[(i + 1) % corners.size()]);
                if ((a.y > at.y) == (b.y > at.y)) continue;
                if ((determinant(b - a, at - a) > 0) == (b.y > a.y)) is_inside = !is_inside;
            }
            if (is_inside) return tile;
        }
        return no_number;
    }

    /// Loops within each gap, without those within other gaps in it, belong to its border.
    void find_gaps() {
        std::vector<std::vector<std::uint32_t>> islands(result_.loops.size());
        for (std::uint32_t loop = 0; loop < result_.loops.size(); ++loop) {
            if (result_.loops[loop].is_outer && gap_around_[loop] != no_number) {
                islands[gap_around_[loop]].push_back(loop);
            }
        }
        for (std::uint32_t loop = 0; loop < result_.loops.size(); ++loop) {
            if (result_.loops[loop].is_outer) continue;
            islands[loop].push_back(loop);
            result_.gaps.push_back(gap_between(islands[loop]));
        }
    }
    TileGap gap_between(const std::vector<std::uint32_t>& loops) {
        const glm::dvec2 origin = start(result_.sides[result_.loops[loops.back()].begin]);
        double twice = 0;
        glm::dvec2 moment(0.0);
        for (const std::uint32_t loop : loops) {
            const auto [part, its_moment] = moments(result_.loops[loop], origin);
            twice += part;
            moment += its_moment;
        }
        TileGap gap{std::fabs(twice) / 2, twice == 0 ? origin : origin + moment / (3 * twice)};
        const auto holds = [&](const std::vector<double>& crossings) {
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
                if (crossings[i] < gap.centre.x && gap.centre.x < crossings[i + 1]) return true;
            }
            return false;
        };
        if (holds(crossings_at(loops, gap.centre.y, true)) && holds(crossings_at(loops, gap.centre.y, false))) {
            return gap;
        }
        // A level between corners, and the middle of the longest part of the gap on it.
        double next = std::numeric_limits<double>::infinity();
        for (const std::uint32_t loop : loops) {
            for (std::uint32_t i = result_.loops[loop].begin; i < result_.loops[loop].end; ++i) {
                const double y = start(result_.sides[i]).y;
                if (y > gap.centre.y) next = std::min(next, y);
            }
        }
        if (next < std::numeric_limits<double>::infinity()) gap.centre.y = (gap.centre.y + next) / 2;
        const std::vector<double> crossings = crossings_at(loops, gap.centre.y, true);
        double longest = 0;
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            if (crossings[i + 1] - crossings[i] <= longest) continue;
            longest = crossings[i + 1] - crossings[i];
            gap.centre.x = (crossings[i] + crossings[i + 1]) / 2;
        }
        return gap;
    }
    /// Where a level, moved up or down infinitesimally, crosses loops: the gap lies between pairs of crossings.
    std::vector<double> crossings_at(const std::vector<std::uint32_t>& loops, double y, bool up) {
        std::vector<double> crossings;
        const auto is_above = [&](glm::dvec2 at) { return up ? at.y > y : at.y >= y; };
        for (const std::uint32_t loop : loops) {
            for (std::uint32_t i = result_.loops[loop].begin; i < result_.loops[loop].end; ++i) {
                pulse_();
                const glm::dvec2 a = start(result_.sides[i]), b = end(result_.sides[i]);
                if (is_above(a) != is_above(b)) crossings.push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
            }
        }
        std::sort(crossings.begin(), crossings.end());
        return crossings;
    }

    bool areas_agree() const {
        if (!plane_.is_exact()) {
            // Tiles of a class differ from the first one by the tolerance along their outlines.
            std::vector<double> outlines;
            for (const TileClass& each : tiles_.classes) {
                double length = 0;
                for (const std::uint32_t vector : each.vectors) {
                    const glm::dvec2 side = plane_.vector_at(vector);
                    length += std::sqrt(scalar_product(side, side));
                }
                outlines.push_back(length);
            }
            double of_tiles = 0, of_loops = 0, length = 0;
            for (const std::uint32_t in_class : tiles_.in_class) {
                of_tiles += tiles_.classes[in_class].area;
                length += outlines[in_class];
            }
            for (const TileLoop& loop : result_.loops) of_loops += loop.area;
            return std::fabs(of_tiles - of_loops) <= 1e-6 * std::fabs(of_tiles) + 2 * plane_.tolerance() * length;
        }
        const Cyclotomic& numbers = plane_.numbers();
        using Wide = std::array<Int128, 8>;
        Wide sum{};
        std::vector<std::uint32_t> counts(tiles_.classes.size(), 0);
        for (const std::uint32_t in_class : tiles_.in_class) ++counts[in_class];
        for (std::size_t in_class = 0; in_class < counts.size(); ++in_class) {
            const Cyclotomic::Number& area = tiles_.classes[in_class].area_4i;
            for (std::size_t i = 0; i < area.size(); ++i) sum[i] += Int128(area[i]) * counts[in_class];
        }
        Wide products{};
        for (const std::uint32_t side : result_.sides) {
            const Cyclotomic::Number product = numbers.conjugate_product(plane_.coordinates(pieces_.from[side]),
                                                                         plane_.coordinates(pieces_.to(side)));
            for (std::size_t i = 0; i < product.size(); ++i) products[i] += product[i];
        }
        const Wide conjugate = numbers.conjugate(products);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            if (products[i] - conjugate[i] != sum[i]) return false;
        }
        return true;
    }

    const TilePlane& plane_;
    const TileSet& tiles_;
    const TilePieces& pieces_;
    const TileNeighbours& neighbours_;
    Pulse pulse_;
    std::vector<std::uint32_t> border_;      // sides without a twin, ascending
    std::vector<std::uint32_t> loop_of_;     // of these
    std::vector<std::uint32_t> follower_;    // of these
    std::vector<std::uint32_t> gap_around_;  // of loops
    TileOverlaps overlaps_;
    TileBorder result_;
};

}  // namespace

TileBorder find_border(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                       const TileNeighbours& neighbours, const Monitor& monitor) {
    return BorderFinder(plane, tiles, pieces, neighbours, monitor).find();
}

}  // namespace sikku
