#include "art/hand/pinches.h"

#include "art/hand/hand_noise.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr double usual_pinch = 6.5, pinch_spread = 0.38;  // loops, and share
constexpr double begin_loops = 0.5, join_loops = 0.3;     // loops
constexpr double begin_flow = 0.35;
constexpr double dry_from = 0.45;      // share of a pinch
constexpr double most_dryness = 0.52;  // the line stays whole
constexpr double most_pinches = 1e6;

}  // namespace

Pinches::Pinches(std::uint64_t seed, double length, double loop, double strength) : loop_(loop), strength_(strength) {
    // A weak hand runs dry, too.
    const double steady = 1 - strength;
    const double dryness = most_dryness * (1 - steady * steady * steady);
    const double count = std::clamp(std::round(length / (usual_pinch * loop)), 1.0, most_pinches);
    const double usual = length / count;
    for (double k = 0; k < count; ++k) {
        const auto number = static_cast<std::uint64_t>(k);
        const double shift = k > 0 ? pinch_spread / 2 * hand_chance(seed, 2 * number) : 0;
        const double chance = (hand_chance(seed, 2 * number + 1) + 1) / 2;
        pinches_.push_back({(k + shift) * usual, 0, dryness * (0.35 + 0.65 * chance)});
    }
    for (std::size_t k = 0; k < pinches_.size(); ++k) {
        const double end = k + 1 < pinches_.size() ? pinches_[k + 1].begin : length;
        pinches_[k].length = end - pinches_[k].begin;
    }
}

const Pinches::Pinch& Pinches::at(double along) const {
    const auto after = std::upper_bound(pinches_.begin() + 1, pinches_.end(), along,
                                        [](double place, const Pinch& pinch) { return place < pinch.begin; });
    return *std::prev(after);
}

double Pinches::flow(double along) const {
    const Pinch& pinch = at(along);
    const double past = along - pinch.begin;
    const double share = pinch.length > 0 ? past / pinch.length : 0;
    const double dry = pinch.dryness * smooth_step((share - dry_from) / (1 - dry_from));
    const double full = 1 + begin_flow * strength_ * beginning(along) - dry;
    // The hand begins on the end of the stretch before.
    if (&pinch == pinches_.data() || past >= join_loops * loop_) return full;
    const double last = 1 - (&pinch - 1)->dryness;
    return last + (full - last) * smooth_step(past / (join_loops * loop_));
}

double Pinches::beginning(double along) const {
    return 1 - smooth_step((along - at(along).begin) / (begin_loops * loop_));
}

}  // namespace sikku
