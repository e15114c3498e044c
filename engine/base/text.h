// engine/base/text.h: trims, escapes, compares and formats texts for output files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Converts ASCII letters to lower case, in any locale; keeps other bytes.
std::string lower_case(std::string_view text);

/// Returns `text` without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Removes the first line from `text` and returns it without its line feed.
std::string_view take_line(std::string_view& text);

/// Removes the first word and the separators before it from `text` and returns the word; empty at the end.
std::string_view take_word(std::string_view& text, std::string_view separators = " \t");
/// All of these words. Memory: 16 bytes for each.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators = " \t");

/// True if XML 1.0 can contain `text`: UTF-8 without control characters.
bool fits_xml(std::string_view text);
/// Escapes text for elements and double-quoted attributes of XML and HTML; U+FFFD replaces invalid characters.
std::string xml_escaped(std::string_view text);

/// Returns JSON on one line with control characters (C0, DEL, C1) and the line separators U+2028 and U+2029 escaped,
/// so that terminals, JavaScript and line readers see plain text. Such characters can only occur in strings.
std::string plain_json(std::string_view json);
/// Formats a string of such JSON with its quotes; `text` is UTF-8.
std::string json_string(std::string_view text);

/// Appends a code point (up to U+10FFFF) in UTF-8.
void append_utf8(std::uint32_t code, std::string& text);
/// The code point of a character in valid UTF-8.
std::uint32_t code_point(std::string_view character);

/// `; did you mean 'a', 'b' or 'c'?`, or empty without names.
std::string did_you_mean(std::span<const std::string_view> names);
/// The same for a single name; empty if `near` is empty.
std::string did_you_mean(std::string_view near);

/// Joins words as `a, b or c`.
std::string alternatives(std::span<const std::string_view> words);

/// `1 note`, `2 notes`.
std::string counted(std::uint64_t count, std::string_view what);
/// The same for a number in decimal digits.
std::string counted(std::string_view digits, std::string_view what);
/// A whole number in decimal digits for messages: `about 10^602` instead of more than 40 digits.
std::string readable(std::string digits);

/// Formats a duration: `320 ms`, `3.2 s`, `1 min 20 s`, `2.5 h`; above about three centuries in years.
std::string time_text(double seconds);
/// Formats a size: `17 kB`, `1.2 GB`.
std::string bytes_text(double bytes);

/// Formats a word for the command line of a shell, quoted if necessary.
std::string shell_word(const std::string& word);

/// Two lower-case hexadecimal digits for each byte.
std::string to_hex(std::string_view bytes);

/// Edit distance in bytes: the fewest substitutions, deletions, insertions and exchanges of neighbours that turn `a`
/// into `b` (optimal string alignment). Cost: product of the lengths.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace sikku
