// engine/base/monitor.h: progress reports and stop requests for long work.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace sikku {

/// Thrown by work that was asked to stop. It is not a std::runtime_error, so that failure handlers do not catch it.
class Stopped : public std::exception {
public:
    explicit Stopped(std::string message = "interrupted; nothing was written") : message_(std::move(message)) {}
    const char* what() const noexcept override { return message_.c_str(); }

private:
    std::string message_;
};

/// Passed to all work that may take longer than 0.3 s. A value of two pointers and a context, which must outlive the
/// work; a default-constructed monitor never stops the work. Several threads may use it at once if its context allows
/// that.
class Monitor {
public:
    using StopRequested = bool (*)(void* context);
    using Advanced = void (*)(void* context, std::uint64_t units);
    using Expected = void (*)(void* context, double units);

    Monitor() = default;
    explicit Monitor(StopRequested stop, Advanced advanced = nullptr, void* context = nullptr,
                     Expected expected = nullptr)
        : stop_requested_(stop), advanced_(advanced), expected_(expected), context_(context) {}

    bool stop_requested() const { return stop_requested_ && stop_requested_(context_); }
    /// Checks for a stop request. Cost: a few nanoseconds plus the callback. @throws Stopped
    void check() const {
        if (stop_requested()) throw Stopped();
    }
    /// Announces work: the number of units that advance() will report from now on, 0 if it is unknown.
    void expect(double units) const {
        if (expected_) expected_(context_, units);
    }
    /// Reports units of work (symbols, lines, bands) completed since the last call. @throws Stopped
    void advance(std::uint64_t units) const {
        if (advanced_) advanced_(context_, units);
        check();
    }

private:
    StopRequested stop_requested_ = nullptr;
    Advanced advanced_ = nullptr;
    Expected expected_ = nullptr;
    void* context_ = nullptr;
};

/// Polls a monitor once in 4096 calls: for loops whose iterations take less than a microsecond. Keeps a reference.
class Pulse {
public:
    explicit Pulse(const Monitor& monitor) : monitor_(&monitor) {}
    /// @throws Stopped
    void operator()() {
        if ((++calls_ & 4095U) == 0) monitor_->check();
    }

private:
    const Monitor* monitor_;
    std::uint32_t calls_ = 0;
};

/// Wraps the order `less` for a long sort, which ends with Stopped on a stop request.
template <class Less>
auto stoppable(const Monitor& monitor, Less less) {
    return [pulse = Pulse(monitor), less = std::move(less)](const auto& a, const auto& b) mutable {
        pulse();
        return less(a, b);
    };
}

}  // namespace sikku
