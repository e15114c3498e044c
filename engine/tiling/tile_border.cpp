#include "engine/tiling/tile_border.h"

#include "engine/base/numbers.h"
#include "engine/tiling/place_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace sikku {
namespace {

class BorderFinder {
public:
    BorderFinder(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces, const Monitor& monitor)
        : plane_(plane), tiles_(tiles), pieces_(pieces), pulse_(monitor), loop_of_(pieces.sides(), no_number) {}

    TileBorder find() {
        for (std::uint32_t side = 0; side < pieces_.sides(); ++side) {
            pulse_();
            if (pieces_.twin[side] == no_number && loop_of_[side] == no_number) follow(side);
        }
        for (TileLoop& loop : result_.loops) {
            measure(loop);
            ++(loop.area > 0 ? result_.regions : result_.gaps);
        }
        find_crossings();
        if (result_.overlap_count == 0) check_nesting();
        result_.areas_agree = areas_agree();
        return std::move(result_);
    }

private:
    /// The next border piece around the tiles that are connected at its end.
    std::uint32_t next_on_border(std::uint32_t side) const {
        std::uint32_t next = pieces_.next(side);
        while (pieces_.twin[next] != no_number) next = pieces_.next(pieces_.twin[next]);
        return next;
    }
    void follow(std::uint32_t first) {
        const auto number = static_cast<std::uint32_t>(result_.loops.size());
        const auto begin = static_cast<std::uint32_t>(result_.sides.size());
        for (std::uint32_t side = first; loop_of_[side] == no_number; side = next_on_border(side)) {
            pulse_();
            loop_of_[side] = number;
            result_.sides.push_back(side);
        }
        result_.loops.push_back({begin, static_cast<std::uint32_t>(result_.sides.size()), 0, glm::dvec2(0.0)});
    }
    glm::dvec2 start(std::uint32_t side) const { return plane_.at(pieces_.from[side]); }
    glm::dvec2 end(std::uint32_t side) const { return plane_.at(pieces_.to(side)); }

    void measure(TileLoop& loop) const {
        const glm::dvec2 origin = start(result_.sides[loop.begin]);
        double twice = 0;
        glm::dvec2 moment(0.0);
        for (std::uint32_t i = loop.begin; i < loop.end; ++i) {
            const glm::dvec2 a = start(result_.sides[i]) - origin, b = end(result_.sides[i]) - origin;
            const double part = determinant(a, b);
            twice += part;
            moment += part * (a + b);
        }
        loop.area = twice / 2;
        loop.centre = twice == 0 ? origin : origin + moment / (3 * twice);
    }

    void overlap(std::uint32_t a, std::uint32_t b, glm::dvec2 at) {
        if (!pairs_.insert(a, b)) return;
        ++result_.overlap_count;
        if (result_.overlaps.size() >= TileViolations::most) return;
        result_.overlaps.push_back(
            {TileFault::overlap, tiles_.number[std::max(a, b)], tiles_.number[std::min(a, b)], at});
    }

    /// Pieces meet at corners only, so that they cross only where each has its ends on either side of the other.
    void find_crossings() {
        if (result_.sides.empty()) return;
        glm::dvec2 low = start(result_.sides.front()), high = low;
        for (const std::uint32_t side : result_.sides) {
            const glm::dvec2 at = start(side);
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        }
        const PlaceGrid grid(low, high, result_.sides.size());
        CellLists<std::uint32_t> lists(grid.cells());
        const auto visit = [&](std::uint32_t side, auto&& take) {
            pulse_();
            grid.along(start(side), end(side), plane_.tolerance(), take);
        };
        for (const std::uint32_t side : result_.sides) visit(side, [&](std::size_t cell) { lists.count(cell); });
        lists.start();
        for (const std::uint32_t side : result_.sides) {
            if (result_.overlap_count >= TileViolations::most_counted) return;
            visit(side, [&](std::size_t cell) {
                lists.visit_added(cell, [&](std::uint32_t other) {
                    pulse_();
                    if (const auto at = crossing(side, other)) overlap(pieces_.tile[side], pieces_.tile[other], *at);
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
        // Both far on the same side?
        const double margin = plane_.tolerance() * std::sqrt(scalar_product(way, way));
        if ((first > margin && second > margin) || (first < -margin && second < -margin)) return std::nullopt;
        if (plane_.side(p, q, r) * plane_.side(p, q, s) >= 0) return std::nullopt;
        if (plane_.side(r, s, p) * plane_.side(r, s, q) >= 0) return std::nullopt;
        return plane_.at(r) + (first / (first - second)) * (plane_.at(s) - plane_.at(r));
    }

    /// Around each region the winding number of the other loops must be 0, around each gap 1.
    void check_nesting() {
        const std::size_t count = result_.loops.size();
        if (count == 1) {
            if (result_.loops.front().area < 0) ++result_.overlap_count;
            return;
        }
        if (count == 0) return;
        // Pieces in levels of about their own height.
        double low = start(result_.sides.front()).y, high = low;
        for (const std::uint32_t side : result_.sides) {
            low = std::min(low, start(side).y);
            high = std::max(high, start(side).y);
        }
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
        for (std::uint32_t number = 0; number < count; ++number) {
            const TileLoop& loop = result_.loops[number];
            const std::uint32_t own = result_.sides[loop.begin];
            const glm::dvec2 middle = (start(own) + end(own)) / 2.0;
            int winding = 0;
            lists.visit(level(middle.y), [&](std::uint32_t side) {
                pulse_();
                if (loop_of_[side] == number) return;
                const glm::dvec2 a = start(side), b = end(side);
                if ((a.y > middle.y) == (b.y > middle.y)) return;
                // To the left of the middle?
                const double place = determinant(b - a, middle - a);
                if (b.y < a.y && place > 0) ++winding;
                if (b.y > a.y && place < 0) --winding;
            });
            if (winding == (loop.area > 0 ? 0 : 1)) continue;
            const std::uint32_t tile = pieces_.tile[own];
            const std::uint32_t other = tile_around(middle, own);
            if (other != no_number) {
                overlap(tile, other, middle);
            } else {
                ++result_.overlap_count;
                result_.overlaps.push_back({TileFault::overlap, tiles_.number[tile], 0, middle});
            }
        }
    }
    /// A tile of another loop that contains a point of the border, or no_number.
    std::uint32_t tile_around(glm::dvec2 at, std::uint32_t side) const {
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            if (tile == pieces_.tile[side]) continue;
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
        for (const std::uint32_t in_class : tiles_.in_class) {
            const Cyclotomic::Number& area = tiles_.classes[in_class].area_4i;
            for (std::size_t i = 0; i < area.size(); ++i) sum[i] += area[i];
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
    Pulse pulse_;
    std::vector<std::uint32_t> loop_of_;  // of sides
    TilePairs pairs_;
    TileBorder result_;
};

}  // namespace

TileBorder find_border(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                       const Monitor& monitor) {
    return BorderFinder(plane, tiles, pieces, monitor).find();
}

}  // namespace sikku
