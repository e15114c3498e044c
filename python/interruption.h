// python/interruption.h: long calls that let other threads of Python run, and stop on ctrl-C.
#pragma once

#include "engine/base/monitor.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace sikku {

/// Asks Python, at most every 50 ms, whether a signal has come, such as ctrl-C. Made by the thread that holds the
/// global lock of Python and then releases it for a long call.
class Interruption {
public:
    Interruption();

    /// A monitor that refers to this object. Threads of the work may use it; only the thread of the call asks Python.
    Monitor monitor();
    /// Throws the exception that a signal raised in Python. Requires the global lock.
    void rethrow();

private:
    bool is_stopped();

    std::thread::id thread_;
    std::chrono::steady_clock::time_point next_;
    std::atomic<bool> is_stopped_{false};
    pybind11::object type_, value_, traceback_;
};

/// Runs `work(monitor)` without the global lock of Python. @throws what `work` throws, or the exception of a signal
template <class Work>
auto long_call(const Work& work) {
    Interruption interruption;
    try {
        const pybind11::gil_scoped_release release;
        return work(interruption.monitor());
    } catch (const Stopped&) {
        interruption.rethrow();
        throw;
    }
}

}  // namespace sikku
