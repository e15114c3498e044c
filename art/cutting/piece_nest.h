// art/cutting/piece_nest.h: lays pieces of different shapes into an area, each in its first free place.
#pragma once

#include "art/cutting/no_fit.h"
#include "art/cutting/piece_rows.h"
#include "engine/base/monitor.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

struct NestedPiece {
    std::size_t kind = 0;
    PieceCopy copy;
};

/// Lays pieces one after another where they lie highest (Burke et al. 2006, bottom left fill): at a corner of the
/// border of the free places, which are those outside the no-fit polygons of all pieces laid before. Pieces of equal
/// outlines and directions share these.
class PieceNest {
public:
    /// Criterion for free places: the place whose lowest point or middle lies highest, in some direction.
    struct Goal {
        glm::dvec2 up{0.0, 1.0};
        bool of_middle = false;
    };

    /// @param outlines  of kinds, anticlockwise, with half of the gap between pieces
    /// @param keeps_direction  pieces are turned by 180 degrees only  @throws Stopped
    PieceNest(const std::vector<Outline>& outlines, bool keeps_direction, const Monitor& monitor);

    /// False if outlines have too many corners for no-fit polygons, or there are too many.
    bool is_possible() const { return is_possible_; }

    /// Adds pieces to those that lie in an area, in the order of `kinds`: the next kind as soon as no piece of the
    /// one before has room.
    /// @param left  the number of pieces of each kind, which is reduced
    /// @param laid  the pieces in the area; each in a direction that this nest has chosen, or PieceRows
    void fill(const Box& area, Goal goal, std::span<const std::size_t> kinds, std::vector<std::uint64_t>& left,
              std::vector<NestedPiece>& laid);

    /// Steps of searches so far: pieces that were looked up, places checked against pieces, and pairs of sides of
    /// no-fit polygons compared.
    double work() const { return work_; }

private:
    /// A piece in one direction.
    struct Form {
        std::size_t kind;
        double turn;
        Outline outline;
        std::vector<Outline> parts;
        Box box;
        glm::dvec2 middle;
    };
    struct Placed {
        std::size_t form;
        glm::dvec2 at;
    };
    class Places;

    std::size_t form_of(const NestedPiece& piece);
    std::size_t add_form(std::size_t kind, double turn);
    const NoFit& no_fit(std::size_t fixed, std::size_t moved);

    std::vector<Outline> outlines_;
    Monitor monitor_;
    bool is_possible_ = true;
    double work_ = 0;
    std::vector<std::vector<Outline>> parts_;       // of kinds
    std::vector<std::vector<std::size_t>> turned_;  // forms of kinds that are tried
    std::vector<Form> forms_;
    std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<NoFit>> no_fits_;
};

}  // namespace sikku
