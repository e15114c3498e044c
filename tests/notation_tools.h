// tests/notation_tools.h: what the tests of printed scores share: random melodies, memory to write to.
#pragma once

#include "music/score/notation.h"
#include "music/score/spelling.h"
#include "tests/tools.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

class MemorySink final : public MemoryOutput {
public:
    const std::string& text = bytes_;
};

/// A note as it can be told from print: ticks, and the key to the quarter tone.
struct PlainNote {
    std::int64_t onset = 0;
    std::int64_t duration = 0;
    double key = 0.0;
    auto operator<=>(const PlainNote&) const = default;
};

std::vector<PlainNote> plain(const std::vector<Note>& notes);

struct TestScore {
    ScoreHead head;
    std::vector<Note> notes;
    std::int64_t end = 0;
};

std::array<Spelling, 12> spelling_of(const std::vector<double>& semitones, Spelling tonic);

Part plain_part(const std::string& name, int voices);

Notation notate(const TestScore& score, std::size_t block = 7);

/// A line of notes one after the other, `lengths` in ticks (negative: a rest).
TestScore line(const Meter& meter, const std::vector<std::int64_t>& lengths, double key = 72);

/// Four bars that slow down and end with a held note, over a part that ends with rests.
TestScore held_score(const Meter& meter);

/// Up to three parts of 1 to 4 voices in some meter; lengths are 1 to 9 of a unit from a 16th to a whole.
/// `quarter_tones`: some keys lie between two semitones.
TestScore random_score(unsigned seed, bool quarter_tones);

/// The ticks at which bars begin, up to `end`, one after the other.
std::vector<std::int64_t> bar_onsets(const ScoreHead& head, std::int64_t end);

}  // namespace sikku
