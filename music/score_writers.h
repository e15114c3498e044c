// music/score_writers.h: the table of the formats of scores.
#pragma once

#include "engine/interpreter.h"
#include "music/rendition.h"

#include <span>
#include <string_view>

namespace sikku {

/// Form in which a writer gets the notes.
enum class ScoreMedium {
    midi,      ///< as they are played, in channels of MIDI
    sound,     ///< as a MIDI file that is rendered
    notation,  ///< in bars
    notes,     ///< all together
    view,      ///< all together, to look at
};

/// Form in which a score contains the text of the pattern.
enum class PatternForm { exact, comments, xml };

/// Seconds of processor time, bytes and bytes of memory of a score, and of each of its notes.
struct ScoreCost {
    double seconds = 0.001, bytes = 1000, memory = 2e6;
    double note_seconds = 0.5e-6, note_bytes = 120, note_memory = 110;
};

/// A format of scores.
struct ScoreWriter {
    FormatName name;
    ScoreMedium medium = ScoreMedium::notes;
    /// Note values are written and performance is left to the player: no swing, articulation, pan or gamakas.
    bool is_printed = false;
    bool plays_swing = false;  ///< though it is printed
    bool has_glides = true;    ///< notes may slide; else they are held at the pitch they begin with
    PatternForm pattern = PatternForm::exact;
    double lowest = 0;              ///< MIDI key of its lowest note
    std::string_view needs_file{};  ///< subject of the message that a pipe is refused; empty: any output
    ScoreCost cost{};
    /// Writes a score in bars, also that of a player; null for other media.
    void (*print)(const Notation& notation, const Rendition& rendition, Output& output) = nullptr;
    void (*write)(Rendition& rendition, Output& output) = nullptr;
    bool has_cues = false;  ///< parts of players have cues
    /// The largest number of times that a passage between repeat signs is played; 1: the format has no repeat signs.
    std::size_t most_repeats = 1;

    /// True for MIDI files and for sound, which is rendered from them.
    bool has_channels() const { return medium == ScoreMedium::midi || medium == ScoreMedium::sound; }
};

/// All formats; the first is MIDI.
std::span<const ScoreWriter> score_writers();

/// The row of a format. @throws SettingError
const ScoreWriter& score_writer(std::string_view format);

}  // namespace sikku
