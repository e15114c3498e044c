#include "music/score/curves.h"

#include <algorithm>
#include <cmath>

namespace sikku {

int controller_value(const ControlPoint& point) {
    return std::clamp(static_cast<int>(std::lround(point.value)), 0, 127);
}

int usual_controller_value(int number) {
    constexpr int volume = 7;
    constexpr int expression = 11;
    constexpr int brightness = 74;
    if (number == volume) return 100;
    if (number == expression) return 127;
    return number == ControlPoint::pan || number == brightness ? 64 : 0;
}

bool Curves::has_bends() const {
    return std::any_of(controls.begin(), controls.end(),
                       [](const ControlPoint& point) { return point.number == ControlPoint::bend; });
}

std::span<const ControlPoint> Curves::of_voice(int voice) const {
    const auto first = std::lower_bound(controls.begin(), controls.end(), voice,
                                        [](const ControlPoint& point, int number) { return point.voice < number; });
    const auto last = std::upper_bound(first, controls.end(), voice,
                                       [](int number, const ControlPoint& point) { return number < point.voice; });
    return {controls.data() + (first - controls.begin()), static_cast<std::size_t>(last - first)};
}

std::vector<TempoPoint> tempo_map(const ScoreHead& head, const Curves& curves, std::int64_t end) {
    constexpr int steps = 8;
    constexpr double slowest = 0.6;
    if (!head.changes_tempo()) return curves.tempo;
    struct Change {
        TempoPoint point;
        bool is_ritardando;
    };
    std::vector<Change> changes;
    for (const SectionChange& change : head.changes) {
        changes.push_back({{change.onset, change.to.tempo / head.tempo}, false});
    }
    const std::int64_t begin = std::max<std::int64_t>(0, end - head.ritardando);
    for (int step = 0; step < steps && head.ritardando > 0; ++step) {
        changes.push_back({{begin + (end - begin) * step / steps, 1 - (1 - slowest) * (step + 1) / steps}, true});
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.point.tick < b.point.tick; });
    // Combines all; the number of points does not depend on the end.
    std::vector<TempoPoint> map;
    double curve = 1;
    double section = 1;
    double fall = 1;
    auto next = changes.begin();
    const auto change_before = [&](std::int64_t tick) {
        for (; next != changes.end() && next->point.tick < tick; ++next) {
            (next->is_ritardando ? fall : section) = next->point.factor;
            map.push_back({next->point.tick, curve * fall * section});
        }
    };
    for (const TempoPoint& point : curves.tempo) {
        change_before(point.tick);
        curve = point.factor;
        map.push_back({point.tick, curve * fall * section});
    }
    change_before(INT64_MAX);
    return map;
}

double seconds_at(std::int64_t tick, double tempo, std::span<const TempoPoint> map) {
    const double ticks_per_second = tempo * static_cast<double>(ticks_per_quarter) / 60;
    double seconds = 0;
    double factor = 1;
    std::int64_t here = 0;
    for (const TempoPoint& point : map) {
        if (point.tick >= tick) break;
        seconds += static_cast<double>(point.tick - here) / (ticks_per_second * factor);
        here = point.tick;
        factor = point.factor;
    }
    return seconds + static_cast<double>(tick - here) / (ticks_per_second * factor);
}

}  // namespace sikku
