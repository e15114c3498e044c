#include "python/interruption.h"

namespace sikku {
namespace {

constexpr std::chrono::milliseconds interval{50};

}  // namespace

Interruption::Interruption()
    : thread_(std::this_thread::get_id()), next_(std::chrono::steady_clock::now() + interval) {}

Monitor Interruption::monitor() {
    return Monitor([](void* self) { return static_cast<Interruption*>(self)->is_stopped(); }, nullptr, this);
}

bool Interruption::is_stopped() {
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

void Interruption::rethrow() {
    if (!type_) return;
    PyErr_Restore(type_.release().ptr(), value_.release().ptr(), traceback_.release().ptr());
    throw pybind11::error_already_set();
}

}  // namespace sikku
