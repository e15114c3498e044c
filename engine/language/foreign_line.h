// engine/language/foreign_line.h: reads lines in the notations of other programs and of the literature, for messages.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The equivalent of a line in a pattern.
struct LineAdvice {
    std::vector<std::string> lines;  ///< as a pattern states it: `axiom: F`, `X --> F+X`
    std::string axiom;               ///< the word, if one of the lines states the axiom
    bool is_needless = false;        ///< it lists variables or constants, or is a heading
    std::string_view reason{};       ///< how a pattern does without a line that is not needed; may be empty
    std::string problem;             ///< error of a line that is left out because a pattern would not accept it
    bool is_understood() const { return is_needless || !lines.empty() || !problem.empty(); }
    /// `write 'X --> F+X'`; `leave this line out` if it is not needed; the problem if there is no line.
    std::string text() const;
};

/// Reads a line in another notation: other arrows, `X=F+X`, `X: "F+X"`, `ω : F`, `p1 : F → FF`, `n=5, δ=25.7°`,
/// `rules: (X → F+X), (F → FF)`, `rules = {"X": "F+X"}`, `1. X → F+X`. Typographic signs become those of ASCII. Each
/// line of the advice is read by the parser and the compiler in a pattern with the axiom F, which accept it.
/// @param has_axiom  false if `w : F` may state the axiom, as Prusinkiewicz & Lindenmayer's `ω : F` does
LineAdvice advice_for_line(std::string_view line, bool has_axiom);

/// The first arrow of a production outside of parentheses in another notation than `-->`, such as `→`, `->`, `=>` or
/// `--&gt;`; a view into `line`, empty if there is none.
std::string_view foreign_arrow(std::string_view line);

/// The key for a name of other programs, the literature or everyday English, such as `iterations`, `δ`
/// or `colour`; empty if there is none. @param name  folded
std::string_view key_of_other_name(std::string_view name);

/// The key whose name, or one of whose other names, is nearest; empty if none is near. @param name  folded
std::string_view nearest_key(std::string_view name);

/// The ASCII sign that a typographic character stands for, such as `-` for U+2212; `" "` for the blanks of Unicode;
/// empty for invisible characters. Null if the character may be a symbol. @param point  one code point
const char* ascii_of(std::string_view point);

/// True for a name of a production, as in `p1 : F --> FF`, where a predecessor with its condition is expected.
bool is_label(std::string_view name, std::string_view after_colon);

/// The byte offset of a mark of comments in other languages (`#`, `;`, `%`, `--`) that stands after a blank, and
/// between blanks before a word of several letters, or, as `//` may, at the beginning of a remark up to the end of
/// the line: words alone, one of them of three letters or more. Npos if there is none.
/// @param is_name  true for words that are symbols
std::size_t find_late_remark(std::string_view line, const std::function<bool(std::string_view)>& is_name);

/// The length of the mark of a comment of find_late_remark() at the beginning of a text.
std::size_t remark_length(std::string_view text);

/// A word with its weight before it, behind it, or between as in `0.33 : F+F`, instead of `F+F : 0.33`.
struct MisplacedWeight {
    std::size_t at = 0;  ///< byte offset of the number
    std::size_t length = 0;
    std::string right;  ///< as a production states it
};

/// Reads the right side of a production: `0.33 F+F`, `33% F+F`, `F+F 0.33`. The number contains a point or ends with
/// `%`, and a blank separates it.
std::optional<MisplacedWeight> misplaced_weight(std::string_view right);

/// The number of an item of a list in front of a line, with the blanks after it: `1. `, `2) `, `(3) `; 0 if there is
/// none.
std::size_t item_number_length(std::string_view line);

/// The left side of a production without the condition `: *` of cpfg and the literature, which always holds.
std::string_view without_star(std::string_view left);

}  // namespace sikku
