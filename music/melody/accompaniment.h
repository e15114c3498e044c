// music/melody/accompaniment.h: notes of drones and chords.
#pragma once

#include "music/melody/melody.h"

#include <cstdint>
#include <vector>

namespace sikku::mapping {

/// Plays what accompanies a melody, bar by bar.
class Accompaniment {
public:
    explicit Accompaniment(const Melody& melody) : melody_(melody) {}

    /// The notes of a bar that begins at tick `begin`; voices are counted from 0.
    /// @param chord  of the bar, if there are chords
    std::vector<Note> bar(std::int64_t begin, const Chord* chord) const;

private:
    /// The pitch of that many cents above the tonic, moved by octaves to within an octave above `lowest`.
    double key_above(double cents, double lowest) const;

    const Melody& melody_;
};

}  // namespace sikku::mapping
