// art/style/contrast.h: how clearly colours differ to the eye.
#pragma once

#include "art/style/colour.h"

namespace sikku {

/// The CIE 1976 colour difference ΔE*ab of two colours: 2 is barely visible, 100 is black to white; ignores alpha.
/// Source: ISO/CIE 11664-4; sRGB (IEC 61966-2-1) with its white.
double colour_difference(Colour a, Colour b);

/// Composites a colour over an opaque one.
Colour laid_over(Colour colour, Colour ground);

}  // namespace sikku
