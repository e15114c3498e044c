// cli/gallery_summary.h: what is made of a whole gallery: its page, a poster, a contact sheet.
#pragma once

#include "cli/gallery_jobs.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Files that no job may have: `index.html` and those of the sheets.
bool is_summary(std::string_view file);

/// Writes `index.html` into the folder: one entry for each name, whatever formats it was made in.
/// @param replaces  also a page that others made, which is an error otherwise
void write_gallery_index(const std::vector<GalleryJob>& jobs, const std::filesystem::path& folder, bool replaces);

struct SheetRequest {
    std::string name;       ///< of the files: poster, contact
    std::string size;       ///< as for `sikku draw`
    bool is_poster = true;  ///< with large captions; else a contact sheet, with names alone
    bool replaces = false;  ///< also files that others made
};

/// Draws the prints of the gallery, one for each name, on one sheet: NAME.svg, NAME.pdf, NAME.png. Where patterns
/// have several derivation lengths, each has a row of its own. @throws UsageError, and what draw_sheet() throws
void draw_gallery_sheet(const std::vector<GalleryJob>& jobs, const std::filesystem::path& folder,
                        const SheetRequest& request, const Telling& telling);

}  // namespace sikku
