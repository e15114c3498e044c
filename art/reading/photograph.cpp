#include "art/reading/photograph.h"

#include "art/reading/kolam_finder.h"
#include "art/reading/kolam_fixes.h"
#include "art/reading/picture.h"
#include "engine/base/diagnostic.h"
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
bool lie_around(const std::vector<glm::dvec2>& points, const std::vector<KolamArea>& areas) {
    const Box box = box_of(points);
    if (!std::all_of(areas.begin(), areas.end(), [&](const KolamArea& area) { return box.surrounds(area.box()); })) {
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

StrayDots stray_dots(const KolamFindings& found, const KolamPart& part) {
    const FoundGrid& grid = part.reading.grid;
    const double radius = grid.dot_radius * grid.spacing;
    std::vector<KolamArea> areas;
    for (const KolamPart& each : found.parts) {
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

/// Notes about what else is in the picture.
void add_picture_notes(KolamPart& part, const KolamFindings& found, std::size_t number) {
    std::vector<std::string>& notes = part.kolam.notes;
    if (const std::size_t kolams = found.kolams(); kolams > 1) {
        notes.push_back(fmt::format("{} kolams in the picture: this is number {}", kolams, number));
        const std::size_t unread = kolams - found.readable();
        if (unread > 0) notes.push_back(fmt::format("{} of the kolams cannot be read", unread));
    }
    const StrayDots stray = part.is_dark == found.is_dark ? stray_dots(found, part) : StrayDots{};
    if (stray.count >= least_kolam_dots && !stray.is_border) {
        notes.push_back(fmt::format("{} like dots elsewhere in the picture: they may belong to another kolam",
                                    counted(stray.count, "spot")));
    }
    if (part.reading.reaches_edge) {
        notes.emplace_back("the kolam seems to continue outside of the picture: dots and lines there are missing");
    }
    if (stray.is_border ||
        std::any_of(found.parts.begin(), found.parts.end(), [](const KolamPart& each) { return each.is_border; })) {
        notes.emplace_back("a border around the kolam was left out");
    }
    if (part.has_more_within) {
        notes.emplace_back("the dots lie in single rows, as in a border: lines within it were not read");
    }
}

/// Notes about dots that were left out.
void add_surplus_notes(KolamPart& part) {
    std::vector<std::string>& notes = part.kolam.notes;
    if (const std::size_t count = part.reading.left_out; count > 0) {
        notes.push_back(fmt::format("{} beside the kolam left out: no line joins {} to it", counted(count, "dot"),
                                    count == 1 ? "it" : "them"));
    }
    if (part.unread > 0) {
        const bool is_one = part.unread == 1;
        notes.push_back(
            fmt::format("{} beside the kolam {} missing from the pattern: the lines around {} cannot be read",
                        counted(part.unread, "dot"), is_one ? "is" : "are", is_one ? "it" : "them"));
    }
    if (part.beside > 0) {
        notes.push_back(fmt::format("{} between the places of the grid left out", counted(part.beside, "dot")));
    }
    if (part.surplus > 0) {
        notes.push_back(fmt::format("{} beside the expected grid left out", counted(part.surplus, "dot")));
    }
}

/// Notes about dots that were added or may be lost.
void add_dot_notes(KolamPart& part) {
    const LineReading& reading = part.reading;
    std::vector<std::string>& notes = part.kolam.notes;
    if (const std::size_t count = reading.added.size(); count > 0 && reading.is_given) {
        notes.push_back(fmt::format("{} not seen: completed as in the expected grid",
                                    count == 1 ? "1 dot was" : fmt::format("{} dots were", count)));
    } else if (count > 0) {
        notes.push_back(fmt::format("{} without a visible dot, but lines run around {}: {} added", places_text(count),
                                    count == 1 ? "it" : "them", count == 1 ? "a dot was" : "dots were"));
    }
    if (const std::size_t count = reading.open_ends.size(); count > 0) {
        notes.push_back(fmt::format("{}: lines lead to {} beside the grid where no dot was seen",
                                    counted(count, "open end"), counted(count, "place")));
    }
    if (!reading.missing.empty()) {
        notes.push_back(
            fmt::format("{} may be missing: no dot was seen there, but there is ink, and the other dots suggest one",
                        counted(reading.missing.size(), "dot")));
    }
}

void add_notes(KolamPart& part, const KolamFindings& found, const PhotographOptions& options) {
    add_picture_notes(part, found, options.number);
    add_surplus_notes(part);
    add_dot_notes(part);
    std::vector<std::string>& notes = part.kolam.notes;
    notes.push_back(fmt::format("{} lines on {} ground, dots {:.0f} pixels apart in a picture of {} x {}",
                                part.is_dark ? "dark" : "light", part.is_dark ? "light" : "dark",
                                part.reading.grid.spacing * file_scale(found.picture), found.picture.file_width,
                                found.picture.file_height));
    const double angle = part.reading.grid.angle;
    if (angle > 66 && angle < 82 && !options.lattice && !options.grid) {
        notes.push_back(fmt::format("rows of dots meet at {:.0f} degrees: the grid was read as {}", angle,
                                    part.kolam.grid.lattice() == DotLattice::square ? "square" : "interlaced"));
    }
}

Photograph photograph_of(const KolamPart& part, const std::vector<KolamPart>& parts) {
    const LineReading& reading = part.reading;
    Photograph photograph{part.kolam, {}, reading.grid.map, reading.open_ends, reading.missing};
    if (reading.is_given) photograph.completed = reading.added;
    for (const KolamPart& other : parts) {
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
std::vector<KolamPart>::const_iterator best_lattice(const std::vector<KolamPart>& parts) {
    if (!parts.empty() && parts[0].dots() >= least_kolam_dots) return parts.begin();
    return std::find_if(parts.begin(), parts.end(), [](const KolamPart& part) {
        return part.dots() + part.reading.left_out >= least_kolam_dots;
    });
}

[[noreturn]] void refuse(KolamFindings found, const std::string& what) {
    RefusedPicture refused;
    constexpr std::size_t most_shown = 2000;
    for (const InkSpot& spot : found.spots) {
        if (refused.spots.size() < most_shown) refused.spots.push_back({spot.at, spot.radius});
    }
    if (!found.parts.empty()) refused.best = photograph_of(found.parts[0], found.parts);
    refused.picture = std::move(found.picture);
    throw NoKolam(what, std::move(refused));
}

[[noreturn]] void refuse(KolamFindings found) {
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
    refuse(std::move(found), what);
}

/// `41 dots (1-3-5-7-9-7-5-3-1)`.
std::string dots_text(const DotGrid& grid) {
    return fmt::format("{} ({})", counted(grid.dots().size(), "dot"), printable(grid.text(), 80));
}

/// Changes by hand to the kolam of a part.
KolamFixes fixes_of(const KolamPart& part, const std::vector<std::string>& texts) {
    KolamFixes fixes(part.kolam.grid);
    for (const std::string& text : texts) fixes.add(text);
    return fixes;
}

/// The places of a list that no hand has decided about, counted from another origin.
std::vector<GridDot> undecided(const std::vector<GridDot>& places, const KolamFixes& fixes, GridDot origin) {
    std::vector<GridDot> others;
    for (const GridDot place : places) {
        const auto is_here = [&](const std::vector<GridDot>& list) {
            return std::find(list.begin(), list.end(), place) != list.end();
        };
        if (!is_here(fixes.added()) && !is_here(fixes.removed())) others.push_back(place - origin);
    }
    return others;
}

/// The part with the dots of some fixes. Other places are as doubtful as before.
KolamPart with_dots(KolamFindings& found, const KolamPart& part, const KolamFixes& fixes, const Monitor& monitor) {
    const LineReading& before = part.reading;
    LineReading again = found.read_again(part, fixes.places(), monitor);
    if (again.outside > 0) throw FixError("a dot that was added lies outside of the picture");
    const GridDot origin = again.grid.placed.origin - before.grid.placed.origin;
    std::vector<GridDot> open_ends;
    for (const GridDot place : again.open_ends) open_ends.push_back(place + origin);
    again.open_ends = undecided(open_ends, fixes, origin);
    again.added = undecided(before.added, fixes, origin);
    again.missing = undecided(before.missing, fixes, origin);
    again.blank = undecided(before.blank, fixes, origin);
    again.left_out = before.left_out;
    again.is_given = before.is_given;
    KolamPart changed = part_of(std::move(again), part.is_dark);
    changed.beside = part.beside;
    changed.has_more_within = part.has_more_within;
    changed.surplus = part.surplus;
    changed.unread = part.unread;
    changed.kolam.notes.push_back(fmt::format("by hand, {} added and {} removed",
                                              counted(fixes.added().size(), "dot"), fixes.removed().size()));
    return changed;
}

KolamFindings search(const PictureDecoder& decode, const PhotographOptions& options, const Monitor& monitor) {
    KolamSearch wanted{options.lattice, options.grid};
    if (options.grid) wanted.lattice = options.grid->lattice();
    KolamFindings found;
    for (const int side : {1500, 4000}) {
        found = find_kolams(large_enough(decode(side)), wanted, monitor);
        const bool is_smaller = found.picture.width < found.picture.file_width;
        const bool is_fine = !found.parts.empty() && found.parts[0].reading.grid.spacing >= least_spacing;
        if (!is_smaller || found.is_rough || is_fine) break;
    }
    return found;
}

void check_grid(const PhotographOptions& options) {
    if (!options.grid) return;
    if (options.grid->dots().size() > most_seen_dots) {
        throw std::runtime_error(fmt::format("the expected grid has {}; a photograph can show {}",
                                             counted(options.grid->dots().size(), "dot"), most_seen_dots));
    }
    if (options.lattice.value_or(options.grid->lattice()) != options.grid->lattice()) {
        throw std::runtime_error("the expected grid has another lattice");
    }
}

/// The kolam that the options choose. Refuses pictures without one.
KolamPart& chosen_part(KolamFindings& found, const PhotographOptions& options) {
    const std::size_t readable = found.readable();
    if (readable == 0) refuse(std::move(found));
    if (options.number < 1 || options.number > readable) {
        throw std::runtime_error(fmt::format("kolam {} does not exist: the picture has {} that can be read",
                                             options.number, counted(readable, "kolam")));
    }
    KolamPart& part = found.parts[options.number - 1];
    if (options.grid && !part.is_expected()) {
        const std::string what =
            fmt::format("found {}; expected {}", dots_text(part.kolam.grid), dots_text(*options.grid));
        refuse(std::move(found), what);
    }
    return part;
}

Photograph read_decoded(const PictureDecoder& decode, const PhotographOptions& options, const Monitor& monitor) {
    check_grid(options);
    KolamFindings found = search(decode, options, monitor);
    KolamPart& part = chosen_part(found, options);
    const KolamFixes fixes = fixes_of(part, options.fixes);
    if (fixes.changes_dots()) part = with_dots(found, part, fixes, monitor);
    if (!part.is_kolam()) throw std::runtime_error("with the dots added and removed by hand: " + part.refusal);
    add_notes(part, found, options);
    if (options.repair) repair_by_symmetry(part.kolam);
    fixes.set_gaps(part.kolam);
    Photograph photograph = photograph_of(part, found.parts);
    photograph.kolams = found.kolams();
    photograph.readable = found.readable();
    photograph.picture = std::move(found.picture);
    if (options.region) photograph.to_file = options.region->to_file();
    return photograph;
}

}  // namespace

glm::dvec2 Photograph::in_file(GridDot place) const {
    return to_file(file_scale(picture) * (map.dot(place) + 0.5)) - 0.5;
}

Photograph read_photograph(const std::filesystem::path& path, const PhotographOptions& options,
                           const Monitor& monitor) {
    return read_photograph(
        [&](int longest_side) { return read_picture(path, longest_side, options.most_pixels, monitor); }, options,
        monitor);
}

Photograph read_photograph(const PictureDecoder& decode, const PhotographOptions& options, const Monitor& monitor) {
    if (!options.region) return read_decoded(decode, options, monitor);
    return read_decoded([&](int longest_side) { return read_region(decode, *options.region, longest_side); }, options,
                        monitor);
}

}  // namespace sikku
