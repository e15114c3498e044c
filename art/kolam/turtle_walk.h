// art/kolam/turtle_walk.h: writes places as the steps of a turtle.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <string_view>

namespace sikku {

/// Moves a turtle to places, given in steps, and writes its turns and moves with ten decimals:
/// `-(60)F(1.5)`.
class TurtleWalk {
public:
    /// @param heading  of the turtle at first, in degrees anticlockwise from the right
    TurtleWalk(std::string& text, glm::dvec2 at, double heading) : text_(text), at_(at), heading_(heading) {}

    /// Appends symbols; breaks the line before them if it would be too long.
    void put(std::string_view symbols);
    /// Turns to a place and moves there with `F` or `f`; writes nothing if the turtle is there.
    void move(glm::dvec2 to, char symbol);
    /// Turns to a direction in degrees.
    void turn(double direction);

private:
    std::string turned(double direction);

    std::string& text_;
    glm::dvec2 at_;  // of the turtle, which differs from the places by rounding
    double heading_;
};

/// Direction from one place to another, in degrees anticlockwise from the right; the same on every machine.
double direction_of(glm::dvec2 from, glm::dvec2 to);

}  // namespace sikku
