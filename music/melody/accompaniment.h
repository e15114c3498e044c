// music/melody/accompaniment.h: notes of drones and chords.
#pragma once

#include "music/melody/melody.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sikku::mapping {

/// Plays the drone or the chords of a melody, bar by bar. Chords have their root in the bass, and two voices above it
/// that move as little as possible; no two voices move in parallel fifths or octaves where the chords permit. Chords
/// of two tones have one voice above the bass, which may be their fifth. The figure of the melody is their rhythm.
class Accompaniment {
public:
    explicit Accompaniment(const Melody& melody);

    /// The notes of a bar that begins at tick `begin`; voices are counted from 0.
    /// @param chord  chord of the bar; null for a drone
    /// @param is_last  the last bar of the melody, in which chords are held
    /// @param next  chord of the next bar; null if it is unknown
    std::vector<Note> bar(std::int64_t begin, const Chord* chord, const Chord* next = nullptr,
                          bool is_last = false) const;

private:
    /// Keys of the bass, the lower and the upper voice above it; voices without a tone of their own are silent.
    using Voicing = std::array<double, 3>;

    std::vector<Note> drone(std::int64_t begin) const;
    void strike(const Figure::Stroke& stroke, Note note, const Chord& chord, const Voicing& keys, double next_bass,
                std::vector<Note>& notes) const;
    double tone_above(const Chord& chord, double cents, double bass) const;
    static double half_step_to(double next_bass, double from);
    Voicing voicing_of(std::int64_t bar, const Chord& chord) const;
    std::vector<Voicing> voicings_of(const Chord& chord) const;
    void lead_progression();
    double unrest(const Voicing& before, const Voicing& voicing) const;
    double distance(const Voicing& voicing) const;
    /// The key `cents` above the tonic, moved by octaves to within an octave above `lowest`.
    double key_above(double cents, double lowest) const;

    const Melody& melody_;
    std::vector<Voicing> progression_;  // one voicing for each chord
};

}  // namespace sikku::mapping
