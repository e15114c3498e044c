// art/gallery/page.h: writes the HTML page of a gallery, with search, zoom and downloads.
#pragma once

#include "engine/base/output.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// One print of a gallery with its description. Texts are UTF-8; all but `name` and `print` may be empty. Paths are
/// relative to the page, with slashes, not escaped.
struct GalleryEntry {
    std::string name;  ///< unique; `index.html#NAME` opens the page with this print
    std::string title, source, description;
    std::string kind;       ///< kolams, tilings, curves, ...; filter
    std::string n;          ///< derivation length
    std::string angle;      ///< degrees; filter
    std::string growth;     ///< exponential, polynomial, bounded; filter
    std::string settings;   ///< other settings, in one line
    std::string pattern;    ///< text of the pattern file
    std::string print;      ///< the print itself, of any kind
    std::string thumbnail;  ///< PNG, SVG or JPEG; the print itself if empty
    int width = 0;          ///< width of the print's page in any unit; with `height` gives the shape of the picture
    int height = 0;         ///< 0: unknown
    std::vector<std::pair<std::string, std::string>> extras;  ///< label and path: MIDI, score, a page that plays
};

/// Writes one HTML page that needs only a browser and the files of `entries`, from a disk or a server: thumbnails,
/// search, filters, order; and each print alone to be enlarged and moved, with the pattern's text to copy. A print
/// that browsers cannot show (PDF, TIFF, EXR) is shown as its thumbnail, and linked. Equal arguments give equal
/// bytes.
///
/// Pattern texts that several entries share are stored once. Bytes that are not UTF-8 become U+FFFD.
/// @throws exceptions of `out`
void write_gallery_page(std::string_view title, std::span<const GalleryEntry> entries, Output& out);

}  // namespace sikku
