// engine/language/expression.h: compiles and evaluates the expressions of pattern files.
#pragma once

#include "engine/base/chance.h"
#include "engine/base/diagnostic.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// The meaning of a name in an expression: a constant, or the value of a formal parameter.
struct NameMeaning {
    bool is_formal = false;
    double value = 0.0;      ///< value of a constant
    std::uint32_t slot = 0;  ///< slot of a formal: index into the values given to evaluate()
};
/// Looks a name up; nullopt for an unknown name.
using NameLookup = std::function<std::optional<NameMeaning>(std::string_view name)>;

/// A compiled expression in reverse Polish order: `+ - * / ^`, comparisons, `&& ||` and the functions of the pattern
/// language, with constant parts computed beforehand. Division by zero and domain errors follow IEEE arithmetic.
class Expression {
public:
    /// Compiles the whole of `text`. Nullopt after an error, which goes to `diagnostics`. No recursion: nesting is
    /// limited by memory only. Cost: linear.
    /// @param draws  counts the calls of `random`, whose numbers select their draws; null where `random` is not
    /// allowed
    static std::optional<Expression> compile(const Span& text, const NameLookup& names, Diagnostics& diagnostics,
                                             std::uint32_t* draws = nullptr);

    /// @param formals  a value for each slot that the names gave
    double evaluate(std::span<const double> formals = {}, const Chance& chance = {}) const {
        switch (shape_) {
            case Shape::number:
                return number_;
            case Shape::formal:
                return formals[slot_];
            case Shape::product:
                return formals[slot_] * number_;
            case Shape::sum:
                return formals[slot_] + number_;
            case Shape::at_least:
                return formals[slot_] >= number_ ? 1.0 : 0.0;
            default:
                return evaluate_steps(formals, chance);
        }
    }

    /// The value, if it is always the same.
    std::optional<double> constant() const { return shape_ == Shape::number ? std::optional(number_) : std::nullopt; }
    bool uses_chance() const { return uses_chance_; }

private:
    enum class Operation : std::uint8_t {
        number,
        formal,
        open,
        // with one operand
        negate,
        complement,
        function,  ///< its slot is an index into the table of functions
        // with two operands
        power,
        multiply,
        divide,
        add,
        subtract,
        less,
        less_equal,
        greater,
        greater_equal,
        equal,
        not_equal,
        conjunction,
        disjunction,
        function2,
        random  ///< its slot is the number of the draw
    };
    struct Step {
        Operation operation;
        std::uint32_t slot = 0;
        double value = 0.0;
    };
    /// The shape of the expression. Most shapes are evaluated directly; the others are `steps`.
    enum class Shape : std::uint8_t { number, formal, product, sum, at_least, steps };
    friend class ExpressionCompiler;

    static double apply(const Step& step, double a, double b);
    double evaluate_steps(std::span<const double> formals, const Chance& chance) const;
    void find_shape();

    Shape shape_ = Shape::number;
    bool uses_chance_ = false;
    std::uint32_t slot_ = 0;  // for all shapes but `steps`: a formal, a number, or both
    double number_ = 0.0;
    std::vector<Step> steps_;  // steps for the others; empty if the shape suffices
    std::size_t stack_ = 0;    // most values at a time
};

/// True for a byte that may begin a name of an expression: a letter, `_`, or any byte of a code point beyond ASCII.
bool begins_name(char byte);
/// True for a byte that may continue a name.
bool continues_name(char byte);

}  // namespace sikku
