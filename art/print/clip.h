// art/print/clip.h: removes parts of a drawing that lie outside a box.
#pragma once

#include "art/print/page.h"
#include "engine/geometry/path.h"

namespace sikku {

/// Passes on parts of strokes: a stroke that is cut continues as another one.
class CutStrokes : public PathSink {
public:
    explicit CutStrokes(PathSink& sink) : sink_(sink) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) final {
        at_ = start;
        pen_ = pen;
        is_whole_ = true;
    }
    void change_pen(const Pen& pen) final {
        pen_ = pen;
        if (is_down_) sink_.change_pen(pen);
    }
    void end_stroke(bool closed) final { lift(closed && is_whole_); }

protected:
    void lower(glm::dvec2 at) {
        if (!is_down_) sink_.begin_stroke(at, pen_);
        is_down_ = true;
    }
    void lift(bool closed) {
        if (is_down_) sink_.end_stroke(closed);
        is_down_ = false;
    }

    PathSink& sink_;
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool is_down_ = false;
    bool is_whole_ = true;  ///< the stroke has not been cut so far
};

/// Passes on the parts of a drawing that may be visible in a box; a stroke that leaves the box and returns is split.
class ClipSink : public CutStrokes {
public:
    /// @param box  in steps, including the width of the pen around it
    ClipSink(PathSink& sink, const Box& box) : CutStrokes(sink), box_(box) {}

    void lines(std::span<const glm::dvec2> ends) override { draw(ends, 1, &PathSink::lines); }
    void curves(std::span<const glm::dvec2> controls) override { draw(controls, 3, &PathSink::curves); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

private:
    bool overlaps(const Box& box) const;
    bool sees(std::span<const glm::dvec2> points) const;
    void draw(std::span<const glm::dvec2> points, std::size_t stride,
              void (PathSink::*pass)(std::span<const glm::dvec2>));

    Box box_;
};

}  // namespace sikku
