#include "art/hand/hand.h"

#include "art/hand/hand_noise.h"
#include "art/hand/pinches.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/box.h"
#include "engine/geometry/point_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace sikku {
namespace {

// Lengths in loops, at full strength.
constexpr double ground_drift = 0.19, drift_knots = 1.25;
constexpr double sway = 0.16, sway_wave = 1.7;
constexpr double growth = 0.14, growth_wave = 5;  // by which loops are larger or smaller than each other
constexpr double tremor = 0.012, tremor_wave = 0.4;
constexpr double corner_window = 0.12;
constexpr double bend_window = 0.22;  // length over which a hand changes its speed
// Exponent of the width over curvature: a third for the speed, half of that for the width, and more at full strength
// than measured.
constexpr double swell = 0.3;
constexpr double least_bend = 0.5;  // bend of a straight run, which limits the speed of the hand
constexpr double usual_bend = 0.6;  // bend where the line is as wide as its pen
constexpr double pulse = 0.11, pulse_wave = 2.6;
constexpr double ripple = 0.06, ripple_wave = 0.7;
constexpr double flow_share = 0.4;  // by which the width follows the flour

// Shares of the gap between two lines that each of them, and the drift, may take.
constexpr double sway_share = 0.17, swell_share = 0.12, miss_share = 0.08, drift_share = 0.16;
constexpr double room_reach = 0.8;    // loops up to which a line has room
constexpr double nearest_gap = 0.03;  // share of the distance: narrower gaps count as touching
constexpr double side_by_side = 0.7;  // cosine of the angle up to which lines run side by side
constexpr double wedge = 0.6;         // gap, in widths, up to which lines that meet are in a wedge
constexpr double own_arc = 1.7;       // least ratio of length to distance at which a line is its own neighbour

constexpr double overlap_widths = 2.5;
constexpr double follow = 0.25;      // distance in loops beyond a line up to which places follow it
constexpr double nodes_of_fill = 6;  // for each loop
constexpr double dot_miss = 0.7;     // radii by which a hand misses the place of a dot, at full strength

std::uint64_t seed_of(const HandOptions& options, std::uint64_t line, std::uint64_t channel) {
    return scrambled(scrambled(options.seed + 0x68616e64) + 16 * line + channel);
}

/// Diameter of a loop: the median over all turning.
double usual_loop(const std::vector<HandLine>& lines) {
    std::vector<std::pair<double, double>> loops;
    double all = 0;
    for (const HandLine& line : lines) {
        const double turn = line.length / line.loop;
        loops.emplace_back(line.loop, turn);
        all += turn;
    }
    std::sort(loops.begin(), loops.end());
    double sum = 0;
    for (const auto& [loop, turn] : loops) {
        sum += turn;
        if (2 * sum >= all) return loop;
    }
    return 1;
}

double widest_half(const std::vector<HandLine>& lines) {
    double widest = 0;
    for (const HandLine& line : lines) {
        for (const HandNode& node : line.nodes) widest = std::max(widest, node.half);
    }
    return widest;
}

/// The nodes of all lines as they were drawn.
struct Places {
    explicit Places(const std::vector<HandLine>& lines) {
        for (std::size_t line = 0; line < lines.size(); ++line) {
            for (std::size_t i = 0; i < lines[line].size(); ++i) {
                at.push_back(lines[line].nodes[i].at);
                way.push_back(hand_unit_direction(lines[line], i));
                of.push_back({static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(i)});
            }
        }
    }
    struct Owner {
        std::uint32_t line, node;
    };
    std::vector<glm::dvec2> at, way;
    std::vector<Owner> of;
};

/// For each node, the nearest places before and after it where its line meets another: numbers from 1; 0 for none.
class Meetings {
public:
    Meetings(const std::vector<HandLine>& lines, const Places& places) {
        std::vector<std::size_t> begins;
        std::size_t count = 0;
        for (const HandLine& line : lines) {
            begins.push_back(count);
            count += line.size();
        }
        std::vector<std::pair<std::size_t, std::uint32_t>> met;
        std::uint32_t number = 0;
        for (const HandCrossing& crossing : hand_crossings(lines)) {
            ++number;
            met.emplace_back(begins[crossing.line] + crossing.node, number);
            met.emplace_back(begins[crossing.other] + crossing.other_node, number);
        }
        add_ends(lines, places, begins, met, number);
        std::sort(met.begin(), met.end());
        before_.resize(count);
        after_.resize(count);
        auto next = met.begin();
        for (std::size_t number_of_line = 0; number_of_line < lines.size(); ++number_of_line) {
            const std::size_t begin = begins[number_of_line], end = begin + lines[number_of_line].size();
            const auto first = next;
            while (next != met.end() && next->first < end) ++next;
            if (first == next) continue;
            const bool closed = lines[number_of_line].closed;
            auto at = first;
            for (std::size_t i = begin; i < end; ++i) {
                while (at != next && at->first <= i) ++at;
                before_[i] = at != first ? std::prev(at)->second : closed ? std::prev(next)->second : 0;
                after_[i] = at != next ? at->second : closed ? first->second : 0;
            }
        }
    }

    bool are_next_to_one(std::size_t i, std::size_t j) const {
        const auto is = [&](std::uint32_t number) {
            return number > 0 && (number == before_[j] || number == after_[j]);
        };
        return is(before_[i]) || is(after_[i]);
    }

private:
    /// Ends that lie on another line.
    static void add_ends(const std::vector<HandLine>& lines, const Places& places,
                         const std::vector<std::size_t>& begins,
                         std::vector<std::pair<std::size_t, std::uint32_t>>& met, std::uint32_t& number) {
        const bool all_closed =
            std::all_of(lines.begin(), lines.end(), [](const HandLine& line) { return line.closed; });
        if (all_closed) return;
        const PointGrid grid(places.at, std::max(2 * widest_half(lines), 1e-9));
        for (std::size_t of = 0; of < lines.size(); ++of) {
            const HandLine& line = lines[of];
            if (line.closed || line.size() < 2) continue;
            for (const std::size_t end : {std::size_t{0}, line.size() - 1}) {
                const std::size_t i = begins[of] + end;
                grid.visit(places.at[i], 1, [&](std::size_t j) {
                    const HandNode& far = lines[places.of[j].line].nodes[places.of[j].node];
                    const double reach = line.nodes[end].half + far.half;
                    if (glm::length(places.at[j] - places.at[i]) > reach) return;
                    if (places.of[j].line == of && std::fabs(far.along - line.nodes[end].along) < 3 * reach) return;
                    ++number;
                    met.emplace_back(i, number);
                    met.emplace_back(j, number);
                });
            }
        }
    }

    std::vector<std::uint32_t> before_, after_;
};

/// Keeps lines apart: measures the room beside each node, and how much of the drift fits.
/// @return share of the drift, 0 to 1
double find_room(std::vector<HandLine>& lines, const Places& places, const std::vector<glm::dvec2>& drifts,
                 double loop, const HandOptions& options) {
    const double far_gap = room_reach * loop, reach = 2 * widest_half(lines) + far_gap;
    const PointGrid grid(places.at, reach);
    const Meetings meetings(lines, places);
    const auto is_end = [](const HandLine& of, std::size_t k) {
        return !of.closed && (k == 0 || k + 1 == of.size());
    };
    double share = 1;
    for (std::size_t i = 0; i < places.at.size(); ++i) {
        if (i % 1024 == 0) options.monitor.check();
        HandLine& line = lines[places.of[i].line];
        HandNode& node = line.nodes[places.of[i].node];
        node.room = std::min(node.room, far_gap);
        grid.visit(places.at[i], 1, [&](std::size_t j) {
            const glm::dvec2 way = places.at[j] - places.at[i];
            const double distance = glm::length(way);
            if (distance > reach || i == j) return;
            const HandLine& other = lines[places.of[j].line];
            const HandNode& far = other.nodes[places.of[j].node];
            const double halves = node.half + far.half;
            if (&other == &line) {
                double arc = std::fabs(far.along - node.along);
                if (line.closed) arc = std::min(arc, line.length - arc);
                if (arc < own_arc * distance || arc < 2 * halves) return;
            }
            if (!is_end(line, places.of[i].node) && !is_end(other, places.of[j].node)) {
                if (std::fabs(glm::dot(places.way[i], places.way[j])) < side_by_side) return;
                if (std::fabs(glm::dot(way, places.way[i])) > side_by_side * distance) return;
            }
            const double gap = distance - halves;
            // Between lines that meet nearby there is a wedge, which may become longer or shorter.
            if (gap < wedge * halves && meetings.are_next_to_one(i, j)) return;
            node.room = std::min(node.room, std::max(gap, 0.0));
            if (gap < nearest_gap * distance) return;
            const double moved = glm::length(drifts[i] - drifts[j]);
            if (moved * share > drift_share * gap) share = drift_share * gap / moved;
        });
    }
    return share;
}

/// Limits the slope of room along each line, so that the widths it limits are smooth.
void even_room(HandLine& line) {
    constexpr double slope = 0.35;
    const std::size_t count = line.size();
    const auto limit = [&](std::size_t i, std::size_t from, double step) {
        line.nodes[i].room = std::min(line.nodes[i].room, line.nodes[from].room + slope * step);
    };
    for (int round = 0; round < (line.closed ? 2 : 1); ++round) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t from = line.previous(i);
            if (from != i) limit(i, from, line.step(from));
        }
        for (std::size_t i = count; i-- > 0;) {
            const std::size_t from = line.next(i);
            if (from != i) limit(i, from, line.step(i));
        }
    }
}

/// The sum of values within a window around each node, by the length of the window.
std::vector<double> windowed(const HandLine& line, const std::vector<double>& values, double window) {
    const std::size_t count = line.size();
    // Nodes are counted through three rounds of a closed line: before, on and after the line itself.
    const auto place = [&](std::size_t k) {
        const std::size_t rounds = k / count;
        return line.nodes[k % count].along + line.length * static_cast<double>(rounds);
    };
    const std::size_t first = line.closed ? count : 0, end = line.closed ? 3 * count : count;
    std::vector<double> sums(count);
    double sum = 0;
    std::size_t low = 0, high = 0;
    for (std::size_t k = first; k < first + count; ++k) {
        while (high < end && place(high) <= place(k) + window) sum += values[high++ % count];
        while (place(low) < place(k) - window) sum -= values[low++ % count];
        sums[k % count] = sum / (2 * window);
    }
    return sums;
}

/// Bend of the line around each node, relative to that of its loops. @param turns  angle at each node
std::vector<double> bends_of(const HandLine& line, const std::vector<double>& turns) {
    const std::size_t count = line.size();
    const double window = std::min(bend_window * line.loop, line.length / 4);
    std::vector<double> bends = windowed(line, turns, window);
    for (std::size_t i = 0; i < count; ++i) bends[i] *= (line.step(i) + line.step(line.previous(i))) / 2;
    bends = windowed(line, bends, window);
    for (double& bend : bends) bend *= line.loop / 2;
    return bends;
}

void set_flow(HandLine& line, const HandOptions& options) {
    const Pinches pinches(seed_of(options, line.number, 5), line.length, line.loop, options.strength);
    for (HandNode& node : line.nodes) {
        node.flow = pinches.flow(node.along);
        node.fresh = pinches.beginning(node.along);
    }
}

/// @param bends  of the line around each node
void set_widths(HandLine& line, const std::vector<double>& bends, const HandOptions& options) {
    const LineNoise pulses(seed_of(options, line.number, 2), line.length, pulse_wave * line.loop, line.closed);
    const LineNoise ripples(seed_of(options, line.number, 3), line.length, ripple_wave * line.loop, line.closed);
    for (std::size_t i = 0; i < line.size(); ++i) {
        HandNode& node = line.nodes[i];
        const double slow = std::pow((std::clamp(bends[i], 0.0, 4.0) + least_bend) / (usual_bend + least_bend),
                                     swell * options.strength);
        const double shaken = 1 + options.strength * (pulse * pulses(node.along) + ripple * ripples(node.along));
        const double strewn = 1 + flow_share * (node.flow - 1);
        node.half =
            std::min(node.half * std::clamp(slow * shaken * strewn, 0.5, 1.8), node.half + swell_share * node.room);
    }
}

/// The mean of vectors within a window around each node.
std::vector<glm::dvec2> smoothed(const HandLine& line, const std::vector<glm::dvec2>& vectors, double window) {
    const std::size_t count = line.size();
    std::vector<double> lengths(count), xs(count), ys(count);
    for (std::size_t i = 0; i < count; ++i) {
        lengths[i] = (line.step(i) + line.step(line.previous(i))) / 2;
        xs[i] = lengths[i] * vectors[i].x;
        ys[i] = lengths[i] * vectors[i].y;
    }
    lengths = windowed(line, lengths, window);
    xs = windowed(line, xs, window);
    ys = windowed(line, ys, window);
    std::vector<glm::dvec2> means(count);
    for (std::size_t i = 0; i < count; ++i) {
        means[i] = lengths[i] > 0 ? glm::dvec2(xs[i], ys[i]) / lengths[i] : vectors[i];
    }
    return means;
}

/// @param bends  of the line around each node, positive to the left
void move_nodes(HandLine& line, const std::vector<double>& bends, const glm::dvec2* drifts, const glm::dvec2* ways,
                const HandOptions& options) {
    const LineNoise sways(seed_of(options, line.number, 0), line.length, sway_wave * line.loop, line.closed);
    const LineNoise tremors(seed_of(options, line.number, 1), line.length, tremor_wave * line.loop, line.closed);
    const LineNoise growths(seed_of(options, line.number, 6), line.length, growth_wave * line.loop, line.closed);
    std::vector<glm::dvec2> moves(line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
        const HandNode& node = line.nodes[i];
        const double most = sway_share * node.room;
        const double outwards = -std::clamp(bends[i], -1.0, 1.0) * growth * growths(node.along);
        const double aside =
            options.strength * line.loop * (sway * sways(node.along) + tremor * tremors(node.along) + outwards);
        const double limited = most > 0 ? aside / (1 + std::fabs(aside) / most) : 0;
        moves[i] = limited * glm::dvec2(-ways[i].y, ways[i].x);
    }
    // At a corner, the sides move differently, and a hand rounds the difference.
    moves = smoothed(line, moves, std::min(corner_window * line.loop, line.length / 8));
    for (std::size_t i = 0; i < line.size(); ++i) {
        const double length = glm::length(moves[i]), most = sway_share * line.nodes[i].room;
        line.nodes[i].at += drifts[i] + (length > most ? most / length : 1) * moves[i];
    }
}

/// Movement of the ground.
class Drift {
public:
    Drift(double loop, const HandOptions& options)
        : seed_(seed_of(options, 0, 8)), most_(options.strength * ground_drift * loop), knots_(drift_knots * loop) {}
    glm::dvec2 operator()(glm::dvec2 at) const { return most_ * plane_noise(seed_, at, knots_); }
    void limit(double share) { most_ *= share; }

private:
    std::uint64_t seed_;
    double most_, knots_;
};

/// Movement of places beside the lines: that of the ground, and near a line its own as well.
class Shift {
public:
    /// @param places  before, and lines after they were moved
    Shift(const Places& places, const std::vector<HandLine>& lines, const Drift& drift, double loop)
        : places_(places),
          lines_(lines),
          drift_(drift),
          reach_(widest_half(lines) + follow * loop),
          grid_(places.at, reach_) {}

    glm::dvec2 operator()(glm::dvec2 at) const {
        const std::optional<Near> near = nearest(at);
        if (!near) return drift_(at);
        const double left = 1 - smooth_step((near->distance - near->node->half) / (reach_ - near->node->half));
        return drift_(at) + left * (near->node->at - near->place - drift_(near->place));
    }
    /// True if a line passes within its width.
    bool is_on_line(glm::dvec2 at) const {
        const std::optional<Near> near = nearest(at);
        return near && near->distance < near->node->half;
    }

private:
    struct Near {
        double distance;
        glm::dvec2 place;
        const HandNode* node;
    };
    std::optional<Near> nearest(glm::dvec2 at) const {
        const std::int64_t found = grid_.nearest(at, reach_);
        if (found < 0) return std::nullopt;
        const auto i = static_cast<std::size_t>(found);
        const Places::Owner& owner = places_.of[i];
        return Near{glm::length(places_.at[i] - at), places_.at[i], &lines_[owner.line].nodes[owner.node]};
    }

    const Places& places_;
    const std::vector<HandLine>& lines_;
    const Drift& drift_;
    double reach_;
    PointGrid grid_;
};

void move_dots(std::vector<HandDot>& dots, const Shift& shift, const HandOptions& options) {
    for (std::size_t i = 0; i < dots.size(); ++i) {
        HandDot& dot = dots[i];
        const double miss = shift.is_on_line(dot.at) ? 0 : options.strength * dot_miss * dot.radius;
        const std::uint64_t seed = seed_of(options, i, 7);
        dot.at += shift(dot.at) + miss * glm::dvec2(hand_chance(seed, 0), hand_chance(seed, 1));
    }
}

/// Divides edges of fills, and moves them. @param piece  length of the pieces
void move_fill(HandFill& fill, double piece, const Shift& shift) {
    constexpr double most_pieces = 64;
    const std::vector<glm::dvec2> outline = std::move(fill.outline);
    fill.outline.clear();
    const auto pieces_of = [&](double length) {
        return static_cast<int>(std::clamp(std::ceil(length / piece), 1.0, most_pieces));
    };
    if (fill.is_polygon) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 from = outline[i], way = outline[(i + 1) % outline.size()] - from;
            const int pieces = pieces_of(glm::length(way));
            for (int k = 0; k < pieces; ++k) {
                const glm::dvec2 at = from + way * (static_cast<double>(k) / pieces);
                fill.outline.push_back(at + shift(at));
            }
        }
        return;
    }
    glm::dvec2 before = shift(outline.front());
    fill.outline.push_back(outline.front() + before);
    for (std::size_t i = 0; i + 3 < outline.size(); i += 3) {
        const Bezier whole = {outline[i], outline[i + 1], outline[i + 2], outline[i + 3]};
        const int pieces = pieces_of(glm::length(whole[1] - whole[0]) + glm::length(whole[2] - whole[1]) +
                                     glm::length(whole[3] - whole[2]));
        for (int k = 0; k < pieces; ++k) {
            const Bezier part = part_of(whole, static_cast<double>(k) / pieces, (k + 1.0) / pieces);
            const glm::dvec2 after = shift(part[3]);
            fill.outline.insert(fill.outline.end(), {part[1] + before, part[2] + after, part[3] + after});
            before = after;
        }
    }
}

}  // namespace

void draw_by_hand(std::vector<HandLine>& lines, std::vector<HandDot>& dots, std::vector<HandFill>& fills,
                  const HandOptions& options) {
    if (!(options.strength > 0)) return;
    const double loop = usual_loop(lines);
    const Places places(lines);
    Drift drift(loop, options);
    std::vector<glm::dvec2> drifts;
    drifts.reserve(places.at.size());
    for (const glm::dvec2 at : places.at) drifts.push_back(drift(at));
    const double share = find_room(lines, places, drifts, loop, options);
    for (glm::dvec2& moved : drifts) moved *= share;
    drift.limit(share);
    std::size_t first = 0;
    for (HandLine& line : lines) {
        options.monitor.check();
        even_room(line);
        const std::size_t count = line.size();
        std::vector<double> turns(count);
        for (std::size_t i = 0; i < count; ++i) turns[i] = hand_turn(line, i);
        const std::vector<double> ways = bends_of(line, turns);
        for (double& turn : turns) turn = std::fabs(turn);
        set_flow(line, options);
        set_widths(line, bends_of(line, turns), options);
        move_nodes(line, ways, drifts.data() + first, places.way.data() + first, options);
        measure_again(line);
        first += count;
    }
    const Shift shift(places, lines, drift, loop);
    move_dots(dots, shift, options);
    for (HandFill& fill : fills) {
        options.monitor.check();
        move_fill(fill, loop / nodes_of_fill, shift);
    }
}

std::vector<HandCrossing> hand_crossings(const std::vector<HandLine>& lines) {
    std::vector<glm::dvec2> middles;
    struct Segment {
        std::uint32_t line, node;
    };
    std::vector<Segment> segments;
    double longest = 0;
    for (std::size_t number = 0; number < lines.size(); ++number) {
        const HandLine& line = lines[number];
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::size_t next = line.next(i);
            if (next == i) continue;
            middles.push_back((line.nodes[i].at + line.nodes[next].at) / 2.0);
            segments.push_back({static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(i)});
            longest = std::max(longest, glm::length(line.nodes[next].at - line.nodes[i].at));
        }
    }
    std::vector<HandCrossing> found;
    if (!(longest > 0)) return found;
    const PointGrid grid(middles, longest);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const HandLine& line = lines[segments[i].line];
        const std::size_t a = segments[i].node, a_end = line.next(a);
        grid.visit(middles[i], 1, [&](std::size_t j) {
            if (j <= i) return;
            const HandLine& other = lines[segments[j].line];
            const std::size_t b = segments[j].node, b_end = other.next(b);
            if (&line == &other && (a_end == b || b_end == a)) return;
            const glm::dvec2 p = line.nodes[a].at, u = line.nodes[a_end].at - p;
            const glm::dvec2 q = other.nodes[b].at, v = other.nodes[b_end].at - q;
            const double cross = determinant(u, v);
            if (cross == 0) return;
            const glm::dvec2 way = q - p;
            const double s = determinant(way, v) / cross, t = determinant(way, u) / cross;
            if (s < 0 || s >= 1 || t < 0 || t >= 1) return;
            found.push_back({p + s * u, std::min(line.nodes[a].half, other.nodes[b].half), segments[i].line, a,
                             segments[j].line, b});
        });
    }
    return found;
}

HandLine drawn_stroke(const HandLine& line, const HandOptions& options) {
    HandLine stroke = line;
    stroke.closed = false;
    if (line.size() < 2) return stroke;
    const double width = 2 * line.nodes.front().half;
    if (line.closed) {
        const double over = std::min(overlap_widths * width, line.length / 5);
        const double side = hand_chance(seed_of(options, line.number, 4), 0) < 0 ? -1 : 1;
        const double miss = side * std::min(1.0, 2 * options.strength) * 0.3 * width / 2;
        for (std::size_t i = 0; i < line.size() && line.nodes[i].along <= over; ++i) {
            stroke.nodes.push_back(line.nodes[i]);
            stroke.nodes.back().along += line.length;
            stroke.nodes.back().flow = line.nodes.back().flow;
            stroke.nodes.back().fresh = 0;
        }
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            HandNode& node = stroke.nodes[i];
            const double part = (node.along - (line.length - over)) / (2 * over);
            if (part <= 0) continue;
            const std::size_t of = i % line.size();
            const glm::dvec2 way = hand_unit_direction(line, of);
            const double limit = miss_share * line.nodes[of].room;
            node.at += std::clamp(miss * smooth_step(part), -limit, limit) * glm::dvec2(-way.y, way.x);
            if (part > 0.5) node.half *= 1 - 0.45 * smooth_step(2 * part - 1);
        }
        stroke.length = stroke.nodes.back().along;
    } else {
        for (HandNode& node : stroke.nodes) {
            const double left = stroke.length - node.along;
            node.half *= 1 - 0.3 * options.strength * (1 - smooth_step(left / std::max(1.5 * width, 1e-12)));
        }
    }
    // The hand waits a moment before it moves.
    for (HandNode& node : stroke.nodes) {
        const double part = node.along / std::max(width, 1e-12);
        if (part >= 1) break;
        node.half = std::min(node.half * (1 + 0.2 * options.strength * (1 - smooth_step(part))),
                             node.half + miss_share * node.room);
    }
    return stroke;
}

}  // namespace sikku
