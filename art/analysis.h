// art/analysis.h: the drawing of a document as data: lines as arrays of points, and the examination of a kolam.
#pragma once

#include "art/kolam/kolam.h"
#include "engine/base/monitor.h"
#include "engine/geometry/polylines.h"
#include "engine/language/document.h"

#include <variant>

namespace sikku {

/// The lines of a drawing in the plane or in space.
using DrawnLines = std::variant<Polylines<glm::dvec2>, Polylines<glm::dvec3>>;

/// Traces the visible lines of a document, in turtle steps; splines are given as control polygons.
/// @param budget  maximum number of derivation nodes visited
/// @throws PatternError, BudgetError, WordError, Stopped
DrawnLines drawn_lines(const Document& document, double budget, const Monitor& monitor);

/// Examines the drawing of a document as a kolam. @param budget  as in KolamOptions
/// @throws PatternError, BudgetError, WordError, Stopped; std::runtime_error if no segment is drawn
KolamExamination examine_kolam(const Document& document, double budget, const Monitor& monitor);

/// True if a window of any depth shows the drawing at the cost of its visible part.
bool has_view(const Document& document);

}  // namespace sikku
