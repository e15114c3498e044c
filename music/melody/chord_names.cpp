#include "music/melody/chord_names.h"

#include "music/score/chord_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::array<std::string_view, 7> numerals = {"I", "II", "III", "IV", "V", "VI", "VII"};
constexpr std::size_t longest_name = 32;
constexpr std::array<double, 7> major_cents = {0, 200, 400, 500, 700, 900, 1100};

const ChordQuality* find_quality(std::string_view name) {
    for (const ChordQuality& one : chord_qualities()) {
        if (one.name == name) return &one;
    }
    return nullptr;
}

/// A name with signs written as letters.
std::string plain(std::string_view name) {
    static constexpr std::pair<std::string_view, std::string_view> signs[] = {
        {"♭", "b"},     {"♯", "#"},    {"°", "dim"}, {"ø7", "m7b5"}, {"ø", "m7b5"},
        {"Δ7", "maj7"}, {"Δ", "maj7"}, {"+", "aug"}, {"M7", "maj7"}, {"min", "m"}};
    std::string text(name);
    for (const auto& [sign, letters] : signs) {
        for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at + letters.size())) {
            text.replace(at, sign.size(), letters);
        }
    }
    return text;
}

/// Removes accidentals of one kind from the start of a text; returns their sum in semitones.
int take_accidentals(std::string_view& text) {
    int sum = 0;
    for (const char sign : {'#', 'b'}) {
        while (sum > -2 && sum < 2 && text.starts_with(sign)) {
            text.remove_prefix(1);
            sum += sign == '#' ? 1 : -1;
        }
        if (sum != 0) break;
    }
    return sum;
}

Chord chord_of(const ChordQuality& quality, double root, const Scale& scale) {
    Chord chord;
    chord.quality = static_cast<int>(&quality - chord_qualities().data());
    chord.root = root;
    for (const int tone : quality.tones) {
        if (tone >= 0) chord.cents.push_back(root + 100 * tone);
    }
    mark_tones(chord, scale);
    return chord;
}

/// A numeral with what follows it.
struct Numeral {
    std::size_t number = 0;  ///< 0 for I
    int accidental = 0;
    bool is_minor = false;     ///< written in small letters
    std::string_view quality;  ///< the rest

    double in_major() const { return major_cents[number] + 100 * accidental; }
    /// Cents of its degree in a scale: degrees with accidentals are those of the major scale.
    double in(const Scale& scale) const {
        return accidental != 0 ? in_major() : scale.cents(degree_of_numeral(scale, number), false);
    }
};

std::optional<Numeral> read_numeral(std::string_view text) {
    Numeral numeral;
    numeral.accidental = take_accidentals(text);
    numeral.is_minor = text.starts_with('i') || text.starts_with('v');
    const std::size_t end = std::min(text.find_first_not_of(numeral.is_minor ? "iv" : "IV"), text.size());
    std::string upper(text.substr(0, end));
    for (char& letter : upper) letter = letter == 'i' ? 'I' : letter == 'v' ? 'V' : letter;
    const auto* found = std::find(numerals.begin(), numerals.end(), upper);
    if (found == numerals.end()) return std::nullopt;
    numeral.number = static_cast<std::size_t>(found - numerals.begin());
    numeral.quality = text.substr(end);
    return numeral;
}

/// The quality of a numeral: a suffix to small letters makes minor chords. Chords with a major third have no small
/// letters, except augmented ones.
const ChordQuality* quality_of(const Numeral& numeral) {
    const std::string name(numeral.quality);
    if (!numeral.is_minor) return find_quality(name.empty() ? "maj" : name);
    if (const ChordQuality* minor = find_quality("m" + name)) return minor;
    const ChordQuality* other = find_quality(name);
    return other && other->tones[1] == 4 && name != "aug" ? nullptr : other;
}

std::optional<Chord> numeral_chord(std::string_view name, const Scale& scale) {
    const std::size_t slash = name.find('/');
    const auto numeral = read_numeral(name.substr(0, slash));
    if (!numeral) return std::nullopt;
    const ChordQuality* quality = quality_of(*numeral);
    if (!quality) return std::nullopt;
    if (slash != std::string_view::npos) {
        const auto tonic = read_numeral(name.substr(slash + 1));
        if (!tonic || !tonic->quality.empty()) return std::nullopt;
        return chord_of(*quality, std::fmod(numeral->in_major() + tonic->in(scale) + 2400, 1200), scale);
    }
    if (numeral->quality.empty() && !numeral->is_minor && numeral->accidental == 0) {
        return triad_on(scale, degree_of_numeral(scale, numeral->number));
    }
    return chord_of(*quality, numeral->in(scale), scale);
}

/// The pitch class of a letter with accidentals, which are removed from a text.
std::optional<int> take_letter(std::string_view& text) {
    constexpr std::string_view letters = "CDEFGAB";
    constexpr int classes[] = {0, 2, 4, 5, 7, 9, 11};
    if (text.empty()) return std::nullopt;
    const std::size_t letter = letters.find(text.front());
    if (letter == std::string_view::npos) return std::nullopt;
    text.remove_prefix(1);
    return classes[letter] + take_accidentals(text);
}

std::optional<Chord> letter_chord(std::string_view name, const Scale& scale, double tonic) {
    std::string_view rest = name;
    const auto cents_above = [&](int pitch) { return 100 * (pitch - tonic - 12 * std::floor((pitch - tonic) / 12)); };
    const auto root = take_letter(rest);
    if (!root) return std::nullopt;
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const ChordQuality* quality = find_quality(slash == 0 ? "maj" : rest.substr(0, slash));
    if (!quality) return std::nullopt;
    Chord chord = chord_of(*quality, cents_above(*root), scale);
    if (slash == rest.size()) return chord;
    rest.remove_prefix(slash + 1);
    const auto bass = take_letter(rest);
    if (!bass || !rest.empty()) return std::nullopt;
    // The lowest tone comes first, and sounds once.
    const double low = cents_above(*bass) - 1200;
    std::erase_if(chord.cents, [&](double tone) { return std::fabs(std::remainder(tone - low, 1200)) < 1; });
    // In a seventh chord, the third and the seventh take precedence over the root unless one of them is the bass.
    const bool is_seventh = quality->tones[3] >= 0;
    if (is_seventh && chord.cents.size() >= 3 && chord.cents[2] - chord.cents[0] == 100 * quality->tones[2] &&
        chord.cents[1] - chord.cents[0] == 100 * quality->tones[1]) {
        std::rotate(chord.cents.begin(), chord.cents.begin() + 1, chord.cents.begin() + 3);
    }
    chord.cents.insert(chord.cents.begin(), low);
    mark_tones(chord, scale);
    return chord;
}

}  // namespace

std::optional<Chord> named_chord(std::string_view name, const Scale& scale, double tonic) {
    if (name.size() > longest_name) return std::nullopt;
    const std::string text = plain(name);
    if (auto chord = numeral_chord(text, scale)) return chord;
    return letter_chord(text, scale, tonic);
}

bool is_chord_and_note(std::string_view name) {
    if (name.size() > longest_name) return false;
    const std::string text = plain(name);
    std::string_view rest = text;
    return take_letter(rest) && (rest.empty() || (rest.size() == 1 && find_quality(rest)));
}

}  // namespace sikku
