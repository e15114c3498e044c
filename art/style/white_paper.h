// art/style/white_paper.h: drawings on white paper, for printers without much ink.
#pragma once

#include "art/style/style.h"

#include <optional>

namespace sikku {

/// The colour of white paper.
constexpr Colour white_paper{255, 255, 255, 255};
/// The ground, or white paper if it is absent or transparent.
inline Colour ground_or_white(const std::optional<Colour>& ground) {
    return ground && ground->alpha > 0 ? *ground : white_paper;
}
/// Red earth (*kaavi*), and a darker tone of it, in which ornaments are drawn on light grounds.
constexpr Colour kaavi{0xb3, 0x45, 0x2c, 255};
constexpr Colour deep_earth{0x6e, 0x2c, 0x1c, 255};

/// The ink that replaces rice flour on white paper: the colour of the ground that the paper replaces, if it has a
/// contrast of at least 3, otherwise `other`.
Colour ink_on_paper(const std::optional<Colour>& ground, Colour other);

/// Colours that a user has set, which stay as they are.
struct GivenColours {
    bool stroke = false, fill = false, palette = false, dots = false;
};

/// Puts a drawing on white paper. Colours of lines, dots, fills and the palette that would vanish there, because they
/// are faint (is_faint()) or have a contrast below 1.5, become ink_on_paper(), or dark earth. Designs on a ground
/// that is nearly white keep their colours, and so do colours that are faint on their own ground, such as the joints
/// of tiles.
void put_on_white_paper(Style& style, const GivenColours& given);

}  // namespace sikku
