// art/provenance/score_provenance.cpp: finds the texts in MusicXML and LilyPond files and in pages that play.
#include "art/provenance/provenance_readers.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

namespace sikku {
namespace {

/// A pattern is at most 64 MB, escaped at most six times as long; the program writes it near the beginning.
constexpr std::uint64_t most_score_bytes = std::uint64_t{448} << 20;
constexpr std::uint64_t most_lilypond_bytes = most_pattern_bytes + (std::uint64_t{4} << 20);

/// Reads escaped text up to `end`, which it skips. @throws UnreadableFile if it is missing
std::string read_escaped(InputStream& in, char end) {
    const std::string stops = {end, '&'};
    std::string text;
    for (;;) {
        const std::string_view bytes = in.ahead(longest_xml_reference);
        if (bytes.empty()) refuse_damaged();
        const std::size_t plain = std::min(bytes.find_first_of(stops), bytes.size());
        append_text(text, bytes.substr(0, plain));
        if (plain < bytes.size() && bytes[plain] == end) {
            in.skip(plain + 1);
            return text;
        }
        std::size_t read = plain;
        // A reference that the block may cut is read with the next one.
        if (plain == 0) {
            const XmlReference reference = read_xml_reference(bytes);
            append_text(text, reference.character);
            read = reference.length;
        }
        in.skip(read);
    }
}

/// The texts after two marks, which come in this order.
std::optional<Provenance> read_marked(const InputFile& file, std::string_view made_mark, char made_end,
                                      std::string_view pattern_mark) {
    InputStream in(file, 0, most_score_bytes);
    Provenance found;
    if (!in.skip_past(made_mark)) return std::nullopt;
    found.made = read_escaped(in, made_end);
    limit_made(found.made);
    if (!in.skip_past(pattern_mark)) return std::nullopt;
    found.pattern = read_escaped(in, '<');
    return found;
}

/// The texts as comments after the first empty line: the recipe on one line, then the pattern.
std::optional<Provenance> read_comments(const InputFile& file, std::string_view sign) {
    InputStream in(file, 0, most_lilypond_bytes);
    if (!in.skip_past("\n\n")) return std::nullopt;
    Provenance found;
    bool is_first = true;
    while (in.skip_text(sign)) {
        in.skip_text(" ");
        std::string& text = std::exchange(is_first, false) ? found.made : found.pattern;
        for (bool is_whole = false; !is_whole;) {
            const std::string_view bytes = in.ahead();
            if (bytes.empty()) refuse_damaged();
            const std::size_t end = std::min(bytes.find('\n'), bytes.size());
            append_text(text, bytes.substr(0, end));
            is_whole = end < bytes.size();
            in.skip(end + 1);
        }
        if (&text == &found.pattern) append_text(text, "\n");
    }
    limit_made(found.made);
    if (!found.made.starts_with("sikku ")) return std::nullopt;
    return found;
}

}  // namespace

XmlReference read_xml_reference(std::string_view bytes) {
    const char first = bytes.size() > 1 ? bytes[1] : ' ';
    if (first == '#') {
        const std::size_t end = std::min(bytes.substr(0, longest_xml_reference).find(';'), bytes.size());
        const bool is_hexadecimal = bytes.starts_with("&#x");
        const char* const begin = bytes.data() + (is_hexadecimal ? 3 : 2);
        const char* const stop = bytes.data() + end;
        std::uint32_t code = 0;
        const bool is_number = begin < stop && end < bytes.size() &&
                               std::from_chars(begin, stop, code, is_hexadecimal ? 16 : 10).ptr == stop;
        if (is_number && code != 0 && code < 0x110000 && (code < 0xD800 || code > 0xDFFF)) {
            XmlReference reference{.character = {}, .length = end + 1};
            append_utf8(code, reference.character);
            return reference;
        }
    } else if (first == 'q' || first == 'l' || first == 'g' || first == 'a') {
        constexpr std::array<std::pair<std::string_view, std::string_view>, 5> known = {
            {{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}, {"&apos;", "'"}}};
        for (const auto& [written, meant] : known) {
            if (bytes.starts_with(written)) return {std::string(meant), written.size()};
        }
    }
    return {"&", 1};
}

std::optional<Provenance> read_musicxml_provenance(const InputFile& file) {
    return read_marked(file, "<miscellaneous-field name=\"made\">", '<', "<miscellaneous-field name=\"pattern\">");
}

std::optional<Provenance> read_page_provenance(const InputFile& file) {
    auto found = read_marked(file, "<meta name=\"generator\" content=\"", '"', "<pre tabindex=\"0\">");
    if (found && !found->made.starts_with("sikku ")) return std::nullopt;
    // HTML drops a leading line feed; the writer doubles it.
    if (found && found->pattern.starts_with('\n')) found->pattern.erase(0, 1);
    return found;
}

std::optional<Provenance> read_lilypond_provenance(const InputFile& file) {
    return read_comments(file, "%");
}

std::optional<Provenance> read_csound_provenance(const InputFile& file) {
    return read_comments(file, ";");
}

std::optional<Provenance> read_strudel_provenance(const InputFile& file) {
    return read_comments(file, "//");
}

}  // namespace sikku
