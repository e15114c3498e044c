// engine/import/cpfg_preprocessor.h: the C preprocessor of cpfg files: comments, conditions and defines.
#pragma once

#include "engine/import/cpfg_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku::cpfg {

constexpr std::size_t most_defines_deep = 200;

struct Macro {
    bool has_parameters = false;
    std::vector<std::string> parameters;
    std::string body;
    std::size_t at = 0;
    enum class Kind { unknown, asked, number, text } kind = Kind::unknown;
};
using Macros = std::map<std::string, Macro, std::less<>>;

/// The defines in force.
struct Defines {
    Macros macros;
    /// Bytes that defines may still expand to.
    std::size_t budget = std::size_t{16} << 20;
};

/// Reads a logical line and expands its defines.
class Reader {
public:
    Reader(Defines& defines, std::string_view line, std::size_t at) : defines_(defines) {
        frames_.push_back({{}, line, 0, 0, nullptr, at});
    }

    /// Returns the next character that is not a blank, with defines expanded; 0 at the end. `keep(name, macro)` is
    /// true for defines that are not expanded.
    template <class Keep>
    char peek(Keep keep) {
        while (true) {
            Frame& frame = frames_.back();
            const std::string_view text = frame.text;
            while (frame.at < text.size() && is_blank(text[frame.at])) ++frame.at;
            if (frame.at >= text.size()) {
                if (frames_.size() == 1) return 0;
                frames_.pop_back();
                continue;
            }
            if (frame.at < frame.checked || !expand(frame, keep)) return text[frame.at];
        }
    }
    /// The same with all defines expanded.
    char peek() {
        return peek([](const std::string&, Macro&) { return false; });
    }

    /// Unread text of the line, or of the define that is being expanded.
    std::string_view ahead() const { return frames_.back().text.substr(frames_.back().at); }
    void take(std::size_t bytes = 1) { frames_.back().at += bytes; }
    /// Takes the next character that is not a blank if it is `wanted`, with all defines expanded.
    bool takes(char wanted) {
        if (peek() != wanted) return false;
        take();
        return true;
    }

    /// Offset in the file; within a define, that of its use in the line.
    std::size_t where() const {
        return frames_.size() > 1 ? frames_[1].used_at : frames_.front().used_at + frames_.front().at;
    }

private:
    struct Frame {
        std::string own;
        std::string_view text;
        std::size_t at;
        std::size_t checked;  // no define begins before this offset
        const Macro* macro;
        std::size_t used_at;  // offset of the define's use; in the first frame, of the line
    };

    /// Expands the define at the current place. False if there is none; the same text is not checked again.
    template <class Keep>
    bool expand(Frame& frame, Keep keep) {
        const std::string_view text = frame.text;
        std::size_t end = frame.at;
        if (is_digit(text[end]) || (text[end] == '.' && end + 1 < text.size() && is_digit(text[end + 1]))) {
            while (end < text.size() && (continues_identifier(text[end]) || text[end] == '.')) ++end;
            frame.checked = end;
            return false;
        }
        if (!begins_identifier(text[end])) return false;
        while (end < text.size() && continues_identifier(text[end])) ++end;
        frame.checked = end;
        const auto found = defines_.macros.find(text.substr(frame.at, end - frame.at));
        if (found == defines_.macros.end()) return false;
        const std::size_t used_at = where();
        Macro& macro = found->second;
        std::vector<std::string_view> arguments;
        if (macro.has_parameters) {
            std::size_t open = end;
            while (open < text.size() && is_blank(text[open])) ++open;
            if (open >= text.size() || text[open] != '(') return false;
            end = split(text, open, arguments, used_at);
            if (arguments.size() != macro.parameters.size() &&
                !(macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty())) {
                mistake(used_at, fmt::format("'{}' takes {} arguments, not {}", printable(found->first, 80),
                                             macro.parameters.size(), arguments.size()));
            }
        } else if (keep(found->first, macro)) {
            return false;
        }
        const bool is_open =
            std::any_of(frames_.begin(), frames_.end(), [&](const Frame& other) { return other.macro == &macro; });
        if (is_open) mistake(used_at, fmt::format("'{}' is defined by itself", printable(found->first, 80)));
        if (frames_.size() > most_defines_deep) mistake(used_at, "defines stand in defines more than 200 deep");
        std::string replaced = macro.has_parameters ? filled_in(macro, arguments) : macro.body;
        if (replaced.size() + 1 > defines_.budget) mistake(used_at, "the defines expand to more than 16 MB");
        defines_.budget -= replaced.size() + 1;
        frame.at = end;
        frames_.push_back({std::move(replaced), {}, 0, 0, &macro, used_at});
        frames_.back().text = frames_.back().own;
        return true;
    }

    static std::size_t split(std::string_view text, std::size_t open, std::vector<std::string_view>& arguments,
                             std::size_t used_at);
    std::string filled_in(const Macro& macro, const std::vector<std::string_view>& arguments) const;

    Defines& defines_;
    std::deque<Frame> frames_;  // a deque, because views into its texts must stay valid
};

/// Replaces comments by blanks; keeps line ends. `//` begins a comment only at the beginning of a line or between
/// blanks; in words it is two rolls, which the preprocessors of the time did not remove.
void blank_comments(std::string& text, Report& report);

/// Executes preprocessor directives.
class Preprocessor {
public:
    /// @param text  text of the file, without comments
    Preprocessor(const std::string& text, Defines& defines, Report& report)
        : text_(text), defines_(defines), report_(report) {}

    /// True if cpfg would read the current line.
    bool is_active() const {
        return conditions_.empty() || (conditions_.back().holds && conditions_.back().was_active);
    }
    /// Executes one directive, from its '#' to the end of the line.
    void directive(std::size_t begin, std::size_t end);
    /// True if the line begins with the name of a directive or is `#` alone. `#(0.1)` and `# F` are words.
    static bool is_directive(std::string_view line);
    /// Reports a condition without #endif.
    void finish();

private:
    struct Condition {
        std::size_t at;
        bool holds;
        bool was_active;
        bool has_held = false;  // one of its branches so far was read
        bool has_else = false;
    };
    std::string_view word_at(std::size_t& at, std::size_t end) const;
    bool is_empty(std::size_t at, std::size_t end) const;
    bool condition(std::string_view what, std::size_t at, std::size_t end) const;
    void define(std::size_t at, std::size_t end);

    const std::string& text_;
    Defines& defines_;
    Report& report_;
    std::set<std::string> defined_once_;
    std::vector<Condition> conditions_;
};

}  // namespace sikku::cpfg
