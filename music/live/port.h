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

/// A monotonic clock.
class Clock {
public:
    virtual ~Clock() = default;
    virtual Nanoseconds now() = 0;
    /// Waits until that time, or until a signal; returns at once if it has passed.
    virtual void sleep_until(Nanoseconds time) = 0;
};

/// CLOCK_MONOTONIC.
class MonotonicClock final : public Clock {
public:
    Nanoseconds now() override;
    void sleep_until(Nanoseconds time) override;
};

/// Raises the priority of this thread if the user may do that; threads that it starts later do not inherit it.
void prefer_this_thread();

/// A message that a port receives from another clock.
struct Received {
    enum class Kind { clock, start, resume, stop, position };
    Nanoseconds time = 0;  ///< time of arrival
    Kind kind = Kind::clock;
    int position = 0;  ///< in sixteenths from the beginning
};

/// The place of a beat in the score: bar and beat, both counted from 1.
struct Place {
    std::int64_t bar = 1;
    int beat = 1;
};

/// Thrown if a port cannot be opened, or has disappeared.
class PortError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A destination of MIDI messages, and perhaps of places.
class Port {
public:
    virtual ~Port() = default;
    /// Time by which messages may be sent early, so that delays of this thread do not matter.
    virtual Nanoseconds ahead() const { return 0; }
    /// Sends messages in this order. @param time  when they are due by the clock, not before that of messages sent
    /// earlier. `at_once` for ports without ahead(); a port receives it always or never. @throws PortError
    virtual void send(std::span<const Message> messages, Nanoseconds time) = 0;
    static constexpr Nanoseconds at_once = 0;
    /// True if the port takes every beat, and takes start, stop and continue even if no clock is sent.
    virtual bool wants_places() const { return false; }
    /// Announces a beat. @param time  as for send(), which follows with the notes of that time @throws PortError
    virtual void send_place(const Place& /*place*/, Nanoseconds /*time*/) {}
    /// Waits until `time`, a message or a signal. @return the messages received since the last call
    /// @throws PortError
    virtual std::vector<Received> wait(Clock& clock, Nanoseconds time) = 0;
};

/// Extracts clock messages from a stream of MIDI bytes.
class ClockReader {
public:
    void read(std::span<const std::uint8_t> bytes, Nanoseconds time, std::vector<Received>& received);

private:
    int expected_ = 0;  // bytes missing from a song position
    int position_ = 0;
};

}  // namespace sikku::live
