#include "music/melody/harmony.h"

#include "engine/base/text.h"
#include "music/melody/chord_names.h"
#include "music/score/chord_signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sikku {
namespace {

constexpr std::array<double, 7> usual_cents = {0, 200, 400, 500, 700, 900, 1100};
constexpr std::size_t most_chords = 256;

std::int64_t within(std::int64_t degree, std::int64_t size) {
    return (degree % size + size) % size;
}

/// The degree above `root` whose interval is nearest to `interval`, within `tolerance` cents.
std::optional<std::int64_t> degree_at(const Scale& scale, std::int64_t root, double interval, double tolerance) {
    std::optional<std::int64_t> best;
    for (std::int64_t degree = root + 1; degree < root + static_cast<std::int64_t>(scale.size()); ++degree) {
        const double distance = std::fabs(scale.cents(degree, false) - scale.cents(root, false) - interval);
        if (distance > tolerance) continue;
        tolerance = distance;
        best = degree;
    }
    return best;
}

}  // namespace

bool Chord::has(std::int64_t degree) const {
    const auto size = static_cast<std::int64_t>(is_tone.size());
    return is_tone[static_cast<std::size_t>(within(degree, size))] != 0;
}

std::int64_t Chord::nearest(std::int64_t degree, std::int64_t low, std::int64_t high) const {
    for (std::int64_t by = 0; by <= static_cast<std::int64_t>(is_tone.size()); ++by) {
        if (degree - by >= low && has(degree - by)) return degree - by;
        if (degree + by <= high && has(degree + by)) return degree + by;
    }
    return degree;
}

void mark_tones(Chord& chord, const Scale& scale) {
    const double period = std::fabs(scale.period);
    chord.is_tone.assign(scale.size(), 0);
    for (std::size_t degree = 0; degree < scale.size(); ++degree) {
        for (const double tone : chord.cents) {
            const double apart = std::remainder(scale.cents(static_cast<std::int64_t>(degree), false) - tone, period);
            if (std::fabs(apart) < 50) chord.is_tone[degree] = 1;
        }
    }
}

ChordSign sign_of(const Chord& chord, double tonic) {
    constexpr double most_away = 0.3;
    const double root = tonic + chord.root / 100;
    if (chord.quality < 0 || std::fabs(root - std::round(root)) > most_away) return {ChordSign::without_name, 0, -1};
    const auto class_of = [](double key) { return static_cast<std::int8_t>((std::lround(key) % 12 + 12) % 12); };
    ChordSign sign{static_cast<std::int8_t>(chord.quality), class_of(root),
                   class_of(tonic + chord.cents.front() / 100)};
    if (sign.bass == sign.root) sign.bass = -1;
    return sign;
}

std::int64_t degree_of_numeral(const Scale& scale, std::size_t number) {
    if (scale.size() == 7 || number == 0) return static_cast<std::int64_t>(number);
    return degree_at(scale, 0, usual_cents[number], 1e9).value_or(0);
}

Chord triad_on(const Scale& scale, std::int64_t root) {
    std::vector<std::int64_t> degrees = {root};
    if (scale.size() == 7) {
        degrees.push_back(root + 2);
        degrees.push_back(root + 4);
    } else {
        if (const auto third = degree_at(scale, root, 350, 84)) degrees.push_back(*third);
        if (const auto fifth = degree_at(scale, root, 702, 60)) degrees.push_back(*fifth);
    }
    Chord chord;
    for (const std::int64_t degree : degrees) chord.cents.push_back(scale.cents(degree, false));
    chord.quality = quality_with(chord.cents);
    chord.root = chord.cents.front();
    mark_tones(chord, scale);
    return chord;
}

std::vector<Chord> triads_of(const Scale& scale) {
    const auto size = static_cast<std::int64_t>(scale.size());
    std::vector<std::int64_t> roots;
    if (size == 7) {
        roots = {0, 3, 4, 5, 1, 2, 6};
    } else {
        for (std::int64_t root = 0; root < size; ++root) roots.push_back(root);
    }
    std::vector<Chord> chords;
    for (const std::int64_t root : roots) {
        Chord chord = triad_on(scale, root);
        if (chord.cents.size() == 3) chords.push_back(std::move(chord));
    }
    if (chords.empty()) chords.push_back(triad_on(scale, 0));
    return chords;
}

std::vector<Chord> read_progression(std::string_view text, const Scale& scale, double tonic, std::string& problem) {
    if (lower_case(text) == "blues") text = "I7-I7-I7-I7-IV7-IV7-I7-I7-V7-IV7-I7-I7";
    problem = "expected chords, one a bar, such as I-IV-V7-I or C-Am-F-G7, or blues";
    std::vector<Chord> chords;
    for (;;) {
        const std::size_t end = std::min(text.find('-'), text.size());
        const std::string_view name = trimmed(text.substr(0, end));
        if (name.empty()) return {};
        std::optional<Chord> chord = named_chord(name, scale, tonic);
        if (!chord) {
            problem = fmt::format(
                "unknown chord '{}'; expected numerals such as IV, ii7, bVII and V7/V, or names such "
                "as Am and Cmaj7, one a bar",
                printable(name));
            return {};
        }
        if (chords.size() == most_chords) {
            problem = fmt::format("more than {} chords", most_chords);
            return {};
        }
        chords.push_back(std::move(*chord));
        if (end == text.size()) return chords;
        text.remove_prefix(end + 1);
    }
}

std::int64_t fifth_degree(const Scale& scale) {
    std::int64_t best = 0;
    for (std::int64_t degree = 0; degree < static_cast<std::int64_t>(scale.size()); ++degree) {
        const auto distance = [&](std::int64_t one) { return std::fabs(scale.cents(one, true) - 702); };
        if (distance(degree) < distance(best)) best = degree;
    }
    return best;
}

std::int64_t drone_degree(const Scale& scale) {
    for (const double interval : {702.0, 498.0}) {
        if (const auto degree = degree_at(scale, 0, interval, 50)) return *degree;
    }
    return 0;
}

int interval_class(double a, double b) {
    return static_cast<int>(std::lround(std::fabs(a - b))) % 12;
}

bool is_parallel(double low, double high, double next_low, double next_high) {
    if (low == next_low || high == next_high) return false;
    const int interval = interval_class(next_low, next_high);
    return (interval == 0 || interval == 7) && interval == interval_class(low, high);
}

}  // namespace sikku
