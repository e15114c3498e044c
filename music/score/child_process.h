// music/score/child_process.h: runs the programs that render scores.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku::child {

/// A file descriptor that is closed with this object.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { reset(); }
    int get() const { return number_; }
    void reset();

private:
    int number_;
};

/// @throws std::runtime_error that names the file, what was tried and the cause
[[noreturn]] void fail(const std::filesystem::path& file, std::string_view doing, int error);

void write_all(int descriptor, const char* bytes, std::size_t count, const std::filesystem::path& name);

/// Reads as many bytes as there are, at most `count`.
std::size_t read_at(int descriptor, char* bytes, std::size_t count, std::uint64_t position,
                    const std::filesystem::path& name);

/// A file without a name in the folder of `output`, or where temporary files go if that folder takes none (as that
/// of a device). It is gone with its last descriptor.
Descriptor nameless_file(const std::filesystem::path& output);

bool is_readable_file(const std::filesystem::path& path);

/// The program of that name in PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// A process that is ended and buried with this object.
class Process {
public:
    /// Standard input is empty, output and errors go to `messages`, and `sound` is descriptor 3, unless negative.
    /// @param environment  variables such as `LANG=C` added to those of this program
    Process(const std::filesystem::path& program, std::vector<std::string> arguments, int messages, int sound = -1,
            std::vector<std::string> environment = {});
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process();
    /// Returns the status of waitpid().
    int wait();
    /// Returns the status if the process has ended.
    std::optional<int> ended();

private:
    pid_t process_ = -1;
};

/// A descriptor of the same file above those that a child's are put on.
Descriptor lifted(Descriptor low);

/// The end of what a program printed, a line each.
std::string last_words(int messages, std::string_view program);

}  // namespace sikku::child
