// music/score/unisons.h: merges notes of voices that share a MIDI channel, on which a key sounds once at a time.
#pragma once

#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {

/// For each voice, the part in which its unisons are merged; parts that share a channel have the same number.
/// @param merges_all  false: only the notes of drums, which share one channel
std::vector<std::size_t> unison_parts(const ScoreHead& head, bool merges_all);

/// The last stroke of each key before an excerpt, whose velocity a key keeps until it is struck anew.
/// Memory: O(keys).
class LastStrokes {
public:
    explicit LastStrokes(std::vector<std::size_t> parts) : parts_(std::move(parts)) {}
    /// Adds a note that begins before the excerpt, in any order.
    void add(const Note& note);
    /// The velocity of the last stroke of the note's key, if there was one.
    std::optional<std::uint8_t> velocity(const Note& note) const;

private:
    struct Stroke {
        std::int64_t onset = 0;
        std::uint8_t velocity = 0;
    };
    std::vector<std::size_t> parts_;  // by voice
    std::map<std::pair<std::size_t, double>, Stroke> last_;
};

/// Collects notes and forwards them so that a key of a part, or of parts that share a channel, sounds only once at a
/// time. Of notes that begin together, the longest stays, with the loudest velocity. A later note ends the one
/// before, and lasts at least until that would have ended. A remainder, at the beginning of an excerpt, is such a
/// note before, and sounds as strokes_before() states. Voices are forwarded one after another. Memory: O(notes).
class UnisonMerger : public NoteSink {
public:
    /// @param most  notes above which a ScoreError is thrown
    /// @param merges_all  false: only the notes of drums, which share one channel
    UnisonMerger(NoteSink& sink, const ScoreHead& head, std::size_t most, bool merges_all = true);

    void curves(const Curves& curves) override { sink_.curves(curves); }
    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override;

    /// Must be filled before finish() if the notes are those of an excerpt.
    LastStrokes& strokes_before() { return before_; }

private:
    NoteSink& sink_;
    std::size_t most_;
    std::vector<std::size_t> parts_;  // by voice
    LastStrokes before_;
    std::vector<Note> notes_;
};

}  // namespace sikku
