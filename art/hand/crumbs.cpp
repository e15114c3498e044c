#include "art/hand/crumbs.h"

#include "art/hand/hand_noise.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr double for_width = 7, at_beginning = 16;  // number for each width of the line, at full strength
constexpr double most_of_node = 100;
constexpr double around_dot = 22;                             // number at full strength
constexpr double scatter = 0.24;                              // scale of the distance from the edge, in widths
constexpr double farthest = 2.2;                              // widths
constexpr double room_share = 0.42;                           // share of the gap to the next line
constexpr double crumb_radius = 0.014, crumb_spread = 0.075;  // widths

/// Chances of one node or dot, in [0, 1).
class Draws {
public:
    explicit Draws(std::uint64_t seed) : chance_(seed) {}
    double next() { return chance_.fraction(); }
    /// A whole number with a mean of `mean`.
    int count(double mean) { return static_cast<int>(std::floor(std::min(mean, most_of_node) + next())); }
    /// Distance from the edge in widths: the density falls with its third power.
    double distance() { return scatter * (1 / std::sqrt(std::max(1 - next(), 1e-9)) - 1); }
    /// Radius in widths: most crumbs are small.
    double radius() {
        const double chance = next();
        return crumb_radius + crumb_spread * chance * chance * chance;
    }

private:
    SplitMix chance_;
};

std::uint64_t seed_of(const HandOptions& options, std::uint64_t kind, std::uint64_t line, std::uint64_t place) {
    return scrambled(scrambled(scrambled(options.seed + kind) + line) + place);
}

}  // namespace

std::vector<HandCrumb> crumbs_beside(const HandLine& line, double least, const HandOptions& options) {
    std::vector<HandCrumb> crumbs;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const HandNode &node = line.nodes[i], &next = line.nodes[i + 1];
        const double width = 2 * node.half;
        if (!(width > 0)) continue;
        Draws draws(seed_of(options, 0x6372756d, line.number, i));
        const double more = for_width * node.flow + at_beginning * node.fresh;
        const glm::dvec2 way = hand_unit_direction(line, i), side(-way.y, way.x);
        for (int left = draws.count(options.strength * more * line.step(i) / width); left > 0; --left) {
            const double sign = draws.next() < 0.5 ? -1 : 1, share = draws.next();
            const double distance = draws.distance(), radius = draws.radius() * width;
            if (radius < least || distance > farthest || distance * width + radius > room_share * node.room) continue;
            const glm::dvec2 middle = node.at + share * (next.at - node.at);
            crumbs.push_back({middle + sign * (node.half + distance * width) * side, radius});
        }
    }
    return crumbs;
}

std::vector<HandCrumb> crumbs_around(const HandDot& dot, std::uint64_t number, double least,
                                     const HandOptions& options) {
    std::vector<HandCrumb> crumbs;
    Draws draws(seed_of(options, 0x63646f74, 0, number));
    for (int left = draws.count(options.strength * around_dot); left > 0; --left) {
        const glm::dvec2 way(2 * draws.next() - 1, 2 * draws.next() - 1);
        const double distance = draws.distance(), radius = draws.radius() * 2 * dot.radius;
        const double length = std::sqrt(way.x * way.x + way.y * way.y);
        if (radius < least || !(length > 0.1) || length > 1 || distance > farthest / 2) continue;
        crumbs.push_back({dot.at + way * (dot.radius * (1 + 2 * distance) / length), radius});
    }
    return crumbs;
}

}  // namespace sikku
