#include "engine/geometry/spline.h"

#include <algorithm>
#include <cmath>

namespace sikku {

void SplineOutlines::begin_stroke(glm::dvec2 start, bool closed) {
    if (is_idle()) {
        first_stroke_ += strokes_.size();
        strokes_.clear();
    }
    strokes_.push_back({pieces_, 0, 1, closed, false});
    down_ = true;
    at_ = start;
}

void SplineOutlines::control(glm::dvec2 point) {
    const std::size_t index = strokes_.back().controls++;
    const glm::dvec2 before = at_;
    at_ = point;
    if (open_.empty()) return;
    Outline& outline = open_.back();
    Run& last = outline.runs.back();
    if (!last.is_point && last.stroke == current() && last.to + 1 == index) {
        last.to = index;
    } else if (outline.last == before) {
        // The stroke begins or continues at the outline's current point.
        if (last.is_point || last.from == last.to) outline.runs.pop_back();
        outline.runs.push_back({current(), index - 1, index});
    } else {
        outline.runs.push_back({current(), index, index});
    }
    outline.last = point;
}

void SplineOutlines::piece(const Bezier& bezier) {
    ++pieces_;
    ++strokes_.back().pieces;
    if (is_idle()) return;
    if (kept_.empty()) first_kept_ = pieces_ - 1;
    kept_.push_back(bezier);
    settle();
    if (kept_.size() >= forget_at_) forget();
}

void SplineOutlines::end_stroke() {
    strokes_.back().ended = true;
    down_ = false;
    settle();
}

void SplineOutlines::begin(glm::dvec2 at) {
    Outline outline;
    outline.last = at;
    outline.piece = pieces_;
    outline.stroke = down_ ? current() : first_stroke_ + strokes_.size();
    if (down_) {
        const std::size_t index = strokes_.back().controls - 1;
        outline.runs.push_back({current(), index, index});
    } else {
        outline.runs.push_back({.is_point = true, .at = at});
    }
    open_.push_back(std::move(outline));
}

void SplineOutlines::vertex(glm::dvec2 at) {
    if (open_.empty()) return;
    open_.back().runs.push_back({.is_point = true, .at = at});
    open_.back().last = at;
}

void SplineOutlines::end(const Pen& pen, bool is_area) {
    if (open_.empty()) return;
    if (is_area) {
        open_.back().pen = pen;
        waiting_.push_back(std::move(open_.back()));
    }
    open_.pop_back();
    settle();
}

/// True if all curves of the run are known.
bool SplineOutlines::is_known(const Run& run) const {
    if (run.is_point || stroke(run).ended) return true;
    const Stroke& drawn = stroke(run);
    // A closed curve begins after its first edge, which comes last; the end of an open one has knots of its own.
    if (drawn.closed ? run.from == 0 : drawn.controls <= run.to + 3) return false;
    return drawn.pieces >= std::max<std::size_t>(run.to, 2) - 1;
}

void SplineOutlines::settle() {
    while (!waiting_.empty()) {
        const Outline& next = waiting_.front();
        const auto last = std::find_if(next.runs.rbegin(), next.runs.rend(),
                                       [&](const Run& run) { return !run.is_point && run.stroke != current(); });
        if (!std::all_of(next.runs.rbegin(), last, [&](const Run& run) { return is_known(run); })) return;
        pass_on(next);
        waiting_.pop_front();
    }
    if (!open_.empty()) return;
    kept_.clear();
    forget_at_ = 1024;
}

/// Drops data that no outline needs any longer.
void SplineOutlines::forget() {
    std::uint64_t piece = pieces_;
    std::uint64_t stroke = current();
    const auto needs = [&](const Outline& outline) {
        piece = std::min(piece, outline.piece);
        stroke = std::min(stroke, outline.stroke);
    };
    std::for_each(waiting_.begin(), waiting_.end(), needs);
    if (!open_.empty()) needs(open_.front());
    if (piece > first_kept_) {
        kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(piece - first_kept_));
        first_kept_ = piece;
    }
    for (; first_stroke_ < stroke; ++first_stroke_) strokes_.pop_front();
    forget_at_ = std::max<std::size_t>(1024, 2 * kept_.size());
}

/// Position of a control point along the stroke's curve, in Béziers. While a stroke continues, no requested control
/// point is near its end.
double SplineOutlines::parameter(const Stroke& stroke, std::size_t control) const {
    const auto k = static_cast<double>(control);
    const auto end = static_cast<double>(stroke.pieces);
    if (stroke.closed) return k - 1;
    const std::size_t segments = stroke.controls - 1;
    if (stroke.ended && control == segments) return end;
    if (control == 0) return 0;
    // With fewer than four segments, the end points count three times.
    if (stroke.ended && segments < 4) return k + 1;
    if (stroke.ended && control + 1 == segments) return end - 1.0 / 3;
    return control == 1 ? 1.0 / 3 : k - 1;
}

const Bezier& SplineOutlines::bezier(const Stroke& stroke, double number) const {
    const std::uint64_t index = number < 0 ? stroke.pieces - 1 : static_cast<std::uint64_t>(number);
    return kept_[stroke.first_piece + index - first_kept_];
}

void SplineOutlines::pass_on(const Outline& outline) {
    points_.clear();
    const auto line_to = [&](glm::dvec2 end) {
        if (points_.empty()) {
            points_.push_back(end);
        } else if (const glm::dvec2 start = points_.back(); start != end) {
            points_.insert(points_.end(), {(2.0 * start + end) / 3.0, (start + 2.0 * end) / 3.0, end});
        }
    };
    for (const Run& run : outline.runs) {
        if (run.is_point) {
            line_to(run.at);
            continue;
        }
        const Stroke& drawn = stroke(run);
        const double from = parameter(drawn, run.from);
        const double to = parameter(drawn, run.to);
        if (from == to) {
            const double number = from > 0 || drawn.closed ? std::ceil(from) - 1 : 0;
            line_to(part_of(bezier(drawn, number), from - number, from - number)[0]);
            continue;
        }
        for (double number = std::floor(from); number < to; ++number) {
            const double begin = std::max(from - number, 0.0);
            const double end = std::min(to - number, 1.0);
            const Bezier& whole = bezier(drawn, number);
            const Bezier part = begin == 0 && end == 1 ? whole : part_of(whole, begin, end);
            line_to(part[0]);
            points_.insert(points_.end(), part.begin() + 1, part.end());
        }
    }
    sink_.area(points_, outline.pen);
}

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
