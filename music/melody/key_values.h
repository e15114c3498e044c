// music/melody/key_values.h: values that several keys of melodies have.
#pragma once

#include "engine/language/pattern.h"
#include "music/score/score.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// The place of a value for messages; that of the name for a key without a value.
inline const Span& place_of(const Key& key) {
    return key.value.empty() ? key.name_at : key.value;
}

/// The base of readers of the keys of a pattern.
class KeyReader {
protected:
    KeyReader(const Pattern& pattern, Diagnostics& diagnostics) : pattern_(pattern), diagnostics_(diagnostics) {}

    /// Reports an error in the value of a key.
    void fail(const Key& key, const std::string& message) { diagnostics_.error(place_of(key), message); }

    /// Passes the value of a key to `read`, if the pattern states it. @param read  returns false for invalid values
    template <class Read>
    void read_key(std::string_view name, const std::string& expected, Read read) {
        const Key* key = pattern_.find(name);
        if (key && !read(key->value.view())) fail(*key, expected);
    }

    const Pattern& pattern_;
    Diagnostics& diagnostics_;
};

/// Reads a whole number from `least` to `most`; nullopt for anything else.
std::optional<std::int64_t> whole_number(std::string_view text, std::int64_t least = INT64_MIN,
                                         std::int64_t most = INT64_MAX);

/// Ticks of `1/8` or `2`, up to 16 whole notes; nullopt for anything else.
std::optional<std::int64_t> note_value(std::string_view text);

/// Reads `4/4`, `7/8`, or with groups `3+2+2/8`; nullopt for anything else.
std::optional<Meter> parse_meter(std::string_view text);

}  // namespace sikku
