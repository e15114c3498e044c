// art/reading/gap_reader.h: reads the state of a gap from the ink around it.
#pragma once

#include "art/kolam/dot_grid_lines.h"
#include "art/reading/lattice_map.h"
#include "art/reading/picture.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>

namespace sikku {

/// Agreement of the ink around a gap with each state, -1 to 1.
struct GapEvidence {
    std::array<double, 3> agreement{};  ///< by GapState
    GapState best() const;
    /// Agreement of the best state minus that of the second best.
    double margin() const;
};

/// Drawn strands of all states, for lines of several widths, made on demand and kept.
class GapTemplates {
public:
    GapTemplates();
    ~GapTemplates();

private:
    friend class GapReader;
    struct Set;
    using Key = std::pair<DotLattice, int>;  // and the radius omitted around the dots, in hundredths of a spacing
    std::map<Key, std::unique_ptr<Set>> sets_;
};

/// Compares the ink between two dots, straightened, with the strands of each state, by correlation with drawn ones of
/// several widths, bends and small displacements.
class GapReader {
public:
    /// Chooses the width of lines that fits best over some of the gaps.
    /// @param ink         is kept by reference, as is `templates`
    /// @param map         maps the plane of the lattice to the picture
    /// @param dot_radius  in spacings; the dots themselves are left out
    /// Cost: about 0.05 s, without templates 5 ms.
    GapReader(const GreyPicture& ink, const DotGrid& grid, const LatticeMap& map, double dot_radius,
              GapTemplates& templates, const Monitor& monitor);

    /// Reads the gap between two places of the lattice, with or without dots.
    /// @param offset  displacement of the strands, in spacings
    /// Cost: about 60 us.
    GapEvidence read(const LatticeMap& map, GridDot from, GridDot to, glm::dvec2 offset = glm::dvec2(0.0)) const;

private:
    const GreyPicture& ink_;
    const GapTemplates::Set& set_;
    std::size_t width_ = 0;
};

}  // namespace sikku
