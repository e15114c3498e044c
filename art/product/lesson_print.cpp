// art/product/lesson_print.cpp: drawing lessons, and generations side by side.
#include "art/drawing/lesson_drawing.h"
#include "art/image/image_file.h"
#include "art/motion/lesson.h"
#include "art/motion/motion_cost.h"
#include "art/product/cell_rows.h"
#include "art/product/plot_remarks.h"
#include "art/product/print_cell.h"
#include "art/product/print_work.h"
#include "art/style/contrast.h"
#include "engine/derivation/forecast.h"

#include <algorithm>
#include <string>

namespace sikku {
namespace {

class GenerationRow : public PrintWork {
public:
    using PrintWork::PrintWork;

    Cost forecast() const override { return sheet_cost(cells(), row_options(print(), drawing())); }

private:
    std::vector<SheetCell> cells(const Monitor& monitor = {}) const {
        const auto [first, last] = *settings().time.generations;
        SheetCell cell = print_cell(document(), settings(), folder(), nullptr, monitor);
        cell.may_be_empty = true;
        return generations(cell, first, last);
    }

    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        make_row(cells(options.monitor), row_options(print(), drawing()), options, destination, name, made);
    }
};

class LessonPrint : public PrintWork {
public:
    using PrintWork::PrintWork;

    Cost forecast() const override {
        return lesson_cost(shorten(grammar()), print(), drawing(), format() == PrintFormat::gif);
    }

private:
    /// A cell for each step; without dots, the first step is left out.
    std::vector<SheetCell> cells(const DrawOptions& options) const {
        DrawOptions steps = options;
        steps.begin = nullptr;
        steps.most_steps = most_lesson_cells;
        steps.lesson_memo = std::make_shared<LessonMemo>();
        const LessonLength length = lesson_length(grammar(), print(), steps);
        std::vector<SheetCell> list;
        for (std::size_t step = length.first; step < length.count; ++step) {
            SheetCell& cell =
                list.emplace_back(print_cell(document(), settings(), folder(), drawing().font, options.monitor));
            cell.lesson_step = step;
            cell.most_steps = steps.most_steps;
            cell.lesson_memo = steps.lesson_memo;
            cell.style.border.reset();
            cell.caption = {step == 0 ? "dots" : step + 1 == length.count ? "whole" : std::to_string(step)};
        }
        return list;
    }

    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        const Style& style = print().style;
        if (style.ground && style.ground->alpha == 255 && is_faint(style.line_colour({}), *style.ground)) {
            made.warn(faint_text({FaintInk::Kind::lines, style.line_colour({}), *style.ground}));
        }
        if (info(format()).kind == FormatKind::pixels) {
            make_row(cells(options), row_options(print(), drawing()), options, destination, name, made);
            return;
        }
        LessonOptions lesson;
        lesson.seconds = *settings().time.lesson * 2 / 3;
        lesson.pause = *settings().time.lesson / 3;
        lesson.hold = settings().time.hold.value_or(lesson.hold);
        const DrawReport drawn = draw_lesson(grammar(), print(), options, lesson, name, destination);
        if (drawn.dots == 0) made.warn("the lesson has no page of dots, because the lines enclose none");
        report_overflow(drawn, made);
    }
};

}  // namespace

std::unique_ptr<PrintWork> plan_row(PrintRequest request) {
    return std::make_unique<GenerationRow>(std::move(request));
}

std::unique_ptr<PrintWork> plan_lesson(PrintRequest request) {
    return std::make_unique<LessonPrint>(std::move(request));
}

}  // namespace sikku
