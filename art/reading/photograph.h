// art/reading/photograph.h: reads a kolam from a photograph.
#pragma once

#include "art/image/image_file.h"
#include "art/reading/lattice.h"
#include "art/reading/read_kolam.h"
#include "engine/base/monitor.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace sikku {

struct PhotographOptions {
    std::optional<DotLattice> lattice = {};  ///< only this one
    bool repair = true;                      ///< doubtful gaps by symmetry
    std::uint64_t most_pixels = 100'000'000;
};

/// A kolam that was read, and where it lies in the picture.
struct Photograph {
    ReadKolam kolam;
    DecodedPicture picture;  ///< as it was read, about 1500 pixels wide
    Homography map;  ///< from the plane of the grid, where dots lie at lattice_point(), to pixels of the picture
};

/// Reads a kolam of dark lines on light ground or light ones on dark: finds the dots, fits a lattice through them in
/// perspective, and compares the ink in each gap with what the three states would leave there. Gaps for which two
/// states are nearly as likely, or none, are doubtful; those that the symmetry of the others decides are repaired
/// and noted. Safe for untrusted files.
/// @throws std::runtime_error if the file is no picture, or no lattice of dots is found in it
/// Time: about 1.5 s for 12 megapixels.
Photograph read_photograph(const std::filesystem::path& path, const PhotographOptions& options = {},
                           const Monitor& monitor = {});

/// Decodes a picture so that no side is longer than `longest_side`, as read_picture() does.
using PictureDecoder = std::function<DecodedPicture(int longest_side)>;
/// The same of a picture that comes from elsewhere. @param decode  called once or twice
Photograph read_photograph(const PictureDecoder& decode, const PhotographOptions& options = {},
                           const Monitor& monitor = {});

/// Draws the kolam that was read over the picture, as PNG: dots as rings, strands in the colour of their state
/// (crossed green, turned blue, joined magenta), doubtful gaps in orange rings with their row and number, repaired
/// ones in yellow.
/// @throws std::runtime_error if the file cannot be written
void write_overlay(const Photograph& photograph, const std::filesystem::path& path);

}  // namespace sikku
