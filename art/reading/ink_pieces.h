// art/reading/ink_pieces.h: connected pieces of ink.
#pragma once

#include "art/reading/picture.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// Connected ink: the pixels of a part of a picture that are above a level, each with the number of its piece.
class InkPieces {
public:
    /// @param low, high  corners of the part, in pixels
    InkPieces(const GreyPicture& ink, double level, glm::dvec2 low, glm::dvec2 high);
    /// The piece at a place of the picture, from 1; 0 for ground, and outside of the part.
    std::uint32_t at(glm::dvec2 place) const;
    /// The longer side of the box around a piece, in pixels.
    double size(std::uint32_t piece) const;

private:
    std::size_t left_ = 0;
    std::size_t top_ = 0;
    std::size_t width_ = 0;
    std::vector<std::uint32_t> pieces_;
    std::vector<double> sizes_;
};

}  // namespace sikku
