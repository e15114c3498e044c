// art/writer/make_drawing.h: makes the drawing of a grammar from drawings of all rooms.
#pragma once

#include "art/drawing/drawing.h"
#include "art/drawing/drawing_cost.h"

#include <memory>

namespace sikku {

struct DrawOptions;

/// Makes the drawing of a grammar: read from the word, or through a view if there is one, with the dots, strand
/// colours and frame that `style` and `options` request.
/// @throws BudgetError, WordError; std::runtime_error if it cannot be drawn
std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                                      const Reading& reading);

/// The same for a print.
std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options);

/// Adds the border and the line of text that `style` and `options` request, if they request any.
/// @throws BudgetError, WordError; std::runtime_error if the border's pattern cannot be drawn
std::unique_ptr<Drawing> with_frame(std::unique_ptr<Drawing> drawing, const Style& style,
                                    const DrawingOptions& options, const Reading& reading);

/// Forecasts the cost of make_drawing() and one print. Uses the page, the style and the resolution of `print`.
/// @throws BudgetError if the word is too long to be read
DrawingCost drawing_cost(const Grammar& grammar, const Print& print, const DrawingOptions& options,
                         const Reading& reading);

}  // namespace sikku
