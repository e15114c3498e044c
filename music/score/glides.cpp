#include "music/score/glides.h"

#include <algorithm>
#include <cmath>

namespace sikku {

void cut(Note& note, std::int64_t from, std::int64_t to) {
    const std::int64_t end = note.onset + note.duration;
    const std::int64_t first = std::max(note.onset, from);
    const std::int64_t last = std::min(end, to);
    Glide& glide = note.glide;
    if (glide.ticks > 0) {
        const std::int64_t begin = end - glide.ticks;
        const auto slid_at = [&](std::int64_t tick) {
            const double part =
                static_cast<double>(std::max<std::int64_t>(0, tick - begin)) / static_cast<double>(glide.ticks);
            return part * static_cast<double>(glide.semitones);
        };
        const double before = slid_at(first);
        const double after = slid_at(last);
        note.key += before;
        glide.ticks = std::max<std::int64_t>(0, last - std::max(first, begin));
        glide.semitones = static_cast<float>(after - before);
        note.is_sliding = glide.ticks > 0 && glide.semitones != 0;
        if (glide.ticks == 0) glide = {};
    }
    note.begins_phrase = note.begins_phrase && first == note.onset;
    note.onset = first;
    note.duration = last - first;
}

std::vector<GlidePoint> glide_points(const Note& note, double tempo) {
    constexpr double widest_step = 0.03;     // semitones
    constexpr double shortest_step = 0.004;  // seconds
    std::vector<GlidePoint> points;
    const std::int64_t ticks = note.glide.ticks;
    const auto semitones = static_cast<double>(note.glide.semitones);
    if (ticks <= 0 || semitones == 0) return points;
    const double ticks_per_second = tempo * static_cast<double>(ticks_per_quarter) / 60;
    const auto apart = std::max<std::int64_t>(1, std::llround(std::ceil(shortest_step * ticks_per_second)));
    const auto wanted = static_cast<std::int64_t>(std::ceil(std::fabs(semitones) / widest_step));
    const std::int64_t steps = std::clamp<std::int64_t>(ticks / apart, 1, wanted);
    const std::int64_t begin = note.onset + note.duration - ticks;
    for (std::int64_t i = 0; i < steps; ++i) {
        // Avoids a product that may overflow.
        const std::int64_t at = ticks / steps * i + ticks % steps * i / steps;
        points.push_back(
            {begin + at, note.key + semitones * static_cast<double>(i + 1) / static_cast<double>(steps)});
    }
    return points;
}

}  // namespace sikku
