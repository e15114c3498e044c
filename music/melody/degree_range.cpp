#include "music/melody/degree_range.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sikku::mapping {

DegreeRange::DegreeRange(const Melody& melody) : is_mirror_(melody.range == Range::reflect) {
    constexpr std::int64_t most_degrees = 10'000;
    const auto is_within = [&](double key) { return key >= melody.lowest && key <= melody.highest; };
    const auto fits = [&](std::int64_t degree) {
        const auto up = melody.key(degree, false);
        const auto down = melody.key(degree, true);
        return up && down && is_within(*up) && is_within(*down);
    };
    const auto tonic = melody.key(0, false);
    const std::int64_t towards = tonic && *tonic > melody.highest ? -1 : 1;
    while (std::abs(low_) < most_degrees && !fits(low_)) low_ += towards;
    high_ = low_;
    while (high_ < most_degrees && fits(high_ + 1)) ++high_;
    while (low_ > -most_degrees && fits(low_ - 1)) --low_;
}

std::int64_t DegreeRange::inside(std::int64_t degree) const {
    if (!is_mirror_ || high_ == low_) return std::clamp(degree, low_, high_);
    const std::int64_t width = high_ - low_;
    std::int64_t phase = (degree - low_) % (2 * width);
    if (phase < 0) phase += 2 * width;
    return low_ + (phase <= width ? phase : 2 * width - phase);
}

std::int64_t goal_near(std::int64_t degree, std::int64_t place, std::int64_t period,
                       const std::optional<DegreeRange>& range, std::int64_t shift) {
    std::int64_t above = (degree - place) % period;
    if (above < 0) above += period;
    const std::int64_t goal = 2 * above <= period ? degree - above : degree - above + period;
    if (!range) return goal;
    const std::int64_t low = range->low() + shift;
    const std::int64_t high = range->high() + shift;
    if (goal < low) return goal + period <= high ? goal + period : goal;
    return goal > high && goal - period >= low ? goal - period : goal;
}

double folded(const Melody& melody, double key) {
    const double period = std::fabs(melody.scale.period) / 100;
    if (std::isfinite(key) && period > 0 && period <= melody.highest - melody.lowest) {
        if (key > melody.highest) key -= period * std::ceil((key - melody.highest) / period);
        if (key < melody.lowest) key += period * std::ceil((melody.lowest - key) / period);
    }
    return std::clamp(key, melody.lowest, melody.highest);
}

}  // namespace sikku::mapping
