// music/live/port.h: the clock that live music is timed by, and the port that it is sent to.
#pragma once

#include "music/live/message.h"

#include <cstdint>
#include <ctime>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku::live {

using Nanoseconds = std::int64_t;
constexpr Nanoseconds second = 1'000'000'000;

/// A time of the clock, or a duration, from 0 on.
timespec timespec_of(Nanoseconds time);

/// A clock that never goes back.
class Clock {
public:
    virtual ~Clock() = default;
    virtual Nanoseconds now() = 0;
    /// Returns at that time, or before it after a signal; at once if it is over.
    virtual void sleep_until(Nanoseconds time) = 0;
};

/// CLOCK_MONOTONIC.
class MonotonicClock final : public Clock {
public:
    Nanoseconds now() override;
    void sleep_until(Nanoseconds time) override;
};

/// Lets this thread run before others, where the user may do that; threads that it starts later do not.
void prefer_this_thread();

/// What a port receives from another clock.
struct Received {
    enum class Kind { clock, start, resume, stop, position };
    Nanoseconds time = 0;  ///< of its arrival
    Kind kind = Kind::clock;
    int position = 0;  ///< in sixteenths from the beginning
};

/// The port cannot be opened, or has vanished.
class PortError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A destination of MIDI messages.
class Port {
public:
    virtual ~Port() = default;
    /// How long before their time messages may be sent, so that delays of this thread do not matter.
    virtual Nanoseconds ahead() const { return 0; }
    /// Sends messages in this order. @param time  when they are due by the clock, not before that of messages sent
    /// earlier. `at_once` for ports without ahead(); a port receives it always or never. @throws PortError
    virtual void send(std::span<const Message> messages, Nanoseconds time) = 0;
    static constexpr Nanoseconds at_once = 0;
    /// Waits until `time`, or until something arrives or a signal comes. @return what arrived since the last call
    /// @throws PortError
    virtual std::vector<Received> wait(Clock& clock, Nanoseconds time) = 0;
};

/// Reads clock messages from a stream of MIDI bytes, whatever is between them.
class ClockReader {
public:
    void read(std::span<const std::uint8_t> bytes, Nanoseconds time, std::vector<Received>& received);

private:
    int expected_ = 0;  // bytes of a song position that are to come
    int position_ = 0;
};

}  // namespace sikku::live
