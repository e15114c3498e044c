#include "art/print/page.h"

#include "art/style/length.h"
#include "engine/base/text.h"
#include "engine/geometry/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

namespace sikku {
namespace {

constexpr double step_of_a_point = 10.0;  // of a drawing without extent

struct NamedSize {
    std::string_view name;
    glm::dvec2 size;
};
const std::array<NamedSize, 10> named_sizes = {{
    {"a0", {841.0, 1189.0}},
    {"a1", {594.0, 841.0}},
    {"a2", {420.0, 594.0}},
    {"a3", {297.0, 420.0}},
    {"a4", {210.0, 297.0}},
    {"a5", {148.0, 210.0}},
    {"a6", {105.0, 148.0}},
    {"letter", {215.9, 279.4}},
    {"legal", {215.9, 355.6}},
    {"tabloid", {279.4, 431.8}},
}};

/// The step at which one axis is filled, or nullopt if the drawing has no extent along it.
std::optional<double> fitting_step(double room, double extent, double ink_steps, double ink_mm) {
    const double steps = extent + 2.0 * ink_steps;
    if (!(steps > 0.0)) return std::nullopt;
    return (room - 2.0 * ink_mm) / steps;
}

}  // namespace

std::optional<glm::dvec2> parse_size(std::string_view text, double dpi) {
    const std::string name = lower_case(trimmed(text));
    for (const NamedSize& named : named_sizes) {
        if (named.name == name) return named.size;
    }
    // `px` holds an x as well, so every x is tried.
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
    }
    const glm::dmat3x2 turned = orientation(options);
    const double step = placement.step;
    const glm::dvec2 centre = low * 0.5 + high * 0.5;
    // Multiplied by the signed step and not negated, so that 0 stays 0.
    placement.to_page[0] = {step * turned[0].x, 0.0 - step * turned[0].y};
    placement.to_page[1] = {step * turned[1].x, 0.0 - step * turned[1].y};
    placement.to_page[2] = {page.width * 0.5 - step * centre.x, page.height * 0.5 + step * centre.y};
    return placement;
}

}  // namespace sikku
