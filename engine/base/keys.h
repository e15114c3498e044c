// engine/base/keys.h: every key of the pattern language, in one table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// The part of the program that reads a key.
enum class KeyOwner : std::uint8_t { engine, art, music };

/// One key of pattern files. Parsing, `--set`, galleries, help and the manual use the same row.
struct KeyInfo {
    std::string_view name;  ///< as written in files: lower case, single blanks
    KeyOwner owner = KeyOwner::engine;
    std::string_view values;     ///< syntax of the value
    std::string_view if_absent;  ///< default value; empty: none
    std::string_view help;       ///< meaning of the key, as a noun phrase
};

/// All keys, grouped by owner, in the order of the manual.
std::span<const KeyInfo> language_keys();

/// The row of a key, or null. @param name  folded
const KeyInfo* find_language_key(std::string_view name);

/// The names of the keys that `owner` reads, in the order of the table.
std::vector<std::string_view> keys_of(KeyOwner owner);

}  // namespace sikku
