// tests/fuzz/scale_targets.h: what the fuzzers do with any bytes as a Scala scale or key map.
#pragma once

#include "music/scale/scale.h"
#include "tests/fuzz/targets.h"

#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// Every diagnostic is readable text with a real place; without an error there is a value.
inline void check_scala_diagnostics(const Diagnostics& diagnostics, bool has_value) {
    require(has_value != diagnostics.has_errors(), "a Scala file has a value and errors, or neither");
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        require(is_utf8(diagnostic.text()), "a diagnostic is not valid UTF-8");
        require(diagnostic.where.line >= 1 && diagnostic.where.column >= 1, "a place is counted from 1");
    }
}

/// read_scl on any bytes; every degree of the scale has finite cents.
inline void try_scl(std::string_view bytes) {
    const Source source("fuzz.scl", std::string(bytes));
    Diagnostics diagnostics;
    const std::optional<Scale> scale = read_scl(source, diagnostics);
    check_scala_diagnostics(diagnostics, scale.has_value());
    if (!scale) return;
    require(is_utf8(scale->title), "a scale's title is not valid UTF-8");
    require(scale->size() >= 1 && scale->period != 0, "a scale has no notes or no period");
    for (const std::int64_t degree : {-100'000, -1, 0, 1, 7, 100'000}) {
        require(std::isfinite(scale->cents(degree, false)) && std::isfinite(scale->cents(degree, true)),
                "a degree's cents are not finite");
    }
    for (int key = 0; key < 128; ++key) {
        const auto mapped = mapped_key(*scale, KeyMap(), key);
        require(mapped && std::isfinite(*mapped), "a key without a map has no pitch");
    }
}

/// read_kbm on any bytes; every key of the map has a finite pitch or none.
inline void try_kbm(std::string_view bytes) {
    const Source source("fuzz.kbm", std::string(bytes));
    Diagnostics diagnostics;
    const std::optional<KeyMap> map = read_kbm(source, diagnostics);
    check_scala_diagnostics(diagnostics, map.has_value());
    if (!map) return;
    require(map->first >= 0 && map->last <= 127 && map->first <= map->last, "the keys of a map are out of range");
    Scale scale;
    scale.ascent = scale.descent = {0, 100, 250.5, 702};
    scale.period = 1902;
    for (int key = -1; key <= 128; ++key) {
        const auto mapped = mapped_key(scale, *map, key);
        require(!mapped || std::isfinite(*mapped), "a mapped key's pitch is not finite");
    }
}

}  // namespace sikku
