// music/performance.h: adds to the notes of a score what its keys of expression say.
#pragma once

#include "music/ensemble.h"
#include "music/score/curves.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Collects all notes, changes their velocities, makes the curves of tempo, pan, controllers and pitch, and hands all
/// on. Sources are measured from their least to their greatest value in the notes of a part. The tempo follows the
/// first part, beat by beat and smoothed. Memory: O(notes and points).
class PerformanceSink : public NoteSink {
public:
    /// Largest number of notes, and of points of curves.
    static constexpr std::size_t most = 4'000'000;

    /// @param is_printed  velocities alone
    /// `sink`, `ensemble` and `playing` have to outlive it.
    PerformanceSink(NoteSink& sink, const Ensemble& ensemble, const PlayOptions& playing, bool is_printed);

    /// @throws ScoreError for too many notes
    void notes(std::span<const Note> notes) override;
    /// @throws ScoreError for too many points; as play() where a source is the level
    void finish(std::int64_t end) override;

    /// The curves of what has been played.
    const Curves& made() const { return curves_; }

private:
    void express(const Player& player, std::vector<Note*>& notes);
    void bend(const Player& player, const std::vector<Note*>& notes);
    void add_tempo(const Player& player, const std::vector<Note*>& notes, const std::vector<double>& parts,
                   std::int64_t end);

    NoteSink& sink_;
    const Ensemble& ensemble_;
    const PlayOptions& playing_;
    bool is_printed_;
    std::vector<Note> notes_;
    std::int64_t end_ = 0;
    Curves curves_;
};

/// True if nothing but velocities, and pan and controllers `with_controls`, follows the curve, by sources that are
/// known note by note.
bool streams_expression(const Ensemble& ensemble, bool with_controls);

/// Gives notes the velocities of the curve as they pass, and hands on the points of pan and controllers before them,
/// the same as PerformanceSink. The parts are played twice: before write_to() for the least and greatest values,
/// after it for the notes. Memory: O(voices).
class ExpressionSink : public NoteSink {
public:
    /// @param is_printed  velocities alone
    /// `ensemble` has to outlive it.
    ExpressionSink(const Ensemble& ensemble, bool is_printed);
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override {
        if (sink_) sink_->finish(end);
    }
    /// The notes that follow go to this sink.
    void write_to(NoteSink& sink);

private:
    /// A curve of a player, from the least to the greatest value of its source.
    struct Followed {
        ExpressionCurve curve;
        int number;  ///< of the controller, or `velocity`
        double low;
        double high;
    };
    static constexpr int velocity = -1;
    struct Line {
        std::optional<Note> before;            ///< where turns are wanted
        std::vector<std::optional<int>> last;  ///< values of the controllers
    };

    std::size_t player_of(int voice) const;
    void express(std::vector<Followed>& curves, Line& line, const Note& note, std::size_t index);

    const Ensemble& ensemble_;
    NoteSink* sink_ = nullptr;
    std::vector<std::vector<Followed>> followed_;  // by player
    std::vector<char> has_turns_;                  // by player
    std::vector<Line> lines_;                      // by voice
    std::vector<Note> changed_;
    std::vector<ControlPoint> points_;
};

}  // namespace sikku
