// engine/import/cpfg_expression.h: translates expressions of cpfg into the pattern language.
#pragma once

#include "engine/import/cpfg_preprocessor.h"

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace sikku::cpfg {

constexpr std::size_t most_parameters = 64;  // maximum for a module of a pattern

/// An expression in the pattern language.
struct Value {
    std::string text;
    int precedence = 9;  ///< the outermost operator's, as in engine/language/expression.cpp; 9 without one
    bool is_random = false;
    bool is_enclosed = false;  ///< in parentheses, which `text` omits
};

/// Adds parentheses if the outermost operator of the value has a lower precedence than `lowest`.
std::string in_parentheses(const Value& value, int lowest);

/// Reads the expressions of one file. In cpfg powers associate to the left, signs bind tighter, and angles are
/// degrees. Defines with numeric values become defines of the pattern.
class Expressions {
public:
    Expressions(Defines& defines, Report& report) : defines_(defines), report_(report) {}

    /// Reads the longest expression. @throws Fault
    Value read(Reader& reader) { return binary(reader, 1); }
    /// Reads the rest of a line as a whole number.
    long long whole_number(Reader& reader);
    /// Returns the next character of an expression that is not a blank; 0 at the end.
    char next(Reader& reader) {
        return reader.peek([this](const std::string& name, Macro& macro) { return is_number(name, macro); });
    }
    /// Takes that character if it is `wanted`.
    bool takes(Reader& reader, char wanted) {
        if (next(reader) != wanted) return false;
        reader.take();
        return true;
    }
    /// Reads an identifier; empty if there is none.
    std::string identifier(Reader& reader);

    /// Makes `name` a define of the pattern.
    void define(const std::string& name, const Value& value);
    /// The texts of the pattern's defines by name.
    const std::map<std::string, std::string, std::less<>>& numbers() const { return number_texts_; }
    /// The defines that the pattern's expressions use, directly or through other defines.
    std::set<std::string> used() const;

    /// Forgets the parameters and local variables of the previous production.
    void forget_formals() {
        formals_.clear();
        locals_.clear();
    }
    /// Replaces later occurrences of the name by the value, instead of a parameter of that name. A value without
    /// text is not available.
    void set_local(const std::string& name, Value value) { locals_[name] = std::move(value); }
    /// Adds a parameter of the production; false if it exists already.
    bool add_formal(const std::string& name) { return formals_.insert(name).second; }

    /// The derivation length, for the variable Z.
    long long steps = 0;

private:
    struct Operator {
        std::string_view text;  ///< in the pattern language, as long as in cpfg; empty: no operator
        int level = 0;
    };
    Operator operator_here(Reader& reader);
    Value binary(Reader& reader, int lowest);
    Value unary(Reader& reader);
    Value operand(Reader& reader);
    Value call(Reader& reader, const std::string& name, std::size_t at);
    bool is_number(const std::string& name, Macro& macro);
    double evaluate(const std::string& text) const;

    Defines& defines_;
    Report& report_;
    std::map<std::string, double, std::less<>> values_;
    std::map<std::string, std::string, std::less<>> number_texts_;
    std::set<std::string> used_;
    std::set<std::string, std::less<>> formals_;
    std::map<std::string, Value, std::less<>> locals_;
    std::size_t number_depth_ = 0;
    std::size_t unwritten_ = 0;  // expressions being read that are not written to the pattern
    std::size_t nesting_ = 0;
};

}  // namespace sikku::cpfg
