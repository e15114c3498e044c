#include "art/product/cell_rows.h"

#include "art/image/image_file.h"
#include "art/product/plot_remarks.h"

#include <algorithm>
#include <vector>

namespace sikku {

SheetOptions row_options(const Print& print, const DrawOptions& drawing) {
    SheetOptions sheet;
    static_cast<WriterOptions&>(sheet) = print;
    static_cast<PictureOptions&>(sheet) = drawing;
    sheet.format = drawing.format;
    sheet.title = print.title;
    sheet.font = drawing.font;
    // Captions are short, and are read from the same distance as the drawings.
    sheet.letters = std::clamp(std::min(print.page.width, print.page.height) * 0.016, 2.0, 12.0);
    sheet.inset = 0.055;
    sheet.pattern = print.pattern;
    sheet.made = print.made;
    return sheet;
}

SheetLayout make_row(const std::vector<SheetCell>& cells, SheetOptions sheet, const DrawOptions& options,
                     Destination& destination, const std::filesystem::path& name, Made& made, bool has_faint_inks) {
    if (!sheet.press.cmyk.empty()) check_cmyk_profile(sheet.press.cmyk);
    sheet.threads = options.threads;
    sheet.monitor = options.monitor;
    sheet.watch = options.watch;
    SheetLayout layout = draw_sheet(cells, sheet, name, destination);
    warn_of_letters(layout.letters_warning, made);
    std::vector<FaintInk> faint;
    for (const DrawReport& drawn : layout.reports) faint.insert(faint.end(), drawn.faint.begin(), drawn.faint.end());
    if (!has_faint_inks) warn_of_faint_inks(faint, made);
    return layout;
}

}  // namespace sikku
