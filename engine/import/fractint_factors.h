// engine/import/fractint_factors.h: writes the numbers after Fractint's `@` as products of powers of a few factors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sikku::fractint {

/// Numbers as products of powers. The factors are multiplicatively independent: two products are equal only if all
/// their exponents are. So 0.5 and 2 cancel, as do 0.25, 2 and 8, or 2, 3 and 6.
struct Factors {
    std::vector<double> values;                        ///< above 0, none of them 1
    std::vector<std::vector<std::int32_t>> exponents;  ///< exponents of the values, for each number
};

/// Finds factors of decimal numbers above 0, such as `.5`. A number stays a factor itself unless it is a power, a
/// root or a product of others. Numbers of more than 18 digits count as independent of all others. Cost:
/// quadratic in the numbers. Source: Bernstein, Factoring into coprimes in essentially linear time, 2005, for the
/// coprime base.
Factors find_factors(const std::vector<std::string>& numbers);

/// Computes a product of powers with exponents in halves. Single powers may exceed the range of doubles; a product
/// that exceeds it becomes 0 or infinity. The result is the same on every machine.
double product_of_powers(const std::vector<double>& values, const std::vector<std::int64_t>& halves);

}  // namespace sikku::fractint
