// art/print/clip.h: removes parts of a drawing that lie outside a box.
#pragma once

#include "art/print/page.h"
#include "engine/geometry/path.h"

namespace sikku {

/// Passes on the parts of a drawing that may be visible in a box; a stroke that leaves the box and returns is split.
class ClipSink : public PathSink {
public:
    /// @param box  in steps, including the width of the pen around it
    ClipSink(PathSink& sink, const Box& box) : sink_(sink), box_(box) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

private:
    bool overlaps(const Box& box) const;
    bool sees(std::span<const glm::dvec2> points) const;
    void lift(bool closed);
    void start();

    PathSink& sink_;
    Box box_;
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool is_down_ = false;
    bool is_whole_ = true;  ///< the stroke has not been cut so far
};

}  // namespace sikku
