// music/performance.h: applies the keys of expression of a score to its notes.
#pragma once

#include "music/ensemble.h"
#include "music/gamakas.h"
#include "music/score/curves.h"
#include "music/score/unisons.h"
#include "music/tempo_curve.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Sets the velocities of notes by the curve and forwards them after their points of pan, controllers and gamakas;
/// the tempo comes first. The parts are played twice: before write_to() for the least and greatest values of their
/// sources and for the tempo, after it for the notes. The tempo follows the first part. Memory: O(voices), and as
/// TempoCurve if there is a tempo.
class ExpressionSink : public NoteSink {
public:
    enum class Use {
        performance,
        print,  ///< only velocities and slides
        pieces  ///< a performance in pieces, each with its own sink
    };

    /// `ensemble` has to outlive it.
    ExpressionSink(const Ensemble& ensemble, Use use);
    /// A sink for a piece of the score that `measured` has received, with its ranges. tempos() returns the tempo of
    /// the piece.
    ExpressionSink(const ExpressionSink& measured, NoteSink& sink);

    /// Takes the ranges of positions on whole curves from the fold where it is known.
    void fold_ranges();
    /// Takes the ranges that another sink has received, of an ensemble with the same players and curves.
    void take_ranges(const ExpressionSink& other);
    /// True if the parts have to be played once before write_to().
    bool needs_ranges() const;
    /// True if it takes ranges from the notes that it receives then.
    bool measures_ranges() const;
    /// @throws ScoreError for a score that is too long for a curve of its tempo; exceptions of the sink
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override;
    /// Passes the notes that follow to this sink.
    void write_to(NoteSink& sink);

    /// The curve of the tempo, after write_to(); tempos() returns that of the notes so far, in a piece until `end`.
    const std::vector<TempoPoint>& tempo() const { return curves_.tempo; }
    std::vector<TempoPoint> tempos(std::int64_t end) const;

private:
    /// A curve of a player.
    struct Followed {
        ExpressionCurve curve;
        int number;  ///< number of the controller, or one of the constants below
        SourceRange range;
        bool is_known;  ///< the range need not be measured
    };
    static constexpr int velocity = -1;
    static constexpr int tempo_number = -2;
    /// The state of a voice.
    struct Line {
        std::size_t player = 0;
        bool is_bent = false;
        std::optional<Note> before;            ///< the note before, if a curve follows turns
        std::vector<std::optional<int>> last;  ///< values of the controllers
        struct Held {
            Note note;
            std::vector<ControlPoint> points;
        };
        std::vector<Held> held;  ///< the last two notes, if the next ones may bend them
    };

    Line& line_of(int voice);
    void measure(Line& line, const Note& note);
    void express(Line& line, Note& note, std::vector<ControlPoint>& points);
    void hold(Line& line, const Note& note);
    void bend(Line& line, const Note* after);
    void release(Line& line);
    void hand_on();

    const Ensemble& ensemble_;
    Use use_;
    NoteSink* sink_ = nullptr;
    std::vector<std::vector<Followed>> followed_;  // by player
    std::vector<char> has_turns_;                  // by player
    std::vector<std::optional<Bender>> benders_;   // by player
    std::vector<std::optional<Line>> lines_;       // by voice
    std::optional<TempoCurve> tempo_;              // until the tempo is known
    std::int64_t end_ = 0;
    Curves curves_;  // only the tempo
    std::vector<Note> changed_;
    std::vector<ControlPoint> points_;
    std::vector<ControlPoint> bends_;
};

/// Deviations of a player from exact onsets and velocities.
struct Human {
    double amount = 0;  ///< 0 to 1; 0: none
    std::uint64_t seed = 0;
};

/// Plays all parts with their expression and the deviations of a player into `sink`. An excerpt has the velocities,
/// controllers, tempo and held notes that it has within the whole (see context_of()), and the ending of the whole
/// only as far as it contains it, unless Ensemble::ends_excerpts. The seconds of the report include all changes of
/// tempo.
/// @param before  receives the notes before an excerpt whose unisons are merged; can be null
/// @throws as play_all()
EnsembleReport perform(const Ensemble& ensemble, const PlayOptions& playing, ExpressionSink::Use use,
                       const Human& human, NoteSink& sink, LastStrokes* before = nullptr);

/// Plays a score as it is, an excerpt without its context.
EnsembleReport perform_all(const Ensemble& ensemble, const PlayOptions& playing, ExpressionSink::Use use,
                           const Human& human, NoteSink& sink);

/// Seconds until a tick of a score, with all changes of tempo. @param curve  the tempo that follows the curve, and in
/// an excerpt the end of the whole
double seconds_of(const Ensemble& ensemble, const PlayOptions& playing, std::int64_t end, ExpressionSink::Use use,
                  const std::vector<TempoPoint>& curve = {});

}  // namespace sikku
