// music/gamakas.h: ornaments within notes, as bends of their pitch.
#pragma once

#include "music/melody/melody.h"
#include "music/score/curves.h"
#include "music/score/score.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Bends the notes of a melody according to its key `gamaka`.
class Bender {
public:
    /// `melody` has to outlive it.
    explicit Bender(const Melody& melody) : melody_(melody) {}

    /// Adds the bends of a note to `points`, by tick, and marks notes that slide or have a grace note.
    /// @param before, after  neighbours in the same voice, or null. Notes are bent in order.
    /// @param tempo  quarters a minute
    /// @throws ScoreError for a note that is too long
    void bend(Note* before, Note& note, const Note* after, double tempo, std::vector<ControlPoint>& points) const;

private:
    std::int64_t degree_of(double key) const;
    bool swing(Note& note, std::int64_t degree, double tempo, std::vector<ControlPoint>& points) const;
    bool slide(const Note& note, double offset, bool from, double tempo, std::vector<ControlPoint>& points) const;

    const Melody& melody_;
};

}  // namespace sikku
