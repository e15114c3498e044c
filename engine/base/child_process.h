// engine/base/child_process.h: file descriptors with an owner, and other programs.
#pragma once

#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// A file descriptor that is closed with its owner; -1: none.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        if (this == &other) return *this;
        reset();
        number_ = std::exchange(other.number_, -1);
        return *this;
    }
    ~Descriptor() { reset(); }
    int get() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }
    void reset() {
        if (number_ >= 0) ::close(number_);
        number_ = -1;
    }

private:
    int number_ = -1;
};

/// Duplicates a descriptor above those that a child receives. @throws std::system_error
Descriptor lifted_copy(int descriptor);
/// Returns the descriptor itself if it is above those, otherwise such a duplicate. @throws std::system_error
Descriptor lifted(Descriptor low);

/// Program, arguments and descriptors of a process to start.
struct ProcessStart {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    /// Its descriptors 0 to 3. -1: for 0 to 2 /dev/null, for 3 none. Others must be lifted().
    std::array<int, 4> descriptors{-1, -1, -1, -1};
    std::vector<std::string> environment{};  ///< variables such as `LANG=C`, which precede those of this program
    bool is_bare = false;                    ///< it gets no other variables
    bool is_apart = false;  ///< in a process group of its own: ctrl-C in a terminal does not reach it
};

/// A process that is ended and reaped with this object. It blocks no signals, ends when its output has no reader,
/// and ignores the signals that this program ignores (nohup).
class Process {
public:
    /// @throws std::runtime_error that names the program and the cause
    explicit Process(ProcessStart start);
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process();
    /// Returns the status of waitpid().
    int wait();
    /// Returns the status if the process has ended.
    std::optional<int> ended();

private:
    int process_ = -1;
};

}  // namespace sikku
