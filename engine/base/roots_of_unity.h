// engine/base/roots_of_unity.h: the ring of whole numbers Z[zeta], zeta = exp(2 pi i / k).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace sikku {

/// The largest phi(k) of a lattice.
constexpr int most_coordinates = 8;

/// phi(k) for 1 <= k <= 30; 0, for no exact lattice, if k is larger or phi(k) is above most_coordinates.
int lattice_rank(std::int64_t k);

/// Coordinates of zeta^0 to zeta^(k-1) in the basis 1, zeta, zeta^2 …; the first `lattice_rank(k)` count.
/// @param k  number with a lattice_rank() above 0
std::vector<std::array<std::int8_t, most_coordinates>> powers_of_root(int k);

}  // namespace sikku
