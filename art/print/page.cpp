#include "art/print/page.h"

#include "art/print/paper.h"
#include "art/style/length.h"
#include "engine/base/text.h"
#include "engine/geometry/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace sikku {
namespace {

constexpr double step_of_a_point = 10.0;  // step of a drawing without extent

/// Upright sizes in millimetres. Sources: ISO 216 (A, B), ISO 269 (C), JIS P 0138 (JIS B), ISO 217 (RA, SRA), ANSI
/// Y14.1.
const std::array<PaperSize, 73> named_sizes = {{
    {"4a0", {1682.0, 2378.0}},      {"2a0", {1189.0, 1682.0}},     {"a0", {841.0, 1189.0}},
    {"a1", {594.0, 841.0}},         {"a2", {420.0, 594.0}},        {"a3", {297.0, 420.0}},
    {"a4", {210.0, 297.0}},         {"a5", {148.0, 210.0}},        {"a6", {105.0, 148.0}},
    {"a7", {74.0, 105.0}},          {"a8", {52.0, 74.0}},          {"a9", {37.0, 52.0}},
    {"a10", {26.0, 37.0}},          {"b0", {1000.0, 1414.0}},      {"b1", {707.0, 1000.0}},
    {"b2", {500.0, 707.0}},         {"b3", {353.0, 500.0}},        {"b4", {250.0, 353.0}},
    {"b5", {176.0, 250.0}},         {"b6", {125.0, 176.0}},        {"b7", {88.0, 125.0}},
    {"b8", {62.0, 88.0}},           {"b9", {44.0, 62.0}},          {"b10", {31.0, 44.0}},
    {"c0", {917.0, 1297.0}},        {"c1", {648.0, 917.0}},        {"c2", {458.0, 648.0}},
    {"c3", {324.0, 458.0}},         {"c4", {229.0, 324.0}},        {"c5", {162.0, 229.0}},
    {"c6", {114.0, 162.0}},         {"c7", {81.0, 114.0}},         {"c8", {57.0, 81.0}},
    {"c9", {40.0, 57.0}},           {"c10", {28.0, 40.0}},         {"jisb0", {1030.0, 1456.0}},
    {"jisb1", {728.0, 1030.0}},     {"jisb2", {515.0, 728.0}},     {"jisb3", {364.0, 515.0}},
    {"jisb4", {257.0, 364.0}},      {"jisb5", {182.0, 257.0}},     {"jisb6", {128.0, 182.0}},
    {"jisb7", {91.0, 128.0}},       {"jisb8", {64.0, 91.0}},       {"jisb9", {45.0, 64.0}},
    {"jisb10", {32.0, 45.0}},       {"ra0", {860.0, 1220.0}},      {"ra1", {610.0, 860.0}},
    {"ra2", {430.0, 610.0}},        {"ra3", {305.0, 430.0}},       {"ra4", {215.0, 305.0}},
    {"sra0", {900.0, 1280.0}},      {"sra1", {640.0, 900.0}},      {"sra2", {450.0, 640.0}},
    {"sra3", {320.0, 450.0}},       {"sra4", {225.0, 320.0}},      {"letter", {215.9, 279.4}},
    {"legal", {215.9, 355.6}},      {"tabloid", {279.4, 431.8}},   {"ledger", {279.4, 431.8}},
    {"executive", {184.15, 266.7}}, {"statement", {139.7, 215.9}}, {"ansia", {215.9, 279.4}},
    {"ansib", {279.4, 431.8}},      {"ansic", {431.8, 558.8}},     {"ansid", {558.8, 863.6}},
    {"ansie", {863.6, 1117.6}},     {"archa", {228.6, 304.8}},     {"archb", {304.8, 457.2}},
    {"archc", {457.2, 609.6}},      {"archd", {609.6, 914.4}},     {"arche", {914.4, 1219.2}},
    {"arche1", {762.0, 1066.8}},
}};

/// The step at which one axis is filled, or nullopt if the drawing has no extent along it.
std::optional<double> fitting_step(double room, double extent, double ink_steps, double ink_mm) {
    const double steps = extent + 2.0 * ink_steps;
    if (!(steps > 0.0)) return std::nullopt;
    return (room - 2.0 * ink_mm) / steps;
}

/// The share of the fitting size that leaves space around a drawing.
/// @param room, size  the page within its margins, and the drawing that fits it
double breathing(const Balance& balance, glm::dvec2 room, glm::dvec2 size) {
    // Drawings that fill their box need more room than those that end in points.
    constexpr double least = 0.05, of_full = 0.05, of_slack = 0.22, most = 0.2;
    const double slack = std::max(1 - size.x / room.x, 1 - size.y / room.y);
    return 1 - std::min(least + of_full * balance.fullness + of_slack * std::max(0.0, slack), most);
}

/// Offset of the box's centre from the middle of the page, in millimetres, y down.
glm::dvec2 optical_shift(const Balance& balance, const Page& page, glm::dvec2 size) {
    // 46 % of the free height is above the drawing.
    constexpr double rise = 0.04, pull = 0.6;
    const glm::dvec2 free(std::max(0.0, page.width - 2 * page.margin - size.x),
                          std::max(0.0, page.height - 2 * page.margin - size.y));
    const glm::dvec2 mass = pull * balance.mass * size;
    return {std::clamp(-mass.x, -free.x / 2, free.x / 2),
            std::clamp(mass.y - rise * (page.height - size.y), -free.y / 2, free.y / 2)};
}

}  // namespace

std::span<const PaperSize> paper_sizes() {
    return named_sizes;
}

std::optional<glm::dvec2> parse_size(std::string_view text, double dpi) {
    std::string name = lower_case(trimmed(text));
    std::string joined;  // `ANSI C`, `jis-b4`
    for (const char byte : name) {
        if (byte != ' ' && byte != '-' && byte != '_') joined += byte;
    }
    for (const PaperSize& named : named_sizes) {
        if (named.name == joined) return named.size;
    }
    for (std::size_t sign = 0; (sign = name.find("×")) != std::string::npos;) {
        name[sign] = 'x';
        name.erase(sign + 1, 1);
    }
    // `px` contains an x as well, so every x is tried.
    for (std::size_t x = name.find('x'); x != std::string::npos; x = name.find('x', x + 1)) {
        auto width = read_length(std::string_view(name).substr(0, x));
        const auto height = read_length(std::string_view(name).substr(x + 1));
        if (!width || !height) continue;
        if (width->unit.empty()) width->unit = height->unit;
        if (height->unit.empty() && !width->unit.empty()) continue;
        const auto width_mm = width->millimetres(dpi);
        const auto height_mm = height->millimetres(dpi);
        if (width_mm && height_mm) return glm::dvec2(*width_mm, *height_mm);
    }
    return std::nullopt;
}

glm::dmat3x2 orientation(const PlacementOptions& options) {
    const glm::dvec2 turned = unit_vector(options.rotate);
    const double mirrored = options.mirror ? -1.0 : 1.0;
    glm::dmat3x2 result(0.0);
    // Adding 0 turns -0 into 0.
    result[0] = {mirrored * turned.x + 0.0, mirrored * turned.y + 0.0};
    result[1] = {0.0 - turned.y, turned.x + 0.0};
    return result;
}

Placement place(const Box& box, const Page& page, const PlacementOptions& options, double ink_steps, double ink_mm) {
    const glm::dvec2 low = box.empty() ? glm::dvec2(0.0) : box.low;
    const glm::dvec2 high = box.empty() ? glm::dvec2(0.0) : box.high;
    const glm::dvec2 extent = high - low;
    Placement placement;
    if (options.step) {
        placement.step = *options.step;
    } else if (extent.x <= 0.0 && extent.y <= 0.0) {
        placement.step = step_of_a_point;
    } else {
        const glm::dvec2 room(page.width - 2.0 * page.margin, page.height - 2.0 * page.margin);
        const auto across = fitting_step(room.x, extent.x, ink_steps, ink_mm);
        const auto down = fitting_step(room.y, extent.y, ink_steps, ink_mm);
        const double fitted = across && down ? std::min(*across, *down) : across ? *across : *down;
        const double pen_alone = std::min(room.x, room.y) - 2.0 * ink_mm;
        if (!(fitted > 0.0) || pen_alone < 0.0) {
            throw std::runtime_error(fmt::format(
                "the margins and the pen leave no room on a page of {:.6g} x {:.6g} mm: margin {:.6g} mm, "
                "pen {:.6g} mm",
                page.width, page.height, page.margin, 2.0 * ink_mm));
        }
        placement.step = fitted * options.scale;
        if (options.balance) {
            placement.step *=
                breathing(*options.balance, room, extent * fitted + 2.0 * (ink_steps * fitted + ink_mm));
        }
    }
    const glm::dmat3x2 turned = orientation(options);
    const double step = placement.step;
    const glm::dvec2 centre = low * 0.5 + high * 0.5;
    // Multiplied by the signed step and not negated, so that 0 stays 0.
    placement.to_page[0] = {step * turned[0].x, 0.0 - step * turned[0].y};
    placement.to_page[1] = {step * turned[1].x, 0.0 - step * turned[1].y};
    placement.to_page[2] = {page.width * 0.5 - step * centre.x, page.height * 0.5 + step * centre.y};
    if (options.balance) {
        const glm::dvec2 size = extent * step + 2.0 * (ink_steps * step + ink_mm);
        placement.to_page[2] += optical_shift(*options.balance, page, size);
    }
    return placement;
}

}  // namespace sikku
