#include "art/kolam/turtle_walk.h"

#include "art/print/micrometres.h"
#include "engine/language/unit_vector.h"

#include <cmath>
#include <numbers>

namespace sikku {
namespace {

constexpr int decimals = 10;
double rounded_number(double value) {
    return std::round(value * 1e10) / 1e10;
}

/// The arc tangent of 0 to 1 in radians, the same on every machine: the series of atan(u), |u| <= sqrt(2) - 1, to
/// 1e-17.
double arc_tangent(double tangent) {
    const bool is_large = tangent > std::numbers::sqrt2 - 1;
    const double u = is_large ? (tangent - 1) / (tangent + 1) : tangent;
    double sum = 0;
    for (int n = 43; n >= 1; n -= 2) sum = 1.0 / n - u * u * sum;
    return u * sum + (is_large ? std::numbers::pi / 4 : 0);
}

}  // namespace

double direction_of(glm::dvec2 from, glm::dvec2 to) {
    const double x = to.x - from.x, y = to.y - from.y;
    const double along = std::fabs(x), across = std::fabs(y);
    if (along == 0 && across == 0) return 0;
    double angle = along >= across ? arc_tangent(across / along) : std::numbers::pi / 2 - arc_tangent(along / across);
    if (x < 0) angle = std::numbers::pi - angle;
    return (y < 0 ? -angle : angle) * 180 / std::numbers::pi;
}

void TurtleWalk::put(std::string_view symbols) {
    const std::size_t line = text_.rfind('\n') + 1;
    if (text_.size() - line + symbols.size() > 108) text_ += " \\\n    ";
    text_ += symbols;
}

std::string TurtleWalk::turned(double direction) {
    const double angle = rounded_number(std::remainder(direction - heading_, 360.0));
    if (angle == 0) return {};
    heading_ += angle;
    return std::string(1, angle < 0 ? '+' : '-') + '(' + decimal(std::fabs(angle), decimals) + ')';
}

void TurtleWalk::turn(double direction) {
    put(turned(direction));
}

void TurtleWalk::move(glm::dvec2 to, char symbol) {
    const double x = to.x - at_.x, y = to.y - at_.y;
    const double length = rounded_number(std::sqrt(x * x + y * y));
    if (length == 0) return;
    const std::string turn = turned(direction_of(at_, to));
    put(turn + symbol + '(' + decimal(length, decimals) + ')');
    at_ += length * unit_vector(heading_);
}

}  // namespace sikku
