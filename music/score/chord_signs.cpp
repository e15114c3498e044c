#include "music/score/chord_signs.h"

#include <cmath>
#include <cstddef>

namespace sikku {
namespace {

constexpr ChordQuality qualities[] = {
    {"maj", {0, 4, 7, -1, -1}, "", "major", ""},
    {"m", {0, 3, 7, -1, -1}, "m", "minor", ":m"},
    {"dim", {0, 3, 6, -1, -1}, "dim", "diminished", ":dim"},
    {"aug", {0, 4, 8, -1, -1}, "aug", "augmented", ":aug"},
    {"5", {0, 7, -1, -1, -1}, "5", "power", ":1.5"},
    {"sus2", {0, 2, 7, -1, -1}, "sus2", "suspended-second", ":sus2"},
    {"sus4", {0, 5, 7, -1, -1}, "sus4", "suspended-fourth", ":sus4"},
    {"6", {0, 4, 9, 7, -1}, "6", "major-sixth", ":6"},
    {"m6", {0, 3, 9, 7, -1}, "m6", "minor-sixth", ":m6"},
    {"7", {0, 4, 10, 7, -1}, "7", "dominant", ":7"},
    {"maj7", {0, 4, 11, 7, -1}, "maj7", "major-seventh", ":maj7"},
    {"m7", {0, 3, 10, 7, -1}, "m7", "minor-seventh", ":m7"},
    {"mmaj7", {0, 3, 11, 7, -1}, "m(maj7)", "major-minor", ":m7+"},
    {"m7b5", {0, 3, 10, 6, -1}, "m7\u266D5", "half-diminished", ":m7.5-"},
    {"dim7", {0, 3, 9, 6, -1}, "dim7", "diminished-seventh", ":dim7"},
    {"7sus4", {0, 5, 10, 7, -1}, "7sus4", "suspended-fourth", ":7sus4", 7},
    {"add9", {0, 4, 2, 7, -1}, "add9", "major", ":1.3.5.9", 9},
    {"9", {0, 4, 10, 7, 2}, "9", "dominant-ninth", ":9"},
    {"maj9", {0, 4, 11, 7, 2}, "maj9", "major-ninth", ":maj9"},
    {"m9", {0, 3, 10, 7, 2}, "m9", "minor-ninth", ":m9"},
    {"madd9", {0, 3, 2, 7, -1}, "m(add9)", "minor", ":1.3-.5.9", 9},
    {"mmaj9", {0, 3, 11, 7, 2}, "m(maj9)", "major-minor", ":m9.7+", 9},
};

}  // namespace

std::span<const ChordQuality> chord_qualities() {
    return qualities;
}

int quality_with(std::span<const double> cents) {
    constexpr double most_away = 30;
    for (std::size_t i = 0; i < std::size(qualities); ++i) {
        const std::array<int, 5>& tones = qualities[i].tones;
        bool is_same = true;
        for (std::size_t k = 0; k < tones.size(); ++k) {
            const bool has_tone = k < cents.size();
            is_same = is_same && has_tone == (tones[k] >= 0) &&
                      (!has_tone || std::fabs(cents[k] - cents[0] - 100 * tones[k]) <= most_away);
        }
        if (is_same && cents.size() <= tones.size()) return static_cast<int>(i);
    }
    return -1;
}

}  // namespace sikku
