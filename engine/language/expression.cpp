#include "engine/language/expression.h"

#include "engine/base/characters.h"
#include "engine/base/decimal.h"
#include "engine/base/text.h"
#include "engine/language/function_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {

bool begins_name(char byte) {
    return is_letter(byte) || byte == '_' || static_cast<unsigned char>(byte) >= 0x80;
}
bool continues_name(char byte) {
    return begins_name(byte) || is_digit(byte);
}

namespace {

struct Function {
    std::string_view name;
    unsigned arguments;
    double (*compute)(double a, double b);
};
constexpr Function functions[] = {{"sin", 1, [](double a, double) { return std::sin(a); }},
                                  {"cos", 1, [](double a, double) { return std::cos(a); }},
                                  {"tan", 1, [](double a, double) { return std::tan(a); }},
                                  {"asin", 1, [](double a, double) { return std::asin(a); }},
                                  {"acos", 1, [](double a, double) { return std::acos(a); }},
                                  {"atan", 1, [](double a, double) { return std::atan(a); }},
                                  {"atan2", 2, [](double a, double b) { return std::atan2(a, b); }},
                                  {"exp", 1, [](double a, double) { return std::exp(a); }},
                                  {"log", 1, [](double a, double) { return std::log(a); }},
                                  {"log10", 1, [](double a, double) { return std::log10(a); }},
                                  {"sqrt", 1, [](double a, double) { return std::sqrt(a); }},
                                  {"abs", 1, [](double a, double) { return std::fabs(a); }},
                                  {"floor", 1, [](double a, double) { return std::floor(a); }},
                                  {"ceil", 1, [](double a, double) { return std::ceil(a); }},
                                  {"round", 1, [](double a, double) { return std::round(a); }},
                                  {"min", 2, [](double a, double b) { return std::fmin(a, b); }},
                                  {"max", 2, [](double a, double b) { return std::fmax(a, b); }},
                                  {"mod", 2, [](double a, double b) { return std::fmod(a, b); }},
                                  {"random", 2, nullptr}};

}  // namespace

std::vector<std::string_view> function_names() {
    std::vector<std::string_view> names;
    for (const Function& function : functions) names.push_back(function.name);
    return names;
}

namespace {

/// A number with twice the digits of a double: the sum of both members.
struct TwoDoubles {
    double high = 0, low = 0;
};

/// @param small  not larger than `large` in size
TwoDoubles exact_sum(double large, double small) {
    const double high = large + small;
    return {high, small - (high - large)};
}

/// Source: Dekker, A floating-point technique for extending the available precision, 1971.
TwoDoubles exact_product(double a, double b) {
    constexpr double splitter = 0x1p27 + 1;
    const auto split = [](double value) {
        const double high = splitter * value - (splitter * value - value);
        return TwoDoubles{high, value - high};
    };
    const TwoDoubles x = split(a), y = split(b);
    const double high = a * b;
    return {high, ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

TwoDoubles product(TwoDoubles a, TwoDoubles b) {
    const TwoDoubles high = exact_product(a.high, b.high);
    return exact_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

/// Returns a^b. Whole exponents give the same bits on every machine; the last bit of pow() differs between C
/// libraries, and between processors with and without fused multiply-add.
double power(double a, double b) {
    constexpr double most = 1024;
    if (!(std::fabs(b) <= most) || b != std::floor(b)) return std::pow(a, b);
    TwoDoubles result{1, 0}, square{a, 0};
    for (auto rest = static_cast<unsigned>(std::fabs(b)); rest > 0; rest /= 2) {
        if (rest % 2 == 1) result = product(result, square);
        if (rest > 1) square = product(square, square);
    }
    // Products of much larger or smaller numbers overflow or underflow, and are not exact.
    const double size = std::fabs(result.high);
    if (!(size > 1e-140 && size < 1e140)) return std::pow(a, b);
    if (b >= 0) return result.high + result.low;
    const double inverse = 1 / result.high;
    const TwoDoubles one = exact_product(inverse, result.high);
    return inverse + inverse * ((1 - one.high) - one.low - inverse * result.low);
}

}  // namespace

/// Dijkstra's shunting yard: operators wait on an explicit stack, so that nesting costs memory and no call stack.
class ExpressionCompiler {
public:
    ExpressionCompiler(const Span& text, const NameLookup& names, Diagnostics& diagnostics, std::uint32_t* draws)
        : text_(text), view_(text.view()), names_(names), diagnostics_(diagnostics), draws_(draws) {}

    std::optional<Expression> run() {
        while (skip_blanks(), at_ < view_.size()) {
            if (!(expect_operand_ ? operand() : operator_after_operand())) return std::nullopt;
        }
        if (expect_operand_) return wrong(view_.size(), "expected a number, a name or '('");
        while (!waiting_.empty()) {
            if (waiting_.back().operation == Operation::open) {
                return wrong(waiting_.back().at, "this '(' is not closed");
            }
            emit();
        }
        result_.find_shape();
        return std::move(result_);
    }

private:
    using Operation = Expression::Operation;
    struct Operator {
        std::string_view sign;
        Operation operation;
        int precedence;
    };
    /// Longer signs precede their beginnings.
    static constexpr Operator operators[] = {
        {"||", Operation::disjunction, 1}, {"&&", Operation::conjunction, 2}, {"==", Operation::equal, 3},
        {"!=", Operation::not_equal, 3},   {"<=", Operation::less_equal, 4},  {">=", Operation::greater_equal, 4},
        {"<", Operation::less, 4},         {">", Operation::greater, 4},      {"+", Operation::add, 5},
        {"-", Operation::subtract, 5},     {"*", Operation::multiply, 6},     {"/", Operation::divide, 6},
        {"^", Operation::power, 8}};
    struct Waiting {
        Operation operation;
        std::size_t at;
        const Function* function = nullptr;  ///< for an open parenthesis: its function
        unsigned arguments = 1;              ///< seen so far within the parenthesis
    };
    static int precedence(Operation operation) {
        if (operation == Operation::negate || operation == Operation::complement) return 7;
        const auto* const row = std::find_if(std::begin(operators), std::end(operators),
                                             [&](const Operator& one) { return one.operation == operation; });
        return row == std::end(operators) ? 0 : row->precedence;  // 0: an open parenthesis
    }

    Refused wrong(std::size_t at, const std::string& message) { return diagnostics_.refuse(text_.part(at), message); }

    void skip_blanks() {
        while (at_ < view_.size() && is_blank(view_[at_])) ++at_;
    }

    void emit() {
        const Operation operation = waiting_.back().operation;
        push_operation({operation}, precedence(operation) == 7 ? 1 : 2);
        waiting_.pop_back();
    }

    /// Constant parts are computed while compiling.
    void push_operation(const Expression::Step& step, std::size_t operands) {
        std::vector<Expression::Step>& steps = result_.steps_;
        depth_ -= operands - 1;
        const bool is_constant =
            step.operation != Operation::random &&
            std::all_of(steps.end() - static_cast<std::ptrdiff_t>(operands), steps.end(),
                        [](const Expression::Step& operand) { return operand.operation == Operation::number; });
        if (!is_constant) return steps.push_back(step);
        const double last = steps.back().value;
        if (operands == 2) steps.pop_back();
        steps.back().value = Expression::apply(step, steps.back().value, last);
    }

    void push_value(const Expression::Step& step) {
        result_.steps_.push_back(step);
        result_.stack_ = std::max(result_.stack_, ++depth_);
        expect_operand_ = false;
    }

    bool operand() {
        const char byte = view_[at_];
        const std::size_t begin = at_;
        if (byte == '(') {
            waiting_.push_back({Operation::open, at_++});
            return true;
        }
        if (byte == '-' || byte == '!' || byte == '+') {
            if (byte != '+') waiting_.push_back({byte == '-' ? Operation::negate : Operation::complement, at_});
            ++at_;
            return true;
        }
        if (is_digit(byte) || byte == '.') return number();
        if (!begins_name(byte)) return wrong(begin, "expected a number, a name or '('");
        while (at_ < view_.size() && continues_name(view_[at_])) ++at_;
        const std::string_view name = view_.substr(begin, at_ - begin);
        skip_blanks();
        if (at_ < view_.size() && view_[at_] == '(') return function(name, begin);
        const auto meaning = names_(name);
        if (!meaning) return wrong(begin, fmt::format("'{}' is not defined", name));
        if (meaning->is_formal) {
            push_value({Operation::formal, meaning->slot});
        } else {
            push_value({Operation::number, 0, meaning->value});
        }
        return true;
    }

    bool number() {
        double value = 0;
        const std::size_t begin = at_;
        const auto [end, error] = parse_number(view_.substr(at_), value);
        if (error != std::errc()) return wrong(begin, "this number is out of range");
        at_ = static_cast<std::size_t>(end - view_.data());
        if (at_ < view_.size() && (continues_name(view_[at_]) || view_[at_] == '.')) {
            return wrong(at_, "expected the number to end here");
        }
        push_value({Operation::number, 0, value});
        return true;
    }

    bool function(std::string_view name, std::size_t begin) {
        const auto* const row = std::find_if(std::begin(functions), std::end(functions),
                                             [&](const Function& known) { return known.name == name; });
        if (row == std::end(functions)) return wrong(begin, fmt::format("unknown function '{}'", name));
        if (!row->compute && !draws_) return wrong(begin, "'random' is not allowed here");
        waiting_.push_back({Operation::open, at_++, row});
        return true;
    }

    bool close(std::size_t at) {
        while (!waiting_.empty() && waiting_.back().operation != Operation::open) emit();
        if (waiting_.empty()) return wrong(at, "this ')' has no '('");
        const Waiting open = waiting_.back();
        waiting_.pop_back();
        if (!open.function) return true;
        if (const unsigned wanted = open.function->arguments; open.arguments != wanted) {
            return wrong(open.at,
                         fmt::format("this function takes {}, not {}", counted(wanted, "argument"), open.arguments));
        }
        Expression::Step step{open.arguments == 1 ? Operation::function : Operation::function2,
                              static_cast<std::uint32_t>(open.function - functions)};
        if (!open.function->compute) {
            step = {Operation::random, (*draws_)++};
            result_.uses_chance_ = true;
        }
        push_operation(step, open.arguments);
        return true;
    }

    bool comma(std::size_t at) {
        while (!waiting_.empty() && waiting_.back().operation != Operation::open) emit();
        if (waiting_.empty() || !waiting_.back().function) return wrong(at, "a ',' outside a function's arguments");
        ++waiting_.back().arguments;
        expect_operand_ = true;
        return true;
    }

    bool operator_after_operand() {
        const std::size_t begin = at_;
        const std::string_view rest = view_.substr(at_);
        if (rest[0] == ')') return close(at_++);
        if (rest[0] == ',') return comma(at_++);
        const auto* const row = std::find_if(std::begin(operators), std::end(operators),
                                             [&](const Operator& one) { return rest.starts_with(one.sign); });
        if (rest.starts_with("=>")) return wrong(begin, "'=>' is not an operator; did you mean '>='?");
        if (rest.starts_with("=<")) return wrong(begin, "'=<' is not an operator; did you mean '<='?");
        if (row == std::end(operators)) {
            return wrong(begin,
                         rest[0] == '=' ? "expected '==' (a single '=' compares nothing)" : "expected an operator");
        }
        const auto [sign, operation, level] = *row;
        at_ += sign.size();
        const bool right_associative = operation == Operation::power;
        while (!waiting_.empty() && waiting_.back().operation != Operation::open &&
               (precedence(waiting_.back().operation) > level ||
                (precedence(waiting_.back().operation) == level && !right_associative))) {
            emit();
        }
        waiting_.push_back({operation, begin});
        expect_operand_ = true;
        return true;
    }

    const Span& text_;
    std::string_view view_;
    const NameLookup& names_;
    Diagnostics& diagnostics_;
    std::uint32_t* draws_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    bool expect_operand_ = true;
    std::vector<Waiting> waiting_;
    Expression result_;
};

std::optional<Expression> Expression::compile(const Span& text, const NameLookup& names, Diagnostics& diagnostics,
                                              std::uint32_t* draws) {
    return ExpressionCompiler(text, names, diagnostics, draws).run();
}

void Expression::find_shape() {
    const auto is = [&](std::size_t i, Operation operation) { return steps_[i].operation == operation; };
    shape_ = Shape::steps;
    if (steps_.size() == 1) {
        shape_ = is(0, Operation::number) ? Shape::number : Shape::formal;
        slot_ = steps_[0].slot;
        number_ = steps_[0].value;
    } else if (steps_.size() == 3) {
        const bool number_first = is(0, Operation::number) && is(1, Operation::formal);
        if (!number_first && !(is(0, Operation::formal) && is(1, Operation::number))) return;
        if (is(2, Operation::multiply)) {
            shape_ = Shape::product;
        } else if (is(2, Operation::add) || (is(2, Operation::subtract) && !number_first)) {
            shape_ = Shape::sum;
        } else if (is(2, number_first ? Operation::less_equal : Operation::greater_equal)) {
            shape_ = Shape::at_least;
        } else {
            return;
        }
        slot_ = steps_[number_first ? 1 : 0].slot;
        number_ = steps_[number_first ? 0 : 1].value;
        if (is(2, Operation::subtract)) number_ = -number_;  // a - b is a + -b, in IEEE arithmetic too
    }
    if (shape_ != Shape::steps) steps_ = {};
}

double Expression::apply(const Step& step, double a, double b) {
    switch (step.operation) {
        case Operation::negate:
            return -a;
        case Operation::complement:
            return a == 0 ? 1.0 : 0.0;
        case Operation::power:
            return power(a, b);
        case Operation::multiply:
            return a * b;
        case Operation::divide:
            return a / b;
        case Operation::add:
            return a + b;
        case Operation::subtract:
            return a - b;
        case Operation::less:
            return a < b ? 1.0 : 0.0;
        case Operation::less_equal:
            return a <= b ? 1.0 : 0.0;
        case Operation::greater:
            return a > b ? 1.0 : 0.0;
        case Operation::greater_equal:
            return a >= b ? 1.0 : 0.0;
        case Operation::equal:
            return a == b ? 1.0 : 0.0;
        case Operation::not_equal:
            return a != b ? 1.0 : 0.0;
        case Operation::conjunction:
            return a != 0 && b != 0 ? 1.0 : 0.0;
        case Operation::disjunction:
            return a != 0 || b != 0 ? 1.0 : 0.0;
        default:
            return functions[step.slot].compute(a, b);
    }
}

double Expression::evaluate_steps(std::span<const double> formals, const Chance& chance) const {
    std::array<double, 16> small;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    std::vector<double> large(stack_ > small.size() ? stack_ : 0);
    double* next = large.empty() ? small.data() : large.data();  // where the next value goes
    for (const Step& step : steps_) {
        if (step.operation == Operation::number) {
            *next++ = step.value;
        } else if (step.operation == Operation::formal) {
            *next++ = formals[step.slot];
        } else if (step.operation < Operation::power) {
            next[-1] = apply(step, next[-1], 0.0);
        } else {
            --next;
            next[-1] = step.operation == Operation::random
                           ? next[-1] + (next[0] - next[-1]) * chance.uniform(step.slot)
                           : apply(step, next[-1], next[0]);
        }
    }
    return next[-1];
}

}  // namespace sikku
