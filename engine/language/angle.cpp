#include "engine/language/angle.h"

#include "engine/base/decimal.h"
#include "engine/base/diagnostic.h"

#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t largest_term = most_angle_parts;  // of the fraction of an exact angle

std::optional<TurnFraction> reduced(std::int64_t numerator, std::int64_t denominator) {
    if (denominator <= 0 || denominator > largest_term) return std::nullopt;
    const std::int64_t divisor = std::gcd(numerator, denominator);
    numerator /= divisor;
    denominator /= divisor;
    numerator %= denominator;
    return TurnFraction{numerator, denominator};
}

/// A decimal as written (`25.7`, `-3`, `1e2`) as a fraction numerator / denominator, if both stay small.
std::optional<std::pair<std::int64_t, std::int64_t>> decimal_fraction(std::string_view text) {
    std::int64_t numerator = 0, denominator = 1;
    bool negative = false;
    std::size_t at = 0;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) negative = text[at++] == '-';
    bool point = false;
    for (; at < text.size() && text[at] != 'e' && text[at] != 'E'; ++at) {
        if (text[at] == '.') {
            point = true;
            continue;
        }
        numerator = numerator * 10 + (text[at] - '0');
        if (point) denominator *= 10;
        if (numerator > largest_term || denominator > largest_term) return std::nullopt;
    }
    if (at < text.size()) {
        int exponent = 0;
        std::string_view digits = text.substr(at + 1);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc()) {
            return std::nullopt;
        }
        if (numerator == 0) exponent = 0;
        while (exponent != 0) {
            std::int64_t& term = exponent > 0 ? numerator : denominator;
            term *= 10;
            if (term > largest_term) return std::nullopt;
            exponent -= exponent > 0 ? 1 : -1;
        }
    }
    return std::pair{negative ? -numerator : numerator, denominator};
}

}  // namespace

Angle angle_of_degrees(double degrees) {
    if (!std::isfinite(degrees)) return {degrees, std::nullopt};  // the turtle refuses it, with its place
    Angle angle{std::fmod(degrees, 360.0), std::nullopt};
    if (const auto fraction = decimal_fraction(shortest_decimal(degrees))) {
        if (fraction->second <= largest_term / 360) angle.exact = reduced(fraction->first, fraction->second * 360);
    }
    return angle;
}

Angle angle_of_parts(std::int64_t k) {
    return {360.0 / static_cast<double>(k), reduced(1, k)};
}

std::optional<Angle> read_angle(std::string_view text) {
    double numerator = 0, denominator = 1;
    const std::size_t slash = text.find('/');
    const std::string_view over = text.substr(0, slash);
    if (!read_number(over, numerator) ||
        (slash != std::string_view::npos && !read_number(text.substr(slash + 1), denominator)) || denominator == 0 ||
        !std::isfinite(numerator / denominator)) {
        return std::nullopt;
    }
    Angle angle{std::fmod(numerator / denominator, 360.0), std::nullopt};
    const auto top = decimal_fraction(over);
    const auto bottom = slash == std::string_view::npos ? std::optional(std::pair{std::int64_t{1}, std::int64_t{1}})
                                                        : decimal_fraction(text.substr(slash + 1));
    if (top && bottom && bottom->first != 0) {
        // (a/b) / (c/d) degrees = a d / (360 b c) turns
        std::int64_t above = 0, below = 0;
        if (!__builtin_mul_overflow(top->first, bottom->second, &above) &&
            !__builtin_mul_overflow(top->second, bottom->first, &below) &&
            !__builtin_mul_overflow(below, std::int64_t{360}, &below)) {
            if (below < 0) {
                above = -above;
                below = -below;
            }
            const std::int64_t divisor = std::gcd(above, below);
            angle.exact = reduced(above / divisor, below / divisor);
        }
    }
    return angle;
}

Angle negated(const Angle& angle) {
    Angle result{-angle.degrees, angle.exact};
    if (result.exact) result.exact->numerator = -result.exact->numerator;
    return result;
}

}  // namespace sikku
