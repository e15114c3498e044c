// music/melody/melody_fold.h: computes the length and the range of a melody by composition, without playing it.
#pragma once

#include "engine/base/integer.h"
#include "engine/geometry/lattice.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

/// Effect of a stretch of a word on a turtle on the square grid that starts at 0 0 and faces along the first axis.
/// Directions are quarter turns from that axis; axis 0 is that of directions 0 and 2.
struct GridStretch {
    struct Span {
        Integer low = 0, high = 0;
    };
    std::array<Integer, 2> move{};                 ///< displacement
    int turn = 0;                                  ///< quarter turns of the heading, 0 to 3
    std::array<Integer, 2> length{};               ///< total length of the steps along each axis, drawn or not
    std::array<Integer, 2> drawn{};                ///< total length of the steps drawn
    std::array<Integer, 2> steps{};                ///< number of steps drawn
    std::array<Integer, 2> runs{};                 ///< number of straight runs drawn along each axis
    std::array<Integer, 2> corners{};              ///< number of those that lead into a run across
    Integer marks = 0;                             ///< number of phrases that end
    Integer rise = 0;                              ///< sum of rise_of()
    std::array<std::optional<Span>, 2> crossings;  ///< range of the runs along each axis on the other axis
    std::array<Span, 2> box;                       ///< range of all positions on each axis, including the start
    int first = -1;        ///< direction of a drawn step that begins the stretch; -1: none, or something precedes it
    int last = -1;         ///< likewise at the end
    bool is_still = true;  ///< there are no steps
};

/// True if the word moves but draws nothing, like that of a kolam whose steps guide a spline. Its moves are then read
/// as drawn steps.
bool draws_nothing(const Grammar& grammar);

/// True if the parameter of a turn is a whole number up to 14, which then counts degrees of a scale: `+(3)`. Others
/// are angles.
bool counts_degrees(const SymbolInfo& symbol);

/// Degrees by which a symbol raises the notes after it in a word that is read symbol by symbol: 1 for `+`, -1 for
/// `-`, or as many as the parameter counts.
int rise_of(const SymbolInfo& symbol);

/// Reading that a fold represents: the curve, or the word symbol by symbol, where turns only change `rise`.
enum class FoldOf { curve, symbols };

/// The stretches of every symbol at every level of a grammar without contexts, whose steps are whole numbers and, for
/// a curve, whose turns are quarter turns. Folded brackets restore only position, heading and rise.
class MelodyFold {
public:
    /// Folds a grammar. Nullopt for others, for more than 10^6 levels times symbols, or for numbers above 256 MB.
    /// Cost: O(symbols x steps) compositions of exact numbers.
    /// @param folds_brackets  false: nullopt for grammars with brackets
    /// @param phrase          the mark that GridStretch::marks counts
    static std::optional<MelodyFold> make(const Grammar& grammar, FoldOf of = FoldOf::curve,
                                          bool folds_brackets = false, std::optional<Symbol> phrase = {});

    /// Stretch of a symbol with `level` tables still to be applied; null if the symbol is not reachable.
    const GridStretch* stretch(Symbol symbol, std::int64_t level) const {
        const auto at = static_cast<std::size_t>(level) * symbols_ + symbol;
        return at < stretches_.size() ? stretches_[at].get() : nullptr;
    }
    /// Stretch of the whole word, turned to the first heading: axis 0 is x, axis 1 is y.
    const GridStretch& whole() const { return whole_; }
    /// Quarter turns from the x axis to the first heading.
    int first_direction() const { return first_direction_; }

private:
    std::size_t symbols_ = 0;
    std::vector<std::shared_ptr<const GridStretch>> stretches_;  // by level and symbol; neighbours share them
    GridStretch whole_;
    int first_direction_ = 0;
};

/// True if the turtle of this lattice walks on the square grid in whole steps along its axes, even with brackets;
/// `first_direction` is then its first heading in quarter turns from the x axis.
bool is_on_grid(const Lattice& lattice, int& first_direction);

}  // namespace sikku
