#include "art/product/print_cell.h"

#include "art/product/border_files.h"
#include "art/product/highlight.h"

#include <utility>

namespace sikku {

SheetCell print_cell(const Document& document, const DrawSettings& settings, const std::filesystem::path& folder,
                     std::shared_ptr<const Font> font, const Monitor& monitor) {
    SheetCell cell;
    static_cast<DrawingOptions&>(cell) = drawing_options(settings, document);
    cell.budget = settings.work.budget;
    cell.grammar = document.shared_grammar();
    cell.style = read_print_style(document, settings);
    if (settings.look.highlight) {
        LitDrawing lit =
            lit_drawing(document.grammar(), cell.style, *settings.look.highlight, settings.work.budget, monitor);
        cell.grammar = std::make_shared<const Grammar>(std::move(lit.grammar));
        cell.style = std::move(lit.style);
    }
    load_border(cell.style, document, settings, folder, cell);
    cell.font = font ? std::move(font) : load_font(settings.look.font_name, folder);
    cell.title = document.text("title");
    return cell;
}

}  // namespace sikku
