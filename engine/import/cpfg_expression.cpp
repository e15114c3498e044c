#include "engine/import/cpfg_expression.h"

#include "engine/base/decimal.h"
#include "engine/language/expression.h"

#include <array>
#include <cmath>
#include <optional>

namespace sikku::cpfg {
namespace {

constexpr std::size_t most_nesting = 256;                            // depth of an expression
constexpr std::size_t most_expression_bytes = std::size_t{1} << 20;  // after rewriting
constexpr double degree = 0.017453292519943295;

/// Increments a counter during its lifetime.
struct Level {
    explicit Level(std::size_t& counted) : count(counted) { ++count; }
    ~Level() { --count; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    std::size_t& count;
};

bool is_whole(const Value& value) {
    return std::all_of(value.text.begin(), value.text.end(), is_digit);
}

void combine(Value& left, std::string_view sign, int level, const Value& right, std::size_t at) {
    left.is_enclosed = false;
    left.is_random = left.is_random || right.is_random;
    if (sign == "%") {
        // The remainder of whole numbers, with division rounded towards 0.
        const auto whole = [&](const Value& value) {
            if (is_whole(value)) return value.text;
            if (value.is_random) lose(at, "'%' would use one random number twice");
            return fmt::format("{}-mod({},1)", in_parentheses(value, 5), value.text);
        };
        left = {fmt::format("mod({},{})", whole(left), whole(right)), 9, left.is_random};
    } else if (sign == "^") {
        left = {in_parentheses(left, 9) + "^" + in_parentheses(right, 9), 8, left.is_random};
    } else {
        // The levels are those of the pattern language; a signed operand is put in parentheses for legibility.
        if (left.precedence < level) left.text = "(" + left.text + ")";
        left.text += sign;
        left.text += in_parentheses(right, right.precedence == 7 ? 8 : level + 1);
        left.precedence = level;
    }
}

Value number(Reader& reader, std::size_t at) {
    const std::string_view text = reader.ahead();
    double value = 0;
    const auto [end, problem] = parse_number(text, value);
    if (problem != std::errc()) mistake(at, "this number is out of range");
    reader.take(static_cast<std::size_t>(end - text.data()));
    return {fmt::format("{}", value)};
}

/// Functions of one argument.
constexpr std::array<std::string_view, 15> functions = {"sin",  "cos",  "tan",   "asin",  "acos",
                                                        "atan", "exp",  "log",   "floor", "ceil",
                                                        "sqrt", "fabs", "trunc", "sign",  "ran"};

}  // namespace

std::string in_parentheses(const Value& value, int lowest) {
    return value.precedence < lowest ? "(" + value.text + ")" : value.text;
}

bool Expressions::is_number(const std::string& name, Macro& macro) {
    if (macro.kind == Macro::Kind::unknown && number_depth_ < most_defines_deep) {
        macro.kind = Macro::Kind::asked;
        Macro::Kind kind = Macro::Kind::text;
        const auto formals = std::exchange(formals_, {});
        const auto locals = std::exchange(locals_, {});
        const Level deeper(number_depth_);
        const Level unwritten(unwritten_);
        try {
            Reader reader(defines_, macro.body, macro.at);
            const Value value = read(reader);
            const bool is_complete = value.precedence == 9 || value.precedence == 7 || value.is_enclosed;
            if (next(reader) == 0 && !value.is_random && is_complete) {
                define(name, value);
                kind = Macro::Kind::number;
            }
        } catch (const Fault&) {
            // The error is reported where the define is expanded.
        }
        formals_ = formals;
        locals_ = locals;
        macro.kind = kind;
    }
    return macro.kind == Macro::Kind::number;
}

void Expressions::define(const std::string& name, const Value& value) {
    values_[name] = evaluate(value.text);
    number_texts_[name] = value.text;
}

double Expressions::evaluate(const std::string& text) const {
    const Source source("", text);
    Diagnostics ignored;
    const auto value = Expression::compile(
        {&source, 0, text.size()},
        [&](std::string_view name) -> std::optional<NameMeaning> {
            const auto found = values_.find(name);
            if (found == values_.end()) return std::nullopt;
            return NameMeaning{false, found->second};
        },
        ignored);
    return value ? value->evaluate() : 0.0;
}

std::set<std::string> Expressions::used() const {
    std::set<std::string> used = used_;
    std::vector<std::string> pending(used.begin(), used.end());
    while (!pending.empty()) {
        const std::string text = number_texts_.at(pending.back());
        pending.pop_back();
        for (std::size_t at = 0; at < text.size(); ++at) {
            const std::string name(take_identifier(text, at));
            if (number_texts_.contains(name) && used.insert(name).second) pending.push_back(name);
        }
    }
    return used;
}

long long Expressions::whole_number(Reader& reader) {
    const std::size_t at = reader.where();
    const Level unwritten(unwritten_);
    const Value value = read(reader);
    if (next(reader) != 0) mistake(reader.where(), "expected the end of the line");
    const double number = evaluate(value.text);
    if (value.is_random || !(std::fabs(number) < 2e9)) mistake(at, "expected a whole number below 2000000000");
    return static_cast<long long>(number);
}

std::string Expressions::identifier(Reader& reader) {
    if (!begins_identifier(next(reader))) return {};
    std::size_t end = 0;
    std::string name(take_identifier(reader.ahead(), end));
    reader.take(end);
    return name;
}

Expressions::Operator Expressions::operator_here(Reader& reader) {
    // Longer operators precede those that they begin with.
    constexpr Operator operators[] = {{"||", 1}, {"&&", 2}, {"==", 3}, {"!=", 3}, {"<=", 4}, {">=", 4}, {"<", 4},
                                      {">", 4},  {"+", 5},  {"-", 5},  {"*", 6},  {"/", 6},  {"%", 6},  {"^", 7}};
    const char byte = next(reader);
    const std::string_view text = reader.ahead();
    if (text.starts_with("-->") || text.starts_with("-o>")) return {};
    if (text.starts_with("<>")) return {"!=", 3};
    for (const Operator& one : operators) {
        if (text.starts_with(one.text)) return one;
    }
    if (byte == '=') mistake(reader.where(), "expected '==': a single '=' compares nothing");
    if (byte == '?') lose(reader.where(), "'?:' chooses between values");
    return {};
}

Value Expressions::binary(Reader& reader, int lowest) {
    Value left = unary(reader);
    while (true) {
        const std::size_t at = reader.where();
        const Operator sign = operator_here(reader);
        if (sign.text.empty() || sign.level < lowest) return left;
        reader.take(sign.text.size());
        const Value right = binary(reader, sign.level + 1);
        combine(left, sign.text, sign.level, right, at);
        if (left.text.size() > most_expression_bytes) mistake(at, "this expression becomes longer than 1 MB");
    }
}

Value Expressions::unary(Reader& reader) {
    if (nesting_ >= most_nesting) mistake(reader.where(), "expressions nest at most 256 deep");
    const Level deeper(nesting_);
    return operand(reader);
}

Value Expressions::operand(Reader& reader) {
    const char byte = next(reader);
    const std::size_t at = reader.where();
    if (byte == '-' || byte == '!') {
        reader.take();
        const Value value = unary(reader);
        return {byte + in_parentheses(value, 8), 7, value.is_random};
    }
    if (byte == '(') {
        reader.take();
        Value value = read(reader);
        if (!takes(reader, ')')) mistake(reader.where(), "expected ')'");
        value.is_enclosed = true;
        return value;
    }
    if (is_digit(byte) || byte == '.') return number(reader, at);
    if (byte == '"' || byte == '&') lose(at, "strings and addresses are not numbers");
    const std::string name = identifier(reader);
    if (name.empty()) mistake(at, "expected a number, a name or '('");
    const char after = next(reader);
    if (after == '(') return call(reader, name, at);
    if (after == '[') lose(at, fmt::format("'{}' is an array", name));
    if (const auto local = locals_.find(name); local != locals_.end()) {
        Value& value = local->second;
        if (value.text.empty()) {
            lose(at, value.is_random ? fmt::format("'{}' would use one random number twice", name)
                                     : fmt::format("the statements that set '{}' are not read", name));
        }
        Value result = value;
        if (value.is_random) value.text.clear();
        return result;
    }
    if (formals_.contains(name)) return {name};
    if (number_texts_.contains(name)) {
        if (unwritten_ == 0) used_.insert(name);
        return {name};
    }
    if (name == "Z") {
        report_.once("Z", at, "Z as the derivation length: it keeps the value in the file");
        return {fmt::format("{}", steps)};
    }
    lose(at, name == "Q" ? "Q, the number of the step, is not available" : fmt::format("'{}' is not defined", name));
}

Value Expressions::call(Reader& reader, const std::string& name, std::size_t at) {
    std::vector<Value> arguments;
    do {
        reader.take();
        arguments.push_back(read(reader));
        if (arguments.size() > most_parameters) mistake(at, "a function has at most 64 arguments");
    } while (next(reader) == ',');
    if (!takes(reader, ')')) mistake(reader.where(), "expected ',' or ')'");
    if (std::find(functions.begin(), functions.end(), name) == functions.end()) {
        lose(at, fmt::format("the pattern language has no function '{}'", name));
    }
    if (arguments.size() != 1) mistake(at, fmt::format("'{}' takes one argument", name));
    const Value& argument = arguments.front();
    const bool random = argument.is_random;
    if (name == "sin" || name == "cos" || name == "tan") {
        return {fmt::format("{}({}*{})", name, in_parentheses(argument, 6), degree), 9, random};
    }
    if (name == "asin" || name == "acos" || name == "atan") {
        return {fmt::format("{}({})/{}", name, argument.text, degree), 6, random};
    }
    if (name == "trunc") return {fmt::format("floor({}+0.5)", in_parentheses(argument, 5)), 9, random};
    if (name == "ran") return {fmt::format("random(0,{})", argument.text), 9, true};
    if (name == "sign") {
        if (random) lose(at, "'sign' would use one random number twice");
        return {fmt::format("({0}>0)-({0}<0)", in_parentheses(argument, 5)), 5, false};
    }
    return {fmt::format("{}({})", name == "fabs" ? "abs" : name, argument.text), 9, random};
}

}  // namespace sikku::cpfg
