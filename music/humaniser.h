// music/humaniser.h: small deviations from exact onsets and velocities.
#pragma once

#include "engine/base/chance.h"
#include "music/score/score.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Makes notes begin slightly late and sound slightly louder or softer, like a player's; their ends stay.
class Humaniser : public NoteSink {
public:
    static constexpr std::int64_t latest = 60;  ///< greatest delay of a note, in ticks
    /// @param amount  0 to 1: share of 60 ticks, and of 24 steps of velocity
    /// @param from    ticks of the score before the piece, which then sounds as in the whole, except for notes that
    ///                its edges cut
    Humaniser(NoteSink& sink, double amount, std::uint64_t seed, std::int64_t from)
        : sink_(sink), amount_(amount), seed_(seed), from_(from) {}
    void curves(const Curves& curves) override { sink_.curves(curves); }
    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override {
        changed_.assign(notes.begin(), notes.end());
        for (Note& note : changed_) {
            const std::uint64_t chance = next(seed_ ^ next(static_cast<std::uint64_t>(from_ + note.onset) * 16 +
                                                           static_cast<std::uint64_t>(note.voice)));
            const double late = static_cast<double>(chance >> 40) / 0x1p24;
            const double loud = static_cast<double>(chance & 0xFFFFFF) / 0x1p24 - 0.5;
            const auto delay = std::min(static_cast<std::int64_t>(late * amount_ * latest), note.duration / 4);
            note.onset += delay;
            note.duration -= delay;
            note.glide.ticks = std::min(note.glide.ticks, note.duration);
            note.velocity = static_cast<std::uint8_t>(
                std::clamp(static_cast<int>(note.velocity) + static_cast<int>(loud * amount_ * 24), 1, 127));
        }
        sink_.notes(changed_);
    }
    void finish(std::int64_t end) override { sink_.finish(end); }

private:
    /// Source: Steele, Lea and Flood 2014, SplitMix64.
    static std::uint64_t next(std::uint64_t value) { return scrambled(value + 0x9E3779B97F4A7C15); }
    NoteSink& sink_;
    double amount_;
    std::uint64_t seed_;
    std::int64_t from_;
    std::vector<Note> changed_;
};

}  // namespace sikku
