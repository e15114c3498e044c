// engine/geometry/tamil.h: the letters of Tamil as single strokes, and the syllables that are written with them.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// A part of a letter that is written without lifting the pen, in units of a 21st of a capital letter's height, y up
/// from the baseline.
struct LetterStroke {
    struct Piece {
        bool is_curve = false;
        glm::dvec2 first{0.0}, second{0.0};  ///< control points of a Bézier
        glm::dvec2 end{0.0};
    };
    glm::dvec2 start{0.0};
    std::vector<Piece> pieces;
    bool is_closed = false;
};

/// A written syllable, or a letter by itself.
struct TamilSyllable {
    std::vector<LetterStroke> strokes;
    double width = 0.0;          ///< distance to the beginning of the next
    std::size_t characters = 0;  ///< number of code points
};

/// The syllable with which a text begins: a vowel, or a consonant with its vowel sign or pulli; signs that are
/// written to the left of the consonant stand there, signs in two parts on both sides, and u and uu have the form
/// that each consonant gives them. Signs without a consonant stand alone. Nullopt if the text begins with anything
/// else. The letters are our own: arcs of ellipses between points of horizontal and vertical tangents. Source: The
/// Unicode Standard 15, 12.6 Tamil: vowel reordering, vowel splitting, ligatures.
std::optional<TamilSyllable> tamil_syllable(std::u32string_view text);

}  // namespace sikku
