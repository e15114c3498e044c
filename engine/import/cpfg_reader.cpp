// engine/import/cpfg_reader.cpp: reads the L-system of a file of cpfg.
#include "engine/base/text.h"
#include "engine/import/cpfg_words.h"

#include <array>
#include <iterator>

namespace sikku::cpfg {
namespace {

constexpr std::size_t most_productions = 10'000;
constexpr std::size_t most_faults = 10'000;
constexpr std::size_t nothing = std::string::npos;

/// The keyword that a line begins with, in lower case and without blanks; empty if there is none.
std::string keyword_of(std::string_view line) {
    const std::string text = lower_case(line.substr(skip_blanks(line, 0)).substr(0, 24));
    constexpr std::array<std::string_view, 19> keywords = {
        "lsystem:", "seed:",   "derivation length:", "derivationlength:", "maximum depth:", "consider:", "ignore:",
        "axiom:",   "define:", "ring lsystem",       "start each:",       "starteach:",     "end each:", "endeach:",
        "start:",   "end:",    "homomorphism",       "decomposition",     "endlsystem"};
    for (const std::string_view keyword : keywords) {
        if (!text.starts_with(keyword)) continue;
        std::string result;
        std::copy_if(keyword.begin(), keyword.end(), std::back_inserter(result), [](char c) { return c != ' '; });
        return result;
    }
    return {};
}

class SystemReader {
public:
    SystemReader(std::string text, const View& view, Report& report)
        : text_(std::move(text)),
          report_(report),
          preprocessor_(text_, defines_, report),
          expressions_(defines_, report),
          words_(view, defines_, expressions_, report) {}

    System read() {
        blank_comments(text_, report_);
        read_lines();
        system_.letters = std::move(words_.letters);
        for (const std::string& name : expressions_.used()) system_.defines[name] = expressions_.numbers().at(name);
        return std::move(system_);
    }

private:
    enum class Section { before, header, productions, decomposition, homomorphism, after };

    std::size_t line_end(std::size_t at) const { return std::min(text_.find('\n', at), text_.size()); }
    std::size_t first_of_line(std::size_t at) const {
        while (at < text_.size() && text_[at] != '\n' && is_blank(text_[at])) ++at;
        return at;
    }
    /// True for a line of the preprocessor. After a tab, `#(0.1)` continues the previous production.
    bool is_directive(std::size_t at) const {
        const std::size_t first = first_of_line(at);
        if (first >= text_.size() || text_[first] != '#') return false;
        const bool continues = text_[at] == '\t' && system_.axiom;
        return !continues ||
               Preprocessor::is_directive(std::string_view(text_).substr(first, line_end(first) - first));
    }

    void read_lines() {
        for (std::size_t at = 0; at < text_.size() && section_ != Section::after;) {
            std::size_t end = line_end(at);
            if (is_directive(at)) {
                // A backslash at the end continues the line.
                while (
                    end < text_.size() && end > at &&
                    (text_[end - 1] == '\\' || (text_[end - 1] == '\r' && end > at + 1 && text_[end - 2] == '\\'))) {
                    text_[text_[end - 1] == '\\' ? end - 1 : end - 2] = ' ';
                    text_[end] = ' ';
                    end = line_end(end);
                }
                attempt([&] { preprocessor_.directive(first_of_line(at), end); });
                at = end + 1;
                continue;
            }
            // A line that begins with a tab continues the one before; so does an open brace of C.
            while (end + 1 < text_.size() &&
                   ((text_[end + 1] == '\t' && !is_directive(end + 1)) || open_braces(at, end) > 0)) {
                text_[end] = ' ';
                end = line_end(end);
            }
            if (preprocessor_.is_active() && first_of_line(at) < end) {
                attempt([&] { line(first_of_line(at), end); });
            }
            at = end + 1;
        }
        preprocessor_.finish();
    }

    /// Number of open braces of a block of C that began in this line; 0 in other lines.
    std::size_t open_braces(std::size_t begin, std::size_t end) {
        // Each line is counted only once, however many lines follow.
        if (counted_begin_ != begin) {
            const std::string_view line = std::string_view(text_).substr(begin, end - begin);
            std::size_t first = nothing;
            const std::string keyword = keyword_of(line);
            if (keyword == "define:" || keyword.starts_with("start") || keyword == "end:" || keyword == "endeach:") {
                first = 0;
            } else if (section_ == Section::productions || section_ == Section::decomposition ||
                       section_ == Section::homomorphism) {
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
            // Further errors would not help.
            if (++faults_ > most_faults) section_ = Section::after;
            if (!fault.is_loss) {
                report_.error(fault.at, fault.message);
            } else if (faults_ > most_faults) {
                report_.error(fault.at, "more than 10,000 productions cannot be imported");
            } else if (section_ == Section::header) {
                report_.error(fault.at, fault.message);  // the axiom or another required part
            } else {
                report_.loss(fault.at, fmt::format("this production: {}", fault.message));
            }
        }
    }

    void line(std::size_t begin, std::size_t end) {
        const std::string_view whole = std::string_view(text_).substr(begin, end - begin);
        const std::string keyword = keyword_of(whole);
        const std::size_t colon = keyword.ends_with(':') ? whole.find(':') + 1 : whole.size();
        const std::string_view rest = whole.substr(colon);
        const std::size_t rest_at = begin + colon;
        if (keyword == "lsystem:") {
            if (section_ != Section::before) {
                report_.loss(begin, "the sub-L-systems that follow");
                section_ = Section::after;
                return;
            }
            system_.at = begin;
            system_.label = pattern_line(rest, 80);
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
            system_.decomposition_at = begin;
            section_ = Section::decomposition;
        } else if (section_ == Section::header) {
            item(keyword, begin, rest, rest_at);
        } else if (section_ == Section::decomposition && keyword == "maximumdepth:") {
            Reader reader(defines_, rest, rest_at);
            system_.decomposition_depth = expressions_.whole_number(reader);
        } else if (section_ == Section::homomorphism && keyword == "maximumdepth:") {
            Reader reader(defines_, rest, rest_at);
            system_.homomorphism_depth = expressions_.whole_number(reader);
            if (system_.homomorphism_depth > 1) system_.homomorphism_depth_at = begin;
        } else if ((section_ == Section::homomorphism || section_ == Section::decomposition) && keyword == "seed:") {
            return;  // seeds of random choices: homomorphisms make none, and patterns have a single seed
        } else {
            production(whole, begin);
        }
    }

    /// Reports further L-systems of the file, which the first one calls.
    void look_for_more(std::size_t at) {
        for (at = std::min(at + 1, text_.size()); at < text_.size(); at = line_end(at) + 1) {
            const std::string_view line = std::string_view(text_).substr(at, line_end(at) - at);
            if (keyword_of(line) == "lsystem:") return report_.loss(at, "the sub-L-systems that follow");
        }
    }

    void item(const std::string& keyword, std::size_t begin, std::string_view rest, std::size_t rest_at) {
        Reader reader(defines_, rest, rest_at);
        if (keyword == "derivationlength:") {
            system_.steps = expressions_.steps = std::max<long long>(0, expressions_.whole_number(reader));
        } else if (keyword == "seed:") {
            system_.seed = expressions_.whole_number(reader);
        } else if (keyword == "ignore:" || keyword == "consider:") {
            system_.listed.clear();
            system_.considers = keyword == "consider:";
            system_.has_list = true;
            while (const char byte = reader.peek()) {
                check_symbol(byte, reader.where());
                system_.listed.insert(byte);
                reader.take();
            }
        } else if (keyword == "axiom:") {
            system_.axiom.emplace();
            section_ = Section::productions;
            try {
                system_.axiom = words_.word(reader, section_ == Section::homomorphism);
            } catch (const Fault& fault) {
                mistake(fault.at, fault.message);  // a system needs an axiom
            }
            if (reader.peek() != 0) mistake(reader.where(), "expected a symbol here");
        } else if (keyword == "ringlsystem") {
            report_.loss(begin, "the ring of the word: here its end is not a neighbour of its beginning");
        } else if (keyword == "start:") {
            note_globals(rest);
            start(reader, begin);
        } else if (keyword.empty()) {
            mistake(begin, "expected an item such as 'derivation length:' or 'Axiom:'");
        } else {
            note_globals(rest);
            report_.loss(begin, fmt::format("the C statements of '{}'", keyword));
        }
    }

    /// Collects the names in the statements before the axiom: a production that sets one affects other
    /// productions.
    void note_globals(std::string_view text) {
        for (std::size_t at = 0; at < text.size();) {
            const std::string_view name = take_identifier(text, at);
            if (!name.empty()) globals_.emplace(name);
            if (name.empty()) ++at;
        }
    }

    /// Reads `{a = 1; b = 2*a;}`. Names that are set only here become defines.
    void start(Reader& reader, std::size_t begin) {
        try {
            if (!expressions_.takes(reader, '{')) lose(begin, "");
            while (expressions_.next(reader) != '}') {
                const std::string name = expressions_.identifier(reader);
                if (name.empty() || !expressions_.takes(reader, '=')) lose(begin, "");
                const Value value = expressions_.read(reader);
                if (value.is_random || !expressions_.takes(reader, ';')) lose(begin, "");
                if (times_assigned(name) != 1 || defines_.macros.contains(name)) lose(begin, "");
                expressions_.define(name, value);
            }
        } catch (const Fault& fault) {
            if (!fault.is_loss) throw;
            report_.loss(begin, "the C statements of 'start:'");
        }
    }

    /// Number of times that the whole file contains the name before a single '=' or after '&'.
    std::size_t times_assigned(const std::string& name) {
        if (assigned_.empty()) {
            for (std::size_t at = 0; at < text_.size();) {
                if (!begins_identifier(text_[at]) || (at > 0 && continues_identifier(text_[at - 1]))) {
                    ++at;
                    continue;
                }
                const std::size_t begin = at;
                const std::string assigned(take_identifier(text_, at));
                const std::size_t after = skip_blanks(text_, at);
                const bool is_set = after + 1 < text_.size() && text_[after] == '=' && text_[after + 1] != '=';
                const bool is_lent = begin > 1 && text_[begin - 1] == '&' && text_[begin - 2] != '&';
                if (is_set || is_lent) ++assigned_[assigned];
            }
        }
        return assigned_[name];
    }

    void production(std::string_view text, std::size_t at) {
        Reader reader(defines_, text, at);
        expressions_.forget_formals();
        Rule rule;
        rule.at = at;
        rule.predecessor = words_.formal_modules(reader);
        if (reader.takes('<')) {
            rule.left = std::move(rule.predecessor);
            rule.predecessor = words_.formal_modules(reader);
        }
        if (reader.takes('>')) rule.right = words_.formal_modules(reader);
        if (rule.predecessor.empty()) mistake(at, "expected a predecessor");
        if (reader.takes(':')) {
            block(reader);
            if (!expressions_.takes(reader, '*') && !is_arrow(reader)) rule.condition = expressions_.read(reader);
            block(reader);
        }
        if (reader.peek() == 0 || !is_arrow(reader)) {
            mistake(reader.where(),
                    reader.peek() == 0 ? "expected '-->' after the predecessor" : "expected '-->' here");
        }
        reader.take(3);
        if (reader.peek() == 0) mistake(at, "expected a successor; '*' is the empty one");
        if (!reader.takes('*')) rule.successor = words_.word(reader, section_ == Section::homomorphism);
        if (reader.takes(':')) rule.weight = expressions_.read(reader);
        if (expressions_.next(reader) != 0) mistake(reader.where(), "expected the end of the line");
        keep(std::move(rule));
    }

    /// Reads the statements of a production. Values assigned to names that no other production uses replace the
    /// names. Other statements are lost, and so is everything that depends on them.
    void block(Reader& reader) {
        if (expressions_.next(reader) != '{') return;
        const std::size_t at = reader.where();
        reader.take();
        while (expressions_.next(reader) != '}') {
            if (statement(reader, at)) continue;
            report_.loss(at, "the C statements of a production");
            return skip_block(reader, at);
        }
        reader.take();
    }

    /// True for `+=`, `++` and the like after the name of a variable.
    static bool changes_variable(std::string_view after) {
        if (after.starts_with("++") || after.starts_with("--")) return true;
        return after.size() > 1 && after[1] == '=' &&
               std::string_view("+-*/%").find(after[0]) != std::string_view::npos;
    }

    /// Reads one statement. False if it is not an assignment to a local variable; then its name has no value.
    bool statement(Reader& reader, std::size_t at) {
        if (expressions_.takes(reader, ';')) return true;
        const std::string name = expressions_.identifier(reader);
        if (name == "printf" && expressions_.next(reader) == '(') {
            report_.once("printf", at, "what printf() writes");
            bool in_text = false;
            while (const char byte = expressions_.next(reader)) {
                if (byte == '"') in_text = !in_text;
                reader.take();
                if (byte == ';' && !in_text) return true;
            }
            return false;
        }
        if (name.empty()) return false;
        const char sign = expressions_.next(reader);
        if (changes_variable(reader.ahead())) expressions_.set_local(name, {""});
        if (sign != '=') return false;
        reader.take();
        try {
            Value value = expressions_.read(reader);
            if (!globals_.contains(name) && expressions_.takes(reader, ';')) {
                expressions_.set_local(name, std::move(value));
                return true;
            }
        } catch (const Fault&) {
            // C has expressions that productions lack.
        }
        expressions_.set_local(name, {""});
        return false;
    }

    /// Skips the rest of a block; variables that it sets have no value.
    void skip_block(Reader& reader, std::size_t at) {
        std::size_t depth = 1;
        bool steps_variable = false;  // `++` or `--` precedes
        while (const char byte = expressions_.next(reader)) {
            if (const std::string name = expressions_.identifier(reader); !name.empty()) {
                const bool follows_change = steps_variable;
                steps_variable = false;
                const bool is_set = expressions_.next(reader) == '=' && !reader.ahead().starts_with("==");
                if (is_set || follows_change || changes_variable(reader.ahead())) expressions_.set_local(name, {""});
                continue;
            }
            if (byte == '{') ++depth;
            if (byte == '}') --depth;
            steps_variable = reader.ahead().starts_with("++") || reader.ahead().starts_with("--");
            if (steps_variable) reader.take();
            reader.take();
            if (depth == 0) return;
        }
        mistake(at, "this '{' is not closed");
    }

    void keep(Rule rule) {
        if (system_.rules.size() + system_.decomposition.size() + system_.homomorphism.size() >= most_productions) {
            mistake(rule.at, "there are more than 10,000 productions");
        }
        if (section_ == Section::homomorphism) {
            if (rule.predecessor.size() > 1) lose(rule.at, "a homomorphism replaces one symbol");
            for (std::vector<Formal>* context : {&rule.left, &rule.right}) {
                for (const Formal& module : *context) {
                    if (!module.names.empty()) lose(rule.at, "a homomorphism has no contexts");
                    report_.once("contexts", rule.at, "the contexts of a homomorphism, which cpfg also ignores");
                }
                context->clear();
            }
            rule.weight.reset();
            system_.homomorphism.push_back(std::move(rule));
            return;
        }
        if (section_ == Section::decomposition) {
            if (rule.predecessor.size() > 1 || rule.has_context()) {
                lose(rule.at, "a decomposition replaces one symbol, without contexts");
            }
            system_.decomposition.push_back(std::move(rule));
            return;
        }
        for (const Formal& module : rule.left) {
            if (module.letter == "[" || module.letter == "]")
                lose(rule.at, "brackets in a left context match nothing");
        }
        rule.right = right_context(std::move(rule.right), rule.at);
        system_.rules.push_back(std::move(rule));
    }

    /// Translates a right context. `[B=]` matches branches that continue after B, as `[B]` does in patterns.
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
                    report_.once("]", at, "right contexts that end with their branch; here the branch may be longer");
                is_free = false;
            } else if (is_free) {
                lose(at, "'=' that is not at the end of a branch");
            }
            if (module.letter == "[") ++depth;
            result.push_back(std::move(module));
        }
        if (depth > 0 || is_free) lose(at, "a right context whose brackets do not balance");
        return result;
    }

    std::string text_;  // without comments
    Report& report_;
    Defines defines_;
    Preprocessor preprocessor_;
    Expressions expressions_;
    Words words_;
    System system_;
    Section section_ = Section::before;
    std::size_t faults_ = 0;
    std::size_t counted_begin_ = nothing;
    std::size_t counted_end_ = 0;
    std::size_t counted_ = 0;
    std::map<std::string, std::size_t> assigned_;
    std::set<std::string, std::less<>> globals_;  // names in statements outside of productions
};

}  // namespace

System read_system(std::string text, const View& view, Report& report) {
    return SystemReader(std::move(text), view, report).read();
}

}  // namespace sikku::cpfg
