// art/style/length.h: parses lengths with units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// A number and its unit: `mm`, `cm`, `m`, `in`, `pt`, `px`; empty for a bare number.
struct Length {
    double number = 0.0;  ///< finite
    std::string unit;     ///< lower case

    /// The length in millimetres, px by `dpi`, a bare number as mm; nullopt for an unknown unit or a value beyond
    /// double precision.
    std::optional<double> millimetres(double dpi) const;
};

/// Parses a length; ignores blanks around number and unit. Returns nullopt if `text` does not begin with a finite
/// number.
std::optional<Length> read_length(std::string_view text);

/// Parses a length such as `15mm`, `1.5cm`, `2m`, `2in`, `12pt`, `300px` and returns millimetres; px by `dpi`; a bare
/// number is mm.
std::optional<double> parse_length(std::string_view text, double dpi);

}  // namespace sikku
