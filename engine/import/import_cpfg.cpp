// A cpfg file goes through a C preprocessor before cpfg reads it, so what stands in it are not yet words: defines are
// expanded here as the reader meets them. Those that are numbers stay names in expressions. Expressions are written
// anew, since powers associate to the left there, signs bind tighter, and angles are degrees. Productions are tried
// in the order of the file there, those with contexts first here: conditions make up for it.
#include "engine/import/import.h"

#include "engine/base/text.h"
#include "engine/language/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <set>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_defines_deep = 200;
constexpr std::size_t most_expanded_bytes = std::size_t{16} << 20;   // that defines expand to
constexpr std::size_t most_nesting = 256;                            // of an expression
constexpr std::size_t most_expression_bytes = std::size_t{1} << 20;  // as written anew
constexpr std::size_t most_productions = 10'000;
constexpr std::size_t most_faults = 10'000;
constexpr std::size_t most_parameters = 64;  // of a module of a pattern
constexpr double degree = 0.017453292519943295;

/// Why a part of the file cannot be had. A loss costs that part, else the file has a mistake.
struct Fault {
    std::size_t at;
    std::string message;
    bool is_loss;
};
[[noreturn]] void mistake(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), false};
}
[[noreturn]] void lose(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), true};
}

bool is_blank(char byte) {
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n' || byte == '\f' || byte == '\v';
}
bool is_digit(char byte) {
    return byte >= '0' && byte <= '9';
}
bool begins_identifier(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '_';
}
bool continues_identifier(char byte) {
    return begins_identifier(byte) || is_digit(byte);
}

struct Macro {
    bool has_parameters = false;
    std::vector<std::string> parameters;
    std::string body;
    std::size_t at = 0;
    enum class Kind { unknown, asked, number, text } kind = Kind::unknown;
};
using Macros = std::map<std::string, Macro, std::less<>>;

/// An expression in the pattern language.
struct Value {
    std::string text;
    int precedence = 9;  ///< of its outermost operator, as in engine/language/expression.cpp; 9 for none
    bool is_random = false;
    bool is_enclosed = false;  ///< in parentheses, which are not written
};

/// A module of a predecessor or a context.
struct Formal {
    std::string letter;
    std::vector<std::string> names;
};

struct Rule {
    std::vector<Formal> left;
    std::vector<Formal> predecessor;
    std::vector<Formal> right;
    std::optional<Value> condition;
    std::string successor;
    std::optional<Value> weight;
    std::size_t at = 0;
    bool has_context() const { return !left.empty() || !right.empty(); }
};

std::string type_of(const std::vector<Formal>& modules) {
    std::string key;
    for (const Formal& module : modules) key += fmt::format("{}({} ", module.letter, module.names.size());
    return key;
}

/// What is left of a logical line, with the defines that are being expanded.
class Reader {
public:
    Reader(Macros& macros, std::size_t& budget, std::string_view line, std::size_t at)
        : macros_(macros), budget_(budget) {
        frames_.push_back({{}, line, 0, 0, nullptr, at});
    }

    /// The next character that is no blank, defines expanded; 0 at the end. `keep` says which are left as they are.
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
    /// Defines expanded, all of them.
    char peek() {
        return peek([](const std::string&, Macro&) { return false; });
    }

    /// The text right here, up to where a define that is being expanded ends.
    std::string_view ahead() const { return frames_.back().text.substr(frames_.back().at); }
    void take(std::size_t bytes = 1) { frames_.back().at += bytes; }

    /// An offset into the file: of a define that is being expanded, where it is used.
    std::size_t where() const {
        return frames_.size() > 1 ? frames_[1].used_at : frames_.front().used_at + frames_.front().at;
    }

private:
    struct Frame {
        std::string own;
        std::string_view text;
        std::size_t at;
        std::size_t checked;  // up to here nothing is a define
        const Macro* macro;
        std::size_t used_at;  // of the first frame, where the line begins
    };

    /// If a define stands here, its text is read next; else what stands here is looked at no more.
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
        const auto found = macros_.find(text.substr(frame.at, end - frame.at));
        if (found == macros_.end()) return false;
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
        if (replaced.size() + 1 > budget_) mistake(used_at, "the defines expand to more than 16 MB");
        budget_ -= replaced.size() + 1;
        frame.at = end;
        frames_.push_back({std::move(replaced), {}, 0, 0, &macro, used_at});
        frames_.back().text = frames_.back().own;
        return true;
    }

    /// From '(' to behind its ')'.
    static std::size_t split(std::string_view text, std::size_t open, std::vector<std::string_view>& arguments,
                             std::size_t used_at) {
        std::size_t depth = 0;
        std::size_t begin = open + 1;
        for (std::size_t i = open; i < text.size(); ++i) {
            if (text[i] == '(') ++depth;
            const bool last = text[i] == ')' && --depth == 0;
            if (!last && !(text[i] == ',' && depth == 1)) continue;
            std::string_view argument = text.substr(begin, i - begin);
            while (!argument.empty() && is_blank(argument.front())) argument.remove_prefix(1);
            while (!argument.empty() && is_blank(argument.back())) argument.remove_suffix(1);
            arguments.push_back(argument);
            begin = i + 1;
            if (last) return i + 1;
        }
        mistake(used_at, "the arguments of this define have no ')'");
    }

    std::string filled_in(const Macro& macro, const std::vector<std::string_view>& arguments) const {
        std::string result;
        const std::string& body = macro.body;
        for (std::size_t i = 0; i < body.size() && result.size() <= budget_;) {
            std::size_t end = i;
            while (end < body.size() && continues_identifier(body[end])) ++end;
            if (end == i) {
                result += body[i++];
                continue;
            }
            const std::string_view name = std::string_view(body).substr(i, end - i);
            const auto found = std::find(macro.parameters.begin(), macro.parameters.end(), name);
            result += found == macro.parameters.end()
                          ? name
                          : arguments[static_cast<std::size_t>(found - macro.parameters.begin())];
            i = end;
        }
        return result;
    }

    Macros& macros_;
    std::size_t& budget_;
    std::deque<Frame> frames_;  // their texts stay where they are
};

class Importer {
public:
    Importer(const SourcePointer& file, const SourcePointer& view, Diagnostics& diagnostics)
        : file_(file), view_(view), diagnostics_(diagnostics), losses_(file, diagnostics), text_(file->text()) {}

    ImportedSystem run() {
        ImportedSystem system;
        blank_comments();
        if (view_) read_view();
        read_lines();
        if (lsystem_at_ == nothing) {
            error(0, "there is no line 'Lsystem:' in this file");
        } else if (!axiom_ && !failed_) {
            error(lsystem_at_, "there is no 'Axiom:'");
        }
        system.name = name();
        if (lsystem_at_ != nothing) system.line = losses_.line(lsystem_at_);
        if (!failed_) {
            system.pattern = write();
            const Span where(file_, lsystem_at_, 1);
            if (!import_compiles(system.name, system.pattern, where, diagnostics_)) system.pattern.clear();
        }
        system.losses = losses_.take();
        return system;
    }

private:
    static constexpr std::size_t nothing = std::string::npos;
    enum class Section { before, header, productions, decomposition, homomorphism, after };

    void error(std::size_t at, const std::string& message) {
        diagnostics_.error({file_, at, 1}, message);
        failed_ = true;
    }
    void lose_part(std::size_t at, const std::string& message) { losses_.add(at, message); }

    std::string name() const {
        std::string stem = import_base_name(file_->name());
        if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
        return printable(stem, 80);
    }

    // --- lines ---------------------------------------------------------------------------------------------

    /// In words `//` is two rolls: younger preprocessors than those that these files were written for would take the
    /// rest of the line away. A comment stands at the beginning of a line or between blanks.
    bool is_comment(std::size_t slashes) const {
        std::size_t before = slashes;
        while (before > 0 && is_blank(text_[before - 1]) && text_[before - 1] != '\n') --before;
        if (before == 0 || text_[before - 1] == '\n') return true;
        return before < slashes && (slashes + 2 == text_.size() || is_blank(text_[slashes + 2]));
    }

    void blank_comments() {
        for (std::size_t at = 0; at + 1 < text_.size(); ++at) {
            if (text_[at] != '/') continue;
            std::size_t end = at;
            if (text_[at + 1] == '*') {
                end = text_.find("*/", at + 2);
                if (end == nothing) {
                    error(at, "this comment has no end: expected '*/'");
                    end = text_.size() - 2;
                }
                end += 2;
            } else if (text_[at + 1] == '/' && is_comment(at)) {
                end = std::min(text_.find('\n', at), text_.size());
            } else {
                continue;
            }
            for (std::size_t i = at; i < end; ++i) {
                if (text_[i] != '\n') text_[i] = ' ';
            }
            at = end - 1;
        }
    }

    std::size_t line_end(std::size_t at) const { return std::min(text_.find('\n', at), text_.size()); }

    std::size_t first_of_line(std::size_t at) const {
        while (at < text_.size() && text_[at] != '\n' && is_blank(text_[at])) ++at;
        return at;
    }
    bool is_directive(std::size_t at) const {
        at = first_of_line(at);
        return at < text_.size() && text_[at] == '#';
    }

    void read_lines() {
        for (std::size_t at = 0; at < text_.size() && section_ != Section::after;) {
            std::size_t end = line_end(at);
            if (is_directive(at)) {
                // A backslash at the end goes on with the next line.
                while (
                    end < text_.size() && end > at &&
                    (text_[end - 1] == '\\' || (text_[end - 1] == '\r' && end > at + 1 && text_[end - 2] == '\\'))) {
                    text_[text_[end - 1] == '\\' ? end - 1 : end - 2] = ' ';
                    text_[end] = ' ';
                    end = line_end(end);
                }
                attempt([&] { directive(first_of_line(at), end); });
                at = end + 1;
                continue;
            }
            // A line that begins with a tab continues the one before; braces of C do, too.
            while (end + 1 < text_.size() &&
                   ((text_[end + 1] == '\t' && !is_directive(end + 1)) || open_braces(at, end) > 0)) {
                text_[end] = ' ';
                end = line_end(end);
            }
            if (is_active() && first_of_line(at) < end) {
                attempt([&] { line(first_of_line(at), end); });
            }
            at = end + 1;
        }
        if (!conditions_.empty()) error(conditions_.back().at, "this condition has no #endif");
    }

    /// Of a block of C that has begun in this line; 0 in other lines.
    std::size_t open_braces(std::size_t begin, std::size_t end) {
        // What was counted once is not counted again, however many lines there are.
        if (counted_begin_ != begin) {
            const std::string_view line = std::string_view(text_).substr(begin, end - begin);
            std::size_t first = nothing;
            const std::string keyword = keyword_of(line);
            if (keyword == "define:" || keyword.starts_with("start") || keyword == "end:" || keyword == "endeach:") {
                first = 0;
            } else if (section_ == Section::productions || section_ == Section::homomorphism) {
                const std::size_t colon = line.find(':');
                const std::size_t brace = colon == nothing ? nothing : line.find('{', colon);
                if (brace < line.find("-->") && brace < line.find("-o>")) first = brace;
            }
            if (first == nothing) return 0;
            counted_begin_ = begin;
            counted_end_ = begin + first;
            counted_ = 0;
        }
        for (; counted_end_ < end; ++counted_end_) {
            if (text_[counted_end_] == '{') ++counted_;
            if (text_[counted_end_] == '}' && counted_ > 0) --counted_;
        }
        return counted_;
    }

    template <class Work>
    void attempt(Work work) {
        try {
            work();
        } catch (const Fault& fault) {
            unwritten_ = 0;
            // Whoever has that many does not read on.
            if (++faults_ > most_faults) section_ = Section::after;
            if (!fault.is_loss) {
                error(fault.at, fault.message);
            } else if (faults_ > most_faults) {
                error(fault.at, "more than 10,000 productions cannot be carried over");
            } else if (section_ == Section::header) {
                error(fault.at, fault.message);  // the axiom or its like
            } else {
                losses_.add(fault.at, fmt::format("this production: {}", fault.message));
            }
        }
    }

    // --- the preprocessor ----------------------------------------------------------------------------------

    struct Condition {
        std::size_t at;
        bool holds;
        bool was_active;
        bool has_else = false;
    };
    bool is_active() const {
        return conditions_.empty() || (conditions_.back().holds && conditions_.back().was_active);
    }

    std::string_view word_at(std::size_t& at, std::size_t end) const {
        while (at < end && is_blank(text_[at])) ++at;
        const std::size_t begin = at;
        while (at < end && continues_identifier(text_[at])) ++at;
        return std::string_view(text_).substr(begin, at - begin);
    }

    void directive(std::size_t begin, std::size_t end) {
        std::size_t at = begin + 1;
        const std::string_view what = word_at(at, end);
        if (what == "if" || what == "ifdef" || what == "ifndef") {
            const bool was_active = is_active();
            bool holds = false;
            if (was_active) {
                const std::size_t place = at;
                const std::string_view name = word_at(at, end);
                if (name.empty()) mistake(std::min(place, text_.size() - 1), "expected a name or a number");
                const auto found = macros_.find(name);
                holds = what == "ifdef"    ? found != macros_.end()
                        : what == "ifndef" ? found == macros_.end()
                                           : holds_for(found == macros_.end() ? name : found->second.body, place);
                if (!is_empty(at, end)) mistake(at, "conditions of more than one word are not read");
            }
            if (conditions_.size() >= most_defines_deep) mistake(begin, "conditions nest more than 200 deep");
            conditions_.push_back({begin, holds, was_active});
        } else if (what == "else" || what == "endif") {
            if (conditions_.empty() || (what == "else" && conditions_.back().has_else)) {
                mistake(begin, fmt::format("this #{} has no #if", what));
            }
            if (what == "endif") {
                conditions_.pop_back();
            } else {
                conditions_.back().holds = !conditions_.back().holds;
                conditions_.back().has_else = true;
            }
        } else if (!is_active()) {
            return;
        } else if (what == "define") {
            define(at, end);
        } else if (what == "undef") {
            macros_.erase(std::string(word_at(at, end)));
        } else if (what == "include") {
            losses_.add(begin, "what #include would bring");
        } else if (what.empty() ? !is_empty(at, end) : what != "pragma" && what != "line" && !is_digit(what[0])) {
            mistake(begin, "unknown preprocessor directive; a production cannot begin with '#'");
        }
    }

    bool is_empty(std::size_t at, std::size_t end) const {
        while (at < end && is_blank(text_[at])) ++at;
        return at >= end;
    }

    static bool holds_for(std::string_view word, std::size_t at) {
        long long number = 0;
        const auto [last, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (problem == std::errc() && last == word.data() + word.size()) return number != 0;
        if (!word.empty() && begins_identifier(word[0])) return false;  // what is not defined is 0
        mistake(at, "this condition is not read: expected a number or a name");
    }

    void define(std::size_t at, std::size_t end) {
        Macro macro;
        const std::string name(word_at(at, end));
        macro.at = at - name.size();
        if (name.empty() || is_digit(name[0])) mistake(std::min(macro.at, text_.size() - 1), "expected a name");
        if (at < end && text_[at] == '(') {
            macro.has_parameters = true;
            ++at;
            while (true) {
                const std::string parameter(word_at(at, end));
                while (at < end && is_blank(text_[at])) ++at;
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
        while (at < end && is_blank(text_[at])) ++at;
        macro.body = text_.substr(at, end - at);
        while (!macro.body.empty() && is_blank(macro.body.back())) macro.body.pop_back();
        // A name that means two things in one file is expanded where it stands.
        if (!defined_once_.insert(name).second) macro.kind = Macro::Kind::text;
        macros_.insert_or_assign(name, std::move(macro));
    }

    /// Does that define stand for a number, so that it may stay a name?
    bool is_number(const std::string& name, Macro& macro) {
        if (macro.kind == Macro::Kind::unknown && number_depth_ < most_defines_deep) {
            macro.kind = Macro::Kind::asked;
            Macro::Kind kind = Macro::Kind::text;
            const auto formals = std::exchange(formals_, {});
            ++number_depth_;
            ++unwritten_;
            try {
                Reader reader(macros_, budget_, macro.body, macro.at);
                Value value = expression(reader);
                const bool is_whole = value.precedence == 9 || value.precedence == 7 || value.is_enclosed;
                if (next(reader) == 0 && !value.is_random && is_whole) {
                    numbers_[name] = evaluate(value.text);
                    number_texts_[name] = std::move(value.text);
                    kind = Macro::Kind::number;
                }
            } catch (const Fault&) {
                // Expanded where it is used, it is told what is wrong with it.
            }
            --number_depth_;
            --unwritten_;
            formals_ = formals;
            macro.kind = kind;
        }
        return macro.kind == Macro::Kind::number;
    }

    double evaluate(const std::string& text) const {
        const Source source("", text);
        Diagnostics ignored;
        const auto value = Expression::compile(
            {&source, 0, text.size()},
            [&](std::string_view name) -> std::optional<NameMeaning> {
                const auto found = numbers_.find(name);
                if (found == numbers_.end()) return std::nullopt;
                return NameMeaning{false, found->second};
            },
            ignored);
        return value ? value->evaluate() : 0.0;
    }

    // --- what a line says ----------------------------------------------------------------------------------

    /// The keyword that a line begins with, in lower case and without blanks, or nothing.
    static std::string keyword_of(std::string_view line) {
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        const std::string text = lower_case(line.substr(0, 24));
        constexpr std::array<std::string_view, 19> keywords = {"lsystem:",
                                                               "seed:",
                                                               "derivation length:",
                                                               "derivationlength:",
                                                               "maximum depth:",
                                                               "consider:",
                                                               "ignore:",
                                                               "axiom:",
                                                               "define:",
                                                               "ring lsystem",
                                                               "start each:",
                                                               "starteach:",
                                                               "end each:",
                                                               "endeach:",
                                                               "start:",
                                                               "end:",
                                                               "homomorphism",
                                                               "decomposition",
                                                               "endlsystem"};
        for (const std::string_view keyword : keywords) {
            if (!text.starts_with(keyword)) continue;
            std::string result;
            std::copy_if(keyword.begin(), keyword.end(), std::back_inserter(result), [](char c) { return c != ' '; });
            return result;
        }
        return {};
    }

    void line(std::size_t begin, std::size_t end) {
        const std::string_view whole = std::string_view(text_).substr(begin, end - begin);
        const std::string keyword = keyword_of(whole);
        const std::size_t colon = keyword.ends_with(':') ? whole.find(':') + 1 : whole.size();
        const std::string_view rest = whole.substr(colon);
        const std::size_t rest_at = begin + colon;
        if (keyword == "lsystem:") {
            if (section_ != Section::before) {
                losses_.add(begin, "the sub-L-systems that follow");
                section_ = Section::after;
                return;
            }
            lsystem_at_ = begin;
            label_ = import_text(rest, 80);
            section_ = Section::header;
        } else if (section_ == Section::before) {
            mistake(begin, "expected 'Lsystem:'");
        } else if (keyword == "endlsystem") {
            if (section_ == Section::header) mistake(begin, "there is no 'Axiom:' before");
            look_for_more(end);
            section_ = Section::after;
        } else if (keyword == "homomorphism") {
            section_ = Section::homomorphism;
        } else if (keyword == "decomposition") {
            losses_.add(begin, "the decomposition, which goes on within a step until nothing more applies");
            section_ = Section::decomposition;
        } else if (section_ == Section::header) {
            item(keyword, begin, rest, rest_at);
        } else if (section_ == Section::decomposition) {
            return;
        } else if (section_ == Section::homomorphism && keyword == "maximumdepth:") {
            Reader reader(macros_, budget_, rest, rest_at);
            homomorphism_depth_ = whole_number(reader);
            if (homomorphism_depth_ > 1) homomorphism_depth_at_ = begin;
        } else if (section_ == Section::homomorphism && keyword == "seed:") {
            return;  // of choices that a homomorphism does not make
        } else {
            production(whole, begin);
        }
    }

    /// Other L-systems of the file are called by the first.
    void look_for_more(std::size_t at) {
        for (at = std::min(at + 1, text_.size()); at < text_.size(); at = line_end(at) + 1) {
            const std::string_view line = std::string_view(text_).substr(at, line_end(at) - at);
            if (keyword_of(line) == "lsystem:") return losses_.add(at, "the sub-L-systems that follow");
        }
    }

    void item(const std::string& keyword, std::size_t begin, std::string_view rest, std::size_t rest_at) {
        Reader reader(macros_, budget_, rest, rest_at);
        if (keyword == "derivationlength:") {
            steps_ = std::max<long long>(0, whole_number(reader));
        } else if (keyword == "seed:") {
            seed_ = whole_number(reader);
        } else if (keyword == "ignore:" || keyword == "consider:") {
            listed_.clear();
            considers_ = keyword == "consider:";
            has_list_ = true;
            while (const char byte = reader.peek()) {
                check_symbol(byte, reader.where());
                listed_.insert(byte);
                reader.take();
            }
        } else if (keyword == "axiom:") {
            axiom_.emplace();
            section_ = Section::productions;
            try {
                axiom_ = word(reader);
            } catch (const Fault& fault) {
                mistake(fault.at, fault.message);  // there is no system without it
            }
            if (reader.peek() != 0) mistake(reader.where(), "expected a symbol here");
        } else if (keyword == "ringlsystem") {
            losses_.add(begin, "that the word is a ring: the end of the word is no neighbour of its beginning");
        } else if (keyword == "start:") {
            start(reader, begin);
        } else if (keyword.empty()) {
            mistake(begin, "expected an item such as 'derivation length:' or 'Axiom:'");
        } else {
            losses_.add(begin, fmt::format("the C statements of '{}'", keyword));
        }
    }

    /// `{a = 1; b = 2*a;}`: what is set here and nowhere else is a define.
    void start(Reader& reader, std::size_t begin) {
        std::map<std::string, Value, std::less<>> found;
        try {
            if (next(reader) != '{') lose(begin, "");
            reader.take();
            while (next(reader) != '}') {
                const std::string name = identifier(reader);
                if (name.empty() || next(reader) != '=') lose(begin, "");
                reader.take();
                Value value = expression(reader);
                if (next(reader) != ';' || value.is_random) lose(begin, "");
                reader.take();
                if (times_assigned(name) != 1 || macros_.contains(name)) lose(begin, "");
                numbers_[name] = evaluate(value.text);
                number_texts_[name] = value.text;
            }
        } catch (const Fault& fault) {
            if (!fault.is_loss) throw;
            losses_.add(begin, "the C statements of 'start:'");
        }
    }

    /// In the whole file: names before a single '=', or behind '&'.
    std::size_t times_assigned(const std::string& name) {
        if (assigned_.empty()) {
            for (std::size_t at = 0; at < text_.size();) {
                if (!begins_identifier(text_[at]) || (at > 0 && continues_identifier(text_[at - 1]))) {
                    ++at;
                    continue;
                }
                const std::size_t begin = at;
                while (at < text_.size() && continues_identifier(text_[at])) ++at;
                std::size_t after = at;
                while (after < text_.size() && is_blank(text_[after])) ++after;
                const bool is_set = after + 1 < text_.size() && text_[after] == '=' && text_[after + 1] != '=';
                const bool is_lent = begin > 1 && text_[begin - 1] == '&' && text_[begin - 2] != '&';
                if (is_set || is_lent) ++assigned_[text_.substr(begin, at - begin)];
            }
        }
        return assigned_[name];
    }

    long long whole_number(Reader& reader) {
        const std::size_t at = reader.where();
        ++unwritten_;
        const Value value = expression(reader);
        --unwritten_;
        if (next(reader) != 0) mistake(reader.where(), "expected the end of the line");
        const double number = evaluate(value.text);
        if (value.is_random || !(std::fabs(number) < 2e9)) mistake(at, "expected a whole number below 2000000000");
        return static_cast<long long>(number);
    }

    // --- words ---------------------------------------------------------------------------------------------

    static void check_symbol(char byte, std::size_t at) {
        const auto code = static_cast<unsigned char>(byte);
        if (code >= 0x80 || code < 0x20 || code == 0x7F) mistake(at, "a symbol is one character of ASCII");
        if (byte == ':' || byte == '*' || byte == '(' || byte == ')' || byte == '<' || byte == '>') {
            mistake(at, fmt::format("'{}' is no symbol", byte));
        }
    }

    static bool moves_the_turtle(char byte) {
        return std::string_view("FfGg+-|[]{}#!;,'%@&^/\\$").find(byte) != std::string_view::npos;
    }

    /// One symbol, or two after '@'. The surface that '~' names is no command of the turtle.
    std::string symbol(Reader& reader) {
        const std::size_t at = reader.where();
        const char byte = reader.peek();
        check_symbol(byte, at);
        reader.take();
        if (std::exchange(after_tilde_, byte == '~') && moves_the_turtle(byte)) return surface(byte);
        if (byte != '@') {
            symbols_.insert(std::string(1, byte));
            return std::string(1, byte);
        }
        const char function = reader.peek();
        if (function == 0) mistake(at, "expected a function after '@'");
        check_symbol(function, reader.where());
        reader.take();
        symbols_.insert({'@', function});
        called_.insert(function);
        if (std::string_view("ocOv").find(function) == std::string_view::npos) {
            once(std::string("@") + function, at, fmt::format("the function @{}", function));
        }
        return {'@', function};
    }

    /// A Greek letter, which no cpfg file uses, for a surface whose name would move the turtle.
    std::string surface(char byte) {
        std::string& letter = surfaces_[byte];
        if (letter.empty()) {
            const std::size_t number = surfaces_.size() - 1;  // at most the commands of the turtle
            letter = {'\xCE', static_cast<char>(0x91 + number)};
            if (letter == "\xCE\x95") letter = "\xCE\xB1";  // capital epsilon is too much like the empty word
        }
        symbols_.insert(letter);
        return letter;
    }

    /// Tells a loss the first time only.
    void once(const std::string& key, std::size_t at, const std::string& what) {
        if (told_.insert(key).second) losses_.add(at, what);
    }

    void note(char letter, std::size_t at) {
        if (letter == '~') once("~", at, "surfaces");
        if (letter == ';' || letter == ',') once(";", at, "the colours, which stand in a map of their own");
        if (letter == '?' || letter == '$') once("?", at, "queries and sub-L-systems");
        if (letter == '{') {
            once("{", at,
                 "which vertices polygons have: here the place of '{' and the ends of all steps, '.' and G being "
                 "nothing special");
        }
    }

    std::string word(Reader& reader) {
        std::string result;
        after_tilde_ = false;
        while (true) {
            const char byte = reader.peek();
            if (byte == 0 || byte == ':') break;
            const std::size_t at = reader.where();
            if (byte == '*') mistake(at, "'*' is the empty word and stands alone");
            const std::string letter = symbol(reader);
            note(letter[0], at);
            std::vector<std::string> arguments;
            if (reader.peek() == '(') arguments = parameters(reader);
            if (letter == "%" && !arguments.empty()) {
                once("%(", at, "%() with parameters");
                continue;
            }
            if (section_ == Section::homomorphism) {
                finish(result, letter, std::move(arguments), at);
                continue;
            }
            if (letter.size() == 1 && (letter == "!" || letter == "#") && arguments.empty()) {
                if (width_increment_ != 0) {
                    once("!", at, "that # and ! add to the width: here they multiply by 1.25 and 0.8");
                }
            }
            if ((letter == "{" || letter == "}") && !arguments.empty() && arguments[0] != "0") {
                once("{(", at, "generalised cylinders");
            }
            note_width(letter, arguments);
            modules_.insert({letter, arguments.size()});
            append(result, letter, arguments);
        }
        return result;
    }

    void append(std::string& result, std::string_view letter, const std::vector<std::string>& arguments) const {
        result += letter;
        for (std::size_t i = 0; i < arguments.size(); ++i) result += (i == 0 ? '(' : ',') + arguments[i];
        if (!arguments.empty()) result += ')';
    }

    /// A module of a homomorphism's successor: nothing is between it and the turtle.
    void finish(std::string& result, const std::string& letter, std::vector<std::string> arguments, std::size_t at) {
        if (letter == "%" || letter == "'" || letter == "@." || letter == "$") return;
        if (letter == "@v") return append(result, "$", {});
        if (letter == "/" || letter == "\\") return append(result, letter == "/" ? "\\" : "/", arguments);
        if ((letter == "!" || letter == "#") && arguments.empty()) {
            if (width_increment_ == 0) return;
            once("!", at, "that # and ! add to the width: here they multiply by 1.25 and 0.8");
        }
        if (letter == "@o" || letter == "@c" || letter == "@O") {
            if (arguments.empty()) return once("disc", at, "discs as wide as the line");
            return append(result, "@O", {"(" + arguments[0] + ")/2"});
        }
        if ((letter == "{" || letter == "}") && !arguments.empty()) {
            if (arguments[0] != "0") return once("{(", at, "generalised cylinders");
            arguments.clear();
        }
        note_width(letter, arguments);
        append(result, letter, arguments);
    }

    /// Widths are pixels unless the view says otherwise.
    void note_width(const std::string& letter, const std::vector<std::string>& arguments) {
        if ((letter == "!" || letter == "#") && !arguments.empty() && stroke_.empty()) stroke_ = "stroke: 1 px";
    }

    std::vector<std::string> parameters(Reader& reader) {
        const std::size_t at = reader.where();
        std::vector<std::string> list;
        do {
            reader.take();
            list.push_back(expression(reader).text);
            if (list.size() > most_parameters) mistake(at, "a module has at most 64 parameters");
        } while (next(reader) == ',');
        if (next(reader) != ')') mistake(reader.where(), "expected ',' or ')' after a parameter");
        reader.take();
        return list;
    }

    // --- expressions ---------------------------------------------------------------------------------------

    /// The next character of an expression: defines that are numbers stay names.
    char next(Reader& reader) {
        return reader.peek([this](const std::string& name, Macro& macro) { return is_number(name, macro); });
    }

    std::string identifier(Reader& reader) {
        if (!begins_identifier(next(reader))) return {};
        const std::string_view text = reader.ahead();
        std::size_t end = 0;
        while (end < text.size() && continues_identifier(text[end])) ++end;
        const std::string name(text.substr(0, end));
        reader.take(end);
        return name;
    }

    struct Operator {
        std::string_view sign;  ///< in the pattern language
        std::size_t bytes = 0;  ///< 0: none stands here
        int level = 0;
    };

    Operator operator_here(Reader& reader) {
        const char byte = next(reader);
        const std::string_view text = reader.ahead();
        const auto is = [&](std::string_view sign) { return text.starts_with(sign); };
        if (is("-->") || is("-o>")) return {};
        if (is("||")) return {"||", 2, 1};
        if (is("&&")) return {"&&", 2, 2};
        if (is("==")) return {"==", 2, 3};
        if (is("!=") || is("<>")) return {"!=", 2, 3};
        if (is("<=")) return {"<=", 2, 4};
        if (is(">=")) return {">=", 2, 4};
        switch (byte) {
            case '<':
                return {"<", 1, 4};
            case '>':
                return {">", 1, 4};
            case '+':
                return {"+", 1, 5};
            case '-':
                return {"-", 1, 5};
            case '*':
                return {"*", 1, 6};
            case '/':
                return {"/", 1, 6};
            case '%':
                return {"%", 1, 6};
            case '^':
                return {"^", 1, 7};
            case '=':
                mistake(reader.where(), "expected '==': a single '=' compares nothing");
            case '?':
                lose(reader.where(), "'?:' chooses between values");
            default:
                return {};
        }
    }

    Value expression(Reader& reader) { return binary(reader, 1); }

    Value binary(Reader& reader, int lowest) {
        Value left = unary(reader);
        while (true) {
            const std::size_t at = reader.where();
            const Operator sign = operator_here(reader);
            if (sign.bytes == 0 || sign.level < lowest) return left;
            reader.take(sign.bytes);
            const Value right = binary(reader, sign.level + 1);
            combine(left, sign, right, at);
            if (left.text.size() > most_expression_bytes) mistake(at, "this expression becomes longer than 1 MB");
        }
    }

    static std::string in_parentheses(const Value& value, int lowest) {
        return value.precedence < lowest ? "(" + value.text + ")" : value.text;
    }

    static bool is_whole(const Value& value) { return std::all_of(value.text.begin(), value.text.end(), is_digit); }

    static void combine(Value& left, const Operator& sign, const Value& right, std::size_t at) {
        left.is_enclosed = false;
        left.is_random = left.is_random || right.is_random;
        if (sign.sign == "%") {
            // Of whole numbers, cut off towards 0.
            const auto whole = [&](const Value& value) {
                if (is_whole(value)) return value.text;
                if (value.is_random) lose(at, "'%' would draw the same chance twice");
                return fmt::format("{}-mod({},1)", in_parentheses(value, 5), value.text);
            };
            left = {fmt::format("mod({},{})", whole(left), whole(right)), 9, left.is_random};
        } else if (sign.sign == "^") {
            left = {in_parentheses(left, 9) + "^" + in_parentheses(right, 9), 8, left.is_random};
        } else {
            // The levels are those of the pattern language; a sign after an operator is hard to read.
            const int level = sign.level;
            if (left.precedence < level) left.text = "(" + left.text + ")";
            left.text += sign.sign;
            left.text += in_parentheses(right, right.precedence == 7 ? 8 : level + 1);
            left.precedence = level;
        }
    }

    Value unary(Reader& reader) {
        if (nesting_ >= most_nesting) mistake(reader.where(), "expressions nest at most 256 deep");
        struct Level {
            std::size_t& count;
            explicit Level(std::size_t& nesting) : count(nesting) { ++count; }
            ~Level() { --count; }
        } level(nesting_);
        return operand(reader);
    }

    Value operand(Reader& reader) {
        const char byte = next(reader);
        const std::size_t at = reader.where();
        if (byte == '-' || byte == '!') {
            reader.take();
            const Value value = unary(reader);
            return {byte + in_parentheses(value, 8), 7, value.is_random};
        }
        if (byte == '(') {
            reader.take();
            Value value = expression(reader);
            if (next(reader) != ')') mistake(reader.where(), "expected ')'");
            reader.take();
            value.is_enclosed = true;
            return value;
        }
        if (is_digit(byte) || byte == '.') return number(reader, at);
        if (byte == '"' || byte == '&') lose(at, "strings and addresses are no numbers");
        const std::string name = identifier(reader);
        if (name.empty()) mistake(at, "expected a number, a name or '('");
        const char after = next(reader);
        if (after == '(') return call(reader, name, at);
        if (after == '[') lose(at, fmt::format("'{}' is an array", name));
        if (formals_.contains(name)) return {name};
        if (number_texts_.contains(name)) {
            if (unwritten_ == 0) used_.insert(name);
            return {name};
        }
        if (name == "Z") {
            once("Z", at, "Z as the derivation length: it stays what the file says");
            return {fmt::format("{}", steps_)};
        }
        lose(at,
             name == "Q" ? "Q, the number of the step, is not to be had" : fmt::format("'{}' is not defined", name));
    }

    static Value number(Reader& reader, std::size_t at) {
        const std::string_view text = reader.ahead();
        double value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (problem != std::errc()) mistake(at, "this is no number that a double holds");
        reader.take(static_cast<std::size_t>(end - text.data()));
        return {fmt::format("{}", value)};
    }

    Value call(Reader& reader, const std::string& name, std::size_t at) {
        std::vector<Value> arguments;
        do {
            reader.take();
            arguments.push_back(expression(reader));
            if (arguments.size() > most_parameters) mistake(at, "a function has at most 64 arguments");
        } while (next(reader) == ',');
        if (next(reader) != ')') mistake(reader.where(), "expected ',' or ')'");
        reader.take();
        static constexpr std::array<std::pair<std::string_view, std::string_view>, 15> functions = {
            {{"sin", "sin"},
             {"cos", "cos"},
             {"tan", "tan"},
             {"asin", "asin"},
             {"acos", "acos"},
             {"atan", "atan"},
             {"exp", "exp"},
             {"log", "log"},
             {"floor", "floor"},
             {"ceil", "ceil"},
             {"sqrt", "sqrt"},
             {"fabs", "abs"},
             {"trunc", ""},
             {"sign", ""},
             {"ran", ""}}};
        const auto known = std::find_if(functions.begin(), functions.end(),
                                        [&](const auto& function) { return function.first == name; });
        if (known == functions.end()) lose(at, fmt::format("the pattern language has no function '{}'", name));
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
            if (random) lose(at, "'sign' would draw the same chance twice");
            return {fmt::format("({0}>0)-({0}<0)", in_parentheses(argument, 5)), 5, false};
        }
        return {fmt::format("{}({})", known->second, argument.text), 9, random};
    }

    // --- productions ---------------------------------------------------------------------------------------

    static bool is_arrow(const Reader& reader) {
        return reader.ahead().starts_with("-->") || reader.ahead().starts_with("-o>");
    }

    void production(std::string_view text, std::size_t at) {
        Reader reader(macros_, budget_, text, at);
        formals_.clear();
        Rule rule;
        rule.at = at;
        rule.predecessor = formal_modules(reader);
        if (reader.peek() == '<') {
            reader.take();
            rule.left = std::move(rule.predecessor);
            rule.predecessor = formal_modules(reader);
        }
        if (reader.peek() == '>') {
            reader.take();
            rule.right = formal_modules(reader);
        }
        if (rule.predecessor.empty()) mistake(at, "expected a predecessor");
        if (reader.peek() == ':') {
            reader.take();
            block(reader);
            if (next(reader) == '*') {
                reader.take();
            } else if (!is_arrow(reader)) {
                rule.condition = expression(reader);
            }
            block(reader);
        }
        if (reader.peek() == 0 || !is_arrow(reader)) {
            mistake(reader.where(),
                    reader.peek() == 0 ? "expected '-->' after the predecessor" : "expected '-->' here");
        }
        reader.take(3);
        const char first = reader.peek();
        if (first == 0) mistake(at, "expected a successor; '*' is the empty one");
        if (first == '*') {
            reader.take();
        } else {
            rule.successor = word(reader);
        }
        if (reader.peek() == ':') {
            reader.take();
            rule.weight = expression(reader);
        }
        if (next(reader) != 0) mistake(reader.where(), "expected the end of the line");
        keep(std::move(rule));
    }

    void block(Reader& reader) {
        if (next(reader) != '{') return;
        const std::size_t at = reader.where();
        losses_.add(at, "the C statements of a production");
        std::size_t depth = 0;
        while (const char byte = next(reader)) {
            if (byte == '{') ++depth;
            if (byte == '}') --depth;
            reader.take();
            if (depth == 0) return;
        }
        mistake(at, "this '{' is not closed");
    }

    /// Up to '<', '>', ':' or an arrow; `*` is nothing.
    std::vector<Formal> formal_modules(Reader& reader) {
        std::vector<Formal> modules;
        after_tilde_ = false;
        if (reader.peek() == '*') {
            reader.take();
            return modules;
        }
        while (true) {
            const char byte = reader.peek();
            if (byte == 0 || byte == '<' || byte == '>' || byte == ':' || is_arrow(reader)) return modules;
            const std::size_t at = reader.where();
            Formal module{symbol(reader), {}};
            if (module.letter[0] != '@') named_.insert(module.letter[0]);
            if (module.letter == "%") lose(at, "the cut symbol is gone before productions apply");
            if (reader.peek() == '(') {
                do {
                    reader.take();
                    const std::string name = identifier(reader);
                    if (name.empty()) mistake(reader.where(), "expected the name of a parameter");
                    if (macros_.contains(name)) {
                        mistake(reader.where(), fmt::format("the parameter '{}' is a define", printable(name, 80)));
                    }
                    if (!formals_.insert(name).second) {
                        mistake(reader.where(),
                                fmt::format("the parameter '{}' is named twice", printable(name, 80)));
                    }
                    module.names.push_back(name);
                    if (module.names.size() > most_parameters) mistake(at, "a module has at most 64 parameters");
                } while (next(reader) == ',');
                if (next(reader) != ')') mistake(reader.where(), "expected ',' or ')' after a parameter");
                reader.take();
            }
            modules.push_back(std::move(module));
        }
    }

    void keep(Rule rule) {
        if (rules_.size() + homomorphism_.size() >= most_productions) {
            mistake(rule.at, "there are more than 10,000 productions");
        }
        if (section_ == Section::homomorphism) {
            if (rule.predecessor.size() > 1) lose(rule.at, "a homomorphism replaces one symbol");
            for (std::vector<Formal>* context : {&rule.left, &rule.right}) {
                for (const Formal& module : *context) {
                    if (!module.names.empty()) lose(rule.at, "a homomorphism looks at no neighbours");
                    once("contexts", rule.at, "the contexts of a homomorphism, at which cpfg does not look either");
                }
                context->clear();
            }
            rule.weight.reset();
            homomorphism_.push_back(std::move(rule));
            return;
        }
        for (const Formal& module : rule.left) {
            if (module.letter == "[" || module.letter == "]")
                lose(rule.at, "brackets in a left context match nothing");
        }
        rule.right = right_context(std::move(rule.right), rule.at);
        rules_.push_back(std::move(rule));
    }

    /// `[B=]` says that the branch may go on, as `[B]` does in patterns.
    std::vector<Formal> right_context(std::vector<Formal> modules, std::size_t at) {
        std::vector<Formal> result;
        std::size_t depth = 0;
        bool is_free = false;
        for (Formal& module : modules) {
            if (module.letter == "=") {
                is_free = true;
                continue;
            }
            if (module.letter == "]") {
                if (depth == 0) lose(at, "a right context that leaves its branch");
                --depth;
                if (!is_free)
                    once("]", at, "that a branch in a right context ends where the context says; it may go on");
                is_free = false;
            } else if (is_free) {
                lose(at, "'=' somewhere else than at the end of a branch");
            }
            if (module.letter == "[") ++depth;
            result.push_back(std::move(module));
        }
        if (depth > 0 || is_free) lose(at, "a right context whose brackets do not balance");
        return result;
    }

    // --- the view file -------------------------------------------------------------------------------------

    void read_view() {
        const std::string& text = view_->text();
        bool in_comment = false;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            std::string line;
            for (std::size_t i = at; i < end; ++i) {
                if (!in_comment && text.compare(i, 2, "/*") == 0) in_comment = true;
                if (in_comment && text.compare(i, 2, "*/") == 0) {
                    in_comment = false;
                    ++i;
                    line += "  ";
                } else {
                    line += in_comment ? ' ' : text[i];
                }
            }
            if (const std::size_t rest = line.find("//"); rest != std::string::npos) line.resize(rest);
            while (!line.empty() && is_blank(line.back())) line.pop_back();
            std::size_t first = 0;
            while (first < line.size() && is_blank(line[first])) ++first;
            if (first < line.size()) setting(std::string_view(line).substr(first), at + first);
            at = end + 1;
        }
    }

    void setting(std::string_view line, std::size_t at) {
        const std::size_t colon = line.find(':');
        if (line.front() == '#' || colon == std::string_view::npos) {
            if (line.front() == '#') losses_.add(view_, at, "what the preprocessor does in a view file");
            return;
        }
        const std::string label = lower_case(line.substr(0, colon));
        std::string_view value = line.substr(colon + 1);
        while (!value.empty() && is_blank(value.front())) value.remove_prefix(1);
        std::size_t end = 0;
        while (end < value.size() && !is_blank(value[end])) ++end;
        double number = 0;
        const bool is_number = read_number(value.substr(0, end), number);
        const auto bad = [&](const char* message) {
            diagnostics_.error({view_, at + colon, 1}, message);
            failed_ = true;
        };
        if (label == "angle factor") {
            if (!is_number || number == 0) return bad("expected a number other than 0: the angle is 360/n degrees");
            const bool is_simple = number >= 1 && number <= 1e9 && number == std::floor(number);
            angle_ =
                is_simple ? fmt::format("angle factor: {}", number) : fmt::format("angle increment: 360/{}", number);
        } else if (label == "angle increment") {
            if (!is_number) return bad("expected degrees");
            angle_ = fmt::format("angle increment: {}", number);
        } else if (label == "line width increment") {
            if (!is_number) return bad("expected a number");
            width_increment_ = number;
        } else if (label == "initial line width" && is_number && number > 0 && number < 100) {
            while (end < value.size() && is_blank(value[end])) ++end;
            const bool in_pixels = end < value.size() && value[end] == 'p';
            stroke_ = fmt::format("stroke: {} {}", number, in_pixels ? "px" : "step");
        } else if (label == "scale factor" && is_number && number > 0 && number <= 1) {
            scale_ = fmt::format("scale factor: {}", 100 * number);
        } else {
            losses_.add(view_, at, fmt::format("'{}:' of the view", printable(label, 60)));
        }
    }

    // --- writing -------------------------------------------------------------------------------------------

    static std::string written(const std::vector<Formal>& modules, std::string_view between) {
        std::string text;
        for (const Formal& module : modules) {
            if (!text.empty()) text += between;
            text += module.letter;
            for (std::size_t i = 0; i < module.names.size(); ++i) text += (i == 0 ? '(' : ',') + module.names[i];
            if (!module.names.empty()) text += ')';
        }
        return text;
    }

    /// A blank before a backslash at the end would go on with the next line.
    static std::string line_of(std::string text) {
        if (text.ends_with(" \\")) text.erase(text.size() - 2, 1);
        return text + '\n';
    }

    static std::string written(const Rule& rule) {
        std::string text;
        if (!rule.left.empty()) text += written(rule.left, " ") + " < ";
        text += written(rule.predecessor, " ");
        if (!rule.right.empty()) text += " > " + written(rule.right, " ");
        if (rule.condition) text += " : " + rule.condition->text;
        text += " --> " + (rule.successor.empty() ? "*" : rule.successor);
        if (rule.weight) text += " : " + rule.weight->text;
        return line_of(std::move(text));
    }

    /// A condition with the parameters of another predecessor; nullopt if one of those is the name of a define in it.
    static std::optional<std::string> renamed(const Value& condition, const std::vector<Formal>& from,
                                              const std::vector<Formal>& to) {
        std::map<std::string, std::string, std::less<>> names;
        std::set<std::string, std::less<>> taken;
        for (std::size_t i = 0; i < from.size(); ++i) {
            for (std::size_t k = 0; k < from[i].names.size(); ++k) names[from[i].names[k]] = to[i].names[k];
        }
        for (const Formal& module : to) taken.insert(module.names.begin(), module.names.end());
        std::string result;
        const std::string& text = condition.text;
        for (std::size_t i = 0; i < text.size();) {
            if (!continues_identifier(text[i]) && text[i] != '.') {
                result += text[i++];
                continue;
            }
            std::size_t end = i;
            while (end < text.size() && (continues_identifier(text[end]) || text[end] == '.')) ++end;
            const std::string_view name = std::string_view(text).substr(i, end - i);
            const auto found = names.find(name);
            const bool is_function = end < text.size() && text[end] == '(';
            if (found != names.end()) {
                result += found->second;
            } else if (!is_function && taken.contains(name)) {
                return std::nullopt;
            } else {
                result += name;
            }
            i = end;
        }
        return result;
    }

    /// cpfg takes the first production that matches. A context-free one before one with contexts is so kept from
    /// being overtaken.
    void restore_order() {
        std::size_t written_bytes = 0;
        std::map<std::string, std::vector<std::size_t>> plain;  // context-free ones so far, by their first letter
        std::vector<Rule> kept;
        for (Rule& rule : rules_) {
            std::vector<std::size_t>& before = plain[rule.predecessor.front().letter];
            bool is_dead = false;
            if (rule.has_context()) {
                for (const std::size_t i : before) {
                    if (is_dead) break;
                    const Rule& other = kept[i];
                    const std::size_t common = std::min(other.predecessor.size(), rule.predecessor.size());
                    const std::vector<Formal> ours(rule.predecessor.begin(),
                                                   rule.predecessor.begin() + static_cast<std::ptrdiff_t>(common));
                    const std::vector<Formal> theirs(other.predecessor.begin(),
                                                     other.predecessor.begin() + static_cast<std::ptrdiff_t>(common));
                    if (type_of(ours) != type_of(theirs)) continue;
                    if (other.predecessor.size() > common) {
                        lose_part(rule.at, "that a production of several symbols before this one is tried first");
                    } else if (!other.condition) {
                        lose_part(rule.at, "a production that can never apply: one before it always does");
                        is_dead = true;
                    } else {
                        const auto condition = renamed(*other.condition, theirs, ours);
                        if (!condition || other.condition->is_random) {
                            lose_part(rule.at, "that a production without contexts before this one is tried first");
                            continue;
                        }
                        const std::string also = "!(" + *condition + ")";
                        const std::string own = rule.condition ? in_parentheses(*rule.condition, 2) + "&&" : "";
                        rule.condition = Value{own + also, 2, rule.condition && rule.condition->is_random};
                        written_bytes += rule.condition->text.size();
                        if (written_bytes > most_import_bytes) {
                            error(rule.at, "the productions together become longer than 64 MB");
                            return;
                        }
                    }
                }
            } else {
                before.push_back(kept.size());
            }
            if (!is_dead) kept.push_back(std::move(rule));
        }
        rules_ = std::move(kept);
    }

    /// What stands after a production that always applies to the same never does.
    void drop_dead(std::vector<Rule>& rules) {
        std::set<std::string> certain;
        std::erase_if(rules, [&](const Rule& rule) {
            const std::string key = type_of(rule.left) + "<" + type_of(rule.predecessor) + ">" + type_of(rule.right);
            if (certain.contains(key) && !rule.weight) {
                lose_part(rule.at, "a production that can never apply: one before it always does");
                return true;
            }
            if (!rule.condition && !rule.weight) certain.insert(key);
            return false;
        });
    }

    void weigh() {
        if (!seed_) {
            for (Rule& rule : rules_) {
                if (!rule.weight) continue;
                once("weight", rule.at, "probabilities, which cpfg does not look at either without 'seed:'");
                rule.weight.reset();
            }
            return;
        }
        std::map<std::string, std::set<std::string>> contexts;
        std::map<std::string, std::size_t> members;
        const auto context_of = [](const Rule& rule) { return type_of(rule.left) + "<>" + type_of(rule.right); };
        for (const Rule& rule : rules_) {
            const std::string predecessor = type_of(rule.predecessor);
            contexts[predecessor].insert(context_of(rule));
            if (contexts[predecessor].size() == 2) {
                once("mixed" + predecessor, rule.at,
                     "that with 'seed:' chance decides among all productions that match, whatever their contexts");
            }
            ++members[predecessor + "|" + context_of(rule)];
        }
        for (Rule& rule : rules_) {
            if (members[type_of(rule.predecessor) + "|" + context_of(rule)] < 2) {
                rule.weight.reset();
            } else if (!rule.weight) {
                rule.weight = Value{"1"};
            }
        }
    }

    /// What cpfg's turtle does otherwise than a pattern's, said by productions.
    std::string interpretation() {
        std::string lines;
        std::set<std::string> certain;
        if (homomorphism_depth_ > 0) {
            drop_dead(homomorphism_);
            std::set<std::string> letters;
            for (const Rule& rule : homomorphism_) letters.insert(rule.predecessor.front().letter);
            for (const Rule& rule : homomorphism_) {
                lines += written(rule);
                if (!rule.condition) certain.insert(type_of(rule.predecessor));
                const bool recurs = std::any_of(letters.begin(), letters.end(), [&](const std::string& letter) {
                    return rule.successor.find(letter) != std::string::npos;
                });
                if (homomorphism_depth_ > 1 && recurs) {
                    once("depth", homomorphism_depth_at_,
                         "that the homomorphism is applied to its own successors; here it is applied once");
                }
            }
        }
        for (const auto& [letter, count] : modules_) {
            std::vector<std::string> names;
            for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("a{}", i + 1));
            std::string successor;
            std::string condition;
            if (letter == "'" || letter == "@." || letter == "$") {
            } else if (letter == "@v") {
                successor = "$";
            } else if (letter == "/" || letter == "\\") {
                // Up is away from the reader there, as the code of cpfg has it.
                successor = letter == "/" ? "\\" : "/";
                if (count > 0) successor += "(a1)";
            } else if ((letter == "!" || letter == "#") && count == 0 && width_increment_ == 0) {
            } else if (letter == "@O" && count == 0) {
                lose_part(lsystem_at_, "discs as wide as the line");
            } else if ((letter == "@o" || letter == "@c" || letter == "@O") && count > 0) {
                successor = "@O(a1/2)";
            } else if ((letter == "{" || letter == "}") && count > 0) {
                condition = " : a1 != 0";
            } else {
                continue;
            }
            const std::vector<Formal> predecessor = {{letter, names}};
            if (certain.contains(type_of(predecessor))) continue;
            lines += line_of(written(predecessor, "") + condition + " --> " + (successor.empty() ? "*" : successor));
        }
        return lines.empty() ? "" : "\ninterpret:\n" + lines;
    }

    /// `ignore:` or `consider:`; a pattern's `consider:` never ignores brackets, and its lists hold no comma.
    std::string list() {
        if (!has_list_) return "";
        const auto is_listed = [&](const std::string& letter) {
            const bool first = listed_.contains(letter[0]);
            if (letter.size() > 1 && first != listed_.contains(letter[1])) {
                once("@list", lsystem_at_, "that contexts see one half of an @ function");
            }
            return first && (letter.size() == 1 || listed_.contains(letter[1]));
        };
        std::set<std::string> symbols = symbols_;
        for (const char letter : listed_) {
            if (letter != '@') symbols.insert(std::string(1, letter));
        }
        symbols.insert({"[", "]"});
        std::string yes;
        std::string no;
        for (const std::string& letter : symbols) (is_listed(letter) ? yes : no) += ' ' + letter;
        const auto has = [](const std::string& letters, char letter) {
            return letters.find(letter) != std::string::npos;
        };
        const std::string& ignored = considers_ ? no : yes;
        const std::string& seen = considers_ ? yes : no;
        const bool brackets_seen = has(seen, '[') && has(seen, ']');
        if (!has(ignored, ',') && (!considers_ || !brackets_seen)) {
            return ignored.empty() ? "" : line_of("ignore:" + ignored);
        }
        if (has(seen, ',')) lose_part(lsystem_at_, "that contexts see ','");
        if (!brackets_seen) lose_part(lsystem_at_, "that contexts pass through brackets");
        std::string considered;
        for (const char letter : seen) considered += letter == ',' ? ' ' : letter;
        return line_of("consider:" + considered);
    }

    void use_what_defines_use() {
        std::vector<std::string> pending(used_.begin(), used_.end());
        while (!pending.empty()) {
            const std::string text = number_texts_[pending.back()];
            pending.pop_back();
            for (std::size_t at = 0; at < text.size(); ++at) {
                const std::size_t begin = at;
                while (at < text.size() && continues_identifier(text[at])) ++at;
                std::string name = text.substr(begin, at - begin);
                if (number_texts_.contains(name) && used_.insert(name).second) pending.push_back(std::move(name));
            }
        }
    }

    std::string write() {
        weigh();
        if (!seed_) restore_order();
        drop_dead(rules_);
        const std::string contexts = list();
        const std::string drawing = interpretation();
        for (const char letter : called_) {
            if (named_.contains(letter)) {
                once("called", lsystem_at_, "that productions apply to the letters of @ functions");
            }
        }
        if (failed_) return {};
        std::string body;
        use_what_defines_use();
        for (const auto& [name, text] : number_texts_) {
            if (used_.contains(name)) body += fmt::format("define {} = {}\n", name, text);
        }
        if (!body.empty()) body += '\n';
        body += fmt::format("derivation length: {}\n{}\nturn: left\nforward: F G\nmove: f g\n", steps_,
                            angle_.empty() ? "angle increment: 45" : angle_);
        if (seed_) body += fmt::format("seed: {}\n", std::abs(*seed_));
        if (!scale_.empty()) body += scale_ + '\n';
        if (!stroke_.empty()) body += stroke_ + '\n';
        body += contexts;
        body += line_of("axiom: " + (axiom_->empty() ? std::string("*") : *axiom_));
        for (const Rule& rule : rules_) {
            body += written(rule);
            if (body.size() > most_import_bytes) break;  // as is told then
        }
        body += drawing;
        std::string comments;
        for (const auto& [letter, free] : surfaces_) {
            comments +=
                fmt::format("// The surface ~{} is ~{} here, as {} would move the turtle.\n", letter, free, letter);
        }
        const bool is_number = std::all_of(label_.begin(), label_.end(), is_digit);
        const std::string title = is_number ? name() : label_;
        return import_head(title, import_base_name(file_->name()), "Imported from a file of cpfg.", losses_.list()) +
               '\n' + comments + body;
    }

    const SourcePointer& file_;
    const SourcePointer& view_;
    Diagnostics& diagnostics_;
    ImportLosses losses_;
    std::string text_;  // without comments
    bool failed_ = false;
    std::size_t faults_ = 0;
    Section section_ = Section::before;
    std::size_t lsystem_at_ = nothing;
    std::string label_;

    Macros macros_;
    std::size_t budget_ = most_expanded_bytes;  // of what defines may still expand to
    std::set<std::string> defined_once_;
    std::vector<Condition> conditions_;
    std::size_t counted_begin_ = nothing;
    std::size_t counted_end_ = 0;
    std::size_t counted_ = 0;
    std::map<std::string, double, std::less<>> numbers_;
    std::map<std::string, std::string, std::less<>> number_texts_;
    std::map<std::string, std::size_t> assigned_;
    std::set<std::string> used_;
    std::size_t number_depth_ = 0;
    std::size_t unwritten_ = 0;  // expressions being read that the pattern does not hold
    std::size_t nesting_ = 0;

    long long steps_ = 0;
    std::optional<long long> seed_;
    std::set<char> listed_;
    bool has_list_ = false;
    bool considers_ = false;
    std::optional<std::string> axiom_;
    std::vector<Rule> rules_;
    std::vector<Rule> homomorphism_;
    long long homomorphism_depth_ = 1;
    std::size_t homomorphism_depth_at_ = 0;
    std::set<std::string, std::less<>> formals_;

    std::set<std::string> symbols_;                          // of words, predecessors and contexts
    std::set<std::pair<std::string, std::size_t>> modules_;  // of the words that are derived
    std::set<char> called_;
    std::set<char> named_;
    std::map<char, std::string> surfaces_;
    bool after_tilde_ = false;
    std::set<std::string> told_;

    std::string angle_;
    std::string stroke_;
    std::string scale_;
    double width_increment_ = 0;
};

}  // namespace

std::vector<ImportedSystem> import_cpfg(const SourcePointer& file, const SourcePointer& view,
                                        Diagnostics& diagnostics) {
    for (const SourcePointer& source : {file, view}) {
        if (!source) continue;
        if (source->text().size() > most_import_bytes) {
            diagnostics.unreadable({source, 0, 0}, "a file to import is at most 64 MB");
            return {};
        }
        if (const std::size_t nul = source->text().find('\0'); nul != std::string::npos) {
            diagnostics.unreadable({source, nul, 1}, "a NUL byte: this is no file of cpfg");
            return {};
        }
    }
    return {Importer(file, view, diagnostics).run()};
}

}  // namespace sikku
