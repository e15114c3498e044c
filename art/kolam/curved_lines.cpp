#include "art/kolam/curved_lines.h"

#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sikku {
namespace {

constexpr std::uint32_t no_end = std::numeric_limits<std::uint32_t>::max();

}  // namespace

LinePlace CurvedLines::place(const Line& line, double position) const {
    const double count = line.count();
    if (line.is_closed && position >= count) position -= count;
    if (line.is_closed && position < 0) position += count;
    const double number = std::clamp(std::floor(position), 0.0, count - 1);
    return {static_cast<std::uint32_t>(number), std::clamp(position - number, 0.0, 1.0)};
}

glm::dvec2 CurvedLines::at(const Line& line, double position) const {
    const LinePlace found = place(line, position);
    return point_of(piece(line, found.piece).curve, found.t);
}

glm::dvec2 CurvedLines::derivative(const Line& line, double position) const {
    const LinePlace found = place(line, position);
    return derivative_of(piece(line, found.piece).curve, found.t);
}

void CurveReader::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start;
    is_seen_ = false;
    change_pen(pen);
}

void CurveReader::add(const Bezier& curve, bool is_straight) {
    if (pieces_.size() >= most_) {
        throw BudgetError(
            fmt::format("the drawing has more than {} segments, which exceeds the budget; use a shorter derivation "
                        "or a larger budget",
                        most_));
    }
    pieces_.push_back({curve, pen_, is_straight});
}

void CurveReader::lines(std::span<const glm::dvec2> ends) {
    for (const glm::dvec2 end : ends) {
        if (is_seen_ && end != at_) add(straight_curve(at_, end), true);
        at_ = end;
    }
}

void CurveReader::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        const Bezier curve = {at_, controls[i], controls[i + 1], controls[i + 2]};
        const bool is_point = curve[0] == curve[1] && curve[1] == curve[2] && curve[2] == curve[3];
        if (is_seen_ && !is_point) add(curve, false);
        at_ = controls[i + 2];
    }
}

void CurveReader::change_pen(const Pen& pen) {
    pen_ = pen;
    const bool is_seen = draws_(pen);
    if (is_seen == is_seen_) return;
    if (is_seen) {
        strokes_.push_back({pieces_.size(), pieces_.size()});
    } else {
        end_seen();
    }
    is_seen_ = is_seen;
}

void CurveReader::end_stroke(bool) {
    if (is_seen_) end_seen();
    is_seen_ = false;
}

void CurveReader::end_seen() {
    strokes_.back().end = pieces_.size();
    if (strokes_.back().begin == strokes_.back().end) strokes_.pop_back();
}

void CurveReader::append(CurvedLines& result, const Stroke& stroke, bool is_reversed) const {
    for (std::size_t i = stroke.begin; i < stroke.end; ++i) {
        CurvePiece piece = pieces_[is_reversed ? stroke.end - 1 - (i - stroke.begin) : i];
        if (is_reversed) std::reverse(piece.curve.begin(), piece.curve.end());
        // Exactly at the end of the piece before.
        const bool is_first = result.pieces.size() == result.lines.back().begin;
        if (!is_first) piece.curve[0] = result.pieces.back().curve[3];
        result.pieces.push_back(piece);
    }
}

CurvedLines CurveReader::finish(const KolamExamination& examination) {
    CurvedLines result;
    result.pieces.reserve(pieces_.size());
    const bool is_same = examination.continuation.size() == 2 * strokes_.size();
    const auto after = [&](std::uint32_t end) {
        if (is_same) return examination.continuation[end];
        const Stroke& stroke = strokes_[end / 2];
        return pieces_[stroke.begin].curve[0] == pieces_[stroke.end - 1].curve[3] ? end ^ 1 : no_end;
    };
    std::vector<bool> is_done(strokes_.size(), false);
    for (std::uint32_t stroke = 0; stroke < strokes_.size(); ++stroke) {
        if (is_done[stroke]) continue;
        // From the beginning of an open line.
        std::uint32_t first = 2 * stroke;
        while (after(first) != no_end && after(first) / 2 != stroke) first = after(first) ^ 1;
        if (after(first) != no_end) first = 2 * stroke;
        CurvedLines::Line& line = result.lines.emplace_back();
        line.begin = result.pieces.size();
        line.orbit = is_same ? examination.orbit_of_line[examination.line_of_stroke[stroke]] : stroke;
        std::uint32_t end = first;
        do {
            is_done[end / 2] = true;
            append(result, strokes_[end / 2], end % 2 == 1);
            end = after(end ^ 1);
        } while (end != no_end && end != first);
        line.is_closed = end != no_end;
        line.end = result.pieces.size();
        if (line.is_closed) result.pieces.back().curve[3] = result.pieces[line.begin].curve[0];
    }
    return result;
}

}  // namespace sikku
