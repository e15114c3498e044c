#include "tests/program.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

namespace sikku {
namespace {

bool has_handler(pid_t process, int signal) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    std::string word;
    while (status >> word && word != "SigCgt:") {
    }
    return status >> word && (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
}

std::string contents(int descriptor) {
    std::string text;
    char block[4096];
    off_t at = 0;
    for (ssize_t got = 0; (got = pread(descriptor, block, sizeof block, at)) > 0; at += got) {
        text.append(block, static_cast<std::size_t>(got));
    }
    return text;
}

}  // namespace

Child::Child(const std::vector<std::string>& arguments, Surroundings surroundings)
    : surroundings_(std::move(surroundings)) {
    // A child that ends early must not take the test with it.
    std::signal(SIGPIPE, SIG_IGN);
    output_ = memfd_create("output", MFD_CLOEXEC);
    errors_ = memfd_create("errors", MFD_CLOEXEC);
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
    std::vector<std::string> words = {surroundings_.program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
        if (!surroundings_.folder.empty() && chdir(surroundings_.folder.c_str()) != 0) _exit(126);
        const int standard_output =
            surroundings_.output.empty() ? output_ : open(surroundings_.output.c_str(), O_WRONLY);
        const int standard_error =
            surroundings_.errors.empty() ? errors_ : open(surroundings_.errors.c_str(), O_WRONLY);
        dup2(ends[0], STDIN_FILENO);
        dup2(standard_output, STDOUT_FILENO);
        dup2(standard_error, STDERR_FILENO);
        for (const auto& [name, value] : surroundings_.environment) setenv(name.c_str(), value.c_str(), 1);
        // A script that runs the tests in the background may ignore some signals.
        for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
        if (surroundings_.file_size) {
            const rlimit limit{*surroundings_.file_size, *surroundings_.file_size};
            std::signal(SIGXFSZ, SIG_IGN);
            setrlimit(RLIMIT_FSIZE, &limit);
        }
        alarm(surroundings_.seconds);
        execvp(pointers[0], pointers.data());
        _exit(127);
    }
    close(ends[0]);
    input_ = ends[1];
}

Child::~Child() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    for (const int descriptor : {input_, output_, errors_}) {
        if (descriptor >= 0) close(descriptor);
    }
}

void Child::send(int signal) const {
    // kill(-1, …) would signal every process.
    const pid_t process = process_;
    if (process > 0) kill(process, signal);
}

void Child::await_handler(int signal) const {
    for (int i = 0; i < 2000 && !has_handler(process_, signal); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(sanitized ? 1000 : 300));
}

void Child::await_errors() const {
    struct stat file {};
    for (int i = 0; i < 12'000 && fstat(errors_, &file) == 0 && file.st_size == 0; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

Outcome Child::wait() {
    const Feed feed = [this](std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = write(input_, bytes.data(), bytes.size());
            if (written <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return true;
    };
    if (surroundings_.feed) {
        surroundings_.feed(feed);
    } else {
        feed(surroundings_.input);
    }
    close(input_);
    input_ = -1;
    int state = 0;
    rusage usage = {};
    wait4(process_, &state, 0, &usage);
    process_ = -1;
    Outcome outcome;
    outcome.status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    outcome.output = contents(output_);
    outcome.errors = contents(errors_);
    const auto time = [](const timeval& value) {
        return static_cast<double>(value.tv_sec) + 1e-6 * static_cast<double>(value.tv_usec);
    };
    outcome.seconds = time(usage.ru_utime) + time(usage.ru_stime);
    outcome.peak = usage.ru_maxrss;
    return outcome;
}

Outcome run(const std::vector<std::string>& arguments, Surroundings surroundings) {
    return Child(arguments, std::move(surroundings)).wait();
}

}  // namespace sikku
