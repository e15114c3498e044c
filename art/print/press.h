// art/print/press.h: settings for print shops: bleed and crop marks, spot colours, inks, bits.
#pragma once

#include "art/print/format.h"
#include "art/print/screen.h"
#include "art/style/colour.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

struct Page;
struct Print;
struct Style;

/// A separate ink for one colour, with its own plate in PDF.
struct Spot {
    std::string name;  ///< 1 to 127 bytes of UTF-8
    Colour colour;     ///< the colour it prints; opaque
};

/// The inks of a press, as its ICC profile describes them. Converts colours for PDF/X-4.
struct PressInks {
    std::vector<std::uint8_t> profile;  ///< the bytes of the file
    std::string name;                   ///< description in the profile, ASCII, not empty
    /// Cyan, magenta, yellow and black of an opaque colour, 0 to 1.
    std::function<std::array<double, 4>(Colour)> convert;
};

/// The marks that overprint the inks beneath them instead of knocking them out, so that no paper shows if plates are
/// misaligned: black lines and dots, areas and lines in spot colours, or both.
enum class Overprint : std::uint8_t { none, black, spots, all };

/// Settings for the print shop. The page of the print is the trimmed sheet.
struct Press {
    double bleed = 0.0;            ///< millimetres that the ground extends beyond the page, 0 to 100
    bool marks = false;            ///< crop marks outside of the bleed; only PDF
    std::vector<Spot> spots{};     ///< only PDF
    bool registration = false;     ///< registration marks outside of the bleed; only PDF
    std::filesystem::path cmyk{};  ///< ICC profile of the inks that colours are converted to; empty: none; TIFF, PDF
    std::shared_ptr<const PressInks> inks{};  ///< inks of `cmyk`, once they are loaded; PDF becomes PDF/X-4
    Overprint overprint = Overprint::none;    ///< only PDF
    int bits = 8;                             ///< bits per channel: 8, or 1 for line art; only TIFF
    Screen screen{};                          ///< for one bit: how greys become black and white
    bool icc = true;                          ///< embed the profile of the colours in pictures
};

/// Parses `Kaavi=#b3452c`: a name and a colour as in parse_colour(). Ignores blanks around both.
/// @throws std::runtime_error if there is no name or no opaque colour, if the name is over 127 bytes, is All or None,
/// which PDF reserves, or contains control characters or invalid UTF-8
Spot parse_spot(std::string_view text);
/// Adds a spot colour. @throws std::runtime_error if its name or its colour is in use
void add_spot(std::vector<Spot>& spots, Spot spot);
/// Parses several spots. @throws std::runtime_error as parse_spot(), and if a name or a colour is repeated
std::vector<Spot> parse_spots(std::span<const std::string> texts);

/// @throws SettingError if the values are out of range, exclude each other, or do not apply to the format
void check_press(const Press& press, PrintFormat format);
/// @throws SettingError if the colour of a spot occurs neither in the ground nor in lines or fills of `style`
void check_spots(const Press& press, const Style& style);

/// Distance in millimetres from the edge of the medium to the trimmed sheet: the bleed, or the room for marks.
double press_edge(const Press& press);

/// The ends of a crop mark, in millimetres from the top left corner of the trimmed sheet, y down.
struct CropMark {
    glm::dvec2 from{0.0}, to{0.0};
};
/// Two marks at each corner, in line with the trimmed edges: 5 mm long, at the distance of the bleed or 2 mm.
std::array<CropMark, 8> crop_marks(const Page& page, const Press& press);

/// The centres of the registration marks in the middle of the sides, in the same coordinates. Each mark is a circle
/// with a radius of 1.5 mm and a cross with arms of 2.5 mm.
std::array<glm::dvec2, 4> registration_marks(const Page& page, const Press& press);
constexpr double registration_radius = 1.5;
constexpr double registration_arm = 2.5;

/// Converts the print for formats with a single page box (all but PDF): its page is as large as the bleed box. For
/// one bit without a screen, every colour of the style becomes black or white by its luminance, or transparent if it
/// is mostly transparent, so that only the coverage of pixels matters. Call it after the print is placed.
Print as_picture(Print print);

}  // namespace sikku
