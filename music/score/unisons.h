// music/score/unisons.h: merges notes of voices that share a MIDI channel, on which a key sounds once at a time.
#pragma once

#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Collects notes and forwards them so that a key of a part, or of parts that share a channel, sounds only once at a
/// time. Of notes that begin together, the longest stays, with the loudest velocity. A later note ends the one
/// before, and lasts at least until that would have ended. Voices are forwarded one after another. Memory: O(notes).
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
    std::vector<std::size_t> parts_;  ///< part of each voice; one number for all parts on one channel
    std::vector<Note> notes_;
};

}  // namespace sikku
