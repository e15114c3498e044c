// engine/geometry/space_turtle.h: turns the symbols of a word into segments, polygons and spheres in space.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/geometry/path.h"
#include "engine/geometry/space_bounds.h"

#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace sikku {

/// Receives a drawing in space, in drawing order, in turtle steps: x to the right, y up, z towards the reader. Spans
/// are valid only during the call.
class SpaceSink {
public:
    virtual ~SpaceSink() = default;

    /// Draws a round stem from `from` to `to`, which may be the same, in the colour of `pen`. It begins as wide as
    /// `before`, the pen with which the turtle reached `from`, and ends as wide as `pen`.
    /// @param goes_on  true if the last segment ended where this one begins, and nothing was drawn between them
    virtual void segment(const glm::dvec3& from, const Pen& before, const glm::dvec3& to, const Pen& pen,
                         bool goes_on) = 0;
    /// A filled polygon of at least three vertices, without the first repeated at the end; it need not be flat.
    virtual void polygon(std::span<const glm::dvec3> vertices, const Pen& pen) = 0;
    /// A polygon of a framework. Such polygons that share vertices are one smooth surface.
    /// @param colours  of its vertices
    virtual void facet(std::span<const glm::dvec3> vertices, std::span<const int> /*colours*/, const Pen& pen) {
        polygon(vertices, pen);
    }
    /// A predefined surface. @param map  from its coordinates
    virtual void surface(const Surface& surface, const glm::dmat4x3& map, const Pen& pen) = 0;
    /// Draws a sphere. `radius` is in turtle steps; 0 is a dot (`@.`), which the style sizes by the pen.
    virtual void sphere(const glm::dvec3& centre, double radius, const Pen& pen) = 0;
    /// Writes a text whose middle is at `centre` and whose capital letters are `height` steps high.
    virtual void label(std::string_view text, const glm::dvec3& centre, double height, const Pen& pen) = 0;
};

/// Measurements of a word that a turtle walks through, starting at 0 0 0; one step is 1.
struct SpaceSurvey {
    std::uint64_t drawn = 0;         ///< segments drawn
    std::uint64_t moves = 0;         ///< steps, drawn or not
    double length = 0.0;             ///< drawn, in steps
    std::uint64_t polygons = 0;      ///< closed by `}` or an inserted edge
    SpaceBounds box;                 ///< of all positions, the start included
    std::optional<SpaceBounds> ink;  ///< of the segments drawn, and of labels as they are seen from the front
    glm::dvec3 end{0.0};
    bool closed = false;     ///< ended where it began
    std::int64_t depth = 0;  ///< deepest nesting of brackets
};

/// A turtle in space: heading, left and up, as a quaternion. It starts in the plane of the reader, z = 0, with its up
/// towards the reader, so that a word without `& ^ \ / $` draws what the turtle of the plane draws.
/// Unbalanced brackets or braces, steps that are not finite, and nesting over 2^20 are a WordError that names the
/// symbol's position. Cost: about 30 ns a turn or segment.
/// Source: Prusinkiewicz & Hanan 1989, sections 2.5 (its matrices act on rows) and 3.1 (tropism).
class SpaceTurtle : public SymbolSink {
public:
    /// Draws into `sink`, if there is one; surveys the word in any case.
    /// @param sway  degrees, 0 or more: maximum angle by which each branch leans to a side, and by which it rolls, at
    /// random by the grammar's seed
    static std::unique_ptr<SpaceTurtle> make(const Grammar& grammar, SpaceSink* sink = nullptr, double sway = 0);

    /// Valid after finish().
    virtual const SpaceSurvey& survey() const = 0;
};

}  // namespace sikku
