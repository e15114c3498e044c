#include "engine/geometry/cyclotomic.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>

namespace sikku {
namespace {

constexpr long double pi = 3.141592653589793238462643383279502884L;  // std::numbers of libc++ 13 has that of a double

}  // namespace

Cyclotomic::Cyclotomic(const Lattice& lattice)
    : k_(static_cast<int>(lattice.headings)),
      roots_(k_ % 2 == 0 ? k_ : 2 * k_),
      rank_(static_cast<std::size_t>(lattice.rank)),
      power_(lattice.power) {
    for (int i = 0; i < k_; ++i) {
        const long double angle = 2 * pi * i / k_;
        cosines_.push_back(std::cos(angle));
        sines_.push_back(std::sin(angle));
    }
}

long double Cyclotomic::angle(const Number& number) const {
    long double x = 0;
    long double y = 0;
    for (std::size_t i = 0; i < rank_; ++i) {
        x += static_cast<long double>(number[i]) * cosines_[i];
        y += static_cast<long double>(number[i]) * sines_[i];
    }
    return std::atan2(y, x);
}

int Cyclotomic::sign(const Number& number, const std::vector<long double>& weights, bool imaginary) const {
    long double sum = 0;
    long double size = 0;
    for (std::size_t i = 0; i < rank_; ++i) {
        const long double coordinate = static_cast<long double>(number[i]);
        sum += coordinate * weights[i];
        size += std::fabs(coordinate);
    }
    if (std::fabs(sum) > size * 0x1p-58L) return sum > 0 ? 1 : -1;
    const Number other = conjugate(number);
    bool is_zero = true;
    for (std::size_t i = 0; i < rank_; ++i) is_zero = is_zero && other[i] == (imaginary ? number[i] : -number[i]);
    return is_zero ? 0 : precise_sign(number, imaginary);
}

int Cyclotomic::precise_sign(const Number& number, bool imaginary) const {
    // Twice the number is an algebraic integer of degree up to 8, in pairs of equal size, so the product of its
    // 4 sizes is 1 or more; as none exceeds 2^67, it is above 2^-202.
    using Precise =
        boost::multiprecision::number<boost::multiprecision::cpp_bin_float<360, boost::multiprecision::digit_base_2>>;
    const Precise full_turn = 2 * acos(Precise(-1));
    Precise precise = 0;
    for (std::size_t i = 0; i < rank_; ++i) {
        const Precise angle = full_turn * static_cast<int>(i) / k_;
        precise += Precise(number[i]) * (imaginary ? Precise(sin(angle)) : Precise(cos(angle)));
    }
    return precise > 0 ? 1 : -1;
}

}  // namespace sikku
