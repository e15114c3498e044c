// python/interruption.h: long calls that release the lock of Python, and stop on Ctrl-C.
#pragma once

#include "engine/base/monitor.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace sikku {

/// Checks for signals such as Ctrl-C in Python, at most every 50 ms. Constructed by the thread that holds the global
/// lock of Python (GIL) and then releases it for a long call.
class Interruption {
public:
    Interruption();

    /// A monitor that refers to this object. Any thread of the work may use it; only the calling thread checks
    /// signals.
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

/// Runs `work(monitor)` without the global lock of Python. @throws exceptions of `work`, or that of a signal
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
