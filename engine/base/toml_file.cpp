#include "engine/base/toml_file.h"

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace sikku {
namespace {

constexpr std::size_t most_toml_values = 250'000;
constexpr std::size_t most_depth = 50;

std::string place_of(const std::string& file, std::size_t line, std::size_t column) {
    return fmt::format("{}:{}:{}", file, line, column);
}

std::string place_of(const std::string& file, const toml::source_position& position) {
    return place_of(file, position.line, position.column);
}

/// Counts nesting and values before the parser, which is recursive, sees them. Skips strings and comments like the
/// parser, up to its first error.
class TomlScan {
public:
    TomlScan(const std::string& file, std::string_view text) : file_(file), text_(text) {}

    void run() {
        std::size_t depth = 0;
        std::size_t dots = 0;  // of the key or number that is being read
        std::size_t values = 0;
        for (at_ = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0; at_ < text_.size();) {
            const char letter = text_[at_];
            // toml++ 3.3 reads out of bounds on such a character.
            require(static_cast<unsigned char>(letter) < 0x80,
                    "non-ASCII characters are allowed only in strings and comments");
            if (letter == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
                continue;
            }
            if (letter == '"' || letter == '\'') {
                // Elsewhere the parser would read the quote as part of a number or a word.
                require(may_begin_string(),
                        "unexpected quote: expected a key, '=', ',' or a bracket before a string");
                pass_string(letter);
                continue;
            }
            if (letter == '.') {
                require(++dots <= most_depth, "too many dots: keys nest at most 50 deep");
            } else if (letter == '[' || letter == '{') {
                require(++depth <= most_depth, "too many brackets: values nest at most 50 deep");
            } else if (letter == ']' || letter == '}') {
                depth -= depth > 0 ? 1 : 0;
            }
            if (letter == ',' || letter == '=' || letter == '[' || letter == '{' || letter == '\n') dots = 0;
            // Each dot in a key creates a table.
            if (letter == ',' || letter == '=' || letter == '[' || letter == '.') {
                require(++values <= most_toml_values, "too many values: a file has at most 250000");
            }
            ++at_;
        }
    }

private:
    void require(bool holds, const char* message) const {
        if (holds) return;
        const std::string_view before = text_.substr(0, at_);
        const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
        fail(place_of(file_, static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1,
                      at_ - line_begin + 1),
             message);
    }

    /// True after a blank, a separator or a bracket, or after a dot that follows a key and not a number.
    bool may_begin_string() const {
        if (at_ == 0) return true;
        const char before = text_[at_ - 1];
        if (before != '.') return std::string_view(" \t\r\n=,[{").find(before) != std::string_view::npos;
        std::size_t begin = at_ - 1;
        const auto is_bare = [](char letter) {
            return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-' ||
                   letter == '+' || letter == '.';
        };
        while (begin > 0 && is_bare(text_[begin - 1])) --begin;
        return std::isalpha(static_cast<unsigned char>(text_[begin])) != 0 || text_[begin] == '.';
    }

    void pass_string(char quote) {
        const std::string three(3, quote);
        const bool is_long = text_.compare(at_, 3, three) == 0;
        at_ += is_long ? 3 : 1;
        while (at_ < text_.size()) {
            if (quote == '"' && text_[at_] == '\\') {
                at_ += 2;
            } else if (!is_long && (text_[at_] == quote || text_[at_] == '\n')) {
                ++at_;
                return;
            } else if (is_long && text_.compare(at_, 3, three) == 0) {
                at_ += 3;
                // Up to two quotes may precede the closing three.
                while (at_ < text_.size() && text_[at_] == quote) ++at_;
                return;
            } else {
                ++at_;
            }
        }
    }

    const std::string& file_;
    std::string_view text_;
    std::size_t at_ = 0;
};

FileValue value_of(const toml::node& node, const std::string& file) {
    FileValue value;
    value.place = place_of(file, node.source().begin);
    value.order = {node.source().begin.line, node.source().begin.column};
    if (const auto* text = node.as_string()) {
        value.text = text->get();
    } else if (const auto* whole = node.as_integer()) {
        value.text = fmt::format("{}", whole->get());
    } else if (const auto* number = node.as_floating_point()) {
        if (!std::isfinite(number->get())) fail(value.place, "expected a finite number");
        value.text = fmt::format("{}", number->get());
        if (value.text.ends_with(".0")) value.text.resize(value.text.size() - 2);
    } else if (const auto* flag = node.as_boolean()) {
        value.text = flag->get() ? "true" : "false";
    } else if (const auto* array = node.as_array()) {
        value.type = FileValue::Type::list;
        value.list.reserve(array->size());
        for (const toml::node& element : *array) value.list.push_back(value_of(element, file));
    } else if (const auto* table = node.as_table()) {
        value.type = FileValue::Type::table;
        if (table->size() > most_table_keys) {
            fail(value.place, fmt::format("too many keys: a table has at most {}", most_table_keys));
        }
        for (const auto& [key, element] : *table) {
            FileValue inner = value_of(element, file);
            inner.place = place_of(file, key.source().begin);
            inner.order = {key.source().begin.line, key.source().begin.column};
            value.table.push_back({std::string(key.str()), std::move(inner)});
        }
        std::sort(value.table.begin(), value.table.end(),
                  [](const auto& a, const auto& b) { return a.value.order < b.value.order; });
    } else {
        value.type = FileValue::Type::other;
    }
    return value;
}

/// True if the value in a line is a word without quotes.
bool has_bare_text(std::string_view text, std::size_t line) {
    for (; line > 1 && !text.empty(); --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find('\n'));
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return false;
    const std::size_t first = text.find_first_not_of(" \t[", equals + 1);
    if (first == std::string_view::npos) return false;
    return is_letter(text[first]) || text[first] == '#';
}

}  // namespace

void fail(const std::string& place, const std::string& message) {
    throw FileError(place.empty() ? message : place + ": " + message);
}

void fail(const FileValue& value, const std::string& message) {
    throw FileError(value.place + ": " + message, value.order);
}

FileValue read_toml(const std::string& file, const std::string& text) {
    if (text.size() > most_toml_bytes) fail(file, "the file is too large: a file has at most 16 MB");
    TomlScan(file, text).run();
    try {
        return value_of(toml::parse(text, file), file);
    } catch (const toml::parse_error& error) {
        const std::string place = place_of(file, error.source().begin);
        if (has_bare_text(text, error.source().begin.line))
            fail(place, "text values need quotes, as in size = \"A4\"");
        fail(place, printable(error.description(), 300));
    }
}

}  // namespace sikku
