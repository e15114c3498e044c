// music/held_ending.h: holds the last notes of a score, as `ending: fermata` requests.
#pragma once

#include "music/ensemble.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Forwards notes, but holds back the last one of each voice until the end of the score is known. Memory: O(voices).
class HeldEnding : public NoteSink {
public:
    /// `ensemble` has to outlive it.
    HeldEnding(const Ensemble& ensemble, NoteSink& sink) : ensemble_(ensemble), sink_(sink) {}

    void curves(const Curves& curves) override { sink_.curves(curves); }
    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t) override {}

    /// Forwards the notes held back. The last notes of lines that ended within a bar of the end are extended to
    /// the end of the last bar, or of one more bar if the last of them would otherwise last less than half a bar.
    /// Voices of one line end together: their last notes are held if they sound when the last note of the line
    /// begins. Drums are not held, nor are sections before the last.
    /// @param end  end of the score, in ticks
    /// @param most  limit of the new end
    /// @return the end of the score
    std::int64_t finish(std::int64_t end, const BarLines& bars, std::int64_t most);
    /// Forwards the notes held back as they are. @return `end`
    std::int64_t finish_as_cut(std::int64_t end);

private:
    /// The line of a voice, a melody or its accompaniment; -1 for drums, and for sections before the last.
    int line_of(int voice) const;
    void forward();

    const Ensemble& ensemble_;
    NoteSink& sink_;
    std::map<int, std::optional<Note>> last_;  // by voice
    std::vector<Note> passing_;
};

}  // namespace sikku
