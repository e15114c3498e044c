// music/melody/clock.h: the ticks at which steps of a melody begin and end.
#pragma once

#include "engine/base/chance.h"
#include "music/melody/melody.h"
#include "music/melody/walks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace sikku::mapping {

/// Converts times in steps to ticks: by the unit or the slots of a rhythm, delayed by the breaths taken before.
template <class Walk>
class Clock {
public:
    using Number = typename Walk::Number;
    explicit Clock(const Melody& melody)
        : melody_(melody), rhythm_(&melody.rhythm), has_rhythm_(!melody.rhythm.empty()), breaths_(melody.lead()) {}

    std::int64_t ticks(Number steps) const {
        if (has_rhythm_) return slot_ticks(steps - begin_, false) + breaths_;
        return Walk::ticks(steps - begin_, melody_.unit) + breaths_;
    }
    /// The tick at which a note that lasts until `steps` ends.
    std::int64_t end_ticks(Number steps) const {
        return has_rhythm_ ? slot_ticks(steps - begin_, true) + breaths_ : ticks(steps);
    }
    /// Maximum duration of a number of steps and phrases, in ticks.
    Integer longest(const Integer& steps, const Integer& phrases) const {
        return (steps / hits() + 1) * cycle() + phrases * melody_.breath + melody_.lead();
    }
    /// Advances by a number of steps and phrases, which do not begin at bar lines, and subtracts as many of their
    /// ticks from `ahead` as possible: later notes come that much earlier, on the same hits of the rhythm.
    /// @param time  in steps
    /// @return the time that follows it, in steps
    std::int64_t skip(std::int64_t time, const Integer& steps, const Integer& phrases, Integer& ahead) {
        Integer end = time + steps;
        const Integer lasts = exact_ticks(end) - exact_ticks(time) + phrases * melody_.breath;
        const Integer taken = std::min(lasts, ahead);
        ahead -= taken;
        // Whole cycles are subtracted from the steps, the rest from the breaths.
        Integer breaths = breaths_ + phrases * melody_.breath - taken;
        if (breaths < 0) {
            const Integer cycles = std::min<Integer>((cycle() - 1 - breaths) / cycle(), end / hits());
            end -= cycles * hits();
            breaths += cycles * cycle();
        }
        breaths_ = breaths.convert_to<std::int64_t>();
        phrases_ += (phrases & 1).convert_to<int>();
        return end.convert_to<std::int64_t>();
    }
    Stress stress(Number steps) const { return has_rhythm_ ? hit(steps).stress : Stress::plain; }
    /// False if chance silences the note that begins with a step: the same in an excerpt as in the whole, and in all
    /// augmentations.
    /// @param before  as PlayOptions::ahead
    bool sounds(Number steps, std::uint64_t seed, const Integer& before) const {
        if (!has_rhythm_ || hit(steps).percent == 100) return true;
        const Integer slot = (before + ticks(steps)) / melody_.unit;
        const auto place = Integer(slot & UINT64_MAX).convert_to<std::uint64_t>();
        return axiom_place(seed, place) % 100 < hit(steps).percent;
    }
    /// Number of steps that certainly begin before `tick`, with the breaths of `phrases` still to come.
    /// @return below 0 if none
    std::int64_t steps_before(std::int64_t tick, const Integer& phrases) const {
        const Integer left = Integer(tick) - breaths_ - phrases * melody_.breath;
        if (left < 0) return -1;
        const auto room = left.convert_to<std::int64_t>();
        if (!has_rhythm_) return room / melody_.unit;
        const auto hits = static_cast<std::int64_t>(rhythm_->hits.size());
        return room / (rhythm_->slots * melody_.unit) * hits - hits;
    }
    /// Adds rests after phrases.
    /// @param steps  end of the last one
    /// @param above  orders by which the largest sub-curve that ends with them is larger than a phrase
    void breathe(const Integer& phrases, Number steps, int above = 0) {
        phrases_ += (phrases & 1).convert_to<int>();
        const std::int64_t breath = melody_.breath * (melody_.breathes_by_level ? 1 + above : 1);
        if (!melody_.restarts_rhythm()) {
            breaths_ += (phrases * breath).convert_to<std::int64_t>();
            return;
        }
        // The next phrase begins with its rhythm, and can begin at a bar line or with its upbeat.
        const std::int64_t bar = melody_.breathes_to_bar ? melody_.meter.bar() : 1;
        std::int64_t end = end_ticks(steps) + breath;
        // Without a bar line, rests of the rhythm before its next note count.
        if (!melody_.breathes_to_bar) end = std::max(end, ticks(steps));
        const std::int64_t lead = melody_.lead();
        breaths_ = (end - lead + bar - 1) / bar * bar + lead;
        begin_ = steps;
        if (melody_.rhythms.empty()) return;
        if (melody_.has_rhythms_by_level) return choose_rhythm(above);
        rhythm_number_ =
            Integer((rhythm_number_ + phrases) % melody_.rhythms.size()).template convert_to<std::size_t>();
        rhythm_ = &melody_.rhythms[rhythm_number_];
    }
    /// Takes the rhythm of a phrase that begins a sub-curve larger by some orders.
    void choose_rhythm(int above) {
        if (!melody_.has_rhythms_by_level || melody_.rhythms.empty()) return;
        const auto last = static_cast<int>(melody_.rhythms.size()) - 1;
        rhythm_ = &melody_.rhythms[static_cast<std::size_t>(std::clamp(above, 0, last))];
    }
    /// True if an odd number of phrases has ended.
    bool is_odd() const { return phrases_ % 2 != 0; }

private:
    const RhythmTemplate::Hit& hit(Number steps) const { return rhythm_->hit(index_of(steps - begin_)); }
    /// The whole number of steps, which sums of lengths may miss slightly.
    static std::int64_t index_of(Number steps) {
        if constexpr (std::is_floating_point_v<Number>) {
            return static_cast<std::int64_t>(std::floor(static_cast<double>(steps) + 1e-6));
        } else {
            return static_cast<std::int64_t>(steps);
        }
    }
    /// Steps in a cycle of the rhythm; cycle() is its duration in ticks.
    Integer hits() const { return has_rhythm_ ? Integer(rhythm_->hits.size()) : Integer(1); }
    Integer cycle() const { return Integer(has_rhythm_ ? rhythm_->slots : 1) * melody_.unit; }
    Integer exact_ticks(const Integer& steps) const {
        const auto index = Integer(steps % hits()).convert_to<std::int64_t>();
        const std::int64_t onset = has_rhythm_ ? rhythm_->onset(index) : 0;
        return steps / hits() * cycle() + Integer(onset) * melody_.unit;
    }

    std::int64_t slot_ticks(Number steps, bool is_end) const {
        const std::int64_t index = index_of(steps);
        const RhythmTemplate& rhythm = *rhythm_;
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
    const RhythmTemplate* rhythm_;  // of the phrase
    std::size_t rhythm_number_ = 0;
    bool has_rhythm_;
    std::int64_t breaths_;  // ticks of rests so far, including that before an upbeat
    Number begin_ = 0;      // step from which times count: the start of the phrase if it begins at a bar line
    int phrases_ = 0;
};

}  // namespace sikku::mapping
