#include "music/score/syllables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace sikku {
namespace {

constexpr int most_dots = 2;

/// A name with dots for its octave, -2 to 2 from `octave` 0 to 4. Fonts have some letters with a dot.
std::string dotted(std::string_view name, std::size_t octave) {
    struct Whole {
        std::string_view name, below, above;
    };
    static constexpr std::array<Whole, 12> whole = {{{"S", "\u1E62", "\u1E60"},
                                                     {"r", "\u1E5B", "\u1E59"},
                                                     {"R", "\u1E5A", "\u1E58"},
                                                     {"g", "", "\u0121"},
                                                     {"G", "", "\u0120"},
                                                     {"m", "\u1E43", "\u1E41"},
                                                     {"M", "\u1E42", "\u1E40"},
                                                     {"P", "", "\u1E56"},
                                                     {"d", "\u1E0D", "\u1E0B"},
                                                     {"D", "\u1E0C", "\u1E0A"},
                                                     {"n", "\u1E47", "\u1E45"},
                                                     {"N", "\u1E46", "\u1E44"}}};
    static constexpr std::array<std::string_view, 5> dots = {"\u0323", "\u0323", "", "\u0307", "\u0307"};
    std::string text(name);
    text += dots[octave];
    for (const Whole& one : whole) {
        const std::string_view letter = octave < 2 ? one.below : one.above;
        if (one.name == name && octave != 2 && !letter.empty()) text = letter;
    }
    return octave == 0 || octave == 4 ? text.append(dots[octave]) : text;
}

/// All syllables of a kind: by letter, octave and sign.
class SyllableTable {
public:
    /// Names with a flat, plain and with a sharp, as compared with the major scale.
    using Names = std::array<std::array<std::string_view, 3>, 7>;
    SyllableTable(const Names& names, bool has_dots) {
        for (std::size_t letter = 0; letter < 7; ++letter) {
            for (std::size_t octave = 0; octave < 5; ++octave) {
                for (std::size_t sign = 0; sign < 3; ++sign) {
                    const std::string_view name = names[letter][sign];
                    texts_[letter][octave][sign] = has_dots ? dotted(name, octave) : std::string(name);
                }
            }
        }
    }
    std::string_view at(int letter, int octave, int sign) const {
        return texts_[static_cast<std::size_t>(letter)]
                     [static_cast<std::size_t>(std::clamp(octave, -most_dots, most_dots) + most_dots)]
                     [static_cast<std::size_t>(std::clamp(sign, -1, 1) + 1)];
    }

private:
    std::array<std::array<std::array<std::string, 3>, 5>, 7> texts_;
};

const SyllableTable& table_of(Syllables kind) {
    static const SyllableTable sargam({{{"S", "S", "S"},
                                        {"r", "R", "R"},
                                        {"g", "G", "G"},
                                        {"m", "m", "M"},
                                        {"P", "P", "P"},
                                        {"d", "D", "D"},
                                        {"n", "N", "N"}}},
                                      true);
    static const SyllableTable degrees({{{"\u266D1", "1", "\u266F1"},
                                         {"\u266D2", "2", "\u266F2"},
                                         {"\u266D3", "3", "\u266F3"},
                                         {"\u266D4", "4", "\u266F4"},
                                         {"\u266D5", "5", "\u266F5"},
                                         {"\u266D6", "6", "\u266F6"},
                                         {"\u266D7", "7", "\u266F7"}}},
                                       true);
    static const SyllableTable solfa({{{"de", "do", "di"},
                                       {"ra", "re", "ri"},
                                       {"me", "mi", "mis"},
                                       {"fe", "fa", "fi"},
                                       {"se", "sol", "si"},
                                       {"le", "la", "li"},
                                       {"te", "ti", "tis"}}},
                                     false);
    return kind == Syllables::sargam ? sargam : kind == Syllables::degrees ? degrees : solfa;
}

}  // namespace

std::string_view syllable_of(Syllables kind, const Pitch& pitch, const KeyOfBars& key) {
    if (kind == Syllables::none) return {};
    static constexpr std::array<int, 7> major = {0, 2, 4, 5, 7, 9, 11};
    const int above = pitch.height() - key.tonic.height();
    const int letter = (above % 7 + 7) % 7;
    const int octave = (above - letter) / 7;
    const double usual = key.tonic.key() + 12 * octave + major[static_cast<std::size_t>(letter)];
    return table_of(kind).at(letter, octave, static_cast<int>(std::lround(pitch.key() - usual)));
}

}  // namespace sikku
