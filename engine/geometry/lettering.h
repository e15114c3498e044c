// engine/geometry/lettering.h: writes text in a font of single strokes, which all formats and plotters can draw.
#pragma once

#include "engine/geometry/path.h"

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Lengths are in the unit of the sink; `height` is that of a capital letter. Text is UTF-8: printable ASCII, Latin
/// letters with their accents (also as combining marks), dashes, quotation marks, currencies, fractions and other
/// signs of titles, and modern Tamil. Other characters, and bytes that are not UTF-8, become a box; a line break is a
/// space.

/// Height of accented capital letters, and depth of descenders below the baseline, as parts of the height.
constexpr double letter_ascent = 1.4;
constexpr double letter_descent = 0.4;

/// Width from the beginning of a text to that of the next.
double text_width(std::string_view utf8, double height);

/// Splits a text into its letters, with their marks; Tamil into syllables.
std::vector<std::string_view> letters_of(std::string_view utf8);

/// True if the font contains every character of the text.
bool has_letters(std::string_view utf8);

/// Lists the characters of several texts that the font lacks, each once, for messages: `日 (U+65E5)`; empty if none
/// is missing.
std::string missing_letters(const std::vector<std::string>& texts);

/// Lists the first characters of texts in the same way, for other fonts.
std::string list_of_characters(const std::vector<std::string_view>& characters);

/// Returns a warning about missing characters. @param missing  a list of them that is not empty
std::string letters_warning(const std::string& missing);

/// Writes text from `start` on the baseline to the right, with y up, as strokes of lines and curves.
void write_text(std::string_view utf8, glm::dvec2 start, double height, const Pen& pen, PathSink& sink);

/// The text if it is at most `width` wide, else as much of its beginning as fits with `…` after it.
std::string shortened(std::string_view utf8, double height, double width);

/// Breaks a text into at most `most` lines (at least one) of at most that width: at spaces; a word longer than a line
/// breaks after a hyphen, or else between any characters. The rest is shortened in the last line.
std::vector<std::string> wrapped(std::string_view utf8, double height, double width, std::size_t most);

/// Where lines of a text end, for other fonts.
struct TextCuts {
    std::function<std::size_t(std::string_view)> fitting;    ///< bytes of the longest beginning that fits
    std::function<std::string(std::string_view)> shortened;  ///< the text, or as much of it as fits with `…`
};
/// Breaks a text likewise.
std::vector<std::string> wrapped(std::string_view utf8, std::size_t most, const TextCuts& cuts);

}  // namespace sikku
