// music/strict_check.h: counts the faults of strict counterpoint in what sounds.
#pragma once

#include "music/ensemble.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Forwards notes and keeps them, to count the faults of parts with `counterpoint: strict` after endings, swing and
/// the deviations of a player. Memory: O(notes).
class StrictCheck : public NoteSink {
public:
    /// `ensemble` has to outlive it. @param bars  with the same origin as the notes
    StrictCheck(const Ensemble& ensemble, BarLines bars, NoteSink& sink)
        : ensemble_(ensemble), bars_(std::move(bars)), sink_(sink) {}
    void curves(const Curves& curves) override { sink_.curves(curves); }
    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override { sink_.finish(end); }

    /// Onsets of notes with faults, see sounding_faults(). @param late  greatest delay of a note
    std::vector<std::int64_t> faults(std::int64_t late);

private:
    const Ensemble& ensemble_;
    BarLines bars_;
    NoteSink& sink_;
    std::vector<std::vector<Note>> voices_;
};

}  // namespace sikku
