// art/reading/straightened.h: shows a photograph of a kolam from straight above.
#pragma once

#include "art/reading/photograph.h"
#include "engine/geometry/box.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// A picture with 4 bytes a pixel, rows from top to bottom; pixels outside of the photograph are transparent.
struct StraightPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels = {};
};

/// The photograph as its grid is drawn: dots lie where dot_place() draws them.
/// @param box  what it shows, in spacings from the middle of the grid's box, y up; of positive size
/// @param longest_side  in pixels, at least 1; reached if the picture is not stretched for it
StraightPicture straightened(const Photograph& photograph, const Box& box, int longest_side);

}  // namespace sikku
