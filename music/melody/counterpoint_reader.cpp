#include "music/melody/reader.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace sikku::mapping {
namespace {

/// Reads two voices: notes of one last while y stays the same, those of the other, an octave lower, while x does.
template <class Walk>
class CounterpointReader final : public CurveReader<Walk> {
    using Base = CurveReader<Walk>;
    using Base::clock_, Base::due_, Base::emitter_, Base::grammar_, Base::is_counted_, Base::kinds_, Base::marks_;
    using Base::melody_, Base::options_, Base::position_, Base::walk_;
    using Base::ticks, Base::point, Base::advance, Base::note_vertex, Base::note_degree;
    using typename Base::Number, typename Base::Position, typename Base::Step;

public:
    explicit CounterpointReader(const Reading& reading)
        : Base(reading),
          lower_(static_cast<std::int64_t>(melody_.scale.size())),
          is_piece_(melody_.anchor == Anchor::piece),
          level_(marks_.whole) {
        at_ = walk_.start;
        voices_[0].origin = reading.origin.y == unknown ? 0 : reading.origin.y;
        emitter_.take(voices_[0].line, 0);
        emitter_.take(voices_[1].line, 1);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            const Kind kind = kinds_[symbol];
            if (kind != Kind::mark && kind != Kind::level) ++position_;
            switch (kind) {
                case Kind::draw:
                case Kind::move:
                    step(walk_.step(at_, symbol), kind == Kind::draw);
                    break;
                case Kind::turn:
                    walk_.turn(at_, symbol);
                    turned_ = sign_of(grammar_.symbols()[symbol].command.angle);
                    break;
                case Kind::open:
                    stack_.open(at_, position_);
                    break;
                case Kind::close:
                    at_ = stack_.close(position_);
                    break;
                case Kind::mark:
                    ++due_;
                    break;
                case Kind::level:
                    level_ = std::max(level_, marks_.level(symbol));
                    this->end_level(marks_.level(symbol));
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
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
        this->finish_at(time_, ticks(time_), due_);
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
            emitter_.skip();
            here_ = point(at_);
            time_ += length.convert_to<std::int64_t>();
            return true;
        } else {
            (void)stretch;
            return false;
        }
    }

private:
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

    /// Ends the phrases of both voices, which breathe together.
    void end_phrases() {
        if (due_ == 0) return;
        for (Voice& voice : voices_) end_note(voice);
        Base::end_phrases(2, time_);
    }

    /// Moves the turtle; the note of its new position sounds during this step.
    void step(const Step& step, bool is_drawn) {
        end_phrases();
        this->begin_note();
        advance(at_, step);
        note_vertex(at_);
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
            voice.symbol = this->counted(position_);
            voice.level = level_;
            voice.turned = turned_;
            // A note is shown where its coordinate stays the same.
            voice.from = Walk::is_level(is_upper ? step.y : step.x) ? here_ : point(at_);
            if (is_drawn && is_upper) note_degree(height);
        }
        level_ = 0;
        time_ += length;
        here_ = point(at_);
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
        const std::int64_t degree = voice.sounding - voice.origin / 2 - (is_upper ? 0 : lower_);
        const Sound sound{loud + (is_upper ? 8 : -8), voice.level, voice.from, here_, voice.symbol};
        emitter_.note(voice.line, this->draft_of(degree, voice.onset, time_, sound));
        voice.sounding = unknown;
    }

    std::int64_t lower_;
    bool is_piece_;  ///< its tonic is not known yet
    int level_;      // level of notes that begin with the next step
    Position at_;
    glm::dvec2 here_{0.0};
    Brackets<Position> stack_;
    std::array<Voice, 2> voices_;
    Number time_ = 0;
    int turned_ = 0;
};

}  // namespace

std::unique_ptr<Reader> read_counterpoint(const Reading& reading) {
    if (reading.is_on_grid) return std::make_unique<CounterpointReader<GridWalk>>(reading);
    return std::make_unique<CounterpointReader<PlaneWalk>>(reading);
}

}  // namespace sikku::mapping
