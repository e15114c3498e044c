// music/melody/clock.h: the ticks at which steps of a melody begin and end.
#pragma once

#include "music/melody/melody.h"
#include "music/melody/walks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace sikku::mapping {

/// Times in steps become ticks: by the unit, by the slots of a rhythm, and later by the breaths taken before.
template <class Walk>
class Clock {
public:
    using Number = typename Walk::Number;
    explicit Clock(const Melody& melody) : melody_(melody), has_rhythm_(!melody.rhythm.empty()) {}

    std::int64_t ticks(Number steps) const {
        if (has_rhythm_) return slot_ticks(steps - begin_, false) + breaths_;
        return Walk::ticks(steps - begin_, melody_.unit) + breaths_;
    }
    /// The tick at which a note ends that goes on until `steps`.
    std::int64_t end_ticks(Number steps) const {
        return has_rhythm_ ? slot_ticks(steps - begin_, true) + breaths_ : ticks(steps);
    }
    /// The steps of so many ticks, a multiple of period().
    Integer steps(const Integer& ticks) const {
        const Integer slots = ticks / melody_.unit;
        return has_rhythm_ ? slots / melody_.rhythm.slots * melody_.rhythm.hits.size() : slots;
    }
    bool is_accented(Number steps) const {
        return has_rhythm_ && melody_.rhythm.hit(static_cast<std::int64_t>(steps - begin_)).is_accented;
    }
    /// The steps that have surely begun before `tick`, with so many breaths still to come.
    /// @return below 0 if none
    std::int64_t steps_before(std::int64_t tick, const Integer& phrases) const {
        const Integer left = Integer(tick) - breaths_ - phrases * melody_.breath;
        if (left < 0) return -1;
        const auto room = left.convert_to<std::int64_t>();
        if (!has_rhythm_) return room / melody_.unit;
        const auto hits = static_cast<std::int64_t>(melody_.rhythm.hits.size());
        return room / (melody_.rhythm.slots * melody_.unit) * hits - hits;
    }
    /// Phrases have ended. @param steps  where the last one did
    void breathe(const Integer& phrases, Number steps) {
        phrases_ += (phrases & 1).convert_to<int>();
        if (!melody_.breathes_to_bar) {
            breaths_ += (phrases * melody_.breath).convert_to<std::int64_t>();
            return;
        }
        // The next phrase begins with the rhythm, at a bar line.
        const std::int64_t bar = melody_.meter.bar();
        breaths_ = (end_ticks(steps) + melody_.breath + bar - 1) / bar * bar;
        begin_ = steps;
    }
    /// Whether an odd number of phrases has ended.
    bool is_odd() const { return phrases_ % 2 != 0; }

private:
    std::int64_t slot_ticks(Number steps, bool is_end) const {
        const auto whole = static_cast<std::int64_t>(std::floor(static_cast<double>(steps) + 1e-6));
        const auto index = std::is_floating_point_v<Number> ? whole : static_cast<std::int64_t>(steps);
        const RhythmTemplate& rhythm = melody_.rhythm;
        const double part = static_cast<double>(steps) - static_cast<double>(index);
        if (index >= farthest / (rhythm.slots + 1)) return latest;
        if (!std::is_floating_point_v<Number> || part < 1e-6) {
            return GridWalk::ticks(is_end ? rhythm.end(index) : rhythm.onset(index), melody_.unit);
        }
        const std::int64_t before = GridWalk::ticks(rhythm.onset(index), melody_.unit);
        const std::int64_t after = GridWalk::ticks(rhythm.onset(index + 1), melody_.unit);
        return before + std::llround(part * static_cast<double>(after - before));
    }

    const Melody& melody_;
    bool has_rhythm_;
    std::int64_t breaths_ = 0;  // ticks
    Number begin_ = 0;          // steps to which times are added, those of the phrase if it begins at a bar line
    int phrases_ = 0;
};

}  // namespace sikku::mapping
