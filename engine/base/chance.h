// engine/base/chance.h: random numbers that depend only on the seed and the place in a derivation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sikku {

/// Returns 64 pseudorandom bits, different for each number.
/// Source: Steele, Lea & Flood 2014, SplitMix64 (the finalizer, variant 13 of D. Stafford).
constexpr std::uint64_t scrambled(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBU;
    return bits ^ (bits >> 31);
}

/// The inverse of scrambled(): returns the number that it maps to `bits`.
constexpr std::uint64_t unscrambled(std::uint64_t bits) {
    bits = (bits ^ (bits >> 31) ^ (bits >> 62)) * 0x319642B2D24D8EC3U;
    bits = (bits ^ (bits >> 27) ^ (bits >> 54)) * 0x96DE1B173F119089U;
    return bits ^ (bits >> 30) ^ (bits >> 60);
}

/// A sequence of pseudorandom numbers. Source: Steele, Lea & Flood 2014 (SplitMix64).
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15U;
        return scrambled(state_);
    }
    /// A number in [0, 1).
    double fraction() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    /// A number from 0 to bound - 1; the bias is below bound / 2^64.
    std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }

private:
    std::uint64_t state_;
};

/// Returns the number that scrambled() maps to the place of a child.
constexpr std::uint64_t child_key(std::uint64_t parent, std::uint64_t index) {
    return parent + 0x9E3779B97F4A7C15U * (index + 1);
}
/// Identifies a module's place in a derivation tree by its parent's place and its index among the children. A module
/// that is not rewritten keeps its place.
constexpr std::uint64_t child_place(std::uint64_t parent, std::uint64_t index) {
    return scrambled(child_key(parent, index));
}
/// Place of a module of the axiom.
constexpr std::uint64_t axiom_place(std::uint64_t seed, std::uint64_t index) {
    return child_place(scrambled(seed ^ 0x5851F42D4C957F2DU), index);
}

/// Random numbers of one module in one derivation step.
struct Chance {
    std::uint64_t place = 0;
    std::int64_t step = 0;  ///< from 1; 0 for the axiom itself

    /// Returns 53 bits: the same for the same draw, unrelated for others.
    constexpr std::uint64_t bits(std::uint32_t draw) const {
        const std::uint64_t here = scrambled((place ^ 0xD1B54A32D192ED03U) + static_cast<std::uint64_t>(step));
        return scrambled(here + 0x9E3779B97F4A7C15U * (std::uint64_t{draw} + 1)) >> 11;
    }
    /// Uniform in [0, 1), in steps of 2^-53.
    constexpr double uniform(std::uint32_t draw) const { return static_cast<double>(bits(draw)) * 0x1p-53; }
};

}  // namespace sikku
