// engine/base/keys.h: every key of the pattern language, in one table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// The part of the program that reads a key.
enum class KeyOwner : std::uint8_t { engine, art, music };

/// The patterns that a key applies to: those whose words a turtle reads, maps, or both.
enum class KeyScope : std::uint8_t { words, maps, all };

/// One key of pattern files. Parsing, `--set`, galleries, help and the manual use the same row.
struct KeyInfo {
    std::string_view name;  ///< as written in files: lower case, single blanks
    KeyOwner owner = KeyOwner::engine;
    std::string_view values;     ///< syntax of the value
    std::string_view if_absent;  ///< default value; empty: none
    std::string_view help;       ///< meaning of the key, as a noun phrase
    KeyScope scope = KeyScope::words;
    /// True for values that name files of this machine; null: no value does.
    bool (*names_file)(std::string_view value) = nullptr;

    /// True for keys with one row for each symbol, such as `note A: C4`; their names end in ` SYMBOL`.
    bool is_for_symbols() const { return name.ends_with(symbol_place); }
    /// The part of such a name before the symbol, such as `note `.
    std::string_view before_symbol() const { return name.substr(0, name.size() - symbol_place.size() + 1); }

    static constexpr std::string_view symbol_place = " SYMBOL";
};

/// All keys, grouped by owner, in the order of the manual.
std::span<const KeyInfo> language_keys();

/// Finds the row of a key, or null; `note A` is found in the row `note SYMBOL`. @param name  folded
const KeyInfo* find_language_key(std::string_view name);

/// The names of the keys that `owner` reads, without those for symbols, in the order of the table.
std::vector<std::string_view> keys_of(KeyOwner owner);

}  // namespace sikku
