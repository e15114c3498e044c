// Numbers are read and written alike with every standard library.
#include "engine/base/decimal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <system_error>

namespace sikku::decimal_test {

struct Read {
    std::size_t bytes;
    std::errc error;
    double value;
    bool operator==(const Read&) const = default;
};

Read read(std::string_view text) {
    double value = -7;
    const auto [end, error] = parse_number(text, value);
    return {static_cast<std::size_t>(end - text.data()), error, value};
}

TEST(Decimal, ReadsTheNumberThatATextBeginsWith) {
    constexpr std::errc good{};
    EXPECT_EQ(read("2.5mm"), (Read{3, good, 2.5}));
    EXPECT_EQ(read("-.5e-2x"), (Read{6, good, -0.005}));
    EXPECT_EQ(read("5."), (Read{2, good, 5}));
    EXPECT_EQ(read("1e"), (Read{1, good, 1}));
    EXPECT_EQ(read("1,5"), (Read{1, good, 1}));
    EXPECT_EQ(read("0x10"), (Read{1, good, 0}));
    EXPECT_EQ(read("-INF"), (Read{4, good, -std::numeric_limits<double>::infinity()}));
    EXPECT_EQ(read("0e-400"), (Read{6, good, 0}));
    EXPECT_EQ(read("1.7976931348623158e308"), (Read{22, good, std::numeric_limits<double>::max()}));
    EXPECT_EQ(read("3e-324"), (Read{6, good, std::numeric_limits<double>::denorm_min()}));
    EXPECT_TRUE(std::isnan(read("nan").value));
    double zero = 1;
    parse_number("-0", zero);
    EXPECT_TRUE(zero == 0 && std::signbit(zero));
}

TEST(Decimal, KeepsTheValueWhereThereIsNoNumber) {
    for (const std::string_view text : {"", "+1", " 1", ".", "-", "--1", ".e5", "in"}) {
        EXPECT_EQ(read(text), (Read{0, std::errc::invalid_argument, -7})) << text;
    }
}

TEST(Decimal, TellsWhatNoDoubleHolds) {
    for (const std::string_view text :
         {"1e400", "-1e400", "1.7976931348623159e308", "2e-324", "0.1e-99999999999999999999"}) {
        EXPECT_EQ(read(text), (Read{text.size(), std::errc::result_out_of_range, -7})) << text;
    }
}

TEST(Decimal, WritesTheFewestDigits) {
    EXPECT_EQ(shortest_decimal(25.7), "25.7");
    EXPECT_EQ(shortest_decimal(-90), "-90");
    EXPECT_EQ(shortest_decimal(0.1 + 0.2), "0.30000000000000004");
}

}  // namespace sikku::decimal_test
