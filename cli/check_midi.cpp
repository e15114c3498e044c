// cli/check_midi.cpp: `sikku check FILE.mid`: what is wrong with MIDI files.
#include "cli/command.h"
#include "music/midi_check.h"

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

std::vector<std::uint8_t> read_bytes(const std::string& file) {
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
    std::vector<std::uint8_t> bytes;
    std::error_code unknown;
    const auto size = std::filesystem::file_size(file, unknown);
    if (!unknown) bytes.reserve(size);
    std::vector<std::uint8_t> block(std::size_t{1} << 16);
    for (;;) {
        const std::size_t got = std::fread(block.data(), 1, block.size(), stream.get());
        const int error = errno;
        bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(got));
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

MidiFile read_midi_file(const std::string& file) {
    return read_midi(read_bytes(file));
}

bool check_midi_file(const std::string& file) {
    const auto faults = check_midi(read_bytes(file));
    for (const MidiFault& fault : faults) fmt::print("{}: byte {}: {}\n", printable(file), fault.at, fault.what);
    if (faults.size() == most_midi_faults) {
        fmt::print("{}: no more than {} faults are told\n", printable(file), most_midi_faults);
    }
    return faults.empty();
}

}  // namespace sikku
