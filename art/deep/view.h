// art/deep/view.h: draws words of any length at the cost of the visible parts: skips parts off the page, and
// replaces parts too small to be resolved by their appearance.
#pragma once

#include "art/drawing/view_window.h"
#include "art/print/print.h"
#include "engine/derivation/derivation.h"
#include "engine/measure/parts.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace sikku {

/// The resolution of a view, in turtle steps; an extent is the longer side of a part's box.
struct Sight {
    Box box;            ///< the visible part, with the pen's width around it, relative to the view's origin
    double chord = -1;  ///< parts up to this extent become their chords
    double blot = -1;   ///< parts up to this extent become blots
    double ink = 1;     ///< part of a blot's length that is drawn: curves are shorter than the lines they follow
    double least = 0;   ///< parts that have less ink than this and join others are left out
};

struct ViewReport {
    std::uint64_t visited = 0;  ///< nodes of the derivation visited
    std::uint64_t lines = 0;    ///< lines drawn, chords included
    std::uint64_t chords = 0;   ///< parts of several steps that became chords
    std::uint64_t blots = 0;    ///< parts of several steps that became blots
};

/// The error after visiting more than `budget` nodes.
BudgetError too_much(double budget);

/// A drawing of lines in one pen, prepared for walks.
class View {
public:
    virtual ~View() = default;

    /// Prepares the whole drawing in doubles or, with a window, relative to its lower left corner, with places in as
    /// many bits as necessary (up to 113; exact where steps are whole and turns are quarters). With `moves_draw`, the
    /// lines are the control points of a spline: see Turtle::drawing(). `grammar` must outlive the result. Returns
    /// nullptr where Parts cannot be made.
    static std::unique_ptr<View> make(const Grammar& grammar, const std::optional<ViewWindow>& window,
                                      bool moves_draw = false);

    /// The same for parts that were made with `moves_draw` from that grammar.
    static std::unique_ptr<View> make(const Grammar& grammar, Parts<double> parts,
                                      const std::optional<ViewWindow>& window, bool moves_draw);

    /// Draws the visible parts in one walk. Several threads may walk at once.
    /// @param budget  maximum number of nodes; more throw BudgetError
    /// @param watch   called every 65,536 nodes with that number; may throw to stop
    /// Cost: the visible parts; 20 ns a node or less.
    virtual ViewReport read(const Sight& sight, BlotSink& sink, double budget,
                            const std::function<void(std::uint64_t)>& watch) const = 0;
    /// The parts in doubles.
    virtual const Parts<double>& parts() const = 0;
};

}  // namespace sikku
