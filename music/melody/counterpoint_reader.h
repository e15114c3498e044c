// music/melody/counterpoint_reader.h: reads a curve as two voices.
#pragma once

#include "music/melody/reader.h"

namespace sikku::mapping {

/// Reads two voices: notes of one last while y stays the same, those of the other, an octave lower, while x does.
template <class Walk>
class CounterpointReader final : public Reader {
public:
    /// `grammar`, `melody`, `marks`, `emitter` and `options` have to outlive it.
    CounterpointReader(const Grammar& grammar, const Lattice& lattice, int first, const Melody& melody,
                       const Marks& marks, Emitter& emitter, Origin origin, const PlayOptions& options)
        : grammar_(grammar),
          marks_(marks),
          melody_(melody),
          emitter_(emitter),
          options_(options),
          walk_(grammar, lattice, first),
          clock_(melody),
          lower_(static_cast<std::int64_t>(melody.scale.size())),
          is_piece_(melody.anchor == Anchor::piece),
          moves_sound_(draws_nothing(grammar)),
          level_(marks.whole) {
        at_ = walk_.start;
        voices_[0].origin = origin.y == unknown ? 0 : origin.y;
        emitter_.take(voices_[0].line, 0);
        emitter_.take(voices_[1].line, 1);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            if (marks_.phrase == symbol) {
                ++due_;
                continue;
            }
            if (const int level = marks_.level(symbol)) {
                level_ = std::max(level_, level);
                continue;
            }
            ++position_;
            const Command& command = grammar_.symbols()[symbol].command;
            switch (const Kind kind = kind_of(command, moves_sound_)) {
                case Kind::draw:
                case Kind::move:
                    advance(walk_.step(at_, symbol), kind == Kind::draw);
                    break;
                case Kind::turn:
                    walk_.turn(at_, symbol);
                    turned_ = sign_of(command.angle);
                    break;
                case Kind::open:
                    stack_.open(at_, position_);
                    break;
                case Kind::close:
                    at_ = stack_.close(position_);
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::mark:
                case Kind::level:
                case Kind::nothing:
                    break;
            }
        }
        if (!Walk::in_range(at_) || time_ >= farthest) {
            throw WordError("the turtle leaves the range of its coordinates");
        }
    }

    void finish() override {
        stack_.require_closed();
        for (Voice& voice : voices_) end_note(voice);
        const std::int64_t last = ticks(time_);
        end_last_phrases(clock_, emitter_, due_, time_);
        emitter_.finish(last);
    }

    bool skip(const GridStretch& stretch) override {
        if constexpr (std::is_same_v<Walk, GridWalk>) {
            const Integer length = stretch.length[0] + stretch.length[1];
            const std::int64_t room = clock_.steps_before(options_.from, stretch.marks + due_) - margin_units - time_;
            if (room < 0 || length > room) return false;
            for (Voice& voice : voices_) end_note(voice);
            end_phrases();
            clock_.breathe(stretch.marks, time_);
            is_counted_ = false;
            level_ = 0;  // known from the mark after the stretch
            walk_.skip(at_, stretch);
            here_ = point();
            time_ += length.convert_to<std::int64_t>();
            return true;
        } else {
            (void)stretch;
            return false;
        }
    }

    std::int64_t lowest_vertex() const override { return Walk::degree(2 * lowest_); }
    std::int64_t highest_vertex() const override { return Walk::degree(2 * highest_); }
    std::int64_t lowest_degree() const override { return lowest_degree_; }

private:
    using Number = typename Walk::Number;
    struct Voice {
        std::int64_t origin = 0;          // doubled
        std::int64_t sounding = unknown;  // its height, in whole steps
        Number onset = 0;
        int turned = 0;
        std::uint64_t symbol = 0;
        int level = 0;
        glm::dvec2 from{0.0};
        Emitter::Line line;
    };

    std::int64_t ticks(Number steps) const { return clock_.ticks(steps); }

    /// Ends the phrases of both voices, which breathe together.
    void end_phrases() {
        if (due_ == 0) return;
        for (Voice& voice : voices_) end_note(voice);
        emitter_.end_phrase(0, clock_.is_odd());
        emitter_.end_phrase(1, clock_.is_odd());
        clock_.breathe(due_, time_);
        emitter_.begin_phrase(ticks(time_));
        due_ = 0;
    }
    glm::dvec2 point() const { return {static_cast<double>(at_.x), static_cast<double>(at_.y)}; }

    /// Moves the turtle; the note of its new position sounds during this step.
    void advance(const typename Walk::Step& step, bool is_drawn) {
        end_phrases();
        at_.x += step.x;
        at_.y += step.y;
        lowest_ = std::min(lowest_, at_.y);
        highest_ = std::max(highest_, at_.y);
        const Number length = Walk::length(step);
        if (is_piece_ && ticks(time_ + length) > options_.from) {
            voices_[0].origin = 2 * Walk::degree(2 * at_.y);
            voices_[1].origin = 2 * Walk::degree(2 * at_.x);
            is_piece_ = false;
        }
        for (Voice& voice : voices_) {
            const bool is_upper = &voice == &voices_[0];
            const std::int64_t height = is_drawn ? Walk::degree(2 * (is_upper ? at_.y : at_.x)) : unknown;
            if (height == voice.sounding) continue;
            end_note(voice);
            voice.sounding = height;
            voice.onset = time_;
            voice.symbol = is_counted_ ? position_ : 0;
            voice.level = level_;
            voice.turned = turned_;
            // A note is shown where its coordinate stays the same.
            voice.from = Walk::is_level(is_upper ? step.y : step.x) ? here_ : point();
            if (is_drawn && is_upper) {
                lowest_degree_ = std::min(lowest_degree_ == unknown ? farthest : lowest_degree_, height);
            }
        }
        level_ = 0;
        time_ += length;
        here_ = point();
        if (ticks(time_) < options_.to || !is_past_piece()) return;
        for (Voice& voice : voices_) end_note(voice);
        throw Enough();
    }

    /// True if no note of the piece is held back.
    bool is_past_piece() const {
        if (!emitter_.is_shaped()) return true;
        const bool is_held = std::any_of(voices_.begin(), voices_.end(), [&](const Voice& voice) {
            return voice.sounding != unknown && ticks(voice.onset) < options_.to;
        });
        return !is_held && emitter_.may_stop(ticks(time_));
    }

    void end_note(Voice& voice) {
        if (voice.sounding == unknown) return;
        const bool is_upper = &voice == &voices_[0];
        const int loud = loudness(melody_, voice.turned, static_cast<double>(time_ - voice.onset), stack_.depth(),
                                  ticks(voice.onset));
        emitter_.level = voice.level;
        emitter_.emphasis.is_accented = clock_.is_accented(voice.onset);
        emitter_.note(voice.line, voice.sounding - voice.origin / 2 - (is_upper ? 0 : lower_), ticks(voice.onset),
                      clock_.end_ticks(time_), loud + (is_upper ? 8 : -8), voice.from, here_, voice.symbol);
        voice.sounding = unknown;
    }

    const Grammar& grammar_;
    const Marks& marks_;
    const Melody& melody_;
    Emitter& emitter_;
    const PlayOptions& options_;
    Walk walk_;
    Clock<Walk> clock_;
    std::int64_t lower_;
    bool is_piece_;     ///< its tonic is not known yet
    bool moves_sound_;  // nothing is drawn: moves are notes
    int level_;         // level of notes that begin with the next step
    typename Walk::Position at_;
    glm::dvec2 here_{0.0};
    Brackets<typename Walk::Position> stack_;
    std::array<Voice, 2> voices_;
    Number time_ = 0;
    int due_ = 0;  // phrases that end before the next step
    int turned_ = 0;
    std::uint64_t position_ = 0;
    bool is_counted_ = true;  // nothing was skipped
    Number lowest_ = 0;
    Number highest_ = 0;
    std::int64_t lowest_degree_ = unknown;
};

}  // namespace sikku::mapping
