// art/product/rule_print.cpp: a print of the productions of a pattern: predecessor, arrow and successor of
// each.
#include "art/product/cell_rows.h"
#include "art/product/plot_remarks.h"
#include "art/product/print_cell.h"
#include "art/product/print_work.h"
#include "art/product/rule_figures.h"
#include "art/writer/make_drawing.h"
#include "engine/base/text.h"
#include "engine/language/document.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

/// Places of a production on the page, in millimetres.
struct RulePlaces {
    std::size_t columns = 1;
    double cell_width = 0, cell_height = 0;
    double arrow = 0;  ///< width between both sides
    double across = 0, down = 0;
};

/// Returns the places with the number of columns that makes the drawings largest.
RulePlaces places_of(std::size_t count, const Window& room, double caption) {
    constexpr double arrow_share = 0.13, gap = 0.06;
    RulePlaces best;
    for (std::size_t columns = 1; columns <= std::min<std::size_t>(count, 4); ++columns) {
        const std::size_t rows = (count + columns - 1) / columns;
        RulePlaces places;
        places.columns = columns;
        const double space = columns > 1 ? gap * room.width : 0;
        const double width = (room.width - space * static_cast<double>(columns - 1)) / static_cast<double>(columns);
        places.across = width + space;
        places.arrow = arrow_share * width;
        places.cell_width = (width - places.arrow) / 2;
        places.down = room.height / static_cast<double>(rows);
        places.cell_height = std::min(places.down - caption, places.cell_width);
        places.down = std::min(places.down, places.cell_height + 1.25 * caption);
        if (columns == 1 || places.cell_height > best.cell_height * 1.02) best = places;
    }
    return best;
}

class RulePrint : public PrintWork {
public:
    explicit RulePrint(PrintRequest request) : PrintWork(std::move(request)) {
        if (document().map()) refuse_option("rule", "", "applies to words, and a map has none");
        RuleFigures found = rule_figures(document(), print().style, settings().work.budget, {});
        sentences_ = std::move(found.sentences);
        if (found.figures.empty()) {
            std::string why;
            for (const std::string& sentence : sentences_) why += "; " + sentence;
            refuse_option("rule", "", "no production of the pattern draws anything" + why);
        }
        make_cells(found);
    }

    Cost forecast() const override { return sheet_cost(cells_, options()); }

private:
    SheetOptions options() const {
        SheetOptions sheet = row_options(print(), drawing());
        static_cast<PlotSetup&>(sheet) = drawing();
        sheet.is_centred = true;
        *sheet.letters *= 1.5;
        sheet.caption_lines = 3;
        for (const std::string& sentence : sentences_) sheet.footer += (sheet.footer.empty() ? "" : " · ") + sentence;
        return sheet;
    }

    void make_cells(const RuleFigures& found) {
        const Page& page = print().page;
        const SheetOptions sheet = options();
        const double letters = *sheet.letters;
        const double title = print().title.empty() ? 0 : sheet_title_height(page) * sheet_title_room;
        Window room{page.margin, page.margin + title, page.width - 2 * page.margin,
                    page.height - 2 * page.margin - title - (sheet.footer.empty() ? 0 : 2 * letters), 0};
        const RulePlaces places = places_of(found.figures.size(), room, 4.5 * letters);
        if (!(places.cell_width > 1 && places.cell_height > 1)) {
            refuse_option("rule", "",
                          fmt::format("the page has no room for {}; use a larger size",
                                      counted(found.figures.size(), "production")));
        }
        const auto row_count = (found.figures.size() + places.columns - 1) / places.columns;
        const auto rows = static_cast<double>(row_count);
        room.top += std::max(0.0, (room.height - rows * places.down) / 2);
        SheetCell model = print_cell(document(), settings(), folder(), drawing().font);
        model.style = found.style;
        model.may_be_empty = true;
        const SheetCell arrow = arrow_cell();
        std::vector<DrawnExtent> frames;
        glm::dvec2 largest_cell(0);
        for (const RuleFigure& figure : found.figures) {
            frames.push_back(common_extent(figure, model));
            if (figure.is_cell) largest_cell = glm::max(largest_cell, frames.back().box.size());
        }
        for (std::size_t i = 0; i < found.figures.size(); ++i) {
            const double left = room.left + static_cast<double>(i % places.columns) * places.across;
            const auto row = i / places.columns;
            const double top = room.top + static_cast<double>(row) * places.down;
            const RuleFigure& figure = found.figures[i];
            if (figure.is_cell) frames[i].box.high = frames[i].box.low + largest_cell;
            add_production(figure, frames[i], model, arrow, places, left, top);
        }
    }

    void add_production(const RuleFigure& figure, const DrawnExtent& frame, const SheetCell& model, SheetCell arrow,
                        const RulePlaces& places, double left, double top) {
        SheetCell before = model;
        before.grammar = figure.predecessor;
        before.title = figure.before;
        before.caption = {figure.before};
        SheetCell after = before;
        after.grammar = figure.successor;
        after.title = figure.before + " → " + figure.after;
        after.caption = {figure.after};
        before.frame = after.frame = frame;
        before.slot = Window{left, top, places.cell_width, places.cell_height, 0};
        after.slot = Window{left + places.cell_width + places.arrow, top, places.cell_width, places.cell_height, 0};
        const double size = 0.62 * places.arrow;
        arrow.slot = Window{left + places.cell_width + (places.arrow - size) / 2,
                            top + (places.cell_height - size / 2) / 2, size, size / 2, 0};
        cells_.push_back(std::move(before));
        cells_.push_back(std::move(arrow));
        cells_.push_back(std::move(after));
    }

    static DrawnExtent common_extent(const RuleFigure& figure, const SheetCell& model) {
        DrawnExtent all;
        for (const auto& grammar : {figure.predecessor, figure.successor}) {
            const DrawnExtent extent = make_drawing(*grammar, model.style, model, Reading())->seen();
            if (!extent.box.empty()) {
                all.box.add(extent.box.low);
                all.box.add(extent.box.high);
            }
            all.widest = std::max(all.widest, extent.widest);
            all.around = std::max(all.around, extent.around);
        }
        return all;
    }

    SheetCell arrow_cell() const {
        const Document pattern = parse("arrow",
                                       "axiom: F[+F(0.36)][-F(0.36)]\nangle increment: 150\nheading: 0\n"
                                       "stroke: 0.05 step #2a2622\nground: none\n");
        SheetCell cell;
        cell.grammar = pattern.shared_grammar();
        cell.style = read_print_style(pattern, DrawSettings());
        cell.title = "arrow";
        return cell;
    }

    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        const SheetLayout layout = make_row(cells_, this->options(), options, destination, name, made, true);
        if (layout.plot) report_plot(*layout.plot, settings().plot.speeds, settings().plot.pen_rules, made);
        if (layout.plot && format() == PrintFormat::hpgl) report_hpgl(*layout.plot, settings(), options.hpgl, made);
        report.polygons = layout.polygons;
        for (const std::string& sentence : sentences_) made.fact(sentence);
    }

    std::vector<SheetCell> cells_;
    std::vector<std::string> sentences_;
};

}  // namespace

std::unique_ptr<PrintWork> plan_rule(PrintRequest request) {
    return std::make_unique<RulePrint>(std::move(request));
}

}  // namespace sikku
