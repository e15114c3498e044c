#include "art/style/light.h"

#include "art/style/values.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace sikku {

std::optional<Light> parse_light(std::string_view text) {
    const std::vector<std::string> words = words_of(text, 4);
    Light light;
    if (words.size() == 1) {
        light.is_flat = words[0] == "flat";
        if (words[0] == "sky") light.sun = 0;
        if (light.is_flat || words[0] == "sun" || words[0] == "sky") return light;
        return std::nullopt;
    }
    if (words.size() < 2 || words.size() > 3) return std::nullopt;
    const auto azimuth = number_in(words[0], -360, 360);
    const auto elevation = number_in(words[1], 5, 90);
    const auto sun = words.size() > 2 ? number_in(words[2], 0, 1) : std::optional(light.sun);
    if (!azimuth || !elevation || !sun) return std::nullopt;
    return Light{.is_flat = false, .azimuth = *azimuth, .elevation = *elevation, .sun = *sun};
}

Light read_light(const Pattern& pattern, Diagnostics& diagnostics) {
    Light light;
    if (const Key* key = pattern.find("light")) {
        if (const auto given = parse_light(key->value.view())) {
            light = *given;
        } else {
            diagnostics.error(
                key->value.empty() ? key->name_at : key->value,
                "expected flat, sun or sky, or AZIMUTH,ELEVATION in degrees (azimuth -360 to 360, to the "
                "right of the eye; elevation 5 to 90) and optionally the share of the sun, 0 to 1");
        }
    }
    if (const Key* key = pattern.find("ground plane")) {
        const std::string value = lower_case(trimmed(key->value.view()));
        light.has_ground = value == "shadow";
        if (value != "shadow" && value != "none") {
            diagnostics.error(key->value.empty() ? key->name_at : key->value,
                              fmt::format("{}: expected shadow or none", quoted_value(key->value.view())));
        }
    }
    return light;
}

}  // namespace sikku
