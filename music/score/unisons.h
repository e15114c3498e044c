// music/score/unisons.h: lets voices of an instrument share a MIDI channel, on which a key sounds once at a time.
#pragma once

#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Collects notes and hands them on without two at a time on one key of one part, or of parts that share a channel:
/// of notes that begin together the longest stays, with the loudest velocity; a later one ends the one before, and
/// goes on as long as that did. Voices come one after the other. Memory: O(notes).
class UnisonMerger : public NoteSink {
public:
    /// @param most  notes above which a ScoreError is thrown
    /// @param merges_all  false: only the notes of drums, which share one channel
    UnisonMerger(NoteSink& sink, const ScoreHead& head, std::size_t most, bool merges_all = true);

    void curves(const Curves& curves) override { sink_.curves(curves); }
    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override;

private:
    NoteSink& sink_;
    std::size_t most_;
    std::vector<std::size_t> parts_;  ///< of each voice; one number for those on one channel
    std::vector<Note> notes_;
};

}  // namespace sikku
