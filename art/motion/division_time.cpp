#include "art/motion/division_time.h"

#include <algorithm>
#include <array>

namespace sikku {
namespace {

// Parts that are cut out of their parents shrink a little, draw closer to their family, and close up again.
constexpr std::array cut_size = {Keyframe{0, 1}, Keyframe{0.45, 0.82}, Keyframe{0.55, 0.82}, Keyframe{1, 1}};
constexpr std::array cut_way = {Keyframe{0, 0}, Keyframe{0.45, 1}, Keyframe{0.55, 1}, Keyframe{1, 0}};
constexpr std::array cut_outline = {Keyframe{0, 0}, Keyframe{0.3, 1}, Keyframe{1, 1}};
constexpr std::array cut_colour = {Keyframe{0, 0}, Keyframe{0.15, 0}, Keyframe{0.75, 1}, Keyframe{1, 1}};
constexpr std::array cut_before = {Keyframe{0, 1}, Keyframe{0.35, 0}, Keyframe{1, 0}};
constexpr std::array cut_opacity = {Keyframe{0, 1}, Keyframe{1, 1}};

// Parts across the edges of their parents appear over them, and shrink and close up again.
constexpr std::array across_size = {Keyframe{0, 1}, Keyframe{0.5, 0.8}, Keyframe{1, 1}};
constexpr std::array across_way = {Keyframe{0, 0}, Keyframe{1, 0}};
constexpr std::array across_outline = {Keyframe{0, 0}, Keyframe{0.3, 1}, Keyframe{1, 1}};
constexpr std::array across_colour = {Keyframe{0, 0}, Keyframe{0.2, 0}, Keyframe{0.75, 1}, Keyframe{1, 1}};
constexpr std::array across_before = {Keyframe{0, 1}, Keyframe{0.1, 1}, Keyframe{0.5, 0}, Keyframe{1, 0}};
constexpr std::array across_opacity = {Keyframe{0, 0}, Keyframe{0.35, 1}, Keyframe{1, 1}};

// Others appear at a share of their size within their parents, which fade while the parts spread.
constexpr std::array spread_size = {Keyframe{0, 0.62}, Keyframe{1, 1}};
constexpr std::array spread_way = {Keyframe{0, 1}, Keyframe{1, 0}};
constexpr std::array spread_outline = {Keyframe{0, 0.5}, Keyframe{1, 1}};
constexpr std::array spread_colour = {Keyframe{0, 0}, Keyframe{0.1, 0}, Keyframe{0.7, 1}, Keyframe{1, 1}};
constexpr std::array spread_before = {Keyframe{0, 1}, Keyframe{0.15, 1}, Keyframe{0.6, 0}, Keyframe{1, 0}};
constexpr std::array spread_opacity = {Keyframe{0, 0}, Keyframe{0.2, 1}, Keyframe{1, 1}};

constexpr std::array arrival = {Keyframe{0, 0}, Keyframe{0.25, 0}, Keyframe{0.8, 1}, Keyframe{1, 1}};

}  // namespace

double eased(double share) {
    return share * share * (3 - 2 * share);
}

double value_at(Track track, double share) {
    std::size_t next = 0;
    while (next < track.size() && track[next].at <= share) ++next;
    if (next == 0) return track.front().value;
    if (next == track.size()) return track.back().value;
    const Keyframe &a = track[next - 1], &b = track[next];
    return a.value + (b.value - a.value) * eased((share - a.at) / (b.at - a.at));
}

const DivisionTracks& division_tracks(DivisionKind kind) {
    static const DivisionTracks cut{cut_size, cut_way, cut_outline, cut_colour, cut_opacity, cut_before, arrival};
    static const DivisionTracks across{across_size,    across_way,    across_outline, across_colour,
                                       across_opacity, across_before, arrival};
    static const DivisionTracks spread{spread_size,    spread_way,    spread_outline, spread_colour,
                                       spread_opacity, spread_before, arrival};
    return kind == DivisionKind::cut ? cut : kind == DivisionKind::across ? across : spread;
}

double DivisionClock::fade() const {
    const int last = generations_ - 1;
    return rest(last) + std::max(times_.hold, times_.rest);
}

}  // namespace sikku
