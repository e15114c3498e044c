#include "engine/language/word_scanner.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"
#include "engine/language/foreign_line.h"
#include "engine/language/surface.h"

#include <fmt/format.h>

namespace sikku {
namespace {

constexpr std::size_t longest_allowed_name = 64;
constexpr std::size_t most_arguments = std::size_t{1} << 16;  // of any module

std::size_t code_point_length(char lead) {
    const auto byte = static_cast<unsigned char>(lead);
    return byte < 0x80 ? 1 : byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
}

}  // namespace

SymbolNames::SymbolNames(const Pattern& pattern, Diagnostics& diagnostics) {
    const Key* key = pattern.find("symbols");
    if (key && !read(key->value, diagnostics)) names_.clear();
    for (const std::string& name : surface_names(pattern)) has_surfaces_ = names_.insert("~" + name).second;
    for (const std::string& name : names_) longest_ = std::max(longest_, name.size());
}

bool SymbolNames::read(const Span& list, Diagnostics& diagnostics) {
    std::string_view text = list.view();
    for (std::string_view name = take_word(text); !name.empty(); name = take_word(text)) {
        const Span where = list.part(list.length - text.size() - name.size());
        const bool good = is_letter(name.front()) && std::all_of(name.begin(), name.end(), is_letter_or_digit);
        if (!good) {
            const std::size_t comma = name.find(',');
            return diagnostics.refuse(where.part(comma == std::string_view::npos ? 0 : comma),
                                      comma == std::string_view::npos
                                          ? "expected a name of letters and digits that begins with a letter"
                                          : "names are separated by blanks, not by commas");
        }
        if (name.size() > longest_allowed_name) return diagnostics.refuse(where, "a name has at most 64 characters");
        if (names_.size() >= most_symbols) {
            return diagnostics.refuse(where, "there are more than 524,288 different symbols");
        }
        if (!names_.insert(std::string(name)).second) {
            diagnostics.error(where, fmt::format("'{}' is listed twice", name));
        }
    }
    return true;
}

bool WordScanner::skip_blanks() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_blank(text_[at_]))) ++at_;
    return at_ > begin;
}

std::string_view WordScanner::wrong(const std::string& message) {
    if (diagnostics_) diagnostics_->error(span_.part(at_), message);
    return {};
}

std::string_view WordScanner::letter(bool blank_before) {
    const auto taken = [&](std::size_t length) {
        const std::string_view found = text_.substr(at_, length);
        at_ += length;
        return found;
    };
    const char byte = text_[at_];
    is_name_ = false;
    if (const std::size_t length = names_.length_at(text_.substr(at_))) {
        is_name_ = length > 1;
        return taken(length);
    }
    if (byte == '@') {
        const std::size_t next = at_ + 1;
        if (next >= text_.size() || is_blank(text_[next]) || text_[next] == '(') {
            return wrong("'@' is not a symbol by itself; expected a character after it");
        }
        return taken(1 + code_point_length(text_[next]));
    }
    if (byte == '~' && names_.has_surfaces()) {
        return wrong("expected the name of a surface after '~': 'patch NAME:' and 'surface:' define them");
    }
    if (byte == '(') {
        return wrong(blank_before ? "unexpected blank between a symbol and its parameters"
                                  : "'(' without a symbol before it");
    }
    if (byte == ')') return wrong("')' without '('");
    if (byte == '<' || byte == '>') {
        return wrong(fmt::format(
            "'{}' is not a symbol; branches stand in [ ], and a step takes its length as a parameter: F(1.36*x)",
            byte));
    }
    if (byte == ':') return wrong("':' is not a symbol");
    if (byte == '*') return wrong("'*' is the empty word and must stand alone");
    if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F) {
        return wrong(fmt::format("a control character (0x{:02x}) is not a symbol", static_cast<unsigned char>(byte)));
    }
    const std::size_t length = code_point_length(byte);
    const std::string_view point = text_.substr(at_, length);
    if (const char* ascii = ascii_of(point)) {
        if (*ascii == 0) return wrong(fmt::format("U+{:04X} is not a symbol: leave it out", code_point(point)));
        if (*ascii == ' ') return wrong("this is not an ASCII blank: write a plain blank");
        return wrong(fmt::format("'{}' is not a symbol: write '{}'", point, ascii));
    }
    // C1 controls are control characters too.
    if (length == 2 && byte == '\xC2' && static_cast<unsigned char>(point[1]) < 0xA0) {
        return wrong("a control character is not a symbol");
    }
    return taken(length);
}

bool WordScanner::parameters(std::vector<Span>& parts) {
    const auto wrong = [&](const Span& where, const std::string& message) {
        if (diagnostics_) diagnostics_->error(where, message);
        return false;
    };
    const std::size_t open = at_;
    std::size_t depth = 0;
    std::size_t begin = at_ + 1;
    for (; at_ < text_.size(); ++at_) {
        if (text_[at_] == '(') ++depth;
        const bool last = text_[at_] == ')' && --depth == 0;
        if (!last && !(text_[at_] == ',' && depth == 1)) continue;
        const Span part = span_.part(begin, at_ - begin).trimmed();
        if (part.empty()) return wrong(span_.part(begin), "expected a parameter");
        if (parts.size() >= most_arguments) return wrong(part, "a module has at most 65,536 parameters");
        parts.push_back(part);
        begin = at_ + 1;
        if (last) {
            ++at_;
            return true;
        }
    }
    return wrong(span_.part(open), "this '(' is not closed");
}

}  // namespace sikku
