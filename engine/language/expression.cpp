#include "engine/language/expression.h"

#include "engine/base/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {

bool begins_name(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '_' ||
           static_cast<unsigned char>(byte) >= 0x80;
}
bool continues_name(char byte) {
    return begins_name(byte) || (byte >= '0' && byte <= '9');
}

/// Dijkstra's shunting yard: operators wait on an explicit stack, so that nesting costs memory and no call stack.
class ExpressionCompiler {
public:
    ExpressionCompiler(const Span& text, const NameLookup& names, Diagnostics& diagnostics, std::uint32_t* draws)
        : text_(text), view_(text.view()), names_(names), diagnostics_(diagnostics), draws_(draws) {}

    std::optional<Expression> run() {
        while (skip_blanks(), at_ < view_.size()) {
            if (!(expect_operand_ ? operand() : operator_after_operand())) return std::nullopt;
        }
        if (expect_operand_) return fail(view_.size(), "expected a number, a name or '('");
        while (!waiting_.empty()) {
            if (waiting_.back().operation == Operation::open) {
                return fail(waiting_.back().at, "this '(' is not closed");
            }
            emit();
        }
        result_.find_shape();
        return std::move(result_);
    }

private:
    using Operation = Expression::Operation;
    struct Waiting {
        Operation operation;
        std::size_t at;
        Operation function = Operation::open;  ///< for an open parenthesis: its function
        int arguments = 1;                     ///< seen so far within the parenthesis
    };
    struct Function {
        std::string_view name;
        Operation operation;
        int arguments;
    };
    static constexpr std::array<Function, 19> functions = {{{"sin", Operation::sine, 1},
                                                            {"cos", Operation::cosine, 1},
                                                            {"tan", Operation::tangent, 1},
                                                            {"asin", Operation::arcsine, 1},
                                                            {"acos", Operation::arccosine, 1},
                                                            {"atan", Operation::arctangent, 1},
                                                            {"atan2", Operation::arctangent2, 2},
                                                            {"exp", Operation::exponential, 1},
                                                            {"log", Operation::logarithm, 1},
                                                            {"log10", Operation::logarithm10, 1},
                                                            {"sqrt", Operation::square_root, 1},
                                                            {"abs", Operation::absolute, 1},
                                                            {"floor", Operation::floor, 1},
                                                            {"ceil", Operation::ceiling, 1},
                                                            {"round", Operation::round, 1},
                                                            {"min", Operation::minimum, 2},
                                                            {"max", Operation::maximum, 2},
                                                            {"mod", Operation::modulo, 2},
                                                            {"random", Operation::random, 2}}};

    static int precedence(Operation operation) {
        switch (operation) {
            case Operation::disjunction:
                return 1;
            case Operation::conjunction:
                return 2;
            case Operation::equal:
            case Operation::not_equal:
                return 3;
            case Operation::less:
            case Operation::less_equal:
            case Operation::greater:
            case Operation::greater_equal:
                return 4;
            case Operation::add:
            case Operation::subtract:
                return 5;
            case Operation::multiply:
            case Operation::divide:
                return 6;
            case Operation::negate:
            case Operation::complement:
                return 7;
            case Operation::power:
                return 8;
            default:
                return 0;  // an open parenthesis
        }
    }

    std::optional<Expression> fail(std::size_t at, const std::string& message) {
        diagnostics_.error(text_.part(at), message);
        return std::nullopt;
    }
    bool wrong(std::size_t at, const std::string& message) {
        fail(at, message);
        return false;
    }

    void skip_blanks() {
        while (at_ < view_.size() && (view_[at_] == ' ' || view_[at_] == '\t')) ++at_;
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
        steps.back().value = Expression::apply(step.operation, steps.back().value, last);
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
        if ((byte >= '0' && byte <= '9') || byte == '.') return number();
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
        Operation operation = Operation::open;
        for (const Function& known : functions) {
            if (known.name == name) operation = known.operation;
        }
        if (operation == Operation::open) return wrong(begin, fmt::format("unknown function '{}'", name));
        if (operation == Operation::random && !draws_) return wrong(begin, "'random' is not allowed here");
        waiting_.push_back({Operation::open, at_++, operation});
        return true;
    }

    static int arity(Operation operation) {
        for (const Function& known : functions) {
            if (known.operation == operation) return known.arguments;
        }
        return 1;
    }

    bool close(std::size_t at) {
        while (!waiting_.empty() && waiting_.back().operation != Operation::open) emit();
        if (waiting_.empty()) return wrong(at, "this ')' has no '('");
        const Waiting open = waiting_.back();
        waiting_.pop_back();
        if (open.function == Operation::open) return true;
        if (open.arguments != arity(open.function)) {
            return wrong(open.at, fmt::format("this function takes {} argument{}, not {}", arity(open.function),
                                              arity(open.function) == 1 ? "" : "s", open.arguments));
        }
        Expression::Step step{open.function};
        if (step.operation == Operation::random) {
            step.slot = (*draws_)++;
            result_.uses_chance_ = true;
        }
        push_operation(step, static_cast<std::size_t>(open.arguments));
        return true;
    }

    bool comma(std::size_t at) {
        while (!waiting_.empty() && waiting_.back().operation != Operation::open) emit();
        if (waiting_.empty() || waiting_.back().function == Operation::open) {
            return wrong(at, "a ',' outside a function's arguments");
        }
        ++waiting_.back().arguments;
        expect_operand_ = true;
        return true;
    }

    bool operator_after_operand() {
        const std::size_t begin = at_;
        const char byte = view_[at_++];
        const bool doubled = at_ < view_.size() && view_[at_] == byte;
        const bool with_equals = at_ < view_.size() && view_[at_] == '=';
        Operation operation = Operation::open;
        switch (byte) {
            case ')':
                return close(begin);
            case ',':
                return comma(begin);
            case '+':
                operation = Operation::add;
                break;
            case '-':
                operation = Operation::subtract;
                break;
            case '*':
                operation = Operation::multiply;
                break;
            case '/':
                operation = Operation::divide;
                break;
            case '^':
                operation = Operation::power;
                break;
            case '<':
                operation = with_equals ? Operation::less_equal : Operation::less;
                break;
            case '>':
                operation = with_equals ? Operation::greater_equal : Operation::greater;
                break;
            case '=':
                if (at_ < view_.size() && (view_[at_] == '>' || view_[at_] == '<')) {
                    return wrong(begin, view_[at_] == '>' ? "'=>' is not an operator; did you mean '>='?"
                                                          : "'=<' is not an operator; did you mean '<='?");
                }
                if (!with_equals) return wrong(begin, "expected '==' (a single '=' compares nothing)");
                operation = Operation::equal;
                break;
            case '!':
                if (with_equals) operation = Operation::not_equal;
                break;
            case '&':
                if (doubled) operation = Operation::conjunction;
                break;
            case '|':
                if (doubled) operation = Operation::disjunction;
                break;
            default:
                break;
        }
        if (operation == Operation::open) return wrong(begin, "expected an operator");
        if (with_equals && (byte == '<' || byte == '>' || byte == '=' || byte == '!')) ++at_;
        if (byte == '&' || byte == '|') ++at_;
        const bool right_associative = operation == Operation::power;
        while (!waiting_.empty() && waiting_.back().operation != Operation::open &&
               (precedence(waiting_.back().operation) > precedence(operation) ||
                (precedence(waiting_.back().operation) == precedence(operation) && !right_associative))) {
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

double Expression::apply(Operation operation, double a, double b) {
    switch (operation) {
        case Operation::negate:
            return -a;
        case Operation::complement:
            return a == 0 ? 1.0 : 0.0;
        case Operation::sine:
            return std::sin(a);
        case Operation::cosine:
            return std::cos(a);
        case Operation::tangent:
            return std::tan(a);
        case Operation::arcsine:
            return std::asin(a);
        case Operation::arccosine:
            return std::acos(a);
        case Operation::arctangent:
            return std::atan(a);
        case Operation::exponential:
            return std::exp(a);
        case Operation::logarithm:
            return std::log(a);
        case Operation::logarithm10:
            return std::log10(a);
        case Operation::square_root:
            return std::sqrt(a);
        case Operation::absolute:
            return std::fabs(a);
        case Operation::floor:
            return std::floor(a);
        case Operation::ceiling:
            return std::ceil(a);
        case Operation::round:
            return std::round(a);
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
        case Operation::arctangent2:
            return std::atan2(a, b);
        case Operation::minimum:
            return std::fmin(a, b);
        case Operation::maximum:
            return std::fmax(a, b);
        case Operation::modulo:
            return std::fmod(a, b);
        default:
            return a;
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
            next[-1] = apply(step.operation, next[-1], 0.0);
        } else {
            --next;
            next[-1] = step.operation == Operation::random
                           ? next[-1] + (next[0] - next[-1]) * chance.uniform(step.slot)
                           : apply(step.operation, next[-1], next[0]);
        }
    }
    return next[-1];
}

}  // namespace sikku
