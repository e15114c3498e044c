// art/workbook/kolam_facts.h: measures how difficult a kolam is, and describes it for teachers.
#pragma once

#include "art/kolam/kolam.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace sikku {

/// A dot by its row, from the top, and its number in the row, from the left; both from 1.
struct DotNumber {
    std::size_t row = 0, number = 0;
    bool operator==(const DotNumber&) const = default;
};

/// Dots in rows from the top, each from left to right.
class DotRows {
public:
    /// @param dots  y up
    explicit DotRows(std::vector<glm::dvec2> dots);

    std::size_t count() const;
    /// The customary notation of the grid: `5x5`, `7-1 ner pulli` (straight), `9-5 idukku pulli` (interlaced), or the
    /// dots in each row, such as `2-4-4-2`. Empty without dots.
    std::string notation() const;
    /// The dot nearest to a point; row 0 without dots.
    DotNumber nearest(glm::dvec2 point) const;

private:
    std::vector<std::vector<glm::dvec2>> rows_;
};

/// The facts about a kolam that notes for teachers state.
struct KolamFacts {
    std::string title;
    std::string grid;  ///< customary notation; empty if the dots form no grid
    std::size_t dots = 0, lines = 0, crossings = 0;
    std::size_t open_lines = 0;
    std::size_t strokes = 0;  ///< steps of its lesson, without the dots and the whole
    KolamSymmetry symmetry;
    std::vector<DotNumber> starts;  ///< dots at which the strokes begin, in their order

    /// Dots + crossings + 4 x strokes of a line: more dots and crossings take longer to find the way through, and a
    /// line of many strokes is harder to remember than many lines of one.
    double difficulty() const;
    /// 1, easy, to 5: below a difficulty of 20, 40, 80, 160, and above.
    int level() const;
};

constexpr int most_level = 5;

/// Notes for the teacher, in paragraphs: level, grid, lines, symmetry, order of strokes.
std::vector<std::string> notes_of(const KolamFacts& facts);

}  // namespace sikku
