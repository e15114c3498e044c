// art/provenance/provenance_readers.h: one reader for each format that provenance.cpp recognises.
#pragma once

#include "art/provenance/provenance.h"
#include "engine/base/input_file.h"
#include "engine/language/pattern.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {

/// Reports why a file cannot be read back; `what()` continues "this PNG file …".
class UnreadableFile : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reports a file that ends too early or contradicts itself.
[[noreturn]] inline void refuse_damaged() {
    throw UnreadableFile("is damaged or truncated");
}

/// Rejects a text that exceeds the limit for patterns.
[[noreturn]] inline void refuse_length() {
    throw UnreadableFile("contains a text of more than 64 MB, the limit for patterns");
}
inline void require_length(std::uint64_t bytes) {
    if (bytes > most_pattern_bytes) refuse_length();
}
/// Appends within that limit.
inline void append_text(std::string& text, std::string_view bytes) {
    require_length(text.size() + bytes.size());
    text += bytes;
}

/// Clears a text over 2 MB, longer than any command line, so that two texts never need the memory of two patterns.
inline void limit_made(std::string& made) {
    if (made.size() > std::size_t{2} << 20) std::string().swap(made);
}

constexpr std::size_t longest_xml_reference = 12;  // bytes

/// A decoded reference such as `&amp;`, `&#13;` or `&#xD;`.
struct XmlReference {
    std::string character;
    std::size_t length = 1;  ///< length in bytes
};
/// Decodes the reference at the front of `bytes`; any other `&` stands for itself.
XmlReference read_xml_reference(std::string_view bytes);

/// The readers receive a file that begins with the signature of their format. They return nullopt (or an empty
/// pattern) if it does not contain a pattern, and throw UnreadableFile if it is damaged. Memory beyond the texts:
/// less than 2 MB.
std::optional<Provenance> read_png_provenance(const InputFile& file);
std::optional<Provenance> read_tiff_provenance(const InputFile& file);
std::optional<Provenance> read_jpeg_provenance(const InputFile& file);
std::optional<Provenance> read_exr_provenance(const InputFile& file);
std::optional<Provenance> read_svg_provenance(const InputFile& file);
std::optional<Provenance> read_pdf_provenance(const InputFile& file);
std::optional<Provenance> read_musicxml_provenance(const InputFile& file);
std::optional<Provenance> read_page_provenance(const InputFile& file);
/// LilyPond, ABC, Csound and Strudel files contain the pattern as comments, line by line: without carriage returns,
/// and with blanks for tabs.
std::optional<Provenance> read_lilypond_provenance(const InputFile& file);
std::optional<Provenance> read_csound_provenance(const InputFile& file);
std::optional<Provenance> read_strudel_provenance(const InputFile& file);

}  // namespace sikku
