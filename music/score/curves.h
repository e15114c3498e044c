// music/score/curves.h: changes while notes sound: of tempo, controllers and pitch.
#pragma once

#include "music/score/score.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A tempo from a tick on.
struct TempoPoint {
    std::int64_t tick = 0;
    double factor = 1;  ///< factor of ScoreHead::tempo, above 0
    bool operator==(const TempoPoint&) const = default;
};

/// A value of a controller, or of the pitch, from a tick on.
struct ControlPoint {
    static constexpr int bend = -1;  ///< number of the pitch
    static constexpr int pan = 10;
    std::int64_t tick = 0;
    int voice = 0;
    int number = pan;  ///< a controller of MIDI, 0 to 127, or `bend`
    double value = 0;  ///< 0 to 127; for a bend, semitones that are added to the note's key
    bool operator==(const ControlPoint&) const = default;
};

/// The value of a controller in MIDI.
int controller_value(const ControlPoint& point);
/// The default value of a controller.
int usual_controller_value(int number);

/// The curves of a score.
struct Curves {
    std::vector<TempoPoint> tempo;       ///< by tick
    std::vector<ControlPoint> controls;  ///< by voice, then by tick; bends lie within notes, which begin without one
    bool empty() const { return tempo.empty() && controls.empty(); }
    bool has_bends() const;
    /// The points of a voice.
    std::span<const ControlPoint> of_voice(int voice) const;
};

/// All changes of tempo, by tick: those of the curves, those of sections, and the ritardando, which falls in eight
/// steps to 60 %.
/// @param end  end of the score, in ticks
std::vector<TempoPoint> tempo_map(const ScoreHead& head, const Curves& curves, std::int64_t end);

/// Seconds from the beginning to a tick. @param map  as of tempo_map()
double seconds_at(std::int64_t tick, double tempo, std::span<const TempoPoint> map);

}  // namespace sikku
