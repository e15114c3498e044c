#include "music/score/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

extern char** environ;  // NOLINT(readability-redundant-declaration): not every C library declares it

namespace sikku::child {

namespace fs = std::filesystem;

void Descriptor::reset() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
}

void fail(const fs::path& file, std::string_view doing, int error) {
    throw std::runtime_error(
        fmt::format("cannot {} {}: {}", doing, file.string(), std::generic_category().message(error)));
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
    for (const fs::path& place : {folder, fs::temp_directory_path()}) {
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

Process::Process(const fs::path& program, std::vector<std::string> arguments, int messages, int sound,
                 std::vector<std::string> environment) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0 || posix_spawnattr_init(&attributes) != 0) {
        throw std::bad_alloc();
    }
    // The child blocks nothing, ends when nothing reads its sound, and ignores what this program ignores (nohup).
    sigset_t none;
    sigset_t defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, messages, 1);
    posix_spawn_file_actions_adddup2(&actions, messages, 2);
    if (sound >= 0) posix_spawn_file_actions_adddup2(&actions, sound, 3);
    arguments.insert(arguments.begin(), program.string());
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    // The first of two variables of one name counts.
    std::vector<char*> variables;
    variables.reserve(environment.size() + 1);
    for (std::string& variable : environment) variables.push_back(variable.data());
    for (char** variable = environ; variable && *variable; ++variable) variables.push_back(*variable);
    variables.push_back(nullptr);
    const int error =
        posix_spawn(&process_, program.c_str(), &actions, &attributes, pointers.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        process_ = -1;
        fail(program, "run", error);
    }
}

Process::~Process() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    wait();
}

int Process::wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

std::optional<int> Process::ended() {
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
    process_ = -1;
    return status;
}

Descriptor lifted(Descriptor low) {
    if (low.get() < 0 || low.get() > 9) return low;
    Descriptor high(::fcntl(low.get(), F_DUPFD_CLOEXEC, 10));
    if (high.get() < 0) throw std::system_error(errno, std::generic_category(), "fcntl");
    return high;
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
