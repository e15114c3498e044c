// art/provenance/svg_provenance.cpp: scans the texts in the head of an SVG without building a document.
#include "art/provenance/provenance_readers.h"
#include "art/vector/svg.h"
#include "engine/language/pattern.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sikku {
namespace {

/// Bytes at the beginning in which the writer declares its namespace.
constexpr std::size_t name_space_bytes = 4096;
/// A pattern is at most 64 MB, escaped up to six times as long, or twice that in hexadecimal digits.
constexpr std::uint64_t most_svg_bytes = std::uint64_t{640} << 20;
/// Maximum number of tags, comments and characters within tags; the writer's head has 500.
constexpr int most_steps = 1'000'000;

/// Finds the texts of the relevant elements in a stream.
class Scan {
public:
    explicit Scan(const InputFile& file) : in_(file, 0, most_svg_bytes) {}

    /// Reads to the end of `desc` and `metadata`; false if they are missing.
    bool run() {
        while (!has_description_ || !has_metadata_) {
            const std::string_view bytes = in_.ahead();
            if (bytes.empty() || !(bytes.front() == '<' ? read_markup() : read_text())) return false;
        }
        return true;
    }

    /// The texts found so far.
    std::optional<Provenance> provenance() {
        if (!has_made_) return std::nullopt;
        // The writer repeats text that XML cannot represent in hexadecimal digits.
        if (!has_exact_) {
            if (description_.is_too_long) refuse_length();
            return Provenance{std::move(description_.text), std::move(made_.text)};
        }
        if (exact_.is_too_long || exact_.is_wrong || exact_.high >= 0) refuse_damaged();
        return Provenance{std::move(exact_.text), std::move(made_.text)};
    }

private:
    /// The text of an element.
    struct Text {
        std::string text;
        bool is_hexadecimal = false;
        int high = -1;  ///< the first of two hexadecimal digits
        bool is_too_long = false, is_wrong = false;

        void add(std::string_view bytes) {
            if (is_too_long) return;
            if (text.size() + bytes.size() / (is_hexadecimal ? 2 : 1) > most_pattern_bytes) {
                is_too_long = true;
                std::string().swap(text);
            } else if (!is_hexadecimal) {
                text += bytes;
            } else {
                for (const char byte : bytes) add_digit(byte);
            }
        }
        void add_digit(char byte) {
            const int digit = byte >= '0' && byte <= '9'   ? byte - '0'
                              : byte >= 'a' && byte <= 'f' ? byte - 'a' + 10
                                                           : -1;
            if (digit < 0) {
                is_wrong = true;
            } else if (high < 0) {
                high = digit;
            } else {
                text += static_cast<char>(std::exchange(high, -1) * 16 + digit);
            }
        }
    };

    /// The text that is collected here, or null.
    Text* target() {
        Text* text = nullptr;
        if (depth_ == 2 && names_[1] == "desc" && !has_description_) text = &description_;
        if (depth_ == 3 && names_[1] == "metadata" && !has_metadata_) {
            if (names_[2] == "sikku:made" && !has_made_) text = &made_;
            if (names_[2] == "sikku:pattern" && !has_exact_) text = &exact_;
        }
        return text;
    }
    /// target(), or null if it is too long already.
    Text* open_target() {
        Text* const text = target();
        return text && !text->is_too_long ? text : nullptr;
    }

    bool may_step() { return ++steps_ <= most_steps; }

    /// Reads a tag, comment or other markup.
    bool read_markup() {
        if (!may_step()) return false;
        if (in_.skip_text("<!--")) return in_.skip_past("-->");
        if (in_.skip_text("<![CDATA[")) return read_verbatim();
        if (in_.skip_text("<?")) return in_.skip_past("?>");
        if (in_.skip_text("</")) {
            if (!in_.skip_past(">") || depth_ == 0) return false;
            close();
            return true;
        }
        in_.skip(1);
        return read_tag();
    }

    void close() {
        const Text* const text = target();
        if (text == &made_) {
            has_made_ = true;
            limit_made(made_.text);
        }
        if (text == &exact_) has_exact_ = true;
        if (depth_ == 2 && names_[1] == "desc") has_description_ = true;
        if (depth_ == 2 && names_[1] == "metadata") has_metadata_ = true;
        --depth_;
    }

    /// Reads a start tag after its `<`.
    bool read_tag() {
        const std::string_view bytes = in_.ahead(name_bytes);
        const std::string_view name = bytes.substr(0, std::min(bytes.find_first_of(" \t\r\n/>"), name_bytes));
        if (depth_ < names_.size()) names_[depth_] = name;
        ++depth_;
        if (target() == &exact_) std::string().swap(description_.text);  // not needed any more
        in_.skip(name.size());
        for (int last = 0, byte = in_.take(); byte >= 0 && may_step(); last = std::exchange(byte, in_.take())) {
            if (byte == '"' || byte == '\'') {
                if (!in_.skip_past(byte == '"' ? "\"" : "'")) return false;
            } else if (byte == '>') {
                if (last == '/') close();
                return true;
            }
        }
        return false;
    }

    /// Reads text up to the next markup, or about to the end of the data in memory.
    bool read_text() {
        const std::string_view bytes = in_.ahead(reference_bytes);
        Text* const text = open_target();
        if (!text) {
            in_.skip(std::min(bytes.find('<'), bytes.size()));
            return true;
        }
        // Bytes that the end of the block may cut are left for the next one.
        const std::size_t end = bytes.size() < reference_bytes ? bytes.size() : bytes.size() - reference_bytes + 1;
        std::size_t at = 0;
        while (at < end && bytes[at] != '<') {
            const std::string_view rest = bytes.substr(at);
            if (rest.front() == '&') {
                at += read_reference(rest, *text);
            } else if (rest.front() == '\r') {  // a line end of another system
                text->add("\n");
                at += rest.starts_with("\r\n") ? 2 : 1;
            } else {
                const std::string_view plain = rest.substr(0, rest.find_first_of("<&\r"));
                text->add(plain);
                at += plain.size();
            }
        }
        in_.skip(at);
        return true;
    }

    /// Decodes a reference, or another `&`, which stands for itself. Returns its length in bytes.
    static std::size_t read_reference(std::string_view bytes, Text& text) {
        const XmlReference reference = read_xml_reference(bytes);
        text.add(reference.character);
        return reference.length;
    }

    /// Reads a CDATA section after its head.
    bool read_verbatim() {
        while (!in_.skip_text("]]>")) {
            Text* const text = open_target();
            if (!text) return in_.skip_past("]]>");
            const std::string_view bytes = in_.ahead(3);
            if (bytes.size() < 3) return false;
            const std::size_t plain = std::max<std::size_t>(std::min(bytes.find(']'), bytes.size()), 1);
            text->add(bytes.substr(0, plain));
            in_.skip(plain);
        }
        return true;
    }

    static constexpr std::size_t name_bytes = 32;
    static constexpr std::size_t reference_bytes = longest_xml_reference;

    InputStream in_;
    int steps_ = 0;
    std::size_t depth_ = 0;
    std::array<std::string, 3> names_;  // names of the open elements
    Text description_, made_, exact_{.text = {}, .is_hexadecimal = true};
    bool has_description_ = false, has_metadata_ = false, has_made_ = false, has_exact_ = false;
};

}  // namespace

std::optional<Provenance> read_svg_provenance(const InputFile& file) {
    if (file.read(0, name_space_bytes).find(svg_name_space) == std::string::npos) return std::nullopt;
    Scan scan(file);
    if (!scan.run()) refuse_damaged();
    return scan.provenance();
}

}  // namespace sikku
