// engine/language/surface.h: predefined surfaces of bicubic Bézier patches, and readers of their texts.
#pragma once

#include "engine/language/pattern.h"

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// A bicubic Bézier patch of four rows of four control points.
struct Patch {
    std::array<glm::dvec3, 16> points;
    int colour = 0;                       ///< index of the palette; 0: that of the turtle
    std::vector<std::size_t> neighbours;  ///< sorted; patches with which it shares smooth edges
};

/// A surface in its own coordinates. The turtle is at `contact`, faces `heading`, and continues from `end`.
struct Surface {
    std::string name;
    std::vector<Patch> patches;
    bool is_smooth = false;  ///< all patches are neighbours of each other
    glm::dvec3 contact{0.0}, end{0.0};
    glm::dvec3 heading{0, 1, 0}, up{0, 0, 1};  ///< perpendicular unit vectors
    double size = 1.0;                         ///< units of these coordinates in a turtle step
    SourcePointer source;                      ///< the file; null if the pattern states it
};

/// Maximum size of all surface files of a pattern in bytes, and number of its patches.
constexpr std::size_t most_surface_bytes = std::size_t{4} << 20;
constexpr std::size_t most_patches = 4096;

/// Reads the text of a surface file of cpfg. Errors go to `diagnostics`. Cost: linear.
/// Source: cpfg's surface files as the programs of the Virtual Laboratory write them.
Surface read_surface(const SourcePointer& source, Diagnostics& diagnostics);

/// The surfaces of a pattern: those of `patch NAME:`, whose coordinates are turtle steps, x to the right, y ahead and
/// z up, and those of `surface: NAME = FILE.s, …`, files beside the pattern or in the working directory.
std::vector<std::shared_ptr<const Surface>> read_surfaces(const Pattern& pattern, Diagnostics& diagnostics);

/// The names of the surfaces of a pattern, sorted; faulty entries are left out.
std::vector<std::string> surface_names(const Pattern& pattern);

}  // namespace sikku
