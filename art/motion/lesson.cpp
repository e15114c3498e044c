#include "art/motion/lesson.h"

#include "art/drawing/lesson_drawing.h"
#include "art/motion/gif_file.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"
#include "art/writer/make_drawing.h"
#include "art/writer/press_inks.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int frames_of_stretch = 6;

std::unique_ptr<LessonDrawing> make_lesson(const Grammar& grammar, const Style& style, DrawOptions options) {
    options.lesson_step = options.lesson_step.value_or(0);
    std::unique_ptr<Drawing> drawing = make_drawing(grammar, style, options);
    auto* lesson = dynamic_cast<LessonDrawing*>(drawing.get());
    if (!lesson) throw std::logic_error("a lesson is drawn step by step");
    static_cast<void>(drawing.release());
    return std::unique_ptr<LessonDrawing>(lesson);
}

std::string title_of(const Print& print, std::size_t step, std::size_t count) {
    const std::string name = step == 0           ? "dots"
                             : step + 1 == count ? "whole"
                                                 : fmt::format("{} / {}", step, count - 2);
    return print.title.empty() ? name : print.title + ": " + name;
}

/// @param first  step to begin with: a page without dots is left out
void draw_pages(LessonDrawing& lesson, const Print& print, std::size_t first, std::size_t count, Output& output) {
    const auto writer = write_pdf_pages(print, output);
    for (std::size_t step = first; step < count; ++step) {
        Print page = print;
        page.style.ground.reset();
        page.title = title_of(print, step, count);
        lesson.show(step);
        writer->begin_page(page, whole_page(print.page), glm::dvec2(0.0), 1.0);
        lesson.read(page, *writer);
    }
    writer->finish();
}

void draw_parts(LessonDrawing& lesson, const Print& print, std::size_t first, std::size_t count,
                const LessonOptions& options, Output& output) {
    const auto writer = write_svg(print, output);
    std::vector<Print> parts(count - first, print);
    for (std::size_t step = first; step < count; ++step) {
        Print& part = parts[step - first];
        part.style.ground.reset();
        part.title = title_of(print, step, count);
        const auto [first_new, last_new] = lesson.new_colours();
        part.lesson = LessonPart{static_cast<int>(step - first),
                                 static_cast<int>(count - first),
                                 options.seconds + options.pause,
                                 options.seconds,
                                 first_new,
                                 last_new};
        lesson.show(step);
        writer->begin_part(part, whole_page(print.page));
        lesson.read(part, *writer);
    }
    writer->finish();
}

void draw_frames(LessonDrawing& lesson, const Print& print, std::size_t first, std::size_t count,
                 const DrawOptions& drawing, const LessonOptions& options, Output& output,
                 const std::filesystem::path& file) {
    const std::size_t stretches = count - 2;
    GifFile gif(print, drawing, count - first + stretches * (frames_of_stretch - 1), output, file);
    for (std::size_t step = first; step < count; ++step) {
        const bool is_stretch = step > 0 && step + 1 < count;
        for (int frame = 1; is_stretch && frame < frames_of_stretch; ++frame) {
            lesson.show(step, static_cast<double>(frame) / frames_of_stretch);
            gif.frame(lesson, print, options.seconds / frames_of_stretch);
        }
        lesson.show(step);
        const double rest = is_stretch ? options.seconds / frames_of_stretch : 0;
        gif.frame(lesson, print, step + 1 == count ? std::max(options.hold, options.pause) : rest + options.pause);
    }
    gif.close();
}

}  // namespace

DrawReport draw_lesson(const Grammar& grammar, Print print, const DrawOptions& given, const LessonOptions& options,
                       const std::filesystem::path& file, Destination& destination) {
    const DrawOptions drawing = with_locked_watch(given);
    load_inks(print.press, drawing.format);
    const auto lesson = make_lesson(grammar, print.style, drawing);
    lesson->number_pages();
    DrawReport report = lesson->place(print);
    print.style = lesson->style();
    check_spots(print.press, print.style);
    const std::size_t count = lesson->count(print);
    lesson->report(report);
    const std::size_t first = report.dots > 0 ? 0 : 1;
    const auto output = destination.open(file);
    if (drawing.format == PrintFormat::pdf) {
        draw_pages(*lesson, print, first, count, *output);
    } else if (drawing.format == PrintFormat::svg) {
        draw_parts(*lesson, as_picture(print), first, count, options, *output);
    } else {
        draw_frames(*lesson, print, first, count, drawing, options, *output, file);
    }
    output->commit();
    return report;
}

LessonLength lesson_length(const Grammar& grammar, Print print, const DrawOptions& options) {
    const auto lesson = make_lesson(grammar, print.style, options);
    DrawReport report = lesson->place(print);
    print.style = lesson->style();
    lesson->report(report);
    return {report.dots > 0 ? std::size_t{0} : std::size_t{1}, lesson->count(print), lesson->starts(print)};
}

}  // namespace sikku
