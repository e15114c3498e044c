// art/analysis.h: the drawing of a document as data: its lines as points, its examination as a kolam.
#pragma once

#include "art/kolam/kolam.h"
#include "engine/base/monitor.h"
#include "engine/geometry/polylines.h"
#include "engine/language/document.h"

#include <variant>

namespace sikku {

/// The lines of a drawing in the plane or in space.
using DrawnLines = std::variant<Polylines<glm::dvec2>, Polylines<glm::dvec3>>;

/// The visible lines that the turtle draws for a document, in turtle steps: control polygons where it asks for
/// splines. @param budget  maximum number of derivation nodes visited
/// @throws PatternError, BudgetError, WordError, Stopped
DrawnLines drawn_lines(const Document& document, double budget, const Monitor& monitor);

/// Examines the drawing of a document as a kolam. @param budget  as in KolamOptions
/// @throws PatternError, BudgetError, WordError, Stopped; std::runtime_error if no segment is drawn
KolamExamination examine_kolam(const Document& document, double budget, const Monitor& monitor);

}  // namespace sikku
