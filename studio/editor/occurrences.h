// studio/editor/occurrences.h: the names in the text of a pattern, and their meanings.
#pragma once

#include "engine/language/pattern.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

struct KeyInfo;

/// True for keys whose value is a word or a list of symbols.
bool has_symbols(const KeyInfo& key);

/// What a name in a pattern denotes.
enum class NameKind : std::uint8_t {
    key,      ///< `angle factor`; of a key with a symbol, the part before that
    symbol,   ///< in words, in lists of symbols, and in keys such as `note A`
    surface,  ///< `leaf` in `~leaf` and `patch leaf:`
    table,
    define,
    formal,  ///< a formal parameter of one production
    variant,
    arrow,  ///< the arrow of a production, which is not a name, but belongs to the line
};

/// A name at one place.
struct Occurrence {
    Span where;  ///< in the text of the pattern
    NameKind kind = NameKind::key;
    bool is_definition = false;  ///< of a symbol: it begins a predecessor, or is listed under `symbols:`
    std::size_t production = 0;  ///< of a formal: the offset of its production

    /// True if both places name the same thing.
    bool is_same(const Occurrence& other) const;
};

/// The names in the text of a pattern, sorted by place. Parts that cannot be read because of errors are skipped.
/// Cost: linear in the text, and a table lookup for each name.
std::vector<Occurrence> occurrences(const Pattern& pattern);

/// The occurrence that contains the byte at an offset or ends there; null if there is none.
const Occurrence* find_occurrence(const std::vector<Occurrence>& all, std::size_t offset);

}  // namespace sikku
