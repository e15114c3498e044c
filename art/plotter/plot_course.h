// art/plotter/plot_course.h: the course of a plot: strokes split, resumed, and interrupted to refill the pen.
#pragma once

#include "art/plotter/plot_layer.h"
#include "engine/base/monitor.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace sikku {

/// A part of a stroke that is drawn without lifting the pen, or, without ends, a visit to the ink.
struct PlotPiece {
    const PlotLayer& layer;
    std::span<const PlotEnd> ends;
    bool closed = false;
    std::optional<glm::dvec2> dip{};  ///< place of the ink, in millimetres from the bottom left corner of the page
};

/// Lengths are millimetres.
struct PlotCourse {
    double step = 1.0;               ///< length of one pattern unit
    double split = 0.0;              ///< maximum length of a piece; 0: none
    double resume = 0.0;             ///< length drawn before: the course begins with the segment in which it ends
    std::optional<Refill> refill{};  ///< refill of pens without their own
};

/// Visits all pieces in order. Strokes are cut only between segments. A pen is dipped before its first piece, and
/// before a stroke or segment for which its filling does not suffice; a stroke for which one filling suffices is not
/// interrupted. Returns the length that was skipped or drawn, in millimetres. @throws Stopped
double follow_course(std::span<const std::unique_ptr<PlotLayer>> layers, const PlotCourse& course,
                     const Monitor& monitor, const std::function<void(const PlotPiece&)>& visit);

}  // namespace sikku
