#include "art/cutting/slide.h"

#include <algorithm>
#include <limits>

namespace sikku {

Profile::Profile(std::span<const glm::dvec2> corners, int axis) {
    const int other = 1 - axis;
    std::vector<double> places;
    for (const glm::dvec2 corner : corners) places.push_back(corner[other]);
    std::sort(places.begin(), places.end());
    sliver_ = 1e-9 * (places.back() - places.front());
    std::size_t kept = 0;
    for (const double place : places) {
        if (kept == 0 || place - places[kept - 1] > sliver_) places[kept++] = place;
    }
    places.resize(kept);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        Strip strip{places[i], places[i + 1], 0, 0, 0, 0};
        const double middle = (strip.from + strip.to) / 2;
        double low = std::numeric_limits<double>::max(), high = -low;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec2 a = corners[k], b = corners[(k + 1) % corners.size()];
            if ((a[other] > middle) == (b[other] > middle)) continue;
            const double slope = (b[axis] - a[axis]) / (b[other] - a[other]);
            const auto at = [&](double place) { return a[axis] + slope * (place - a[other]); };
            if (at(middle) < low) {
                low = at(middle);
                strip.low_from = at(strip.from);
                strip.low_to = at(strip.to);
            }
            if (at(middle) > high) {
                high = at(middle);
                strip.high_from = at(strip.from);
                strip.high_to = at(strip.to);
            }
        }
        strips_.push_back(strip);
    }
}

Profile Profile::turned() const {
    Profile result = *this;
    std::reverse(result.strips_.begin(), result.strips_.end());
    for (Strip& strip : result.strips_) {
        strip = {-strip.to, -strip.from, -strip.high_to, -strip.high_from, -strip.low_to, -strip.low_from};
    }
    return result;
}

double Profile::slide(const Profile& moved, double offset) const {
    double most = -std::numeric_limits<double>::infinity();
    const double sliver = std::max(sliver_, moved.sliver_);
    for (std::size_t i = 0, k = 0; i < strips_.size() && k < moved.strips_.size();) {
        const Strip& mine = strips_[i];
        const Strip& other = moved.strips_[k];
        const double from = std::max(mine.from, other.from + offset), to = std::min(mine.to, other.to + offset);
        if (to - from > sliver) {
            for (const double at : {from, to}) most = std::max(most, mine.high(at) - other.low(at - offset));
        }
        if (mine.to < other.to + offset) {
            ++i;
        } else {
            ++k;
        }
    }
    return most;
}

}  // namespace sikku
