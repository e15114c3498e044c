#include "art/kolam/page_kolam.h"

#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Maximum slack of a grid, in spacings, if the nearest one is impossible.
constexpr double most_slack = 1.5;
constexpr double good_slack = 0.5;
/// Loops at the rim beyond the outer dots, with half of the line's width, in spacings.
constexpr double usual_reach = 0.39;

/// A rectangle, and the slack that its drawing would leave.
struct Candidate {
    DotRectangle rectangle;
    std::uint32_t detour = 0;  ///< rows or columns off the spacing wanted
    double slack = 0.0;
};

double row_distance(DotLattice lattice) {
    return lattice == DotLattice::square ? 1.0 : std::numbers::sqrt3 / 2;
}

/// The usual size of a drawing on a rectangle, in spacings.
glm::dvec2 usual_size(const DotRectangle& rectangle) {
    const glm::dvec2 dots(rectangle.columns - 1.0, (rectangle.rows - 1.0) * row_distance(rectangle.lattice));
    return dots + 2 * usual_reach;
}

double spacing_of(glm::dvec2 size, glm::dvec2 room) {
    return std::min(room.x / size.x, room.y / size.y);
}

double slack_of(glm::dvec2 size, glm::dvec2 room) {
    const glm::dvec2 left = room / spacing_of(size, room) - size;
    return std::max(left.x, left.y);
}

/// The number of dots in a row, or of rows, whose drawing is nearest to a length, in spacings.
std::uint32_t nearest_count(double length, double distance) {
    const double count = std::round((length - 2 * usual_reach) / distance) + 1;
    return static_cast<std::uint32_t>(std::clamp(count, 1.0, 2.0 * DotGrid::most_dots));
}

class Candidates {
public:
    explicit Candidates(const PageFill& fill) : fill_(fill), distance_(row_distance(fill.given.lattice)) {}

    /// Sorted from the best.
    std::vector<Candidate> all() {
        const auto [lattice, rows, columns] = fill_.given;
        if (rows > 0) {
            grow_columns(rows, 0);
        } else if (columns > 0) {
            grow_rows(columns, 0);
        } else {
            grow_both();
        }
        std::stable_sort(found_.begin(), found_.end(), [](const Candidate& a, const Candidate& b) {
            return std::pair(a.detour, a.slack) < std::pair(b.detour, b.slack);
        });
        return std::move(found_);
    }

private:
    static constexpr std::uint32_t farthest = 3;  // from the nearest count

    /// Calls `put` with whole numbers around a count.
    template <typename Put>
    static void around(std::uint32_t count, Put&& put) {
        for (std::uint32_t n = count - std::min(count, farthest); n <= count + farthest; ++n) put(n);
    }
    void grow_columns(std::uint32_t rows, std::uint32_t detour) {
        const double height = usual_size({fill_.given.lattice, rows, 1}).y;
        around(nearest_count(height * fill_.room.x / fill_.room.y, 1),
               [&](std::uint32_t columns) { add(rows, columns, detour); });
    }
    void grow_rows(std::uint32_t columns, std::uint32_t detour) {
        const double width = usual_size({fill_.given.lattice, 1, columns}).x;
        around(nearest_count(width * fill_.room.y / fill_.room.x, distance_),
               [&](std::uint32_t rows) { add(rows, columns, detour); });
    }
    /// The shorter side has the spacing wanted, the longer one grows.
    void grow_both() {
        const bool is_wide = fill_.room.x >= fill_.room.y;
        const double shorter = (is_wide ? fill_.room.y : fill_.room.x) / *fill_.spacing;
        const std::uint32_t usual = nearest_count(shorter, is_wide ? distance_ : 1);
        const glm::dvec2 counts = fill_.room / *fill_.spacing;
        if (counts.x * counts.y / distance_ > DotGrid::most_dots) {
            throw std::runtime_error(
                fmt::format("{:.4g} x {:.4g} mm with dots {:.3g} mm apart would have more than {} dots; expected a "
                            "larger spacing",
                            fill_.room.x, fill_.room.y, *fill_.spacing, DotGrid::most_dots));
        }
        around(usual, [&](std::uint32_t count) {
            const std::uint32_t detour = std::max(count, usual) - std::min(count, usual);
            is_wide ? grow_columns(count, detour) : grow_rows(count, detour);
        });
    }
    void add(std::uint32_t rows, std::uint32_t columns, std::uint32_t detour) {
        const DotRectangle rectangle{fill_.given.lattice, rows, columns};
        if (!is_possible(rectangle)) return;
        const double slack = slack_of(usual_size(rectangle), fill_.room);
        if (slack <= most_slack) found_.push_back({rectangle, detour, slack});
    }

    const PageFill& fill_;
    double distance_;
    std::vector<Candidate> found_;
};

/// Returns why a grid cannot have what is wanted, or an empty text.
std::string obstacle_of(const DotGrid& grid, const GridKolamOptions& options) {
    if (!options.symmetry) return "";
    if (!has_symmetry(grid, *options.symmetry)) {
        return fmt::format("{} itself does not have the symmetry {}", grid.name(),
                           grid_symmetry_name(*options.symmetry));
    }
    if (!options.single_line) return "";
    return single_line_obstacle(grid, *options.symmetry, options.joined > 0).value_or("");
}

PageKolam make_on(const DotRectangle& rectangle, const PageFill& fill, const GridKolamOptions& options,
                  const KolamPatternOptions& look, const Monitor& monitor) {
    DotGrid grid = dot_grid(rectangle);
    GridKolam kolam = make_grid_kolam(grid, options, monitor);
    const KolamPatternOptions named = describe_grid_kolam(grid, options, kolam);
    KolamPatternOptions described = look;
    described.title = named.title;
    described.description = named.description;
    KolamPattern pattern = kolam_pattern(grid, kolam.states, described);
    const glm::dvec2 size = pattern.size;
    return {.grid = std::move(grid),
            .kolam = std::move(kolam),
            .look = std::move(described),
            .pattern = std::move(pattern),
            .spacing = spacing_of(size, fill.room),
            .slack = slack_of(size, fill.room)};
}

[[noreturn]] void refuse_fill(const PageFill& fill, const std::string& obstacle) {
    throw std::runtime_error(fmt::format(
        "no grid fills {:.4g} x {:.4g} mm: {}", fill.room.x, fill.room.y,
        !obstacle.empty() ? obstacle
                          : "this number of dots leaves too much space; expected a number for the shorter side, "
                            "such as ROWSxfill on a wide page"));
}

/// Candidates that permit the symmetry and the line, best first, and why a better one fails.
struct Permitted {
    std::vector<Candidate> candidates;
    std::string skipped;
};

Permitted permitted(const PageFill& fill, const GridKolamOptions& options, const Monitor& monitor) {
    constexpr std::size_t most = 3;
    Permitted found;
    for (const Candidate& candidate : Candidates(fill).all()) {
        if (found.candidates.size() == most) break;
        monitor.check();
        // Further ones are only to be better by the size of their loops.
        if (!found.candidates.empty() && candidate.detour > found.candidates.front().detour) break;
        const std::string obstacle = obstacle_of(dot_grid(candidate.rectangle), options);
        if (obstacle.empty()) {
            found.candidates.push_back(candidate);
        } else if (found.candidates.empty() && found.skipped.empty()) {
            found.skipped = obstacle;
        }
    }
    if (found.candidates.empty()) refuse_fill(fill, found.skipped);
    return found;
}

/// Numbers of seeds that are tried until loops at the rim have a fitting size: those of straight grids have one size.
std::uint64_t tries_of(const PageFill& fill, const KolamPatternOptions& look, const Candidate& best) {
    constexpr std::uint64_t most_dots = 3000;
    const bool varies = fill.given.lattice == DotLattice::triangular || look.rim != RimStyle::round;
    const std::uint64_t dots = std::uint64_t{best.rectangle.rows} * best.rectangle.columns;
    return varies && best.slack <= good_slack && dots <= most_dots ? 6 : 1;
}

}  // namespace

PageKolam make_page_kolam(const PageFill& fill, const GridKolamOptions& options, const KolamPatternOptions& look,
                          const Monitor& monitor) {
    Permitted found = permitted(fill, options, monitor);
    const std::uint64_t tries = tries_of(fill, look, found.candidates.front());
    std::optional<PageKolam> best;
    GridKolamOptions tried = options;
    for (std::uint64_t k = 0; k < tries; ++k, tried.seed += 0x9E3779B97F4A7C15U) {
        for (const Candidate& candidate : found.candidates) {
            if (best && (best->slack <= good_slack || tries == 1)) break;
            PageKolam kolam = make_on(candidate.rectangle, fill, tried, look, monitor);
            if (!best || kolam.slack < best->slack) best = std::move(kolam);
        }
    }
    best->skipped = std::move(found.skipped);
    return std::move(*best);
}

}  // namespace sikku
