#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sikku {
namespace {

using Spellings = std::array<std::optional<Spelling>, 12>;

int modulo(int value, int by) {
    return (value % by + by) % by;
}

int pitch_class(Spelling spelling) {
    return modulo(letter_semitones(spelling.letter) + spelling.alteration, 12);
}

/// Fifths above C: F is -1, B is 5, F# is 6.
int line_of_fifths(Spelling spelling) {
    static constexpr std::array<int, 7> position = {0, 2, 4, -1, 1, 3, 5};
    return position[static_cast<std::size_t>(spelling.letter)] + 7 * spelling.alteration;
}

Spelling from_line_of_fifths(int position) {
    static constexpr std::array<int, 7> letter = {3, 0, 4, 1, 5, 2, 6};
    const int from_f = position + 1;
    const int place = modulo(from_f, 7);
    return {letter[static_cast<std::size_t>(place)], (from_f - place) / 7};
}

/// A simpler spelling of the same key, without E#, B#, Cb, Fb and double signs.
Spelling simplified(Spelling spelling) {
    const int position = line_of_fifths(spelling);
    if (position >= -6 && position <= 10) return spelling;
    return from_line_of_fifths(position > 0 ? modulo(position + 1, 12) - 1 : modulo(position + 6, 12) - 6);
}

bool closes_at_the_octave(const Scale& scale) {
    return std::fabs(scale.period - 1200.0) < 25.0;
}

/// The pitch class nearest to a number of cents, 0 to 11.
int nearest_class(double cents) {
    return static_cast<int>(std::lround(std::fmod(cents, 1200.0) / 100.0) % 12 + 12) % 12;
}

/// The scale in semitones above its tonic, both directions.
std::array<bool, 12> classes_of(const Scale& scale) {
    std::array<bool, 12> found{};
    for (const auto* list : {&scale.ascent, &scale.descent}) {
        for (const double cents : *list) found[static_cast<std::size_t>(nearest_class(cents))] = true;
    }
    return found;
}

bool prefers_flats(const Scale& scale, const std::array<bool, 12>& classes) {
    return scale.id.find("blues") != std::string::npos || (classes[3] && !classes[4]);
}

/// Gives every degree of a list of seven its own letter; pitch classes that have a letter keep it.
void spell_degrees(std::vector<double> cents, Spelling tonic, Spellings& result) {
    std::sort(cents.begin(), cents.end());
    const auto set = [&](int semitones, int letter) {
        const int found = modulo(pitch_class(tonic) + semitones, 12);
        auto& entry = result[static_cast<std::size_t>(found)];
        int alteration = modulo(found - letter_semitones(letter), 12);
        if (alteration > 6) alteration -= 12;
        if (!entry && alteration >= -2 && alteration <= 2) entry = Spelling{letter, alteration};
    };
    for (int i = 0; i < 7; ++i) set(nearest_class(cents[static_cast<std::size_t>(i)]), (tonic.letter + i) % 7);
    // A quarter tone has the letter of its degree from both sides.
    for (int i = 0; i < 7; ++i) {
        const double semitones = cents[static_cast<std::size_t>(i)] / 100.0;
        if (std::fabs(semitones - std::round(semitones)) < 0.25) continue;
        set(static_cast<int>(std::floor(semitones)), (tonic.letter + i) % 7);
        set(static_cast<int>(std::ceil(semitones)), (tonic.letter + i) % 7);
    }
}

/// Number of notes of the scale that share a letter with another, if spelled by twelve fifths from `first` on.
int shared_letters(const std::array<bool, 12>& classes, int tonic_position, int first) {
    std::array<int, 7> used{};
    for (int position = first; position < first + 12; ++position) {
        if (!classes[static_cast<std::size_t>(modulo(7 * position, 12))]) continue;
        const Spelling spelling = simplified(from_line_of_fifths(tonic_position + position));
        ++used[static_cast<std::size_t>(spelling.letter)];
    }
    int shared = 0;
    for (const int count : used) shared += std::max(0, count - 1);
    return shared;
}

}  // namespace

int letter_semitones(int letter) {
    static constexpr std::array<int, 7> semitones = {0, 2, 4, 5, 7, 9, 11};
    return semitones[static_cast<std::size_t>(letter)];
}

std::array<Spelling, 12> spell(const Scale& scale, Spelling tonic) {
    Spellings found;
    std::array<bool, 12> classes{};
    if (closes_at_the_octave(scale)) {
        classes = classes_of(scale);
        if (scale.ascent.size() == 7) spell_degrees(scale.ascent, tonic, found);
        if (scale.descent.size() == 7) spell_degrees(scale.descent, tonic, found);
    }

    const int tonic_position = line_of_fifths(tonic);
    std::vector<int> firsts = {-5, -4, -3, -2, -1};
    firsts.insert(prefers_flats(scale, classes) ? firsts.begin() : firsts.end(), -6);
    int best = firsts.front();
    int fewest = std::numeric_limits<int>::max();
    for (const int first : firsts) {
        const int shared = shared_letters(classes, tonic_position, first);
        if (shared < fewest) {
            fewest = shared;
            best = first;
        }
    }

    std::array<Spelling, 12> result{};
    for (int position = best; position < best + 12; ++position) {
        const Spelling spelling = from_line_of_fifths(tonic_position + position);
        const auto at = static_cast<std::size_t>(pitch_class(spelling));
        result[at] = found[at].value_or(simplified(spelling));
    }
    return result;
}

std::optional<KeySignature> key_signature(const Scale& scale, Spelling tonic) {
    if (!closes_at_the_octave(scale) || scale.ascent.size() != 7) return std::nullopt;
    const auto semitones_of = [](std::vector<double> cents) -> std::optional<std::vector<int>> {
        std::sort(cents.begin(), cents.end());
        std::vector<int> result;
        for (const double value : cents) {
            if (!(std::fabs(value - 100.0 * std::round(value / 100.0)) < 25.0)) return std::nullopt;
            result.push_back(static_cast<int>(std::lround(value / 100.0)));
        }
        return result;
    };
    const auto ascent = semitones_of(scale.ascent);
    if (!ascent || (!scale.descent.empty() && semitones_of(scale.descent) != ascent)) return std::nullopt;

    // Modes are the stretches of seven fifths that contain the tonic; the start of its stretch determines a mode.
    for (int below = 0; below < 7; ++below) {
        std::vector<int> mode;
        for (int position = -below; position < 7 - below; ++position) mode.push_back(modulo(7 * position, 12));
        std::sort(mode.begin(), mode.end());
        if (mode != *ascent) continue;
        // In major one note lies below the tonic on the line of fifths: F, in C major.
        const int fifths = line_of_fifths(tonic) + 1 - below;
        if (fifths < -7 || fifths > 7) return std::nullopt;
        return KeySignature{fifths, below == 4, static_cast<Mode>(below)};
    }
    return std::nullopt;
}

std::optional<KeySignature> print_signature(const Scale& scale, Spelling tonic) {
    if (!closes_at_the_octave(scale)) return std::nullopt;
    for (const auto* list : {&scale.ascent, &scale.descent}) {
        for (const double cents : *list) {
            if (std::fabs(cents - 100.0 * std::round(cents / 100.0)) > 25.0) return std::nullopt;
        }
    }
    const std::array<bool, 12> classes = classes_of(scale);
    const auto notes = std::count(classes.begin(), classes.end(), true);
    if (notes < 5 || notes > 8) return std::nullopt;
    const std::array<Spelling, 12> spelling = spell(scale, tonic);
    /// Notes of the scale that need a sign of their own.
    const auto signs_with = [&](int fifths) {
        int count = 0;
        for (int semitones = 0; semitones < 12; ++semitones) {
            if (!classes[static_cast<std::size_t>(semitones)]) continue;
            const Spelling note = spelling[static_cast<std::size_t>(modulo(pitch_class(tonic) + semitones, 12))];
            const int natural = line_of_fifths({note.letter, 0});  // F is -1
            const int altered = fifths > natural + 1 ? 1 : -fifths > 5 - natural ? -1 : 0;
            if (altered != note.alteration) ++count;
        }
        return count;
    };
    using enum Mode;
    std::optional<KeySignature> best;
    int fewest = notes == 7 ? 3 : 2;
    for (const Mode mode : {major, minor, mixolydian, dorian, phrygian, lydian, locrian}) {
        const int fifths = line_of_fifths(tonic) + 1 - static_cast<int>(mode);
        if (fifths < -7 || fifths > 7) continue;
        const int signs = signs_with(fifths);
        if (signs >= fewest || (signs > 0 && signs >= signs_with(0))) continue;
        fewest = signs;
        best = KeySignature{fifths, mode == minor, mode};
    }
    return best;
}

std::string note_name(double key, const std::array<Spelling, 12>& spelling) {
    const int nearest = static_cast<int>(std::lround(key));
    const Spelling found = spelling[static_cast<std::size_t>(modulo(nearest, 12))];
    const int octave = (nearest - found.alteration - letter_semitones(found.letter)) / 12 - 1;
    return fmt::format(
        "{}{}{}", "CDEFGAB"[found.letter],
        std::string(static_cast<std::size_t>(std::abs(found.alteration)), found.alteration > 0 ? '#' : 'b'), octave);
}

std::optional<Tonic> parse_note(std::string_view text) {
    if (text.empty()) return std::nullopt;
    constexpr std::string_view letters = "CDEFGABcdefgab";
    const std::size_t letter = letters.find(text.front());
    if (letter == std::string_view::npos) return std::nullopt;
    text.remove_prefix(1);
    Tonic tonic;
    tonic.spelling.letter = static_cast<int>(letter % 7);
    const auto take = [&](std::string_view sign) {
        if (!text.starts_with(sign)) return false;
        text.remove_prefix(sign.size());
        return true;
    };
    if (take("\u266F")) {
        tonic.spelling.alteration = 1;
    } else if (take("\u266D")) {
        tonic.spelling.alteration = -1;
    } else {
        while (tonic.spelling.alteration < 2 && tonic.spelling.alteration >= 0 && take("#")) {
            ++tonic.spelling.alteration;
        }
        while (tonic.spelling.alteration > -2 && tonic.spelling.alteration <= 0 && take("b")) {
            --tonic.spelling.alteration;
        }
    }
    int octave = 4;
    if (text == "-1") {
        octave = -1;
    } else if (text.size() == 1 && text.front() >= '0' && text.front() <= '9') {
        octave = text.front() - '0';
    } else if (!text.empty()) {
        return std::nullopt;
    }
    tonic.key = 12 * (octave + 1) + letter_semitones(tonic.spelling.letter) + tonic.spelling.alteration;
    return tonic;
}

}  // namespace sikku
