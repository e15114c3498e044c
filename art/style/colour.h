// art/style/colour.h: colours in the notation of CSS, and named sets of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A colour with 8 bits per channel, sRGB, straight (not premultiplied) alpha.
struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
    bool operator==(const Colour&) const = default;
};

/// Parses `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa`, the 148 names of CSS Color 4 in any case, or `transparent`.
std::optional<Colour> parse_colour(std::string_view text);

/// Parses a list of `#rrggbb`, separated by single blanks.
std::vector<Colour> parse_colours(std::string_view list);

/// Returns `#rrggbb`, without alpha.
std::string hex(Colour colour);

/// Returns the CSS name if there is one, else hex(); without alpha.
std::string colour_name(Colour colour);

/// Lightness of a colour: 0 for black to 1 for white; ignores alpha. Source: Ottosson, A perceptual color
/// space for image processing (OKLab), 2020.
double lightness(Colour colour);
/// Linear light of a channel of sRGB (IEC 61966-2-1), 0 to 1.
double linear_light(std::uint8_t channel);
/// Perceived difference between two colours in OKLab: 0.02 is barely visible, 1 is black to white; ignores alpha.
double colour_distance(Colour a, Colour b);

/// All names that parse_colour() accepts, in lower case, for hints.
const std::vector<std::string_view>& colour_names();

/// Names of the sets of powders with which rangoli fields are filled, in the order of the manual. Colour-blind
/// readers, too, can distinguish the colours of `distinct` (Okabe and Ito 2008).
std::vector<std::string_view> powder_names();
/// The colours of a set of powders; nullopt for an unknown name.
std::optional<std::vector<Colour>> find_powders(std::string_view name);

}  // namespace sikku
