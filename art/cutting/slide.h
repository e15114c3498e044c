// art/cutting/slide.h: the distance by which a piece slides towards another until they touch.
#pragma once

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace sikku {

/// The extent of a polygon along one axis (0: x, 1: y) at each place of the other axis. Between neighbouring corners
/// both of its ends are straight. Corners may run either way; the outline must not cross itself.
class Profile {
public:
    /// Cost: k^2 for k corners.
    Profile(std::span<const glm::dvec2> corners, int axis);

    /// The polygon turned by 180 degrees about the origin.
    Profile turned() const;

    /// The least distance by which `moved` must be displaced along the axis to lie beyond this polygon, if it is
    /// displaced by `offset` across the axis: they touch there, and do not overlap. -infinity if they pass each
    /// other. Cost: linear.
    double slide(const Profile& moved, double offset) const;

    double begin() const { return strips_.front().from; }  ///< beginning on the other axis
    double end() const { return strips_.back().to; }

private:
    struct Strip {
        double from, to;  ///< range on the other axis
        double low_from, low_to, high_from, high_to;
        double low(double at) const { return low_from + (low_to - low_from) * share(at); }
        double high(double at) const { return high_from + (high_to - high_from) * share(at); }
        double share(double at) const { return (at - from) / (to - from); }
    };
    std::vector<Strip> strips_;
    double sliver_ = 0;  ///< strips that overlap by less touch
};

}  // namespace sikku
