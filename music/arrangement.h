// music/arrangement.h: arrangements: several patterns with keys of their own as one piece, read from TOML files.
#pragma once

#include "engine/base/toml_file.h"
#include "engine/language/document.h"
#include "music/melody/layout.h"
#include "music/score/score.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A part of an arrangement: a pattern with its keys.
struct Track {
    Document document;
    std::string pattern;  ///< its name in the arrangement
    char section = 0;     ///< `A` to `Z`; 0: it plays from the beginning of the piece
    std::string name;     ///< name of its staff and MIDI track; empty: that of the instrument
};

/// Several patterns as one piece.
struct Arrangement {
    std::string text;  ///< TOML, with every pattern in it, so that it can be read again without other files
    std::string title;
    std::string composer;
    std::string source;
    std::optional<double> tempo;  ///< quarters a minute; nullopt: that of the first track
    std::string tempo_words;      ///< printed before it; may be empty
    std::optional<Meter> meter;   ///< nullopt: that of the first track
    std::vector<FormSection> form;
    std::map<char, SectionTempo> section_tempos{};  ///< of sections that state a tempo or a meter
    std::vector<Track> tracks;
    std::vector<std::string> remarks{};  ///< for the user: keys of the piece that replace those of patterns within it
};

/// Largest number of tracks.
constexpr std::size_t most_tracks = 500;

/// A pattern that was read: its name in messages, and its text.
struct NamedPattern {
    std::string name;
    std::string text;
};
/// Reads the pattern that a track names.
using PatternReader = std::function<NamedPattern(const std::string& pattern)>;

/// Wraps a reader: names of files in `folder` come first. `read` gets their paths, or other names as they are.
PatternReader beside_first(std::filesystem::path folder, PatternReader read);

/// Reads an arrangement and compiles its patterns. Those in `[[pattern]]` tables of the file come first; `read` reads
/// the others.
/// @param file  name of the file, for places
/// @throws FileError for errors of the arrangement, one line for each, with its place; PatternError for errors in
/// patterns; exceptions of `read`
Arrangement read_arrangement(const std::string& file, const std::string& text, const PatternReader& read);

/// An arrangement that plays these documents together, as on the command line; the first sets tempo and meter.
Arrangement arrangement_of(std::span<const Document> documents);

/// Makes the setting of a part from a key of a track or the command line: `n` is the derivation length, and hyphens
/// and underscores count as blanks.
Setting part_setting(std::string_view key, std::string value);

}  // namespace sikku
