#include "art/cutting/piece_rows.h"

#include "art/cutting/slide.h"
#include "art/drawing/ink_shape.h"
#include "art/print/outline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

constexpr double pi = std::numbers::pi;
/// Limits for directions and displacements, so that intricate outlines do not take minutes.
std::size_t most_directions(std::size_t corners) {
    return std::clamp<std::size_t>(4'000 / corners, 4, 24);
}
std::size_t most_alignments(std::size_t corners) {
    return std::clamp<std::size_t>(200'000 / corners, 50, 1'000);
}
constexpr std::size_t most_units = 12;  ///< rows of each kind whose displacements are searched
constexpr std::size_t most_kept = 12;   ///< arrangements of each direction
/// Maximum number of copies, or rows, whose extents one copy overlaps. Needles overlap as many as they are longer
/// than wide; beyond the maximum their rows lie apart instead.
constexpr double most_met = 1'000;
constexpr double unlimited = std::numeric_limits<double>::max();
constexpr double near = 1e-9;  ///< relative difference of equal numbers

/// Angles from 0 to 180 degrees that turn sides parallel to the x or y axis, the angles of the longest sides first.
std::vector<double> turns_of(std::span<const glm::dvec2> outline) {
    std::vector<std::pair<double, double>> found;  // length and angle
    const auto add_sides = [&](std::span<const glm::dvec2> corners) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
            for (const double along : {0.0, pi / 2}) {
                double turn = std::fmod(along - std::atan2(side.y, side.x) + 3 * pi, pi);
                if (pi - turn < 1e-6) turn = 0;
                const auto known = std::find_if(found.begin(), found.end(),
                                                [&](const auto& one) { return std::fabs(one.second - turn) < 1e-6; });
                const double length = glm::length(side);
                if (known == found.end()) {
                    found.emplace_back(length, turn);
                } else {
                    known->first += length;
                }
            }
        }
    };
    add_sides(outline);
    add_sides(convex_hull({outline.begin(), outline.end()}));
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first * (1 + near); });
    found.resize(std::min(found.size(), most_directions(outline.size())));
    std::vector<double> turns;
    for (const auto& [length, turn] : found) turns.push_back(turn);
    return turns;
}

/// Distinct values; if there are too many, evenly spaced ones of these.
std::vector<double> few(std::vector<double> values, double size, std::size_t most) {
    std::sort(values.begin(), values.end());
    std::vector<double> different;
    for (const double value : values) {
        if (different.empty() || value - different.back() > near * size) different.push_back(value);
    }
    if (different.size() <= most) return different;
    std::vector<double> chosen;
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(different[i * different.size() / most]);
    return chosen;
}

/// True if a box of that size has room in an area.
bool fits(const Box& box, const Box& area) {
    const glm::dvec2 room = area.high - area.low, size = box.high - box.low;
    const double slack = near * glm::length(room);
    return size.x <= room.x + 2 * slack && size.y <= room.y + 2 * slack;
}

/// Copies of one piece of a row's unit that fit into the row.
struct Range {
    double first = 0;  ///< index of the period
    double count = 0;
};

}  // namespace

/// Searches the arrangements of one direction.
class PieceRows::Finder {
public:
    Finder(std::span<const glm::dvec2> corners, std::size_t direction, const Monitor& monitor)
        : direction_(direction),
          pulse_(monitor),
          corners_{std::vector<glm::dvec2>(corners.begin(), corners.end()), {}},
          box_(sikku::box_of(corners)),
          size_(glm::length(box_.high - box_.low)),
          area_(polygon_area(corners_[0])),
          across_{Profile(corners, 0), Profile(corners, 0).turned()},
          up_{Profile(corners, 1), Profile(corners, 1).turned()} {
        for (const glm::dvec2 corner : corners) corners_[1].push_back(-corner);
        for (std::size_t i = 0; i < 2; ++i) {
            marks_[i] = corners_[i];
            constexpr std::size_t most_with_middles = 16;
            for (std::size_t k = 0; k < corners.size() && corners.size() <= most_with_middles; ++k) {
                marks_[i].push_back((corners_[i][k] + corners_[i][(k + 1) % corners.size()]) / 2.0);
            }
        }
    }

    /// The best arrangements, the densest first.
    std::vector<Arrangement> find() {
        const double alone = across_[0].slide(across_[0], 0);
        arrange({{{}}, alone});
        for (const Row& row : rows_beside(alone)) arrange(row);
        for (const Row& row : rows_above(alone)) arrange(row);
        std::stable_sort(found_.begin(), found_.end(), is_denser);
        found_.resize(std::min(found_.size(), most_kept));
        return std::move(found_);
    }

private:
    struct Row {
        std::vector<Copy> unit;
        double period = 0;
        double waste = 0;  ///< wasted area; less is more promising
    };

    /// Displacements along an axis that move marks of a second copy to marks of the first.
    std::vector<double> alignments(const Copy& first, const Copy& second, int axis) const {
        std::vector<double> values;
        for (const glm::dvec2 a : marks_[first.is_turned]) {
            for (const glm::dvec2 b : marks_[second.is_turned]) {
                values.push_back(first.at[axis] + a[axis] - second.at[axis] - b[axis]);
            }
        }
        return few(std::move(values), size_, most_alignments(corners_[0].size()));
    }
    static std::vector<Row> most_promising(std::vector<Row> rows) {
        std::stable_sort(rows.begin(), rows.end(),
                         [](const Row& a, const Row& b) { return a.waste < b.waste * (1 - near); });
        rows.resize(std::min(rows.size(), most_units));
        return rows;
    }

    /// Rows of a copy and a turned one beside it.
    std::vector<Row> rows_beside(double alone) {
        std::vector<Row> rows;
        const Copy first{}, turned{true, {}};
        for (const double rise : alignments(first, turned, 1)) {
            pulse_();
            const double there = across_[0].slide(across_[1], rise), back = across_[1].slide(across_[0], -rise);
            if (!std::isfinite(there) || !std::isfinite(back)) continue;
            Row row{{first, {true, {there, rise}}}, std::max(there + back, alone)};
            const double top = std::max(box_.high.y, rise - box_.low.y);
            const double bottom = std::min(box_.low.y, rise - box_.high.y);
            row.waste = row.period * (top - bottom);
            rows.push_back(std::move(row));
        }
        return most_promising(std::move(rows));
    }
    /// Rows of copies with a row of turned ones above it.
    std::vector<Row> rows_above(double alone) {
        std::vector<Row> rows;
        const Copy first{};
        for (const double shift : shifts({first}, {{true, {}}}, alone)) {
            const double rise = rise_of({first}, {{true, {}}}, alone, shift, unlimited);
            if (!std::isfinite(rise)) continue;
            rows.push_back({{first, {true, {shift, rise}}}, alone, rise});
        }
        return most_promising(std::move(rows));
    }

    /// Displacements of an upper row against a lower one, from 0 to the period.
    std::vector<double> shifts(const std::vector<Copy>& lower, const std::vector<Copy>& upper, double period) const {
        std::vector<double> values = {0};
        for (const Copy& below : lower) {
            for (const Copy& above : upper) {
                for (const double value : alignments(below, above, 0)) {
                    const double shift = value - std::floor(value / period) * period;
                    values.push_back(period - shift < near * size_ ? 0 : shift);
                }
            }
        }
        return few(std::move(values), size_, most_alignments(corners_[0].size()));
    }
    /// The distance by which an upper row must be lifted above a lower one; infinity if that takes too long to find.
    /// @param most  results above it may be too small
    double rise_of(const std::vector<Copy>& lower, const std::vector<Copy>& upper, double period, double shift,
                   double most) {
        double rise = -std::numeric_limits<double>::infinity();
        for (const Copy& below : lower) {
            for (const Copy& above : upper) {
                const Profile& fixed = up_[below.is_turned];
                const Profile& moved = up_[above.is_turned];
                const double offset = above.at.x + shift - below.at.x;
                const double first = std::ceil((fixed.begin() - moved.end() - offset) / period);
                const double last = std::floor((fixed.end() - moved.begin() - offset) / period);
                if (!(last - first <= most_met)) return std::numeric_limits<double>::infinity();
                for (double k = first; k <= last; ++k) {
                    pulse_();
                    const double needed = fixed.slide(moved, offset + k * period);
                    rise = std::max(rise, needed + below.at.y - above.at.y);
                    if (rise > most) return rise;
                }
            }
        }
        return rise;
    }

    /// Finds the displacements that pack such rows most densely.
    void arrange(const Row& row) {
        Box box;
        for (const Copy& copy : row.unit) {
            for (const glm::dvec2 corner : corners_[copy.is_turned]) box.add(corner + copy.at);
        }
        const double in_use = static_cast<double>(row.unit.size()) * area_;
        std::vector<Arrangement> found;
        for (const double shift : shifts(row.unit, row.unit, row.period)) {
            constexpr double share = 0.9;  // least share of the best density
            const double most = in_use / (row.period * share * densest_);
            double rise = rise_of(row.unit, row.unit, row.period, shift, most);
            // Rows that are not neighbours may meet, too.
            const double height = box.high.y - box.low.y;
            if (!(height <= most_met * rise)) continue;
            for (double k = 2; rise <= most && k * rise < height; ++k) {
                rise = std::max(rise, rise_of(row.unit, row.unit, row.period, k * shift, k * most) / k);
            }
            if (!(rise > near * size_ && rise <= most)) continue;
            const double density = in_use / (row.period * rise);
            densest_ = std::max(densest_, density);
            found.push_back({direction_, row.unit, row.period, {shift, rise}, density});
        }
        if (found.empty() && row.unit.size() == 1 && found_.empty()) {
            const double height = box.high.y - box.low.y;
            found.push_back({direction_, row.unit, row.period, {0, height}, in_use / (row.period * height)});
        }
        // Straight columns come first if they are as good.
        std::stable_sort(found.begin(), found.end(), is_denser);
        constexpr std::size_t most_displacements = 4;
        found.resize(std::min(found.size(), most_displacements));
        for (Arrangement& each : found) found_.push_back(std::move(each));
    }

    std::size_t direction_;
    Pulse pulse_;
    std::array<std::vector<glm::dvec2>, 2> corners_;  ///< the corners as given, and turned by 180 degrees
    std::array<std::vector<glm::dvec2>, 2> marks_;    ///< corners and, if there are few, middles of sides
    Box box_;
    double size_;
    double area_;
    std::array<Profile, 2> across_, up_;
    double densest_ = 1e-3;
    std::vector<Arrangement> found_;
};

PieceRows::PieceRows(std::span<const glm::dvec2> outline, bool keeps_direction, const Box& area,
                     const Monitor& monitor) {
    for (const double turn : keeps_direction ? std::vector<double>{0} : turns_of(outline)) {
        const std::vector<glm::dvec2> corners = turned(outline, turn);
        const Direction direction{turn, sikku::box_of(corners)};
        if (fits(direction.box, area)) {
            Finder finder(corners, directions_.size(), monitor);
            for (Arrangement& each : finder.find()) arrangements_.push_back(std::move(each));
        }
        directions_.push_back(direction);
        glm::dvec2 size = direction.box.high - direction.box.low;
        if (size.y > size.x) std::swap(size.x, size.y);
        if (directions_.size() == 1 || size.x < least_size_.x) least_size_ = size;
    }
    std::stable_sort(arrangements_.begin(), arrangements_.end(), is_denser);
}

bool PieceRows::is_denser(const Arrangement& a, const Arrangement& b) {
    return a.density > b.density * (1 + near);
}

Box PieceRows::box_of(const Arrangement& arrangement, const Copy& copy) const {
    const Box& box = directions_[arrangement.direction].box;
    return copy.is_turned ? Box{copy.at - box.high, copy.at - box.low} : Box{copy.at + box.low, copy.at + box.high};
}

/// Calls `visit(origin, ranges)` for the rows of an area from top to bottom, until it returns false. @param phase the
/// copy that touches the left side in the first row
template <class Visit>
void PieceRows::for_each_row(const Arrangement& arrangement, const Box& area, std::size_t phase,
                             Visit&& visit) const {
    const double slack = near * glm::length(area.high - area.low);
    std::vector<Box> boxes;
    Box all;
    for (const Copy& copy : arrangement.unit) {
        boxes.push_back(box_of(arrangement, copy));
        all.add(boxes.back().low);
        all.add(boxes.back().high);
    }
    glm::dvec2 origin(area.low.x - boxes[phase].low.x, area.high.y - all.high.y);
    std::vector<Range> ranges(boxes.size());
    for (; origin.y + all.high.y >= area.low.y; origin -= arrangement.row) {
        // The first period within the area.
        origin.x -= std::floor((origin.x - area.low.x) / arrangement.period) * arrangement.period;
        bool fits = false;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            ranges[i] = {};
            const Box& box = boxes[i];
            if (origin.y + box.low.y < area.low.y - slack || origin.y + box.high.y > area.high.y + slack) continue;
            const double first = std::ceil((area.low.x - slack - origin.x - box.low.x) / arrangement.period);
            const double last = std::floor((area.high.x + slack - origin.x - box.high.x) / arrangement.period);
            ranges[i] = {first, std::max(0.0, last - first + 1)};
            fits = fits || ranges[i].count > 0;
        }
        if (fits && !visit(origin, std::span<const Range>(ranges))) return;
    }
}

LaidPieces PieceRows::fill(const Box& area, std::size_t most) const {
    struct Choice {
        const Arrangement* arrangement = nullptr;
        std::size_t phase = 0;
        double count = 0;
        double bottom = 0;
    };
    Choice best;
    const double wanted = static_cast<double>(most);
    for (const Arrangement& arrangement : arrangements_) {
        if (!fits(directions_[arrangement.direction].box, area)) continue;
        for (std::size_t phase = 0; phase < arrangement.unit.size(); ++phase) {
            Choice choice{&arrangement, phase, 0, area.high.y};
            for_each_row(arrangement, area, phase, [&](glm::dvec2 origin, std::span<const Range> ranges) {
                for (std::size_t i = 0; i < ranges.size(); ++i) {
                    choice.count += ranges[i].count;
                    if (ranges[i].count == 0) continue;
                    choice.bottom =
                        std::min(choice.bottom, origin.y + box_of(arrangement, arrangement.unit[i]).low.y);
                }
                choice.count = std::min(choice.count, wanted);
                return choice.count < wanted;
            });
            const double slack = near * (area.high.y - area.low.y);
            if (choice.count > best.count ||
                (choice.count == best.count && choice.count == wanted && choice.bottom > best.bottom + slack)) {
                best = choice;
            }
        }
    }
    LaidPieces laid;
    if (!best.arrangement || best.count == 0) {
        laid.below = area;
        return laid;
    }
    const Arrangement& arrangement = *best.arrangement;
    const double turn = directions_[arrangement.direction].turn;
    Box last;
    double above = area.high.y, bottom = area.high.y;  // lower edges of the rows above the last one, and of all rows
    for_each_row(arrangement, area, best.phase, [&](glm::dvec2 origin, std::span<const Range> ranges) {
        std::vector<std::pair<Copy, Box>> row;
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            for (double k = 0; k < ranges[i].count; ++k) {
                Copy copy = arrangement.unit[i];
                copy.at += origin + glm::dvec2((ranges[i].first + k) * arrangement.period, 0);
                row.emplace_back(copy, box_of(arrangement, copy));
            }
        }
        std::stable_sort(row.begin(), row.end(),
                         [](const auto& a, const auto& b) { return a.second.low.x < b.second.low.x; });
        row.resize(std::min(row.size(), most - laid.copies.size()));
        above = bottom;
        last = Box();
        for (const auto& [copy, box] : row) {
            laid.copies.push_back({copy.is_turned ? turn + pi : turn, copy.at});
            last.add(box.low);
            last.add(box.high);
        }
        bottom = std::min(bottom, last.low.y);
        return laid.copies.size() < most;
    });
    laid.below = {area.low, {area.high.x, bottom}};
    laid.beside = {{last.high.x, bottom}, {area.high.x, above}};
    return laid;
}

}  // namespace sikku
