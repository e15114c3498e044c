// art/motion/lesson.h: writes drawing lessons as pages and animations.
#pragma once

#include "art/writer/draw.h"

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

struct LessonOptions {
    double seconds = 2.0;  ///< time in which an animation draws a stretch
    double pause = 1.0;    ///< pause after each stretch
    double hold = 4.0;     ///< minimum display time of the whole drawing
};

/// Draws a lesson (LessonDrawing): a PDF with a page for each step, an SVG that shows one step after the other and
/// draws each stretch, or, for PNG options, an animated GIF. Viewers without animation show the whole drawing of the
/// SVG. @throws as draw()
DrawReport draw_lesson(const Grammar& grammar, Print print, const DrawOptions& options, const LessonOptions& lesson,
                       const std::filesystem::path& file, Destination& destination = file_system());

/// The steps of a lesson.
struct LessonLength {
    std::size_t first = 0;             ///< 0, the dots; 1 for drawings without dots
    std::size_t count = 0;             ///< one after the last, the whole drawing
    std::vector<glm::dvec2> starts{};  ///< where the strokes begin, in turtle steps
};
/// @throws as draw()
LessonLength lesson_length(const Grammar& grammar, Print print, const DrawOptions& options);

}  // namespace sikku
