// engine/language/word_scanner.h: divides the text of a word into letters and parameters.
#pragma once

#include "engine/language/pattern.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Maximum number of symbols of a grammar.
constexpr std::size_t most_symbols = std::size_t{1} << 19;

/// Names of several characters, listed under `symbols:`.
class SymbolNames {
public:
    SymbolNames(const Pattern& pattern, Diagnostics& diagnostics);

    /// Length in bytes of the longest name at the beginning of `text`, or 0.
    std::size_t length_at(std::string_view text) const {
        for (std::size_t length = std::min(longest_, text.size()); length > 0; --length) {
            if (names_.contains(text.substr(0, length))) return length;
        }
        return 0;
    }
    /// True if `~` begins the names of surfaces.
    bool has_surfaces() const { return has_surfaces_; }
    std::vector<std::string> sorted() const { return {names_.begin(), names_.end()}; }

private:
    bool read(const Span& list, Diagnostics& diagnostics);
    std::set<std::string, std::less<>> names_;
    std::size_t longest_ = 0;
    bool has_surfaces_ = false;
};

/// Scans one word.
class WordScanner {
public:
    /// @param diagnostics  null: errors are not reported
    WordScanner(const SymbolNames& names, const Span& span, Diagnostics* diagnostics)
        : names_(names), diagnostics_(diagnostics), span_(span), text_(span.view()) {}

    /// Offset of the next letter or parenthesis.
    std::size_t at() const { return at_; }
    /// Skips blanks and tabs; true if there were any.
    bool skip_blanks();
    bool at_end() const { return at_ >= text_.size(); }
    /// True if the next character is a parenthesis.
    bool at_parameters() const { return at_ < text_.size() && text_[at_] == '('; }

    /// Reads the next letter, which may be a name; empty after an error. @param blank_before  result of skip_blanks()
    std::string_view letter(bool blank_before);
    /// True if the last letter was a name of several characters.
    bool is_name() const { return is_name_; }
    /// Skips from the parenthesis at() to its closing one; false after an error.
    bool parameters(std::vector<Span>& parts);

private:
    std::string_view wrong(const std::string& message);

    const SymbolNames& names_;
    Diagnostics* diagnostics_;
    Span span_;
    std::string_view text_;
    std::size_t at_ = 0;
    bool is_name_ = false;
};

/// Passes each symbol of a word to `take(letter, parameters, where)`, up to the first error, which is not reported.
template <class Take>
void for_each_symbol(const SymbolNames& names, const Span& word, Take take) {
    WordScanner scanner(names, word, nullptr);
    std::vector<Span> parameters;
    while (scanner.skip_blanks(), !scanner.at_end()) {
        const std::size_t begin = scanner.at();
        const std::string_view letter = scanner.letter(false);
        parameters.clear();
        if (letter.empty() || (scanner.at_parameters() && !scanner.parameters(parameters))) return;
        take(letter, parameters, word.part(begin, scanner.at() - begin));
    }
}

}  // namespace sikku
