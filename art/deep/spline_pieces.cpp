#include "art/deep/spline_pieces.h"

#include "engine/derivation/derivation.h"

#include <cmath>

namespace sikku {
namespace {

constexpr std::size_t most_points = 1 << 24;

}  // namespace

bool SplinePieces::same(glm::dvec2 a, glm::dvec2 b) const {
    return std::fabs(a.x - b.x) <= tolerance_ && std::fabs(a.y - b.y) <= tolerance_;
}

void SplinePieces::begin(glm::dvec2 start, bool closed) {
    closed_.push_back(closed);
    spline_.begin_stroke(start, pen_);
}

void SplinePieces::begin_line(glm::dvec2 at) {
    line_start_ = at;
    first_.clear();
    may_be_first_ = true;
}

void SplinePieces::begin_stroke(glm::dvec2 start, const Pen& pen) {
    end_last();
    pen_ = pen;
    at_ = start;
    is_first_ = may_be_first_ && same(start, line_start_);
    may_be_first_ = false;
    if (is_first_) {
        first_.push_back(start);
    } else {
        begin(start, false);
        is_open_ = true;
    }
}

void SplinePieces::lines(std::span<const glm::dvec2> ends) {
    if (ends.empty()) return;
    at_ = ends.back();
    if (!is_first_) return spline_.lines(ends);
    if (first_.size() + ends.size() > most_points) {
        throw BudgetError("more than 16,777,216 steps of one line are visible; use a smaller window");
    }
    first_.insert(first_.end(), ends.begin(), ends.end());
}

void SplinePieces::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 2; i < controls.size(); i += 3) lines(controls.subspan(i, 1));
}

void SplinePieces::change_pen(const Pen& pen) {
    pen_ = pen;
    spline_.change_pen(pen);
}

/// A piece may be the last of its line, which is known only at the end of the line.
void SplinePieces::end_stroke(bool) {}

void SplinePieces::end_last() {
    if (is_open_) spline_.end_stroke(false);
    is_open_ = false;
}

void SplinePieces::end_line(glm::dvec2 at) {
    const bool is_closed = same(at, line_start_) && same(at, at_);
    if (!first_.empty()) {
        const std::span<const glm::dvec2> rest = std::span(first_).subspan(1);
        if (is_open_ && is_closed) {
            // Continues over the line's end into its beginning.
            spline_.lines(rest);
        } else {
            end_last();
            begin(first_.front(), is_first_ && is_closed && !rest.empty());
            spline_.lines(rest);
            is_open_ = true;
        }
    }
    end_last();
    is_first_ = false;
    first_.clear();
}

void SplinePieces::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    spline_.polygon(vertices, pen);
}

void SplinePieces::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    spline_.disc(centre, radius, pen);
}

void SplinePieces::label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) {
    spline_.label(text, centre, height, pen);
}

}  // namespace sikku
