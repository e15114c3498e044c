#include "art/print/press.h"

#include "art/print/print.h"
#include "engine/base/diagnostic.h"
#include "engine/base/option.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double most_bleed = 100.0;
constexpr double mark_length = 5.0;
constexpr double least_mark_offset = 2.0;  // keeps marks off the sheet if the knife is slightly off
constexpr std::size_t longest_name = 127;  // ISO 32000-1, annex C
constexpr std::size_t most_listed = 12;

bool is_printable(std::string_view name) {
    for (std::size_t i = 0; i < name.size();) {
        const std::size_t length = utf8_length(name.substr(i));
        const auto byte = static_cast<unsigned char>(name[i]);
        if (length == 0 || byte < 0x20 || byte == 0x7F) return false;
        i += length;
    }
    return true;
}

bool same_ink(Colour a, Colour b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

double mark_offset(const Press& press) {
    return std::max(press.bleed, least_mark_offset);
}

/// Weights sRGB values by Rec. 709, without linearisation, as colours are mixed.
Colour black_or_white(Colour colour) {
    if (colour.alpha < 128) return {255, 255, 255, 0};
    const int luminance = 2126 * colour.red + 7152 * colour.green + 722 * colour.blue;
    const std::uint8_t value = luminance * 2 > 255 * 10000 ? 255 : 0;
    return {value, value, value, 255};
}

}  // namespace

Spot parse_spot(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos) {
        throw std::runtime_error("expected a name and a colour, such as Kaavi=#b3452c");
    }
    const std::string_view name = trimmed(text.substr(0, equals));
    const std::string_view colour_text = trimmed(text.substr(equals + 1));
    const auto refuse = [&](std::string_view why) { throw std::runtime_error(std::string(why)); };
    if (name.empty()) refuse("its name is missing");
    if (name.size() > longest_name) refuse(fmt::format("its name is longer than {} bytes", longest_name));
    for (const char* reserved : {"All", "None", "Cyan", "Magenta", "Yellow", "Black"}) {
        if (lower_case(name) == lower_case(reserved)) refuse(fmt::format("the name {} is reserved", reserved));
    }
    if (!is_printable(name)) refuse("its name contains control characters or invalid UTF-8");
    if (colour_text.empty()) refuse("its colour is missing");
    const auto colour = parse_colour(colour_text);
    if (!colour) refuse(fmt::format("'{}' is not a colour: write #rrggbb or a CSS name", printable(colour_text)));
    if (colour->alpha != 255) refuse("the colour of an ink cannot be transparent");
    return {std::string(name), *colour};
}

void add_spot(std::vector<Spot>& spots, Spot spot) {
    for (const Spot& other : spots) {
        if (other.name == spot.name) {
            throw std::runtime_error(fmt::format("two spot colours are named '{}'", spot.name));
        }
        if (other.colour == spot.colour) {
            throw std::runtime_error(fmt::format("spot colours '{}' and '{}' are both {}", other.name, spot.name,
                                                 colour_name(spot.colour)));
        }
    }
    spots.push_back(std::move(spot));
}

std::vector<Spot> parse_spots(std::span<const std::string> texts) {
    std::vector<Spot> spots;
    for (const std::string& text : texts) add_spot(spots, parse_spot(text));
    return spots;
}

void check_press(const Press& press, PrintFormat format) {
    const auto refuse_if = [](bool is_wrong, const char* option, const std::string& why) {
        if (is_wrong) refuse_option(option, "", why);
    };
    // Also false for NaN.
    const bool has_bleed = press.bleed >= 0.0 && press.bleed <= most_bleed;
    refuse_if(!has_bleed, "bleed", fmt::format("expected 0 to {:g}mm", most_bleed));
    refuse_if(press.bleed > 0.0 && is_for_plotters(format), "bleed", "a plot has no bleed");
    refuse_if(press.bits != 1 && press.bits != 8, "bits", "expected 1 or 8");
    refuse_if(format != PrintFormat::pdf && press.marks, "marks", "only a PDF has crop marks");
    refuse_if(format != PrintFormat::pdf && !press.spots.empty(), "spot", "only a PDF has spot colours");
    const bool is_pdf = format == PrintFormat::pdf;
    refuse_if(!is_pdf && press.registration, "registration", "only a PDF has registration marks");
    refuse_if(!is_pdf && press.overprint != Overprint::none, "overprint", "only a PDF has inks that overprint");
    refuse_if(press.overprint != Overprint::none && press.cmyk.empty() && press.spots.empty(), "overprint",
              "needs 'cmyk' or 'spot': colours that are not inks cannot overprint");
    refuse_if(format != PrintFormat::tiff && !is_pdf && !press.cmyk.empty(), "cmyk",
              "only TIFF and PDF support CMYK");
    refuse_if(format != PrintFormat::tiff && press.bits == 1, "bits", "only TIFF supports one bit per channel");
    refuse_if(press.bits != 1 && press.screen != Screen{}, "screen", "applies only to pictures of one bit");
    refuse_if(press.bits == 1 && !press.cmyk.empty(), "cmyk", "a picture in CMYK has 8 bits per channel");
}

void check_spots(const Press& press, const Style& style) {
    if (press.spots.empty()) return;
    std::vector<Colour> used;
    const auto use = [&](const std::optional<Colour>& colour) {
        if (!colour || colour->alpha == 0) return;
        const auto same = [&](Colour other) { return same_ink(other, *colour); };
        if (std::none_of(used.begin(), used.end(), same)) used.push_back(*colour);
    };
    use(style.ground);
    for (int index = 0; index < std::max(static_cast<int>(style.palette.size()), 1); ++index) {
        if (style.stroked) use(style.line_colour(Pen{.colour = index}));
        use(style.fill_colour(Pen{.colour = index}));
    }
    for (const Spot& spot : press.spots) {
        const auto matches = [&](Colour colour) { return same_ink(colour, spot.colour); };
        if (std::any_of(used.begin(), used.end(), matches)) continue;
        std::string names;
        for (std::size_t i = 0; i < std::min(used.size(), most_listed); ++i) {
            names += (i == 0 ? "" : ", ") + colour_name(used[i]);
        }
        refuse_option("spot", spot.name + "=" + colour_name(spot.colour),
                      fmt::format("nothing is drawn in {}; the colours are {}{}", colour_name(spot.colour), names,
                                  used.size() > most_listed ? " and more" : ""));
    }
}

double press_edge(const Press& press) {
    return press.marks || press.registration ? mark_offset(press) + mark_length : press.bleed;
}

std::array<CropMark, 8> crop_marks(const Page& page, const Press& press) {
    const double near = mark_offset(press);
    const double far = near + mark_length;
    std::array<CropMark, 8> marks;
    std::size_t next = 0;
    for (const double x : {0.0, page.width}) {
        for (const double y : {0.0, page.height}) {
            const double out_x = x > 0.0 ? 1.0 : -1.0;
            const double out_y = y > 0.0 ? 1.0 : -1.0;
            marks[next++] = {{x + out_x * near, y}, {x + out_x * far, y}};
            marks[next++] = {{x, y + out_y * near}, {x, y + out_y * far}};
        }
    }
    return marks;
}

std::array<glm::dvec2, 4> registration_marks(const Page& page, const Press& press) {
    const double out = mark_offset(press) + mark_length / 2;
    const glm::dvec2 middle(page.width / 2, page.height / 2);
    return {{{middle.x, -out}, {page.width + out, middle.y}, {middle.x, page.height + out}, {-out, middle.y}}};
}

Print as_picture(Print print) {
    const double bleed = print.press.bleed;
    print.page.width += 2 * bleed;
    print.page.height += 2 * bleed;
    print.page.margin += bleed;
    print.placement.to_page[2] += glm::dvec2(bleed);
    print.floor_corner -= glm::dvec2(bleed);
    print.press.bleed = 0.0;
    if (print.press.bits == 1 && print.press.screen.kind == Screen::Kind::threshold) {
        Style& style = print.style;
        for (std::optional<Colour>* colour : {&style.ground, &style.stroke_colour, &style.fill}) {
            if (*colour) **colour = black_or_white(**colour);
        }
        for (Colour& colour : style.palette) colour = black_or_white(colour);
        // White paper, since one bit has no transparency.
        if (!style.ground || style.ground->alpha == 0) style.ground = Colour{255, 255, 255, 255};
    }
    return print;
}

}  // namespace sikku
