// cli/check_midi.cpp: validates MIDI files and reads the patterns in them.
#include "cli/command.h"
#include "engine/base/input_file.h"
#include "engine/language/pattern.h"
#include "music/score/midi_check.h"
#include "music/score/midi_texts.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_midi_bytes = std::size_t{128} << 20;
/// The texts come first; the data around them are small.
constexpr std::size_t texts_bytes = most_pattern_bytes + (std::size_t{2} << 20);

std::span<const std::uint8_t> span_of(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// @throws UsageError if there are more than can be checked
std::string read_bytes(const std::string& file) {
    try {
        std::string bytes = read_file(file, file, most_midi_bytes, stop_monitor());
        if (bytes.size() <= most_midi_bytes) return bytes;
    } catch (const std::runtime_error& error) {
        throw UsageError(error.what());
    }
    throw UsageError(fmt::format("{}: MIDI files of more than 128 MB cannot be checked", file));
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
        fmt::print("{}: only the first {} errors are listed\n", printable(file), most_midi_faults);
    }
    return faults.empty();
}

}  // namespace sikku
