#include "art/kolam/turtle_walk.h"

#include "art/print/micrometres.h"

#include <cmath>
#include <numbers>

namespace sikku {
namespace {

constexpr int decimals = 10;
double rounded_number(double value) {
    return std::round(value * 1e10) / 1e10;
}

}  // namespace

double direction_of(glm::dvec2 from, glm::dvec2 to) {
    return std::atan2(to.y - from.y, to.x - from.x) * 180 / std::numbers::pi;
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
    const double length = rounded_number(std::hypot(to.x - at_.x, to.y - at_.y));
    if (length == 0) return;
    const std::string turn = turned(direction_of(at_, to));
    put(turn + symbol + '(' + decimal(length, decimals) + ')');
    const double radians = heading_ * std::numbers::pi / 180;
    at_ += length * glm::dvec2(std::cos(radians), std::sin(radians));
}

}  // namespace sikku
