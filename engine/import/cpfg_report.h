// engine/import/cpfg_report.h: collects the errors of a cpfg file, and the features lost in its pattern.
#pragma once

#include "engine/base/characters.h"
#include "engine/import/import.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace sikku::cpfg {

/// Thrown where a part of the file cannot be imported: a loss drops that part, otherwise the file has an error.
struct Fault {
    std::size_t at;
    std::string message;
    bool is_loss;
};
[[noreturn]] inline void mistake(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), false};
}
[[noreturn]] inline void lose(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), true};
}

inline bool is_blank(char byte) {
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n' || byte == '\f' || byte == '\v';
}
inline bool begins_identifier(char byte) {
    return is_letter(byte) || byte == '_';
}
inline bool continues_identifier(char byte) {
    return is_letter_or_digit(byte) || byte == '_';
}
/// Returns the position of the first character from `at` on that is not a blank, at most `end`.
inline std::size_t skip_blanks(std::string_view text, std::size_t at, std::size_t end = std::string_view::npos) {
    while (at < std::min(end, text.size()) && is_blank(text[at])) ++at;
    return at;
}
/// Moves `at` past the identifier there and returns it; empty if there is none. It may begin with a digit.
inline std::string_view take_identifier(std::string_view text, std::size_t& at) {
    const std::size_t begin = at;
    while (at < text.size() && continues_identifier(text[at])) ++at;
    return text.substr(begin, at - begin);
}
inline std::string_view without_blanks(std::string_view text) {
    text.remove_prefix(skip_blanks(text, 0));
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

/// Collects errors and losses of one file.
class Report {
public:
    Report(const SourcePointer& file, Diagnostics& diagnostics)
        : file_(file), diagnostics_(diagnostics), losses_(file, diagnostics) {}

    void error(std::size_t at, const std::string& message) { error(file_, at, message); }
    /// Reports an error of another file.
    void error(const SourcePointer& file, std::size_t at, const std::string& message) {
        diagnostics_.error({file, at, 1}, message);
        failed_ = true;
    }
    void loss(std::size_t at, const std::string& what) { losses_.add(at, what); }
    /// Reports a loss only once for each key.
    void once(const std::string& key, std::size_t at, const std::string& what) {
        if (told_.insert(key).second) losses_.add(at, what);
    }
    bool failed() const { return failed_; }
    ImportLosses& losses() { return losses_; }

private:
    const SourcePointer& file_;
    Diagnostics& diagnostics_;
    ImportLosses losses_;
    bool failed_ = false;
    std::set<std::string> told_;
};

}  // namespace sikku::cpfg
