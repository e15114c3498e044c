// art/plotter/pen_rules.h: settings of single pens: speed, heights, pause, refilling.
#pragma once

#include "art/style/colour.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sikku {

/// Dips a brush again and again. Lengths are millimetres; places are measured from the bottom left corner of the
/// page, y up, and may lie outside it.
struct Refill {
    double length = 0.0;    ///< drawn with one filling, 10 mm to 1 km
    glm::dvec2 place{0.0};  ///< place of the ink
    bool operator==(const Refill&) const = default;
};

/// Settings of a pen; absent ones are those of all pens.
struct PenSettings {
    std::optional<double> speed{};  ///< mm/s, pen down, 0.001 to 10^6
    std::optional<double> lift{};   ///< height of the raised pen, in the unit of the machine: mm, %, degrees
    std::optional<double> down{};   ///< height of the lowered pen, or the power that lowers it
    std::optional<double> pause{};  ///< seconds after the pen was lifted or lowered, up to an hour
    std::optional<Refill> refill{};
    bool operator==(const PenSettings&) const = default;
};

/// Settings of the pens with a number, as plots count them from 1, or of the pen that draws a colour.
struct PenRule {
    int number = 0;  ///< 0: by colour
    std::optional<Colour> colour{};
    PenSettings settings{};
    bool operator==(const PenRule&) const = default;
};

/// Parses a pen and its settings: `2 speed=20mm/s lift=3mm down=-0.2mm pause=0.5s refill=5m@10,10`, or a colour
/// instead of the number: `navy speed=20`. @throws std::runtime_error
PenRule parse_pen_rule(std::string_view text, double dpi);
/// Parses `5m@10mm,10mm`: a length and a place. @throws std::runtime_error
Refill parse_refill(std::string_view text, double dpi);
/// Parses `10mm,20mm`: x and y, up to 10 m from the origin. @throws std::runtime_error
glm::dvec2 parse_place(std::string_view text, double dpi);
/// Parses seconds up to an hour, with or without their unit. @throws std::runtime_error
double parse_pause(std::string_view text);
/// Parses a speed in mm/s between 0.001 and 10^6, with or without its unit. @throws std::runtime_error
double parse_speed(std::string_view text);
/// Parses a number without or with the unit mm, % or deg, up to 10^6. @throws std::runtime_error
double parse_height(std::string_view text);

/// The rules by which AxiDraw's software reads settings of pens from the names of layers.
struct LayerCodes {
    double full_speed = 0.0;  ///< mm/s of its 100 %; 0: layers have plain names
    bool pauses = false;      ///< it waits before every layer but the first
};
/// The name of a pen's layer: `2 navy`, or with codes `!2+S25+H40+D500 navy` (speed and height of the lowered pen in
/// %, delay before the layer in ms). Speeds are rounded to 1 to 110 %, heights to 0 to 100 %.
/// Source: Evil Mad Scientist Wiki, AxiDraw Layer Control; axidraw.py, 100 % = 8.6979 in/s * 100 / 110.
std::string layer_name(int number, Colour colour, const PenSettings& settings, const LayerCodes& codes);

/// The settings of one pen: later rules replace earlier ones.
PenSettings pen_settings(std::span<const PenRule> rules, int number, Colour colour);

}  // namespace sikku
