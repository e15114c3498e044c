#include "art/reading/photograph.h"

#include "art/reading/kolam_edge.h"
#include "art/reading/kolam_reader.h"
#include "art/reading/picture.h"
#include "art/reading/spots.h"
#include "engine/base/text.h"
#include "engine/geometry/box.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace sikku {
namespace {

/// Dots closer than this are searched for again in a larger picture.
constexpr double least_spacing = 18;
/// Smaller pictures are enlarged: spots of a pixel or two cannot be compared with rings around them.
constexpr int least_side = 700;
/// A kolam with fewer dots would be found by chance.
constexpr std::size_t least_dots = 4;

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
    /// True if there are spots everywhere, as in noise.
    bool is_rough() const { return spots.size() >= SpotFinder::most_spots; }
};

/// True for dots in single rows, such as those of a border.
bool is_narrow_grid(const DotGrid& grid) {
    return 6 * grid.gaps().size() < 7 * grid.dots().size();
}

/// Least agreement of lines whose kolam could be an accident: the crossings between dots make coarser lattices, and
/// the ornaments of borders their own, whose gaps agree with no state.
constexpr double least_agreement = 1.12;

/// A part of a picture with dots on a lattice.
struct Part {
    LineReading reading;
    ReadKolam kolam;
    std::string refusal;  ///< reason why it is not a readable kolam; empty if it is
    bool is_dark = true;
    std::size_t beside = 0;        ///< dots between the places of the lattice
    bool is_border = false;        ///< a border of the kolams within it
    bool has_more_within = false;  ///< a frame around ink that was not read

    std::size_t dots() const { return kolam.grid.dots().size(); }
    bool is_kolam() const { return refusal.empty(); }
    /// True for dots on a lattice with lines around them, even if most gaps cannot be read.
    bool is_counted() const {
        return is_kolam() || (!is_border && !is_narrow() && has_lines() && reading.agreement >= least_agreement);
    }
    /// True for lines around dots on a lattice, which may be ornaments.
    bool has_lines() const { return dots() >= 9 && reading.explained >= 0.5 && 2 * reading.joined >= dots(); }
    bool is_narrow() const { return is_narrow_grid(kolam.grid); }
};

/// Places that may have dots that were not read.
std::size_t losses(const LineReading& reading) {
    return reading.open_ends.size() + reading.missing.size() + reading.left_out;
}
bool has_kolam(const std::vector<Part>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_counted(); });
}
/// True if dots or gaps of the kolams among some parts may be lost.
bool has_losses(const std::vector<Part>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const Part& part) {
        return part.is_counted() &&
               (losses(part.reading) > 0 || 8 * part.kolam.doubtful().size() > part.kolam.states.size());
    });
}
/// Certain gaps of the kolams among some parts, minus possible losses.
double gain_of(const std::vector<Part>& parts) {
    double gain = 0;
    for (const Part& part : parts) {
        if (!part.is_counted()) continue;
        gain += static_cast<double>(part.kolam.states.size()) - static_cast<double>(part.kolam.doubtful().size());
        gain -= static_cast<double>(losses(part.reading));
    }
    return gain;
}

/// The reason why dots with lines between them are not a kolam, or cannot be read; empty if they can.
std::string refusal_of_joined(const LineReading& reading, const ReadKolam& kolam) {
    const std::size_t dots = kolam.grid.dots().size();
    const std::size_t gaps = kolam.states.size();
    const std::size_t doubts = kolam.doubtful().size();
    if (dots < least_dots) return fmt::format("only {} of a lattice", counted(dots, "dot"));
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
    if (refusal.empty() || dots < least_dots) return refusal;
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

Part part_of(LineReading reading, bool is_dark) {
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
    for (const auto* places : {&reading.added, &reading.open_ends, &reading.missing}) {
        for (const GridDot place : *places) doubt_around(kolam, place);
    }
    if (refusal.empty() && gaps > 0 && kolam.doubtful().size() == gaps) {
        refusal = fmt::format("{} on a lattice, but every gap between them is beside a place that may have another",
                              counted(grid.dots().size(), "dot"));
    }
    return {std::move(reading), std::move(kolam), std::move(refusal), is_dark};
}

double agreement_of(const std::vector<LineReading>& readings) {
    return readings.empty() ? -1 : readings[0].agreement;
}
std::size_t dots_of(const std::vector<LineReading>& readings) {
    std::size_t dots = 0;
    for (const LineReading& reading : readings) dots += reading.grid.grid().dots().size();
    return dots;
}

/// Reads the kolams on a lattice through some of the spots; where the angle of the lattice does not decide, the one
/// whose gaps agree better.
std::vector<LineReading> read_lattice(InkReader& reader, const SpotFinder& finder, const std::vector<InkSpot>& spots,
                                      std::optional<DotLattice> lattice, std::optional<double> spacing,
                                      const Monitor& monitor) {
    auto found = find_grid(finder, spots, lattice, monitor, spacing);
    if (!found || found->grid().dots().size() < 3) return {};
    const double angle = found->angle;
    const DotLattice first = found->grid().lattice();
    std::vector<LineReading> readings = reader.read(*found, monitor);
    if (lattice || angle <= 64 || angle >= 84) return readings;
    const DotLattice other = first == DotLattice::square ? DotLattice::triangular : DotLattice::square;
    if (auto again = find_grid(finder, spots, other, monitor, spacing)) {
        std::vector<LineReading> second = reader.read(*again, monitor);
        if (agreement_of(second) > agreement_of(readings) + 0.3 && 2 * dots_of(second) > dots_of(readings)) {
            return second;
        }
    }
    return readings;
}

/// The area around the dots of a reading.
class Area {
public:
    explicit Area(const LineReading& reading)
        : grid_(reading.grid.grid()), map_(reading.grid.map), back_(map_.perspective().inverse()) {
        for (const GridDot dot : grid_.dots()) box_.add(map_.dot(dot));
    }
    /// A place of the lattice, of any offset, from one of its dots.
    glm::dvec2 from_first(glm::dvec2 pixel) const {
        return (*back_)(pixel)-map_.shift() + map_.offset() - lattice_point(grid_.lattice(), grid_.dots().front());
    }
    bool is_regular() const { return back_.has_value(); }
    /// True if a pixel lies close to a dot, within some spacings, or between dots: not in a hole, such as that of a
    /// frame.
    bool contains(glm::dvec2 pixel, double reach = 1.45) const {
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
    /// The box around the dots.
    const Box& box() const { return box_; }
    /// The pixels of that box.
    double pixels() const {
        const glm::dvec2 size = box_.high - box_.low;
        return std::max(0.0, size.x) * std::max(0.0, size.y);
    }

private:
    DotGrid grid_;
    LatticeMap map_;
    std::optional<Homography> back_;
    Box box_;
};

bool is_in(const std::vector<Area>& areas, glm::dvec2 pixel) {
    return std::any_of(areas.begin(), areas.end(), [&](const Area& area) { return area.contains(pixel); });
}

/// Dots between the places of a lattice: spots like its dots, within it.
std::size_t dots_beside(const Part& part, const std::vector<InkSpot>& spots) {
    const FoundGrid& found = part.reading.grid;
    const DotLattice lattice = found.grid().lattice();
    const GridDot first = found.grid().dots().front();
    const double radius = found.dot_radius * found.spacing;
    const Area area(part.reading);
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

/// Spots in which to look for a lattice: all of them, then those of similar sizes, the largest first. A border can
/// have more ornaments than the kolam has dots.
std::vector<std::vector<InkSpot>> subsets_of(const std::vector<InkSpot>& spots) {
    constexpr double similar = 1.9;
    constexpr std::size_t most_sizes = 3;
    constexpr std::size_t least_spots = 9;
    std::vector<std::vector<InkSpot>> subsets{spots};
    std::vector<double> radii;
    for (const InkSpot& spot : spots) radii.push_back(spot.radius);
    std::sort(radii.begin(), radii.end());
    // Ends of the sizes, from a radius that at least some spots have.
    std::size_t end = radii.size();
    while (end >= least_spots && subsets.size() <= most_sizes) {
        const double high = radii[end - std::min<std::size_t>(end, 3)];
        const double low = high / similar;
        std::vector<InkSpot> same;
        std::copy_if(spots.begin(), spots.end(), std::back_inserter(same),
                     [&](const InkSpot& spot) { return spot.radius > low && spot.radius <= 1.1 * high; });
        if (same.size() >= least_spots && 5 * same.size() < 4 * spots.size()) subsets.push_back(std::move(same));
        end = static_cast<std::size_t>(std::upper_bound(radii.begin(), radii.end(), low) - radii.begin());
    }
    return subsets;
}

/// Distances from spots to the nearest other one, for at most 400 of them.
std::vector<double> nearest_distances(const std::vector<InkSpot>& spots) {
    constexpr std::size_t most = 400;
    std::vector<double> distances;
    for (std::size_t i = 0; spots.size() > 1 && i < std::min(most, spots.size()); ++i) {
        double least = 1e300;
        for (std::size_t k = 0; k < spots.size(); ++k) {
            if (k != i) least = std::min(least, glm::distance(spots[i].at, spots[k].at));
        }
        distances.push_back(least);
    }
    return distances;
}

/// Finds all parts of a picture with dots on a lattice, with lines of one sense.
void find_parts(const InkSpots& ink, std::optional<DotLattice> lattice, std::vector<Part>& parts,
                const Monitor& monitor) {
    if (ink.is_rough()) return;
    InkReader reader(ink.ink);
    std::vector<InkSpot> spots = ink.spots;
    const auto remove_area = [&](const LineReading& reading) {
        const Area area(reading);
        std::erase_if(spots, [&](const InkSpot& spot) { return area.contains(spot.at); });
    };
    for (const Part& part : parts) {
        if (part.is_counted()) remove_area(part.reading);
    }
    constexpr std::size_t most_parts = 64;
    // Kolams of a page are of one size, mostly.
    std::optional<double> spacing;
    // The parts on the best lattice through some spots.
    const auto parts_on = [&](const std::vector<InkSpot>& some, std::optional<double> step) {
        std::vector<Part> found;
        for (LineReading& reading : read_lattice(reader, ink.finder, some, lattice, step, monitor)) {
            found.push_back(part_of(std::move(reading), ink.is_dark));
        }
        return found;
    };
    // Adds parts; returns true if there is a kolam among them.
    const auto add = [&](std::vector<Part> more) {
        const bool is_first = !spacing;
        const bool is_good = has_kolam(more);
        if (is_good) spacing.reset();
        for (Part& part : more) {
            if (part.is_counted()) {
                part.beside = dots_beside(part, ink.spots);
                remove_area(part.reading);
                const double strength = part.reading.grid.strength;
                if (is_first) {
                    std::erase_if(spots, [&](const InkSpot& spot) { return spot.strength < 0.5 * strength; });
                }
                spacing = part.reading.grid.spacing;
            }
            parts.push_back(std::move(part));
        }
        return is_good;
    };
    // Adds the first kolams: those on all spots if nothing is lost there, else those of the subset with most.
    const auto add_first = [&](const std::vector<std::vector<InkSpot>>& subsets) {
        std::vector<Part> best;
        for (const bool is_nearest : {false, true}) {
            for (const std::vector<InkSpot>& some : subsets) {
                // On a page of kolams, multiples of their steps can lead from one to the next.
                std::optional<double> step;
                if (is_nearest) step = median(nearest_distances(some));
                std::vector<Part> found = parts_on(some, step);
                if (!has_kolam(found)) {
                    add(std::move(found));
                    continue;
                }
                if (best.empty() || gain_of(found) > gain_of(best)) best = std::move(found);
                if (!has_losses(best)) return add(std::move(best));
            }
        }
        return add(std::move(best));
    };
    // Lattices are often found by chance among the spots of textures.
    int attempts = has_kolam(parts) ? 1 : 2;
    for (; attempts > 0 && parts.size() < most_parts && spots.size() >= least_dots;) {
        if (spacing) {
            if (add(parts_on(spots, spacing))) continue;
            spacing.reset();
        }
        const std::size_t before = parts.size();
        const bool is_further =
            std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_kolam(); });
        if (is_further ? add(parts_on(spots, std::nullopt)) : add_first(subsets_of(spots))) {
            attempts = 1;
            continue;
        }
        if (parts.size() == before) break;
        --attempts;
        remove_area(parts[before].reading);
    }
}

/// Findings in a picture.
struct Findings {
    DecodedPicture picture;
    std::vector<Part> parts = {};
    std::vector<InkSpot> spots = {};  ///< in the sense of the best part
    bool is_dark = true;              ///< that sense
    bool is_rough = false;

    std::size_t kolams() const {
        return static_cast<std::size_t>(
            std::count_if(parts.begin(), parts.end(), [](const Part& part) { return part.is_counted(); }));
    }
    /// Share of the picture around which no kolam was found.
    double free() const {
        double covered = 0;
        for (const Part& part : parts) covered += part.is_counted() ? Area(part.reading).pixels() : 0;
        return 1 - covered / (static_cast<double>(picture.width) * static_cast<double>(picture.height));
    }
};

/// True if no dot of a part lies in or at the loops of an area, as those of its coarser lattices do.
bool lies_outside(const Part& part, const Area& area) {
    const std::vector<GridDot>& dots = part.kolam.grid.dots();
    return std::none_of(dots.begin(), dots.end(), [&](GridDot dot) {
        constexpr double loop = 0.6;
        return area.contains(part.reading.grid.map.dot(dot), loop);
    });
}

/// Sorts parts: readable kolams first, those with most dots before the others, frames after the kolams within them.
void sort_parts(std::vector<Part>& parts) {
    const auto rank = [](const Part& part) { return part.is_kolam() ? 0 : part.is_counted() ? 1 : 2; };
    std::stable_sort(parts.begin(), parts.end(), [&](const Part& a, const Part& b) {
        return rank(a) != rank(b) ? rank(a) < rank(b) : a.dots() > b.dots();
    });
    std::vector<Area> areas;
    for (const Part& part : parts) areas.emplace_back(part.reading);
    std::vector<char> is_frame(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = 0; k < parts.size() && is_frame[i] == 0; ++k) {
            if (k == i || !parts[k].is_kolam() || !areas[i].box().surrounds(areas[k].box())) continue;
            if (10 * parts[k].dots() <= parts[i].dots()) continue;
            is_frame[i] = parts[i].is_kolam() || (parts[i].has_lines() && lies_outside(parts[i], areas[k]));
        }
    }
    std::vector<Part> frames;
    std::vector<Part> borders;
    std::vector<Part> others;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        // A frame of single dots, or one that cannot be read, is an ornament around a kolam.
        if (is_frame[i] != 0 && (!parts[i].is_kolam() || parts[i].is_narrow())) {
            if (parts[i].is_kolam()) parts[i].refusal = "a border";
            parts[i].is_border = true;
        }
        (parts[i].is_border ? borders : is_frame[i] != 0 ? frames : others).push_back(std::move(parts[i]));
    }
    const auto first_other =
        std::find_if(others.begin(), others.end(), [](const Part& part) { return !part.is_kolam(); });
    others.insert(first_other, std::make_move_iterator(frames.begin()), std::make_move_iterator(frames.end()));
    others.insert(others.end(), std::make_move_iterator(borders.begin()), std::make_move_iterator(borders.end()));
    parts = std::move(others);
}

/// True if the hole of a frame has as much ink as a few of its loops, lighter or darker than the ground, besides the
/// kolams that were found.
bool has_ink_within(const Part& frame, const std::vector<Part>& parts, const GreyPicture& ink,
                    const Monitor& monitor) {
    const FoundGrid& found = frame.reading.grid;
    const Area area(frame.reading);
    if (!area.is_regular()) return false;
    std::vector<Area> known;
    for (const Part& part : parts) {
        if (part.is_counted()) known.emplace_back(part.reading);
    }
    const double level = std::fabs(line_level(ink, found));
    const double step = std::max(1.0, found.spacing / 12);
    const double most = 4 * found.spacing * found.spacing / (step * step);
    double inked = 0;
    for (double y = area.box().low.y; y <= area.box().high.y; y += step) {
        monitor.check();
        for (double x = area.box().low.x; x <= area.box().high.x; x += step) {
            const glm::dvec2 pixel(x, y);
            if (std::fabs(ink.at(pixel)) <= 0.5 * level || is_in(known, pixel)) continue;
            if (++inked > most) return true;
        }
    }
    return false;
}

Findings find_kolams(DecodedPicture picture, const PhotographOptions& options, const Monitor& monitor) {
    Findings found{std::move(picture)};
    InkSpots ink(find_ink(found.picture, monitor), monitor);
    find_parts(ink, options.lattice, found.parts, monitor);
    found.is_rough = ink.is_rough();
    found.spots = ink.spots;
    found.is_dark = ink.is_dark;
    const std::size_t before = found.kolams();
    // The opposite sense, for grounds with a pattern, and for white kolams on black beside the kolams found.
    if (before == 0 || found.free() > 0.4) {
        ink.negate(monitor);
        found.is_rough = found.is_rough && ink.is_rough();
        find_parts(ink, options.lattice, found.parts, monitor);
    }
    sort_parts(found.parts);
    for (Part& part : found.parts) {
        if (part.is_kolam() && part.is_narrow())
            part.has_more_within = has_ink_within(part, found.parts, ink.ink, monitor);
    }
    if (!found.parts.empty() && found.parts[0].is_dark == ink.is_dark) {
        found.spots = ink.spots;
        found.is_dark = ink.is_dark;
    }
    return found;
}

DecodedPicture large_enough(DecodedPicture picture) {
    if (std::min(picture.width, picture.height) < 16) throw std::runtime_error("the picture is too small");
    const int longest = std::max(picture.width, picture.height);
    const int times = std::min(4, (least_side + longest - 1) / longest);
    return times > 1 ? enlarged(picture, times) : std::move(picture);
}

/// Pixels of the file for each pixel of the picture as it was read.
double file_scale(const DecodedPicture& picture) {
    return static_cast<double>(picture.file_width) / std::max(1, picture.width);
}

std::string places_text(std::size_t count) {
    return count == 1 ? "1 place was" : fmt::format("{} places were", count);
}

/// Spots that look like the dots of a kolam, but lie in none.
struct StrayDots {
    std::size_t count = 0;   ///< beside each other, as on a lattice
    bool is_border = false;  ///< they, or all spots, lie along the sides of a box around the kolams
};

/// True if points lie along the four sides of a box that contains some areas.
bool lie_around(const std::vector<glm::dvec2>& points, const std::vector<Area>& areas) {
    const Box box = box_of(points);
    if (!std::all_of(areas.begin(), areas.end(), [&](const Area& area) { return box.surrounds(area.box()); })) {
        return false;
    }
    const auto [low, high] = box;
    const double reach = 0.12 * std::min(high.x - low.x, high.y - low.y);
    std::array<std::size_t, 4> sides{};
    for (const glm::dvec2 point : points) {
        const std::array<double, 4> to = {point.x - low.x, high.x - point.x, point.y - low.y, high.y - point.y};
        const auto nearest = std::min_element(to.begin(), to.end());
        if (*nearest > reach) return false;
        ++sides[static_cast<std::size_t>(nearest - to.begin())];
    }
    return *std::min_element(sides.begin(), sides.end()) >= 3;
}

StrayDots stray_dots(const Findings& found, const Part& part) {
    const FoundGrid& grid = part.reading.grid;
    const double radius = grid.dot_radius * grid.spacing;
    std::vector<Area> areas;
    for (const Part& each : found.parts) {
        if (each.is_counted()) areas.emplace_back(each.reading);
    }
    std::vector<glm::dvec2> strays;
    std::vector<glm::dvec2> all;
    for (const InkSpot& spot : found.spots) {
        if (spot.strength < 0.5 * grid.strength || is_in(areas, spot.at)) continue;
        all.push_back(spot.at);
        if (spot.strength < 0.7 * grid.strength || spot.radius < 0.7 * radius || spot.radius > 1.4 * radius) continue;
        strays.push_back(spot.at);
    }
    StrayDots dots;
    dots.is_border = lie_around(strays, areas) || lie_around(all, areas);
    dots.count = static_cast<std::size_t>(std::count_if(strays.begin(), strays.end(), [&](glm::dvec2 at) {
        return std::count_if(strays.begin(), strays.end(), [&](glm::dvec2 other) {
                   return glm::distance(at, other) > 0.5 * grid.spacing &&
                          glm::distance(at, other) < 1.6 * grid.spacing;
               }) >= 2;
    }));
    return dots;
}

void add_notes(Part& part, const Findings& found, const PhotographOptions& options) {
    const LineReading& reading = part.reading;
    std::vector<std::string>& notes = part.kolam.notes;
    if (const std::size_t kolams = found.kolams(); kolams > 1) {
        notes.push_back(fmt::format("{} kolams in the picture: this is number {}", kolams, options.number));
        const auto unread = std::count_if(found.parts.begin(), found.parts.end(),
                                          [](const Part& each) { return each.is_counted() && !each.is_kolam(); });
        if (unread > 0) notes.push_back(fmt::format("{} of the kolams cannot be read", unread));
    }
    const StrayDots stray = part.is_dark == found.is_dark ? stray_dots(found, part) : StrayDots{};
    if (stray.count >= least_dots && !stray.is_border) {
        notes.push_back(fmt::format("{} like dots elsewhere in the picture: they may belong to another kolam",
                                    counted(stray.count, "spot")));
    }
    if (reading.reaches_edge) {
        notes.emplace_back("the kolam seems to continue outside of the picture: dots and lines there are missing");
    }
    if (stray.is_border ||
        std::any_of(found.parts.begin(), found.parts.end(), [](const Part& each) { return each.is_border; })) {
        notes.emplace_back("a border around the kolam was left out");
    }
    if (part.has_more_within) {
        notes.emplace_back("the dots lie in single rows, as in a border: lines within it were not read");
    }
    if (reading.left_out > 0) {
        notes.push_back(fmt::format("{} beside the kolam left out: no line joins {} to it",
                                    counted(reading.left_out, "dot"), reading.left_out == 1 ? "it" : "them"));
    }
    if (part.beside > 0) {
        notes.push_back(fmt::format("{} between the places of the grid left out", counted(part.beside, "dot")));
    }
    if (!reading.added.empty()) {
        notes.push_back(fmt::format("{} without a visible dot, but lines run around {}: {} added",
                                    places_text(reading.added.size()), reading.added.size() == 1 ? "it" : "them",
                                    reading.added.size() == 1 ? "a dot was" : "dots were"));
    }
    if (!reading.open_ends.empty()) {
        notes.push_back(fmt::format("{}: lines lead to {} beside the grid where no dot was seen",
                                    counted(reading.open_ends.size(), "open end"),
                                    counted(reading.open_ends.size(), "place")));
    }
    if (!reading.missing.empty()) {
        notes.push_back(
            fmt::format("{} may be missing: no dot was seen there, but there is ink, and the other dots suggest one",
                        counted(reading.missing.size(), "dot")));
    }
    notes.push_back(fmt::format("{} lines on {} ground, dots {:.0f} pixels apart in a picture of {} x {}",
                                part.is_dark ? "dark" : "light", part.is_dark ? "light" : "dark",
                                reading.grid.spacing * file_scale(found.picture), found.picture.file_width,
                                found.picture.file_height));
    if (const double angle = reading.grid.angle; angle > 66 && angle < 82 && !options.lattice) {
        notes.push_back(fmt::format("rows of dots meet at {:.0f} degrees: the grid was read as {}", angle,
                                    part.kolam.grid.lattice() == DotLattice::square ? "square" : "interlaced"));
    }
}

Photograph photograph_of(const Part& part, const std::vector<Part>& parts) {
    Photograph photograph{part.kolam, {}, part.reading.grid.map, part.reading.open_ends, part.reading.missing, {}, 1};
    for (const Part& other : parts) {
        if (&other == &part || !other.is_counted()) continue;
        for (const GridDot dot : other.kolam.grid.dots())
            photograph.others.push_back(other.reading.grid.map.dot(dot));
    }
    return photograph;
}

/// Variation of the distances from dots to their nearest neighbours: standard deviation divided by the mean.
double variation(const std::vector<InkSpot>& spots) {
    double sum = 0;
    double squares = 0;
    const std::vector<double> distances = nearest_distances(spots);
    for (const double distance : distances) {
        sum += distance;
        squares += distance * distance;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, distances.size()));
    const double mean = sum / count;
    return std::sqrt(std::max(0.0, squares / count - mean * mean)) / std::max(mean, 1e-9);
}

/// The first part with enough dots for a kolam, including those without lines; the end if there is none.
std::vector<Part>::const_iterator best_lattice(const std::vector<Part>& parts) {
    if (!parts.empty() && parts[0].dots() >= least_dots) return parts.begin();
    return std::find_if(parts.begin(), parts.end(),
                        [](const Part& part) { return part.dots() + part.reading.left_out >= least_dots; });
}

[[noreturn]] void refuse(Findings found) {
    const auto spots = [&] { return counted(found.spots.size(), "round spot"); };
    std::string what = "no kolam found: ";
    if (found.is_rough) {
        what += "too many round spots to be the dots of a kolam";
    } else if (found.spots.empty()) {
        what += "no round spots that could be dots";
    } else if (const auto part = best_lattice(found.parts); part != found.parts.end()) {
        what += spots() + ", " + part->refusal;
    } else {
        what += spots() + ", no lattice";
        // Dots in a ring are as far from each other as those of a lattice.
        const double percent = found.spots.size() > 3 ? 100 * variation(found.spots) : 0;
        if (percent >= 10) what += fmt::format(": their distances vary by {:.0f} %", percent);
    }
    RefusedPicture refused;
    constexpr std::size_t most_shown = 2000;
    for (const InkSpot& spot : found.spots) {
        if (refused.spots.size() < most_shown) refused.spots.push_back({spot.at, spot.radius});
    }
    if (!found.parts.empty()) refused.best = photograph_of(found.parts[0], found.parts);
    refused.picture = std::move(found.picture);
    throw NoKolam(what, std::move(refused));
}

}  // namespace

glm::dvec2 Photograph::in_file(GridDot place) const {
    return file_scale(picture) * (map.dot(place) + 0.5) - 0.5;
}

Photograph read_photograph(const std::filesystem::path& path, const PhotographOptions& options,
                           const Monitor& monitor) {
    return read_photograph(
        [&](int longest_side) { return read_picture(path, longest_side, options.most_pixels, monitor); }, options,
        monitor);
}

Photograph read_photograph(const PictureDecoder& decode, const PhotographOptions& options, const Monitor& monitor) {
    Findings found;
    for (const int side : {1500, 4000}) {
        found = find_kolams(large_enough(decode(side)), options, monitor);
        const bool is_smaller = found.picture.width < found.picture.file_width;
        const bool is_fine = !found.parts.empty() && found.parts[0].reading.grid.spacing >= least_spacing;
        if (!is_smaller || found.is_rough || is_fine) break;
    }
    const auto readable = static_cast<std::size_t>(
        std::count_if(found.parts.begin(), found.parts.end(), [](const Part& part) { return part.is_kolam(); }));
    if (readable == 0) refuse(std::move(found));
    if (options.number < 1 || options.number > readable) {
        throw std::runtime_error(fmt::format("kolam {} does not exist: the picture has {} that can be read",
                                             options.number, counted(readable, "kolam")));
    }
    Part& part = found.parts[options.number - 1];
    add_notes(part, found, options);
    if (options.repair) repair_by_symmetry(part.kolam);
    Photograph photograph = photograph_of(part, found.parts);
    photograph.kolams = found.kolams();
    photograph.readable = readable;
    photograph.picture = std::move(found.picture);
    return photograph;
}

}  // namespace sikku
