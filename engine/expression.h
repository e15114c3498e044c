// engine/expression.h: arithmetic of pattern files, compiled once and evaluated often.
#pragma once

#include "engine/diagnostic.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// What a name in an expression stands for: a constant, or the value of a formal parameter.
struct NameMeaning {
    bool is_formal = false;
    double value = 0.0;      ///< of a constant
    std::uint32_t slot = 0;  ///< of a formal: index into the values given to evaluate()
};
/// Looks a name up; nullopt for one that means nothing here.
using NameLookup = std::function<std::optional<NameMeaning>(std::string_view name)>;

/// `+ - * / ^`, comparisons, `&& ||`, functions of the pattern language, in reverse Polish order.
/// Division by zero and domain errors give what IEEE arithmetic gives.
class Expression {
public:
    /// Compiles the whole of `text`. Nullopt after a mistake, which goes to `diagnostics`. No recursion: nesting is
    /// limited by memory only. `random` is not known yet. Cost: linear.
    static std::optional<Expression> compile(const Span& text, const NameLookup& names, Diagnostics& diagnostics);

    /// @param formals  a value for each slot that the names gave
    double evaluate(std::span<const double> formals = {}) const;

private:
    enum class Operation : std::uint8_t {
        number,
        formal,
        negate,
        complement,
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
        open,
        sine,
        cosine,
        tangent,
        arcsine,
        arccosine,
        arctangent,
        arctangent2,
        exponential,
        logarithm,
        logarithm10,
        square_root,
        absolute,
        floor,
        ceiling,
        round,
        minimum,
        maximum,
        modulo
    };
    struct Step {
        Operation operation;
        std::uint32_t slot = 0;
        double value = 0.0;
    };
    friend class ExpressionCompiler;

    std::vector<Step> steps_;
    std::size_t stack_ = 0;  ///< most values at a time
};

/// True for a byte that may begin a name of an expression: a letter, `_`, or any byte of a code point beyond ASCII.
bool begins_name(char byte);
/// True for a byte that may go on in a name.
bool continues_name(char byte);

}  // namespace sikku
