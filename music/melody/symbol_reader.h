// music/melody/symbol_reader.h: reads the symbols of a word as notes.
#pragma once

#include "music/melody/reader.h"

namespace sikku::mapping {

/// The word itself, symbol by symbol.
class SymbolReader final : public Reader {
public:
    SymbolReader(const Grammar& grammar, const Melody& melody, Emitter& emitter, const PlayOptions& options,
                 bool has_brackets)
        : grammar_(grammar),
          melody_(melody),
          emitter_(emitter),
          options_(options),
          may_stop_(!has_brackets),
          origin_(melody.anchor == Anchor::piece ? unknown : 0) {
        emitter_.take(state_.line, 0);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            ++position_;
            const SymbolInfo& info = grammar_.symbols()[symbol];
            const Command& command = info.command;
            switch (kind_of(command)) {
                case Kind::draw:
                    sound(std::fabs(command.value));
                    break;
                case Kind::move:
                    end_note();
                    state_.time += std::fabs(command.value);
                    stop_if_done();
                    break;
                case Kind::turn:
                    if (info.letter == "+") ++state_.degree;
                    if (info.letter == "-") --state_.degree;
                    state_.turned = sign_of(command.angle);
                    break;
                case Kind::open:
                    // The stem's note goes on through its branches.
                    stack_.open(state_, position_);
                    state_.sounding = unknown;
                    state_.line = {};
                    break;
                case Kind::close:
                    end_note();
                    emitter_.release(state_.line);
                    state_ = stack_.close(position_);
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::nothing:
                    break;
            }
        }
    }

    void finish() override {
        stack_.require_closed();
        end_note();
        emitter_.finish(ticks(state_.time));
    }

    bool skip(const GridStretch& stretch) override {
        const Integer length = stretch.length[0] + stretch.length[1];
        const std::int64_t units = options_.from / melody_.unit - margin_units;
        const double room = static_cast<double>(units) - state_.time;
        if (room < 0 || length > Integer(room) || abs(stretch.rise) >= farthest) return false;
        end_note();
        is_counted_ = false;
        state_.time += length.convert_to<double>();
        state_.degree += stretch.rise.convert_to<std::int64_t>();
        return true;
    }

private:
    struct State {
        double time = 0;
        double onset = 0;
        std::int64_t degree = 0;
        std::int64_t sounding = unknown;
        int turned = 0;
        std::uint64_t symbol = 0;
        Emitter::Line line;
    };

    std::int64_t ticks(double steps) const { return PlaneWalk::ticks(steps, melody_.unit); }

    /// Equal symbols side by side are one long note, unless each step is to be heard.
    void sound(double length) {
        if (state_.sounding != state_.degree || melody_.runs == Runs::each_step) {
            end_note();
            state_.sounding = state_.degree;
            state_.onset = state_.time;
            state_.symbol = is_counted_ ? position_ : 0;
        }
        state_.time += length;
        if (may_stop_ && ticks(state_.time) >= options_.to) end_note();
        stop_if_done();
    }

    void end_note() {
        if (state_.sounding == unknown) return;
        if (origin_ == unknown && ticks(state_.time) > options_.from) origin_ = state_.sounding;
        if (origin_ != unknown) {
            const auto height = static_cast<double>(state_.sounding);
            const int velocity =
                loudness(melody_, state_.turned, state_.time - state_.onset, stack_.depth(), ticks(state_.onset));
            emitter_.note(state_.line, state_.sounding - origin_, ticks(state_.onset), ticks(state_.time), velocity,
                          {state_.onset, height}, {state_.time, height}, state_.symbol);
        }
        state_.sounding = unknown;
    }

    void stop_if_done() const {
        if (may_stop_ && ticks(state_.time) >= options_.to) throw Enough();
    }

    const Grammar& grammar_;
    const Melody& melody_;
    Emitter& emitter_;
    const PlayOptions& options_;
    bool may_stop_;
    std::int64_t origin_;
    State state_;
    Brackets<State> stack_;
    std::uint64_t position_ = 0;
    bool is_counted_ = true;  // nothing was skipped
};

}  // namespace sikku::mapping
