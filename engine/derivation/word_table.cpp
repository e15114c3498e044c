#include "engine/derivation/word_table.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

namespace sikku {
namespace {

bool is_combining(std::uint32_t code) {
    return (code >= 0x300 && code < 0x370) || (code >= 0x1AB0 && code < 0x1B00) || (code >= 0x20D0 && code < 0x2100);
}

/// A symbol with parameters of four digits, so that words stay readable.
std::string short_text(const SymbolInfo& symbol, std::span<const double> arguments) {
    if (symbol.arity == 0) arguments = symbol.arguments;
    std::string text = symbol.letter;
    for (std::size_t i = 0; i < arguments.size(); ++i)
        text += fmt::format("{}{:.4g}", i == 0 ? '(' : ',', arguments[i]);
    if (!arguments.empty()) text += ')';
    return text;
}

/// Symbols of a row, without places.
std::vector<TableSymbol> symbols_of(const Grammar& grammar, const LineageWord& word) {
    std::vector<TableSymbol> row(word.word.symbols.size());
    const double* next = word.word.arguments.data();
    for (std::size_t i = 0; i < row.size(); ++i) {
        const SymbolInfo& info = grammar.symbols()[word.word.symbols[i]];
        row[i].text = short_text(info, {next, info.arity});
        row[i].width = text_columns(row[i].text);
        if (!word.parents.empty()) row[i].parent = word.parents[i];
        next += info.arity;
    }
    for (std::size_t i = 0; i < word.applied.size();) {
        const std::uint32_t production = word.applied[i];
        TableSymbol& symbol = row[i];
        symbol.is_cut = production == StepOrigins::is_cut;
        symbol.is_replaced = !symbol.is_cut && production != StepOrigins::stays;
        if (symbol.is_replaced) symbol.replaced = word.next->production(production).predecessor.size();
        const std::size_t end = i + std::max<std::size_t>(symbol.replaced, 1);
        while (++i < std::min(end, row.size())) {
            row[i].is_replaced = true;
            row[i].replaced = 0;
            row[i].is_joined = row[i].parent == row[i - 1].parent;
        }
    }
    return row;
}

/// Links each row with the one below it.
void link_rows(std::vector<TableRow>& rows) {
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
        std::vector<TableSymbol>& above = rows[r].symbols;
        const std::vector<TableSymbol>& below = rows[r + 1].symbols;
        for (std::size_t i = 0; i < below.size(); ++i) {
            TableSymbol& parent = above[below[i].parent];
            if (parent.children++ == 0) parent.first_child = i;
        }
    }
}

/// Widths of the columns below each symbol, from the last row up.
class Widths {
public:
    Widths(const Grammar& grammar, const std::vector<LineageWord>& words, std::vector<TableRow>& rows)
        : grammar_(grammar), words_(words), rows_(rows) {
        for (std::size_t r = rows.size(); r-- > 0;) {
            for (std::size_t i = 0; i < rows[r].symbols.size(); ++i) {
                TableSymbol& symbol = rows[r].symbols[i];
                const std::size_t children = span(r + 1, symbol.first_child, symbol.children);
                symbol.end = symbol.is_joined ? 0 : std::max(joined_width(r, i), children);  // until it is placed
                if (symbol.is_joined) symbol.leaves = 0;
                if (symbol.children == 0) continue;
                symbol.leaves = 0;
                for (std::size_t k = 0; k < symbol.children; ++k) {
                    symbol.leaves += rows[r + 1].symbols[symbol.first_child + k].leaves;
                }
            }
        }
    }

    /// Blanks between the columns of a symbol and the next, with the same parent.
    std::size_t gap(std::size_t row, std::size_t first) const {
        if (rows_[row].symbols[first + 1].is_joined) return 0;
        if (row + 1 < rows_.size()) return 1;
        const Word& word = words_[row].word.symbols;
        return needs_blank(grammar_, word[first], word[first + 1]) ? 1 : 0;
    }

    /// Places symbols with the same parent, and their descendants, from a column on.
    void place(std::size_t row, std::size_t first, std::size_t count, std::size_t column, std::size_t leaf) {
        struct Task {
            std::size_t row, first, count, column, leaf;
        };
        std::vector<Task> tasks = {{row, first, count, column, leaf}};
        while (!tasks.empty()) {
            Task task = tasks.back();
            tasks.pop_back();
            for (std::size_t i = task.first; i < task.first + task.count; ++i) {
                TableSymbol& symbol = rows_[task.row].symbols[i];
                const std::size_t width = symbol.end;
                symbol.begin = task.column;
                symbol.end = task.column + width;
                symbol.column = symbol.is_joined
                                    ? rows_[task.row].symbols[i - 1].column + rows_[task.row].symbols[i - 1].width
                                    : task.column + (width - joined_width(task.row, i)) / 2;
                if (symbol.is_joined) {
                    symbol.begin = symbol.column;
                    symbol.end = symbol.column + symbol.width;
                }
                symbol.leaf = task.leaf;
                if (symbol.children > 0) {
                    const std::size_t below = span(task.row + 1, symbol.first_child, symbol.children);
                    tasks.push_back({task.row + 1, symbol.first_child, symbol.children,
                                     task.column + (width - below) / 2, task.leaf});
                }
                task.column += width + (i + 1 < task.first + task.count ? gap(task.row, i) : 0);
                task.leaf += symbol.leaves;
            }
        }
    }

    /// Width of the texts of a symbol and those joined to it.
    std::size_t joined_width(std::size_t row, std::size_t first) const {
        const std::vector<TableSymbol>& symbols = rows_[row].symbols;
        std::size_t width = symbols[first].width;
        for (std::size_t i = first + 1; i < symbols.size() && symbols[i].is_joined; ++i) width += symbols[i].width;
        return width;
    }

    /// Width of symbols with the same parent that are not yet placed.
    std::size_t span(std::size_t row, std::size_t first, std::size_t count) const {
        std::size_t width = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            width += rows_[row].symbols[i].end;
            if (i + 1 < first + count) width += gap(row, i);
        }
        return width;
    }

private:
    const Grammar& grammar_;
    const std::vector<LineageWord>& words_;
    std::vector<TableRow>& rows_;
};

/// True for each boundary between columns that cuts the text of a symbol; 2 where it would separate siblings of the
/// last row.
std::vector<char> cuts_of(const WordTable& table) {
    std::vector<char> cuts(table.columns + 1, 0);
    for (const TableRow& row : table.rows) {
        for (const TableSymbol& symbol : row.symbols) {
            for (std::size_t c = symbol.column + 1; c < symbol.column + symbol.width; ++c) cuts[c] = 2;
        }
    }
    const std::vector<TableSymbol>& last = table.rows.back().symbols;
    for (std::size_t i = 1; i < last.size(); ++i) {
        if (last[i].parent == last[i - 1].parent) cuts[last[i].column] = std::max<char>(cuts[last[i].column], 1);
    }
    return cuts;
}

/// Columns where blocks of lines begin, and the end.
std::vector<std::size_t> panels(const WordTable& table, std::size_t width) {
    std::vector<std::size_t> begins = {0};
    if (width == 0) {
        begins.push_back(table.columns);
        return begins;
    }
    const std::vector<char> cuts = cuts_of(table);
    while (table.columns - begins.back() > width) {
        const std::size_t first = begins.back();
        std::size_t best = first + width;
        // Between families, if that leaves at least half a line; else between symbols; else anywhere.
        for (char allowed = 0; allowed < 2; ++allowed) {
            std::size_t at = first + width;
            while (at > first + (allowed == 0 ? width / 2 : 0) && cuts[at] > allowed) --at;
            if (at <= first + (allowed == 0 ? width / 2 : 0)) continue;
            best = at;
            break;
        }
        begins.push_back(best);
    }
    begins.push_back(table.columns);
    return begins;
}

void pad(std::string& line, std::size_t& at, std::size_t column) {
    line.append(column - at, ' ');
    at = column;
}

std::string latex_escaped(std::string_view text) {
    std::string result;
    for (const char byte : text) {
        switch (byte) {
            case '\\':
                result += "\\textbackslash{}";
                break;
            case '^':
            case '~':
                result += fmt::format("\\{}{{}}", byte);
                break;
            case '-':
                result += "{-}";
                break;
            case '\'':
                result += "\\textquotesingle{}";
                break;
            case '`':
                result += "\\textasciigrave{}";
                break;
            case '{':
            case '}':
            case '$':
            case '&':
            case '#':
            case '_':
            case '%':
                result += '\\';
                result += byte;
                break;
            case '[':
            case ']':
                result += fmt::format("{{{}}}", byte);  // directly after `\\`, it would start an argument
                break;
            default:
                result += byte;
        }
    }
    return result;
}

}  // namespace

std::size_t text_columns(std::string_view utf8) {
    std::size_t columns = 0;
    for (std::size_t i = 0; i < utf8.size();) {
        std::size_t end = i + 1;
        while (end < utf8.size() && is_continuation(utf8[end])) ++end;
        columns += is_combining(code_point(utf8.substr(i, end - i))) ? 0 : 1;
        i = end;
    }
    return columns;
}

WordTable lay_out_words(const Grammar& grammar, const std::vector<LineageWord>& words) {
    WordTable table;
    for (const LineageWord& word : words) {
        table.rows.push_back(
            {word.is_interpreted ? "interpret" : std::to_string(word.steps), symbols_of(grammar, word)});
        table.symbols += table.rows.back().symbols.size();
    }
    if (words.empty()) return table;
    link_rows(table.rows);
    Widths widths(grammar, words, table.rows);
    const std::vector<TableSymbol>& roots = table.rows.front().symbols;
    table.columns = widths.span(0, 0, roots.size());
    for (const TableSymbol& root : roots) table.leaves += root.leaves;
    widths.place(0, 0, roots.size(), 0, 0);
    return table;
}

std::string words_as_text(const WordTable& table, std::size_t wrap) {
    constexpr std::size_t between = 2;
    std::size_t label = 0;
    for (const TableRow& row : table.rows) label = std::max(label, row.label.size());
    const std::size_t least = label + between + 8;
    const std::size_t width = wrap == 0 ? 0 : std::max(wrap, least) - label - between;
    const std::vector<std::size_t> begins = panels(table, width);
    std::string text;
    std::vector<std::size_t> next(table.rows.size(), 0);
    for (std::size_t p = 0; p + 1 < begins.size(); ++p) {
        if (p > 0) text += '\n';
        const std::size_t end = p + 2 == begins.size() ? SIZE_MAX : begins[p + 1];
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const TableRow& row = table.rows[r];
            std::string line = fmt::format("{:>{}}", row.label, label);
            std::size_t at = 0;
            for (std::size_t& i = next[r]; i < row.symbols.size() && row.symbols[i].column < end; ++i) {
                const TableSymbol& symbol = row.symbols[i];
                pad(line, at, symbol.column - begins[p] + between);
                line += symbol.text;
                at += symbol.width;
            }
            text += line + '\n';
        }
    }
    return text;
}

std::string words_as_markdown(const WordTable& table, std::size_t wrap, const std::string& title) {
    // The fence is longer than any in the words.
    const std::string text = words_as_text(table, wrap);
    std::size_t longest = 2, run = 0;
    for (const char byte : text) {
        run = byte == '`' ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    const std::string fence(longest + 1, '`');
    std::string head;
    for (const char byte : title) {
        if (std::string_view("\\`*_{}[]<>#|~&").find(byte) != std::string_view::npos) head += '\\';
        head += byte;
    }
    return fmt::format("{}{}text\n{}{}\n", head.empty() ? "" : "**" + head + "**\n\n", fence, text, fence);
}

std::string words_as_latex(const WordTable& table, const std::string& title) {
    std::string text = fmt::format(
        "% {}Symbols that the next step replaces are underlined by \\replaced.\n"
        "\\providecommand{{\\replaced}}[1]{{\\underline{{\\smash{{#1}}}}}}\n"
        "\\begin{{center}}\\ttfamily\\setlength{{\\tabcolsep}}{{1pt}}\n"
        "\\begin{{tabular}}{{r@{{\\quad}}*{{{}}}{{c}}}}\n",
        title.empty() ? "" : title + ". ", std::max<std::size_t>(table.leaves, 1));
    for (const TableRow& row : table.rows) {
        text += row.label;
        std::size_t leaf = 0;
        for (std::size_t i = 0; i < row.symbols.size(); ++i) {
            const TableSymbol& symbol = row.symbols[i];
            for (; leaf < symbol.leaf; ++leaf) text += " &";
            std::string shown = latex_escaped(symbol.text);
            while (i + 1 < row.symbols.size() && row.symbols[i + 1].is_joined) {
                shown += latex_escaped(row.symbols[++i].text);
            }
            const std::string word = symbol.is_replaced ? fmt::format("\\replaced{{{}}}", shown) : shown;
            text += symbol.leaves == 1 ? fmt::format(" & {}", word)
                                       : fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", symbol.leaves, word);
            leaf += symbol.leaves;
        }
        text += " \\\\\n";
    }
    return text + "\\end{tabular}\n\\end{center}\n";
}

}  // namespace sikku
