#include "art/reading/lattice_steps.h"

namespace sikku {

LatticeTurn LatticeTurn::after(const LatticeTurn& first) const {
    const auto& b = first.m;
    return {
        {m[0] * b[0] + m[1] * b[2], m[0] * b[1] + m[1] * b[3], m[2] * b[0] + m[3] * b[2], m[2] * b[1] + m[3] * b[3]}};
}

std::vector<LatticeTurn> rotations_of(DotLattice lattice) {
    const bool is_square = lattice == DotLattice::square;
    const LatticeTurn rotation = is_square ? LatticeTurn{{0, -1, 1, 0}} : LatticeTurn{{0, -1, 1, 1}};
    std::vector<LatticeTurn> turns(1);
    while (turns.size() < (is_square ? 4 : 6)) turns.push_back(rotation.after(turns.back()));
    return turns;
}

std::vector<LatticeTurn> turns_of(DotLattice lattice) {
    const LatticeTurn mirror{{0, 1, 1, 0}};
    std::vector<LatticeTurn> turns;
    for (const LatticeTurn& turn : rotations_of(lattice)) {
        turns.push_back(turn);
        turns.push_back(turn.after(mirror));
    }
    turns.erase(turns.begin());
    return turns;
}

}  // namespace sikku
