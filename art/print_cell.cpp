#include "art/print_cell.h"

namespace sikku {

SheetCell print_cell(const Document& document, const DrawSettings& settings) {
    SheetCell cell;
    cell.grammar = document.shared_grammar();
    cell.style = read_print_style(document, settings);
    cell.placement.rotate = settings.rotate;
    cell.placement.mirror = settings.mirror;
    cell.placement.step = settings.step;
    cell.title = document.text("title");
    cell.window = settings.window;
    cell.only_dots = settings.only_dots;
    cell.colours_strokes = settings.colours_strokes;
    cell.border = settings.border;
    cell.budget = settings.budget;
    return cell;
}

}  // namespace sikku
