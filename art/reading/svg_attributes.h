// art/reading/svg_attributes.h: attributes of SVG elements: transforms, lists of numbers, properties.
#pragma once

#include <glm/vec2.hpp>

#include <string_view>
#include <vector>

namespace sikku {

/// Maximum depth of nested elements.
constexpr int most_svg_levels = 200;

/// A matrix of SVG: x' = a x + c y + e, y' = b x + d y + f.
struct Transform {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
    glm::dvec2 operator()(glm::dvec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    Transform operator*(const Transform& o) const {
        return {a * o.a + c * o.b, b * o.a + d * o.b,     a * o.c + c * o.d,
                b * o.c + d * o.d, a * o.e + c * o.f + e, b * o.e + d * o.f + f};
    }
};

/// A name without its prefix.
std::string_view local_name(std::string_view name);

/// Parses numbers separated by blanks, commas or signs. @throws std::runtime_error if one is damaged or 1e12 or
/// larger
std::vector<double> numbers_of(std::string_view text);

/// The product of a list of transforms. Source: SVG 1.1 (Second Edition), section 7.6. @throws std::runtime_error
Transform parse_transform(std::string_view text);

}  // namespace sikku
