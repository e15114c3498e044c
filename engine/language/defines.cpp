#include "engine/language/defines.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace sikku {

Defines::Defines(const Pattern& pattern, Diagnostics& diagnostics) {
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t i = 0; i < pattern.defines.size(); ++i) index[pattern.defines[i].name.view()] = i;
    enum class State : char { fresh, open, done };
    std::vector<State> state(pattern.defines.size(), State::fresh);
    std::vector<std::size_t> stack;
    for (std::size_t first = 0; first < pattern.defines.size(); ++first) {
        stack.push_back(first);
        while (!stack.empty()) {
            const std::size_t i = stack.back();
            const Define& define = pattern.defines[i];
            if (state[i] == State::done) {
                stack.pop_back();
                continue;
            }
            if (state[i] == State::fresh) {
                state[i] = State::open;
                const std::size_t before = stack.size();
                for (const std::string_view name : names_in(define.value.view())) {
                    const auto found = index.find(name);
                    if (found == index.end() || state[found->second] == State::done) continue;
                    if (state[found->second] == State::open) {
                        diagnostics.error(define.name,
                                          fmt::format("the definition of '{}' refers to itself", define.name.view()));
                        values_[name] = std::numeric_limits<double>::quiet_NaN();
                        continue;
                    }
                    stack.push_back(found->second);
                }
                if (stack.size() > before) continue;
            }
            evaluate(define, diagnostics);
            state[i] = State::done;
            stack.pop_back();
        }
    }
}

std::vector<std::string_view> names_in(std::string_view text) {
    std::vector<std::string_view> names;
    for (std::size_t at = 0; at < text.size();) {
        if (!continues_name(text[at]) && text[at] != '.') {
            ++at;
            continue;
        }
        const std::size_t begin = at;
        while (at < text.size() && (continues_name(text[at]) || text[at] == '.')) ++at;
        if (begins_name(text[begin])) names.push_back(text.substr(begin, at - begin));
    }
    return names;
}

bool is_expression_name(std::string_view text) {
    return begins_name(text.front()) && std::all_of(text.begin(), text.end(), continues_name);
}

void Defines::evaluate(const Define& define, Diagnostics& diagnostics) {
    const std::string_view name = define.name.view();
    if (!is_expression_name(name)) {
        return diagnostics.error(
            define.name, "the name of a define must consist of letters, digits and '_', and not begin with a digit");
    }
    // A value that cannot be read is reported once, not at every use.
    values_[name] = constant(define.value, diagnostics).value_or(0.0);
}

std::optional<double> Defines::constant(const Span& text, Diagnostics& diagnostics) const {
    const auto expression = Expression::compile(
        text, [this](std::string_view name) { return find(name); }, diagnostics);
    if (!expression) return std::nullopt;
    return expression->evaluate();
}

}  // namespace sikku
