#include "art/words/word_svg.h"

#include "art/vector/svg.h"
#include "art/words/tidy_tree.h"
#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

// Lengths are millimetres.
constexpr double letter_size = 5;
constexpr double letter_advance = 0.602 * letter_size;  // of the letters of the usual monospaced fonts
constexpr double head_size = 3.4;                       // letters of productions and labels
constexpr double word_around = 10;                      // margin
constexpr double below_baseline = 1.6, above_baseline = 4.6;

constexpr const char* lit_symbol_ink = "#b3452c";
constexpr const char* symbol_ink = "#2a2622";
constexpr const char* pale_symbol_ink = "#8a8278";
constexpr const char* thread_ink = "#cfc7ba";
constexpr const char* funnel_tint = "#f3dfd3";

/// Collects the elements of a figure. Places are those of the figure's own corner.
class WordCanvas {
public:
    void text(double x, double y, std::string_view text, const char* style) {
        texts_ += fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", number(x), number(y), style,
                              xml_escaped(text));
        right_ = std::max(right_, x);
        bottom_ = std::max(bottom_, y + below_baseline);
    }
    void line(double x0, double y0, double x1, double y1, const char* colour) {
        lines_ += fmt::format("<path d=\"M{} {}L{} {}\" stroke=\"{}\"/>\n", number(x0), number(y0), number(x1),
                              number(y1), colour);
    }
    /// A tinted area from one width above to another below.
    void funnel(double x0, double x1, double top, double x2, double x3, double bottom) {
        const double middle = (top + bottom) / 2;
        areas_ +=
            fmt::format("<path d=\"M{0} {2}H{1}C{1} {6} {4} {6} {4} {5}H{3}C{3} {6} {0} {6} {0} {2}Z\"/>\n",
                        number(x0), number(x1), number(top), number(x2), number(x3), number(bottom), number(middle));
    }
    void reach(double right, double bottom) {
        right_ = std::max(right_, right);
        bottom_ = std::max(bottom_, bottom);
    }

    /// The file, with a title and lines above the figure.
    std::string file(const WordFigure& figure) const {
        double top = word_around;
        std::string head;
        double right = right_;
        const auto add = [&](std::string_view text, double size, const char* style) {
            top += 1.5 * size;
            head += fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", number(word_around),
                                number(top - 0.3 * size), style, xml_escaped(text));
            right = std::max(right, 0.62 * size * static_cast<double>(text_columns(text)));
        };
        if (!figure.title.empty()) add(figure.title, 6, "title");
        for (const std::string& line : figure.lines) add(line, head_size, "rule");
        if (top > word_around) top += 5;
        const std::string width = number(right + 2 * word_around), height = number(top + bottom_ + word_around);
        std::string file = fmt::format(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:sikku=\"{}\"\n"
            "     width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n"
            "<title>{}</title>\n<desc>{}</desc>\n<metadata>\n<sikku:made>{}</sikku:made>\n",
            svg_name_space, width, height, width, height, xml_escaped(figure.title), xml_escaped(figure.pattern),
            xml_escaped(figure.made));
        if (!fits_xml(figure.pattern)) {
            file += fmt::format("<sikku:pattern>{}</sikku:pattern>\n", to_hex(figure.pattern));
        }
        file += fmt::format(
            "</metadata>\n<style>\n"
            "text {{ font-family: 'DejaVu Sans Mono', Menlo, Consolas, monospace; font-size: {}px; fill: {} }}\n"
            ".s, .l, .c {{ text-anchor: middle }}\n.l {{ fill: {}; font-weight: bold }}\n"
            ".c {{ fill: {} }}\n.n {{ font-size: {}px; fill: {}; text-anchor: end }}\n"
            ".rule {{ font-size: {}px; white-space: pre }}\n.title {{ font-family: 'DejaVu Sans', Helvetica, Arial, "
            "sans-serif; "
            "font-size: 6px; font-weight: bold }}\n</style>\n",
            letter_size, symbol_ink, lit_symbol_ink, pale_symbol_ink, head_size, pale_symbol_ink, head_size);
        file += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n{}", width, height, head);
        file += fmt::format(
            "<g transform=\"translate({} {})\">\n<g fill=\"{}\">\n{}</g>\n"
            "<g fill=\"none\" stroke-width=\"0.35\" stroke-linecap=\"round\">\n{}</g>\n{}</g>\n</svg>\n",
            number(word_around), number(top), funnel_tint, areas_, lines_, texts_);
        return file;
    }

private:
    /// Hundredths of a millimetre, without zeros at the end.
    static std::string number(double value) {
        std::string text = fmt::format("{:.2f}", value);
        while (text.back() == '0') text.pop_back();
        if (text.back() == '.') text.pop_back();
        return text == "-0" ? "0" : text;
    }

    std::string texts_, lines_, areas_;
    double right_ = 0, bottom_ = 0;
};

const char* class_of_symbol(const TableSymbol& symbol) {
    return symbol.is_cut ? "c" : symbol.is_replaced ? "l" : "s";
}

/// Writes `n = 0` and so on before the rows, and returns the width that they take.
double write_labels(const WordTable& table, double pitch, WordCanvas& canvas) {
    std::size_t widest = 0;
    const auto label = [](const TableRow& row) { return row.label == "interpret" ? row.label : "n = " + row.label; };
    for (const TableRow& row : table.rows) widest = std::max(widest, label(row).size());
    const double width = 0.602 * head_size * static_cast<double>(widest);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        canvas.text(width, above_baseline + static_cast<double>(r) * pitch, label(table.rows[r]), "n");
    }
    return width + 6;
}

/// The text on one line, with arrows for `-->`.
std::string single_spaced(std::string_view text) {
    constexpr std::string_view arrow = "-->";
    std::string result = fmt::format("{}", fmt::join(split_words(text, " \t\n\r"), " "));
    for (std::size_t at = 0; (at = result.find(arrow, at)) != std::string::npos;)
        result.replace(at, arrow.size(), "→");
    return result;
}

/// At most `most` characters.
std::string cut_off(const std::string& text, std::size_t most) {
    if (text_columns(text) <= most) return text;
    std::string result;
    for (std::size_t i = 0, shown = 0; i < text.size(); ++i) {
        if (!is_continuation(text[i]) && ++shown >= most) break;
        result += text[i];
    }
    return result + "…";
}

}  // namespace

WordFigure word_figure(const Pattern& pattern) {
    constexpr std::size_t most_lines = 12, most_characters = 100;
    WordFigure figure;
    figure.title = pattern.text("title");
    figure.pattern = pattern.source->text();
    if (const Key* axiom = pattern.find("axiom")) {
        figure.lines.push_back(cut_off("axiom: " + single_spaced(axiom->value.view()), most_characters));
    }
    std::size_t left_out = 0;
    const auto add = [&](const std::vector<ProductionText>& productions, std::string_view table) {
        for (const ProductionText& production : productions) {
            if (figure.lines.size() > most_lines) {
                ++left_out;
                continue;
            }
            const std::string text = single_spaced(production.whole.view());
            figure.lines.push_back(
                cut_off(table.empty() ? text : fmt::format("{}: {}", table, text), most_characters));
        }
    };
    add(pattern.common, "");
    for (const TableText& table : pattern.tables) add(table.productions, table.name.view());
    if (left_out > 0) figure.lines.push_back(fmt::format("… and {}", counted(left_out, "production")));
    return figure;
}

std::string words_svg(const WordTable& table, const WordFigure& figure) {
    constexpr double pitch = 15;
    WordCanvas canvas;
    const double left = write_labels(table, pitch, canvas);
    const auto x = [&](std::size_t column) { return left + letter_advance * static_cast<double>(column); };
    const auto middle = [&](const TableSymbol& symbol) {
        return left + letter_advance * (static_cast<double>(symbol.column) + static_cast<double>(symbol.width) / 2);
    };
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const std::vector<TableSymbol>& row = table.rows[r].symbols;
        const double baseline = above_baseline + static_cast<double>(r) * pitch;
        const double top = baseline + below_baseline, bottom = baseline + pitch - above_baseline;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const TableSymbol& symbol = row[i];
            canvas.text(middle(symbol), baseline, symbol.text, class_of_symbol(symbol));
            if (symbol.replaced == 0) continue;
            const TableSymbol& last = row[i + std::max<std::size_t>(symbol.replaced, 1) - 1];
            if (symbol.children == 0) {
                if (!symbol.is_replaced) continue;
                const double at = (middle(symbol) + middle(last)) / 2;
                canvas.funnel(x(symbol.column), x(last.column + last.width), top, at - 0.7, at + 0.7, bottom);
                canvas.text(at, baseline + pitch, "ε", "c");
                continue;
            }
            const std::vector<TableSymbol>& next = table.rows[r + 1].symbols;
            const TableSymbol& first_child = next[symbol.first_child];
            const TableSymbol& last_child = next[symbol.first_child + symbol.children - 1];
            if (symbol.is_replaced) {
                canvas.funnel(x(symbol.column), x(last.column + last.width), top, x(first_child.column),
                              x(last_child.column + last_child.width), bottom);
            } else {
                canvas.line(middle(symbol), top + 0.8, middle(first_child), bottom - 0.8, thread_ink);
            }
        }
    }
    canvas.reach(x(table.columns), 0);
    return canvas.file(figure);
}

std::string tree_svg(const WordTable& table, const WordFigure& figure) {
    constexpr double pitch = 17, space = 3.2;
    // A root above all symbols of the first word, which is not drawn.
    std::vector<TidyNode> nodes = {{1, table.rows.empty() ? 0 : table.rows.front().symbols.size(), 0}};
    std::vector<std::size_t> begins;
    for (const TableRow& row : table.rows) {
        begins.push_back(nodes.size());
        const std::size_t below = nodes.size() + row.symbols.size();
        for (const TableSymbol& symbol : row.symbols) {
            nodes.push_back({below + symbol.first_child, symbol.children,
                             letter_advance * static_cast<double>(symbol.width) + space});
        }
    }
    const std::vector<double> places = tidy_places(nodes);
    double least = 0, most = 0;
    for (std::size_t v = 1; v < nodes.size(); ++v) {
        const double low = places[v] - nodes[v].width / 2, high = places[v] + nodes[v].width / 2;
        least = v == 1 ? low : std::min(least, low);
        most = v == 1 ? high : std::max(most, high);
    }
    WordCanvas canvas;
    const double left = write_labels(table, pitch, canvas) - least;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const std::vector<TableSymbol>& row = table.rows[r].symbols;
        const double baseline = above_baseline + static_cast<double>(r) * pitch;
        const double top = baseline + below_baseline, bottom = baseline + pitch - above_baseline;
        std::size_t owner = 0;  // the symbol whose production replaces this one
        for (std::size_t i = 0; i < row.size(); ++i) {
            const TableSymbol& symbol = row[i];
            if (symbol.replaced > 0) owner = i;
            const double at = left + places[begins[r] + i];
            canvas.text(at, baseline, symbol.text, class_of_symbol(symbol));
            const TableSymbol& source = row[owner];
            const char* colour = symbol.is_replaced ? lit_symbol_ink : thread_ink;
            for (std::size_t k = 0; k < source.children; ++k) {
                canvas.line(at, top + 0.5, left + places[begins[r + 1] + source.first_child + k], bottom - 0.5,
                            colour);
            }
            if (source.children == 0 && symbol.is_replaced) {
                canvas.line(at, top + 0.5, left + places[begins[r] + owner], bottom - 0.5, colour);
                if (owner == i) canvas.text(at, baseline + pitch, "ε", "c");
            }
        }
    }
    canvas.reach(left + most, 0);
    return canvas.file(figure);
}

}  // namespace sikku
