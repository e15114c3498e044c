#include "cli/signals.h"

#include "engine/base/output_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

namespace sikku {
namespace {

constexpr long patience_milliseconds = 500;

std::atomic<int> signal_seen{0};
std::atomic<bool> is_reported{false};
std::atomic<bool> has_pause{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);
timer_t patience;
bool has_patience = false;

/// Runs in a signal handler, on any thread.
[[noreturn]] void end_at_once() {
    remove_unfinished_files();
    _exit(128 + signal_seen);
}

extern "C" void stop_signal(int signal) {
    int none = 0;
    if (!signal_seen.compare_exchange_strong(none, signal)) end_at_once();
    if (!has_patience) return;
    const int error = errno;  // errno of the interrupted code
    itimerspec time{};
    time.it_value.tv_nsec = patience_milliseconds * 1'000'000;
    timer_settime(patience, 0, &time, nullptr);
    errno = error;
}

/// Ends the program if the work did not check for the request in time, or the exit takes too long.
extern "C" void patience_signal(int) {
    constexpr std::string_view message = "sikku: interrupted\n";
    // A lost terminal must not delay the exit.
    if (!is_reported && ::write(STDERR_FILENO, message.data(), message.size()) < 0) {
    }
    end_at_once();
}

/// Removes temporary files after the reader of the output is gone, then ends the program by the signal.
extern "C" void pipe_signal(int) {
    remove_unfinished_files();
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

extern "C" void suspend_signal(int) {
    has_pause = true;
}

/// Handles a signal unless it is ignored.
void handle(int signal, void (*handler)(int)) {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = handler;
    sigaction(signal, &action, nullptr);
}

}  // namespace

void catch_signals() {
    struct sigaction action = {};
    action.sa_handler = patience_signal;
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGRTMIN;
    has_patience =
        sigaction(SIGRTMIN, &action, nullptr) == 0 && timer_create(CLOCK_MONOTONIC, &event, &patience) == 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, stop_signal);
    handle(SIGPIPE, pipe_signal);
    // A file that grows over the limit of the shell is an error like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
}

void ignore_closed_pipes() {
    std::signal(SIGPIPE, SIG_IGN);
}

void catch_pause() {
    handle(SIGTSTP, suspend_signal);
}

bool pause_wanted() {
    return has_pause;
}

void pause_now() {
    has_pause = false;
    std::raise(SIGSTOP);
}

bool interrupted() {
    return signal_seen != 0;
}

int interruption_status() {
    is_reported = true;
    return 128 + signal_seen;
}

}  // namespace sikku
