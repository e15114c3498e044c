// art/workbook/workbook_pages.h: the pages of a workbook.
#pragma once

#include "art/sheet/sheet_pages.h"
#include "art/workbook/kolam_facts.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// A kolam of a workbook, on white paper.
struct WorkbookKolam {
    KolamFacts facts;
    SheetCell whole;                     ///< with dots and a border, if it has one
    std::optional<SheetCell> colouring;  ///< absent: its regions are too small
};

/// The pages that a workbook has for a kolam, in their order: the whole with notes for the teacher; the steps of the
/// lesson; the whole line to trace, half of its strokes, the dots alone; a page to colour.
/// @param page  of the workbook
std::vector<PlacedSheet> pages_of(const WorkbookKolam& kolam, const SheetOptions& page);

/// The front page: a heading, and all kolams with their levels and pages.
/// @param first_pages  numbers of the first page of each kolam
PlacedSheet front_page(const std::vector<WorkbookKolam>& kolams, const std::vector<std::size_t>& first_pages,
                       const std::string& heading, const SheetOptions& page);

/// The order of the pages of a booklet that is folded in the middle and stapled: two for each side of a sheet, the
/// left one first, from 0; the front of a sheet is followed by its back. @param count  a multiple of 4
std::vector<std::pair<std::size_t, std::size_t>> saddle_stitch(std::size_t count);

}  // namespace sikku
