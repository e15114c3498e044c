#include "art/style/colour.h"

#include "art/style/contrast.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {
namespace {

struct NamedColour {
    std::string_view name;
    std::uint32_t rgb;
};

/// CSS Color Module Level 4, section 6.1, sorted by name.
constexpr std::array<NamedColour, 148> named_colours = {{
    {"aliceblue", 0xf0f8ff},
    {"antiquewhite", 0xfaebd7},
    {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4},
    {"azure", 0xf0ffff},
    {"beige", 0xf5f5dc},
    {"bisque", 0xffe4c4},
    {"black", 0x000000},
    {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff},
    {"blueviolet", 0x8a2be2},
    {"brown", 0xa52a2a},
    {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},
    {"chocolate", 0xd2691e},
    {"coral", 0xff7f50},
    {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc},
    {"crimson", 0xdc143c},
    {"cyan", 0x00ffff},
    {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b},
    {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},
    {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b},
    {"darkolivegreen", 0x556b2f},
    {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc},
    {"darkred", 0x8b0000},
    {"darksalmon", 0xe9967a},
    {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f},
    {"darkslategrey", 0x2f4f4f},
    {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3},
    {"deeppink", 0xff1493},
    {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},
    {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff},
    {"firebrick", 0xb22222},
    {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22},
    {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc},
    {"ghostwhite", 0xf8f8ff},
    {"gold", 0xffd700},
    {"goldenrod", 0xdaa520},
    {"gray", 0x808080},
    {"green", 0x008000},
    {"greenyellow", 0xadff2f},
    {"grey", 0x808080},
    {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4},
    {"indianred", 0xcd5c5c},
    {"indigo", 0x4b0082},
    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},
    {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5},
    {"lawngreen", 0x7cfc00},
    {"lemonchiffon", 0xfffacd},
    {"lightblue", 0xadd8e6},
    {"lightcoral", 0xf08080},
    {"lightcyan", 0xe0ffff},
    {"lightgoldenrodyellow", 0xfafad2},
    {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90},
    {"lightgrey", 0xd3d3d3},
    {"lightpink", 0xffb6c1},
    {"lightsalmon", 0xffa07a},
    {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa},
    {"lightslategray", 0x778899},
    {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0},
    {"lime", 0x00ff00},
    {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},
    {"maroon", 0x800000},
    {"mediumaquamarine", 0x66cdaa},
    {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3},
    {"mediumpurple", 0x9370db},
    {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a},
    {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585},
    {"midnightblue", 0x191970},
    {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1},
    {"moccasin", 0xffe4b5},
    {"navajowhite", 0xffdead},
    {"navy", 0x000080},
    {"oldlace", 0xfdf5e6},
    {"olive", 0x808000},
    {"olivedrab", 0x6b8e23},
    {"orange", 0xffa500},
    {"orangered", 0xff4500},
    {"orchid", 0xda70d6},
    {"palegoldenrod", 0xeee8aa},
    {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093},
    {"papayawhip", 0xffefd5},
    {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f},
    {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},
    {"powderblue", 0xb0e0e6},
    {"purple", 0x800080},
    {"rebeccapurple", 0x663399},
    {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},
    {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513},
    {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},
    {"seagreen", 0x2e8b57},
    {"seashell", 0xfff5ee},
    {"sienna", 0xa0522d},
    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},
    {"slategray", 0x708090},
    {"slategrey", 0x708090},
    {"snow", 0xfffafa},
    {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},
    {"tan", 0xd2b48c},
    {"teal", 0x008080},
    {"thistle", 0xd8bfd8},
    {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},
    {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},
    {"white", 0xffffff},
    {"whitesmoke", 0xf5f5f5},
    {"yellow", 0xffff00},
    {"yellowgreen", 0x9acd32},
}};
static_assert(std::is_sorted(named_colours.begin(), named_colours.end(),
                             [](const NamedColour& a, const NamedColour& b) { return a.name < b.name; }));

constexpr std::size_t longest_name = 20;

Colour from_rgb(std::uint32_t rgb) {
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
            static_cast<std::uint8_t>(rgb & 0xff), 255};
}

int hex_digit(char byte) {
    if (byte >= '0' && byte <= '9') return byte - '0';
    if (byte >= 'a' && byte <= 'f') return byte - 'a' + 10;
    if (byte >= 'A' && byte <= 'F') return byte - 'A' + 10;
    return -1;
}

std::optional<Colour> parse_hex(std::string_view digits) {
    const bool is_short = digits.size() == 3 || digits.size() == 4;
    if (!is_short && digits.size() != 6 && digits.size() != 8) return std::nullopt;
    std::array<std::uint8_t, 4> channels = {0, 0, 0, 255};
    const std::size_t width = is_short ? 1 : 2;
    for (std::size_t i = 0; i < digits.size() / width; ++i) {
        const int high = hex_digit(digits[i * width]);
        const int low = hex_digit(digits[i * width + width - 1]);
        if (high < 0 || low < 0) return std::nullopt;
        channels[i] = static_cast<std::uint8_t>(high * 16 + low);
    }
    return Colour{channels[0], channels[1], channels[2], channels[3]};
}

/// Relative luminance of ITU-R BT.709 and of WCAG.
double luminance(Colour colour) {
    return 0.2126 * linear_light(colour.red) + 0.7152 * linear_light(colour.green) +
           0.0722 * linear_light(colour.blue);
}

/// CIE L*a*b* relative to the white of sRGB.
glm::dvec3 cielab(Colour colour) {
    const double r = linear_light(colour.red), g = linear_light(colour.green), b = linear_light(colour.blue);
    const auto share = [](double value) {
        constexpr double knee = 6.0 / 29;
        return value > knee * knee * knee ? std::cbrt(value) : value / (3 * knee * knee) + 4.0 / 29;
    };
    const double x = share((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = share(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = share((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

glm::dvec3 oklab(Colour colour) {
    const double r = linear_light(colour.red), g = linear_light(colour.green), b = linear_light(colour.blue);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// A set of powders. Neighbours in the list contrast, since fields of different parity alternate between them.
struct Powders {
    std::string_view name;
    std::string_view colours;
};
constexpr std::array powder_sets = {
    Powders{"festival", "#f2a71b #c8324a #f6dfa6 #2f8f83 #e8743b #3d6cb0"},
    Powders{"pongal", "#f0b52e #5d8c3a #f7e6b8 #b5472a #e08a35 #2f6b57"},
    Powders{"lotus", "#f3b7c4 #c23a6b #fbe7de #7f9f63 #e5809f #8e2b55"},
    Powders{"peacock", "#2a9d9b #274b93 #9fd8c4 #c9a227 #4fb3d9 #5a3d8a"},
    Powders{"temple", "#e9b872 #5a3527 #f6e9d0 #c9743f #d9a441 #8d6b52"},
    Powders{"marigold", "#fcc52c #d9541e #ffeab0 #a8321f #f4922a #e7b96b"},
    Powders{"monsoon", "#a9c4bd #4b6f86 #e4dfcd #6f8f6b #c79a6b #39525f"},
    Powders{"distinct", "#e69f00 #0072b2 #f0e442 #009e73 #d55e00 #56b4e9 #cc79a7"},
};

}  // namespace

std::optional<Colour> parse_colour(std::string_view text) {
    if (text.starts_with('#')) return parse_hex(text.substr(1));
    if (text.empty() || text.size() > longest_name) return std::nullopt;
    const std::string folded = lower_case(text);
    if (folded == "transparent") return Colour{0, 0, 0, 0};
    const auto found =
        std::lower_bound(named_colours.begin(), named_colours.end(), folded,
                         [](const NamedColour& named, std::string_view name) { return named.name < name; });
    if (found == named_colours.end() || found->name != folded) return std::nullopt;
    return from_rgb(found->rgb);
}

std::vector<Colour> parse_colours(std::string_view list) {
    constexpr std::size_t length = std::string_view("#rrggbb").size();
    std::vector<Colour> colours;
    for (std::size_t at = 0; at < list.size(); at += length + 1) {
        colours.push_back(*parse_colour(list.substr(at, length)));
    }
    return colours;
}

std::string hex(Colour colour) {
    return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

std::string colour_name(Colour colour) {
    // The better known of two names for one colour: cyan and magenta, the printers' names, before aqua and fuchsia.
    for (const std::string_view name : {"cyan", "magenta"}) {
        if (const auto known = parse_colour(name); hex(*known) == hex(colour)) return std::string(name);
    }
    for (const NamedColour& named : named_colours) {
        if (hex(from_rgb(named.rgb)) == hex(colour)) return std::string(named.name);
    }
    return hex(colour);
}

const std::vector<std::string_view>& colour_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        list.reserve(std::size(named_colours) + 1);
        for (const NamedColour& named : named_colours) list.push_back(named.name);
        list.push_back("transparent");
        return list;
    }();
    return names;
}

std::vector<std::string_view> powder_names() {
    std::vector<std::string_view> names;
    for (const Powders& each : powder_sets) names.push_back(each.name);
    return names;
}

std::optional<std::vector<Colour>> find_powders(std::string_view name) {
    for (const Powders& each : powder_sets) {
        if (each.name == name) return parse_colours(each.colours);
    }
    return std::nullopt;
}

double linear_light(std::uint8_t channel) {
    const double value = channel / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double lightness(Colour colour) {
    return oklab(colour).x;
}

double colour_distance(Colour a, Colour b) {
    return glm::length(oklab(a) - oklab(b));
}

Colour mixed(Colour from, Colour to, double share) {
    const auto channel = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
    };
    return {channel(from.red, to.red), channel(from.green, to.green), channel(from.blue, to.blue),
            channel(from.alpha, to.alpha)};
}

double colour_difference(Colour a, Colour b) {
    return glm::length(cielab(a) - cielab(b));
}

bool is_faint(Colour ink, Colour ground) {
    constexpr double least_difference = 15;
    return ink.alpha > 0 && colour_difference(laid_over(ink, ground), ground) < least_difference;
}

double contrast_ratio(Colour a, Colour b) {
    constexpr double flare = 0.05;
    const double one = luminance(a) + flare, other = luminance(b) + flare;
    return std::max(one, other) / std::min(one, other);
}

Colour laid_over(Colour colour, Colour ground) {
    const auto mixed = [&](int above, int below) {
        return static_cast<std::uint8_t>((above * colour.alpha + below * (255 - colour.alpha) + 127) / 255);
    };
    return {mixed(colour.red, ground.red), mixed(colour.green, ground.green), mixed(colour.blue, ground.blue), 255};
}

}  // namespace sikku
