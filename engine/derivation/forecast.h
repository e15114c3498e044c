// engine/derivation/forecast.h: forecasts the length and the cost of a word before it is derived.
#pragma once

#include "engine/derivation/derivation.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

struct ExactCounts;

/// Numbers with more decimal digits than this are reported as "about 10^k".
constexpr int most_digits = 10'000;
/// Above this number of steps only chains of units (F --> F) are derived.
constexpr std::int64_t most_steps = 1'000'000;

struct Forecast {
    /// Derivation nodes visited: symbols that are rewritten into none or several symbols, and symbols of the word.
    /// Subwords known to be empty are not visited. May be infinite.
    double nodes = 0.0;
    double log10_length = 0.0;  ///< -infinity if the word is empty
    /// Number of each symbol in the word, to 15 digits (infinity if a double does not hold it), and log10 of it.
    std::vector<double> rough_counts;
    std::vector<double> log10_counts;
    /// Exact number of each symbol in the word, null if the word's length has over 10^4 digits.
    std::shared_ptr<const ExactCounts> counts;

    /// The word's length: exact, or "about 10^k".
    std::string length() const;
};

/// Forecasts the word. Nullopt for a map, and for a word if productions look at neighbours (see resolve_contexts), if
/// it is cut, or if the system has parameters or random choices: only deriving determines these.
/// @param interpreted  forecast the word after `interpret:`
/// Cost: O(steps x size of the tables), times the size of the numbers. @throws BudgetError if the first factor is
/// above 5 x 10^7
std::optional<Forecast> forecast(const Grammar& grammar, bool interpreted);

/// Like forecast(), but without exact counts, at a cost that does not depend on the size of the numbers.
std::optional<Forecast> estimate(const Grammar& grammar, bool interpreted);

/// Estimates the number of symbols of a forecast word that draw lines, discs or surfaces.
/// @param moves_draw  moves count, too: splines pass through them
double drawn_symbols(const Grammar& grammar, const Forecast& forecast, bool moves_draw = false);

/// Estimates the number of lines and curves in the letters of labels.
double label_lines(const Grammar& grammar, const Forecast& forecast);

/// Number of symbols of the word, for progress reports; 0 if only deriving would determine it.
double expected_symbols(const Grammar& grammar, bool interpreted);

/// Upper bound of the time for matching contexts in seconds, assuming that every candidate is compared in full at
/// every symbol of the first word, in every step with contexts. The budget may stop it earlier.
double matching_seconds(const Grammar& grammar, double budget);

/// Returns the largest derivation length up to grammar.steps() that visits at most `budget` nodes; -1 if none does.
std::int64_t largest_affordable(const Grammar& grammar, bool interpreted, double budget);

/// Throws BudgetError, with the length and the largest derivation length that fits, if the word costs more than
/// `budget` nodes. Accepts systems that cannot be forecast; DerivationOptions limits them.
void require_affordable(const Grammar& grammar, bool interpreted, double budget);

/// Returns a grammar that derives the same word in at most most_steps steps: `grammar` itself, or, for a longer
/// derivation that replaces each symbol by at most one, the composition of all its steps into one.
/// @throws BudgetError for other systems
Grammar shorten(const Grammar& grammar);

}  // namespace sikku
