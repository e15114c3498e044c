#include "engine/geometry/lattice.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace sikku {
namespace {

constexpr std::int64_t most_headings = std::int64_t{1} << 20;
constexpr std::int64_t largest_unit = 1'000'000;

int totient(std::int64_t k) {
    std::int64_t count = 0;
    for (std::int64_t i = 1; i <= k; ++i) count += std::gcd(i, k) == 1 ? 1 : 0;
    return static_cast<int>(count);
}

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

/// The denominator of a decimal in lowest terms: of 2.5 it is 2, of 0.2 it is 5; 0 if it is too large.
std::int64_t decimal_denominator(double value) {
    if (!(std::fabs(value) < 0x1p40)) return 0;
    for (std::int64_t denominator = 1; denominator <= largest_unit; denominator *= 10) {
        const double scaled = value * static_cast<double>(denominator);
        if (std::fabs(scaled) > 0x1p40) return 0;
        const std::int64_t numerator = std::llround(scaled);
        if (static_cast<double>(numerator) / static_cast<double>(denominator) == value) {
            return denominator / std::gcd(denominator, numerator);
        }
    }
    return 0;
}

/// Cosine and sine of at most 45 degrees, within one unit in the last place. The functions of C libraries differ in
/// their last bits, and so would drawings; Taylor's series has the same bits everywhere.
glm::dvec2 small_angle(double radians) {
    const double square = radians * radians;
    double cosine = 0;
    double sine = 0;
    for (int power = 16; power > 0; power -= 2) {
        cosine = square / ((power - 1) * power) * (1 - cosine);
        sine = square / (power * (power + 1)) * (1 - sine);
    }
    return {1 - cosine, radians - radians * sine};
}

}  // namespace

FoldedTurn fold_turn(TurnFraction turn) {
    const std::int64_t q = turn.denominator;
    std::int64_t p = turn.numerator % q;
    if (p < 0) p += q;
    const std::int64_t quarter = (8 * p / q + 1) / 2;
    return {static_cast<int>(quarter % 4), 4 * p - quarter * q};
}

glm::dvec2 unit_vector(TurnFraction turn) {
    const FoldedTurn folded = fold_turn(turn);
    const std::int64_t q = turn.denominator;
    const std::int64_t distance = std::abs(folded.rest);
    glm::dvec2 near(1.0, 0.0);
    if (3 * distance == q) {  // 30 degrees
        near = {std::sqrt(3.0) / 2, 0.5};
    } else if (2 * distance == q) {
        near = glm::dvec2(std::sqrt(0.5));
    } else if (distance != 0) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(distance) / (4 * static_cast<double>(q));
        near = small_angle(angle);
    }
    if (folded.rest < 0) near.y = -near.y;
    return by_quarters(folded.quarter, near);
}

glm::dvec2 unit_vector(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    // Whole multiples of a thousandth of a degree are folded exactly, too.
    const double thousandths = turned * 1000;
    if (thousandths == std::floor(thousandths)) return unit_vector(TurnFraction{std::llround(thousandths), 360'000});
    const double rest = std::remainder(turned, 90.0);
    const auto quarter = static_cast<int>(std::lround((turned - rest) / 90));
    return by_quarters(((quarter % 4) + 4) % 4, small_angle(rest * std::numbers::pi / 180));
}

Lattice make_lattice(const Grammar& grammar) {
    Lattice lattice;
    lattice.first_heading = std::fmod(grammar.heading().degrees, 360.0);
    std::int64_t k = 1;
    std::int64_t denominator = 1;
    bool whole_headings = true;
    bool whole_lengths = true;
    for (const SymbolInfo& symbol : grammar.symbols()) {
        const Command& command = symbol.command;
        if (command.action == Action::turn && whole_headings) {
            whole_headings =
                !command.takes_argument && command.angle.exact && command.angle.exact->denominator <= most_headings;
            if (whole_headings) k = std::lcm(k, command.angle.exact->denominator);
            whole_headings = whole_headings && k <= most_headings;
        }
        if ((command.action == Action::draw || command.action == Action::move) && whole_lengths) {
            const std::int64_t needed = command.takes_argument ? 0 : decimal_denominator(command.value);
            whole_lengths = needed > 0;
            if (whole_lengths) denominator = std::lcm(denominator, needed);
            whole_lengths = whole_lengths && denominator <= largest_unit;
        }
    }
    // Together they may need more than 64 bits.
    for (const SymbolInfo& symbol : grammar.symbols()) {
        const Command& command = symbol.command;
        if (command.action != Action::draw && command.action != Action::move) continue;
        if (!(std::fabs(command.value) * static_cast<double>(denominator) <= 0x1p40)) whole_lengths = false;
    }
    const std::size_t symbols = grammar.symbols().size();
    if (!whole_headings) return lattice;
    if (k <= 2) k = 4;
    lattice.headings = static_cast<std::uint32_t>(k);
    lattice.turn.assign(symbols, 0);
    for (std::size_t i = 0; i < symbols; ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (command.action != Action::turn) continue;
        const TurnFraction turn = *command.angle.exact;
        const std::int64_t steps = turn.numerator * (k / turn.denominator) % k;
        lattice.turn[i] = static_cast<std::uint32_t>(steps < 0 ? steps + k : steps);
    }
    for (std::int64_t h = 0; h < k; ++h) {
        const auto& first = grammar.heading().exact;
        std::int64_t common = 0;
        std::int64_t sum = 0;
        if (first && !__builtin_mul_overflow(first->denominator, k, &common) && common < (std::int64_t{1} << 58) &&
            !__builtin_mul_overflow(first->numerator, k, &sum)) {
            sum += h * first->denominator;
            const std::int64_t divisor = std::gcd(sum, common);
            lattice.direction.push_back(unit_vector(TurnFraction{sum / divisor, common / divisor}));
        } else {
            lattice.direction.push_back(
                unit_vector(lattice.first_heading + 360.0 * static_cast<double>(h) / static_cast<double>(k)));
        }
    }
    if (k > 30 || totient(k) > 8 || !whole_lengths) return lattice;
    lattice.rank = totient(k);
    lattice.unit = 1.0 / static_cast<double>(denominator);
    lattice.length.assign(symbols, 0);
    for (std::size_t i = 0; i < symbols; ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (command.action != Action::draw && command.action != Action::move) continue;
        lattice.length[i] = std::llround(command.value * static_cast<double>(denominator));
    }
    // zeta^(h+1) from zeta^h: shift the coordinates, and replace zeta^rank by the polynomial's other terms.
    const std::vector<int> polynomial = cyclotomic(static_cast<int>(k));
    std::array<std::int8_t, 8> power{};
    power[0] = 1;
    const auto rank = static_cast<std::size_t>(lattice.rank);
    for (std::int64_t h = 0; h < k; ++h) {
        lattice.power.push_back(power);
        const std::int8_t overflow = power[rank - 1];
        for (std::size_t i = rank - 1; i > 0; --i) {
            power[i] = static_cast<std::int8_t>(power[i - 1] - overflow * polynomial[i]);
        }
        power[0] = static_cast<std::int8_t>(-overflow * polynomial[0]);
    }
    return lattice;
}

}  // namespace sikku
