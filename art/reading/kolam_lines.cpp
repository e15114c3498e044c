#include "art/reading/kolam_lines.h"

#include "engine/base/text.h"
#include "engine/geometry/box.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// The part of the plane that a point lies in: the side of its nearest dot.
struct Part {
    std::uint32_t dot = 0;
    std::uint32_t side = 0;
    std::uint64_t rhombus = 0;  ///< the number of the gap, or another number at the border
};

/// The part of a point; nullopt far from all dots.
std::optional<Part> part_of(const DotGrid& grid, glm::dvec2 point) {
    // Places of the grid may be odd; those of nearest_place() are not.
    const GridDot origin = grid.dots()[0];
    const GridDot near = origin + nearest_place(grid.lattice(), point - lattice_point(grid.lattice(), origin));
    std::optional<Part> best;
    double least = 1e300;
    const std::int32_t reach = grid.lattice() == DotLattice::square ? 2 : 1;
    for (std::int32_t dy = -2; dy <= 2; dy += 2) {
        for (std::int32_t dx = -2; dx <= 2; dx += reach) {
            const GridDot place = near + GridDot{dx, dy};
            const auto dot = grid.dot_at(place);
            if (!dot) continue;
            const double distance = glm::distance(lattice_point(grid.lattice(), place), point);
            if (distance >= least) continue;
            least = distance;
            best = Part{*dot, 0, 0};
        }
    }
    if (!best) return best;
    const glm::dvec2 way = point - lattice_point(grid.lattice(), grid.dots()[best->dot]);
    const double turns = std::atan2(way.y, way.x) / (2 * std::numbers::pi);
    const auto sides = static_cast<double>(grid.sides());
    best->side = static_cast<std::uint32_t>(std::lround((turns + 1) * sides)) % grid.sides();
    const std::int32_t gap = grid.gap(best->dot, best->side);
    best->rhombus = gap >= 0 ? static_cast<std::uint64_t>(gap)
                             : grid.gaps().size() + std::uint64_t{grid.sides()} * best->dot + best->side;
    return best;
}

/// An arc as a line passes it.
struct Passed {
    std::uint32_t arc = 0;
    bool anticlockwise = true;
    std::uint64_t rhombus = 0;  ///< rhombus that it leads into
};

class LineReader {
public:
    LineReader(const DotGrid& grid, const Homography& to_lattice)
        : grid_(grid),
          to_lattice_(to_lattice),
          votes_(grid.gaps().size()),
          arc_times_(std::size_t{grid.sides()} * grid.dots().size()) {}

    void read(const ClosedLine& line) {
        passed_.clear();
        last_.reset();
        lost_ = false;
        for (std::size_t i = 0; i <= line.size(); ++i) {
            const glm::dvec2 from = to_lattice_(line[(i + line.size() - 1) % line.size()]);
            const glm::dvec2 to = to_lattice_(line[i % line.size()]);
            const double length = glm::distance(from, to);
            if (!(length < 1e7)) continue;
            const auto pieces = static_cast<std::size_t>(std::ceil(length * 6)) + 1;
            pieces_ += pieces;
            if (pieces_ > most_pieces)
                throw std::runtime_error("the lines are too long for the distances between their dots");
            for (std::size_t k = i == 0 ? pieces : 1; k <= pieces; ++k) {
                go(from + (to - from) * (static_cast<double>(k) / static_cast<double>(pieces)));
            }
        }
        // The walk begins at the first point and ends there; the arcs close a circle.
        for (std::size_t i = 0; i < passed_.size(); ++i) {
            ++arc_times_[passed_[i].arc];
            vote(passed_[i], passed_[(i + 1) % passed_.size()]);
        }
    }

    ReadKolam result() const {
        ReadKolam kolam{grid_, GapStates(votes_.size()), std::vector<float>(votes_.size(), 1.0F)};
        for (std::size_t gap = 0; gap < votes_.size(); ++gap) {
            const auto& votes = votes_[gap];
            const auto best = std::max_element(votes.begin(), votes.end());
            kolam.states[gap] = static_cast<GapState>(best - votes.begin());
            const std::uint32_t all = votes[0] + votes[1] + votes[2];
            if (*best != 2 || all != 2) kolam.certainty[gap] = *best >= 2 ? 0.3F : all == 1 ? 0.2F : 0.0F;
        }
        std::size_t loose = 0;
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            for (std::uint32_t arc = 0; arc < grid_.sides(); ++arc) {
                if (arc_times_[grid_.sides() * dot + arc] == 1) continue;
                ++loose;
                break;
            }
        }
        if (loose > 0) {
            kolam.notes.push_back(fmt::format("{} of {} {} not encircled once by the lines", loose,
                                              counted(grid_.dots().size(), "dot"), loose == 1 ? "is" : "are"));
        }
        if (strayed_ > 0) {
            kolam.notes.push_back(
                fmt::format("{} where a line strays from its path around the dots", counted(strayed_, "place")));
        }
        if (std::all_of(kolam.certainty.begin(), kolam.certainty.end(), [](float c) { return c == 1.0F; })) {
            kolam.certainty.clear();
        }
        return kolam;
    }

private:
    void go(glm::dvec2 to) {
        const auto part = part_of(grid_, to);
        if (!part) {
            lost_ = true;
            return;
        }
        if (last_ && !lost_) cross(*last_, at_, *part, to, 0);
        last_ = part;
        at_ = to;
        lost_ = false;
    }
    /// Adds the passes between two points close to each other.
    void cross(const Part& a, glm::dvec2 from, const Part& b, glm::dvec2 to, int depth) {
        if (a.rhombus == b.rhombus) return;
        if (a.dot == b.dot) {
            const std::uint32_t sides = grid_.sides();
            if ((a.side + 1) % sides == b.side) return pass({sides * a.dot + a.side, true, b.rhombus});
            if ((b.side + 1) % sides == a.side) return pass({sides * a.dot + b.side, false, b.rhombus});
        }
        if (depth > 30) {
            ++strayed_;
            return;
        }
        const glm::dvec2 middle = 0.5 * (from + to);
        const auto between = part_of(grid_, middle);
        if (!between) return;
        cross(a, from, *between, middle, depth + 1);
        cross(*between, middle, b, to, depth + 1);
    }
    void pass(const Passed& arc) {
        // To and fro over the same arc is a wobble.
        if (!passed_.empty() && passed_.back().arc == arc.arc && passed_.back().anticlockwise != arc.anticlockwise) {
            passed_.pop_back();
            return;
        }
        passed_.push_back(arc);
    }
    void vote(const Passed& from, const Passed& to) {
        if (from.rhombus >= votes_.size()) return;
        const ArcEnd leaves{from.arc, from.anticlockwise ? 1U : 0U};
        const ArcEnd enters{to.arc, to.anticlockwise ? 0U : 1U};
        const GridGap& gap = grid_.gaps()[static_cast<std::size_t>(from.rhombus)];
        for (const GapState state : {GapState::turned, GapState::crossed, GapState::joined}) {
            for (const ArcJoint& joint : joints(grid_, gap, state)) {
                if ((joint.first == leaves && joint.second == enters) ||
                    (joint.first == enters && joint.second == leaves)) {
                    ++votes_[static_cast<std::size_t>(from.rhombus)][static_cast<std::size_t>(state)];
                    return;
                }
            }
        }
        ++strayed_;
    }

    const DotGrid& grid_;
    const Homography& to_lattice_;
    std::vector<std::array<std::uint32_t, 3>> votes_;
    std::vector<std::uint32_t> arc_times_;
    std::vector<Passed> passed_;
    std::optional<Part> last_;
    glm::dvec2 at_{0.0};
    bool lost_ = false;
    static constexpr std::size_t most_pieces = 50'000'000;
    std::size_t pieces_ = 0;
    std::uint64_t strayed_ = 0;
};

// --- dots of lines that have none ---------------------------------------------------------------------------------

/// Cells of a picture of the plane: inside the lines an odd number of times or not.
class OddCells {
public:
    OddCells(const std::vector<ClosedLine>& lines, const Monitor& monitor) {
        Box box;
        for (const ClosedLine& line : lines) {
            for (const glm::dvec2 point : line) box.add(point);
        }
        low_ = box.low;
        const glm::dvec2 high = box.high;
        const double longest = std::max({high.x - low_.x, high.y - low_.y, 1e-12});
        // A dot of a kolam takes about four points, and has to be some tens of cells wide.
        std::size_t points = 0;
        for (const ClosedLine& line : lines) points += line.size();
        const double across = std::clamp(20 * std::sqrt(static_cast<double>(points)), 256.0, 1600.0);
        scale_ = across / longest;
        low_ -= glm::dvec2(2 / scale_);
        width_ = static_cast<std::size_t>(std::ceil((high.x - low_.x) * scale_)) + 4;
        height_ = static_cast<std::size_t>(std::ceil((high.y - low_.y) * scale_)) + 4;
        odd_.assign(width_ * height_, 0);
        // A step along a line flips all cells on its right: prefix sums along rows finish the picture.
        for (const ClosedLine& line : lines) {
            monitor.check();
            for (std::size_t i = 0; i < line.size(); ++i) flip(line[i], line[(i + 1) % line.size()]);
        }
        for (std::size_t y = 0; y < height_; ++y) {
            for (std::size_t x = 1; x < width_; ++x) odd_[y * width_ + x] ^= odd_[y * width_ + x - 1];
        }
    }

    bool is_odd(glm::dvec2 point) const {
        const glm::dvec2 cell = (point - low_) * scale_;
        if (!(cell.x >= 0 && cell.y >= 0 && cell.x < static_cast<double>(width_) &&
              cell.y < static_cast<double>(height_))) {
            return false;
        }
        return odd_[static_cast<std::size_t>(cell.y) * width_ + static_cast<std::size_t>(cell.x)] != 0;
    }

    /// Middles of the odd faces that are about as large as most.
    std::vector<glm::dvec2> faces() const {
        struct Face {
            double cells = 0;
            glm::dvec2 sum{0.0};
        };
        std::vector<Face> faces;
        // Faces meet where lines cross: without their borders they fall apart.
        std::vector<char> is_inside(odd_.size());
        constexpr std::size_t border = 2;
        for (std::size_t y = border; y + border < height_; ++y) {
            for (std::size_t x = border; x + border < width_; ++x) {
                const std::size_t cell = y * width_ + x;
                is_inside[cell] = odd_[cell] & odd_[cell - border] & odd_[cell + border] &
                                  odd_[cell - border * width_] & odd_[cell + border * width_];
            }
        }
        std::vector<char> is_seen(odd_.size());
        std::vector<std::size_t> stack;
        for (std::size_t first = 0; first < odd_.size(); ++first) {
            if (is_inside[first] == 0 || is_seen[first] != 0) continue;
            Face face;
            stack.assign(1, first);
            is_seen[first] = 1;
            while (!stack.empty()) {
                const std::size_t cell = stack.back();
                stack.pop_back();
                ++face.cells;
                face.sum += glm::dvec2(cell % width_, cell / width_);
                for (const std::size_t next : {cell - 1, cell + 1, cell - width_, cell + width_}) {
                    if (is_inside[next] == 0 || is_seen[next] != 0) continue;
                    is_seen[next] = 1;
                    stack.push_back(next);
                }
            }
            if (face.cells >= 12) faces.push_back(face);
        }
        if (faces.empty()) return {};
        std::vector<double> sizes;
        sizes.reserve(faces.size());
        for (const Face& face : faces) sizes.push_back(face.cells);
        const double usual = median(std::move(sizes));
        std::vector<glm::dvec2> places;
        for (const Face& face : faces) {
            if (face.cells < 0.3 * usual || face.cells > 3 * usual) continue;
            places.push_back(low_ + (face.sum / face.cells + 0.5) / scale_);
        }
        return places;
    }

private:
    void flip(glm::dvec2 a, glm::dvec2 b) {
        a = (a - low_) * scale_;
        b = (b - low_) * scale_;
        if (a.y > b.y) std::swap(a, b);
        // Rows whose middles lie between the ends, the lower one included.
        for (double y = std::ceil(a.y - 0.5); y + 0.5 < b.y; ++y) {
            const double x = a.x + (b.x - a.x) * (y + 0.5 - a.y) / (b.y - a.y);
            odd_[static_cast<std::size_t>(y) * width_ +
                 static_cast<std::size_t>(std::max(0.0, std::ceil(x - 0.5)))] ^= 1;
        }
    }

    glm::dvec2 low_{0.0};
    double scale_ = 1;
    std::size_t width_ = 0;
    std::size_t height_ = 0;
    std::vector<char> odd_;
};

/// All places of the lattice, near those fitted, that lines run around an odd number of times.
std::vector<GridDot> odd_places(const OddCells& cells, const LatticeFit& fit) {
    PlaceBox box;
    for (const auto& place : fit.places) {
        if (place) box.add(*place);
    }
    constexpr std::int32_t beyond = 12;
    std::vector<GridDot> places;
    for (std::int32_t y = box.low.y - beyond; y <= box.high.y + beyond; y += 2) {
        for (std::int32_t x = box.low.x - beyond; x <= box.high.x + beyond; ++x) {
            const GridDot place{x, y};
            const glm::dvec2 at = lattice_point(fit.lattice, place);
            if (!(nearest_place(fit.lattice, at) == place)) continue;
            if (cells.is_odd(fit.map(at))) places.push_back(place);
        }
    }
    return places;
}

}  // namespace

PlacedGrid place_grid(DotLattice lattice, std::vector<GridDot> places) {
    if (places.empty()) throw std::runtime_error("there are no dots");
    std::sort(places.begin(), places.end(), is_before);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    const std::int64_t rows = (std::int64_t{places.front().y} - places.back().y) / 2 + 1;
    if (rows > static_cast<std::int64_t>(DotGrid::most_dots)) throw std::runtime_error("the dots lie too far apart");
    std::vector<std::vector<std::int32_t>> columns(static_cast<std::size_t>(rows));
    for (const GridDot place : places) {
        columns[static_cast<std::size_t>((std::int64_t{places.front().y} - place.y) / 2)].push_back(place.x);
    }
    DotGrid grid(lattice, columns);
    const GridDot first = grid.dots().front();
    return {std::move(grid), places.front() - first};
}

ReadKolam read_gaps(const DotGrid& grid, const Homography& to_lattice, const std::vector<ClosedLine>& lines,
                    const Monitor& monitor) {
    LineReader reader(grid, to_lattice);
    for (const ClosedLine& line : lines) {
        monitor.check();
        if (line.size() > 1) reader.read(line);
    }
    return reader.result();
}

ReadKolam read_gaps(const PlacedGrid& placed, const std::vector<ClosedLine>& lines, const Monitor& monitor) {
    std::vector<glm::dvec2> from, to;
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        from.push_back(2.0 * corner + glm::dvec2(placed.origin.x, placed.origin.y));
        to.push_back(corner);
    }
    return read_gaps(placed.grid, *Homography::fit(from, to), lines, monitor);
}

ReadKolam kolam_of_lines(const std::vector<ClosedLine>& lines, std::vector<glm::dvec2> dots, bool y_down,
                         std::optional<DotLattice> lattice, const Monitor& monitor) {
    if (lines.empty() || lines[0].empty()) throw std::runtime_error("there are no closed lines");
    const bool has_dots = !dots.empty();
    std::optional<OddCells> cells;
    if (!has_dots) {
        cells.emplace(lines, monitor);
        dots = cells->faces();
        if (dots.empty()) throw std::runtime_error("the lines enclose no dots");
    }
    std::optional<LatticeFit> fit = fit_lattice(dots, y_down, lattice, monitor);
    if (!fit && dots.size() == 1) {
        // One dot: the line around it determines the scale of the grid.
        double reach = 0;
        for (const ClosedLine& line : lines) {
            for (const glm::dvec2 point : line) reach = std::max(reach, glm::distance(point, dots[0]));
        }
        const double up = y_down ? -1 : 1;
        const std::array<glm::dvec2, 3> from = {{{0, 0}, {1, 0}, {0, 1}}};
        const std::array<glm::dvec2, 3> to = {
            {dots[0], dots[0] + glm::dvec2(2 * reach, 0), dots[0] + glm::dvec2(0, 2 * up * reach)}};
        fit =
            LatticeFit{lattice.value_or(DotLattice::square), *Homography::fit(from, to), {GridDot{}}, 1, 90, {}, {}};
    }
    if (!fit) throw std::runtime_error("no lattice fits the dots");
    std::vector<GridDot> places;
    if (has_dots) {
        for (const auto& place : fit->places) {
            if (place) places.push_back(*place);
        }
    } else {
        places = odd_places(*cells, *fit);
    }
    const PlacedGrid placed = place_grid(fit->lattice, std::move(places));
    // Maps the plane of the lines to that of the grid, which has another origin.
    std::vector<glm::dvec2> from, to;
    for (const GridDot corner : {GridDot{0, 0}, GridDot{2, 0}, GridDot{0, 4}, GridDot{2, 4}}) {
        const GridDot place = corner + placed.origin;
        from.push_back(fit->map(lattice_point(fit->lattice, place)));
        to.push_back(lattice_point(fit->lattice, corner));
    }
    const auto to_lattice = Homography::fit(from, to);
    if (!to_lattice) throw std::runtime_error("no lattice fits the dots");
    ReadKolam kolam = read_gaps(placed.grid, *to_lattice, lines, monitor);
    if (const std::size_t doubts = kolam.doubtful().size(); 2 * doubts > kolam.states.size()) {
        throw std::runtime_error(
            fmt::format("the lines do not run around the dots of a lattice, as those of a kolam "
                        "on a grid do: {} of {} cannot be read",
                        doubts, counted(kolam.states.size(), "gap")));
    }
    if (has_dots && fit->fitted < dots.size()) {
        kolam.notes.push_back(fmt::format("{} of {} lie off the lattice and were left out", dots.size() - fit->fitted,
                                          counted(dots.size(), "dot")));
    }
    return kolam;
}

std::vector<ClosedLine> lines_of_kolam(const DotGrid& grid, const GapStates& states, double apart,
                                       const Monitor& monitor) {
    std::vector<ClosedLine> lines;
    Pulse pulse(monitor);
    for (const ArcStep& start : line_starts(grid, states, monitor)) {
        ClosedLine line;
        ArcStep step = start;
        do {
            pulse();
            const GridDot dot = grid.dots()[step.dot];
            const std::uint32_t side = entry(grid, step);
            const GridDot way = grid.step(side);
            const std::int32_t gap = grid.gap(step.dot, side);
            const GapState state = gap < 0 ? GapState::turned : states[static_cast<std::size_t>(gap)];
            const glm::dvec2 to_gap(0.5 * way.x, 0.5 * way.y);
            const glm::dvec2 middle = glm::dvec2(dot.x, dot.y) + to_gap;
            glm::dvec2 away(0.0);
            if (state == GapState::turned) away = -apart * to_gap;
            if (state == GapState::joined) {
                // Towards the middle of the face that the arc lies in.
                const GridDot first = grid.step(step.arc);
                const GridDot second = grid.step((step.arc + 1) % grid.sides());
                const double corners = grid.sides() == 4 ? 2 : 3;
                const glm::dvec2 face(first.x + second.x, first.y + second.y);
                away = apart * (face / corners - to_gap);
            }
            line.push_back(middle + away);
            step = next_step(grid, states, step);
        } while (step != start);
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace sikku
