#include "art/reading/photograph.h"

#include "art/reading/kolam_reader.h"
#include "art/reading/picture.h"
#include "art/reading/spots.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace sikku {
namespace {

/// Dots closer than that are looked for once more in a larger picture.
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
    /// Spots everywhere, as in noise.
    bool is_rough() const { return spots.size() >= SpotFinder::most_spots; }
};

/// A part of a picture with dots on a lattice.
struct Part {
    Reading reading;
    ReadKolam kolam;
    std::string refusal;  ///< why it is not a kolam that can be read; empty for those that are
    bool is_dark = true;
    std::size_t beside = 0;  ///< dots between the places of the lattice
    bool is_border = false;  ///< of the kolams within it

    std::size_t dots() const { return kolam.grid.dots().size(); }
    bool is_kolam() const { return refusal.empty(); }
    /// Dots on a lattice and lines around them, even if most gaps cannot be read.
    bool is_counted() const {
        return is_kolam() || (!is_border && !is_narrow() && dots() >= 9 && reading.explained >= 0.5 &&
                              2 * reading.joined >= dots());
    }
    /// Dots in single rows, as those of a border.
    bool is_narrow() const { return 6 * kolam.states.size() < 7 * dots(); }
};

/// Why a reading is not a kolam, or cannot be read; empty if it can.
std::string refusal_of(const Reading& reading, const ReadKolam& kolam) {
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
    return "";
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
        const GridDot way = kolam.grid.step(side);
        if (const auto dot = kolam.grid.dot_at({place.x + way.x, place.y + way.y})) doubt(*dot);
    }
}

Part part_of(Reading reading, bool is_dark) {
    const DotGrid& grid = reading.grid.grid();
    const std::size_t gaps = reading.evidence.size();
    ReadKolam kolam{grid, GapStates(gaps), std::vector<float>(gaps)};
    const double bad = bad_share(reading.evidence);
    for (std::size_t i = 0; i < gaps; ++i) {
        kolam.states[i] = reading.evidence[i].best();
        kolam.certainty[i] = certainty(reading.evidence[i], grid.lattice(), bad);
    }
    std::string refusal = refusal_of(reading, kolam);
    return {std::move(reading), std::move(kolam), std::move(refusal), is_dark};
}

double agreement_of(const std::vector<Reading>& readings) {
    return readings.empty() ? -1 : readings[0].agreement;
}
std::size_t dots_of(const std::vector<Reading>& readings) {
    std::size_t dots = 0;
    for (const Reading& reading : readings) dots += reading.grid.grid().dots().size();
    return dots;
}

/// Reads the kolams on a lattice through some of the spots; where the angle of the lattice does not decide, the one
/// whose gaps agree better.
std::vector<Reading> read_lattice(InkReader& reader, const SpotFinder& finder, const std::vector<InkSpot>& spots,
                                  std::optional<DotLattice> lattice, std::optional<double> spacing,
                                  const Monitor& monitor) {
    auto found = find_grid(finder, spots, lattice, monitor, spacing);
    if (!found || found->grid().dots().size() < 3) return {};
    const double angle = found->angle;
    const DotLattice first = found->grid().lattice();
    std::vector<Reading> readings = reader.read(std::move(*found), monitor);
    if (lattice || angle <= 64 || angle >= 84) return readings;
    const DotLattice other = first == DotLattice::square ? DotLattice::triangular : DotLattice::square;
    if (auto again = find_grid(finder, spots, other, monitor, spacing)) {
        std::vector<Reading> second = reader.read(std::move(*again), monitor);
        if (agreement_of(second) > agreement_of(readings) + 0.3 && 2 * dots_of(second) > dots_of(readings)) {
            return second;
        }
    }
    return readings;
}

/// The area around the dots of a reading.
class Area {
public:
    explicit Area(const Reading& reading)
        : grid_(reading.grid.grid()), map_(reading.grid.map), back_(map_.perspective().inverse()) {
        for (const GridDot dot : grid_.dots()) {
            low_ = glm::min(low_, map_.dot(dot));
            high_ = glm::max(high_, map_.dot(dot));
        }
    }
    /// A place of the lattice, of any offset, from one of its dots.
    glm::dvec2 from_first(glm::dvec2 pixel) const {
        return (*back_)(pixel)-map_.shift() + map_.offset() - lattice_point(grid_.lattice(), grid_.dots().front());
    }
    bool is_regular() const { return back_.has_value(); }
    /// Whether a pixel lies close to a dot, or between dots: not in a hole, as that of a frame.
    bool contains(glm::dvec2 pixel) const {
        if (!back_) return false;
        constexpr double reach = 1.45;
        const glm::dvec2 at = from_first(pixel);
        if (!(std::fabs(at.x) < 1e6 && std::fabs(at.y) < 1e6)) return false;
        const GridDot first = grid_.dots().front();
        const GridDot near = nearest_place(grid_.lattice(), at);
        for (std::int32_t y = -4; y <= 4; y += 2) {
            for (std::int32_t x = -4; x <= 4; ++x) {
                const GridDot place{near.x + x, near.y + y};
                if (glm::distance(lattice_point(grid_.lattice(), place), at) > reach) continue;
                if (grid_.dot_at({place.x + first.x, place.y + first.y})) return true;
            }
        }
        return false;
    }
    /// Pixels of the box around the dots.
    double box() const { return std::max(0.0, high_.x - low_.x) * std::max(0.0, high_.y - low_.y); }
    bool surrounds(const Area& other) const {
        return low_.x < other.low_.x && low_.y < other.low_.y && high_.x > other.high_.x && high_.y > other.high_.y;
    }

private:
    DotGrid grid_;
    LatticeMap map_;
    std::optional<Homography> back_;
    glm::dvec2 low_{1e300};
    glm::dvec2 high_{-1e300};
};

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
        // Two dots at least beside it.
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

/// All parts of a picture with dots on a lattice, of lines in one sense.
void find_parts(const InkSpots& ink, std::optional<DotLattice> lattice, std::vector<Part>& parts,
                const Monitor& monitor) {
    if (ink.is_rough()) return;
    InkReader reader(ink.ink);
    std::vector<InkSpot> spots = ink.spots;
    const auto remove_area = [&](const Reading& reading) {
        const Area area(reading);
        std::erase_if(spots, [&](const InkSpot& spot) { return area.contains(spot.at); });
    };
    for (const Part& part : parts) {
        if (part.is_counted()) remove_area(part.reading);
    }
    constexpr std::size_t most_parts = 64;
    // Kolams of a page are of one size, mostly.
    std::optional<double> spacing;
    // Adds the parts on the best lattice through some spots. Whether there is a kolam among them.
    const auto read = [&](const std::vector<InkSpot>& some) {
        std::vector<Reading> more = read_lattice(reader, ink.finder, some, lattice, spacing, monitor);
        bool is_good = false;
        std::optional<double> size;
        for (Reading& reading : more) {
            Part part = part_of(std::move(reading), ink.is_dark);
            if (part.is_counted()) {
                part.beside = dots_beside(part, ink.spots);
                remove_area(part.reading);
                const double strength = part.reading.grid.strength;
                if (!spacing) {
                    std::erase_if(spots, [&](const InkSpot& spot) { return spot.strength < 0.5 * strength; });
                }
                is_good = true;
                size = part.reading.grid.spacing;
            }
            parts.push_back(std::move(part));
        }
        if (is_good) spacing = size;
        return is_good;
    };
    // Lattices are often found by chance among the spots of textures.
    const bool has_kolam =
        std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_counted(); });
    int attempts = has_kolam ? 1 : 2;
    for (; attempts > 0 && parts.size() < most_parts && spots.size() >= least_dots;) {
        if (spacing) {
            if (read(spots)) continue;
            spacing.reset();
        }
        const std::size_t before = parts.size();
        const bool is_further =
            std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_kolam(); });
        const std::vector<std::vector<InkSpot>> subsets =
            is_further ? std::vector<std::vector<InkSpot>>{spots} : subsets_of(spots);
        if (std::any_of(subsets.begin(), subsets.end(), read)) {
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
        for (const Part& part : parts) covered += part.is_counted() ? Area(part.reading).box() : 0;
        return 1 - covered / (static_cast<double>(picture.width) * static_cast<double>(picture.height));
    }
};

/// Kolams that can be read first, those with most dots before the others, frames behind what they surround.
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
            is_frame[i] = k != i && parts[i].is_counted() && parts[k].is_kolam() && areas[i].surrounds(areas[k]) &&
                          10 * parts[k].dots() > parts[i].dots();
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
    return times > 1 ? enlarged(picture, times) : picture;
}

/// Pixels of the file for one of the picture as it was read.
double file_scale(const DecodedPicture& picture) {
    return static_cast<double>(picture.file_width) / std::max(1, picture.width);
}

std::string places_text(std::size_t count) {
    return count == 1 ? "1 place was" : fmt::format("{} places were", count);
}

/// Spots that look like the dots of a kolam, but lie in none.
std::size_t stray_dots(const Findings& found, const Part& part) {
    const FoundGrid& grid = part.reading.grid;
    const double radius = grid.dot_radius * grid.spacing;
    std::vector<Area> areas;
    for (const Part& each : found.parts) {
        if (each.is_counted()) areas.emplace_back(each.reading);
    }
    std::vector<glm::dvec2> strays;
    for (const InkSpot& spot : found.spots) {
        if (spot.strength < 0.7 * grid.strength || spot.radius < 0.7 * radius || spot.radius > 1.4 * radius) continue;
        if (std::any_of(areas.begin(), areas.end(), [&](const Area& area) { return area.contains(spot.at); }))
            continue;
        strays.push_back(spot.at);
    }
    // Beside each other, as on a lattice.
    return static_cast<std::size_t>(std::count_if(strays.begin(), strays.end(), [&](glm::dvec2 at) {
        return std::count_if(strays.begin(), strays.end(), [&](glm::dvec2 other) {
                   return glm::distance(at, other) > 0.5 * grid.spacing &&
                          glm::distance(at, other) < 1.6 * grid.spacing;
               }) >= 2;
    }));
}

void add_notes(Part& part, const Findings& found, const PhotographOptions& options) {
    const Reading& reading = part.reading;
    std::vector<std::string>& notes = part.kolam.notes;
    if (const std::size_t kolams = found.kolams(); kolams > 1) {
        notes.push_back(fmt::format("{} kolams in the picture: this is number {}", kolams, options.number));
        const auto unread = std::count_if(found.parts.begin(), found.parts.end(),
                                          [](const Part& each) { return each.is_counted() && !each.is_kolam(); });
        if (unread > 0) notes.push_back(fmt::format("{} of the kolams cannot be read", unread));
    }
    if (const std::size_t stray = part.is_dark == found.is_dark ? stray_dots(found, part) : 0; stray >= least_dots) {
        notes.push_back(fmt::format("{} like dots elsewhere in the picture: they may belong to another kolam",
                                    counted(stray, "spot")));
    }
    if (reading.reaches_edge) {
        notes.emplace_back("the kolam seems to continue outside of the picture: dots and lines there are missing");
    }
    if (std::any_of(found.parts.begin(), found.parts.end(), [](const Part& each) { return each.is_border; })) {
        notes.emplace_back("a border around the kolam was left out");
    }
    if (reading.left_out > 0) {
        notes.push_back(
            fmt::format("{} beside the kolam that no line joins to it left out", counted(reading.left_out, "dot")));
    }
    if (part.beside > 0) {
        notes.push_back(fmt::format("{} between the places of the grid left out", counted(part.beside, "dot")));
    }
    if (!reading.added.empty()) {
        notes.push_back(fmt::format("{} without a visible dot counted as a dot, because lines run around it",
                                    places_text(reading.added.size())));
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
    for (const auto* places : {&reading.added, &reading.open_ends, &reading.missing}) {
        for (const GridDot place : *places) doubt_around(part.kolam, place);
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

/// How far the distances from dots to their nearest neighbours vary: their standard deviation, of their mean.
double variation(const std::vector<InkSpot>& spots) {
    constexpr std::size_t most = 400;
    const std::size_t count = std::min(most, spots.size());
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double least = 1e300;
        for (std::size_t k = 0; k < count; ++k) {
            if (k != i) least = std::min(least, glm::distance(spots[i].at, spots[k].at));
        }
        sum += least;
        squares += least * least;
    }
    const double mean = sum / static_cast<double>(count);
    return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean * mean)) / std::max(mean, 1e-9);
}

[[noreturn]] void refuse(Findings found) {
    const auto spots = [&] { return counted(found.spots.size(), "round spot"); };
    std::string what = "no kolam found: ";
    if (found.is_rough) {
        what += "too many round spots to be the dots of a kolam";
    } else if (found.spots.empty()) {
        what += "no round spots that could be dots";
    } else if (found.parts.empty() || found.parts[0].dots() < least_dots) {
        what += spots() + ", no lattice";
        if (found.spots.size() > 3)
            what += fmt::format(": their distances vary by {:.0f} %", 100 * variation(found.spots));
    } else {
        what += spots() + ", " + found.parts[0].refusal;
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
