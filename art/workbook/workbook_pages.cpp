#include "art/workbook/workbook_pages.h"

#include "art/drawing/lesson_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace sikku {
namespace {

/// One drawing that fills a page.
PlacedSheet single(SheetCell cell, const std::string& title, const std::string& subtitle, const SheetOptions& page) {
    PlacedSheet sheet{{}, page};
    sheet.options.title = title;
    sheet.options.subtitle = subtitle;
    sheet.cells.push_back(std::move(cell));
    return sheet;
}

SheetCell without_border(SheetCell cell) {
    cell.style.border.reset();
    return cell;
}

SheetCell practice(const WorkbookKolam& kolam, double traced) {
    SheetCell cell = without_border(kolam.whole);
    cell.lesson_step = 0;
    cell.traced = traced;
    return cell;
}

PlacedSheet notes_page(const WorkbookKolam& kolam, const SheetOptions& page) {
    PlacedSheet sheet = single(kolam.whole, kolam.facts.title, "", page);
    sheet.cells.front().caption = notes_of(kolam.facts);
    sheet.options.letters = 0.019 * std::min(page.page.width, page.page.height);
    sheet.options.caption_lines = 16;
    sheet.options.is_centred = false;
    return sheet;
}

/// The dots, the strokes, and the whole, side by side.
PlacedSheet steps_page(const WorkbookKolam& kolam, const SheetOptions& page) {
    PlacedSheet sheet{{}, page};
    sheet.options.title = kolam.facts.title;
    sheet.options.letters = 0.014 * std::min(page.page.width, page.page.height);
    SheetCell cell = without_border(kolam.whole);
    cell.most_steps = most_lesson_cells;
    cell.lesson_memo = std::make_shared<LessonMemo>();
    const std::size_t strokes = std::min(kolam.facts.strokes, most_lesson_cells);
    for (std::size_t step = kolam.facts.dots > 0 ? 0 : 1; step < strokes + 2; ++step) {
        cell.lesson_step = step;
        cell.caption = {step == 0 ? "dots" : step > strokes ? "whole" : std::to_string(step)};
        sheet.cells.push_back(cell);
    }
    return sheet;
}

}  // namespace

std::vector<PlacedSheet> pages_of(const WorkbookKolam& kolam, const SheetOptions& page) {
    const std::string& title = kolam.facts.title;
    std::vector<PlacedSheet> pages = {notes_page(kolam, page), steps_page(kolam, page),
                                      single(practice(kolam, 1), "Trace the lines", title, page),
                                      single(practice(kolam, 0.5), "Draw the other half", title, page)};
    if (kolam.facts.dots > 0) pages.push_back(single(practice(kolam, 0), "Draw the lines", title, page));
    if (kolam.colouring) pages.push_back(single(*kolam.colouring, "Colour the fields", title, page));
    return pages;
}

PlacedSheet front_page(const std::vector<WorkbookKolam>& kolams, const std::vector<std::size_t>& first_pages,
                       const std::string& heading, const SheetOptions& page) {
    PlacedSheet sheet{{}, page};
    sheet.options.title = heading;
    for (std::size_t i = 0; i < kolams.size(); ++i) {
        SheetCell& cell = sheet.cells.emplace_back(kolams[i].whole);
        cell.caption = {kolams[i].facts.title,
                        fmt::format("level {}, page {}", kolams[i].facts.level(), first_pages[i])};
    }
    return sheet;
}

std::vector<std::pair<std::size_t, std::size_t>> saddle_stitch(std::size_t count) {
    std::vector<std::pair<std::size_t, std::size_t>> sides;
    for (std::size_t page = 0; page < count / 2; page += 2) {
        sides.emplace_back(count - 1 - page, page);
        sides.emplace_back(page + 1, count - 2 - page);
    }
    return sides;
}

}  // namespace sikku
