// art/sheet/sheet_pages.h: a document of several pages, each with one or more sheets.
#pragma once

#include "art/sheet/sheet.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// A sheet, and the place of its top left corner on a page, in millimetres.
struct PlacedSheet {
    std::vector<SheetCell> cells;
    SheetOptions options;
    glm::dvec2 at{0.0};
};
/// The sheets of a page; none for a blank one.
using SheetPage = std::vector<PlacedSheet>;

/// Draws pages into a PDF, which appears whole or not at all. Page, title, inks and monitor are those of `document`.
/// Memory: that of the drawings of two pages. @throws as draw_sheet()
/// @returns a warning of characters in the texts that the lettering lacks; empty if it has all
std::string draw_pages(const std::vector<SheetPage>& pages, const SheetOptions& document,
                       const std::filesystem::path& file, Destination& destination = file_system());

}  // namespace sikku
