#include "engine/base/roots_of_unity.h"

#include <cstddef>
#include <numeric>

namespace sikku {
namespace {

/// The cyclotomic polynomial of k, lowest coefficient first: x^k - 1 divided by those of the divisors of k.
std::vector<int> cyclotomic(int k) {
    std::vector<int> polynomial(static_cast<std::size_t>(k) + 1, 0);
    polynomial.front() = -1;
    polynomial.back() = 1;
    for (int divisor = 1; divisor < k; ++divisor) {
        if (k % divisor != 0) continue;
        const std::vector<int> factor = cyclotomic(divisor);
        std::vector<int> quotient(polynomial.size() - factor.size() + 1, 0);
        for (std::size_t i = quotient.size(); i > 0; --i) {
            quotient[i - 1] = polynomial[i + factor.size() - 2];  // the factor's highest coefficient is 1
            for (std::size_t j = 0; j < factor.size(); ++j) polynomial[i - 1 + j] -= quotient[i - 1] * factor[j];
        }
        polynomial = quotient;
    }
    return polynomial;
}

}  // namespace

int lattice_rank(std::int64_t k) {
    if (k < 1 || k > 30) return 0;
    int count = 0;
    for (std::int64_t i = 1; i <= k; ++i) count += std::gcd(i, k) == 1 ? 1 : 0;
    return count > most_coordinates ? 0 : count;
}

std::vector<std::array<std::int8_t, most_coordinates>> powers_of_root(int k) {
    // zeta^(h+1) from zeta^h: shift the coordinates, and replace zeta^rank by the polynomial's other terms.
    const std::vector<int> polynomial = cyclotomic(k);
    const auto rank = static_cast<std::size_t>(lattice_rank(k));
    std::vector<std::array<std::int8_t, most_coordinates>> powers;
    std::array<std::int8_t, most_coordinates> power{};
    power[0] = 1;
    for (int h = 0; h < k; ++h) {
        powers.push_back(power);
        const std::int8_t overflow = power[rank - 1];
        for (std::size_t i = rank - 1; i > 0; --i) {
            power[i] = static_cast<std::int8_t>(power[i - 1] - overflow * polynomial[i]);
        }
        power[0] = static_cast<std::int8_t>(-overflow * polynomial[0]);
    }
    return powers;
}

}  // namespace sikku
