// art/style/light.h: the light of pictures of drawings in space, from the keys light and ground plane.
#pragma once

#include "engine/language/pattern.h"

#include <optional>
#include <string_view>

namespace sikku {

/// A sun with soft edges, a sky around it, and the level ground on which the drawing stands.
struct Light {
    bool is_flat = true;      ///< no sun and no shadows, each facet in one tone: for diagrams
    double azimuth = -40.0;   ///< azimuth of the sun, in degrees to the right of the eye
    double elevation = 50.0;  ///< elevation of the sun above the horizon, in degrees, 5 to 90
    double sun = 0.6;         ///< share of the sun in the light, 0 to 1; the rest comes from the sky
    bool has_ground = true;   ///< the ground receives the shadow
    bool operator==(const Light&) const = default;
};

/// Parses `flat`, `sun`, `sky`, or `AZIMUTH ELEVATION [SUN]`, separated by blanks or commas. Returns nullopt for
/// anything else.
std::optional<Light> parse_light(std::string_view text);

/// Reads the keys `light` and `ground plane`.
Light read_light(const Pattern& pattern, Diagnostics& diagnostics);

}  // namespace sikku
