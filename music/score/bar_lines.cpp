#include "music/score/bar_lines.h"

#include "music/score/rhythm.h"

#include <algorithm>

namespace sikku {

BarLines::BarLines(const Meter& meter) {
    add(0, meter);
}

BarLines::BarLines(const Meter& meter, const std::vector<SectionChange>& changes, std::int64_t upbeat)
    : BarLines(meter) {
    if (upbeat > 0) stretches_.front().onset = upbeat - stretches_.front().bar;
    for (const SectionChange& change : changes) add(change.onset, change.to.meter);
}

void BarLines::add(std::int64_t onset, const Meter& meter) {
    const bool is_first = stretches_.empty();
    if (!is_first && stretches_.back().meter == meter) return;
    const std::int64_t first = is_first ? 0 : number(onset);
    stretches_.push_back({onset, first, std::max<std::int64_t>(meter.bar(), 1), meter});
}

const BarLines::Stretch& BarLines::at(std::int64_t tick) const {
    auto stretch = stretches_.end() - 1;
    if (stretch->onset <= tick || stretches_.size() == 1) return *stretch;
    stretch = std::upper_bound(stretches_.begin() + 1, stretches_.end(), tick,
                               [](std::int64_t one, const Stretch& other) { return one < other.onset; });
    return *(stretch - 1);
}

std::int64_t BarLines::number(std::int64_t tick) const {
    const Stretch& stretch = at(tick);
    return stretch.number + (tick - stretch.onset) / stretch.bar;
}

std::int64_t BarLines::onset(std::int64_t number) const {
    const auto next = std::upper_bound(stretches_.begin() + 1, stretches_.end(), number,
                                       [](std::int64_t one, const Stretch& other) { return one < other.number; });
    const Stretch& stretch = *(next - 1);
    return std::max<std::int64_t>(0, stretch.onset + (number - stretch.number) * stretch.bar);
}

BarLines BarLines::from(std::int64_t tick) const {
    if (tick == 0) return *this;
    BarLines result(meter(tick));
    for (const Stretch& stretch : stretches_) {
        if (stretch.onset > tick) result.add(stretch.onset - tick, stretch.meter);
    }
    return result;
}

BarLines BarLines::without(std::int64_t first, std::int64_t end) const {
    BarLines result = *this;
    const std::int64_t bars = number(end) - number(first);
    for (Stretch& stretch : result.stretches_) {
        if (stretch.onset < end) continue;
        stretch.onset -= end - first;
        stretch.number -= bars;
    }
    return result;
}

TempoAndMeter tempo_and_meter_of(const ScoreHead& head) {
    return {head.tempo, head.tempo_words, head.meter};
}

bool needs_tempo_mark(const TempoAndMeter& before, const TempoAndMeter& after) {
    return before.tempo != after.tempo || before.tempo_words != after.tempo_words ||
           beat_unit(before.meter).quarters != beat_unit(after.meter).quarters;
}

TempoAndMeter tempo_and_meter_at(const TempoAndMeter& first, const std::vector<SectionChange>& changes,
                                 std::int64_t tick) {
    const auto next =
        std::upper_bound(changes.begin(), changes.end(), tick,
                         [](std::int64_t one, const SectionChange& other) { return one < other.onset; });
    return next == changes.begin() ? first : (next - 1)->to;
}

std::vector<SectionChange> changes_after(const std::vector<SectionChange>& changes, std::int64_t tick) {
    std::vector<SectionChange> result;
    for (SectionChange change : changes) {
        if (change.onset <= tick) continue;
        change.onset -= tick;
        result.push_back(std::move(change));
    }
    return result;
}

}  // namespace sikku
