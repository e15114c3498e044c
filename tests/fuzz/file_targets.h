// tests/fuzz/file_targets.h: checks of the fuzzers for untrusted files; tests/program/corpus_test.cpp runs them on
// the corpus.
#pragma once

#include "art/provenance/provenance.h"
#include "engine/base/text.h"
#include "engine/language/pattern.h"
#include "music/score/midi_check.h"
#include "music/score/midi_texts.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {

/// A regular file in memory that has a path.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view bytes) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
        if (descriptor_ < 0 ||
            ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
            std::abort();
        }
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

inline void must(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

/// Text for a terminal, or a string of JSON, is free of control characters.
inline void must_be_plain(std::string_view text, const char* what) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const bool is_c1 = byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0 &&
                           static_cast<unsigned char>(text[i + 1]) >= 0x80;
        must((byte >= 0x20 || byte == '\n') && byte != 0x7F && !is_c1,
             std::string(what) + " has a control character");
    }
}

/// `sikku show` of a file with these bytes: its pattern, or nothing if it is refused.
inline std::optional<std::string> try_show(std::string_view bytes) {
    const MemoryFile file(bytes);
    try {
        if (const auto found = read_provenance(file.path())) {
            must(!found->pattern.empty(), "a pattern that is empty");
            must(found->pattern.size() <= most_pattern_bytes && found->made.size() <= most_pattern_bytes,
                 "a text over its limit");
            must_be_plain(printable(found->made, std::size_t{1} << 20), "what made it");
            must_be_plain(json_string(found->made), "its JSON");
            return found->pattern;
        }
        if (bytes.starts_with("MThd")) {
            return read_midi_texts({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}).pattern;
        }
    } catch (const std::runtime_error& error) {
        const std::string_view what = error.what();
        must(!what.empty() && what.find('\n') == std::string_view::npos, "an error is one line");
        must_be_plain(printable(what), "an error");
        return std::nullopt;
    }
    Diagnostics diagnostics;
    const auto source = read_source("fuzz", std::string(bytes), diagnostics);
    return diagnostics.is_unreadable() ? std::nullopt : std::optional(source->text());
}

/// `sikku check` of a MIDI file.
inline void try_midi(std::string_view bytes) {
    const std::span<const std::uint8_t> span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    const auto faults = check_midi(span);
    must(faults.size() <= most_midi_faults, "too many faults");
    for (const MidiFault& fault : faults) {
        must(fault.at <= bytes.size(), "a fault beyond the end of the file");
        must_be_plain(fault.what, "a fault");
    }
    try {
        const MidiTexts texts = read_midi_texts(span);
        must(texts.pattern.size() + texts.made.size() <= bytes.size(), "texts longer than their file");
    } catch (const std::runtime_error&) {
    }
}

}  // namespace sikku
