// music/score/bar_lines.h: bar lines of a score whose meter may change.
#pragma once

#include "music/score/score.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sikku {

/// The bar lines of a score. Bars are counted from 0, and ticks from the beginning of the score or the excerpt. Each
/// lookup costs O(log changes). With an upbeat, the first bar begins before the score: places, lengths and begin()
/// are those of a full bar.
class BarLines {
public:
    /// Bars of one meter.
    BarLines(const Meter& meter = {});  // NOLINT(google-explicit-constructor): a meter is the common case
    /// Bars of the meters of a score. @param changes  ascending, at bar lines of the meters before them
    /// @param upbeat  ticks before the first bar line, less than a bar; 0: none
    BarLines(const Meter& meter, const std::vector<SectionChange>& changes, std::int64_t upbeat = 0);
    explicit BarLines(const ScoreHead& head) : BarLines(head.meter, head.changes, head.upbeat) {}

    /// The meter of the bar in which a tick lies.
    const Meter& meter(std::int64_t tick) const { return at(tick).meter; }
    /// The length of the bar in which a tick lies.
    std::int64_t length(std::int64_t tick) const { return at(tick).bar; }
    /// Ticks of the bar in which a tick lies that are part of the score: fewer than its length in an upbeat.
    std::int64_t written(std::int64_t tick) const { return end(tick) - std::max<std::int64_t>(0, begin(tick)); }
    /// The number of the bar in which a tick lies.
    std::int64_t number(std::int64_t tick) const;
    /// The printed number of a bar: from 1, or from 0 with an upbeat.
    std::int64_t printed_number(std::int64_t tick) const { return number(tick) + (upbeat() > 0 ? 0 : 1); }
    /// Ticks before the first bar line; 0 without an upbeat.
    std::int64_t upbeat() const { return stretches_.front().onset < 0 ? end(0) : 0; }
    /// The ticks at which this bar begins and ends.
    std::int64_t begin(std::int64_t tick) const { return tick - place(tick); }
    std::int64_t end(std::int64_t tick) const { return begin(tick) + length(tick); }
    /// Ticks from the beginning of the bar.
    std::int64_t place(std::int64_t tick) const {
        const Stretch& stretch = at(tick);
        return (tick - stretch.onset) % stretch.bar;
    }
    /// The first bar line at or after a tick; the beginning of the score counts as one.
    std::int64_t next(std::int64_t tick) const { return tick == 0 || place(tick) == 0 ? tick : end(tick); }
    /// The tick at which a bar begins in the score.
    std::int64_t onset(std::int64_t number) const;
    /// The same for a bar with a printed number; for earlier bars, the tick of the first bar.
    std::int64_t printed_onset(std::int64_t number) const {
        return onset(std::max<std::int64_t>(0, number - (upbeat() > 0 ? 0 : 1)));
    }
    /// The tick at which a score that ends at a tick can begin again: a bar line, or the upbeat before it.
    std::int64_t next_pass(std::int64_t end) const {
        const std::int64_t pass = next(end) - upbeat();
        return pass >= end ? pass : pass + length(end);
    }
    /// The number of bars that begin before a tick.
    std::int64_t count(std::int64_t tick) const { return number(next(tick)); }
    /// The same bar lines, with ticks and bars counted from the one at `tick`.
    BarLines from(std::int64_t tick) const;
    /// The bar lines without the bars from one bar line to another, which must have the meter of the bar before
    /// them.
    BarLines without(std::int64_t first, std::int64_t end) const;

private:
    /// Bars of the same meter.
    struct Stretch {
        std::int64_t onset = 0;
        std::int64_t number = 0;  ///< of its first bar
        std::int64_t bar = 1;     ///< ticks
        Meter meter;
    };
    void add(std::int64_t onset, const Meter& meter);
    const Stretch& at(std::int64_t tick) const;

    std::vector<Stretch> stretches_;  ///< ascending, the first at 0, or before it with an upbeat
};

/// The tempo and meter with which a score begins.
TempoAndMeter tempo_and_meter_of(const ScoreHead& head);
/// True if a change needs a tempo mark: tempo, words or beat unit differ.
bool needs_tempo_mark(const TempoAndMeter& before, const TempoAndMeter& after);
/// The tempo and meter of a score from a tick on. @param first  tempo and meter before the first change
TempoAndMeter tempo_and_meter_at(const TempoAndMeter& first, const std::vector<SectionChange>& changes,
                                 std::int64_t tick);
/// The changes after a tick, counted from it.
std::vector<SectionChange> changes_after(const std::vector<SectionChange>& changes, std::int64_t tick);

}  // namespace sikku
