// art/motion/division_drawing.h: tiles that divide, at one moment.
#pragma once

#include "art/drawing/drawing.h"
#include "art/motion/division.h"

#include <memory>

namespace sikku {

/// A moment of a division.
struct DivisionMoment {
    std::size_t stage = 0;  ///< number of the stage whose tiles appear
    double share = 1;       ///< share of the time of its division that has passed; 1: at rest
    double fade = 0;        ///< share of the time in which the last stage fades into the first
};

/// The drawing at a moment, in the coordinates of the last stage and with colours added for this moment.
class DivisionDrawing : public Drawing {
public:
    DivisionDrawing(std::shared_ptr<const Division> division, const DivisionMoment& moment,
                    const DrawingOptions& options, const Reading& reading);

    const DrawnExtent& seen() override { return division_->seen; }
    const Style& style() const override { return style_; }
    double scale() const override { return division_->scale; }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;

private:
    /// @param lines  opacity of lines  @param fills  opacity of everything else
    void add_picture(const DivisionStage& stage, double lines, double fills, bool has_polygons);
    void add_parts(const DivisionStage& stage, double share);
    void add_fills(const DivisionStage& stage, double opacity);
    int index_of(Colour colour);

    std::shared_ptr<const Division> division_;
    Style style_;
    RecordedPath path_;
};

/// Draws the lines, discs and areas of a picture without its polygons.
class WithoutPolygons : public PathFilter {
public:
    using Forwarding::Forwarding;
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
};

}  // namespace sikku
