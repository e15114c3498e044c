// art/relief/solid.h: a solid whose height is constant in each region of the plane, as a closed mesh.
#pragma once

#include "art/relief/regions.h"
#include "art/style/colour.h"
#include "engine/base/monitor.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sikku {

/// The prism over a region, from 0 up to its height.
struct ReliefRegion {
    std::int32_t height = 0;  ///< micrometres, above 0
    Colour colour;
};

/// A corner of the solid in micrometres, z up.
struct SolidPoint {
    std::int32_t x = 0, y = 0, z = 0;
    bool operator==(const SolidPoint&) const = default;
};
/// Corners anticlockwise, seen from outside.
using SolidTriangle = std::array<SolidPoint, 3>;

/// The prisms over all regions of a plane, united. Each edge belongs to two triangles, in opposite directions, and no
/// corner lies within an edge. Where prisms touch only along an upright edge, squares of 50 µm or more as high as the
/// highest one join them; where that does not help, narrow gaps are filled.
class Solid {
public:
    /// @param plane  outlines already divided, so that they do not cross
    /// @param regions  at least one; the regions of `plane` are indices into it
    /// @throws Stopped
    Solid(PlaneRegions plane, std::vector<ReliefRegion> regions, const Monitor& monitor);

    using Visit = std::function<void(std::uint32_t region, const SolidTriangle&)>;
    /// Visits all triangles, with the regions to which they belong: the bottom belongs to the first.
    void visit(const Visit& visit) const;
    std::span<const ReliefRegion> regions() const { return regions_; }
    double volume() const;    ///< cubic millimetres
    glm::dvec3 size() const;  ///< size of its box, in millimetres

private:
    PlaneRegions plane_, bottom_;
    std::vector<ReliefRegion> regions_;
    Monitor monitor_;
};

}  // namespace sikku
