// music/play_settings.h: typed settings of a score, and the table of options that sets them.
#pragma once

#include "engine/base/option.h"
#include "engine/language/pattern.h"
#include "music/score/midi.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

struct PlaySettings {
    RecipeOptions recipe;       ///< the options that set no key
    std::vector<Setting> keys;  ///< keys of the language in the order of their table: `scale`, `tempo`, …
    std::int64_t from_bar = 1;  ///< first bar, counted from 1
    std::int64_t bars = 0;      ///< 0: all
    double seconds = 0;         ///< 0: all
    double transpose = 0;       ///< semitones, -127 to 127
    double humanise = 0;        ///< 0 to 1
    Syllables syllables = Syllables::none;
    bool has_chord_signs = false;  ///< chords are named in print
    bool has_graces = false;       ///< gamakas are printed as grace notes
    bool has_repeats = false;      ///< passages that are played several times in a row are printed once
    bool has_parts = false;        ///< a part for each player is printed, too
    bool is_transposed = true;     ///< in print, transposing instruments are written as their players read them
    std::uint64_t seed = 0;        ///< random seed of humanise
    int format = 1;                ///< MIDI format, 0 or 1
    Tuning tuning = Tuning::bend;
    double budget = 200e6;  ///< maximum number of derivation nodes visited
};

/// Every option of a score, in the order of help, beginning with the keys that music owns.
std::span<const Option<PlaySettings>> play_options();

/// Reads options. @throws SettingError
PlaySettings read_play_settings(const OptionValues& values);

}  // namespace sikku
