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
    std::int64_t times = 1;  ///< number of times that the score is played; 0: until it is stopped
    ClockMode clock = ClockMode::none;
};

/// Callbacks of the performer while it plays. They are called between notes and must return within a millisecond,
/// except `pause`.
struct PerformHooks {
    Monitor monitor;  ///< stops the performance
    /// Returns a newer version of the score, or null. It replaces the score at a bar line, as soon as it is ready.
    std::function<std::unique_ptr<NoteStream>()> newer;
    /// Reports the bar, counted from 1, from which the newer version sounds.
    std::function<void(std::int64_t bar)> changed;
    /// Reports that the newer version cannot be read from there on; the version before it continues.
    std::function<void(const std::exception_ptr& error)> refused;
    std::function<bool()> is_pause_wanted;
    std::function<void()> pause;                     ///< returns when the performance resumes
    std::function<void(const std::string&)> report;  ///< `waiting for the clock`, `stopped`
};

struct PerformReport {
    std::uint64_t notes = 0;
    std::int64_t passes = 0;  ///< repetitions begun
    Nanoseconds latest = 0;   ///< largest delay of a note
    std::uint64_t late = 0;   ///< notes that were more than 5 ms late
    Nanoseconds lost = 0;     ///< total of the pauses because notes were not ready in time
};

/// Plays a score. Each repetition begins at the next bar line after the end of the score. Times are counted from the
/// beginning, and from changes of tempo, so that errors do not add up. Ends all notes at the end, after an
/// interruption and after failures. Memory: the notes of a window of the stream, and those that sound.
/// @throws PortError; Stopped; exceptions of the stream
PerformReport perform(std::unique_ptr<NoteStream> stream, Clock& clock, Port& port, const PerformOptions& options,
                      const PerformHooks& hooks);

}  // namespace sikku::live
