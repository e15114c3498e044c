// music/tempo_curve.h: a tempo that follows the curve, beat by beat.
#pragma once

#include "music/melody/expression.h"
#include "music/score/curves.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Computes a tempo for each quarter: the mean of the notes that begin in it, or the previous tempo, smoothed over
/// two quarters on both sides. Memory: 12 bytes a quarter, and 24 more for points().
class TempoCurve {
public:
    /// Largest number of quarters.
    static constexpr std::int64_t most = std::int64_t{1} << 26;

    /// @param tempo  quarters a minute that the factors of points refer to
    TempoCurve(const ExpressionCurve& curve, double tempo) : curve_(curve), tempo_(tempo) {}
    /// Adds a note. @param value  value of the source at its middle. @throws ScoreError beyond `most` quarters
    void add(std::int64_t onset, double value);
    /// The changes of tempo before `end`, one at the beginning. @param range  range of the source. @throws ScoreError
    std::vector<TempoPoint> points(const SourceRange& range, std::int64_t end) const;

private:
    ExpressionCurve curve_;
    double tempo_;
    std::vector<double> sums_;  // sum of the values in each quarter
    std::vector<std::uint32_t> counts_;
    double first_ = 0;  // value of the first note
    std::int64_t first_onset_ = INT64_MAX;
};

}  // namespace sikku
