// cli/check_midi.cpp: validates MIDI files.
#include "cli/command.h"
#include "engine/base/input_file.h"
#include "music/score/midi_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_midi_bytes = std::size_t{128} << 20;

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

bool check_midi_file(const std::string& file) {
    const std::string bytes = read_bytes(file);
    const auto faults = check_midi(span_of(bytes));
    for (const MidiFault& fault : faults) {
        fmt::print("{}: byte {}: {}{}\n", printable(file), fault.at, fault.is_remark ? "warning: " : "", fault.what);
    }
    if (faults.size() == most_midi_faults) {
        fmt::print("{}: only the first {} errors and warnings are listed\n", printable(file), most_midi_faults);
    }
    return std::all_of(faults.begin(), faults.end(), [](const MidiFault& fault) { return fault.is_remark; });
}

}  // namespace sikku
