#include "engine/language/unit_vector.h"

#include <cmath>
#include <numbers>

namespace sikku {
namespace {

/// Cosine and sine of at most 45 degrees, within one unit in the last place. The functions of C libraries differ in
/// their last bits, and so would drawings; Taylor's series has the same bits everywhere.
glm::dvec2 small_angle(double radians) {
    const double square = radians * radians;
    double cosine = 0, sine = 0;
    for (int power = 16; power > 0; power -= 2) {
        cosine = square / ((power - 1) * power) * (1 - cosine);
        sine = square / (power * (power + 1)) * (1 - sine);
    }
    return {1 - cosine, radians - radians * sine};
}

}  // namespace

FoldedTurn fold_turn(TurnFraction turn) {
    const std::int64_t q = turn.denominator;
    std::int64_t p = turn.numerator % q;
    if (p < 0) p += q;
    const std::int64_t quarter = (8 * p / q + 1) / 2;
    return {static_cast<int>(quarter % 4), 4 * p - quarter * q};
}

glm::dvec2 unit_vector(TurnFraction turn) {
    const FoldedTurn folded = fold_turn(turn);
    const std::int64_t q = turn.denominator;
    const std::int64_t distance = std::abs(folded.rest);
    glm::dvec2 near(1.0, 0.0);
    if (3 * distance == q) {  // 30 degrees
        near = {std::sqrt(3.0) / 2, 0.5};
    } else if (2 * distance == q) {
        near = glm::dvec2(std::sqrt(0.5));
    } else if (distance != 0) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(distance) / (4 * static_cast<double>(q));
        near = small_angle(angle);
    }
    if (folded.rest < 0) near.y = -near.y;
    return by_quarters(folded.quarter, near);
}

glm::dvec2 unit_vector(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    // Whole multiples of a thousandth of a degree are folded exactly, too.
    const double thousandths = turned * 1000;
    if (thousandths == std::floor(thousandths)) return unit_vector(TurnFraction{std::llround(thousandths), 360'000});
    const double rest = std::remainder(turned, 90.0);
    const auto quarter = static_cast<int>(std::lround((turned - rest) / 90));
    return by_quarters(((quarter % 4) + 4) % 4, small_angle(rest * std::numbers::pi / 180));
}

}  // namespace sikku
