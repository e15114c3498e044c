// engine/language/pattern.h: reads a pattern file into plain data with places, not yet interpreted.
#pragma once

#include "engine/base/diagnostic.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// `name: value`. `name` is folded: lower case, single blanks.
struct Key {
    std::string name;
    Span name_at;
    Span value;
};

/// `define NAME = EXPRESSION`.
struct Define {
    Span name;
    Span value;
};

/// One production, cut at its separators; absent parts are nullopt.
struct ProductionText {
    Span whole;
    std::optional<Span> left;
    Span predecessor;
    std::optional<Span> right;
    std::optional<Span> condition;
    Span successor;
    std::optional<Span> weight;
};

/// `table NAME:` and the productions up to the next.
struct TableText {
    Span name;
    std::vector<ProductionText> productions;
};

/// `patch NAME:` and the lines after it, each of the coordinates of points.
struct PatchText {
    Span name;
    std::vector<Span> rows;
};

/// `variant NAME: a = 1, derivation length = 3`: values that override those of the file.
struct Variant {
    Span name;
    std::vector<Key> settings;
};

/// A setting from outside the file that overrides it.
struct Setting {
    /// The key is its own origin.
    Setting(std::string name, std::string text) : origin(name), key(std::move(name)), value(std::move(text)) {}
    Setting(std::string from, std::string name, std::string text)
        : origin(std::move(from)), key(std::move(name)), value(std::move(text)) {}

    /// KEY=VALUE of a list of settings; messages show both.
    static Setting assignment(std::string from, std::string name, std::string text) {
        Setting setting(std::move(from), std::move(name), std::move(text));
        setting.is_assignment = true;
        return setting;
    }

    std::string origin;  ///< source, for messages: `--set`, `-n`
    std::string key;
    std::string value;
    bool is_assignment = false;  ///< otherwise messages show the value after the source
};

/// The contents of a pattern file; its Spans live as long as it does. Keys hold the final values, overrides applied,
/// in the order of the file.
struct Pattern {
    SourcePointer source;
    std::vector<SourcePointer> overrides;  ///< sources of overriding values
    std::vector<Key> keys;
    std::vector<Define> defines;
    std::vector<ProductionText> common;  ///< productions before the first table
    std::vector<TableText> tables;
    std::vector<ProductionText> interpret;  ///< the homomorphism
    std::vector<PatchText> patches;
    std::vector<Variant> variants;

    /// The key of that folded name, or null.
    const Key* find(std::string_view name) const;
    /// The value of a free-text key (`title`, `source`, `description`), or empty.
    std::string text(std::string_view name) const;
};

/// Maximum size of a pattern text in bytes.
constexpr std::size_t most_pattern_bytes = std::size_t{64} << 20;

/// Takes the text of a pattern file without parsing it. Refuses (as unreadable) more than 64 MB, NUL bytes, invalid
/// UTF-8, and comments without end. Cost: linear; memory: the text, twice if it has comments.
SourcePointer read_source(std::string name, std::string text, Diagnostics& diagnostics);

/// Reads the text of a pattern file: lines, keys, productions, tables, variants; errors go to `diagnostics`. Rejects
/// more than 64 MB, NUL bytes and invalid UTF-8. Cost: linear.
Pattern parse_pattern(std::string name, std::string text, Diagnostics& diagnostics);

/// Applies a variant by name (empty: none), then the settings, in this order: file < variant < settings.
/// A setting replaces the define of its name, or else the key.
void apply_overrides(Pattern& pattern, std::string_view variant, const std::vector<Setting>& settings,
                     Diagnostics& diagnostics);

/// Reports every key that is not in language_keys(), with the nearest one, and keys of words in maps and of maps in
/// words. Values are checked where they are read.
void check_keys(const Pattern& pattern, Diagnostics& diagnostics);

/// True if a line states an axiom, as in every pattern, even one with errors. Cost: linear.
bool states_axiom(std::string_view text);

}  // namespace sikku
