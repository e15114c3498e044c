// art/image/picture_process.cpp: read_picture(), which decodes pictures in a separate process.
#include "art/image/decoder_answer.h"
#include "art/image/image_file.h"
#include "art/module/module.h"
#include "engine/base/child_process.h"
#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sikku {
namespace {

using Clock = std::chrono::steady_clock;

/// On a busy machine a process may wait longer than it computes.
constexpr std::chrono::seconds longest_wait{10 * most_decoder_seconds};

/// A running decoder of one file. The process is ended with this object.
class Decoder {
public:
    Decoder(const std::filesystem::path& program, const InputFile& file, int longest_side,
            std::uint64_t most_pixels) {
        const Descriptor input = lifted_copy(file.descriptor());
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
        Descriptor low_answers(ends[0]);
        const Descriptor output = lifted(Descriptor(ends[1]));
        answers_ = lifted(std::move(low_answers));
        ProcessStart start{
            .program = program,
            .arguments = {std::to_string(decoder_version(SIKKU_VERSION)), std::to_string(::getpid()),
                          std::to_string(longest_side), std::to_string(most_pixels)},
            .descriptors = {input.get(), output.get(), -1, -1},  // libraries print
            .environment = {"MALLOC_ARENA_MAX=1"},
            .is_bare = true,
            .is_apart = true,
        };
        // Search paths of libraries, and settings of sanitizers.
        for (const char* name : {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS"}) {
            if (const char* value = std::getenv(name)) start.environment.push_back(std::string(name) + "=" + value);
        }
        process_.emplace(std::move(start));
    }

    /// Reads up to `size` bytes; fewer at the end of the answer. @throws Stopped; std::runtime_error after too long
    std::size_t read(char* bytes, std::size_t size, const Monitor& monitor) {
        std::size_t done = 0;
        while (done < size) {
            monitor.check();
            if (Clock::now() > deadline_) throw std::runtime_error("decoding the picture took too long");
            pollfd waiting = {answers_.get(), POLLIN, 0};
            constexpr int milliseconds = 50;
            if (::poll(&waiting, 1, milliseconds) <= 0) continue;
            const ssize_t got = ::read(answers_.get(), bytes + done, size - done);
            if (got == 0) break;
            if (got > 0) done += static_cast<std::size_t>(got);
            if (got < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "read");
        }
        return done;
    }
    /// The state of the process, as of waitpid(), after its last answer; nullopt if unknown.
    std::optional<int> end() {
        const auto patience = Clock::now() + std::chrono::seconds(2);
        while (Clock::now() < patience) {
            if (const auto state = process_->ended()) return state;
            ::poll(nullptr, 0, 5);
        }
        return std::nullopt;
    }

private:
    std::optional<Process> process_;
    Descriptor answers_;
    Clock::time_point deadline_ = Clock::now() + longest_wait;
};

[[noreturn]] void refuse_start(const std::filesystem::path& program, const char* reason) {
    throw std::runtime_error(
        fmt::format("the program that decodes pictures, {}, does not start: {}", program.string(), reason));
}

/// Why a decoder ended before it was ready. @param state  as from waitpid()
const char* reason_not_to_start(std::optional<int> state, bool is_heif) {
    constexpr int library_is_missing = 127;  // of the dynamic loader, also if a memory limit prevents loading
    rlimit space{};
    const bool is_limited = ::getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur != RLIM_INFINITY;
    if (state && WIFEXITED(*state) && WEXITSTATUS(*state) == library_is_missing && !is_limited) {
        return is_heif ? "libheif is not installed (on Debian, install libheif1)"
                       : "OpenImageIO is not installed (on Debian 12, install libopenimageio2.4)";
    }
    return "raise `ulimit -v`, `-n` or `-u`";
}

std::filesystem::path find_decoder(bool is_heif) {
    const char* const name = is_heif ? heif_decoder_name : decoder_name;
    std::string places;
    for (const std::filesystem::path& folder : module_folders()) {
        std::error_code error;
        std::filesystem::path program = folder / name;
        if (std::filesystem::is_regular_file(program, error)) return program;
        places += "\n  " + program.string();
    }
    throw std::runtime_error(
        fmt::format("the program that decodes {} was not found:{}", is_heif ? "HEIF" : "pictures", places));
}

/// Explains an answer that ended too early.
[[noreturn]] void refuse_end(std::optional<int> state) {
    if (state && WIFSIGNALED(*state) && WTERMSIG(*state) == SIGXCPU) {
        throw std::runtime_error(
            fmt::format("the picture takes more than {} s of processor time", most_decoder_seconds));
    }
    throw std::runtime_error("the picture is damaged: " +
                             (state && WIFSIGNALED(*state)
                                  ? fmt::format("its decoder crashed (signal {})", WTERMSIG(*state))
                                  : "its decoder ended too early"));
}

DecodedPicture read_pixels(Decoder& decoder, int longest_side, std::uint64_t most_pixels, const Monitor& monitor) {
    std::array<unsigned char, 16> head{};
    if (decoder.read(reinterpret_cast<char*>(head.data()), head.size(), monitor) != head.size()) {
        refuse_end(decoder.end());
    }
    const auto number = [&](std::size_t at) {
        return std::uint64_t{head[at]} | std::uint64_t{head[at + 1]} << 8U | std::uint64_t{head[at + 2]} << 16U |
               std::uint64_t{head[at + 3]} << 24U;
    };
    const std::uint64_t width = number(0);
    const std::uint64_t height = number(4);
    const std::uint64_t file_width = number(8);
    const std::uint64_t file_height = number(12);
    const auto most_side = static_cast<std::uint64_t>(longest_side);
    if (width == 0 || height == 0 || width > most_side || height > most_side || width > file_width ||
        height > file_height || file_width > most_pixels || file_height > most_pixels / file_width) {
        throw std::runtime_error("the picture is damaged: its decoder gave it a wrong size");
    }
    DecodedPicture picture;
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    picture.file_width = static_cast<int>(file_width);
    picture.file_height = static_cast<int>(file_height);
    picture.pixels.resize(3 * width * height);
    if (decoder.read(reinterpret_cast<char*>(picture.pixels.data()), picture.pixels.size(), monitor) !=
        picture.pixels.size()) {
        refuse_end(decoder.end());
    }
    return picture;
}

}  // namespace

DecodedPicture read_picture(const std::filesystem::path& path, int longest_side, std::uint64_t most_pixels,
                            const Monitor& monitor) {
    if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("not a regular file");
    const InputFile file(path);
    const bool is_heif = file.read(4, 4) == "ftyp";
    const std::filesystem::path program = find_decoder(is_heif);
    Decoder decoder(program, file, longest_side, most_pixels);
    const auto next = [&]() -> std::optional<DecoderAnswer> {
        char byte = 0;
        if (decoder.read(&byte, 1, monitor) == 0) return std::nullopt;
        return static_cast<DecoderAnswer>(byte);
    };
    const auto first = next();
    if (first == DecoderAnswer::version) refuse_start(program, "it was made for another version of sikku");
    if (first != DecoderAnswer::ready) refuse_start(program, reason_not_to_start(decoder.end(), is_heif));
    const auto second = next();
    if (second == DecoderAnswer::picture) return read_pixels(decoder, longest_side, most_pixels, monitor);
    if (second == DecoderAnswer::memory) {
        throw std::runtime_error(
            fmt::format("the picture needs more than {} MB of memory", most_decoder_memory / 1'000'000));
    }
    if (second != DecoderAnswer::refusal) refuse_end(decoder.end());
    std::string message(longest_refusal, '\0');
    message.resize(decoder.read(message.data(), message.size(), monitor));
    throw std::runtime_error(printable(message, longest_refusal));
}

}  // namespace sikku
