#include "music/score/syllables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace sikku {
namespace {

constexpr int most_dots = 2;

/// All syllables of a kind: by letter, octave and sign.
class SyllableTable {
public:
    SyllableTable(const std::array<std::string_view, 7>& names, bool has_dots, bool has_signs) {
        static constexpr std::array<std::string_view, 5> dots = {"\u0323\u0323", "\u0323", "", "\u0307",
                                                                 "\u0307\u0307"};
        static constexpr std::array<std::string_view, 3> signs = {"\u266D", "", "\u266F"};
        for (std::size_t letter = 0; letter < 7; ++letter) {
            for (std::size_t octave = 0; octave < dots.size(); ++octave) {
                for (std::size_t sign = 0; sign < signs.size(); ++sign) {
                    std::string& text = texts_[letter][octave][sign];
                    if (has_signs) text += signs[sign];
                    text += names[letter];
                    if (has_dots) text += dots[octave];
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
    static const SyllableTable sargam({"S", "R", "G", "M", "P", "D", "N"}, true, false);
    static const SyllableTable degrees({"1", "2", "3", "4", "5", "6", "7"}, true, true);
    static const SyllableTable solfa({"do", "re", "mi", "fa", "sol", "la", "ti"}, false, false);
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
