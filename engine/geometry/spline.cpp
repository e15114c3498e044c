#include "engine/geometry/spline.h"

#include <algorithm>

namespace sikku {

void SplineSink::begin_stroke(glm::dvec2 start, const Pen& pen) {
    is_closed_ = stroke_ < closed_.size() && closed_[stroke_];
    ++stroke_;
    begun_ = false;
    pen_ = pen;
    count_ = 0;
    outlines_.begin_stroke(start, is_closed_);
    add(start);
}

void SplineSink::lines(std::span<const glm::dvec2> ends) {
    for (const glm::dvec2 end : ends) {
        outlines_.control(end);
        add(end);
    }
}

void SplineSink::curves(std::span<const glm::dvec2> controls) {
    // Only the ends of existing curves become control points.
    for (std::size_t i = 2; i < controls.size(); i += 3) lines(controls.subspan(i, 1));
}

/// Passes a piece of the curve on as soon as no later point can change it.
void SplineSink::add(glm::dvec2 point) {
    recent_[count_ % recent_.size()] = {point, pen_};
    if (count_ < first_.size()) first_[count_] = {point, pen_};
    ++count_;
    const std::size_t last = count_ - 1;
    if (is_closed_ && last >= 3) {
        emit(uniform(recent(last - 3), recent(last - 2), recent(last - 1), recent(last)), recent(last - 1).pen);
    } else if (!is_closed_ && last >= 5) {
        // As many segments as there are now are enough for this span's knots to be far from the end.
        emit(clamped(last - 5, last), recent(last - 3).pen);
    }
}

void SplineSink::end_stroke(bool) {
    const std::size_t segments = count_ - 1;
    if (is_closed_ && segments >= 3) {
        // The last control point is the first again.
        emit(uniform(recent(segments - 2), recent(segments - 1), first_[0], first_[1]), recent(segments).pen);
        emit(uniform(recent(segments - 1), first_[0], first_[1], first_[2]), first_[1].pen);
    } else if (!is_closed_ && segments >= 4) {
        for (std::size_t span = segments - 4; span <= segments - 3; ++span) {
            emit(clamped(span, segments), recent(span + 2).pen);
        }
    } else {
        emit_short();
    }
    flush();
    outlines_.end_stroke();
    sink_.end_stroke(is_closed_);
}

/// Fewer than 4 segments (3 if closed) are few enough to be processed together.
void SplineSink::emit_short() {
    const std::size_t segments = count_ - 1;
    std::vector<Control> controls(recent_.begin(), recent_.begin() + static_cast<std::ptrdiff_t>(count_));
    if (is_closed_) {
        controls.pop_back();
        for (std::size_t i = 0; i < 3; ++i) controls.push_back(controls[i]);
    } else {
        controls.insert(controls.begin(), 2, controls.front());
        controls.insert(controls.end(), 2, controls.back());
    }
    for (std::size_t i = 0; i + 3 < controls.size(); ++i) {
        const std::size_t segment = is_closed_ ? (i + 1) % segments + 1 : std::clamp<std::size_t>(i, 1, segments);
        emit(uniform(controls[i], controls[i + 1], controls[i + 2], controls[i + 3]), recent(segment).pen);
    }
}

Bezier SplineSink::uniform(const Control& a, const Control& b, const Control& c, const Control& d) const {
    return {(a.at + 4.0 * b.at + c.at) / 6.0, (2.0 * b.at + c.at) / 3.0, (b.at + 2.0 * c.at) / 3.0,
            (b.at + 4.0 * c.at + d.at) / 6.0};
}

/// The piece of a clamped spline over points span … span + 3, by its blossom: the knots are whole numbers, those at
/// the two ends four times.
Bezier SplineSink::clamped(std::size_t span, std::size_t segments) const {
    const auto knot = [&](std::size_t index) {
        return static_cast<double>(std::clamp<std::size_t>(index, 3, segments + 1) - 3);
    };
    const std::size_t j = span + 3;
    const auto blossom = [&](double u, double v, double w) {
        const std::array<double, 3> arguments = {u, v, w};
        return de_boor({recent(span).at, recent(span + 1).at, recent(span + 2).at, recent(span + 3).at},
                       [&](std::size_t level, std::size_t i) {
                           const double low = knot(j - 2 + level + i);
                           return (arguments[level] - low) / (knot(j + 1 + i) - low);
                       });
    };
    const double a = knot(j);
    const double b = knot(j + 1);
    return {blossom(a, a, a), blossom(a, a, b), blossom(a, b, b), blossom(b, b, b)};
}

void SplineSink::emit(const Bezier& bezier, const Pen& pen) {
    if (!begun_) {
        begun_ = true;
        sent_ = pen;
        sink_.begin_stroke(bezier[0], pen);
    } else if (sent_ != pen) {
        flush();
        sent_ = pen;
        sink_.change_pen(pen);
    }
    outlines_.piece(bezier);
    controls_.insert(controls_.end(), bezier.begin() + 1, bezier.end());
    if (controls_.size() >= 3 * 340) flush();
}

void SplineSink::flush() {
    if (controls_.empty()) return;
    sink_.curves(controls_);
    controls_.clear();
}

}  // namespace sikku
