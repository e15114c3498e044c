// python/interruption.h: long calls that release the lock of Python, report progress, and stop on Ctrl-C.
#pragma once

#include "engine/base/monitor.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>

namespace sikku {

/// Checks for signals such as Ctrl-C in Python and reports progress, at most every 50 ms. Constructed by the thread
/// that holds the global lock of Python (GIL) and then releases it for a long call.
class Interruption {
public:
    /// @param progress  called with the units of work that are done and those expected (0: unknown), or None
    explicit Interruption(pybind11::object progress = pybind11::none()) : progress_(std::move(progress)) {}

    /// A monitor that refers to this object. Any thread of the work may use it; only the calling thread calls Python.
    Monitor monitor() {
        return Monitor([](void* self) { return static_cast<Interruption*>(self)->is_stopped(); },
                       [](void* self, std::uint64_t units) { static_cast<Interruption*>(self)->done_ += units; },
                       this, [](void* self, double units) { static_cast<Interruption*>(self)->expect(units); });
    }
    /// Throws the exception that a signal or the callback raised in Python. Requires the global lock.
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
        if (PyErr_CheckSignals() != 0 || !report()) {
            PyErr_Fetch(&type_.ptr(), &value_.ptr(), &traceback_.ptr());
            is_stopped_ = true;
        }
        // Read after the signals, so that the time spent waiting for the lock does not count.
        next_ = std::chrono::steady_clock::now() + interval;
        return is_stopped_;
    }

    /// A new stage of the work.
    void expect(double units) {
        done_ = 0;
        expected_ = units;
    }
    /// Calls the callback. Returns false if it raised an exception, which is then set in Python.
    bool report() {
        if (progress_.is_none()) return true;
        const pybind11::object answer = pybind11::reinterpret_steal<pybind11::object>(PyObject_CallFunction(
            progress_.ptr(), "Kd", static_cast<unsigned long long>(done_.load()), expected_.load()));
        return static_cast<bool>(answer);
    }

    pybind11::object progress_;
    std::atomic<std::uint64_t> done_{0};
    std::atomic<double> expected_{0};
    std::thread::id thread_ = std::this_thread::get_id();
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
    std::atomic<bool> is_stopped_{false};
    pybind11::object type_, value_, traceback_;
};

/// Runs `work(monitor)` without the global lock of Python. @param progress  as in Interruption
/// @throws exceptions of `work`, or that of a signal or of the callback
template <class Work>
auto long_call(const Work& work, const pybind11::object& progress = pybind11::none()) {
    Interruption interruption(progress);
    try {
        auto result = [&] {
            const pybind11::gil_scoped_release release;
            return work(interruption.monitor());
        }();
        interruption.rethrow();
        return result;
    } catch (const pybind11::error_already_set&) {
        throw;
    } catch (...) {
        interruption.rethrow();
        throw;
    }
}

}  // namespace sikku
