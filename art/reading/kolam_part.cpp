#include "art/reading/kolam_part.h"

#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sikku {
namespace {

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
/// True for dots in single rows, such as those of a border.
bool is_narrow_grid(const DotGrid& grid) {
    return 6 * grid.gaps().size() < 7 * grid.dots().size();
}

/// Least agreement of lines whose kolam could be an accident: the crossings between dots make coarser lattices, and
/// the ornaments of borders their own, whose gaps agree with no state.
constexpr double least_agreement = 1.12;

/// The ratio of the shortest to the longest image of a unit step, in the middle of a grid: 1 as seen from above, and
/// the sine of the angle at which one looks along the ground otherwise.
double foreshortening(const FoundGrid& found) {
    glm::dvec2 middle(0.0);
    for (const GridDot dot : found.grid().dots()) middle += lattice_point(found.grid().lattice(), dot);
    const auto [x, y] = found.map.derivatives(middle / static_cast<double>(found.grid().dots().size()));
    const double squares = glm::dot(x, x) + glm::dot(y, y);
    const double area = x.x * y.y - x.y * y.x;
    const double difference = std::sqrt(std::max(0.0, squares * squares - 4 * area * area));
    return std::sqrt(std::max(0.0, squares - difference) / (squares + difference));
}

/// The reason why dots with lines between them are not a kolam, or cannot be read; empty if they can.
std::string refusal_of_joined(const LineReading& reading, const ReadKolam& kolam) {
    const std::size_t dots = kolam.grid.dots().size();
    const std::size_t gaps = kolam.states.size();
    const std::size_t doubts = kolam.doubtful().size();
    if (dots < least_kolam_dots) return fmt::format("only {} of a lattice", counted(dots, "dot"));
    // Chance finds such lattices among the spots of textures.
    if (constexpr double flattest = 0.25; foreshortening(reading.grid) < flattest) {
        return fmt::format("{} on a lattice, but it is too flat for a kolam", counted(dots, "dot"));
    }
    if (2 * doubts > gaps) {
        return fmt::format("{} on a lattice, but {} of {} between them cannot be read", counted(dots, "dot"), doubts,
                           counted(gaps, "gap"));
    }
    if (reading.explained < 0.6) {
        return fmt::format("{} on a lattice, but lines around them explain only {:.0f} % of the ink there",
                           counted(dots, "dot"), 100 * reading.explained);
    }
    if (2 * reading.joined < dots) {
        return fmt::format("{} on a lattice, but lines lead to only {} of them from another", counted(dots, "dot"),
                           reading.joined);
    }
    if (std::count(kolam.states.begin(), kolam.states.end(), GapState::crossed) == 0) {
        return fmt::format("{} on a lattice, but lines cross between none of them", counted(dots, "dot"));
    }
    if (is_narrow_grid(kolam.grid) && reading.agreement < least_agreement) {
        return fmt::format("{} in single rows, but the lines around them agree with no kolam", counted(dots, "dot"));
    }
    return "";
}

/// The reason why a reading is not a kolam, or cannot be read; empty if it can.
std::string refusal_of(const LineReading& reading, const ReadKolam& kolam) {
    std::string refusal = refusal_of_joined(reading, kolam);
    const std::size_t joined = kolam.grid.dots().size();
    const std::size_t dots = joined + reading.left_out;
    // Kolams that the edge of the picture cuts off leave a few dots on the lattice of their neighbour.
    const bool is_most = 2 * joined >= reading.left_out;
    if ((refusal.empty() && is_most) || dots < least_kolam_dots) return refusal;
    const bool is_without_lines = reading.explained == 0;
    if (!is_without_lines && joined > reading.left_out) return refusal;
    return fmt::format("{} on a lattice, but no line runs around {} from one to another", counted(dots, "dot"),
                       is_without_lines ? "them" : "most of them");
}

/// Where many gaps are doubtful, the picture is worse than those by which certainties were calibrated: on generated
/// pictures, most undoubted wrong gaps were in such ones.
void doubt_more(ReadKolam& kolam) {
    constexpr double usual = 0.1;
    const double share = static_cast<double>(kolam.doubtful().size()) /
                         static_cast<double>(std::max<std::size_t>(1, kolam.states.size()));
    if (share <= usual) return;
    for (float& certainty : kolam.certainty) certainty *= static_cast<float>(1 - (share - usual));
}

/// Places where a dot may have been lost, or taken for one.
std::vector<GridDot> uncertain_places(const LineReading& reading) {
    if (reading.is_given) return reading.blank;
    std::vector<GridDot> places = reading.added;
    for (const auto* more : {&reading.open_ends, &reading.missing}) {
        places.insert(places.end(), more->begin(), more->end());
    }
    return places;
}

/// Makes the gaps of a place to dots doubtful.
void doubt_around(ReadKolam& kolam, GridDot place) {
    const auto doubt = [&](std::uint32_t dot) {
        for (std::uint32_t side = 0; side < kolam.grid.sides(); ++side) {
            const std::int32_t gap = kolam.grid.gap(dot, side);
            if (gap < 0) continue;
            float& certainty = kolam.certainty[static_cast<std::size_t>(gap)];
            certainty = std::min(certainty, 0.9F * ReadKolam::doubtful_below);
        }
    };
    if (const auto dot = kolam.grid.dot_at(place)) return doubt(*dot);
    for (std::uint32_t side = 0; side < kolam.grid.sides(); ++side) {
        if (const auto dot = kolam.grid.dot_at(place + kolam.grid.step(side))) doubt(*dot);
    }
}

}  // namespace

bool KolamPart::is_counted() const {
    return is_kolam() || (!is_border && !is_narrow() && has_lines() && reading.agreement >= least_agreement);
}

bool KolamPart::is_narrow() const {
    return is_narrow_grid(kolam.grid);
}

KolamPart part_of(LineReading reading, bool is_dark) {
    const DotGrid& grid = reading.grid.grid();
    const std::size_t gaps = reading.evidence.size();
    ReadKolam kolam{grid, GapStates(gaps), std::vector<float>(gaps)};
    const double bad = bad_share(reading.evidence);
    for (std::size_t i = 0; i < gaps; ++i) {
        kolam.states[i] = reading.evidence[i].best();
        kolam.certainty[i] = certainty(reading.evidence[i], grid.lattice(), bad);
    }
    std::string refusal = refusal_of(reading, kolam);
    doubt_more(kolam);
    for (const GridDot place : uncertain_places(reading)) doubt_around(kolam, place);
    if (refusal.empty() && gaps > 0 && kolam.doubtful().size() == gaps) {
        refusal = fmt::format("{} on a lattice, but every gap between them is doubtful",
                              counted(grid.dots().size(), "dot"));
    }
    return {std::move(reading), std::move(kolam), std::move(refusal), is_dark};
}

KolamArea::KolamArea(const LineReading& reading)
    : grid_(reading.grid.grid()), map_(reading.grid.map), back_(map_.perspective().inverse()) {
    for (const GridDot dot : grid_.dots()) box_.add(map_.dot(dot));
}

glm::dvec2 KolamArea::from_first(glm::dvec2 pixel) const {
    return (*back_)(pixel)-map_.shift() + map_.offset() - lattice_point(grid_.lattice(), grid_.dots().front());
}

bool KolamArea::contains(glm::dvec2 pixel, double reach) const {
    if (!back_) return false;
    const glm::dvec2 at = from_first(pixel);
    if (!(std::fabs(at.x) < 1e6 && std::fabs(at.y) < 1e6)) return false;
    const GridDot first = grid_.dots().front();
    const GridDot near = nearest_place(grid_.lattice(), at);
    for (std::int32_t y = -4; y <= 4; y += 2) {
        for (std::int32_t x = -4; x <= 4; ++x) {
            const GridDot place = near + GridDot{x, y};
            if (glm::distance(lattice_point(grid_.lattice(), place), at) > reach) continue;
            if (grid_.dot_at(place + first)) return true;
        }
    }
    return false;
}

double KolamArea::pixels() const {
    const glm::dvec2 size = box_.high - box_.low;
    return std::max(0.0, size.x) * std::max(0.0, size.y);
}

bool is_in(const std::vector<KolamArea>& areas, glm::dvec2 pixel) {
    return std::any_of(areas.begin(), areas.end(), [&](const KolamArea& area) { return area.contains(pixel); });
}

std::size_t dots_beside(const KolamPart& part, const std::vector<InkSpot>& spots) {
    const FoundGrid& found = part.reading.grid;
    const DotLattice lattice = found.grid().lattice();
    const GridDot first = found.grid().dots().front();
    const double radius = found.dot_radius * found.spacing;
    const KolamArea area(part.reading);
    if (!area.is_regular()) return 0;
    std::size_t count = 0;
    for (const InkSpot& spot : spots) {
        if (spot.strength < 0.7 * found.strength || spot.radius < 0.6 * radius || spot.radius > 1.6 * radius)
            continue;
        if (!area.contains(spot.at)) continue;
        const glm::dvec2 at = area.from_first(spot.at);
        const GridDot near = nearest_place(lattice, at);
        if (glm::distance(lattice_point(lattice, near), at) < 0.4) continue;
        // At least two dots beside it.
        std::size_t around = 0;
        for (const GridDot dot : found.grid().dots()) {
            const glm::dvec2 place = lattice_point(lattice, dot) - lattice_point(lattice, first);
            around += glm::distance(place, at) < 0.95;
        }
        count += around >= 2;
    }
    return count;
}

}  // namespace sikku
