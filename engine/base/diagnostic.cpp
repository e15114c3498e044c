#include "engine/base/diagnostic.h"

#include "engine/base/characters.h"
#include "engine/base/decimal.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <tuple>

namespace sikku {
namespace {

constexpr std::size_t most_errors = 50;

/// Replaces comments, continued line ends, carriage returns before a line end and a byte order mark by blanks, so
/// that offsets stay those of the file.
/// @param open_comment  receives the offset of a comment without end
std::string clean(const std::string& text, std::size_t& open_comment) {
    std::string cleaned;  // a copy from the first change on
    const auto blank = [&](std::size_t begin, std::size_t end) {
        if (cleaned.empty()) cleaned = text;
        std::fill(cleaned.begin() + static_cast<std::ptrdiff_t>(begin),
                  cleaned.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    };
    const auto at_byte = [&](std::size_t i) { return cleaned.empty() ? text[i] : cleaned[i]; };
    std::size_t at = 0;
    if (text.starts_with("\xEF\xBB\xBF")) {
        blank(0, 3);
        at = 3;
    }
    bool only_blanks = true;  // of the logical line so far
    while (at < text.size()) {
        const char byte = text[at];
        if (byte == '\n') {
            std::size_t last = at;
            if (last > 0 && text[last - 1] == '\r') blank(--last, at);
            if (last >= 2 && at_byte(last - 1) == '\\' && is_blank(at_byte(last - 2))) {
                blank(last - 1, at + 1);
            } else {
                only_blanks = true;
            }
            ++at;
        } else if (byte == '/' && text.compare(at, 2, "//") == 0 && only_blanks) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            blank(at, end);
            at = end;
        } else if (byte == '/' && text.compare(at, 2, "/*") == 0) {
            const std::size_t close = text.find("*/", at + 2);
            if (close == std::string::npos) {
                open_comment = at;
                blank(at, text.size());
                break;
            }
            blank(at, close + 2);
            at = close + 2;
        } else {
            if (!is_blank(byte)) only_blanks = false;
            ++at;
        }
    }
    if (text.ends_with('\r')) blank(text.size() - 1, text.size());
    return cleaned;
}

/// True for characters that a terminal obeys or that reorder those after them: control characters (C0, DEL, C1) and
/// embeddings, overrides and isolates of the direction of writing (U+202A to U+202E, U+2066 to U+2069).
bool is_command(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character.empty() ? ' ' : character[0]);
    return lead < 0x20 || lead == 0x7F || (character >= "\u0080" && character <= "\u009F") ||
           (character >= "\u202A" && character <= "\u202E") || (character >= "\u2066" && character <= "\u2069");
}

/// Returns at most 80 columns of the line around `at`, with tabs as blanks and unprintable text as '?', and the
/// caret's column within it.
std::string excerpt(const std::string& text, std::size_t at) {
    at = std::min(at, text.size());
    std::size_t begin = at;
    int before = 0;
    while (begin > 0 && text[begin - 1] != '\n' && before < 50) {
        --begin;
        if (!is_continuation(text[begin])) ++before;
    }
    while (begin < at && is_continuation(text[begin])) ++begin;
    std::string line, caret;
    int columns = 0;
    if (begin == 0 && text.starts_with("\xEF\xBB\xBF")) begin = 3;
    for (std::size_t i = begin; i < text.size() && text[i] != '\n' && columns < 80;) {
        // A column is a byte with its continuation bytes, as place() counts.
        std::size_t end = i + 1;
        while (end < text.size() && is_continuation(text[end])) ++end;
        if (text[i] != '\r') {
            const std::string_view point = std::string_view(text).substr(i, end - i);
            const auto lead = static_cast<unsigned char>(text[i]);
            if (lead == '\t') {
                line += ' ';
            } else if (utf8_length(point) != point.size() || is_command(point)) {
                line += '?';
            } else {
                line += point;
            }
            if (i < at) caret += ' ';
            ++columns;
        }
        i = end;
    }
    return line + '\n' + caret + '^';
}

std::string text_of(const std::vector<Diagnostic>& list, std::size_t errors) {
    std::string text;
    for (const Diagnostic& diagnostic : list) {
        if (!text.empty()) text += '\n';
        text += diagnostic.text();
    }
    if (errors > most_errors) text += fmt::format("\n{} more errors are not shown", errors - most_errors);
    return text;
}

/// Replaces control characters of terminals, and line breaks by `line_end`.
std::string plain_text(std::string_view text, std::size_t most, char line_end) {
    std::string result;
    const auto append = [&](std::size_t begin, std::size_t end) {
        while (begin < end) {
            const std::size_t length = utf8_length(text.substr(begin));
            const std::string_view point = text.substr(begin, length);
            if (point == "\n") {
                result += line_end;
            } else if (point == "\r" || point == "\u2028" || point == "\u2029") {
                result += ' ';
            } else if (length == 0 || is_command(point)) {
                result += '?';
            } else {
                result += point;
            }
            begin += std::max<std::size_t>(length, 1);
        }
    };
    if (text.size() <= most) {
        append(0, text.size());
    } else {
        std::size_t tail = text.size() - most / 2;
        while (tail < text.size() && is_continuation(text[tail])) ++tail;
        append(0, most / 2);
        result += " … ";
        append(tail, text.size());
    }
    return result;
}

}  // namespace

Source::Source(std::string name, std::string text, bool is_value)
    : Source(std::move(name), std::move(text), is_value, {}, {}) {}

Source::Source(std::string shown, std::string text, bool is_value, std::string setting, std::string value)
    : name_(std::move(shown)),
      text_(std::move(text)),
      is_value_(is_value),
      setting_(std::move(setting)),
      value_(std::move(value)),
      cleaned_(clean(text_, open_comment_)) {}

Place Source::place(std::size_t at) const {
    at = std::min(at, text_.size());
    const auto begin = text_.begin();
    const auto here = begin + static_cast<std::ptrdiff_t>(at);
    const std::size_t newline = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
    std::size_t line_begin = newline == std::string::npos ? 0 : newline + 1;
    if (line_begin == 0 && text_.starts_with("\xEF\xBB\xBF") && at >= 3) line_begin = 3;
    const auto columns = std::count_if(begin + static_cast<std::ptrdiff_t>(line_begin), here,
                                       [](char byte) { return !is_continuation(byte); });
    return {static_cast<int>(std::count(begin, here, '\n')) + 1, static_cast<int>(columns) + 1};
}

std::string_view Span::view() const {
    return source ? source->cleaned().substr(at, length) : std::string_view();
}

Span Span::part(std::size_t begin, std::size_t count) const {
    begin = std::min<std::size_t>(begin, length);
    return {source, at + begin, std::min(count, length - begin)};
}

Span Span::trimmed() const {
    const std::string_view text = view(), inner = sikku::trimmed(text);
    return part(static_cast<std::size_t>(inner.data() - text.data()), inner.size());
}

std::string Diagnostic::text() const {
    if (where.line == 0) return fmt::format("{}: {}{}", file, warning ? "warning: " : "", message);
    return fmt::format("{}:{}:{}: {}{}\n{}", file, where.line, where.column, warning ? "warning: " : "", message,
                       excerpt);
}

void Diagnostics::add(const Span& where, const std::string& message, bool warning) {
    if (!warning && ++errors_ > most_errors) return;
    if (warning && list_.size() >= 2 * most_errors) return;
    if (!where.source) {
        list_.push_back({"", {}, printable(message), "", warning});
        return;
    }
    if (where.source->is_value()) {
        Diagnostic one{printable(where.source->name(), 80), {0, 0}, printable(message), "", warning};
        one.setting = where.source->setting();
        one.value = where.source->value();
        list_.push_back(std::move(one));
        return;
    }
    list_.push_back({printable(where.source->name()), where.source->place(where.at), printable(message),
                     excerpt(where.source->text(), where.at), warning});
}

void Diagnostics::add(const Diagnostic& diagnostic) {
    if (!diagnostic.warning && ++errors_ > most_errors) return;
    list_.push_back(diagnostic);
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::vector<Diagnostic> result = list_;
    std::stable_sort(result.begin(), result.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.file, a.where.line, a.where.column) < std::tie(b.file, b.where.line, b.where.column);
    });
    return result;
}

void Diagnostics::throw_if_errors() const {
    if (has_errors()) throw PatternError(sorted(), errors_);
}

PatternError::PatternError(std::vector<Diagnostic> diagnostics, std::size_t errors)
    : std::runtime_error(text_of(diagnostics, errors)), diagnostics_(std::move(diagnostics)) {}

const Diagnostic* PatternError::setting_error() const {
    const Diagnostic* first = nullptr;
    for (const Diagnostic& one : diagnostics_) {
        if (one.warning) continue;
        if (one.setting.empty()) return nullptr;
        if (!first) first = &one;
    }
    return first;
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known) {
    if (word.size() > 64) return {};
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        if (candidate.size() >= word.size() + best_distance) continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if (!is_continuation(text[i])) return 0;
    }
    const unsigned second = byte(1);
    const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
    const bool beyond = (lead == 0xED && second > 0x9F) || (lead == 0xF4 && second > 0x8F);
    return overlong || beyond ? 0 : length;
}

std::string printable(std::string_view text, std::size_t most) {
    return plain_text(text, most, ' ');
}

std::string printable_lines(std::string_view text, std::size_t most) {
    std::string result;
    const std::string plain = plain_text(text, most, '\n');
    for (std::size_t at = 0; at < plain.size(); ++at) {
        result += plain[at];
        if (plain[at] == '\n' && plain.compare(at + 1, 2, "  ") != 0) result += "  ";
    }
    return result;
}

std::string pattern_line(std::string_view text, std::size_t most) {
    std::string result;
    for (const char byte : printable(text, most)) {
        if (byte == ' ' && (result.empty() || result.back() == ' ')) continue;
        // `//` begins a comment only at the beginning of a line.
        if (byte == '*' && result.ends_with('/')) result += ' ';
        result += byte;
    }
    while (result.ends_with('\\') || result.ends_with(' ')) result.pop_back();
    return result;
}

bool read_number(std::string_view text, double& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = parse_number(text, value);
    return error == std::errc() && end == text.data() + text.size() && !text.empty() && std::isfinite(value);
}

}  // namespace sikku
