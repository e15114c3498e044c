// art/provenance/provenance.h: reads the pattern and the recipe of a print back from its file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

struct Provenance {
    std::string pattern;  ///< the text of the pattern, byte for byte
    /// Program, version and options that made the print; empty if over 2 MB. Untrusted, like the pattern.
    std::string made;
};

/// A file format that is not a pattern.
struct KnownFormat {
    std::string_view name;     ///< with its article: `an SVG file`
    bool has_pattern = false;  ///< the program writes the pattern into such files
};
/// Recognises a format by the beginning of the file; nullopt if it is none of those below or the file cannot be
/// opened.
std::optional<KnownFormat> known_format(const std::filesystem::path& file);

/// Reads the pattern that the program put into a file: PNG, TIFF, JPEG, EXR, SVG, PDF, GIF, HP-GL, G-code, DXF, OBJ,
/// glTF, MusicXML, LilyPond, HTML. Sound (WAV, FLAC) does not contain it. Recognises the format by the first bytes,
/// not by the name; never decodes pixels. Returns nullopt if the format is unknown or the file is not a regular file
/// that can be opened.
///
/// Safe for untrusted files: reading any file takes at most about a second and 200 MB.
/// @throws std::runtime_error, naming the file, if it has one of the formats but contains no pattern, is damaged, or
/// contains a text of more than 64 MB
std::optional<Provenance> read_provenance(const std::filesystem::path& file);

}  // namespace sikku
