#include "engine/tiling/tile_periods.h"

#include "engine/geometry/box.h"
#include "engine/tiling/tile_anchors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sikku {
namespace {

constexpr int most_multiples = 1000;
constexpr double rounding = 1e-7;  // rounding error of a multiple

class PeriodFinder {
public:
    PeriodFinder(const TilingPatch& patch, std::span<const std::uint32_t> kinds, const Monitor& monitor)
        : plane_(patch.plane),
          tiles_(patch.tiles),
          pieces_(patch.pieces),
          neighbours_(patch.neighbours),
          kinds_(kinds),
          monitor_(monitor),
          pulse_(monitor) {
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            placed_.add(tiles_.in_class[tile], anchor(tile));
        }
        for (std::uint32_t side = 0; side < pieces_.sides(); ++side) {
            if (pieces_.twin[side] == no_number) border_.push_back(side);
        }
    }

    TilePeriods find() {
        find_middle();
        result_.reach = result_.radius / 3;
        for (const auto& [length, tile] : candidates()) {
            const glm::dvec2 way = plane_.at(anchor(tile)) - plane_.at(anchor(result_.middle));
            if (result_.count == 1) {
                const glm::dvec2 first = result_.vectors[0];
                if (std::fabs(determinant(first, way)) < 1e-9 * glm::length(first) * glm::length(way)) continue;
            }
            monitor_.check();
            const std::uint64_t compared = count_images(tile);
            if (compared == 0) continue;
            const auto number = static_cast<std::size_t>(result_.count++);
            result_.compared = number == 0 ? compared : std::min(result_.compared, compared);
            result_.vectors[number] = way;
            if (plane_.is_exact()) result_.exact[number] = exact_way(tile);
            if (result_.count == 2) break;
        }
        return result_;
    }

private:
    std::uint32_t anchor(std::uint32_t tile) const { return tiles_.corner[tiles_.begin[tile]]; }

    /// Finds the tile farthest from the border, from there inwards.
    void find_middle() {
        std::vector<char> is_reached(tiles_.tiles(), 0);
        std::vector<std::uint32_t> reached;
        const auto reach = [&](std::uint32_t tile) {
            if (is_reached[tile]) return;
            is_reached[tile] = 1;
            reached.push_back(tile);
        };
        for (const std::uint32_t side : border_) reach(pieces_.tile(side));
        is_inner_.assign(tiles_.tiles(), 1);
        for (const std::uint32_t tile : reached) is_inner_[tile] = 0;
        for (std::size_t next = 0; next < reached.size();) {
            pulse_();
            for (const std::uint32_t other : neighbours_.of(reached[next++])) reach(other);
        }
        if (!reached.empty()) result_.middle = reached.back();
        const glm::dvec2 at = plane_.at(anchor(result_.middle));
        double least = std::numeric_limits<double>::max();
        for (const std::uint32_t side : border_) {
            const glm::dvec2 from = plane_.at(pieces_.from[side]) - at, to = plane_.at(pieces_.to(side)) - at;
            const glm::dvec2 along = to - from;
            const double share = std::clamp(-scalar_product(from, along) / scalar_product(along, along), 0.0, 1.0);
            least = std::min(least, glm::length(from + share * along));
        }
        result_.radius = border_.empty() ? 0 : least;
    }

    /// Tiles of the kind of the middle one that lie above it or on its right, with their rounded distances, the
    /// nearest first.
    std::vector<std::pair<double, std::uint32_t>> candidates() const {
        const glm::dvec2 at = plane_.at(anchor(result_.middle));
        std::vector<std::pair<double, std::uint32_t>> found;
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            if (tile == result_.middle || !is_alike(tile, result_.middle)) continue;
            const glm::dvec2 way = plane_.at(anchor(tile)) - at;
            const bool is_level = std::fabs(way.y) < plane_.tolerance();
            const double length = glm::length(way);
            if (is_level ? way.x < 0 : way.y < 0) continue;
            // Equal lengths are in the order of tiles.
            if (length <= result_.reach) found.emplace_back(std::round(length * 1e6), tile);
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    bool is_alike(std::uint32_t a, std::uint32_t b) const {
        return tiles_.in_class[a] == tiles_.in_class[b] && kinds_[a] == kinds_[b];
    }

    Cyclotomic::Number exact_way(std::uint32_t tile) const {
        return plane_.way(anchor(result_.middle), anchor(tile));
    }

    /// The tile that a translation maps a tile onto, or no_number.
    std::uint32_t image(std::uint32_t tile, const Cyclotomic::Number& exact, glm::dvec2 way) const {
        Cyclotomic::Number at{};
        if (plane_.is_exact()) {
            at = plane_.coordinates(anchor(tile));
            for (std::size_t i = 0; i < at.size(); ++i) at[i] += exact[i];
        }
        const std::uint32_t point = plane_.find(at, plane_.at(anchor(tile)) + way);
        if (point == no_number) return no_number;
        const std::uint32_t found = placed_.find(tiles_.in_class[tile], point);
        return found == no_number || !is_alike(tile, found) ? no_number : found;
    }

    /// The number of tiles with an image under the translation from the middle tile to another; 0 if it fails.
    std::uint64_t count_images(std::uint32_t to) {
        const glm::dvec2 way = plane_.at(anchor(to)) - plane_.at(anchor(result_.middle));
        const Cyclotomic::Number exact = plane_.is_exact() ? exact_way(to) : Cyclotomic::Number{};
        std::vector<char> is_reached(tiles_.tiles(), 0);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> mapped = {{result_.middle, to}};
        is_reached[result_.middle] = 1;
        for (std::size_t i = 0; i < mapped.size(); ++i) {
            const auto [tile, its_image] = mapped[i];
            for (const std::uint32_t other : neighbours_.of(tile)) {
                pulse_();
                if (is_reached[other]) continue;
                const std::uint32_t found = image(other, exact, way);
                if (found != no_number) {
                    is_reached[other] = 1;
                    mapped.emplace_back(other, found);
                } else if (is_inner_[its_image]) {
                    return 0;
                }
            }
        }
        return mapped.size();
    }

    const TilePlane& plane_;
    const TileSet& tiles_;
    const TilePieces& pieces_;
    const TileNeighbours& neighbours_;
    std::span<const std::uint32_t> kinds_;
    const Monitor& monitor_;
    Pulse pulse_;
    TileAnchors placed_;
    std::vector<std::uint32_t> border_;  // sides without a twin
    std::vector<char> is_inner_;         // tiles without such sides
    TilePeriods result_;
};

/// The shortest vector m a + n b, m > 0 or n = 1, that is perpendicular to another; nullopt if there is none.
std::optional<glm::dvec2> perpendicular(glm::dvec2 a, glm::dvec2 b, glm::dvec2 to) {
    const double along_a = scalar_product(a, to), along_b = scalar_product(b, to);
    const double size = std::sqrt(scalar_product(to, to));
    if (std::fabs(along_b) <= rounding * size * std::sqrt(scalar_product(b, b))) return b;
    for (int m = 1; m <= most_multiples; ++m) {
        const double n = -m * along_a / along_b;
        if (std::fabs(n) <= most_multiples && std::fabs(n - std::round(n)) <= rounding) {
            return static_cast<double>(m) * a + std::round(n) * b;
        }
    }
    return std::nullopt;
}

}  // namespace

TilePeriods find_periods(const TilingPatch& patch, std::span<const std::uint32_t> kinds, const Monitor& monitor) {
    if (patch.tiles.tiles() == 0) return {};
    return PeriodFinder(patch, kinds, monitor).find();
}

std::optional<LatticeRectangle> upright_rectangle(glm::dvec2 a, glm::dvec2 b) {
    const auto across = perpendicular(a, b, {0, 1}), up = perpendicular(a, b, {1, 0});
    if (!across || !up) return std::nullopt;
    return LatticeRectangle{{std::fabs(across->x), 0}, {0, std::fabs(up->y)}};
}

std::optional<LatticeRectangle> least_rectangle(glm::dvec2 a, glm::dvec2 b) {
    constexpr int most = 24;
    std::optional<LatticeRectangle> least;
    for (int m = 0; m <= most; ++m) {
        for (int n = m == 0 ? 1 : -most; n <= most; ++n) {
            if (std::gcd(m, n) != 1) continue;
            glm::dvec2 across = static_cast<double>(m) * a + static_cast<double>(n) * b;
            const auto found = perpendicular(a, b, across);
            if (!found) continue;
            // To the right, within 45 degrees of the axis.
            glm::dvec2 up = *found;
            if (std::fabs(across.y) > std::fabs(across.x) * (1 + rounding)) std::swap(across, up);
            if (across.x < 0) across = -across;
            if (determinant(across, up) < 0) up = -up;
            const LatticeRectangle rectangle{across, up};
            const bool is_smaller = !least || rectangle.area() < least->area() * (1 - rounding);
            const bool is_as_large = least && rectangle.area() < least->area() * (1 + rounding);
            const auto slope = [](const LatticeRectangle& each) { return std::fabs(each.across.y / each.across.x); };
            if (is_smaller || (is_as_large && slope(rectangle) < slope(*least) - rounding)) least = rectangle;
        }
    }
    return least;
}

}  // namespace sikku
