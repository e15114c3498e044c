// tests/program.h: runs the program as a child process, as a user's shell would.
#pragma once

#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace sikku {

/// Takes bytes for standard input; false once nobody reads any more.
using Feed = std::function<bool(std::string_view bytes)>;

/// What the program is started with.
struct Surroundings {
    std::string input = {};
    std::function<void(const Feed&)> feed = {};  ///< instead of `input`, where that would be large
    std::filesystem::path folder = {};           ///< working directory
    std::vector<std::pair<std::string, std::string>> environment = {};
    std::optional<rlim_t> file_size = {};  ///< most bytes a file may get: a disk that is full
    std::string output = {};               ///< standard output goes to this file
    std::string errors = {};               ///< and standard error to this one
    std::string program = SIKKU_PROGRAM;
    unsigned seconds = sanitized ? 300 : 150;  ///< of real time; then it is killed
};

/// What became of it.
struct Outcome {
    int status = -1;  ///< exit status; 128 + n if signal n ended it
    std::string output;
    std::string errors;
    double seconds = 0.0;  ///< processor time
    long peak = 0;         ///< kilobytes
};

/// A running program.
class Child {
public:
    explicit Child(const std::vector<std::string>& arguments, Surroundings surroundings = {});
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();

    /// Sends a signal, unless the process has ended.
    void send(int signal) const;
    /// Waits until it has a handler for the signal, and a little longer, so that it is at work.
    void await_handler(int signal) const;
    /// Waits until it has written to standard error, for a minute at most.
    void await_errors() const;
    /// Hands over standard input and waits for the end.
    Outcome wait();

private:
    Surroundings surroundings_;
    std::atomic<pid_t> process_ = -1;  // other threads send signals while one waits
    int input_ = -1;
    int output_ = -1;
    int errors_ = -1;
};

Outcome run(const std::vector<std::string>& arguments, Surroundings surroundings = {});

}  // namespace sikku
