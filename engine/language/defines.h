// engine/language/defines.h: the named constants of a pattern.
#pragma once

#include "engine/language/expression.h"
#include "engine/language/pattern.h"

#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// The values of all `define NAME = EXPRESSION` lines of a pattern. Refers to its source.
class Defines {
public:
    /// Evaluates every define once, those it mentions first; a cycle is an error at each of its members.
    Defines(const Pattern& pattern, Diagnostics& diagnostics);

    std::optional<NameMeaning> find(std::string_view name) const {
        const auto found = values_.find(name);
        if (found == values_.end()) return std::nullopt;
        return NameMeaning{false, found->second};
    }
    /// Evaluates an expression without formal parameters; nullopt after an error in it.
    std::optional<double> constant(const Span& text, Diagnostics& diagnostics) const;

private:
    void evaluate(const Define& define, Diagnostics& diagnostics);
    std::map<std::string_view, double> values_;
};

/// The names in an expression, in order, functions included.
std::vector<std::string_view> names_in(std::string_view text);

/// True if `text` (not empty) is a name that expressions can contain.
bool is_expression_name(std::string_view text);

}  // namespace sikku
