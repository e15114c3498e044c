// art/drawing/view_window.h: rectangles of a drawing of any size.
#pragma once

#include "engine/base/numbers.h"

#include <optional>
#include <string_view>

namespace sikku {

/// A rectangle of a drawing, in turtle steps, y up: x0 < x1, y0 < y1.
struct ViewWindow {
    Quad x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Parses `X0,Y0,X1,Y1`: four decimal numbers of any length; digits beyond 34 are rounded. Returns nullopt for
/// anything else and for rectangles without area.
std::optional<ViewWindow> parse_window(std::string_view text);

}  // namespace sikku
