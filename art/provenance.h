// art/provenance.h: what a print was made from, read back from its file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sikku {

struct Provenance {
    std::string pattern;  ///< the text of the pattern, byte for byte
    /// Program, version and options that made the print; empty if they have more than 2 MB. Untrusted, like the pattern.
    std::string made;
};

/// Reads the pattern that the writers of this folder put into a file: PNG, TIFF, JPEG, EXR, SVG, PDF. Recognises the
/// format by the first bytes, not by the name; never decodes pixels. Nullopt if the bytes belong to none of the
/// formats or if there is no such regular file that can be opened.
///
/// Safe for files from strangers: whatever they hold, reading takes at most about a second and 200 MB.
/// @throws std::runtime_error, which names the file, if it has one of the formats but contains no pattern, is
/// damaged, or contains a text of more than 64 MB
std::optional<Provenance> read_provenance(const std::filesystem::path& file);

}  // namespace sikku
