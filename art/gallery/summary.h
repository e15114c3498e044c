// art/gallery/summary.h: makes the page, the poster and the contact sheet of a gallery.
#pragma once

#include "art/gallery/jobs.h"
#include "engine/base/output.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// True for names that jobs may not use: `index.html` and the files of the sheets.
bool is_summary(std::string_view file);

/// True if a file that begins with these (up to 4096) bytes was written by write_gallery_index().
bool is_gallery_page(std::string_view beginning);

struct SheetRequest {
    std::string name;       ///< name of the files: poster, contact
    std::string size;       ///< as for `sikku draw`
    bool is_poster = true;  ///< with large captions; else a contact sheet, with names alone
    int threads = 0;        ///< 0: one for each core
    double memory = 0;      ///< bytes for the pixels and cells of pictures; 0: no limit
};

/// The files of a sheet: NAME.pdf, NAME.png, NAME.svg.
std::vector<std::string> sheet_files(const SheetRequest& request);

/// @param jobs  jobs whose files exist
/// @param file  `index.html`: one entry for each name, whatever formats it was made in
void write_gallery_index(const std::vector<const GalleryJob*>& jobs, const std::string& title,
                         const std::filesystem::path& file, Destination& destination, const Monitor& monitor);

/// Draws the prints among `jobs`, one for each name, on one sheet; the file's extension selects the format. Where
/// patterns have several derivation lengths, each has rows of its own.
/// @return a warning of characters in its texts that the lettering lacks; empty if it has all
/// @throws GalleryError if no job is a print, and everything that draw_sheet() throws
std::string draw_gallery_sheet(const std::vector<const GalleryJob*>& jobs, const SheetRequest& request,
                               const std::filesystem::path& file, Destination& destination, const Monitor& monitor);

/// Estimated bytes needed to draw that sheet: see sheet_memory(). @throws exceptions of draw_gallery_sheet()
double gallery_sheet_memory(const std::vector<const GalleryJob*>& jobs, const SheetRequest& request,
                            const std::filesystem::path& file);

}  // namespace sikku
