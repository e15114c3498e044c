// engine/import/fractint_entry.h: reads an entry of a Fractint collection.
#pragma once

#include "engine/base/characters.h"
#include "engine/import/fractint_factors.h"
#include "engine/import/import.h"

#include <bitset>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::fractint {

/// A command or symbol; `[` and `]` too.
struct Token {
    char letter = 0;
    std::int8_t root = 0;    ///< for @: exponent of the factor in halves
    std::uint16_t base = 0;  ///< for @: index of its number in Entry::factors
    std::uint32_t at = 0;
    double number = 0.0;  ///< for \ / c < >
};
using Tokens = std::vector<Token>;

inline bool is_step(char letter) {
    return letter == 'f' || letter == 'g' || letter == 'd' || letter == 'm';
}
inline bool is_letter(char letter) {
    return letter >= 'a' && letter <= 'z';
}
inline bool is_plain(char letter) {
    return is_letter(letter) || is_digit(letter) || letter == '_';
}
inline bool takes_number(char letter) {
    return letter == '@' || letter == '\\' || letter == '/' || letter == 'c' || letter == '<' || letter == '>';
}
inline std::size_t index_of(char letter) {
    return static_cast<unsigned char>(letter);
}

/// Position of the first `wanted` in [begin, end), or `end`.
std::size_t find_before(const std::string& text, char wanted, std::size_t begin, std::size_t end);

/// Thrown after an error in an entry was reported.
struct BadEntry {};

/// Reports an error and abandons the entry.
[[noreturn]] inline void fail(const SourcePointer& file, Diagnostics& diagnostics, std::size_t at,
                              const std::string& message) {
    diagnostics.error({file, at, 1}, message);
    throw BadEntry();
}

/// A set of letters.
using Flags = std::bitset<256>;
inline Flags flags_of(std::string_view list) {
    Flags flags;
    for (const char letter : list) flags.set(index_of(letter));
    return flags;
}

struct Entry {
    std::string name;
    std::size_t at = 0;  ///< beginning of the entry
    std::string comments;
    int angle = 0;  ///< turns are 360 degrees divided by this number
    Tokens axiom;
    std::map<char, Tokens> rules;
    Factors factors;  ///< factors of the distinct numbers after @

    /// The rule of a letter, or null.
    const Tokens* rule_of(char letter) const {
        const auto found = rules.find(letter);
        return found == rules.end() ? nullptr : &found->second;
    }
    /// Position of the first of these letters.
    std::size_t first_of(std::string_view list) const;
};

/// Reads the text between the braces of an entry. @throws BadEntry after reporting an error
Entry read_entry(const SourcePointer& file, std::string name, std::size_t at, std::size_t begin, std::size_t end,
                 Diagnostics& diagnostics);

}  // namespace sikku::fractint
