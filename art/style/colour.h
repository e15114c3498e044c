// art/style/colour.h: colours in the notation of CSS.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// 8 bits a channel, sRGB, straight (not premultiplied) alpha.
struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
    bool operator==(const Colour&) const = default;
};

/// `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa`, the 148 names of CSS Color 4 in any case, or `transparent`.
std::optional<Colour> parse_colour(std::string_view text);

/// `#rrggbb`; alpha is not part of it.
std::string hex(Colour colour);

/// The CSS name if there is one, else hex(); alpha is not part of it.
std::string colour_name(Colour colour);

/// Lightness of a colour: 0 for black to 1 for white; ignores alpha. Source: Ottosson, A perceptual color
/// space for image processing (OKLab), 2020.
double lightness(Colour colour);
/// Perceived difference between two colours in OKLab: 0.02 is barely visible, 1 is black to white; ignores alpha.
double colour_distance(Colour a, Colour b);

/// Every name that parse_colour knows, in lower case, for hints.
const std::vector<std::string_view>& colour_names();

}  // namespace sikku
