// music/melody/degree_range.h: the degrees of a scale that a melody may sound.
#pragma once

#include "music/melody/melody.h"

#include <cstdint>
#include <optional>

namespace sikku::mapping {

/// The degrees around the tonic whose keys, rising and falling, lie within the range of a melody; where the tonic
/// lies beyond it, those nearest to the tonic. Cost: O(degrees), at most 30,000.
class DegreeRange {
public:
    explicit DegreeRange(const Melody& melody);
    std::int64_t low() const { return low_; }
    std::int64_t high() const { return high_; }
    /// The degree that sounds for `degree`: mirrored at the ends for Range::reflect, else the nearest.
    std::int64_t inside(std::int64_t degree) const;

private:
    bool is_mirror_;
    std::int64_t low_ = 0;
    std::int64_t high_ = 0;
};

/// The degree of `place` and whole periods that is nearest to `degree`, or of two the lower, moved by a period
/// towards `range` if it lies beyond. @param shift  degrees by which the range is moved
std::int64_t goal_near(std::int64_t degree, std::int64_t place, std::int64_t period,
                       const std::optional<DegreeRange>& range, std::int64_t shift = 0);

/// The key moved by whole periods of the scale into the range of the melody; the nearest end of the range if the
/// range is narrower than a period.
double folded(const Melody& melody, double key);

}  // namespace sikku::mapping
