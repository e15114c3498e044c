#include "engine/language/expression.h"
#include "tests/checks.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

namespace sikku::expression_test {

struct Compiled {
    std::optional<Expression> expression;
    std::vector<Diagnostic> errors;
};

/// Names a, b and α are constants; x and y formals.
Compiled compile(const std::string& text) {
    const auto source = std::make_shared<const Source>("test", text);
    const std::map<std::string, NameMeaning, std::less<>> names = {
        {"a", {false, 3}},   {"b", {false, 0.5}}, {"\xCE\xB1", {false, 7}}, {"sin", {false, 9}},
        {"_1", {false, 11}}, {"x", {true, 0, 0}}, {"y", {true, 0, 1}}};
    Diagnostics diagnostics;
    auto expression = Expression::compile(
        Span{source, 0, text.size()},
        [&](std::string_view name) -> std::optional<NameMeaning> {
            const auto found = names.find(name);
            return found == names.end() ? std::nullopt : std::optional(found->second);
        },
        diagnostics);
    EXPECT_EQ(expression.has_value(), diagnostics.list().empty()) << text;
    return {std::move(expression), diagnostics.list()};
}
double value(const std::string& text, const std::vector<double>& formals = {}) {
    const auto compiled = compile(text);
    for (const Diagnostic& error : compiled.errors) ADD_FAILURE() << error.text();
    return compiled.expression ? compiled.expression->evaluate(formals) : std::nan("");
}
void expect_mistake(const std::string& text, int column, const std::string& essence) {
    const auto compiled = compile(text);
    ASSERT_EQ(compiled.errors.size(), 1u) << text;
    EXPECT_EQ(compiled.errors[0].where, (Place{1, column})) << compiled.errors[0].text();
    EXPECT_TRUE(has(compiled.errors[0].message, essence)) << compiled.errors[0].text();
}

TEST(Expression, OperatorsBindAsTheLanguageSays) {
    for (const auto& [text, expected] : {std::pair{"1 + 2 * 3", 7.0},
                                         {"(1 + 2) * 3", 9.0},
                                         {"7 - 2 - 1", 4.0},
                                         {"8 / 4 / 2", 1.0},
                                         {"2 ^ 3 ^ 2", 512.0},
                                         {"-2 ^ 2", -4.0},
                                         {"2 ^ -2", 0.25},
                                         {"2 ^ -1 * 4", 2.0},
                                         {"-2 * -3", 6.0},
                                         {"- - 3", 3.0},
                                         {"2 - -3", 5.0},
                                         {"!0", 1.0},
                                         {"!5", 0.0},
                                         {"!0 + 1", 2.0},
                                         {"!2 ^ 0", 0.0},
                                         {"-!0", -1.0},
                                         {"1 + 1 < 3", 1.0},
                                         {"1 < 2 == 1", 1.0},
                                         {"3 == 3 != 0", 1.0},
                                         {"2 <= 2", 1.0},
                                         {"2 >= 3", 0.0},
                                         {"2 > 1", 1.0},
                                         {"1 || 0 && 0", 1.0},
                                         {"0 == 1 || 2 > 1", 1.0},
                                         {"2 && 3", 1.0},
                                         {"0 || 0.5", 1.0},
                                         {"1e2 + .5", 100.5},
                                         {"1.5e-1", 0.15},
                                         {" 4\t", 4.0},
                                         {"a * b", 1.5},
                                         {"\xCE\xB1+1", 8.0},
                                         {"sin + _1", 20.0}}) {
        EXPECT_DOUBLE_EQ(value(text), expected) << text;
    }
}

TEST(Expression, FunctionsAreThoseOfTheLanguage) {
    for (const auto& [text, expected] : {std::pair{"sin(1)", std::sin(1.0)},
                                         {"cos(1)", std::cos(1.0)},
                                         {"tan(1)", std::tan(1.0)},
                                         {"asin(0.5)", std::asin(0.5)},
                                         {"acos(0.5)", std::acos(0.5)},
                                         {"atan(2)", std::atan(2.0)},
                                         {"atan2(1, 0-2)", std::atan2(1.0, -2.0)},
                                         {"exp(2)", std::exp(2.0)},
                                         {"log(2)", std::log(2.0)},
                                         {"log10(1000)", 3.0},
                                         {"sqrt(2)", std::sqrt(2.0)},
                                         {"abs(-3)", 3.0},
                                         {"floor(-1.5)", -2.0},
                                         {"ceil(-1.5)", -1.0},
                                         {"round(1.5)", 2.0},
                                         {"min(3, 2)", 2.0},
                                         {"max(3, 2)", 3.0},
                                         {"mod(7, 4)", 3.0},
                                         {"sin (0)", 0.0},
                                         {"max(min(1, 2), min(4, 3))", 3.0},
                                         {"2*max(1, 2)^2", 8.0},
                                         {"atan2((1), (2+3)*2)", std::atan2(1.0, 10.0)}}) {
        EXPECT_DOUBLE_EQ(value(text), expected) << text;
    }
    EXPECT_TRUE(std::isinf(value("1/0")));
    EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
}

TEST(Expression, FormalsAreLookedUpWhenEvaluated) {
    const auto compiled = compile("x * 10 + y");
    ASSERT_TRUE(compiled.expression);
    EXPECT_EQ(compiled.expression->evaluate(std::vector{4.0, 2.0}), 42.0);
    EXPECT_EQ(compiled.expression->evaluate(std::vector{1.0, 1.0}), 11.0);
}

TEST(Expression, MistakesNameTheirPlace) {
    expect_mistake("", 1, "expected a number");
    expect_mistake("1 +", 4, "expected a number");
    expect_mistake("1 2", 3, "expected an operator");
    expect_mistake("* 2", 1, "expected a number");
    expect_mistake("(1 + 2", 1, "not closed");
    expect_mistake("1 + 2)", 6, "has no '('");
    expect_mistake("()", 2, "expected a number");
    expect_mistake("c + 1", 1, "'c' is not defined");
    expect_mistake("1 + A", 5, "'A' is not defined");  // names are case-sensitive
    expect_mistake("sine(1)", 1, "unknown function 'sine'");
    expect_mistake("a(1)", 1, "unknown function 'a'");
    expect_mistake("sin(1, 2)", 4, "takes 1 argument, not 2");
    expect_mistake("max(1)", 4, "takes 2 arguments, not 1");
    expect_mistake("max(1, )", 8, "expected a number");
    expect_mistake("1, 2", 2, "','");
    expect_mistake("max((1, 2), 3)", 7, "','");
    expect_mistake("random(0, 1)", 1, "not allowed here");
    expect_mistake("1 = 1", 3, "'=='");
    expect_mistake("1 & 1", 3, "expected an operator");
    expect_mistake("1 | 1", 3, "expected an operator");
    expect_mistake("1 ! 1", 3, "expected an operator");
    expect_mistake("1 ? 2", 3, "expected an operator");
    expect_mistake("2a", 2, "number to end");
    expect_mistake("1.2.3", 4, "number to end");
    expect_mistake("0x10", 2, "number to end");
    expect_mistake("1e400", 1, "number is out of range");
    expect_mistake("\xCE\xB1 + \xCE\xB2", 5, "is not defined");
}

TEST(Expression, AgreesWithRecursiveDescent) {
    const std::vector<std::string> operators = {
        "+", "-", "*", "/", "^", "<", "<=", ">", ">=", "==", "!=", "&&", "||"};
    for (unsigned seed = 0; seed < 2000; ++seed) {
        std::mt19937 dice(seed);
        const std::function<std::string(int)> make = [&](int depth) -> std::string {
            switch (depth == 0 ? 0U : dice() % 7) {
                case 0:
                    return std::to_string(dice() % 4);
                case 1:
                    return "-" + make(depth - 1);
                case 2:
                    return "!" + make(depth - 1);
                case 3:
                    return "(" + make(depth - 1) + ")";
                case 4:
                    return "max(" + make(depth - 1) + ", " + make(depth - 1) + ")";
                default:
                    return make(depth - 1) + " " + operators[dice() % operators.size()] + " " + make(depth - 1);
            }
        };
        const std::string text = make(5);
        const double expected = reference::Calculator(text, {}, {}, 0).result();
        const double found = value(text);
        if (std::isnan(expected)) {
            EXPECT_TRUE(std::isnan(found)) << text;
        } else {
            EXPECT_EQ(found, expected) << text;
        }
    }
}

TEST(Expression, NestsAsDeepAsMemoryAllows) {
    const std::size_t deep = 1'000'000;
    EXPECT_EQ(value(std::string(deep, '(') + "1" + std::string(deep, ')')), 1.0);
    EXPECT_EQ(value(std::string(deep, '-') + "1"), 1.0);
    std::string tower = "1";
    for (int i = 0; i < 100'000; ++i) tower += "^1";
    EXPECT_EQ(value(tower), 1.0);
    std::string sum = "0";
    for (int i = 0; i < 100'000; ++i) sum += "+(1";
    EXPECT_EQ(value(sum + std::string(100'000, ')')), 100'000.0);
}

/// A correctly rounded power is the same on every machine.
TEST(Expression, WholePowersAreCorrectlyRounded) {
    using Real = boost::multiprecision::cpp_bin_float_100;
    const auto compiled = compile("x^y");
    ASSERT_TRUE(compiled.expression);
    std::mt19937_64 random(5);
    for (int i = 0; i < 20'000; ++i) {
        const double base =
            std::ldexp(static_cast<double>(random() % 2'000'001) - 1e6, -static_cast<int>(random() % 40));
        const int exponent = static_cast<int>(random() % 61) - 30;
        if (base == 0) continue;
        Real exact = 1;
        for (int k = 0; k < std::abs(exponent); ++k) exact *= base;
        if (exponent < 0) exact = 1 / exact;
        if (!(abs(exact) > 1e-140 && abs(exact) < 1e140)) continue;
        const std::vector<double> formals = {base, static_cast<double>(exponent)};
        ASSERT_EQ(compiled.expression->evaluate(formals), exact.convert_to<double>()) << base << "^" << exponent;
    }
    // The first one differs between two C libraries.
    EXPECT_EQ(value("1.4^12"), 0x1.c58d21ee717c9p+5);
    EXPECT_EQ(value("10^22"), 1e22);
    EXPECT_EQ(value("10^-3"), 1e-3);
}

}  // namespace sikku::expression_test
