#include "art/reading/photograph.h"

#include "art/reading/gap_reader.h"
#include "art/reading/kolam_lines.h"
#include "art/reading/picture.h"
#include "art/reading/spots.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Most dots of a photograph: more would be a few pixels apart.
constexpr std::size_t most_dots = 10'000;
/// Dots closer than that are looked for once more in a larger picture.
constexpr double least_spacing = 18;

/// A lattice in a picture, and the appearance of its dots.
struct FoundGrid {
    PlacedGrid placed;
    Homography map;  ///< from the plane of the grid to pixels
    double spacing = 0;
    double dot_radius = 0;  ///< in spacings
    double strength = 0;    ///< strength of most dots
    double angle = 90;
    double score = 0;
    std::size_t left_out = 0;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The same map, from a grid that counts places from elsewhere.
std::optional<Homography> moved(const Homography& map, DotLattice lattice, GridDot origin) {
    std::vector<glm::dvec2> from;
    std::vector<glm::dvec2> to;
    const glm::dvec2 shift = lattice_point(lattice, origin);
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        from.push_back(corner);
        to.push_back(map(corner + shift));
    }
    return Homography::fit(from, to);
}

/// Dots of the lattice: spots on it, and places beside them where a weaker spot is.
std::optional<FoundGrid> grid_of(const std::vector<InkSpot>& spots, const LatticeFit& fit, const SpotFinder& finder,
                                 const Monitor& monitor) {
    using Key = std::pair<std::int32_t, std::int32_t>;
    std::map<Key, InkSpot> dots;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        if (fit.places[i]) dots[{fit.places[i]->x, fit.places[i]->y}] = spots[i];
    }
    if (dots.size() < 2 || dots.size() > most_dots) return std::nullopt;
    std::vector<double> strengths;
    std::vector<double> radii;
    std::vector<double> spacings;
    for (const auto& [place, spot] : dots) {
        strengths.push_back(spot.strength);
        const auto steps = fit.map.derivatives(lattice_point(fit.lattice, {place.first, place.second}));
        const double spacing = 0.5 * (glm::length(steps[0]) + glm::length(steps[1]));
        spacings.push_back(spacing);
        radii.push_back(spot.radius / spacing);
    }
    FoundGrid found{{DotGrid(std::vector<std::uint32_t>{1}), {}},
                    fit.map,
                    median(spacings),
                    median(radii),
                    median(strengths),
                    fit.angle,
                    0,
                    0};

    // The map of a chance lattice may be degenerate.
    if (!(found.spacing < finder.longer_side())) return std::nullopt;

    const std::vector<GridDot> around =
        fit.lattice == DotLattice::square ? std::vector<GridDot>{{2, 0}, {0, 2}, {-2, 0}, {0, -2}}
                                          : std::vector<GridDot>{{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}};
    const auto neighbours = [&](Key place) {
        std::size_t count = 0;
        for (const GridDot way : around) count += dots.contains({place.first + way.x, place.second + way.y});
        return count;
    };
    // Spots that are much weaker or larger than the others, or apart from them, are not dots.
    std::erase_if(dots, [&](const auto& dot) { return dot.second.strength < 0.35 * found.strength; });
    if (dots.size() > 4) {
        std::vector<Key> lonely;
        for (const auto& [place, spot] : dots) {
            if (neighbours(place) == 0) lonely.push_back(place);
        }
        for (const Key& place : lonely) dots.erase(place);
        found.left_out = lonely.size();
    }
    // Places beside dots, again and again, for a dot may be weak and yet be there.
    std::set<Key> tried;
    for (int round = 0; round < 8; ++round) {
        std::map<Key, InkSpot> more;
        for (const auto& [place, spot] : dots) {
            monitor.check();
            for (const GridDot way : around) {
                const Key to{place.first + way.x, place.second + way.y};
                if (dots.contains(to) || tried.contains(to)) continue;
                if (neighbours(to) < (dots.size() < 6 ? 1U : 2U)) continue;
                tried.insert(to);
                const glm::dvec2 at = lattice_point(fit.lattice, {to.first, to.second});
                const auto steps = fit.map.derivatives(at);
                const double spacing = 0.5 * (glm::length(steps[0]) + glm::length(steps[1]));
                const InkSpot near = finder.near(fit.map(at), found.dot_radius * spacing, 0.12 * spacing);
                if (near.strength > 0.35 * found.strength) more[to] = near;
            }
        }
        if (more.empty()) break;
        dots.merge(more);
    }
    if (dots.size() < 2 || dots.size() > most_dots) return std::nullopt;

    std::vector<GridDot> places;
    std::vector<glm::dvec2> from;
    std::vector<glm::dvec2> to;
    double squares = 0;
    for (const auto& [place, spot] : dots) {
        places.push_back({place.first, place.second});
        from.push_back(lattice_point(fit.lattice, places.back()));
        to.push_back(spot.at);
        const auto steps = fit.map.derivatives(from.back());
        const double off = glm::distance(fit.map(from.back()), spot.at) / glm::length(steps[0]);
        squares += off * off;
    }
    const double off = std::sqrt(squares / static_cast<double>(dots.size()));
    if (dots.size() >= 9) {
        if (const auto better = Homography::fit(from, to)) found.map = *better;
    }
    found.placed = place_grid(fit.lattice, std::move(places));
    const auto map = moved(found.map, fit.lattice, found.placed.origin);
    if (!map) return std::nullopt;
    found.map = *map;
    // Dots that touch no other are rare in kolams, and lattices with many holes are accidents.
    const auto count = static_cast<double>(found.placed.grid.dots().size());
    const auto gaps = static_cast<double>(found.placed.grid.gaps().size());
    const double full = fit.lattice == DotLattice::square ? 2 : 3;
    found.score = count * std::min(1.0, gaps / (full * std::max(1.0, count - 1.6 * std::sqrt(count)))) *
                  std::min(1.0, found.strength) * std::max(0.05, 1 - off / 0.12);
    return found;
}

/// The best lattice through the stronger spots.
std::optional<FoundGrid> find_grid(const SpotFinder& finder, const std::vector<InkSpot>& all,
                                   std::optional<DotLattice> lattice, const Monitor& monitor) {
    if (all.size() < 2) return std::nullopt;
    const double high = all[all.size() / 20].strength;
    std::optional<FoundGrid> best;
    std::size_t before = 0;
    for (const double part : {0.75, 0.55, 0.4, 0.28}) {
        const auto end = std::partition_point(all.begin(), all.end(),
                                              [&](const InkSpot& spot) { return spot.strength >= part * high; });
        const auto count = std::min<std::size_t>(static_cast<std::size_t>(end - all.begin()), most_dots);
        if (count == before || count < 2) continue;
        before = count;
        const std::vector<InkSpot> spots(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        std::vector<glm::dvec2> points;
        for (const InkSpot& spot : spots) points.push_back(spot.at);
        const auto fit = fit_lattice(points, true, lattice, monitor);
        if (!fit || fit->fitted < 2) continue;
        auto found = grid_of(spots, *fit, finder, monitor);
        if (!found) continue;
        // Chance finds lattices among many spots, too.
        const double share = static_cast<double>(fit->fitted) / static_cast<double>(count);
        found->score *= 0.4 + 0.6 * share;
        if (!best || found->score > best->score) best = std::move(found);
    }
    return best;
}

/// Share of gaps whose ink agrees badly with all states, as in a picture that is blurred or rough.
double bad_share(const std::vector<GapEvidence>& evidence) {
    const auto bad = std::count_if(evidence.begin(), evidence.end(), [](const GapEvidence& gap) {
        return gap.agreement[static_cast<std::size_t>(gap.best())] < 0.85;
    });
    return static_cast<double>(bad) / static_cast<double>(std::max<std::size_t>(1, evidence.size()));
}

/// Certainty of a gap, calibrated with pictures of known kolams: below one half the best state may be wrong. Strands
/// around interlaced dots come closer to each other; in bad pictures, and where the ink agrees badly, more is needed.
float certainty(const GapEvidence& evidence, DotLattice lattice, double bad) {
    const double best = evidence.agreement[static_cast<std::size_t>(evidence.best())];
    const double sure_margin = (lattice == DotLattice::square ? 0.10 : 0.17) * (1 + 6 * std::min(bad, 0.2)) *
                               (1 + 5 * std::max(0.0, 0.92 - best));
    constexpr double sure_agreement = 0.60;
    return static_cast<float>(
        std::clamp(std::min(evidence.margin() / (2 * sure_margin), best / (2 * sure_agreement)), 0.0, 1.0));
}

struct Reading {
    FoundGrid grid;
    std::vector<GapEvidence> evidence;
    double agreement = 0;         ///< mean of the gaps, with their margins
    std::vector<GridDot> added;   ///< dots that were not seen, but have lines around them
    std::vector<GridDot> unsure;  ///< places beside the grid that might be dots
    bool reaches_edge = false;
    bool has_border = false;  ///< around the kolam, left out
};

void rate(Reading& reading) {
    reading.agreement = 0;
    for (const GapEvidence& gap : reading.evidence) {
        reading.agreement += gap.agreement[static_cast<std::size_t>(gap.best())] + gap.margin();
    }
    reading.agreement /= static_cast<double>(std::max<std::size_t>(1, reading.evidence.size()));
}

bool is_inside(const GreyPicture& picture, glm::dvec2 at) {
    return at.x >= 0 && at.y >= 0 && at.x < static_cast<double>(picture.width) &&
           at.y < static_cast<double>(picture.height);
}

/// True if the edge cuts the loop around a dot, or if there is ink where the way to the next place leaves the
/// picture.
class EdgeCheck {
public:
    EdgeCheck(const GreyPicture& ink, const FoundGrid& found) : ink_(ink), found_(found) {
        std::vector<double> dots;
        for (const GridDot dot : grid().dots())
            dots.push_back(ink.at(found.map(lattice_point(grid().lattice(), dot))));
        least_ = 0.5 * median(std::move(dots));
    }
    /// Whether the kolam seems to continue outside of the picture.
    bool reaches_edge() const {
        std::size_t ways = 0;
        std::size_t lines = 0;
        for (const GridDot dot : grid().dots()) {
            const glm::dvec2 from = lattice_point(grid().lattice(), dot);
            for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                const GridDot way = grid().step(side);
                const GridDot to{dot.x + way.x, dot.y + way.y};
                const glm::dvec2 along = lattice_point(grid().lattice(), way);
                if (grid().dot_at(to) || is_inside(ink_, found_.map(from + along))) continue;
                constexpr double loop = 0.35;
                const double leaves = leaves_at(from, along);
                if (leaves < loop) return true;
                ++ways;
                lines += has_line(from, along, leaves);
            }
        }
        return lines > 0 && 6 * lines >= ways;
    }

private:
    const DotGrid& grid() const { return found_.placed.grid; }
    /// The part of the way that lies in the picture.
    double leaves_at(glm::dvec2 from, glm::dvec2 along) const {
        double part = 0;
        while (part < 1 && is_inside(ink_, found_.map(from + part * along))) part += 0.02;
        return part;
    }
    bool has_line(glm::dvec2 from, glm::dvec2 along, double leaves) const {
        constexpr double beyond_loops = 0.56;
        const glm::dvec2 aside(-along.y, along.x);
        std::size_t inked = 0;
        for (double part = std::max(beyond_loops, leaves - 0.12); part < leaves - 0.02; part += 0.02) {
            for (double off = -0.4; off <= 0.4; off += 0.02) {
                const glm::dvec2 at = found_.map(from + part * along + off * aside);
                inked += is_inside(ink_, at) && ink_.at(at) > least_;
            }
        }
        return inked > 3;
    }
    const GreyPicture& ink_;
    const FoundGrid& found_;
    double least_;
};

/// Removes places outside of the box of a grid if they lie on all of its sides, as the ornaments of a border do.
/// @return whether there were any
bool remove_border(const DotGrid& grid, std::vector<GridDot>& added, std::vector<GridDot>& unsure) {
    const auto [left, right] =
        std::minmax_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.x < b.x; });
    const auto [below, above] =
        std::minmax_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.y < b.y; });
    const GridDot low{left->x, below->y};
    const GridDot high{right->x, above->y};
    std::array<bool, 4> sides{};
    for (const auto* places : {&added, &unsure}) {
        for (const GridDot place : *places) {
            sides[0] = sides[0] || place.x < low.x;
            sides[1] = sides[1] || place.x > high.x;
            sides[2] = sides[2] || place.y < low.y;
            sides[3] = sides[3] || place.y > high.y;
        }
    }
    if (!std::all_of(sides.begin(), sides.end(), [](bool has) { return has; })) return false;
    for (auto* places : {&added, &unsure}) {
        std::erase_if(*places, [&](GridDot place) {
            return place.x < low.x || place.x > high.x || place.y < low.y || place.y > high.y;
        });
    }
    return true;
}

/// Adds places beside the grid that have lines around them although no dot was seen there: of all their gaps to dots,
/// both strands are there. @return whether there were any
bool add_encircled(const GreyPicture& smooth, Reading& reading, const Monitor& monitor) {
    constexpr double sure = 0.84;
    constexpr double sure_alone = 0.88;
    const DotGrid& grid = reading.grid.placed.grid;
    const DotLattice lattice = grid.lattice();
    std::vector<GridDot> places = grid.dots();
    for (const GridDot dot : grid.dots()) {
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            const GridDot way = grid.step(side);
            const GridDot to{dot.x + way.x, dot.y + way.y};
            if (!grid.dot_at(to) && is_inside(smooth, reading.grid.map(lattice_point(lattice, to))))
                places.push_back(to);
        }
    }
    if (places.size() == grid.dots().size()) return false;
    const PlacedGrid wider = place_grid(lattice, std::move(places));
    const auto map = moved(reading.grid.map, lattice, wider.origin);
    if (!map) return false;
    const auto evidence = read_gap_evidence(smooth, wider.grid, *map, reading.grid.dot_radius, monitor);
    std::vector<GridDot> added;
    reading.unsure.clear();
    for (const GridDot place : wider.grid.dots()) {
        const GridDot here{place.x + wider.origin.x, place.y + wider.origin.y};
        if (grid.dot_at(here)) continue;
        std::size_t gaps = 0;
        std::size_t good = 0;
        double least = 1;
        double sum = 0;
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            const GridDot way = grid.step(side);
            if (!grid.dot_at({here.x + way.x, here.y + way.y})) continue;
            const std::int32_t gap = wider.grid.gap(*wider.grid.dot_at(place), side);
            const GapEvidence& found = evidence[static_cast<std::size_t>(gap)];
            const double agreement = found.agreement[static_cast<std::size_t>(found.best())];
            ++gaps;
            good += agreement >= sure;
            least = std::min(least, agreement);
            sum += agreement;
        }
        if (good == gaps && (gaps > 1 || least >= sure_alone)) {
            added.push_back(here);
        } else if (sum > 0.79 * static_cast<double>(gaps)) {
            reading.unsure.push_back(here);
        }
    }
    if (remove_border(grid, added, reading.unsure)) reading.has_border = true;
    if (added.empty()) return false;
    std::vector<GridDot> all = grid.dots();
    all.insert(all.end(), added.begin(), added.end());
    const PlacedGrid placed = place_grid(lattice, std::move(all));
    const auto placed_map = moved(reading.grid.map, lattice, placed.origin);
    if (!placed_map) return false;
    for (GridDot& dot : reading.added) dot = {dot.x - placed.origin.x, dot.y - placed.origin.y};
    for (const GridDot dot : added) reading.added.push_back({dot.x - placed.origin.x, dot.y - placed.origin.y});
    reading.grid.placed = placed;
    reading.grid.map = *placed_map;
    return true;
}

/// Whether most gaps of the dots in an outer row or column agree with no state.
bool is_bad_side(const Reading& reading, const std::function<bool(GridDot)>& is_outer) {
    const DotGrid& grid = reading.grid.placed.grid;
    std::size_t gaps = 0;
    std::size_t bad = 0;
    for (std::size_t i = 0; i < reading.evidence.size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        if (!is_outer(grid.dots()[gap.from]) && !is_outer(grid.dots()[gap.to])) continue;
        const GapEvidence& found = reading.evidence[i];
        ++gaps;
        bad += found.agreement[static_cast<std::size_t>(found.best())] < 0.85;
    }
    return 5 * bad > 3 * gaps;
}

/// Takes off the outer rows and columns of a grid that agree with no kolam on three sides at least: ornaments of a
/// border that look like dots. @return nothing if there are none
std::optional<FoundGrid> without_border(const Reading& reading) {
    const DotGrid& grid = reading.grid.placed.grid;
    const auto [left, right] =
        std::minmax_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.x < b.x; });
    const auto [below, above] =
        std::minmax_element(grid.dots().begin(), grid.dots().end(), [](GridDot a, GridDot b) { return a.y < b.y; });
    const std::array<std::function<bool(GridDot)>, 4> sides = {
        [x = left->x](GridDot dot) { return dot.x == x; }, [x = right->x](GridDot dot) { return dot.x == x; },
        [y = below->y](GridDot dot) { return dot.y == y; }, [y = above->y](GridDot dot) { return dot.y == y; }};
    std::vector<const std::function<bool(GridDot)>*> bad;
    for (const auto& side : sides) {
        if (is_bad_side(reading, side)) bad.push_back(&side);
    }
    if (bad.size() < 3) return std::nullopt;
    std::vector<GridDot> kept = grid.dots();
    std::erase_if(kept, [&](GridDot dot) {
        return std::any_of(bad.begin(), bad.end(), [&](const auto* side) { return (*side)(dot); });
    });
    if (kept.size() < 4) return std::nullopt;
    FoundGrid inner = reading.grid;
    inner.placed = place_grid(grid.lattice(), std::move(kept));
    const auto map = moved(reading.grid.map, grid.lattice(), inner.placed.origin);
    if (!map) return std::nullopt;
    inner.map = *map;
    return inner;
}

Reading read_states(const GreyPicture& ink, FoundGrid grid, const Monitor& monitor) {
    const GreyPicture smooth = blurred(ink, 0.018 * grid.spacing);
    Reading reading{std::move(grid), {}, 0, {}, {}, false, false};
    for (int round = 0; round < 4 && add_encircled(smooth, reading, monitor); ++round) {
    }
    reading.evidence =
        read_gap_evidence(smooth, reading.grid.placed.grid, reading.grid.map, reading.grid.dot_radius, monitor);
    rate(reading);
    for (int round = 0; round < 2; ++round) {
        auto inner = without_border(reading);
        if (!inner) break;
        Reading within{std::move(*inner), {}, 0, {}, {}, false, true};
        within.evidence =
            read_gap_evidence(smooth, within.grid.placed.grid, within.grid.map, within.grid.dot_radius, monitor);
        rate(within);
        if (within.agreement <= reading.agreement) break;
        reading = std::move(within);
    }
    reading.reaches_edge = EdgeCheck(smooth, reading.grid).reaches_edge();
    return reading;
}

/// The ink of a picture and the spots in it.
struct InkSpots {
    GreyPicture ink;
    SpotFinder finder;
    bool is_dark;
    std::vector<InkSpot> spots = {};

    InkSpots(Ink found, const Monitor& monitor)
        : ink(std::move(found.values)), finder(ink, monitor), is_dark(true), spots(finder.find(monitor)) {
        if (!found.is_dark) negate(monitor);
    }
    void negate(const Monitor& monitor) {
        for (float& value : ink.values) value = -value;
        finder.negate();
        is_dark = !is_dark;
        spots = finder.find(monitor);
    }
    /// Spots everywhere, as in noise.
    bool is_rough() const { return spots.size() >= SpotFinder::most_spots; }
};

/// True for a lattice whose inside is empty, as of the dots of a border.
bool is_hollow(const FoundGrid& found) {
    const auto count = static_cast<double>(found.placed.grid.dots().size());
    const auto gaps = static_cast<double>(found.placed.grid.gaps().size());
    const double full = found.placed.grid.lattice() == DotLattice::square ? 2 : 3;
    return count >= 16 && gaps < 0.75 * full * (count - 1.6 * std::sqrt(count));
}

/// Reads the kolam within a border of dots, if there is one that agrees better.
std::optional<Reading> read_inside(const InkSpots& ink, const Reading& border, std::optional<DotLattice> lattice,
                                   const Monitor& monitor) {
    const FoundGrid& found = border.grid;
    std::vector<glm::dvec2> dots;
    glm::dvec2 low(1e300);
    glm::dvec2 high(-1e300);
    for (const GridDot dot : found.placed.grid.dots()) {
        dots.push_back(found.map(lattice_point(found.placed.grid.lattice(), dot)));
        low = glm::min(low, dots.back());
        high = glm::max(high, dots.back());
    }
    std::vector<InkSpot> inside;
    for (const InkSpot& spot : ink.spots) {
        const bool is_in = spot.at.x > low.x && spot.at.y > low.y && spot.at.x < high.x && spot.at.y < high.y;
        const bool is_of_border = std::any_of(dots.begin(), dots.end(), [&](glm::dvec2 dot) {
            return glm::distance(dot, spot.at) < 0.6 * found.spacing;
        });
        if (is_in && !is_of_border) inside.push_back(spot);
    }
    auto again = find_grid(ink.finder, inside, lattice, monitor);
    if (!again || again->placed.grid.dots().size() < 4) return std::nullopt;
    Reading reading = read_states(ink.ink, std::move(*again), monitor);
    if (reading.agreement <= border.agreement) return std::nullopt;
    reading.has_border = true;
    return reading;
}

/// Reads the ink; where the angle of the lattice does not decide, the one whose gaps agree better.
std::optional<Reading> read_ink(const InkSpots& ink, std::optional<DotLattice> lattice, const Monitor& monitor) {
    if (ink.is_rough()) return std::nullopt;
    auto found = find_grid(ink.finder, ink.spots, lattice, monitor);
    if (!found) return std::nullopt;
    const double angle = found->angle;
    const DotLattice first = found->placed.grid.lattice();
    Reading reading = read_states(ink.ink, std::move(*found), monitor);
    if (is_hollow(reading.grid)) {
        if (auto kolam = read_inside(ink, reading, lattice, monitor)) return kolam;
    }
    if (!lattice && angle > 64 && angle < 84) {
        const DotLattice other = first == DotLattice::square ? DotLattice::triangular : DotLattice::square;
        if (auto again = find_grid(ink.finder, ink.spots, other, monitor)) {
            Reading second = read_states(ink.ink, std::move(*again), monitor);
            if (second.agreement > reading.agreement + 0.3 &&
                2 * second.grid.placed.grid.dots().size() > reading.grid.placed.grid.dots().size()) {
                return second;
            }
        }
    }
    return reading;
}

/// Refuses a picture of something else: in kolams, even in bad pictures, most gaps are certain.
void refuse_unreadable(const ReadKolam& kolam) {
    const std::size_t doubts = kolam.doubtful().size();
    if (5 * doubts <= 3 * kolam.states.size()) return;
    throw std::runtime_error(fmt::format("no kolam found: {} of {} between the dots cannot be read", doubts,
                                         counted(kolam.states.size(), "gap")));
}

/// Makes the gaps of a dot doubtful.
void doubt_around(ReadKolam& kolam, std::uint32_t dot) {
    for (std::uint32_t side = 0; side < kolam.grid.sides(); ++side) {
        const std::int32_t gap = kolam.grid.gap(dot, side);
        if (gap < 0) continue;
        float& certainty = kolam.certainty[static_cast<std::size_t>(gap)];
        certainty = std::min(certainty, 0.9F * ReadKolam::doubtful_below);
    }
}

}  // namespace

Photograph read_photograph(const std::filesystem::path& path, const PhotographOptions& options,
                           const Monitor& monitor) {
    return read_photograph(
        [&](int longest_side) { return read_picture(path, longest_side, options.most_pixels, monitor); }, options,
        monitor);
}

Photograph read_photograph(const PictureDecoder& decode, const PhotographOptions& options, const Monitor& monitor) {
    std::optional<Reading> best;
    DecodedPicture picture;
    bool is_dark = true;
    bool is_rough = false;
    for (const int side : {1500, 4000}) {
        picture = decode(side);
        if (std::min(picture.width, picture.height) < 16) throw std::runtime_error("the picture is too small");
        InkSpots ink(find_ink(picture, monitor), monitor);
        is_dark = ink.is_dark;
        best = read_ink(ink, options.lattice, monitor);
        is_rough = ink.is_rough();
        if (!best || best->agreement < 0.85) {
            // The other way round, as where the ground has a pattern.
            ink.negate(monitor);
            is_rough = is_rough && ink.is_rough();
            auto other = read_ink(ink, options.lattice, monitor);
            if (other && (!best || other->agreement > best->agreement + 0.1)) {
                best = std::move(other);
                is_dark = ink.is_dark;
            }
        }
        const bool is_smaller = picture.width < picture.file_width;
        if (!is_smaller || is_rough || (best && best->grid.spacing >= least_spacing)) break;
    }
    if (!best && is_rough) throw std::runtime_error("no kolam found: too many spots to be the dots of a kolam");
    if (!best) throw std::runtime_error("no kolam found: the picture has no lattice of dots");
    FoundGrid& grid = best->grid;
    if (grid.placed.grid.dots().size() < 4 || (best->agreement < 0.75 && !best->evidence.empty())) {
        throw std::runtime_error("no kolam found: too few dots, or no lines around them");
    }

    ReadKolam kolam{
        grid.placed.grid, GapStates(best->evidence.size()), std::vector<float>(best->evidence.size()), {}, {}, {}};
    const double bad = bad_share(best->evidence);
    for (std::size_t i = 0; i < best->evidence.size(); ++i) {
        kolam.states[i] = best->evidence[i].best();
        kolam.certainty[i] = certainty(best->evidence[i], grid.placed.grid.lattice(), bad);
    }
    if (best->reaches_edge) {
        kolam.notes.emplace_back(
            "the kolam seems to continue outside of the picture: dots and lines there are missing");
    }
    if (best->has_border) kolam.notes.emplace_back("a border around the kolam was left out");
    if (!best->added.empty()) {
        kolam.notes.push_back(
            fmt::format("{} without a visible dot taken for a dot, because lines run around it",
                        best->added.size() == 1 ? "1 place was" : fmt::format("{} places were", best->added.size())));
        for (const GridDot place : best->added) {
            if (const auto dot = kolam.grid.dot_at(place)) doubt_around(kolam, *dot);
        }
    }
    for (const GridDot place : best->unsure) {
        for (std::uint32_t side = 0; side < kolam.grid.sides(); ++side) {
            const GridDot way = kolam.grid.step(side);
            if (const auto dot = kolam.grid.dot_at({place.x + way.x, place.y + way.y})) doubt_around(kolam, *dot);
        }
    }
    if (!best->unsure.empty()) {
        kolam.notes.push_back(fmt::format("{} beside the grid may have a dot that was not seen",
                                          counted(best->unsure.size(), "place")));
    }
    kolam.notes.push_back(fmt::format("{} lines on {} ground, dots {:.0f} pixels apart in a picture of {} x {}",
                                      is_dark ? "dark" : "light", is_dark ? "light" : "dark", grid.spacing,
                                      picture.width, picture.height));
    if (grid.angle > 66 && grid.angle < 82 && !options.lattice) {
        kolam.notes.push_back(
            fmt::format("rows of dots meet at {:.0f} degrees: the grid was read as {}", grid.angle,
                        grid.placed.grid.lattice() == DotLattice::square ? "square" : "interlaced"));
    }
    refuse_unreadable(kolam);
    if (options.repair) repair_by_symmetry(kolam);
    return {std::move(kolam), std::move(picture), grid.map};
}

}  // namespace sikku
