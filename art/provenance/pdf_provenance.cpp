// art/provenance/pdf_provenance.cpp: finds the texts of a PDF in the layout of write_pdf, from the end of the file.
#include "art/provenance/provenance_readers.h"
#include "engine/base/text.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string>
#include <utility>

namespace sikku {
namespace {

/// A pattern is at most 64 MB long, UTF-16 in hexadecimal digits four times as long; 64 MB are left for the title.
constexpr std::uint64_t most_dictionary_bytes = std::uint64_t{320} << 20;
/// Maximum number of entries; the writer has four.
constexpr int most_entries = 64;
constexpr std::uint64_t entry_bytes = 20;  // size of an entry in the table of objects

std::optional<std::uint64_t> number_at(std::string_view text, std::size_t at) {
    std::uint64_t number = 0;
    if (at > text.size()) return std::nullopt;
    const auto error = std::from_chars(text.data() + at, text.data() + text.size(), number).ec;
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// The number after the last `mark`.
std::optional<std::uint64_t> number_after(std::string_view text, std::string_view mark) {
    const std::size_t at = text.rfind(mark);
    return at == std::string_view::npos ? std::nullopt : number_at(text, at + mark.size());
}

/// A text string, taken byte by byte into UTF-8: it is ASCII, or UTF-16 after a byte order mark.
class TextString {
public:
    void take(unsigned char byte) {
        if (count_++ == 0 && byte == 0xFE) {
            is_utf16_ = true;
        } else if (!is_utf16_) {
            is_wrong_ |= byte >= 0x80;
            put(byte);
        } else if (count_ == 2) {
            is_wrong_ |= byte != 0xFF;
        } else if (count_ % 2 == 1) {
            first_ = byte;
        } else {
            take_unit(first_ << 8 | byte);
        }
    }
    /// The whole text, or nullopt if it is malformed.
    std::optional<std::string> finish() {
        const bool is_cut = is_utf16_ && (count_ % 2 != 0 || high_ != 0);
        return is_wrong_ || is_cut ? std::nullopt : std::optional(std::move(text_));
    }

private:
    void put(std::uint32_t code) {
        require_length(text_.size() + 1);
        if (code < 0x80) {
            text_ += static_cast<char>(code);
        } else {
            append_utf8(code, text_);
        }
    }
    void take_unit(std::uint32_t unit) {
        const bool is_second = unit >= 0xDC00 && unit < 0xE000;
        is_wrong_ |= is_second != (high_ != 0);
        if (unit >= 0xD800 && unit < 0xDC00) {
            high_ = unit;
        } else {
            if (!is_wrong_) put(is_second ? 0x10000 + ((high_ - 0xD800) << 10) + (unit - 0xDC00) : unit);
            high_ = 0;
        }
    }

    std::string text_;
    std::uint64_t count_ = 0;
    std::uint32_t first_ = 0;  // the first byte of two
    std::uint32_t high_ = 0;   // the first half of a pair, while the second is awaited
    bool is_utf16_ = false, is_wrong_ = false;
};

bool is_delimiter(char byte) {
    return byte == '(' || byte == ')' || byte == '\\';
}

/// Passes the bytes of the next string in parentheses to `take`. Returns false if it does not end.
template <typename Take>
bool read_literal(InputStream& in, Take take) {
    constexpr std::string_view names = "nrtbf";
    constexpr std::string_view meanings = "\n\r\t\b\f";
    in.skip(1);
    for (int depth = 1;;) {
        const std::string_view bytes = in.ahead();
        if (bytes.empty()) return false;
        std::size_t plain = 0;
        for (; plain < bytes.size(); ++plain) {
            char byte = bytes[plain];
            if (byte == '(' || byte == ')') break;
            if (byte == '\\') {
                // Escapes that the writer uses; others are handled below.
                if (plain + 1 == bytes.size() || !is_delimiter(bytes[plain + 1])) break;
                byte = bytes[++plain];
            }
            take(static_cast<unsigned char>(byte));
        }
        in.skip(plain);
        if (plain == bytes.size()) continue;
        const int byte = in.take();
        if (byte != '\\') {
            depth += byte == '(' ? 1 : -1;
            if (depth == 0) return true;
            take(static_cast<unsigned char>(byte));
            continue;
        }
        const int escaped = in.take();
        if (escaped < 0) return false;
        if (const std::size_t name = names.find(static_cast<char>(escaped)); name != std::string_view::npos) {
            take(static_cast<unsigned char>(meanings[name]));
        } else if (escaped >= '0' && escaped <= '7') {
            int value = escaped - '0';
            for (int i = 0; i < 2; ++i) {
                const std::string_view rest = in.ahead();
                if (rest.empty() || rest.front() < '0' || rest.front() > '7') break;
                value = value * 8 + in.take() - '0';
            }
            take(static_cast<unsigned char>(value));
        } else if (escaped != '\n') {  // the line continues
            take(static_cast<unsigned char>(escaped));
        }
    }
}

int digit_of(char byte) {
    if (byte >= '0' && byte <= '9') return byte - '0';
    if (byte >= 'A' && byte <= 'F') return byte - 'A' + 10;
    return byte >= 'a' && byte <= 'f' ? byte - 'a' + 10 : -1;
}

/// Passes the bytes of the next string in hexadecimal digits to `take`. Returns false if it does not end.
template <typename Take>
bool read_hexadecimal(InputStream& in, Take take) {
    in.skip(1);
    for (int high = -1;;) {
        const std::string_view bytes = in.ahead();
        if (bytes.empty()) return false;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const int digit = digit_of(bytes[i]);
            if (digit < 0) {
                in.skip(i + 1);
                return bytes[i] == '>' && high < 0;
            }
            if (high < 0) {
                high = digit;
            } else {
                take(static_cast<unsigned char>(std::exchange(high, -1) * 16 + digit));
            }
        }
        in.skip(bytes.size());
    }
}

/// Reads the next string in either notation. Returns false if there is none, or if it does not end.
template <typename Take>
bool read_string(InputStream& in, Take take) {
    const std::string_view next = in.ahead();
    if (next.starts_with('(')) return read_literal(in, take);
    return next.starts_with('<') && read_hexadecimal(in, take);
}

/// Reads the next text; nullopt if it is malformed.
std::optional<std::string> read_text(InputStream& in) {
    TextString text;
    const bool is_whole = read_string(in, [&text](unsigned char byte) { text.take(byte); });
    return is_whole ? text.finish() : std::nullopt;
}

/// Skips the next text. Returns false if it does not end.
bool skip_text(InputStream& in) {
    std::uint64_t count = 0;
    return read_string(in, [&count](unsigned char) { require_length(++count); });
}

/// Skips the next name. Returns false if there is none.
bool skip_name(InputStream& in) {
    if (!in.skip_text("/")) return false;
    const auto is_letter = [](char byte) { return (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z'); };
    for (std::string_view bytes = in.ahead(); !bytes.empty() && is_letter(bytes.front()); bytes = in.ahead()) {
        in.skip(1);
    }
    return true;
}

/// The texts of the object in the writer's layout: a dictionary of strings and names.
std::optional<Provenance> read_dictionary(InputStream& in) {
    constexpr std::string_view head = " 0 obj\n<< ";
    const std::size_t at = in.ahead(64).find(head);
    if (at > 20) return std::nullopt;  // or not found
    in.skip(at + head.size());
    Provenance found;
    bool is_ours = false;
    std::set<std::string> seen;
    for (int entry = 0; entry < most_entries && in.skip_text("/"); ++entry) {
        const std::string_view bytes = in.ahead(64);
        const std::string name(bytes.substr(0, std::min<std::size_t>(bytes.find(' '), 64)));
        in.skip(name.size() + 1);
        if (name == "Creator" || name == "SikkuPattern" || name == "Subject") {
            if (!seen.insert(name).second) return std::nullopt;  // a dictionary must not repeat a key
            auto text = read_text(in);
            if (!text) return std::nullopt;
            if (name == "Creator") {
                is_ours = *text == "Sikku";
            } else {
                (name == "Subject" ? found.made : found.pattern) = std::move(*text);
                limit_made(found.made);
            }
        } else if (!skip_text(in) && !skip_name(in)) {
            return std::nullopt;
        }
        in.skip_text("\n") || in.skip_text(" ");
    }
    return is_ours && in.skip_text(">>") ? std::optional(std::move(found)) : std::nullopt;
}

}  // namespace

std::optional<Provenance> read_pdf_provenance(const InputFile& file) {
    const std::uint64_t size = file.size();
    const std::string end = file.read(size - std::min<std::uint64_t>(size, 256), 256);
    const auto table = number_after(end, "startxref\n");
    const auto info = number_after(end, " /Info ");
    if (!table || !info || *table >= size || *info >= size / entry_bytes) return std::nullopt;

    const std::string head = file.read(*table, 64);
    const std::size_t entries = head.find('\n', std::string_view("xref\n").size()) + 1;
    if (!head.starts_with("xref\n0 ") || entries == 0) return std::nullopt;
    const auto begin = number_at(file.read(*table + entries + entry_bytes * *info, entry_bytes), 0);
    // The texts are the last object before the table.
    if (!begin || *begin >= *table || *table - *begin > most_dictionary_bytes) return std::nullopt;
    InputStream in(file, *begin, *table);
    return read_dictionary(in);
}

}  // namespace sikku
