// engine/geometry/cyclotomic.h: arithmetic with the points of a lattice, the whole numbers of a cyclotomic field.
#pragma once

#include "engine/geometry/lattice.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Z[zeta] of a lattice with rank > 0, zeta = exp(2 pi i / k). Numbers are arrays of 8 coordinates, of which the
/// first `rank` count; the others are 0. Nothing is rounded: signs are found in as many bits as they need.
class Cyclotomic {
public:
    using Number = std::array<std::int64_t, 8>;

    explicit Cyclotomic(const Lattice& lattice);

    std::size_t rank() const { return rank_; }
    /// Number of roots of unity: k, or 2k if k is odd.
    int roots() const { return roots_; }

    /// Product of a number and the root of unity with that index, of roots().
    template <class Coordinates>
    Coordinates rotated(const Coordinates& number, int index) const {
        index = (index % roots_ + roots_) % roots_;
        // If k is odd, odd powers of the 2k-th root are negative powers of zeta.
        const bool negative = roots_ != k_ && index % 2 != 0;
        const int power = roots_ == k_ ? index : (negative ? index + k_ : index) / 2 % k_;
        Coordinates result{};
        for (std::size_t i = 0; i < rank_; ++i) {
            const auto& unit = power_[(i + static_cast<std::size_t>(power)) % power_.size()];
            const auto value = negative ? -number[i] : number[i];
            for (std::size_t j = 0; j < rank_; ++j) result[j] += unit[j] * value;
        }
        return result;
    }
    /// The mirror image about the direction of 1.
    template <class Coordinates>
    Coordinates conjugate(const Coordinates& number) const {
        Coordinates result{};
        for (std::size_t i = 0; i < rank_; ++i) {
            const auto& unit = power_[(power_.size() - i) % power_.size()];
            for (std::size_t j = 0; j < rank_; ++j) result[j] += unit[j] * number[i];
        }
        return result;
    }
    /// conj(a) b. Its real part is the scalar product of a and b, its imaginary part their determinant.
    template <class Coordinates>
    Coordinates conjugate_product(const Coordinates& a, const Coordinates& b) const {
        Coordinates result{};
        for (std::size_t i = 0; i < rank_; ++i) {
            if (a[i] == 0) continue;
            for (std::size_t j = 0; j < rank_; ++j) {
                const auto times = a[i] * b[j];
                if (times == 0) continue;
                const auto& unit = power_[(j + power_.size() - i) % power_.size()];
                for (std::size_t m = 0; m < rank_; ++m) result[m] += unit[m] * times;
            }
        }
        return result;
    }
    template <class Coordinates>
    bool is_real(const Coordinates& number) const {
        return conjugate(number) == number;
    }

    /// Radians anticlockwise from the direction of 1, rounded.
    long double angle(const Number& number) const;
    /// Signs of the real and the imaginary part: 1, 0 or -1. Coordinates must be below 2^62.
    int sign_real(const Number& number) const { return sign(number, cosines_, false); }
    int sign_imaginary(const Number& number) const { return sign(number, sines_, true); }

private:
    int sign(const Number& number, const std::vector<long double>& weights, bool imaginary) const;
    int precise_sign(const Number& number, bool imaginary) const;

    int k_;
    int roots_;
    std::size_t rank_;
    std::vector<std::array<std::int8_t, 8>> power_;  // coordinates of the powers of zeta
    std::vector<long double> cosines_;               // of the powers of zeta
    std::vector<long double> sines_;
};

}  // namespace sikku
