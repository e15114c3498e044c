// art/kolam/curve_intersections.h: intersects Béziers and segments.
#pragma once

#include "engine/geometry/bezier.h"

#include <functional>

namespace sikku {

/// Finds where curves meet. A meeting may be reported several times, with slightly different parameters.
class CurveIntersections {
public:
    /// Receives the parameters of a meeting on the first and the second curve.
    using Note = std::function<void(double, double)>;

    /// Reports the meetings of two curves, ends included. @throws std::runtime_error if they run along each other
    void of_two(const Bezier& a, const Bezier& b, const Note& note);
    /// Reports the meetings of two curves, the second of which begins where the first ends, except that point.
    void of_neighbours(const Bezier& a, const Bezier& b, const Note& note);
    /// Reports where a curve crosses itself.
    void of_one(const Bezier& curve, const Note& note);
    /// Reports the meetings of two segments, ends included; if they overlap, the ends of each on the other.
    static void of_segments(const Bezier& a, const Bezier& b, const Note& note);

private:
    struct Part {
        Bezier curve;
        double from = 0.0, to = 1.0;
        double middle() const { return (from + to) / 2; }
    };
    void begin(const Bezier& a, const Bezier& b, const Note& note);
    static Part half(const Part& part, bool is_second);
    void meet(const Part& a, const Part& b, int depth);
    void meet_neighbours(const Part& a, const Part& b, int depth);
    void meet_self(const Part& part, int depth);
    void settle(const Part& a, const Part& b, double t, double s);

    const Bezier* first_ = nullptr;
    const Bezier* second_ = nullptr;
    const Note* note_ = nullptr;
    int contacts_ = 0;
};

}  // namespace sikku
