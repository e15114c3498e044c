// tests/engine/fractint_factors_test.cpp: numbers as products of powers of independent factors.
#include "engine/import/fractint_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sikku::fractint::fractint_factors_test {

TEST(FractintFactors, AreIndependent) {
    const auto exponents = [](const std::vector<std::string>& numbers) { return find_factors(numbers).exponents; };
    using Rows = std::vector<std::vector<std::int32_t>>;
    EXPECT_EQ(exponents({".5", "2"}), (Rows{{1}, {-1}}));
    EXPECT_EQ(exponents({"4", "8", "0.50"}), (Rows{{2}, {3}, {-1}}));
    EXPECT_EQ(exponents({"1", "3"}), (Rows{{0}, {1}}));
    EXPECT_EQ(exponents({"2", "3", "6"}), (Rows{{1, 0}, {0, 1}, {1, 1}}));
    EXPECT_EQ(exponents({".75", "1.5"}), (Rows{{1, 0}, {0, 1}}));
    EXPECT_EQ(exponents({"0.1234567890123456789012", "2"}), (Rows{{0, 1}, {1, 0}}));
    // Every number is the product of the powers, whatever the numbers are.
    std::mt19937 random(11);
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::string> numbers;
        for (std::size_t i = random() % 6 + 1; i > 0; --i) {
            const auto whole = random() % 40;
            const auto part = random() % (round % 2 == 0 ? 100 : 1000);
            if (whole + part > 0) numbers.push_back(std::to_string(whole) + "." + std::to_string(part));
        }
        const Factors factors = find_factors(numbers);
        ASSERT_EQ(factors.exponents.size(), numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            std::vector<std::int64_t> halves;
            double product = 1;
            for (std::size_t k = 0; k < factors.values.size(); ++k) {
                product *= std::pow(factors.values[k], factors.exponents[i][k]);
                halves.push_back(2 * std::int64_t{factors.exponents[i][k]});
            }
            const double value = std::stod(numbers[i]);
            EXPECT_NEAR(product / value, 1, 1e-12) << numbers[i];
            EXPECT_NEAR(product_of_powers(factors.values, halves) / value, 1, 1e-12) << numbers[i];
        }
    }
    EXPECT_NEAR(product_of_powers({0.3, 1 / 0.3}, {200'001, 200'001}), 1, 1e-9);
    EXPECT_DOUBLE_EQ(product_of_powers({2}, {-1}), std::sqrt(0.5));
    EXPECT_EQ(product_of_powers({2}, {20'000}), HUGE_VAL);
    EXPECT_EQ(product_of_powers({2}, {-20'000}), 0);
}

}  // namespace sikku::fractint::fractint_factors_test
