// music/melody/figure.h: rhythms in which an accompaniment plays the chords of a melody.
#pragma once

#include "music/score/score.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The rhythm in which an accompaniment plays the chord of each bar.
struct Figure {
    enum class Tone {
        all,   ///< bass, lower and upper voice
        pair,  ///< lower and upper voice
        bass,
        lower,
        upper,
        octave,   ///< tone of the bass, above the upper voice
        third,    ///< of the chord, in the register of the bass
        fifth,    ///< likewise
        approach  ///< half step to the bass of the next bar
    };
    struct Stroke {
        std::int64_t onset = 0;   ///< slots from the beginning of the bar
        std::int64_t length = 1;  ///< slots
        Tone tone = Tone::all;
        bool is_accented = false;
    };
    /// Voices with a rhythm of their own; layers share no voice.
    struct Layer {
        std::vector<Stroke> strokes;  ///< by onset, without overlap
        std::int64_t slots = 1;       ///< of a bar, all of one length
    };
    std::vector<Layer> layers;  ///< none: all voices sound throughout the bar
    bool is_silent = false;     ///< chords bend the melody, and are named in print, but do not sound
};

/// Reads a figure for a meter: `block`, `oom-pah`, `arpeggio`, `arpeggio down`, `alberti`, `strum`, `bossa`, `walking
/// bass`, `silent`; or its strokes in equal slots of a bar, layers joined by `&`: `bc5c`, `b..5b..5 & ~.c.~c..`. In
/// it a, c, b, l, u, o, 3, 5 and n are the tones of Figure::Tone in their order, capitals are accented, `.` holds and
/// `~` is silent; blanks and | are ignored.
/// @param problem  receives the problem, or is empty
Figure read_figure(std::string_view text, const Meter& meter, std::string& problem);

}  // namespace sikku
