#include "art/reading/kolam_finder.h"

#include "art/reading/grid_fit.h"
#include "art/reading/kolam_edge.h"
#include "engine/base/text.h"
#include "engine/geometry/box.h"
#include "engine/geometry/point_grid.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

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

/// Places that may have dots that were not read.
std::size_t losses(const LineReading& reading) {
    return reading.open_ends.size() + reading.missing.size() + reading.left_out;
}
bool has_kolam(const std::vector<KolamPart>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const KolamPart& part) { return part.is_counted(); });
}
/// True if dots or gaps of the kolams among some parts may be lost.
bool has_losses(const std::vector<KolamPart>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const KolamPart& part) {
        return part.is_counted() &&
               (losses(part.reading) > 0 || 8 * part.kolam.doubtful().size() > part.kolam.states.size());
    });
}
/// Certain gaps of the kolams among some parts, minus possible losses.
double gain_of(const std::vector<KolamPart>& parts) {
    double gain = 0;
    for (const KolamPart& part : parts) {
        if (!part.is_counted()) continue;
        gain += static_cast<double>(part.kolam.states.size()) - static_cast<double>(part.kolam.doubtful().size());
        gain -= static_cast<double>(losses(part.reading));
        // Lattices with the expected grid come before all others, those that need fewer changes first.
        if (part.is_expected()) gain += 1e6 - 1e3 * static_cast<double>(part.changes());
    }
    return gain;
}
double agreement_of(const std::vector<LineReading>& readings) {
    return readings.empty() ? -1 : readings[0].agreement;
}
std::size_t dots_of(const std::vector<LineReading>& readings) {
    std::size_t dots = 0;
    for (const LineReading& reading : readings) dots += reading.grid.grid().dots().size();
    return dots;
}

/// Looks for lattices, and reads the kolams on them.
class LatticeReader {
public:
    LatticeReader(const InkSpots& ink, std::optional<DotLattice> lattice, const Monitor& monitor)
        : ink_(ink), lattice_(lattice), monitor_(monitor), reader_(ink.ink) {}

    InkReader& reader() { return reader_; }

    /// Reads the kolams on a lattice through some of the spots; where the angle of the lattice does not decide, the
    /// one whose gaps agree better. None if the lattice is one that was given up.
    std::vector<LineReading> read(const std::vector<InkSpot>& spots, std::optional<double> spacing) {
        last_.reset();
        const auto found = find_grid(ink_.finder, spots, lattice_, monitor_, spacing);
        if (!found || found->grid().dots().size() < 3) return {};
        last_ = Known(*found);
        if (std::find(given_up_.begin(), given_up_.end(), *last_) != given_up_.end()) return {};
        std::vector<LineReading> readings = reader_.read(*found, monitor_);
        if (lattice_ || found->angle <= 64 || found->angle >= 84) return readings;
        const bool is_square = found->grid().lattice() == DotLattice::square;
        const DotLattice other = is_square ? DotLattice::triangular : DotLattice::square;
        if (const auto again = find_grid(ink_.finder, spots, other, monitor_, spacing)) {
            std::vector<LineReading> second = reader_.read(*again, monitor_);
            if (agreement_of(second) > agreement_of(readings) + 0.3 && 2 * dots_of(second) > dots_of(readings)) {
                return second;
            }
        }
        return readings;
    }

    /// Never reads the last lattice again.
    void give_up_last() {
        if (last_) given_up_.push_back(*last_);
    }

private:
    struct Known {
        DotLattice lattice;
        std::size_t dots;
        glm::dvec2 first, last;
        explicit Known(const FoundGrid& found)
            : lattice(found.grid().lattice()),
              dots(found.grid().dots().size()),
              first(found.map.dot(found.grid().dots().front())),
              last(found.map.dot(found.grid().dots().back())) {}
        bool operator==(const Known&) const = default;
    };

    const InkSpots& ink_;
    std::optional<DotLattice> lattice_;
    const Monitor& monitor_;
    InkReader reader_;
    std::optional<Known> last_;
    std::vector<Known> given_up_;
};

/// The spots without others close beside them. Dots are many radii apart; hearts, petals and tips of flowers are not.
std::vector<InkSpot> spots_alone(const std::vector<InkSpot>& spots) {
    constexpr double close = 4.5;        // radii
    constexpr double least_share = 0.3;  // weaker or smaller spots are noise
    std::vector<glm::dvec2> points;
    for (const InkSpot& spot : spots) points.push_back(spot.at);
    const PointGrid index(points,
                          std::max(1.0, box_of(points).longest() / std::sqrt(static_cast<double>(points.size()))));
    std::vector<InkSpot> alone;
    for (std::uint32_t i = 0; i < spots.size(); ++i) {
        const InkSpot& spot = spots[i];
        const auto near = index.neighbours(i, 8);
        const bool is_alone = std::none_of(near.begin(), near.end(), [&](std::uint32_t k) {
            const InkSpot& other = spots[k];
            return glm::distance(spot.at, other.at) < close * std::max(spot.radius, other.radius) &&
                   other.strength > least_share * spot.strength && other.radius > least_share * spot.radius;
        });
        if (is_alone) alone.push_back(spot);
    }
    return alone;
}

/// Spots in which to look for a lattice: all of them, then those of similar sizes, the largest first, then those that
/// stand alone. A border can have more ornaments than the kolam has dots.
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
    std::vector<InkSpot> alone = spots_alone(spots);
    if (alone.size() >= least_spots && 5 * alone.size() < 4 * spots.size()) subsets.push_back(std::move(alone));
    return subsets;
}
/// Finds the parts of a picture with dots on a lattice, with lines of one sense.
class PartFinder {
public:
    PartFinder(const InkSpots& ink, const KolamSearch& search, std::vector<KolamPart>& parts, const Monitor& monitor)
        : ink_(ink),
          search_(search),
          parts_(parts),
          lattices_(ink, search.lattice, monitor),
          spots_(ink.spots),
          monitor_(monitor) {
        for (const KolamPart& part : parts) {
            if (part.is_counted()) remove_area(part.reading);
        }
    }

    void find() {
        // Lattices are often found by chance among the spots of textures.
        int attempts = has_kolam(parts_) ? 1 : 2;
        while (attempts > 0 && parts_.size() < most_parts && spots_.size() >= least_kolam_dots) {
            if (spacing_) {
                if (add(parts_on(spots_, spacing_))) continue;
                spacing_.reset();
            }
            const std::size_t before = parts_.size();
            if (has_readable() ? add(parts_on(spots_, std::nullopt)) : add_first(subsets_of(spots_))) {
                attempts = 1;
                continue;
            }
            if (parts_.size() == before) break;
            --attempts;
            remove_area(parts_[before].reading);
        }
        refuse_accidents();
    }

private:
    static constexpr std::size_t most_parts = 64;

    bool has_readable() const {
        return std::any_of(parts_.begin(), parts_.end(), [](const KolamPart& part) { return part.is_kolam(); });
    }
    void remove_area(const LineReading& reading) {
        const KolamArea area(reading);
        std::erase_if(spots_, [&](const InkSpot& spot) { return area.contains(spot.at); });
    }
    /// The parts on the best lattice through some spots.
    std::vector<KolamPart> parts_on(const std::vector<InkSpot>& some, std::optional<double> step) {
        std::vector<KolamPart> found;
        for (LineReading& reading : lattices_.read(some, step)) {
            found.push_back(as_expected(part_of(std::move(reading), ink_.is_dark)));
        }
        if (!has_kolam(found)) lattices_.give_up_last();
        count_unread(found);
        return found;
    }
    /// Counts, for the largest kolam on a lattice, the dots there that belong to no kolam.
    static void count_unread(std::vector<KolamPart>& parts) {
        const auto kolam =
            std::find_if(parts.begin(), parts.end(), [](const KolamPart& part) { return part.is_counted(); });
        if (kolam == parts.end() || kolam->is_expected()) return;
        for (const KolamPart& part : parts) {
            if (!part.is_counted() && !part.is_narrow()) kolam->unread += part.dots();
        }
    }
    /// The part with the dots of the expected grid, if it may have them.
    KolamPart as_expected(KolamPart part) {
        if (!search_.grid || part.reading.joined == 0) return part;
        std::optional<KolamPart> best;
        for (const GridFit& fit : fit_grid(*search_.grid, part.kolam.grid)) {
            if (!fit.is_plausible()) continue;
            LineReading again = lattices_.reader().read_as(part.reading.grid, fit.places, monitor_);
            if (!has_lines_around(again)) continue;
            again.left_out = 0;
            if (best && again.agreement <= best->reading.agreement) continue;
            best = part_of(std::move(again), part.is_dark);
            best->surplus = fit.surplus;
        }
        return best ? std::move(*best) : std::move(part);
    }
    /// True if most dots that were not seen have lines around them.
    static bool has_lines_around(const LineReading& reading) {
        return reading.outside == 0 && 3 * reading.blank.size() <= reading.added.size();
    }
    /// Adds parts; returns true if there is a kolam among them.
    bool add(std::vector<KolamPart> more) {
        const bool is_first = !spacing_;
        const bool is_good = has_kolam(more);
        if (is_good) spacing_.reset();
        for (KolamPart& part : more) {
            if (part.is_counted()) take_spots(part, is_first);
            parts_.push_back(std::move(part));
        }
        return is_good;
    }
    /// Removes the spots of a kolam, and after the first one all that are weak beside its dots. Kolams of a page are
    /// of one size, mostly.
    void take_spots(KolamPart& part, bool is_first) {
        part.beside = dots_beside(part, ink_.spots);
        remove_area(part.reading);
        const double strength = part.reading.grid.strength;
        if (is_first) std::erase_if(spots_, [&](const InkSpot& spot) { return spot.strength < 0.5 * strength; });
        spacing_ = part.reading.grid.spacing;
    }
    /// Adds the first kolams: those on all spots if nothing is lost there, else those of the subset with most.
    bool add_first(const std::vector<std::vector<InkSpot>>& subsets) {
        std::vector<KolamPart> best;
        for (const bool is_nearest : {false, true}) {
            for (const std::vector<InkSpot>& some : subsets) {
                // On a page of kolams, multiples of their steps can lead from one to the next.
                std::optional<double> step;
                if (is_nearest) step = median(nearest_distances(some));
                std::vector<KolamPart> found = parts_on(some, step);
                if (!has_kolam(found)) {
                    add(std::move(found));
                    continue;
                }
                if (best.empty() || gain_of(found) > gain_of(best)) best = std::move(found);
                if (is_enough(best)) return add(std::move(best));
            }
        }
        return add(std::move(best));
    }
    /// Refuses kolams of a few dots among many spots like them: chance finds such ones in textures.
    void refuse_accidents() {
        constexpr std::size_t few = 9;
        std::vector<KolamArea> areas;
        for (const KolamPart& part : parts_) {
            if (part.is_counted()) areas.emplace_back(part.reading);
        }
        for (KolamPart& part : parts_) {
            if (!part.is_kolam() || part.dots() >= few || part.is_dark != ink_.is_dark) continue;
            const std::size_t others = spots_like(part.reading.grid, areas);
            if (others < 8 * part.dots()) continue;
            part.refusal = fmt::format("{} on a lattice, but {} like dots elsewhere", counted(part.dots(), "dot"),
                                       counted(others, "spot"));
        }
    }
    /// The number of spots outside of some areas that resemble the dots of a grid.
    std::size_t spots_like(const FoundGrid& grid, const std::vector<KolamArea>& areas) const {
        return static_cast<std::size_t>(std::count_if(ink_.spots.begin(), ink_.spots.end(), [&](const InkSpot& spot) {
            const double size = spot.radius / (grid.dot_radius * grid.spacing);
            return spot.strength > 0.5 * grid.strength && size > 0.7 && size < 1.4 && !is_in(areas, spot.at);
        }));
    }
    bool is_enough(const std::vector<KolamPart>& parts) const {
        if (!search_.grid) return !has_losses(parts);
        return std::any_of(parts.begin(), parts.end(), [](const KolamPart& part) {
            return part.is_expected() && part.is_kolam() && part.changes() == 0;
        });
    }

    const InkSpots& ink_;
    const KolamSearch& search_;
    std::vector<KolamPart>& parts_;
    LatticeReader lattices_;
    std::vector<InkSpot> spots_;  ///< outside of the parts found
    const Monitor& monitor_;
    std::optional<double> spacing_;  ///< of the last kolam
};

void find_parts(const InkSpots& ink, const KolamSearch& search, std::vector<KolamPart>& parts,
                const Monitor& monitor) {
    if (!ink.is_rough()) PartFinder(ink, search, parts, monitor).find();
}

/// True if no dot of a part lies in or at the loops of an area, as those of its coarser lattices do.
bool lies_outside(const KolamPart& part, const KolamArea& area) {
    const std::vector<GridDot>& dots = part.kolam.grid.dots();
    return std::none_of(dots.begin(), dots.end(), [&](GridDot dot) {
        constexpr double loop = 0.6;
        return area.contains(part.reading.grid.map.dot(dot), loop);
    });
}
bool share_area(const Box& a, const Box& b) {
    return a.low.x < b.high.x && a.low.y < b.high.y && a.high.x > b.low.x && a.high.y > b.low.y;
}
/// The box around a part and, if its dots lie in single rows, around all such parts that overlap it and have its
/// spacing: a border may be found in pieces.
Box whole_box(const std::vector<KolamPart>& parts, const std::vector<KolamArea>& areas, std::size_t number) {
    Box box = areas[number].box();
    if (!parts[number].is_narrow()) return box;
    const Box own = box;
    const double spacing = parts[number].reading.grid.spacing;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Box& other = areas[i].box();
        const double times = parts[i].reading.grid.spacing / spacing;
        if (!parts[i].is_narrow() || times < 0.8 || times > 1.25 || !share_area(own, other)) continue;
        box.add(other.low);
        box.add(other.high);
    }
    return box;
}
/// Sorts parts: readable kolams first, those with most dots before the others, frames after the kolams within them.
void sort_parts(std::vector<KolamPart>& parts) {
    const auto rank = [](const KolamPart& part) {
        const int kind = part.is_kolam() ? 0 : part.is_counted() ? 1 : 2;
        return std::tuple(kind, part.is_expected() ? 0 : 1, part.is_expected() ? part.changes() : 0);
    };
    std::stable_sort(parts.begin(), parts.end(), [&](const KolamPart& a, const KolamPart& b) {
        return rank(a) != rank(b) ? rank(a) < rank(b) : a.dots() > b.dots();
    });
    std::vector<KolamArea> areas;
    for (const KolamPart& part : parts) areas.emplace_back(part.reading);
    std::vector<char> is_frame(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Box box = whole_box(parts, areas, i);
        for (std::size_t k = 0; k < parts.size() && is_frame[i] == 0; ++k) {
            if (k == i || parts[i].is_expected() || !parts[k].is_kolam() || !box.surrounds(areas[k].box())) continue;
            if (10 * parts[k].dots() <= parts[i].dots()) continue;
            is_frame[i] = parts[i].is_kolam() || (parts[i].has_lines() && lies_outside(parts[i], areas[k]));
        }
    }
    std::vector<KolamPart> frames;
    std::vector<KolamPart> borders;
    std::vector<KolamPart> others;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        // A frame of single dots, or one that cannot be read, is an ornament around a kolam.
        if (is_frame[i] != 0 && (!parts[i].is_kolam() || parts[i].is_narrow())) {
            if (parts[i].is_kolam()) parts[i].refusal = "a border";
            parts[i].is_border = true;
        }
        (parts[i].is_border ? borders : is_frame[i] != 0 ? frames : others).push_back(std::move(parts[i]));
    }
    const auto first_other =
        std::find_if(others.begin(), others.end(), [](const KolamPart& part) { return !part.is_kolam(); });
    others.insert(first_other, std::make_move_iterator(frames.begin()), std::make_move_iterator(frames.end()));
    others.insert(others.end(), std::make_move_iterator(borders.begin()), std::make_move_iterator(borders.end()));
    parts = std::move(others);
}
/// True if the hole of a frame has as much ink as a few of its loops, lighter or darker than the ground, besides the
/// kolams that were found.
bool has_ink_within(const KolamPart& frame, const std::vector<KolamPart>& parts, const GreyPicture& ink,
                    const Monitor& monitor) {
    const FoundGrid& found = frame.reading.grid;
    const KolamArea area(frame.reading);
    if (!area.is_regular()) return false;
    std::vector<KolamArea> known;
    for (const KolamPart& part : parts) {
        if (part.is_counted()) known.emplace_back(part.reading);
    }
    const double level = std::fabs(line_level(ink, found));
    const double step = std::max(1.0, found.spacing / 12);
    const double most = 3 * found.spacing * found.spacing / (step * step);
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

}  // namespace

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

std::size_t KolamFindings::kolams() const {
    return static_cast<std::size_t>(
        std::count_if(parts.begin(), parts.end(), [](const KolamPart& part) { return part.is_counted(); }));
}

std::size_t KolamFindings::readable() const {
    return static_cast<std::size_t>(
        std::count_if(parts.begin(), parts.end(), [](const KolamPart& part) { return part.is_kolam(); }));
}

double KolamFindings::free() const {
    double covered = 0;
    for (const KolamPart& part : parts) covered += part.is_counted() ? KolamArea(part.reading).pixels() : 0;
    return 1 - covered / (static_cast<double>(picture.width) * static_cast<double>(picture.height));
}

LineReading KolamFindings::read_again(const KolamPart& part, const std::vector<GridDot>& places,
                                      const Monitor& monitor) {
    if (is_ink_dark != part.is_dark) {
        for (float& value : ink.values) value = -value;
        is_ink_dark = part.is_dark;
    }
    return InkReader(ink).read_as(part.reading.grid, places, monitor);
}

KolamFindings find_kolams(DecodedPicture picture, const KolamSearch& search, const Monitor& monitor) {
    KolamFindings found{std::move(picture)};
    InkSpots ink(find_ink(found.picture, monitor), monitor);
    find_parts(ink, search, found.parts, monitor);
    found.is_rough = ink.is_rough();
    found.spots = ink.spots;
    found.is_dark = ink.is_dark;
    const std::size_t before = found.kolams();
    // The opposite sense, for grounds with a pattern, and for white kolams on black beside the kolams found.
    if (before == 0 || found.free() > 0.4) {
        ink.negate(monitor);
        found.is_rough = found.is_rough && ink.is_rough();
        find_parts(ink, search, found.parts, monitor);
    }
    sort_parts(found.parts);
    for (KolamPart& part : found.parts) {
        if (part.is_kolam() && part.is_narrow())
            part.has_more_within = has_ink_within(part, found.parts, ink.ink, monitor);
    }
    if (!found.parts.empty() && found.parts[0].is_dark == ink.is_dark) {
        found.spots = ink.spots;
        found.is_dark = ink.is_dark;
    }
    found.ink = std::move(ink.ink);
    found.is_ink_dark = ink.is_dark;
    return found;
}

}  // namespace sikku
