// music/note_stream.h: the notes of a score in the order of time, a few bars at a time.
#pragma once

#include "engine/base/monitor.h"
#include "engine/interpreter.h"
#include "music/arrangement.h"
#include "music/performance.h"
#include "music/score/curves.h"
#include "music/score/midi.h"
#include "music/score/score.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Notes that begin in a few bars. Ticks are counted from the beginning of the score.
struct NoteWindow {
    std::int64_t from = 0;
    std::int64_t to = 0;  ///< the next window begins here
    /// By onset, then by voice. A duration of 0 means that the end of the note is not known yet.
    std::vector<Note> notes;
    /// Ends of notes of earlier windows whose duration was 0, by tick.
    struct End {
        std::int64_t tick = 0;
        std::int16_t voice = 0;
    };
    std::vector<End> ends;
    /// Slides of the sounding notes, by tick; some may lie beyond the window. They replace Note::glide.
    struct Pitch {
        std::int64_t tick = 0;
        std::int16_t voice = 0;
        double key = 0;
    };
    std::vector<Pitch> pitches;
    /// Controllers and bends of the notes, by tick; some may lie beyond the window. After seek() also those in effect
    /// at the beginning of the window.
    std::vector<ControlPoint> controls;
    /// Changes of tempo along the curve within the window, by tick; the first applies at its beginning.
    std::vector<TempoPoint> tempos;
    /// End of the score, rests included; known at least two bars before.
    std::optional<std::int64_t> end;
    bool is_last = false;  ///< the next window begins at tick 0 again
};

/// Provides the notes of a score from any tick on, repeatedly.
class NoteStream {
public:
    virtual ~NoteStream() = default;
    virtual const ScoreHead& head() const = 0;
    /// Use of channels by the voices.
    virtual const MidiOptions& midi() const = 0;
    /// Makes the next window begin at a tick, 0 or more; notes that began before it are left out.
    virtual void seek(std::int64_t tick) = 0;
    /// True if next() returns at once.
    virtual bool is_ready() { return true; }
    /// @throws as Work::make()
    virtual NoteWindow next() = 0;
};

/// Streams the score of documents or of an arrangement. A window takes memory for its bars only, and the part of a
/// curve on the square grid before it is skipped; off the grid, and where phrases begin at bar lines or with rhythms
/// of their own, or `leaps` are limited, the curve is walked to the window. Scores whose notes depend on later ones
/// (retrograde, forms, loops, strict parts, branches as voices, words with parameters, chance or contexts) are held
/// in memory, with at most 4,000,000 notes. If curves of expression need the least and greatest values of their
/// sources, the score is played once in advance, unless the fold provides them. `monitor` also stops the reading of
/// windows.
/// @throws as plan_score(); ScoreError if the score has no notes
std::unique_ptr<NoteStream> stream_notes(std::span<const Document> documents, const OptionValues& values,
                                         const Monitor& monitor = {}, const std::filesystem::path& folder = {});
std::unique_ptr<NoteStream> stream_notes(const Arrangement& arrangement, const OptionValues& values,
                                         const Monitor& monitor = {}, const std::filesystem::path& folder = {});

struct Ensemble;
struct PlayOptions;

/// Contents and options of a streamed score.
struct StreamedScore {
    ScoreHead head;
    MidiOptions midi;
    Human human;
};

/// Streams a piece of an ensemble. @throws ScoreError if it has no notes
std::unique_ptr<NoteStream> stream_notes(StreamedScore score, Ensemble ensemble, const PlayOptions& playing);

}  // namespace sikku
