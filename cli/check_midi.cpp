// cli/check_midi.cpp: validates MIDI files and reads back what they were made from.
#include "cli/command.h"
#include "engine/base/input_file.h"
#include "engine/language/pattern.h"
#include "music/score/midi_check.h"
#include "music/score/midi_texts.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_midi_bytes = std::size_t{128} << 20;
/// The texts come first; what surrounds them is small.
constexpr std::size_t texts_bytes = most_pattern_bytes + (std::size_t{2} << 20);

std::span<const std::uint8_t> span_of(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// @throws UsageError if there are more than can be checked
std::string read_bytes(const std::string& file) {
    if (std::error_code error; std::filesystem::is_directory(file, error)) {
        throw UsageError(fmt::format("{} is a folder", file));
    }
    std::FILE* opened = nullptr;
    // Opening a named pipe waits for its writer.
    while (!(opened = std::fopen(file.c_str(), "rb"))) {
        if (interrupted()) throw Interrupted();
        if (errno != EINTR) throw UsageError(fmt::format("{}: {}", file, std::strerror(errno)));
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(opened, &std::fclose);
    std::string bytes;
    std::vector<char> block(std::size_t{1} << 16);
    for (;;) {
        const std::size_t got = std::fread(block.data(), 1, block.size(), stream.get());
        const int error = errno;
        bytes.append(block.data(), got);
        if (bytes.size() > most_midi_bytes) {
            throw UsageError(fmt::format("{}: MIDI files of more than 128 MB cannot be checked", file));
        }
        if (interrupted()) throw Interrupted();
        if (std::ferror(stream.get()) != 0) {
            if (error != EINTR) throw UsageError(fmt::format("{}: {}", file, std::strerror(error)));
            std::clearerr(stream.get());
        } else if (got == 0) {
            return bytes;
        }
    }
}

}  // namespace

Provenance read_score_provenance(const std::string& file) {
    const std::string bytes = InputFile(file).read(0, texts_bytes);
    try {
        MidiTexts texts = read_midi_texts(span_of(bytes));
        if (!texts.pattern.empty()) return {std::move(texts.pattern), std::move(texts.made)};
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: this MIDI file {}", file, error.what()));
    }
    throw std::runtime_error(file + ": this MIDI file contains no pattern");
}

bool check_midi_file(const std::string& file) {
    const std::string bytes = read_bytes(file);
    const auto faults = check_midi(span_of(bytes));
    for (const MidiFault& fault : faults) fmt::print("{}: byte {}: {}\n", printable(file), fault.at, fault.what);
    if (faults.size() == most_midi_faults) {
        fmt::print("{}: no more than {} faults are told\n", printable(file), most_midi_faults);
    }
    return faults.empty();
}

}  // namespace sikku
