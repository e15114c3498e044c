// tests/fuzz/surface_targets.h: what the fuzzer does with any bytes as a surface file.
#pragma once

#include "engine/language/surface.h"
#include "tests/fuzz/targets.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>

namespace sikku {

/// read_surface on any bytes: a surface of finite points and perpendicular axes, or readable errors with places.
inline void try_surface(std::string_view bytes) {
    Diagnostics diagnostics;
    const SourcePointer source = read_source("fuzz.s", std::string(bytes), diagnostics);
    if (diagnostics.has_errors()) return;
    const Surface surface = read_surface(source, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        require(is_utf8(diagnostic.text()), "a diagnostic is not valid UTF-8");
        require(diagnostic.where.line >= 1 && diagnostic.where.column >= 1, "a place is counted from 1");
    }
    if (diagnostics.has_errors()) return;
    require(!surface.patches.empty() && surface.size > 0, "a surface without patches or size");
    require(std::fabs(glm::dot(surface.heading, surface.up)) < 1e-9, "the axes are not perpendicular");
    for (const Patch& patch : surface.patches) {
        for (const glm::dvec3& point : patch.points) {
            require(std::isfinite(point.x + point.y + point.z), "a control point is not finite");
        }
        for (const std::size_t other : patch.neighbours) {
            require(other < surface.patches.size(), "a neighbour is not a patch of the surface");
        }
    }
}

}  // namespace sikku
