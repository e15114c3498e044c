#include "engine/expression.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
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
    ExpressionCompiler(const Span& text, const NameLookup& names, Diagnostics& diagnostics)
        : text_(text), view_(text.view()), names_(names), diagnostics_(diagnostics) {}

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
        return std::move(result_);
    }

private:
    using Operation = Expression::Operation;
    struct Waiting {
        Operation operation;
        std::size_t at;
        Operation function = Operation::open;  ///< of an open parenthesis: the function it belongs to
        int arguments = 1;                     ///< seen so far within the parenthesis
    };
    struct Function {
        std::string_view name;
        Operation operation;
        int arguments;
    };
    static constexpr std::array<Function, 18> functions = {{{"sin", Operation::sine, 1},
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
                                                            {"mod", Operation::modulo, 2}}};

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

    std::optional<Expression> fail(std::size_t at, std::string message) {
        diagnostics_.error(text_.part(at), std::move(message));
        return std::nullopt;
    }
    bool wrong(std::size_t at, std::string message) {
        fail(at, std::move(message));
        return false;
    }

    void skip_blanks() {
        while (at_ < view_.size() && (view_[at_] == ' ' || view_[at_] == '\t')) ++at_;
    }

    void emit() {
        result_.steps_.push_back({waiting_.back().operation});
        const bool unary = precedence(waiting_.back().operation) == 7;
        if (!unary) --depth_;
        waiting_.pop_back();
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
        const auto [end, error] = std::from_chars(view_.data() + at_, view_.data() + view_.size(), value);
        if (error != std::errc()) return wrong(begin, "this is no number that a double holds");
        at_ = static_cast<std::size_t>(end - view_.data());
        if (at_ < view_.size() && (continues_name(view_[at_]) || view_[at_] == '.')) {
            return wrong(at_, "expected the number to end here");
        }
        push_value({Operation::number, 0, value});
        return true;
    }

    bool function(std::string_view name, std::size_t begin) {
        if (name == "random") return wrong(begin, "chance is not supported yet: 'random'");
        Operation operation = Operation::open;
        for (const Function& known : functions) {
            if (known.name == name) operation = known.operation;
        }
        if (operation == Operation::open) return wrong(begin, fmt::format("there is no function '{}'", name));
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
        result_.steps_.push_back({open.function});
        depth_ -= static_cast<std::size_t>(open.arguments - 1);
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
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    bool expect_operand_ = true;
    std::vector<Waiting> waiting_;
    Expression result_;
};

std::optional<Expression> Expression::compile(const Span& text, const NameLookup& names, Diagnostics& diagnostics) {
    return ExpressionCompiler(text, names, diagnostics).run();
}

double Expression::evaluate(std::span<const double> formals) const {
    std::array<double, 16> small{};
    std::vector<double> large(stack_ > small.size() ? stack_ : 0);
    double* next = large.empty() ? small.data() : large.data();  // where the next value goes
    for (const Step& step : steps_) {
        const auto binary = [&](auto&& combine) {
            --next;
            next[-1] = combine(next[-1], next[0]);
        };
        switch (step.operation) {
            case Operation::number:
                *next++ = step.value;
                break;
            case Operation::formal:
                *next++ = formals[step.slot];
                break;
            case Operation::negate:
                next[-1] = -next[-1];
                break;
            case Operation::complement:
                next[-1] = next[-1] == 0;
                break;
            case Operation::power:
                binary([](double a, double b) { return std::pow(a, b); });
                break;
            case Operation::multiply:
                binary([](double a, double b) { return a * b; });
                break;
            case Operation::divide:
                binary([](double a, double b) { return a / b; });
                break;
            case Operation::add:
                binary([](double a, double b) { return a + b; });
                break;
            case Operation::subtract:
                binary([](double a, double b) { return a - b; });
                break;
            case Operation::less:
                binary([](double a, double b) { return a < b ? 1.0 : 0.0; });
                break;
            case Operation::less_equal:
                binary([](double a, double b) { return a <= b ? 1.0 : 0.0; });
                break;
            case Operation::greater:
                binary([](double a, double b) { return a > b ? 1.0 : 0.0; });
                break;
            case Operation::greater_equal:
                binary([](double a, double b) { return a >= b ? 1.0 : 0.0; });
                break;
            case Operation::equal:
                binary([](double a, double b) { return a == b ? 1.0 : 0.0; });
                break;
            case Operation::not_equal:
                binary([](double a, double b) { return a != b ? 1.0 : 0.0; });
                break;
            case Operation::conjunction:
                binary([](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; });
                break;
            case Operation::disjunction:
                binary([](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; });
                break;
            case Operation::sine:
                next[-1] = std::sin(next[-1]);
                break;
            case Operation::cosine:
                next[-1] = std::cos(next[-1]);
                break;
            case Operation::tangent:
                next[-1] = std::tan(next[-1]);
                break;
            case Operation::arcsine:
                next[-1] = std::asin(next[-1]);
                break;
            case Operation::arccosine:
                next[-1] = std::acos(next[-1]);
                break;
            case Operation::arctangent:
                next[-1] = std::atan(next[-1]);
                break;
            case Operation::arctangent2:
                binary([](double a, double b) { return std::atan2(a, b); });
                break;
            case Operation::exponential:
                next[-1] = std::exp(next[-1]);
                break;
            case Operation::logarithm:
                next[-1] = std::log(next[-1]);
                break;
            case Operation::logarithm10:
                next[-1] = std::log10(next[-1]);
                break;
            case Operation::square_root:
                next[-1] = std::sqrt(next[-1]);
                break;
            case Operation::absolute:
                next[-1] = std::fabs(next[-1]);
                break;
            case Operation::floor:
                next[-1] = std::floor(next[-1]);
                break;
            case Operation::ceiling:
                next[-1] = std::ceil(next[-1]);
                break;
            case Operation::round:
                next[-1] = std::round(next[-1]);
                break;
            case Operation::minimum:
                binary([](double a, double b) { return std::fmin(a, b); });
                break;
            case Operation::maximum:
                binary([](double a, double b) { return std::fmax(a, b); });
                break;
            case Operation::modulo:
                binary([](double a, double b) { return std::fmod(a, b); });
                break;
            case Operation::open:
                break;
        }
    }
    return next[-1];
}

}  // namespace sikku
