#include "art/style/white_paper.h"

#include "art/style/contrast.h"

namespace sikku {
namespace {

constexpr double clear_contrast = 3.0;    // WCAG 2.2, 1.4.11: graphics
constexpr double visible_contrast = 1.5;  // cream and pale yellow have less

bool vanishes(Colour ink) {
    if (ink.alpha == 0) return false;
    return is_faint(ink, white_paper) || contrast_ratio(laid_over(ink, white_paper), white_paper) < visible_contrast;
}

}  // namespace

Colour ink_on_paper(const std::optional<Colour>& ground, Colour other) {
    if (!ground || ground->alpha == 0) return other;
    const Colour solid = laid_over(*ground, white_paper);
    return contrast_ratio(solid, white_paper) >= clear_contrast ? solid : other;
}

void put_on_white_paper(Style& style, const GivenColours& given) {
    const std::optional<Colour> ground = style.ground;
    style.ground = white_paper;
    if (ground && is_faint(white_paper, *ground)) return;
    const Colour ink = ink_on_paper(ground, deep_earth);
    const auto replace = [&](Colour& colour) {
        const bool was_seen = !ground || !is_faint(colour, *ground);
        if (was_seen && vanishes(colour)) colour = ink;
    };
    if (style.stroke_colour && !given.stroke) replace(*style.stroke_colour);
    if (style.fill && !given.fill) replace(*style.fill);
    if (style.dots && style.dots->colour && !given.dots) replace(*style.dots->colour);
    if (given.palette) return;
    for (Colour& colour : style.palette) replace(colour);
}

}  // namespace sikku
