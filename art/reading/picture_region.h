// art/reading/picture_region.h: cuts a part out of a picture, and straightens it.
#pragma once

#include "art/image/image_file.h"
#include "art/reading/lattice.h"

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <string_view>

namespace sikku {

/// Decodes a picture so that no side is longer than `longest_side`, as read_picture() does.
using PictureDecoder = std::function<DecodedPicture(int longest_side)>;

/// Four corners of a region that becomes a rectangle, in pixels of the file from its top left corner: the top left
/// one, then the others clockwise.
struct PictureRegion {
    std::array<glm::dvec2, 4> corners{};

    /// The length of its upper and lower side, on average, and of its other sides.
    glm::dvec2 size() const;
    /// Maps pixels of the rectangle, which is as large as size(), to those of the file.
    Homography to_file() const;
};

/// Reads `x,y,width,height` in pixels. @throws std::runtime_error
PictureRegion parse_crop(std::string_view text);

/// Reads `x,y x,y x,y x,y` in pixels: four corners around the region, from the top left one, in either direction.
/// @throws std::runtime_error if they are not those of a convex quadrangle
PictureRegion parse_corners(std::string_view text);

/// Decodes a region as a rectangle, averaged over squares of pixels until no side is longer than `longest_side`; its
/// size in the file is that of the region. Pictures with sides over 8000 pixels are reduced first.
/// @throws std::runtime_error if the region does not lie within the picture
DecodedPicture read_region(const PictureDecoder& decode, const PictureRegion& region, int longest_side);

}  // namespace sikku
