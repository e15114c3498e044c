#include "engine/base/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <new>
#include <stdexcept>
#include <system_error>

extern char** environ;  // NOLINT(readability-redundant-declaration): not every C library declares it

namespace sikku {
namespace {

constexpr int first_lifted = 10;

}  // namespace

Descriptor lifted_copy(int descriptor) {
    Descriptor high(::fcntl(descriptor, F_DUPFD_CLOEXEC, first_lifted));
    if (!high) throw std::system_error(errno, std::generic_category(), "fcntl");
    return high;
}

Descriptor lifted(Descriptor low) {
    return low.get() < 0 || low.get() >= first_lifted ? std::move(low) : lifted_copy(low.get());
}

Process::Process(ProcessStart start) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0 || posix_spawnattr_init(&attributes) != 0) {
        throw std::bad_alloc();
    }
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    const int group = start.is_apart ? POSIX_SPAWN_SETPGROUP : 0;
    posix_spawnattr_setflags(&attributes, static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | group));
    for (std::size_t i = 0; i < start.descriptors.size(); ++i) {
        const int target = static_cast<int>(i);
        if (start.descriptors[i] >= 0) {
            posix_spawn_file_actions_adddup2(&actions, start.descriptors[i], target);
        } else if (target <= STDERR_FILENO) {
            posix_spawn_file_actions_addopen(&actions, target, "/dev/null", target == 0 ? O_RDONLY : O_WRONLY, 0);
        }
    }
    std::string name = start.program.string();
    std::vector<char*> arguments = {name.data()};
    for (std::string& argument : start.arguments) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    // The first of two variables of one name counts.
    std::vector<char*> variables;
    for (std::string& variable : start.environment) variables.push_back(variable.data());
    for (char** variable = environ; !start.is_bare && variable && *variable; ++variable) {
        variables.push_back(*variable);
    }
    variables.push_back(nullptr);
    const int error = posix_spawn(&process_, name.c_str(), &actions, &attributes, arguments.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error == 0) return;
    process_ = -1;
    throw std::runtime_error(fmt::format("cannot run {}: {}", name, std::generic_category().message(error)));
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
    if (process_ <= 0) return std::nullopt;
    int status = 0;
    const int found = ::waitpid(process_, &status, WNOHANG);
    const bool is_running = found == 0 || (found < 0 && errno == EINTR);
    if (!is_running) process_ = -1;  // also if another thread has waited for it
    return found > 0 ? std::optional(status) : std::nullopt;
}

}  // namespace sikku
