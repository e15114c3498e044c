#include "art/plotter/passes.h"

#include "art/plotter/shading.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

double square(glm::dvec2 way) {
    return glm::dot(way, way);
}

/// The direction of a Bézier at its first point.
glm::dvec2 leaving(const Bezier& b) {
    for (std::size_t i = 1; i < 4; ++i) {
        if (b[i] != b[0]) return glm::normalize(b[i] - b[0]);
    }
    return {0.0, 0.0};
}

/// A piece of a stroke with the directions at its ends.
struct Part {
    bool is_curve = false;
    Bezier bezier;  ///< for a line, only the end points matter
    glm::dvec2 out{0.0}, in{0.0};

    double length() const { return glm::distance(bezier[0], bezier[3]); }
};

std::vector<Part> parts_of(const PenPath& stroke) {
    std::vector<Part> parts;
    glm::dvec2 at = stroke.start;
    for (const PenPath::Piece& piece : stroke.pieces) {
        const glm::dvec2 from = std::exchange(at, piece.end);
        Part part{piece.is_curve, {from, piece.first, piece.second, piece.end}};
        if (!piece.is_curve) part.bezier = {from, from, piece.end, piece.end};
        part.out = leaving(part.bezier);
        part.in = -leaving({piece.end, part.bezier[2], part.bezier[1], from});
        if (part.out != glm::dvec2(0.0)) parts.push_back(part);
    }
    return parts;
}

/// One pass along a stroke.
class Pass {
public:
    Pass(std::span<const Part> parts, bool is_closed, double offset, double tolerance)
        : parts_(parts), offset_(offset), tolerance_(tolerance) {
        path_.is_closed = is_closed;
    }

    /// @param beyond  extension of an open stroke at both ends
    PenPath path(double beyond) {
        const std::size_t count = parts_.size();
        const Part &first = parts_.front(), &last = parts_.back();
        const double closing = path_.is_closed ? trim(last, first) : 0.0;
        double trimmed = closing;
        path_.start = first.bezier[0] + offset_ * left_of(first.out) + trimmed * first.out;
        if (!path_.is_closed && beyond > 0) {
            const glm::dvec2 joined = path_.start;
            path_.start -= beyond * first.out;
            line(joined);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Part& part = parts_[i];
            const bool is_last = i + 1 == count;
            const Part& next = parts_[is_last ? 0 : i + 1];
            const double cut = !is_last ? trim(part, next) : closing;
            if (part.is_curve) {
                follow(part.bezier, 0);
            } else {
                line(part.bezier[3] + offset_ * left_of(part.in) - cut * part.in);
            }
            if (is_last && !path_.is_closed) break;
            // At a corner, offset lines are either trimmed or connected around it.
            if (!(cut > 0)) corner(part, next);
        }
        if (!path_.is_closed && beyond > 0) line(end() + beyond * last.in);
        if (path_.is_closed && !path_.pieces.empty()) path_.pieces.back().end = path_.start;
        return std::move(path_);
    }

private:
    glm::dvec2 end() const { return path_.pieces.empty() ? path_.start : path_.pieces.back().end; }
    void line(glm::dvec2 to) {
        if (to != end()) path_.pieces.push_back({false, {}, {}, to});
    }

    /// Length trimmed from two lines at the inside of a corner; 0 if they are not trimmed.
    double trim(const Part& part, const Part& next) const {
        const double turn = determinant(part.in, next.out);
        if (part.is_curve || next.is_curve || offset_ * turn <= 0) return 0;
        const double cut = std::fabs(offset_ * turn) / (1 + glm::dot(part.in, next.out));
        return cut < 0.5 * std::min(part.length(), next.length()) ? cut : 0;
    }

    /// Connects around a corner: by an arc on the outside, by a line within the stroke on the inside.
    void corner(const Part& part, const Part& next) {
        const glm::dvec2 at = part.bezier[3];
        const glm::dvec2 to = at + offset_ * left_of(next.out);
        const double turn = std::atan2(determinant(part.in, next.out), glm::dot(part.in, next.out));
        if (std::fabs(turn * offset_) <= tolerance_) return;
        const bool is_back = std::fabs(turn) > std::numbers::pi - 1e-9;
        if (offset_ * turn > 0 && !is_back) return line(to);
        const double sweep = is_back ? std::copysign(std::numbers::pi, -offset_) : turn;
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / 0.8)));
        const double step = sweep / pieces;
        const double handle = 4.0 / 3.0 * std::tan(step / 4);
        glm::dvec2 from = offset_ * left_of(part.in);
        for (int i = 0; i < pieces; ++i) {
            const glm::dvec2 turned(from.x * std::cos(step) - from.y * std::sin(step),
                                    from.x * std::sin(step) + from.y * std::cos(step));
            path_.pieces.push_back(
                {true, at + from + handle * left_of(from), at + turned - handle * left_of(turned), at + turned});
            from = turned;
        }
        path_.pieces.back().end = to;
    }

    /// Adds the offset of a Bézier. Its tangents have the directions of the curve's, with lengths from its speed; the
    /// curve is halved until the middle is within the tolerance.
    void follow(const Bezier& b, int depth) {
        const Bezier reversed = {b[3], b[2], b[1], b[0]};
        const glm::dvec2 out = leaving(b), in = -leaving(reversed);
        if (out == glm::dvec2(0.0)) return;
        const glm::dvec2 from = b[0] + offset_ * left_of(out), to = b[3] + offset_ * left_of(in);
        const auto speed = [&](const Bezier& curve, double side) {
            const glm::dvec2 first = curve[1] - curve[0];
            const double length = square(first);
            if (!(length > 0)) return 1.0;
            const double bend = 2.0 / 3.0 * determinant(first, curve[2] - curve[1]) / (length * std::sqrt(length));
            return 1 - side * offset_ * bend;
        };
        const Bezier found = {from, from + speed(b, 1) * (b[1] - b[0]), to + speed(reversed, -1) * (b[2] - b[3]), to};
        const glm::dvec2 middle = part_of(b, 0, 0.5)[3];
        const Bezier half = part_of(b, 0.5, 1);
        const glm::dvec2 way = leaving(half);
        const glm::dvec2 off = part_of(found, 0, 0.5)[3] - middle;
        // Compare across the curve only: along it the parametrisation may differ.
        const bool is_close = std::fabs(glm::dot(off, left_of(way)) - offset_) <= tolerance_ &&
                              std::fabs(glm::dot(off, way)) <= 0.1 * glm::distance(from, to) + tolerance_;
        if (is_close || depth == 8) {
            path_.pieces.push_back({true, found[1], found[2], found[3]});
            return;
        }
        follow(part_of(b, 0, 0.5), depth + 1);
        follow(half, depth + 1);
    }

    std::span<const Part> parts_;
    double offset_, tolerance_;
    PenPath path_;
};

PenPath reversed(const PenPath& path) {
    PenPath result;
    result.is_closed = path.is_closed;
    result.start = path.pieces.back().end;
    for (std::size_t i = path.pieces.size(); i-- > 0;) {
        const PenPath::Piece& piece = path.pieces[i];
        result.pieces.push_back(
            {piece.is_curve, piece.second, piece.first, i > 0 ? path.pieces[i - 1].end : path.start});
    }
    return result;
}

}  // namespace

std::size_t pass_count(double width, double pen) {
    return static_cast<std::size_t>(std::clamp(std::ceil(width / pen - 0.1), 1.0, 1e5));
}

void require_few_passes(std::size_t pieces, std::size_t passes) {
    constexpr std::size_t most = 20'000'000;
    if (pieces > most / passes) {
        throw std::runtime_error("the passes of one stroke would have over 20 million pieces; use a wider pen");
    }
}

std::vector<double> pass_offsets(double width, double pen) {
    std::vector<double> offsets(pass_count(width, pen));
    const auto count = static_cast<double>(offsets.size());
    const double apart = count > 1 ? std::min(pen, (width - pen) / (count - 1)) : 0.0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        offsets[i] = (static_cast<double>(i) - (count - 1) / 2) * apart;
    }
    return offsets;
}

std::vector<PenPath> pen_passes(const PenPath& stroke, double width, double pen, double tolerance) {
    const std::vector<double> offsets = pass_offsets(width, pen);
    if (offsets.size() == 1) return {stroke};
    require_few_passes(stroke.pieces.size(), offsets.size());
    const std::vector<Part> parts = parts_of(stroke);
    std::vector<PenPath> result;
    if (parts.empty()) {
        const std::vector<glm::dvec2> dot = spiral(stroke.start, width / 2, pen);
        PenPath& path = result.emplace_back(PenPath{dot.front(), {}, false});
        for (std::size_t i = 1; i + 2 < dot.size(); i += 3) {
            path.pieces.push_back({true, dot[i], dot[i + 1], dot[i + 2]});
        }
        return result;
    }
    const double widest = offsets.back();
    for (const double offset : offsets) {
        const double beyond = std::sqrt(std::max(0.0, widest * widest - offset * offset));
        PenPath path = Pass(parts, stroke.is_closed, offset, tolerance).path(beyond);
        if (path.pieces.empty()) continue;
        if (stroke.is_closed || result.empty()) {
            result.push_back(std::move(path));
            continue;
        }
        // Open strokes go back and forth.
        PenPath& whole = result.front();
        if (glm::distance(whole.pieces.back().end, path.start) >
            glm::distance(whole.pieces.back().end, path.pieces.back().end)) {
            path = reversed(path);
        }
        whole.pieces.push_back({false, {}, {}, path.start});
        whole.pieces.insert(whole.pieces.end(), path.pieces.begin(), path.pieces.end());
    }
    return result;
}

}  // namespace sikku
