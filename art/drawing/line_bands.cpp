#include "art/drawing/line_bands.h"

#include "engine/geometry/box.h"
#include "engine/geometry/parallel_curve.h"
#include "engine/geometry/point_tree.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double accuracy = 0.005;      // accuracy of parallel curves, in widths of a strand
constexpr double least_share = 0.55;    // share of the spacing: the widest strand
constexpr double beside = 0.6;          // share of a spacing: more room between bands than between strands
constexpr double least_spacing = 1e-3;  // in steps
constexpr int samples = 4;              // points of each piece, for distances

/// Finds the point where two straight strands meet that run `offset` to the left of a corner. Returns false if it is
/// far away, or far outside of the corner.
bool mitre(glm::dvec2 corner, glm::dvec2 before, glm::dvec2 after, double offset, glm::dvec2& found) {
    // 1 + the cosine of the turn: about 148 and 95 degrees
    constexpr double sharpest = 0.15;
    constexpr double sharpest_outside = 0.91;
    const double share = 1 + glm::dot(before, after);
    const bool is_outside = determinant(before, after) * offset < 0;
    if (share < (is_outside ? sharpest_outside : sharpest)) return false;
    found = corner + offset / share * (left_of(before) + left_of(after));
    return true;
}

double distance_to(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - a - share * along);
}

}  // namespace

LineBands::LineBands(const CurvedLines& lines, const CurveMeetings& meetings, const Style& style,
                     const Monitor& monitor)
    : lines_(lines), meetings_(meetings), style_(style) {
    if (style.weave) weave(monitor);
    if (style.parallel.count < 2) return;
    double sum = 0;
    for (const CurvePiece& piece : lines.pieces) sum += glm::length(piece.curve[3] - piece.curve[0]);
    const double step = lines.pieces.empty() ? 0 : sum / static_cast<double>(lines.pieces.size());
    measure_tips(step, monitor);
    measure_turns(monitor);
    // Lines farther apart than this leave room for any band that the tightest turn permits.
    constexpr int widest = 4;
    for (double most = step / 2; most <= widest * step && least_distance_ > most; most *= 2) {
        measure_distance(monitor, most);
    }
}

void LineBands::weave(const Monitor& monitor) {
    diagram_ = make_curve_diagram(lines_, meetings_);
    if (diagram_.multiple > 0) {
        throw std::runtime_error(
            fmt::format("a weave needs crossings of two strands; more than two meet at {} of this drawing",
                        diagram_.multiple == 1 ? "1 point" : fmt::format("{} points", diagram_.multiple)));
    }
    if (!alternate(diagram_.diagram, monitor)) {
        throw std::runtime_error("the lines cannot pass over and under alternately: an open line ends inside a loop");
    }
    upper_.resize(crossings());
    for (std::size_t line = 0; line < diagram_.marks.size(); ++line) {
        const auto& passes = diagram_.diagram.lines[line].passes;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            if (diagram_.diagram.is_over(passes[i])) upper_[passes[i].crossing] = diagram_.marks[line][i];
        }
    }
    measure_crossings();
}

void LineBands::measure_crossings() {
    for (std::size_t line = 0; line < lines_.lines.size(); ++line) {
        const auto& marks = diagram_.marks[line];
        const bool is_closed = lines_.lines[line].is_closed;
        for (std::size_t i = 0; i + (is_closed ? 0 : 1) < marks.size(); ++i) {
            const bool is_last = i + 1 == marks.size();
            const double from = meetings_.marks[marks[i]].position;
            const double to =
                meetings_.marks[marks[is_last ? 0 : i + 1]].position + (is_last ? lines_.lines[line].count() : 0.0);
            double length = 0;
            lines_.visit_between(lines_.lines[line], from, to, [&](const Bezier& curve, const CurvePiece&) {
                constexpr int chords = 4;
                for (int k = 0; k < chords; ++k) {
                    length += glm::length(point_of(curve, static_cast<double>(k + 1) / chords) -
                                          point_of(curve, static_cast<double>(k) / chords));
                }
            });
            least_run_ = std::min(least_run_, length);
        }
    }
}

/// Finds tips that have room for parallel lines inside, of lines whose mean piece is `step` long.
void LineBands::measure_tips(double step, const Monitor& monitor) {
    constexpr double sharp = 0.1;
    constexpr double shrink = 0.85;
    for (const LineTip& tip : find_tips(lines_, meetings_, sharp * step, monitor)) {
        double most = std::min(step / 2, least_tip_);
        while (most > sharp * step && !crossing_inside(lines_, tip, most)) most *= shrink;
        if (most <= sharp * step) continue;
        least_tip_ = std::min(least_tip_, most);
        tips_.push_back(tip);
    }
}

std::span<const LineTip> LineBands::tips_of(std::size_t line) const {
    const auto begin =
        std::partition_point(tips_.begin(), tips_.end(), [&](const LineTip& tip) { return tip.line < line; });
    const auto end = std::partition_point(begin, tips_.end(), [&](const LineTip& tip) { return tip.line == line; });
    return std::span(tips_).subspan(begin - tips_.begin(), end - begin);
}

/// For each eighth of each piece, whether a tip covers it.
std::vector<bool> LineBands::places_in_tips(std::size_t line) const {
    std::vector<bool> covered(std::size_t{places_of_piece} * lines_.lines[line].count(), false);
    for (const LineTip& tip : tips_of(line)) {
        const auto end = static_cast<std::size_t>(std::lround(tip.end * places_of_piece));
        for (auto i = static_cast<std::size_t>(std::lround(tip.begin * places_of_piece)); i < end; ++i) {
            covered[i % covered.size()] = true;
        }
    }
    return covered;
}

/// Finds the tightest turn outside of tips, and the corners that are closest to each other along a line.
void LineBands::measure_turns(const Monitor& monitor) {
    Pulse pulse(monitor);
    for (std::size_t number = 0; number < lines_.lines.size(); ++number) {
        const CurvedLines::Line& line = lines_.lines[number];
        const std::vector<bool> covered = places_in_tips(number);
        const auto is_in_tip = [&](std::uint32_t i, int k) {
            const std::size_t place = std::size_t{i} * places_of_piece + static_cast<std::size_t>(k);
            return covered[place % covered.size()] || covered[(place + covered.size() - 1) % covered.size()];
        };
        double run = 0;          // length of straight pieces in one direction
        double turn_before = 0;  // half the turn at its beginning, as a tangent
        const std::uint32_t count = line.count();
        for (std::uint32_t i = 0; i < count + (line.is_closed ? count : 0); ++i) {
            pulse();
            const CurvePiece& piece = lines_.piece(line, i % count);
            if (!piece.is_straight) {
                if (i >= count) continue;
                for (int k = 0; k <= places_of_piece; ++k) {
                    if (is_in_tip(i, k)) continue;
                    const double bend =
                        std::fabs(curvature_of(piece.curve, static_cast<double>(k) / places_of_piece));
                    if (bend > 0) least_radius_ = std::min(least_radius_, 1 / bend);
                }
                run = turn_before = 0;
                continue;
            }
            run += glm::length(piece.curve[3] - piece.curve[0]);
            if (i + 1 >= count && !line.is_closed) break;
            const glm::dvec2 before = tangent_of(piece.curve, 1);
            const glm::dvec2 after = tangent_of(lines_.piece(line, (i + 1) % count).curve, 0);
            glm::dvec2 unused;
            if (!mitre({}, before, after, determinant(before, after), unused)) {
                run = turn_before = 0;
                continue;
            }
            const double turn = determinant(before, after) / (1 + glm::dot(before, after));
            if (std::fabs(turn) < 1e-9) continue;
            constexpr double most = 0.9;
            const double both = std::fabs(turn_before + turn);
            if (both > 1e-9) least_corner_ = std::min(least_corner_, most * run / both);
            run = 0;
            turn_before = turn;
        }
    }
}

/// Finds the least distance, up to `most`, of points of lines that lie beside each other: where the line between them
/// is at right angles to both.
void LineBands::measure_distance(const Monitor& monitor, double most) {
    std::vector<glm::dvec2> points;
    std::vector<glm::dvec2> tangents;
    for (const CurvePiece& piece : lines_.pieces) {
        for (int k = 0; k < samples; ++k) {
            const double t = (k + 0.5) / samples;
            points.push_back(point_of(piece.curve, t));
            tangents.push_back(tangent_of(piece.curve, t));
        }
    }
    const PointTree tree(points, monitor);
    Pulse pulse(monitor);
    constexpr std::size_t most_near = 200;
    constexpr double right_angle = 0.25;  // cosine of the angle that still counts
    constexpr double right_angle_beside = 0.45;
    constexpr double parallel = 0.97;  // cosine of the angle up to which lines run side by side
    std::vector<PointTree::Near> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        tree.nearest(points[i], std::min(most, least_distance_), most_near, found);
        for (const PointTree::Near& near : found) {
            pulse();
            const double length = std::sqrt(near.square);
            const glm::dvec2 way = points[near.id] - points[i];
            const double along =
                std::max(std::fabs(glm::dot(way, tangents[i])), std::fabs(glm::dot(way, tangents[near.id])));
            const bool is_beside = std::fabs(glm::dot(tangents[i], tangents[near.id])) > parallel;
            if (length < 1e-6 || along > (is_beside ? right_angle_beside : right_angle) * length) continue;
            // Points of lines side by side need not lie opposite each other.
            least_distance_ = std::min(least_distance_, is_beside ? std::sqrt(near.square - along * along) : length);
        }
    }
}

BandLook LineBands::look(const Print& print) const {
    BandLook look;
    const double unit = style_.stroke.in_steps ? 1.0 : 1 / print.placement.step;
    double widest = 0;
    for (const CurvePiece& piece : lines_.pieces) widest = std::max(widest, print.style.pen_width(piece.pen));
    look.width = widest * unit;
    look.count = style_.parallel.count;
    look.wanted = look.spacing = style_.parallel.spacing * look.width;
    const double gap = style_.weave.value_or(0);
    if (look.count > 1) {
        const int between = look.count - 1;
        look.spacing =
            std::min({look.spacing, 2 * tightest_inside * least_radius_ / between, 2 * least_corner_ / between,
                      2 * least_tip_ / between, least_distance_ / (look.count + beside)});
        if (style_.weave) look.spacing = std::min(look.spacing, 0.9 * least_run_ / (look.count + gap));
        if (!(look.spacing >= std::min(least_spacing, look.wanted))) {
            throw std::runtime_error("parallel lines do not fit: a line turns too tightly or lies too near another");
        }
        if (look.spacing < look.wanted) look.thinner = std::min(1.0, least_share * look.spacing / look.width);
        look.width *= look.thinner;
    }
    look.gap = gap * look.width;
    return look;
}

/// The position, from a pass under another line on, at which a strand is far enough from that line.
double LineBands::cut(std::size_t line, std::size_t pass, bool is_forward, double offset,
                      const BandLook& look) const {
    const auto& passes = diagram_.diagram.lines[line].passes;
    const auto& marks = diagram_.marks[line];
    const CurvedLines::Line& own = lines_.lines[line];
    const double at = meetings_.marks[marks[pass]].position;
    const double count = own.count();
    // At most halfway to the next crossing.
    double room = is_forward ? count - at : at;
    if (is_forward && (pass + 1 < marks.size() || own.is_closed)) {
        const bool is_last = pass + 1 == marks.size();
        room = (meetings_.marks[marks[is_last ? 0 : pass + 1]].position + (is_last ? count : 0) - at) / 2;
    } else if (!is_forward && (pass > 0 || own.is_closed)) {
        room = (at - meetings_.marks[marks[pass == 0 ? marks.size() - 1 : pass - 1]].position +
                (pass == 0 ? count : 0)) /
               2;
    }
    const CurveMark& upper_mark = meetings_.marks[upper_[passes[pass].crossing]];
    const CurvedLines::Line& upper = lines_.lines[upper_mark.line];
    const double clear = look.band() / 2 + look.gap + look.width / 2;

    // The upper line nearby, as chords.
    const glm::dvec2 upper_speed = lines_.derivative(upper, upper_mark.position);
    const glm::dvec2 own_speed = lines_.derivative(own, at);
    const double speeds = glm::length(upper_speed) * glm::length(own_speed);
    const double sine = speeds > 0 ? std::fabs(determinant(upper_speed, own_speed)) / speeds : 1;
    constexpr double least_sine = 0.15;
    const double reach = 2.5 * clear / std::max(sine, least_sine);
    constexpr int chords = 96;
    const double extent = std::min(reach / std::max(glm::length(upper_speed), 1e-9), upper.count() * 0.49);
    std::array<glm::dvec2, chords + 1> curve;
    for (int i = 0; i <= chords; ++i) {
        double position = upper_mark.position + extent * (2.0 * i / chords - 1);
        if (!upper.is_closed) position = std::clamp(position, 0.0, static_cast<double>(upper.count()));
        curve[static_cast<std::size_t>(i)] = lines_.at(upper, position);
    }
    const auto is_near = [&](double way) {
        const LinePlace place = lines_.place(own, at + (is_forward ? way : -way));
        const Bezier& bezier = lines_.piece(own, place.piece).curve;
        const glm::dvec2 point = point_of(bezier, place.t) + offset * left_of(tangent_of(bezier, place.t));
        for (std::size_t i = 0; i < chords; ++i) {
            if (distance_to(point, curve[i], curve[i + 1]) < clear) return true;
        }
        return false;
    };
    const double stride = std::min(room / 8, clear / 8 / std::max(glm::length(own_speed), 1e-9));
    double high = stride;
    while (high < room && is_near(high)) high += stride;
    double low = high - stride;
    high = std::min(high, room);
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        (is_near(middle) ? low : high) = middle;
    }
    return at + (is_forward ? high : -high);
}

/// The parts of a strand that are drawn, between its passes under other lines.
LineBands::Sections LineBands::sections(std::size_t line, double offset, const Sections& omitted,
                                        const BandLook& look) const {
    const double count = lines_.lines[line].count();
    const bool is_closed = lines_.lines[line].is_closed;
    Sections cuts;
    if (style_.weave) {
        const auto& passes = diagram_.diagram.lines[line].passes;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            if (diagram_.diagram.is_over(passes[i])) continue;
            cuts.emplace_back(cut(line, i, false, offset, look), cut(line, i, true, offset, look));
        }
    }
    if (cuts.empty()) {
        // Closed lines begin where the strand is drawn.
        double start = 0;
        for (const auto& [from, to] : omitted) {
            if (!is_closed) break;
            if (from < 0) start = to;
            if (to > count) start = to - count;
        }
        return {{start, start + count}};
    }
    Sections found;
    if (!is_closed && cuts.front().first > 0) found.emplace_back(0.0, cuts.front().first);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) found.emplace_back(cuts[i].second, cuts[i + 1].first);
    if (!is_closed && cuts.back().second < count) found.emplace_back(cuts.back().second, count);
    if (is_closed) found.emplace_back(cuts.back().second, cuts.front().first + count);
    return found;
}

/// The parts that a strand leaves out inside of tips, sorted by position.
LineBands::Sections LineBands::left_out(std::size_t line, double offset) const {
    Sections found;
    for (const LineTip& tip : tips_of(line)) {
        if (tip.side * offset <= 0) continue;
        if (const auto crossing = crossing_inside(lines_, tip, std::fabs(offset))) found.push_back(*crossing);
    }
    std::sort(found.begin(), found.end());
    return found;
}

void LineBands::draw(const Print& print, const std::function<int(std::size_t)>& colour, PathSink& sink) const {
    const BandLook bands = look(print);
    for (std::size_t line = 0; line < lines_.lines.size(); ++line) {
        for (int strand = 0; strand < bands.count; ++strand) {
            const double offset = (strand - (bands.count - 1) / 2.0) * bands.spacing;
            const Sections omitted = left_out(line, offset);
            for (const auto& section : sections(line, offset, omitted, bands)) {
                if (section.second <= section.first) continue;
                draw_section(line, section, offset, omitted, bands, colour(line), sink);
            }
        }
    }
}

void LineBands::draw_section(std::size_t line, std::pair<double, double> section, double offset,
                             const Sections& omitted, const BandLook& look, int colour, PathSink& sink) const {
    const CurvedLines::Line& whole = lines_.lines[line];
    const bool is_closed = whole.is_closed && section.second - section.first >= whole.count();
    std::vector<Part> parts;
    const auto add = [&](double from, double to) {
        lines_.visit_between(whole, from, to, [&](const Bezier& curve, const CurvePiece& piece) {
            parts.push_back({curve, &piece});
        });
    };
    double from = section.first;
    for (const double round : {-1.0, 0.0, 1.0}) {
        for (const auto& [begin, end] : omitted) {
            const double shift = round * whole.count();
            if (begin + shift < from || end + shift > section.second) continue;
            add(from, begin + shift);
            from = end + shift;
        }
    }
    add(from, section.second);
    if (parts.empty()) return;
    const auto moved = [&](const Part& part, double t) {
        return offset == 0 ? point_of(part.curve, t)
                           : point_of(part.curve, t) + offset * left_of(tangent_of(part.curve, t));
    };
    // The point where the strand passes from one part to the next: one point in a smooth line, inside of a tip, or a
    // corner of straight ones.
    const auto corner = [&](const Part& before, const Part& after, glm::dvec2& at) {
        if (offset == 0) return at = before.curve[3], true;
        const glm::dvec2 in = tangent_of(before.curve, 1);
        const glm::dvec2 out = tangent_of(after.curve, 0);
        constexpr double one_point = 1e-8;
        if (glm::length(in - out) < 1e-6 || glm::length(moved(before, 1) - moved(after, 0)) < one_point) {
            return at = moved(before, 1), true;
        }
        const bool is_straight = before.piece->is_straight && after.piece->is_straight;
        return is_straight && mitre(before.curve[3], in, out, offset, at);
    };
    const auto pen_of = [&](const Part& part) {
        Pen pen = part.piece->pen;
        pen.width *= look.thinner;
        pen.colour = colour >= 0 ? colour : style_.index(pen);
        return pen;
    };
    glm::dvec2 start = moved(parts.front(), 0);
    if (is_closed && !corner(parts.back(), parts.front(), start)) start = moved(parts.front(), 0);
    glm::dvec2 at = start;
    Pen pen = pen_of(parts.front());
    sink.begin_stroke(start, pen);
    std::vector<glm::dvec2> controls;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        if (const Pen own = pen_of(part); own != pen) sink.change_pen(pen = own);
        const bool is_last = i + 1 == parts.size();
        const Part* after = !is_last ? &parts[i + 1] : is_closed ? &parts.front() : nullptr;
        glm::dvec2 end = moved(part, 1);
        const bool is_joined = after && corner(part, *after, end);
        if (is_last && is_joined) end = start;
        if (part.piece->is_straight) {
            sink.lines(std::span(&end, 1));
        } else {
            controls.clear();
            if (offset == 0) {
                controls.assign(part.curve.begin() + 1, part.curve.end());
            } else {
                add_parallel(part.curve, offset, accuracy * look.width, controls);
            }
            controls.back() = end;
            sink.curves(controls);
        }
        at = end;
        if (!after || is_joined) continue;
        const glm::dvec2 next = is_last ? start : moved(*after, 0);
        if (next != at) sink.lines(std::span(&next, 1));
        at = next;
    }
    sink.end_stroke(is_closed);
}

}  // namespace sikku
