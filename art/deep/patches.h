// art/deep/patches.h: a drawing composed from the parts that its symbols draw, of any size.
#pragma once

#include "art/drawing/reading.h"
#include "art/style/style.h"
#include "engine/base/numbers.h"
#include "engine/geometry/path.h"
#include "engine/language/grammar.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace sikku {

/// A place or a displacement in 113 bits.
struct QuadVector {
    Quad x = 0, y = 0;
    QuadVector& operator+=(const QuadVector& other) {
        x += other.x;
        y += other.y;
        return *this;
    }
    glm::dvec2 rounded() const { return {static_cast<double>(x), static_cast<double>(y)}; }
};

/// The parts of a drawing, composed from the smallest up: for each symbol with a number of remaining steps, its
/// displacement and a bound of its drawing. If all turns are fractions of 360 degrees, bounds are boxes for each
/// heading in which a symbol occurs; otherwise, as in pinwheels, they are discs that turn with the symbol.
class Patches {
public:
    /// Returns nullptr, with the reason in `why`, for brackets, polygons and colours that span more than 10,000
    /// symbols, for drawings in space, and for more than a million parts.
    /// @param grammar  plain, with resolved contexts; must outlive the result
    static std::unique_ptr<Patches> make(const Grammar& grammar, const Style& style, std::string& why);
    virtual ~Patches() = default;

    /// The widest pen, in the unit of the style's stroke.
    virtual double widest() const = 0;
    /// Box of the whole drawing.
    virtual const Box& box() const = 0;
    /// Number of steps, `interpret:` included.
    virtual std::size_t levels() const = 0;
    /// The centre of one of the smallest parts, chosen at random with larger parts more often.
    virtual QuadVector random_place(std::uint64_t seed) const = 0;
    /// Draws all parts that meet `box`, both relative to `origin`. Returns true if there are any.
    virtual bool read(QuadVector origin, const Box& box, PathSink& sink, const ReadingLimits& limits) const = 0;
    /// Draws each of the smallest parts once, in the headings in which it occurs, all at one place; in a single
    /// heading if headings are not fractions of 360 degrees.
    virtual void read_samples(PathSink& sink) const = 0;
};

}  // namespace sikku
