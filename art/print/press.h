// art/print/press.h: what a print shop asks of a file: bleed and crop marks, spot colours, inks, bits.
#pragma once

#include "art/print/format.h"
#include "art/print/screen.h"
#include "art/style/colour.h"

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

struct Page;
struct Print;
struct Style;

/// An ink of its own for one colour: in PDF it has its own plate.
struct Spot {
    std::string name;  ///< 1 to 127 bytes of UTF-8
    Colour colour;     ///< that it prints; opaque
};

/// How a print goes to press. Its page is the sheet as it is trimmed.
struct Press {
    double bleed = 0.0;            ///< millimetres that the ground goes on beyond the page, 0 to 100
    bool marks = false;            ///< crop marks, outside of the bleed; PDF alone
    std::vector<Spot> spots{};     ///< PDF alone
    std::filesystem::path cmyk{};  ///< ICC profile of inks, which pixels are turned into; empty: none; TIFF alone
    int bits = 8;                  ///< a channel: 8, or 1 for line art; TIFF alone
    Screen screen{};               ///< for one bit: how greys become black and white
    bool icc = true;               ///< pictures hold the profile of their colours
};

/// `Kaavi=#b3452c`: a name and a colour as parse_colour() takes it. Blanks around both do not count.
/// @throws std::runtime_error if there is no name or no opaque colour, if the name is over 127 bytes, is All or None,
/// which PDF reserves, or contains control characters or invalid UTF-8
Spot parse_spot(std::string_view text);
/// Adds a spot colour. @throws std::runtime_error if its name or its colour is there already
void add_spot(std::vector<Spot>& spots, Spot spot);
/// Several. @throws std::runtime_error as parse_spot(), and if a name or a colour comes twice
std::vector<Spot> parse_spots(std::span<const std::string> texts);

/// @throws SettingError if the values are out of range, exclude each other, or are nothing for that format
void check_press(const Press& press, PrintFormat format);
/// @throws SettingError if a spot's colour is none of the ground, the lines and the fills that `style` has
void check_spots(const Press& press, const Style& style);

/// Millimetres from the edge of the medium to the trimmed sheet: the bleed, or the room that the marks need.
double press_edge(const Press& press);

/// Where a crop mark begins and ends, in millimetres from the top left corner of the trimmed sheet, y down.
struct CropMark {
    glm::dvec2 from{0.0}, to{0.0};
};
/// Two at each corner, in line with the trimmed edges: 5 mm long, and as far outside as the bleed, or 2 mm.
std::array<CropMark, 8> crop_marks(const Page& page, const Press& press);

/// Converts the print for formats with a single page box (all but PDF): its page is as large as the bleed box. For
/// one bit without a screen, every colour of the style becomes black or white, whichever its luminance is nearer to,
/// or transparent if it is mostly transparent, so that only the coverage of pixels matters. Call it when the print is
/// placed.
Print as_picture(Print print);

}  // namespace sikku
