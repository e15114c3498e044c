#include "engine/import/fractint_entry.h"

#include "engine/base/decimal.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace sikku::fractint {
namespace {

constexpr std::size_t most_word_bytes = std::size_t{1} << 20;  // bytes in all words of an entry
constexpr std::size_t most_numbers = 32;                       // different ones after @

class EntryReader {
public:
    EntryReader(const SourcePointer& file, std::string name, std::size_t at, Diagnostics& diagnostics)
        : file_(file), diagnostics_(diagnostics) {
        entry_.name = std::move(name);
        entry_.at = at;
    }

    Entry read(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        bool has_axiom = false;
        while (begin < end) {
            const std::size_t next = find_before(text, '\n', begin, end);
            const std::size_t stop = find_before(text, ';', begin, next);
            if (stop < next) note_comment(std::string_view(text).substr(stop, next - stop));
            if (read_line(begin, stop)) has_axiom = true;
            begin = next + 1;
        }
        if (!has_axiom || entry_.axiom.empty())
            fail(entry_.at, fmt::format("the entry '{}' has no axiom", entry_.name));
        if (entry_.angle == 0) fail(entry_.at, fmt::format("the entry '{}' has no angle", entry_.name));
        entry_.factors = find_factors(number_texts_);
        return std::move(entry_);
    }

private:
    [[noreturn]] void fail(std::size_t at, const std::string& message) const {
        fractint::fail(file_, diagnostics_, at, message);
    }
    void note_comment(std::string_view comment) {
        while (!comment.empty() && (comment.front() == ';' || comment.front() == ' ')) comment.remove_prefix(1);
        if (entry_.comments.size() > 300 || comment.empty()) return;
        entry_.comments += (entry_.comments.empty() ? "" : " ") + pattern_line(comment, 200);
    }

    /// Reads a line; true if it is the axiom.
    bool read_line(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        const auto is_blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\t' || text[i] == '\r'; };
        const auto skip = [&](std::size_t i) {
            while (i < end && is_blank(i)) ++i;
            return i;
        };
        const auto word_end = [&](std::size_t i) {
            while (i < end && !is_blank(i)) ++i;
            return i;
        };
        begin = skip(begin);
        if (begin >= end) return false;
        std::size_t at = begin;
        while (at < end && !is_blank(at) && text[at] != '=') ++at;
        const std::string key = lower_case(std::string_view(text).substr(begin, at - begin));
        at = skip(at);
        if (at < end && text[at] == '=') at = skip(at + 1);
        const std::size_t stop = word_end(at);
        if (skip(stop) < end) fail(skip(stop), "text after the word: a word cannot contain blanks");
        if (key == "axiom") {
            entry_.axiom = tokens(at, stop);
            return true;
        }
        if (key == "angle") {
            const auto [last, error] = std::from_chars(text.data() + at, text.data() + stop, entry_.angle);
            if (error != std::errc() || last != text.data() + stop || entry_.angle < 3 || entry_.angle > 50) {
                fail(std::min(at, end - 1), "expected a whole number from 3 to 50: the turn is 360/n degrees");
            }
            return false;
        }
        if (key.size() != 1) fail(begin, "expected 'Angle n', 'Axiom word' or a rule 'c=word'");
        // Older versions of Fractint use such rules for colours.
        if (std::string_view("+-/\\@|!][").find(key) != std::string_view::npos) {
            fail(begin, fmt::format("a rule for the command '{}' is not allowed", key));
        }
        if (index_of(key[0]) >= 0x80 || index_of(key[0]) < 0x20) {
            fail(begin, "a rule must be for one ASCII character");
        }
        Tokens body = tokens(at, stop);
        // Rules for the same character are concatenated.
        Tokens& rule = entry_.rules[key[0]];
        rule.insert(rule.end(), body.begin(), body.end());
        return false;
    }

    Tokens tokens(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        word_bytes_ += end - begin;
        if (word_bytes_ > most_word_bytes) fail(begin, "the words of an entry are longer than 1 MB");
        Tokens result;
        std::vector<std::size_t> open;
        for (std::size_t at = begin; at < end;) {
            Token token;
            token.at = static_cast<std::uint32_t>(at);
            token.letter = lower_case(std::string_view(text).substr(at, 1))[0];
            if (index_of(token.letter) >= 0x80 || index_of(token.letter) < 0x20) {
                fail(at, "words must consist of ASCII characters");
            }
            ++at;
            if (takes_number(token.letter)) read_number_of(token, at, end);
            if (token.letter == '[') {
                open.push_back(token.at);
            } else if (token.letter == ']' && open.empty()) {
                diagnostics_.warning({file_, token.at, 1}, "']' without '[': Fractint reads this word no further");
                return result;
            } else if (token.letter == ']') {
                open.pop_back();
            }
            result.push_back(token);
        }
        if (!open.empty()) fail(open.back(), "this '[' is not closed on its line");
        return result;
    }

    /// Reads `Q` and `I` in any order, then a decimal number of digits and points.
    void read_number_of(Token& token, std::size_t& at, std::size_t end) {
        const std::string& text = file_->text();
        bool root = false, inverse = false;
        for (int i = 0; i < 2 && at < end; ++i) {
            const char byte = lower_case(std::string_view(text).substr(at, 1))[0];
            if (byte != 'q' && byte != 'i') break;
            (byte == 'q' ? root : inverse) = true;
            ++at;
        }
        const std::size_t begin = at;
        while (at < end && (is_digit(text[at]) || text[at] == '.')) ++at;
        double number = 0;
        if (at > begin) {
            const auto [last, error] = parse_number(std::string_view(text).substr(begin, at - begin), number);
            if (error != std::errc() || last != text.data() + at) fail(begin, "this is not a decimal number");
        }
        if (token.letter == '@') {
            if (!(number > 0)) fail(token.at, "expected a number above 0 after '@': the step would have no length");
            const auto known = std::find(numbers_.begin(), numbers_.end(), number);
            token.base = static_cast<std::uint16_t>(known - numbers_.begin());
            if (known == numbers_.end()) {
                numbers_.push_back(number);
                number_texts_.push_back(text.substr(begin, at - begin));
            }
            if (numbers_.size() > most_numbers) fail(token.at, "more than 32 different numbers after '@'");
            token.root = static_cast<std::int8_t>(number == 1 ? 0 : (root ? 1 : 2) * (inverse ? -1 : 1));
            return;
        }
        if (number > 0 && root) number = std::sqrt(number);
        if (number > 0 && inverse) number = 1 / number;
        if (!(number < 1e9)) fail(token.at, "expected a number below 1000000000 here");
        const bool is_angle = token.letter == '\\' || token.letter == '/';
        token.number = is_angle ? number : std::floor(number);
    }

    const SourcePointer& file_;
    Diagnostics& diagnostics_;
    Entry entry_;
    std::vector<double> numbers_;  // distinct numbers after @
    std::vector<std::string> number_texts_;
    std::size_t word_bytes_ = 0;
};

}  // namespace

std::size_t find_before(const std::string& text, char wanted, std::size_t begin, std::size_t end) {
    const std::size_t found = std::string_view(text).substr(0, end).find(wanted, begin);
    return std::min(found, end);
}

std::size_t Entry::first_of(std::string_view list) const {
    std::size_t first = at;
    bool found = false;
    const auto look = [&](const Tokens& word) {
        for (const Token& token : word) {
            if (list.find(token.letter) == std::string_view::npos || (found && token.at >= first)) continue;
            first = token.at;
            found = true;
        }
    };
    look(axiom);
    for (const auto& [letter, rule] : rules) look(rule);
    return first;
}

Entry read_entry(const SourcePointer& file, std::string name, std::size_t at, std::size_t begin, std::size_t end,
                 Diagnostics& diagnostics) {
    return EntryReader(file, std::move(name), at, diagnostics).read(begin, end);
}

}  // namespace sikku::fractint
