// art/hand/lesson_steps.h: cuts lines into the stretches of a drawing lesson.
#pragma once

#include "art/hand/hand_line.h"

#include <cstddef>
#include <vector>

namespace sikku {

/// Consecutive nodes of a line; `to` may be the number of nodes of a closed line, its first node again.
struct Stretch {
    std::size_t line = 0;
    std::size_t from = 0, to = 0;
};

/// The stretches of line drawn in one step of a lesson.
using LessonStep = std::vector<Stretch>;

/// Maximum number of steps, and of cells in a picture, where a step is a cell.
constexpr std::size_t most_lesson_steps = 40, most_lesson_cells = 10;
/// Maximum size of a drawing for a lesson, in which every step repeats the lines of the steps before it.
constexpr std::size_t most_lesson_lines = 1000;
constexpr double most_lesson_points = 100'000;

/// Cuts lines, in the order of the hand, into steps: a line that is its own image under a rotation into its equal
/// parts, a long one into stretches of about a dozen loops, of equal length. Joins steps if there are more than
/// `most`. Call it before draw_by_hand(), which keeps the numbers of nodes.
std::vector<LessonStep> lesson_steps(const std::vector<HandLine>& lines, std::size_t most = most_lesson_steps);

/// The nodes of a stretch as an open line.
HandLine part_of(const HandLine& line, const Stretch& stretch);

/// The first `share` of a line by length, 0 to 1.
HandLine beginning_of(const HandLine& line, double share);

}  // namespace sikku
