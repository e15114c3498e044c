#include "music/score/transposing.h"

#include "music/score/spelling.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <optional>

namespace sikku {
namespace {

/// A key moved along the fifths. @param letters  receives the letters by which notes move, so that they fit it
std::optional<KeySignature> moved(std::optional<KeySignature> key, const Transposition& by, int& letters) {
    constexpr int most_signs = 7, enharmonic = 12;
    letters = by.letters;
    if (!key) return key;
    key->fifths += 7 * by.semitones - 12 * by.letters;
    if (key->fifths > most_signs) {
        key->fifths -= enharmonic;
        ++letters;
    } else if (key->fifths < -most_signs) {
        key->fifths += enharmonic;
        --letters;
    }
    return key;
}

/// The sign of a pitch class written with a letter.
int alteration_of(int pitch_class, int letter) {
    return (pitch_class - letter_semitones(letter) + 18) % 12 - 6;
}

std::array<Spelling, 12> moved(const std::array<Spelling, 12>& spelling, int semitones, int letters, bool has_key) {
    std::array<Spelling, 12> result{};
    for (int i = 0; i < 12; ++i) {
        const int pitch_class = (i + semitones) % 12;
        int letter = (spelling[static_cast<std::size_t>(i)].letter + letters) % 7;
        const auto natural_of = [&](int other) { return alteration_of(pitch_class, other) == 0; };
        // Without a key, a white key is written as such.
        for (const int other : {(letter + 1) % 7, (letter + 6) % 7}) {
            if (!has_key && alteration_of(pitch_class, letter) != 0 && natural_of(other)) letter = other;
        }
        result[static_cast<std::size_t>(pitch_class)] = {letter, alteration_of(pitch_class, letter)};
    }
    return result;
}

}  // namespace

void transpose(PrintedPart& part, const Transposition& by) {
    for (std::vector<Note>& voice : part.voices) {
        for (Note& note : voice) note.key += by.semitones;
    }
    int letters = by.letters;
    for (KeyOfBars& key : part.keys) {
        key.key = moved(key.key, by, letters);
        key.spelling = moved(key.spelling, by.semitones, letters, key.key.has_value());
        key.tonic = spelled(key.tonic.key() + by.semitones, key.spelling);
    }
    part.part.key = moved(part.part.key, by, letters);
    part.part.signature = moved(part.part.signature, by, letters);
    part.part.spelling = moved(part.part.spelling, by.semitones, letters, printed_key(part.part).has_value());
}

}  // namespace sikku
