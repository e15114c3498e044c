// engine/geometry/lettering.h: writes text in a font of single strokes, which all formats and plotters can draw.
#pragma once

#include "engine/geometry/path.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Lengths are in the unit of the sink; `height` is that of a capital letter. Text is UTF-8: printable ASCII, Latin
/// letters with their accents (also as combining marks), dashes, quotation marks, currencies, fractions and other
/// signs of titles, and modern Tamil. Other characters, and bytes that are not UTF-8, become a box; a line break is a
/// space.

/// Height of accents above capital letters, and of descenders below the line, as parts of the height.
constexpr double letter_ascent = 1.4;
constexpr double letter_descent = 0.4;

/// From the beginning of the text to where the next would begin.
double text_width(std::string_view utf8, double height);

/// Does the font have every character of it?
bool has_letters(std::string_view utf8);

/// Lists the characters of several texts that the font lacks, each once, for messages: `日 (U+65E5)`; empty if none
/// is missing.
std::string missing_letters(const std::vector<std::string>& texts);

/// Returns a warning about missing characters. @param missing  a list of them that is not empty
std::string letters_warning(const std::string& missing);

/// Writes from `start`, on the line that letters stand on, to the right, with y up: strokes of lines and curves.
void write_text(std::string_view utf8, glm::dvec2 start, double height, const Pen& pen, PathSink& sink);

/// The text if it is at most `width` wide, else as much of its beginning as fits with `…` after it.
std::string shortened(std::string_view utf8, double height, double width);

/// The text in at most `most` lines (at least one) of at most that width, broken at spaces, within a word only where
/// it has no line for itself. What is left over in the last line is shortened.
std::vector<std::string> wrapped(std::string_view utf8, double height, double width, std::size_t most);

}  // namespace sikku
