// art/deep/window_drawing.h: a window into a drawing of any size with polygons, colours and discs, such as a
// tiling: only the parts that the window shows are derived.
#pragma once

#include "art/deep/view.h"
#include "art/drawing/drawing.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace sikku {

class Patches;

/// Draws the part within the window of the options, from the window's lower left corner. Parts whose boxes miss the
/// window are skipped; the others are followed down to the smallest parts that are drawings by themselves (a tile),
/// which are recorded once and drawn again at each of their places. Places have 113 bits: to a millionth of a step up
/// to 10^27 steps from the start.
/// Cost: the visible parts, times the derivation length; 0.1 us a node.
class WindowDrawing : public Drawing {
public:
    /// Returns nullptr, with the reason in `why`, if the parts cannot be composed: for words that depend on contexts
    /// or chance, for brackets, polygons and colours that span more than 10,000 symbols, for places or decimal
    /// lengths whose errors add up to a thousandth of a step, for splines, and for ornaments that need the whole
    /// drawing. Also, with `why` unchanged, without a window and for short words, which are better read whole.
    /// @param grammar  with resolved contexts; in the plane
    static std::unique_ptr<WindowDrawing> make(const std::shared_ptr<const Grammar>& grammar, const Style& style,
                                               const DrawingOptions& options, const Reading& reading,
                                               std::string& why);
    ~WindowDrawing() override;

    /// The extent of the window.
    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return style_; }
    double scale() const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void read_samples(PathSink& sink) const override;
    void report(DrawingReport& report) const override;

private:
    WindowDrawing(std::shared_ptr<const Grammar> grammar, std::unique_ptr<Patches> patches, const Style& style,
                  const DrawingOptions& options, const Reading& reading);

    std::shared_ptr<const Grammar> grammar_;  ///< in plain form; the patches refer to it
    std::unique_ptr<Patches> patches_;
    Style style_;
    DrawnExtent extent_;
    mutable bool is_empty_ = true;
};

/// A place of a tiling that covers a page.
struct FilledPage {
    std::int64_t steps = 0;  ///< derivation length
    ViewWindow window;
};

/// Searches for the least derivation length at which polygons cover a window of `size` steps with `around` steps on
/// each side, and for a place where they do. Tries 40 places for each length, by the seed of the grammar. Returns
/// nullopt, with the reason in `why`, like WindowDrawing::make(), or if no place is found up to a length of 500.
/// Cost: the tiles of a page, times the tries.
std::optional<FilledPage> find_filled_page(const Grammar& grammar, const Style& style, glm::dvec2 size, double around,
                                           const ReadingLimits& limits, std::string& why);

}  // namespace sikku
