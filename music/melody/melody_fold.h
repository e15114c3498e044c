// music/melody/melody_fold.h: computes the length and the range of a melody by composition, without playing it.
#pragma once

#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

/// What a stretch of a word does to a turtle on the square grid, as seen with the turtle at 0 0 and facing along the
/// first axis. Directions are quarter turns from there; axis 0 is that of directions 0 and 2.
struct GridStretch {
    struct Span {
        Integer low = 0, high = 0;
    };
    std::array<Integer, 2> move{};                 ///< displacement
    int turn = 0;                                  ///< of the heading, 0 to 3
    std::array<Integer, 2> length{};               ///< of all steps along each axis, drawn or not
    std::array<Integer, 2> drawn{};                ///< of the steps drawn
    std::array<Integer, 2> steps{};                ///< how many are drawn
    std::array<Integer, 2> runs{};                 ///< straight runs drawn along each axis
    std::array<Integer, 2> corners{};              ///< runs drawn along each axis that lead into one across
    Integer marks = 0;                             ///< phrases that end
    Integer rise = 0;                              ///< symbols `+` less symbols `-`
    std::array<std::optional<Span>, 2> crossings;  ///< where these lie on the other axis
    std::array<Span, 2> box;                       ///< of all positions on each axis, the start included
    int first = -1;  ///< direction of a drawn step that begins the stretch; -1: none, or something stands before it
    int last = -1;   ///< likewise at the end
    bool is_still = true;  ///< no step at all
};

/// True if the word moves and draws nothing, as that of a kolam whose steps guide a spline. Its moves are then read
/// as steps drawn.
bool draws_nothing(const Grammar& grammar);

/// What a fold is for: the curve, or the word symbol by symbol, where turns only change `rise`.
enum class FoldOf { curve, symbols };

/// The stretches of every symbol at every level of a grammar whose steps are whole numbers, without contexts. Of a
/// curve all turns are quarters. Brackets, if they are folded, restore position and rise, and nothing else.
class MelodyFold {
public:
    /// Nullopt for other grammars, and if levels times symbols are above 10^6 or the numbers above 256 MB.
    /// Cost: O(symbols x steps) compositions of exact numbers.
    /// @param folds_brackets  false: nullopt for grammars with brackets
    /// @param phrase          the mark that GridStretch::marks counts
    static std::optional<MelodyFold> make(const Grammar& grammar, FoldOf of = FoldOf::curve,
                                          bool folds_brackets = false, std::optional<Symbol> phrase = {});

    /// Of a symbol with `level` tables still to come; null if no symbol leads there.
    const GridStretch* stretch(Symbol symbol, std::int64_t level) const {
        const auto at = static_cast<std::size_t>(level) * symbols_ + symbol;
        return at < stretches_.size() ? stretches_[at].get() : nullptr;
    }
    /// Of the whole word, as the turtle walks it: axis 0 is x, axis 1 is y.
    const GridStretch& whole() const { return whole_; }
    /// Quarter turns from the x axis to the first heading.
    int first_direction() const { return first_direction_; }

private:
    std::size_t symbols_ = 0;
    std::vector<std::shared_ptr<const GridStretch>> stretches_;  // by level and symbol; neighbours share them
    GridStretch whole_;
    int first_direction_ = 0;
};

/// True if the turtle of this lattice walks on the square grid in whole steps along its axes, brackets or not;
/// `first_direction` is then its first heading in quarter turns from the x axis.
bool is_on_grid(const Lattice& lattice, int& first_direction);

}  // namespace sikku
