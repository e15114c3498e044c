// music/live/performer.h: plays a stream of notes to a port, in time.
#pragma once

#include "engine/base/monitor.h"
#include "music/live/port.h"
#include "music/note_stream.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace sikku::live {

enum class ClockMode {
    none,
    send,   ///< sends MIDI clock: 24 a quarter, start, stop, and continue after a pause
    follow  ///< waits for the start of another clock, and follows its tempo, stop, continue and song position
};

struct PerformOptions {
    std::int64_t times = 1;  ///< how often the score is played; 0: until it is stopped
    ClockMode clock = ClockMode::none;
};

/// What the performer asks and tells while it plays. All are called between notes and have to return within a
/// millisecond, except `pause`.
struct PerformHooks {
    Monitor monitor;  ///< stops the performance
    /// A newer version of the score, or null. It takes over at a bar line, as soon as it is ready.
    std::function<std::unique_ptr<NoteStream>()> newer;
    /// The newer version sounds from this bar on, counted from 1.
    std::function<void(std::int64_t bar)> changed;
    /// The newer version cannot be read from there on: that before it plays on.
    std::function<void(const std::exception_ptr& error)> refused;
    std::function<bool()> is_pause_wanted;
    std::function<void()> pause;                     ///< returns when the performance goes on
    std::function<void(const std::string&)> report;  ///< `waiting for the clock`, `stopped`
};

struct PerformReport {
    std::uint64_t notes = 0;
    std::int64_t passes = 0;  ///< begun
    Nanoseconds latest = 0;   ///< the most that notes were late
    std::uint64_t late = 0;   ///< notes that were more than 5 ms late
    Nanoseconds lost = 0;     ///< pauses because notes were not ready in time, together
};

/// Plays a score. Each repetition begins at the next bar line after the end of the score. Times are counted from the
/// beginning, and from changes of tempo, so that errors do not add up. At the end, after an interruption and after
/// failures all notes are ended. The notes of a window of the stream are in memory, and those that sound.
/// @throws PortError; Stopped; what the stream throws
PerformReport perform(std::unique_ptr<NoteStream> stream, Clock& clock, Port& port, const PerformOptions& options,
                      const PerformHooks& hooks);

}  // namespace sikku::live
