// music/score/midi_conductor.h: the first track of a MIDI file, with texts, tempo, meter and key.
#pragma once

#include "music/score/curves.h"
#include "music/score/score.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku::midi {

/// A change of tempo, of meter or of key.
struct ConductorChange {
    std::int64_t tick;
    std::uint32_t micro = 0;         ///< microseconds a quarter
    const Meter* meter = nullptr;    ///< the new meter, owned by the head
    const KeyChange* key = nullptr;  ///< the new key, owned by the head; both null for a change of tempo

    /// The event without its delta.
    std::string event() const;
};

class Conductor {
public:
    /// @param head, curves  have to outlive this; curves may be null
    /// @throws ScoreError for a tempo, meter, key or program that a file cannot contain
    Conductor(const ScoreHead& head, const Curves* curves, bool is_mpe);

    /// The events at the beginning of the track, all at tick 0.
    const std::string& opening() const { return opening_; }
    /// Changes of tempo, meter and key after the beginning, by tick.
    std::vector<ConductorChange> changes(std::int64_t end) const;
    /// The bytes that end the track. Their number is the same for every `end` if `last` is.
    /// @param last  the delta of the end of the track if nothing changes
    std::string closing(std::int64_t end, const std::string& last) const;

private:
    double first_factor() const;
    std::string make_opening(bool is_mpe) const;

    const ScoreHead* head_;
    const Curves* curves_;
    std::string opening_;
};

}  // namespace sikku::midi
