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
    /// A monitor that refers to this object. Any thread of the work may use it; only the calling thread checks
    /// signals.
    Monitor monitor() {
        return Monitor([](void* self) { return static_cast<Interruption*>(self)->is_stopped(); }, nullptr, this);
    }
    /// Throws the exception that a signal raised in Python. Requires the global lock.
    void rethrow() {
        if (!type_) return;
        PyErr_Restore(type_.release().ptr(), value_.release().ptr(), traceback_.release().ptr());
        throw pybind11::error_already_set();
    }

private:
    static constexpr std::chrono::milliseconds interval{50};

    bool is_stopped() {
        if (is_stopped_ || std::this_thread::get_id() != thread_) return is_stopped_;
        const auto now = std::chrono::steady_clock::now();
        if (now < next_) return false;
        const pybind11::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) {
            PyErr_Fetch(&type_.ptr(), &value_.ptr(), &traceback_.ptr());
            is_stopped_ = true;
        }
        // Read after the signals, so that the time spent waiting for the lock does not count.
        next_ = std::chrono::steady_clock::now() + interval;
        return is_stopped_;
    }

    std::thread::id thread_ = std::this_thread::get_id();
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
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
