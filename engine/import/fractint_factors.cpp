#include "engine/import/fractint_factors.h"

#include "engine/base/decimal.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <utility>

namespace sikku::fractint {
namespace {

constexpr std::size_t most_integer_digits = 18;  // that an integer of 64 bits holds

/// A fraction above 0 in lowest terms.
struct Fraction {
    std::uint64_t over = 1, under = 1;
    bool operator==(const Fraction&) const = default;
};

Fraction inverse(const Fraction& fraction) {
    return {fraction.under, fraction.over};
}

/// Returns the exact value of `0.75`; nullopt if it has too many digits.
std::optional<Fraction> fraction_of(const std::string& text) {
    Fraction fraction{0, 1};
    std::size_t digits = 0;
    const std::size_t point = std::min(text.find('.'), text.size());
    std::size_t end = text.size();
    if (point < text.size()) end = text.find_last_not_of('0') + 1;
    for (std::size_t i = 0; i < end; ++i) {
        if (text[i] == '.') continue;
        if (digits > 0 || text[i] != '0') ++digits;
        if (digits > most_integer_digits || (i > point && i - point > most_integer_digits)) return std::nullopt;
        fraction.over = 10 * fraction.over + static_cast<std::uint64_t>(text[i] - '0');
        if (i > point) fraction.under *= 10;
    }
    if (fraction.over == 0) return std::nullopt;
    const std::uint64_t common = std::gcd(fraction.over, fraction.under);
    return Fraction{fraction.over / common, fraction.under / common};
}

/// Returns the root of a power: root_of(1000, 3) is 10. Nullopt if there is none among whole numbers.
std::optional<std::uint64_t> root_of(std::uint64_t power, int degree) {
    const auto near = static_cast<std::uint64_t>(std::llround(std::pow(static_cast<double>(power), 1.0 / degree)));
    for (std::uint64_t root = near > 1 ? near - 1 : 1; root <= near + 1; ++root) {
        std::uint64_t product = power;
        int taken = 0;
        while (taken < degree && product % root == 0) {
            product /= root;
            ++taken;
        }
        if (taken == degree && product == 1) return root;
    }
    return std::nullopt;
}

/// Replaces a fraction by its root of the highest degree, and returns that degree.
int take_root(Fraction& fraction) {
    for (int degree = 62; degree > 1; --degree) {
        const auto over = root_of(fraction.over, degree);
        const auto under = root_of(fraction.under, degree);
        if (!over || !under) continue;
        fraction = {*over, *under};
        return degree;
    }
    return 1;
}

/// Divides `number` by `factor` as often as possible, and returns how often.
std::int32_t divide_out(std::uint64_t& number, std::uint64_t factor) {
    std::int32_t times = 0;
    while (number % factor == 0) {
        number /= factor;
        ++times;
    }
    return times;
}

/// Pairwise coprime whole numbers above 1; all numerators and denominators are products of their powers.
std::vector<std::uint64_t> coprime_base(const std::vector<Fraction>& fractions) {
    std::vector<std::uint64_t> base, pending;
    for (const Fraction& fraction : fractions) {
        pending.push_back(fraction.over);
        pending.push_back(fraction.under);
    }
    while (!pending.empty()) {
        std::uint64_t number = pending.back();
        pending.pop_back();
        for (std::size_t i = 0; i < base.size() && number > 1; ++i) {
            const std::uint64_t common = std::gcd(number, base[i]);
            if (common == 1) continue;
            if (common == base[i]) {
                divide_out(number, common);
                i = static_cast<std::size_t>(-1);
                continue;
            }
            // Both numbers split into smaller ones.
            pending.push_back(number / common);
            pending.push_back(base[i] / common);
            pending.push_back(common);
            base.erase(base.begin() + static_cast<std::ptrdiff_t>(i));
            number = 1;
        }
        if (number > 1) base.push_back(number);
    }
    std::sort(base.begin(), base.end());
    return base;
}

std::vector<std::int32_t> exponents_of(Fraction fraction, const std::vector<std::uint64_t>& base) {
    std::vector<std::int32_t> exponents;
    for (const std::uint64_t factor : base) {
        const std::int32_t over = divide_out(fraction.over, factor);
        exponents.push_back(over - divide_out(fraction.under, factor));
    }
    return exponents;
}

/// True if the rows are linearly independent. Long double pivots would suffice, but a prime modulus proves
/// that rows found independent are independent.
bool are_independent(const std::vector<std::vector<std::int32_t>>& rows) {
    constexpr std::int64_t modulus = 2'147'483'647;  // a prime number
    const auto inverse_of = [](std::int64_t number) {
        std::int64_t result = 1;
        for (std::int64_t power = modulus - 2; power > 0; power /= 2) {
            if (power % 2 == 1) result = result * number % modulus;
            number = number * number % modulus;
        }
        return result;
    };
    std::vector<std::vector<std::int64_t>> left;
    for (const auto& row : rows) {
        left.emplace_back();
        for (const std::int32_t one : row) left.back().push_back((one % modulus + modulus) % modulus);
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
        const auto pivot = std::find_if(left[i].begin(), left[i].end(), [](std::int64_t one) { return one != 0; });
        if (pivot == left[i].end()) return false;
        const auto column = static_cast<std::size_t>(pivot - left[i].begin());
        const std::int64_t scale = inverse_of(*pivot);
        for (std::size_t k = i + 1; k < left.size(); ++k) {
            const std::int64_t share = left[k][column] * scale % modulus;
            for (std::size_t j = 0; share != 0 && j < left[k].size(); ++j) {
                left[k][j] = ((left[k][j] - share * left[i][j]) % modulus + modulus) % modulus;
            }
        }
    }
    return true;
}

/// A number and a power of two: values far beyond the range of doubles.
struct Scaled {
    double part = 1.0;
    std::int64_t exponent = 0;

    void multiply(const Scaled& other) {
        int shift = 0;
        part = std::frexp(part * other.part, &shift);
        exponent += other.exponent + shift;
    }
};

}  // namespace

Factors find_factors(const std::vector<std::string>& numbers) {
    Factors factors;
    std::vector<std::optional<Fraction>> exact;
    std::vector<int> degrees(numbers.size(), 1);    // each number is its root to this power,
    std::vector<std::size_t> root(numbers.size());  // which has this index among the roots
    std::vector<Fraction> roots;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        exact.push_back(fraction_of(numbers[i]));
        if (!exact[i]) continue;
        Fraction base = *exact[i];
        degrees[i] = take_root(base);
        auto found = std::find(roots.begin(), roots.end(), base);
        if (found == roots.end()) {
            found = std::find(roots.begin(), roots.end(), inverse(base));
            if (found != roots.end()) degrees[i] = -degrees[i];
        }
        root[i] = static_cast<std::size_t>(found - roots.begin());
        if (found == roots.end() && base != Fraction()) roots.push_back(base);
    }
    const auto is_one = [&](std::size_t i) { return exact[i] == Fraction(); };
    const std::vector<std::uint64_t> coprime = coprime_base(roots);
    std::vector<std::vector<std::int32_t>> rows;
    for (const Fraction& one : roots) rows.push_back(exponents_of(one, coprime));
    std::size_t columns = 0;
    std::vector<std::vector<std::int32_t>> of_roots(roots.size());  // exponents of each root
    if (are_independent(rows)) {
        for (std::size_t k = 0; k < roots.size(); ++k) {
            // The only number with this root represents it.
            std::size_t users = 0, user = 0;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                if (!exact[i] || is_one(i) || root[i] != k) continue;
                ++users;
                user = i;
            }
            double value = static_cast<double>(roots[k].over) / static_cast<double>(roots[k].under);
            if (users == 1) {
                degrees[user] = 1;
                parse_number(numbers[user], value);
            }
            factors.values.push_back(value);
            of_roots[k].assign(roots.size(), 0);
            of_roots[k][k] = 1;
        }
        columns = roots.size();
    } else {
        for (const std::uint64_t factor : coprime) factors.values.push_back(static_cast<double>(factor));
        of_roots = std::move(rows);
        columns = coprime.size();
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::vector<std::int32_t> row(columns, 0);
        if (exact[i] && !is_one(i)) {
            for (std::size_t j = 0; j < columns; ++j) row[j] = degrees[i] * of_roots[root[i]][j];
        }
        factors.exponents.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (exact[i]) continue;
        double value = 1;
        parse_number(numbers[i], value);
        for (auto& row : factors.exponents) row.push_back(0);
        factors.exponents[i].back() = 1;
        factors.values.push_back(value);
    }
    return factors;
}

double product_of_powers(const std::vector<double>& values, const std::vector<std::int64_t>& halves) {
    Scaled product;
    for (std::size_t i = 0; i < values.size(); ++i) {
        Scaled power{1.0, 0};
        power.multiply({halves[i] % 2 != 0 ? std::sqrt(values[i]) : 1.0, 0});
        Scaled square{1.0, 0};
        square.multiply({values[i], 0});
        for (std::int64_t times = std::abs(halves[i]) / 2; times > 0; times /= 2) {
            if (times % 2 == 1) power.multiply(square);
            const Scaled once = square;
            square.multiply(once);
        }
        if (halves[i] < 0) power = {1 / power.part, -power.exponent};
        product.multiply(power);
    }
    if (product.exponent > 4000) return HUGE_VAL;
    if (product.exponent < -4000) return 0.0;
    return std::ldexp(product.part, static_cast<int>(product.exponent));
}

}  // namespace sikku::fractint
