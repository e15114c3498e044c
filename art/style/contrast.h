// art/style/contrast.h: how clearly colours differ to the eye.
#pragma once

#include "art/style/colour.h"

namespace sikku {

/// The CIE 1976 colour difference ΔE*ab of two colours: 2 is barely visible, 100 is black to white; ignores alpha.
/// Source: ISO/CIE 11664-4; sRGB (IEC 61966-2-1) with its white.
double colour_difference(Colour a, Colour b);

/// True for a visible ink whose colour differs by less than 15 from that of the ground (see colour_difference()).
bool is_faint(Colour ink, Colour ground);

/// The contrast ratio of two opaque colours, 1 for equal luminance to 21 for black on white.
/// Source: W3C, Web Content Accessibility Guidelines 2.2, which ask for 3 for graphics (1.4.11) and 4.5 for text.
double contrast_ratio(Colour a, Colour b);

/// Composites a colour over an opaque one.
Colour laid_over(Colour colour, Colour ground);

/// Interpolates between two colours in each channel of sRGB and in alpha. @param share  of the second
Colour mixed(Colour from, Colour to, double share);

}  // namespace sikku
