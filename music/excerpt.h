// music/excerpt.h: some bars of a score as they are within the whole.
#pragma once

#include "music/ensemble.h"
#include "music/score/curves.h"
#include "music/score/unisons.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sikku {

/// The part of a score to play so that an excerpt sounds as it does within the whole.
struct ExcerptContext {
    PlayOptions playing;
    bool is_whole = true;  ///< otherwise some bars before and after the excerpt
};

/// Number of symbols that take about a second to derive and play.
constexpr double soon_played = 2e6;

/// True if a whole score is derived from up to `most` symbols.
bool is_soon_played(const Ensemble& ensemble, double most = soon_played);

/// True if excerpts sound as in the whole only if more is played than their bars.
bool depends_on_whole(const Ensemble& ensemble);

/// The same parts without `excerpt`.
Ensemble without_excerpts(Ensemble ensemble);

/// The context of an excerpt: the whole score if it is soon played, otherwise some bars.
ExcerptContext context_of(const Ensemble& ensemble, const PlayOptions& excerpt, double most_symbols = soon_played);
/// The bars around an excerpt, from a bar line on.
ExcerptContext bars_around(const Ensemble& ensemble, const PlayOptions& excerpt);

/// An ensemble whose melodies begin where those of an excerpt do, even if more is played: it replaces `anchor: piece`
/// by the height of the first note of the excerpt.
Ensemble with_fixed_anchors(Ensemble ensemble, const PlayOptions& excerpt);

/// The changes of tempo between two ticks, counted from the first; one applies at its beginning, unless there are
/// none.
std::vector<TempoPoint> cut_tempo(std::span<const TempoPoint> tempo, std::int64_t from, std::int64_t to);

/// Forwards what sounds between two ticks, counted from the first: notes are cut at both ends, and controllers begin
/// with the values in effect. Curves are ignored, see cut_tempo(). Memory: O(voices).
class ExcerptSink : public NoteSink {
public:
    /// @param before  receives the notes that begin before the excerpt; can be null
    ExcerptSink(NoteSink& sink, std::int64_t from, std::int64_t to, LastStrokes* before = nullptr)
        : sink_(sink), from_(from), to_(to), before_(before) {}
    void controls(std::span<const ControlPoint> points) override;
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override;
    /// Number of notes forwarded, and their least and greatest keys.
    std::uint64_t count() const { return count_; }
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

private:
    struct Voice {
        std::vector<ControlPoint> coming;  // points of the notes to come
        std::map<int, double> before;      // values before the excerpt, by number, until its first note
    };
    void pass_controls(Voice& voice, const Note& note);

    NoteSink& sink_;
    std::int64_t from_;
    std::int64_t to_;
    LastStrokes* before_;
    std::vector<Voice> voices_;
    std::uint64_t count_ = 0;
    double lowest_ = 127;
    double highest_ = 0;
    std::vector<Note> cut_;
    std::vector<ControlPoint> points_;
};

}  // namespace sikku
