// music/melody/mapping.h: turns the symbols of a word into notes.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "music/melody/melody.h"
#include "music/score/score.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace sikku {

struct PlayOptions {
    std::int64_t from = 0;        ///< ticks: what sounds before it is left out, and the score begins there
    std::int64_t to = INT64_MAX;  ///< ticks: the score ends there; a note cut by an edge keeps its part
    int most_voices = 15;         ///< that sound at once; more is a ScoreError
    double budget = 200e6;        ///< most nodes of the derivation that are visited
    std::function<void(std::uint64_t symbols)> watch;  ///< as in DerivationOptions
};

/// What became of it.
struct PlayReport {
    std::uint64_t notes = 0;
    std::uint64_t moved = 0;  ///< of them, those that were beyond the keys of MIDI
    std::uint64_t lost = 0;   ///< notes shorter than a tick, or whose degree a key map leaves out
    int voices = 0;
    std::int64_t end = 0;   ///< ticks
    bool past = false;      ///< the score ended before the piece began
    double lowest = 127.0;  ///< keys
    double highest = 0.0;
};

/// Reads the word of `grammar` as `melody` says and hands its notes to `sink`, in one pass; two if the anchor has to
/// be looked for and the fold does not tell it. What lies before options.from is passed over without being derived
/// if the curve lies on the square grid and has neither brackets nor contexts; else it is walked. A branch begins
/// where and when the turtle is.
/// Memory: O(steps), and the state of open brackets. Cost: O(symbols between from and to).
/// @throws BudgetError, WordError, ScoreError; what `sink` throws
/// Source: Prusinkiewicz & Hanan 1989, section 6.3; the choices it leaves open are those of Melody.
PlayReport play(const Grammar& grammar, const Melody& melody, NoteSink& sink, const PlayOptions& options);

/// What can be told of a melody without playing it.
struct MelodyCensus {
    Integer notes = 0;  ///< of mapping runs
    Integer ticks = 0;
    Integer height = 0;  ///< degrees between the lowest and the highest note of the horizontal runs
};

/// By composition, of any order. Nullopt for other mappings than runs, for curves that are not on the square grid,
/// brackets and contexts.
std::optional<MelodyCensus> census(const Grammar& grammar, const Melody& melody);

}  // namespace sikku
