#include "music/melody/accompaniment.h"

#include <algorithm>
#include <cmath>

namespace sikku::mapping {
namespace {

constexpr std::uint8_t soft = 54;
// Semitones from the tonic: where the octave of the bass and that of the other tones begin.
constexpr double bass_register = -21;
constexpr double chord_register = -10;

}  // namespace

double Accompaniment::key_above(double cents, double lowest) const {
    const double tonic = melody_.tonic + melody_.transpose;
    double key = tonic + cents / 100;
    key -= 12 * std::floor((key - std::round(tonic + lowest)) / 12);
    while (key > 127) key -= 12;
    while (key < 0) key += 12;
    return key;
}

std::vector<Note> Accompaniment::bar(std::int64_t begin, const Chord* chord) const {
    std::vector<Note> notes;
    const std::int64_t length = melody_.meter.bar();
    const auto add = [&](std::int16_t voice, std::int64_t from, std::int64_t to, double key) {
        Note note;
        note.onset = begin + from;
        note.duration = to - from;
        note.key = key;
        note.voice = voice;
        note.velocity = soft;
        notes.push_back(note);
    };
    if (melody_.harmony == Harmony::drone) {
        // As a tanpura is plucked: fifth, tonic, tonic above a low tonic that rings on.
        const double fifth = melody_.scale.cents(drone_degree(melody_.scale), false);
        const std::int64_t beat = length / 4;
        add(0, 0, beat, key_above(fifth, -12));
        add(0, beat, 2 * beat, key_above(0, 0));
        add(0, 2 * beat, length, key_above(0, 0));
        add(1, 0, length, key_above(0, -12));
        return notes;
    }
    if (!chord) return notes;
    add(0, 0, length, key_above(chord->cents.front(), bass_register));
    for (std::size_t tone = 1; tone < std::min<std::size_t>(chord->cents.size(), 3); ++tone) {
        add(static_cast<std::int16_t>(tone), 0, length, key_above(chord->cents[tone], chord_register));
    }
    return notes;
}

}  // namespace sikku::mapping
