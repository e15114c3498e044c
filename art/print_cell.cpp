#include "art/print_cell.h"

namespace sikku {

SheetCell print_cell(const Document& document, const DrawSettings& settings) {
    SheetCell cell;
    static_cast<DrawingOptions&>(cell) = drawing_options(settings);
    cell.grammar = document.shared_grammar();
    cell.style = read_print_style(document, settings);
    cell.title = document.text("title");
    return cell;
}

}  // namespace sikku
