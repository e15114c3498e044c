#include "music/tempo_curve.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

[[noreturn]] void refuse_length() {
    throw ScoreError(
        fmt::format("a tempo that follows the curve needs fewer than {} quarters; limit the bars", TempoCurve::most));
}

/// Replaces each value by the mean of its neighbours and twice itself.
void smooth(std::vector<double>& values) {
    double before = values.front();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double here = values[i];
        const double after = values[std::min(i + 1, values.size() - 1)];
        values[i] = (before + 2 * here + after) / 4;
        before = here;
    }
}

}  // namespace

void TempoCurve::add(std::int64_t onset, double value) {
    const std::int64_t beat = onset / ticks_per_quarter;
    if (beat >= most) refuse_length();
    const auto at = static_cast<std::size_t>(beat);
    if (at >= sums_.size()) {
        sums_.resize(at + 1, 0);
        counts_.resize(at + 1, 0);
    }
    sums_[at] += value;
    ++counts_[at];
    if (onset >= first_onset_) return;
    first_onset_ = onset;
    first_ = value;
}

std::vector<TempoPoint> TempoCurve::points(const SourceRange& range, std::int64_t end) const {
    if (end / ticks_per_quarter >= most) refuse_length();
    std::vector<double> values(static_cast<std::size_t>(end / ticks_per_quarter + 1));
    double last = first_onset_ < INT64_MAX ? range.part(first_) : 0.5;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i < sums_.size() && counts_[i] > 0) last = range.part(sums_[i] / counts_[i]);
        values[i] = last;
    }
    smooth(values);
    smooth(values);
    // A value at the very end is left out, and so are repeated ones.
    if (values.size() > 1 && end % ticks_per_quarter == 0) values.pop_back();
    for (double& value : values) value = curve_.at(value) / tempo_;
    std::size_t changes = 1;
    for (std::size_t i = 1; i < values.size(); ++i) changes += values[i] != values[i - 1] ? 1 : 0;
    std::vector<TempoPoint> result;
    result.reserve(changes);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0 && values[i] == values[i - 1]) continue;
        result.push_back({static_cast<std::int64_t>(i) * ticks_per_quarter, values[i]});
    }
    return result;
}

}  // namespace sikku
