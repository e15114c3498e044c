#include "music/melody/accompaniment.h"

#include "music/score/rhythm.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sikku::mapping {
namespace {

constexpr std::uint8_t soft = 54;
constexpr double silent = -1;
// Semitones from the tonic: where the octave of the bass begins, the range of the voices above it, and its middle.
constexpr double bass_register = -21;
constexpr double lowest_tone = -12;
constexpr double highest_tone = 8;
constexpr double middle_tone = -3;
constexpr double least_above_bass = 2.5;
constexpr double widest_pair = 12;
// Penalties for voices that move in parallel, and for each semitone that a pair of voices lies off the middle.
constexpr double unrest_of_parallels = 100;
constexpr double unrest_off_middle = 0.25;
// Penalties for an octave and for a fourth above the bass, in place of a fifth.
constexpr double unrest_of_octave = 6;
constexpr double unrest_of_fourth = 12;

/// Ticks of a bar at which a tanpura is plucked: at its groups if there are three, otherwise at three beats.
std::array<std::int64_t, 3> plucks(const Meter& meter) {
    const std::vector<std::int64_t> groups = groups_of(meter);
    const std::int64_t bar = meter.bar();
    if (groups.size() == 3) return {0, groups[0], groups[0] + groups[1]};
    const std::int64_t beat = bar / meter.beats;
    if (meter.beats % 4 == 0) return {0, bar / 4, bar / 2};
    if (meter.beats % 3 == 0) return {0, bar / 3, 2 * bar / 3};
    if (meter.beats >= 3) return {0, beat, 2 * beat};
    return {0, bar / 4, bar / 2};
}

}  // namespace

Accompaniment::Accompaniment(const Melody& melody) : melody_(melody) {
    if (melody.harmony == Harmony::progression && !melody.progression.empty()) lead_progression();
}

double Accompaniment::key_above(double cents, double lowest) const {
    const double tonic = melody_.tonic + melody_.transpose;
    double key = tonic + cents / 100;
    key -= 12 * std::floor((key - std::round(tonic + lowest)) / 12);
    while (key > 127) key -= 12;
    while (key < 0) key += 12;
    return key;
}

std::vector<Note> Accompaniment::bar(std::int64_t begin, const Chord* chord, const Chord* next, bool is_last) const {
    if (melody_.harmony == Harmony::drone) return drone(begin);
    std::vector<Note> notes;
    if (!chord) return notes;
    const std::int64_t length = melody_.meter.bar();
    const Voicing keys = voicing_of(melody_.bar_number(begin), *chord);
    if (is_last || melody_.figure.layers.empty()) {
        strike({}, {begin, length, 60, 0, soft}, *chord, keys, silent, notes);
    } else {
        const double next_bass = next ? voicing_of(melody_.bar_number(begin) + 1, *next)[0] : silent;
        for (const Figure::Layer& layer : melody_.figure.layers) {
            const std::int64_t slot = length / layer.slots;
            for (const Figure::Stroke& stroke : layer.strokes) {
                strike(stroke, {begin + stroke.onset * slot, stroke.length * slot, 60, 0, soft}, *chord, keys,
                       next_bass, notes);
            }
        }
    }
    const ChordSign sign = sign_of(*chord, melody_.tonic + melody_.transpose);
    for (Note& note : notes) note.chord = sign;
    return notes;
}

/// Adds the notes of a stroke. @param note  its onset, duration and velocity
/// @param next_bass  bass of the next bar, or silent
void Accompaniment::strike(const Figure::Stroke& stroke, Note note, const Chord& chord, const Voicing& keys,
                           double next_bass, std::vector<Note>& notes) const {
    using enum Figure::Tone;
    if (stroke.is_accented) {
        note.velocity = soft + accent_velocity;
        note.emphasis.stress = Stress::accent;
    }
    const auto add = [&](std::size_t voice, double key) {
        if (key == silent) return;
        note.voice = static_cast<std::int16_t>(voice);
        note.key = key;
        notes.push_back(note);
    };
    const double top = keys[2] != silent ? keys[2] : keys[1];
    switch (stroke.tone) {
        case all:
        case pair:
            for (std::size_t voice = stroke.tone == all ? 0 : 1; voice < keys.size(); ++voice)
                add(voice, keys[voice]);
            return;
        case bass:
            return add(0, keys[0]);
        case lower:
            return add(1, keys[1] != silent ? keys[1] : keys[0]);
        case upper:
            return add(2, top != silent ? top : keys[0]);
        case octave: {
            double key = keys[0];
            while (key <= top && key + 12 <= 127) key += 12;
            return add(2, key);
        }
        case third:
            return add(0, tone_above(chord, 400, keys[0]));
        case fifth:
            return add(0, tone_above(chord, 700, keys[0]));
        case Figure::Tone::approach:
            return add(0, half_step_to(next_bass, tone_above(chord, 700, keys[0])));
    }
}

/// The tone of a chord at about `cents` above its root, near the bass.
double Accompaniment::tone_above(const Chord& chord, double cents, double bass) const {
    constexpr double most_away = 160;
    double best = bass;
    double least = most_away;
    for (const double tone : chord.cents) {
        const double above = std::fmod(tone - chord.root + 2400, 1200);
        if (std::fabs(above - cents) >= least) continue;
        least = std::fabs(above - cents);
        best = key_above(tone, bass_register);
    }
    return best;
}

/// A half step to the next bass, from the side of `from`; that itself if there is none.
double Accompaniment::half_step_to(double next_bass, double from) {
    if (next_bass == silent) return from;
    return std::clamp(from < next_bass ? next_bass - 1 : next_bass + 1, 0.0, 127.0);
}

/// A bar of a tanpura: fifth, tonic and tonic over a sustained low tonic.
std::vector<Note> Accompaniment::drone(std::int64_t begin) const {
    const std::int64_t length = melody_.meter.bar();
    const auto [first, second, third] = plucks(melody_.meter);
    const double fifth = melody_.scale.cents(drone_degree(melody_.scale), false);
    const auto note = [&](std::int16_t voice, std::int64_t from, std::int64_t to, double key) {
        return Note{begin + from, to - from, key, voice, soft};
    };
    return {note(0, first, second, key_above(fifth, -12)), note(0, second, third, key_above(0, 0)),
            note(0, third, length, key_above(0, 0)), note(1, 0, length, key_above(0, -12))};
}

/// Returns the voicing of a chord. Those of a given progression are precomputed; the last bar of a piece, with the
/// first chord, adapts to the bar before it. Other chords alternate from bar to bar, independently of their
/// neighbours: with the fifth on top, then with the third.
Accompaniment::Voicing Accompaniment::voicing_of(std::int64_t bar, const Chord& chord) const {
    const std::vector<Voicing> voicings = voicings_of(chord);
    const auto least = [&](auto cost) {
        return *std::min_element(voicings.begin(), voicings.end(),
                                 [&](const Voicing& a, const Voicing& b) { return cost(a) < cost(b); });
    };
    if (progression_.empty()) {
        const double top = chord.cents.size() < 3 ? 0 : chord.cents[bar % 2 == 0 ? 2 : 1];
        return least([&](const Voicing& one) {
            const double apart = std::remainder(one[2] - key_above(top, 0), 12);
            return distance(one) + (one[2] != silent && std::fabs(apart) > 0.01 ? unrest_of_parallels : 0);
        });
    }
    const auto size = static_cast<std::int64_t>(progression_.size());
    const auto at = static_cast<std::size_t>(bar % size);
    if (&chord == &melody_.progression[at]) return progression_[at];
    const Voicing& before = progression_[static_cast<std::size_t>((bar + size - 1) % size)];
    return least([&](const Voicing& one) { return unrest(before, one); });
}

/// All positions of the upper tones of a chord within their range.
std::vector<Accompaniment::Voicing> Accompaniment::voicings_of(const Chord& chord) const {
    const double tonic = melody_.tonic + melody_.transpose;
    const double bass = key_above(chord.cents.front(), bass_register);
    const auto places = [&](std::size_t tone) {
        std::vector<double> keys;
        const double lowest = key_above(chord.cents[tone], lowest_tone);
        for (double key = lowest; key <= std::min(tonic + highest_tone, 127.0); key += 12) keys.push_back(key);
        if (keys.empty()) keys.push_back(lowest);
        return keys;
    };
    if (chord.cents.size() < 2) return {{bass, silent, silent}};
    std::vector<Voicing> voicings;
    if (chord.cents.size() == 2) {
        for (const double key : places(1)) voicings.push_back({bass, key, silent});
        if (interval_class(chord.cents[0] / 100, chord.cents[1] / 100) != 7) return voicings;
        // Alternatives to parallel fifths: the root alone, in octaves, or the fifth in the bass.
        const double other = key_above(chord.cents[1], bass_register);
        for (const double key : places(0)) {
            voicings.push_back({bass, key, silent});
            voicings.push_back({other, key, silent});
        }
        return voicings;
    }
    Voicing any{};
    for (const double third : places(1)) {
        for (const double fifth : places(2)) {
            any = {bass, std::min(third, fifth), std::max(third, fifth)};
            if (any[1] < bass + least_above_bass || any[2] - any[1] > widest_pair) continue;
            voicings.push_back(any);
        }
    }
    if (voicings.empty()) voicings.push_back(any);
    return voicings;
}

double Accompaniment::distance(const Voicing& voicing) const {
    const bool is_pair = voicing[2] == silent;
    const double top = is_pair ? voicing[1] : voicing[2];
    const double middle = melody_.tonic + melody_.transpose + middle_tone;
    const double off = unrest_off_middle * std::fabs((voicing[1] + top) / 2 - middle);
    if (!is_pair || voicing[1] == silent) return off;
    const int interval = interval_class(voicing[0], voicing[1]);
    return off + (interval == 0 ? unrest_of_octave : interval == 5 ? unrest_of_fourth : 0);
}

/// Semitones by which the upper voices move, with penalties for their position and for parallels.
double Accompaniment::unrest(const Voicing& before, const Voicing& voicing) const {
    double sum = distance(voicing);
    for (std::size_t i = 1; i < voicing.size(); ++i) {
        if (before[i] == silent || voicing[i] == silent) continue;
        sum += std::fabs(voicing[i] - before[i]);
        for (std::size_t below = 0; below < i; ++below) {
            if (is_parallel(before[below], before[i], voicing[below], voicing[i])) sum += unrest_of_parallels;
        }
    }
    return sum;
}

/// Chooses the voicings with the least penalty over all chords, including the step from the last to the first.
void Accompaniment::lead_progression() {
    std::vector<std::vector<Voicing>> choices;
    for (const Chord& chord : melody_.progression) choices.push_back(voicings_of(chord));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < choices.front().size(); ++first) {
        std::vector<double> costs(choices.front().size(), std::numeric_limits<double>::infinity());
        costs[first] = 0;
        std::vector<std::vector<std::size_t>> origins;  // best choice before each choice of a chord
        for (std::size_t i = 1; i <= choices.size(); ++i) {
            const std::vector<Voicing>& from = choices[i - 1];
            const std::vector<Voicing>& to = choices[i % choices.size()];
            std::vector<double> next(to.size(), std::numeric_limits<double>::infinity());
            std::vector<std::size_t>& origin = origins.emplace_back(to.size(), 0);
            for (std::size_t a = 0; a < from.size(); ++a) {
                for (std::size_t b = 0; b < to.size(); ++b) {
                    const double cost = costs[a] + unrest(from[a], to[b]);
                    if (cost >= next[b]) continue;
                    next[b] = cost;
                    origin[b] = a;
                }
            }
            costs = std::move(next);
        }
        if (costs[first] >= least) continue;
        least = costs[first];
        progression_.assign(choices.size(), {});
        std::size_t chosen = first;
        for (std::size_t i = choices.size(); i-- > 0;) {
            chosen = origins[i][chosen];
            progression_[i] = choices[i][chosen];
        }
    }
}

}  // namespace sikku::mapping
