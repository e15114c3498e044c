#include "engine/geometry/lattice.h"

#include "tests/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace sikku::lattice_test {

using reference::grammar_of;
using Complex = std::complex<long double>;

Complex root(long double turns) {
    return std::polar(1.0L, 2 * std::numbers::pi_v<long double> * turns);
}
void expect_near(glm::dvec2 found, Complex expected, const std::string& what, double tolerance = 3e-16) {
    EXPECT_NEAR(found.x, static_cast<double>(expected.real()), tolerance) << what;
    EXPECT_NEAR(found.y, static_cast<double>(expected.imag()), tolerance) << what;
}
Lattice lattice_of(const std::string& text) {
    const Grammar grammar = grammar_of(text);
    return make_lattice(grammar);
}
int totient(int k) {
    int count = 0;
    for (int i = 1; i <= k; ++i) count += std::gcd(i, k) == 1 ? 1 : 0;
    return count;
}

TEST(Lattice, PowersAreThoseOfTheRootOfUnity) {
    for (int k = 1; k <= 40; ++k) {
        const Lattice lattice =
            lattice_of("axiom: F+F\nturn: left\nheading: 0\nangle factor: " + std::to_string(k) + "\n");
        const int headings = k <= 2 ? 4 : k;
        ASSERT_EQ(lattice.headings, static_cast<std::uint32_t>(headings)) << k;
        EXPECT_EQ(lattice.rank, k <= 30 && totient(headings) <= 8 ? totient(headings) : 0) << k;
        ASSERT_EQ(lattice.direction.size(), static_cast<std::size_t>(headings));
        for (int h = 0; h < headings; ++h) {
            const std::string what = std::to_string(k) + " " + std::to_string(h);
            const auto at = static_cast<std::size_t>(h);
            expect_near(lattice.direction[at], root(static_cast<long double>(h) / headings), what);
            if (lattice.rank == 0) continue;
            Complex sum = 0;
            for (int i = 0; i < lattice.rank; ++i) {
                sum += static_cast<long double>(lattice.power[at][static_cast<std::size_t>(i)]) *
                       root(static_cast<long double>(i) / headings);
            }
            expect_near({static_cast<double>(sum.real()), static_cast<double>(sum.imag())},
                        root(static_cast<long double>(h) / headings), what, 1e-15);
        }
    }
}

TEST(Lattice, HeadingsAreTheLeastThatHoldEveryTurn) {
    struct Case {
        std::string text;
        std::uint32_t headings;
        int rank;
    };
    for (const Case& expected : {Case{"axiom: F\n", 4, 2},
                                 {"axiom: F+F\nangle factor: 6\n", 6, 2},
                                 {"axiom: F+F|\nangle factor: 3\n", 6, 2},
                                 {"axiom: F+F|\nangle factor: 5\n", 10, 4},
                                 {"axiom: F+F+(60)\nangle factor: 8\n", 24, 8},
                                 {"axiom: F+(90)+(40)\n", 36, 0},
                                 {"axiom: F+F\nangle increment: 25.7\n", 3600, 0},
                                 {"axiom: F+F\nangle increment: 137.508\n", 30000, 0},
                                 {"axiom: F+F\nangle increment: 1.23456789\n", 0, 0},
                                 {"axiom: F+F\nangle increment: 1e300\n", 0, 0},
                                 {"axiom: F+F\nangle factor: 7\n", 7, 6},
                                 {"axiom: F+F\nangle factor: 1048576\n", 1048576, 0},
                                 {"axiom: F+F\nangle factor: 1048577\n", 0, 0}}) {
        const Lattice lattice = lattice_of(expected.text);
        EXPECT_EQ(lattice.headings, expected.headings) << expected.text;
        EXPECT_EQ(lattice.rank, expected.rank) << expected.text;
    }
}

TEST(Lattice, TurnsAndLengthsAreWhole) {
    const Grammar grammar = grammar_of("axiom: + - | F f F(2.5) F(-0.2) f(3) X +(60)\nangle factor: 4\n");
    const Lattice lattice = make_lattice(grammar);
    EXPECT_EQ(lattice.headings, 12u);
    EXPECT_EQ(lattice.unit, 0.1);
    const Word& axiom = grammar.axiom();
    EXPECT_EQ(lattice.turn[axiom[0]], 9u);  // to the right
    EXPECT_EQ(lattice.turn[axiom[1]], 3u);
    EXPECT_EQ(lattice.turn[axiom[2]], 6u);
    EXPECT_EQ(lattice.turn[axiom[9]], 10u);
    for (const auto& [at, length] : {std::pair{3, 10}, {4, 10}, {5, 25}, {6, -2}, {7, 30}, {8, 0}}) {
        EXPECT_EQ(lattice.length[axiom[static_cast<std::size_t>(at)]], length) << at;
    }
}

TEST(Lattice, LengthsThatAreNotShortDecimalsLeaveIt) {
    EXPECT_EQ(lattice_of("axiom: F(0.001)\n").rank, 2);
    EXPECT_EQ(lattice_of("axiom: F(1/3)\n").rank, 0);
    EXPECT_EQ(lattice_of("axiom: F(1e-9)\n").rank, 0);
    EXPECT_EQ(lattice_of("axiom: F(1e30)\n").rank, 0);
    EXPECT_EQ(lattice_of("axiom: F A(1/3)\n").rank, 2);  // no step
}

TEST(Lattice, TheFirstHeadingTurnsTheDirections) {
    for (const char* heading : {"90", "0", "-45", "360/7", "12.345", "1.2345678901234567", "123456789.5", "1e22"}) {
        const double degrees =
            std::fmod(grammar_of("axiom: F\nheading: " + std::string(heading) + "\n").heading().degrees, 360.0);
        for (const int k : {4, 5, 7, 24}) {
            const Lattice lattice = lattice_of("axiom: F+\nheading: " + std::string(heading) +
                                               "\nangle factor: " + std::to_string(k) + "\n");
            for (int h = 0; h < k; ++h) {
                expect_near(lattice.direction[static_cast<std::size_t>(h)],
                            root(static_cast<long double>(degrees) / 360 + static_cast<long double>(h) / k), heading,
                            1e-14);
                if (HasFailure()) return;
            }
        }
    }
}

TEST(UnitVector, IsExactWhereSinesAreHalvesOrWholes) {
    for (int i = -48; i <= 48; ++i) {
        const glm::dvec2 at = unit_vector(15.0 * i);
        expect_near(at, root(i / 24.0L), std::to_string(15 * i), 1.2e-16);
        EXPECT_EQ(at, unit_vector(TurnFraction{i, 24}));
        if (i % 6 == 0) {
            EXPECT_TRUE(at.x == 0 || at.y == 0) << i;
        } else if (i % 2 == 0 && i % 3 != 0) {
            EXPECT_TRUE(std::fabs(at.x) == 0.5 || std::fabs(at.y) == 0.5) << i;
        } else if (i % 3 == 0) {
            EXPECT_EQ(std::fabs(at.x), std::fabs(at.y)) << i;
        }
    }
    for (int i = -1000; i <= 1000; ++i) {
        expect_near(unit_vector(0.37 * i), root(0.37L * i / 360), std::to_string(i), 4e-14);
        // Mirrored and turned, it is the same to the last bit.
        const glm::dvec2 at = unit_vector(TurnFraction{i, 997});
        EXPECT_EQ(at.x, unit_vector(TurnFraction{-i, 997}).x);
        EXPECT_EQ(at.y, -unit_vector(TurnFraction{-i, 997}).y);
        EXPECT_EQ(at.x, unit_vector(TurnFraction{4 * i + 997, 4 * 997}).y);
    }
}

TEST(FoldTurn, IsTheNearestAxisAndTheRest) {
    for (std::int64_t q = 1; q <= 60; ++q) {
        for (std::int64_t p = -2 * q; p <= 2 * q; ++p) {
            const FoldedTurn folded = fold_turn({p, q});
            EXPECT_GE(folded.quarter, 0);
            EXPECT_LT(folded.quarter, 4);
            EXPECT_LE(2 * std::abs(folded.rest), q) << p << '/' << q;
            // p / q = quarter / 4 + rest / 4q, but for whole turns
            EXPECT_EQ((4 * p - folded.quarter * q - folded.rest) % (4 * q), 0) << p << '/' << q;
        }
    }
}

}  // namespace sikku::lattice_test
