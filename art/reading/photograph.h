// art/reading/photograph.h: reads a kolam from a photograph.
#pragma once

#include "art/image/image_file.h"
#include "art/reading/lattice_map.h"
#include "art/reading/picture_region.h"
#include "art/reading/read_kolam.h"
#include "engine/base/monitor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

struct PhotographOptions {
    std::optional<DotLattice> lattice = {};  ///< accept only this one
    bool repair = true;                      ///< repair doubtful gaps by symmetry
    std::uint64_t most_pixels = 100'000'000;
    std::size_t number = 1;                    ///< which of several kolams; the one with most dots is the first
    std::optional<DotGrid> grid = {};          ///< the dots that the kolam has, as seen from any side
    std::optional<PictureRegion> region = {};  ///< read only this part of the picture
    std::vector<std::string> fixes = {};       ///< changes by hand, as in fix_gaps()
};

/// A kolam that was read, and its position in the picture.
struct Photograph {
    ReadKolam kolam;
    DecodedPicture picture;  ///< as it was read, about 700 to 1500 pixels wide
    LatticeMap map;  ///< from the plane of the grid, where dots lie at lattice_point(), to pixels of the picture
    std::vector<GridDot> open_ends = {};  ///< places beside the grid that lines lead to, where no dot was seen
    std::vector<GridDot> missing =
        {};  ///< places where neighbouring dots, or symmetry, suggest a dot that was not seen
    std::vector<GridDot> completed = {};  ///< dots that were not seen, but belong to the expected grid
    std::vector<glm::dvec2> others = {};  ///< dots of other kolams, and beside the lattice, in pixels
    std::size_t kolams = 1;               ///< number of kolams in the picture
    std::size_t readable = 1;             ///< number of those that can be read
    Homography to_file = {};              ///< maps pixels of the region to those of the file

    /// The position of a place of the grid in the file, in pixels.
    glm::dvec2 in_file(GridDot place) const;
};

/// Findings in a picture that was refused.
struct RefusedPicture {
    struct Spot {
        glm::dvec2 at{0.0};
        double radius = 0;
    };
    DecodedPicture picture;
    std::vector<Spot> spots = {};                   ///< round spots, which could be dots
    std::optional<Photograph> best = std::nullopt;  ///< the reading that comes nearest to a kolam; without picture
};

/// Thrown if a picture does not contain a readable kolam.
class NoKolam : public std::runtime_error {
public:
    NoKolam(const std::string& what, RefusedPicture picture)
        : std::runtime_error(what), picture_(std::make_shared<const RefusedPicture>(std::move(picture))) {}
    const RefusedPicture& picture() const { return *picture_; }

private:
    std::shared_ptr<const RefusedPicture> picture_;
};

/// Reads a kolam of dark lines on light ground or light ones on dark: finds the dots, grows a lattice through them in
/// perspective, along rows that may be bent, and compares the ink in each gap with the ink that each of the three
/// states would leave there. Gaps for which two states are almost equally likely, or none is likely, are doubtful;
/// those that the symmetry of the others decides are repaired and noted. Lost dots are reported as open ends, where
/// strands leave the kolam, and as missing, where neighbouring dots or symmetry suggest one. Several kolams are
/// counted. With an expected grid, dots that it lacks are left out, and those that were not seen are completed where
/// there is ink. Safe for untrusted files.
/// @throws NoKolam if most gaps are doubtful, if the lines explain little of the ink around the dots, or lead from
///     few dots to others, and if no kolam has the expected grid; FixError; std::runtime_error if the file is not a
///     picture, has fewer kolams than `number`, or does not contain the region, and for an expected grid of more than
///     10,000 dots
/// Time: about 1 s for 12 megapixels, and up to 3 s for pictures without a readable kolam.
Photograph read_photograph(const std::filesystem::path& path, const PhotographOptions& options = {},
                           const Monitor& monitor = {});

/// Reads a photograph from another source. @param decode  called once or twice
Photograph read_photograph(const PictureDecoder& decode, const PhotographOptions& options = {},
                           const Monitor& monitor = {});

/// Draws the kolam that was read over the picture, as PNG: dots as rings, strands in the colour of their state
/// (crossed green, turned blue, joined magenta), doubtful gaps in orange rings with their row and number, repaired
/// ones in yellow; open ends in red rings and missing dots in broken red rings, with their row and place; completed
/// dots in broken cyan rings; dots of other kolams in grey rings.
/// @throws std::runtime_error if the file cannot be written
void write_overlay(const Photograph& photograph, const std::filesystem::path& path);

/// Draws a refused picture: its spots in grey rings, and the reading that comes nearest to a kolam.
void write_overlay(const RefusedPicture& refused, const std::filesystem::path& path);

}  // namespace sikku
