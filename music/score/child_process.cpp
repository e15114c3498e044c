#include "music/score/child_process.h"

#include "engine/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace sikku::child {

namespace fs = std::filesystem;

void fail(const fs::path& file, std::string_view doing, int error) {
    throw std::runtime_error(
        fmt::format("cannot {} '{}': {}", doing, file.string(), std::generic_category().message(error)));
}

void fail_without(std::string_view what, std::string_view program, [[maybe_unused]] std::string_view advice) {
#ifdef __EMSCRIPTEN__
    throw std::runtime_error(
        fmt::format("{} cannot be made here; use `sikku play`, which needs the program {}", what, program));
#else
    throw std::runtime_error(
        fmt::format("{} needs the program {}, which is not in PATH; install it{}", what, program, advice));
#endif
}

void write_all(int descriptor, const char* bytes, std::size_t count, const fs::path& name) {
    while (count > 0) {
        const ssize_t written = ::write(descriptor, bytes, count);
        if (written < 0) {
            if (errno == EINTR) continue;
            fail(name, "write", errno);
        }
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
}

std::size_t read_at(int descriptor, char* bytes, std::size_t count, std::uint64_t position, const fs::path& name) {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = ::pread(descriptor, bytes + done, count - done, static_cast<off_t>(position + done));
        if (got < 0) {
            if (errno == EINTR) continue;
            fail(name, "read", errno);
        }
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Descriptor nameless_file(const fs::path& output) {
    fs::path folder = output.parent_path();
    if (folder.empty()) folder = ".";
    int error = 0;
    for (const bool is_beside : {true, false}) {
        const fs::path place = is_beside ? folder : temporary_folder();
#ifdef O_TMPFILE
        const int nameless = ::open(place.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        if (nameless >= 0) return Descriptor(nameless);
#endif
        std::string name = (place / ".sikku-score.XXXXXX").string();
        Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
        error = errno;
        if (file.get() < 0) continue;
        ::unlink(name.c_str());
        return file;
    }
    fail(folder, "write a temporary file in", error);
}

bool is_readable_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), R_OK) == 0;
}

std::optional<fs::path> find_program(std::string_view name) {
    const char* list = std::getenv("PATH");
    std::string_view rest = list ? list : "/usr/local/bin:/usr/bin:/bin";
    while (true) {
        const std::size_t colon = rest.find(':');
        const std::string_view folder = rest.substr(0, colon);
        fs::path program = fs::path(folder.empty() ? std::string_view(".") : folder) / name;
        if (is_readable_file(program) && ::access(program.c_str(), X_OK) == 0) return program;
        if (colon == std::string_view::npos) return std::nullopt;
        rest.remove_prefix(colon + 1);
    }
}

std::string last_words(int messages, std::string_view program) {
    constexpr std::size_t most = 2000;
    const off_t size = ::lseek(messages, 0, SEEK_END);
    const std::uint64_t length = size > 0 ? static_cast<std::uint64_t>(size) : 0;
    std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(length, most)), '\0');
    text.resize(read_at(messages, text.data(), text.size(), length - text.size(),
                        fmt::format("the messages of {}", program)));
    for (char& byte : text) {
        if (static_cast<unsigned char>(byte) < 0x20 && byte != '\n') byte = ' ';
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

}  // namespace sikku::child
