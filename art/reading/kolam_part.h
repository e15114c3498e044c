// art/reading/kolam_part.h: a part of a picture that may be a kolam, and the reasons why it is not.
#pragma once

#include "art/reading/kolam_reader.h"
#include "art/reading/read_kolam.h"
#include "engine/geometry/box.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// A kolam with fewer dots would be found by chance.
inline constexpr std::size_t least_kolam_dots = 4;

/// A part of a picture with dots on a lattice.
struct KolamPart {
    LineReading reading;
    ReadKolam kolam;
    std::string refusal;  ///< reason why it is not a readable kolam; empty if it is
    bool is_dark = true;
    std::size_t beside = 0;        ///< dots between the places of the lattice
    bool is_border = false;        ///< a border of the kolams within it
    bool has_more_within = false;  ///< a frame around ink that was not read
    std::size_t surplus = 0;       ///< dots that were found beside the expected grid
    std::size_t unread = 0;        ///< dots on the same lattice whose lines are not a kolam

    std::size_t dots() const { return kolam.grid.dots().size(); }
    bool is_kolam() const { return refusal.empty(); }
    /// True for dots on a lattice with lines around them, even if most gaps cannot be read.
    bool is_counted() const;
    /// True if its dots are those of the expected grid.
    bool is_expected() const { return reading.is_given; }
    /// Dots that were added or left out to make them so.
    std::size_t changes() const { return surplus + reading.added.size(); }
    /// True for lines around dots on a lattice, which may be ornaments.
    bool has_lines() const { return dots() >= 9 && reading.explained >= 0.5 && 2 * reading.joined >= dots(); }
    /// True for dots in single rows, such as those of a border.
    bool is_narrow() const;
};

/// Rates the certainty of the gaps of a reading, and decides whether it is a kolam. Gaps beside places that may have
/// a dot are doubtful; if the dots are given, those beside dots without ink.
KolamPart part_of(LineReading reading, bool is_dark);

/// The area around the dots of a reading.
class KolamArea {
public:
    explicit KolamArea(const LineReading& reading);
    /// A place of the lattice, of any offset, from one of its dots.
    glm::dvec2 from_first(glm::dvec2 pixel) const;
    bool is_regular() const { return back_.has_value(); }
    /// True if a pixel lies close to a dot, within some spacings, or between dots: not in a hole, such as that of a
    /// frame.
    bool contains(glm::dvec2 pixel, double reach = 1.45) const;
    /// The box around the dots.
    const Box& box() const { return box_; }
    /// The pixels of that box.
    double pixels() const;

private:
    DotGrid grid_;
    LatticeMap map_;
    std::optional<Homography> back_;
    Box box_;
};

/// True if a pixel lies in one of some areas.
bool is_in(const std::vector<KolamArea>& areas, glm::dvec2 pixel);

/// Dots between the places of a lattice: spots like its dots, within it.
std::size_t dots_beside(const KolamPart& part, const std::vector<InkSpot>& spots);

}  // namespace sikku
