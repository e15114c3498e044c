#include "engine/import/cpfg_preprocessor.h"

#include "engine/language/expression.h"

#include <array>
#include <optional>

namespace sikku::cpfg {
namespace {

bool is_comment(const std::string& text, std::size_t slashes) {
    std::size_t before = slashes;
    while (before > 0 && is_blank(text[before - 1]) && text[before - 1] != '\n') --before;
    if (before == 0 || text[before - 1] == '\n') return true;
    return before < slashes && (slashes + 2 == text.size() || is_blank(text[slashes + 2]));
}

/// True if an integer expression of C, with defines expanded, is not 0; undefined names are 0. Without division,
/// integers are exact in doubles.
bool holds(const std::string& text, std::size_t at) {
    if (text.find_first_of("/.") != std::string::npos) {
        mistake(at, "this condition is not read: it divides or has a decimal point, and conditions are integers");
    }
    const Source source("", text);
    Diagnostics diagnostics;
    const auto value = Expression::compile(
        {&source, 0, text.size()},
        [](std::string_view) {
            return std::optional(NameMeaning{false, 0.0});
        },
        diagnostics);
    if (!value || diagnostics.has_errors()) {
        mistake(at, "this condition is not understood: expected an expression of numbers and names");
    }
    return value->evaluate() != 0;
}

}  // namespace

std::size_t Reader::split(std::string_view text, std::size_t open, std::vector<std::string_view>& arguments,
                          std::size_t used_at) {
    std::size_t depth = 0;
    std::size_t begin = open + 1;
    for (std::size_t i = open; i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        const bool last = text[i] == ')' && --depth == 0;
        if (!last && !(text[i] == ',' && depth == 1)) continue;
        arguments.push_back(without_blanks(text.substr(begin, i - begin)));
        begin = i + 1;
        if (last) return i + 1;
    }
    mistake(used_at, "the arguments of this define have no ')'");
}

std::string Reader::filled_in(const Macro& macro, const std::vector<std::string_view>& arguments) const {
    std::string result;
    const std::string& body = macro.body;
    for (std::size_t i = 0; i < body.size() && result.size() <= defines_.budget;) {
        const std::string_view name = take_identifier(body, i);
        if (name.empty()) {
            result += body[i++];
            continue;
        }
        const auto found = std::find(macro.parameters.begin(), macro.parameters.end(), name);
        result += found == macro.parameters.end()
                      ? name
                      : arguments[static_cast<std::size_t>(found - macro.parameters.begin())];
    }
    return result;
}

void blank_comments(std::string& text, Report& report) {
    for (std::size_t at = 0; at + 1 < text.size(); ++at) {
        if (text[at] != '/') continue;
        std::size_t end = at;
        if (text[at + 1] == '*') {
            end = text.find("*/", at + 2);
            if (end == std::string::npos) {
                report.error(at, "this comment has no end: expected '*/'");
                end = text.size() - 2;
            }
            end += 2;
        } else if (text[at + 1] == '/' && is_comment(text, at)) {
            end = std::min(text.find('\n', at), text.size());
        } else {
            continue;
        }
        for (std::size_t i = at; i < end; ++i) {
            if (text[i] != '\n') text[i] = ' ';
        }
        at = end - 1;
    }
}

std::string_view Preprocessor::word_at(std::size_t& at, std::size_t end) const {
    at = skip_blanks(text_, at, end);
    return take_identifier(std::string_view(text_).substr(0, end), at);
}

void Preprocessor::directive(std::size_t begin, std::size_t end) {
    std::size_t at = begin + 1;
    const std::string_view what = word_at(at, end);
    if (what == "if" || what == "ifdef" || what == "ifndef") {
        if (conditions_.size() >= most_defines_deep) mistake(begin, "conditions nest more than 200 deep");
        const bool was_active = is_active();
        // Pushed first, so that #else and #endif are matched even if the condition is invalid.
        conditions_.push_back({begin, false, was_active});
        if (was_active) conditions_.back().holds = conditions_.back().has_held = condition(what, at, end);
    } else if (what == "elif" || what == "else" || what == "endif") {
        if (conditions_.empty() || (what != "endif" && conditions_.back().has_else)) {
            mistake(begin, fmt::format("this #{} has no #if", what));
        }
        if (what == "endif") {
            conditions_.pop_back();
            return;
        }
        Condition& current = conditions_.back();
        const bool may_hold = current.was_active && !current.has_held;
        current.holds = false;
        if (what == "else") {
            current.has_else = true;
            current.holds = may_hold;
        } else if (may_hold) {
            current.holds = current.has_held = condition("if", at, end);
        }
    } else if (!is_active()) {
        return;
    } else if (what == "define") {
        define(at, end);
    } else if (what == "undef") {
        defines_.macros.erase(std::string(word_at(at, end)));
    } else if (what == "include") {
        report_.loss(begin, "the contents of #include");
    } else if (what == "error") {
        mistake(begin, "this #error is not in a condition that fails");
    } else if (what.empty() ? !is_empty(at, end)
                            : what != "pragma" && what != "line" && what != "warning" && !is_digit(what[0])) {
        mistake(begin, "unknown preprocessor directive; a production cannot begin with '#'");
    }
}

/// The value of the condition after #if, #ifdef or #ifndef.
bool Preprocessor::condition(std::string_view what, std::size_t at, std::size_t end) const {
    const std::size_t place = std::min(at, text_.size() - 1);
    if (what != "if") {
        const std::string_view name = word_at(at, end);
        if (name.empty()) mistake(place, "expected a name");
        if (!is_empty(at, end)) mistake(at, "expected the end of the line");
        return defines_.macros.contains(name) == (what == "ifdef");
    }
    if (is_empty(at, end)) mistake(place, "expected a condition");
    // `defined NAME` is evaluated before defines are expanded.
    std::string text;
    while (at < end) {
        if (!begins_identifier(text_[at]) || (at > 0 && continues_identifier(text_[at - 1]))) {
            text += text_[at++];
            continue;
        }
        const std::string_view name = word_at(at, end);
        if (name != "defined") {
            text += name;
            continue;
        }
        while (at < end && (is_blank(text_[at]) || text_[at] == '(')) ++at;
        const std::string_view asked = word_at(at, end);
        if (asked.empty()) mistake(place, "expected a name after 'defined'");
        text += defines_.macros.contains(asked) ? '1' : '0';
        at = skip_blanks(text_, at, end);
        if (at < end && text_[at] == ')') ++at;
    }
    Reader reader(defines_, text, place);
    std::string expanded;
    while (const char byte = reader.peek()) {
        expanded += byte;
        reader.take();
    }
    return holds(expanded, place);
}

bool Preprocessor::is_directive(std::string_view line) {
    if (!line.starts_with('#')) return false;
    line = without_blanks(line.substr(1));
    std::size_t end = 0;
    const std::string_view word = take_identifier(line, end);
    constexpr std::array<std::string_view, 13> names = {"if",     "ifdef",  "ifndef", "elif", "else",
                                                        "endif",  "define", "undef",  "line", "include",
                                                        "pragma", "error",  "warning"};
    return line.empty() || std::find(names.begin(), names.end(), word) != names.end();
}

bool Preprocessor::is_empty(std::size_t at, std::size_t end) const {
    return skip_blanks(text_, at, end) >= end;
}

void Preprocessor::define(std::size_t at, std::size_t end) {
    Macro macro;
    const std::string name(word_at(at, end));
    macro.at = at - name.size();
    if (name.empty() || is_digit(name[0])) mistake(std::min(macro.at, text_.size() - 1), "expected a name");
    if (at < end && text_[at] == '(') {
        macro.has_parameters = true;
        ++at;
        while (true) {
            const std::string parameter(word_at(at, end));
            at = skip_blanks(text_, at, end);
            if (parameter.empty() && macro.parameters.empty() && at < end && text_[at] == ')') break;
            if (parameter.empty() || at >= end || (text_[at] != ',' && text_[at] != ')')) {
                mistake(std::min(at, text_.size() - 1), "expected names, separated by ',', and ')'");
            }
            macro.parameters.push_back(parameter);
            if (macro.parameters.size() > 64) mistake(macro.at, "a define has at most 64 parameters");
            if (text_[at] == ')') break;
            ++at;
        }
        ++at;
    }
    macro.body = without_blanks(std::string_view(text_).substr(at, end - at));
    // A name that is defined twice is expanded where it is used.
    if (!defined_once_.insert(name).second) macro.kind = Macro::Kind::text;
    defines_.macros.insert_or_assign(name, std::move(macro));
}

void Preprocessor::finish() {
    if (!conditions_.empty()) report_.error(conditions_.back().at, "this condition has no #endif");
}

}  // namespace sikku::cpfg
