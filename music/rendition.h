// music/rendition.h: plays a piece for the writer of a score.
#pragma once

#include "engine/base/monitor.h"
#include "engine/base/output.h"
#include "music/performance.h"
#include "music/score/midi.h"
#include "music/score/music_page.h"
#include "music/score/notation.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sikku {

struct ExcerptContext;

/// A piece that is about to be written, with everything that writers of scores need. A writer asks for its notes
/// once, in the form of its medium.
struct Rendition {
    const Ensemble& ensemble;
    const PlayOptions& playing;
    const ScoreHead& head;
    ExpressionSink::Use use;
    Human human;
    MidiOptions midi;
    const Monitor& monitor;
    std::filesystem::path name;  ///< name of the output, for messages

    EnsembleReport report;             ///< set once the notes are played
    std::optional<Notation> notation;  ///< set by print()
    std::string warning;               ///< set by writers: about the result; may be empty

    /// Plays all notes into memory.
    NoteCollector collect();
    /// Arranges the notes in bars, without the deviations of a player. An excerpt has the staves, clefs and dynamics
    /// that it has within the whole, and whole bars.
    const Notation& print();
    /// Writes the notes as a MIDI file as they are played.
    void write_midi(Output& output);

private:
    const Notation& print_excerpt();
    Notation print_within(const ExcerptContext& context) const;
};

}  // namespace sikku
