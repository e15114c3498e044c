#include "engine/language/foreign_text.h"

#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"

#include <algorithm>

namespace sikku {
namespace {

/// Calls `work` with each line that is not empty, without blanks at both ends, until it returns true.
template <class Work>
bool any_line(std::string_view text, Work work) {
    while (!text.empty()) {
        std::string_view line = take_line(text);
        while (line.ends_with('\r')) line.remove_suffix(1);
        line = trimmed(line);
        if (!line.empty() && work(line)) return true;
    }
    return false;
}

/// True if the line begins with the word (in lower case) and a blank, or ends there.
bool begins_with_word(std::string_view line, std::string_view word) {
    if (lower_case(line.substr(0, word.size())) != word) return false;
    return line.size() == word.size() || is_blank(line[word.size()]);
}

/// Skips comments of several lines in a C-like text.
class CommentSkipper {
public:
    /// True if the line begins outside of a comment.
    bool next(std::string_view line) {
        const bool outside = !in_comment_;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            if (!in_comment_ && line.substr(i, 2) == "/*") in_comment_ = true;
            if (in_comment_ && line.substr(i, 2) == "*/") in_comment_ = false;
        }
        return outside;
    }

private:
    bool in_comment_ = false;
};

bool is_entry_line(std::string_view line) {
    if (line.empty() || line.front() == ';' || line.front() == '#') return false;
    const std::size_t brace = line.find('{');
    return brace != std::string_view::npos && brace < line.find(';');
}

/// `Axiom F--F`, but neither `axiom -> F` nor `axiom = F`.
bool is_axiom_line(std::string_view line) {
    if (!begins_with_word(line, "axiom")) return false;
    const std::string_view word = trimmed(line.substr(5));
    return !word.starts_with("->") && !word.starts_with('=') && !word.starts_with(':') && !word.starts_with('"') &&
           (word.empty() || static_cast<unsigned char>(word.front()) < 0x80);
}

/// `module A(float);`
bool is_module_line(std::string_view line) {
    if (!begins_with_word(line, "module")) return false;
    std::string_view rest = trimmed(line.substr(std::min<std::size_t>(6, line.size())));
    const auto is_name = [](char byte) { return is_letter_or_digit(byte) || byte == '_'; };
    const auto end = std::find_if_not(rest.begin(), rest.end(), is_name);
    if (end == rest.begin()) return false;
    rest = trimmed(rest.substr(static_cast<std::size_t>(end - rest.begin())));
    return rest.starts_with('(') && rest.ends_with(';');
}

}  // namespace

bool has_fractint_entry(std::string_view text) {
    CommentSkipper comments;
    return any_line(text, [&](std::string_view line) { return comments.next(line) && is_entry_line(line); });
}

ForeignKind foreign_kind(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    CommentSkipper comments;
    bool in_entry = false;
    bool has_axiom = false;  // as patterns state it
    bool has_module = false, has_produce = false;
    bool has_python = false;
    ForeignKind kind = ForeignKind::none;
    any_line(text, [&](std::string_view line) {
        if (!comments.next(line)) return false;
        if (lower_case(line.substr(0, 8)) == "lsystem:") {
            kind = ForeignKind::cpfg;
            return true;
        }
        const bool includes = line.starts_with("#include") && line.find("lpfgall.h") != std::string_view::npos;
        if (includes || is_module_line(line)) has_module = true;
        if (line.find("produce ") != std::string_view::npos || line.ends_with("produce")) has_produce = true;
        if (begins_with_word(line, "production:") || begins_with_word(line, "homomorphism:") ||
            (begins_with_word(line, "def") && line.ends_with(':'))) {
            has_python = true;
        }
        if (lower_case(line.substr(0, 6)) == "axiom:" && !line.ends_with(';')) has_axiom = true;
        if (in_entry && is_axiom_line(line)) kind = ForeignKind::fractint;
        if (is_entry_line(line)) in_entry = true;
        if (line.substr(0, line.find(';')).find('}') != std::string_view::npos) in_entry = false;
        return kind == ForeignKind::fractint;
    });
    if (kind == ForeignKind::cpfg || kind == ForeignKind::fractint) return kind;
    if (has_module) return ForeignKind::lpfg;
    if (has_produce && has_python) return ForeignKind::lpy;
    if (has_axiom) return ForeignKind::none;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return ForeignKind::none;
    const std::string begin = lower_case(text.substr(first, 5));
    if (begin == "<html" || begin == "<!doc" || begin == "<?xml" || begin.starts_with("<svg"))
        return ForeignKind::html;
    return ForeignKind::none;
}

std::string_view foreign_kind_name(ForeignKind kind) {
    constexpr std::string_view names[] = {"a pattern",
                                          "a Fractint collection of L-systems",
                                          "an L-system of cpfg",
                                          "an L+C file of lpfg, which is C++",
                                          "an L-Py file, which is Python",
                                          "HTML or XML"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace sikku
