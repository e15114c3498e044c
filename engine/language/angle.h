// engine/language/angle.h: angles of turtles, stored as exact fractions if possible.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace sikku {

/// A rational number of whole turns (360 degrees), in lowest terms, denominator > 0.
struct TurnFraction {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;
};

/// An angle: exact if the file states one that fits, and always in degrees between -360 and 360, anticlockwise.
struct Angle {
    double degrees = 0.0;
    std::optional<TurnFraction> exact;
};

/// Converts degrees; exact if the shortest decimal that reads back as `degrees` is a fraction of small terms.
Angle angle_of_degrees(double degrees);

/// The k-th part of a turn. @param k  1 to most_angle_parts
Angle angle_of_parts(std::int64_t k);
constexpr std::int64_t most_angle_parts = std::int64_t{1} << 40;

/// Reads degrees: a decimal number or a fraction of two, such as `360/7`; nullopt for anything else.
std::optional<Angle> read_angle(std::string_view text);

Angle negated(const Angle& angle);

}  // namespace sikku
