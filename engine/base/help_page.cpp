#include "engine/base/help_page.h"

#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sikku {
namespace {

constexpr std::size_t page_columns = 100;
constexpr std::size_t text_column = 30;

/// The number of columns that `text` takes, one for each code point.
std::size_t columns(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size(); ++count) at += std::max<std::size_t>(1, utf8_length(text.substr(at)));
    return count;
}

/// `text` in lines of at most `page_columns`, each after the first indented.
std::string wrapped(std::string_view text, std::size_t indent) {
    std::string result;
    std::size_t column = indent;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string_view word = text.substr(at, end - at);
        at = end + 1;
        if (word.empty()) continue;
        const std::size_t width = columns(word);
        if (column > indent && column + 1 + width > page_columns) {
            result += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (column > indent) {
            result += ' ';
            ++column;
        }
        result += word;
        column += width;
    }
    return result;
}

/// A cell of a table of Markdown; code if `is_code`.
std::string cell(const std::string& text, bool is_code) {
    std::string result;
    for (const char letter : text) {
        if (letter == '|') result += '\\';
        if (letter == '<' && !is_code) {
            result += "&lt;";
            continue;
        }
        result += letter;
    }
    return is_code ? '`' + result + '`' : result;
}

/// Text of roff, in which hyphens, backslashes and leading dots and quotes have meanings of their own.
std::string roff(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (letter == '\\') {
            result += "\\e";
        } else if (letter == '-') {
            result += "\\-";
        } else {
            if ((letter == '.' || letter == '\'') && result.empty()) result += "\\&";
            result += letter;
        }
    }
    return result;
}

std::string upper(std::string text) {
    for (char& letter : text) {
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    }
    return text;
}

}  // namespace

std::string help_text(const HelpPage& page) {
    std::string text = wrapped(page.summary, 0) + "\n\nUsage: " + page.usage + '\n';
    for (const HelpGroup& group : page.groups) {
        text += '\n' + group.heading + ":\n";
        for (const HelpRow& row : group.rows) {
            // Long names without a short one stand below each other.
            std::string names = (row.names.starts_with("--") ? "      " : "  ") + row.names;
            const std::size_t width = columns(names);
            names += width + 2 > text_column ? '\n' + std::string(text_column, ' ')
                                             : std::string(text_column - width, ' ');
            text += names + wrapped(row.text, text_column) + '\n';
        }
    }
    for (const std::string& paragraph : page.notes) text += '\n' + wrapped(paragraph, 0) + '\n';
    if (!page.examples.empty()) text += "\nExamples:\n";
    for (const std::string& example : page.examples) text += "  " + example + '\n';
    return text;
}

std::string help_markdown(const HelpPage& page) {
    std::string text = fmt::format("## {}\n\n{}\n\n    {}\n", page.name, page.summary, page.usage);
    for (const HelpGroup& group : page.groups) {
        text += fmt::format("\n| {} | |\n|---|---|\n", group.heading);
        for (const HelpRow& row : group.rows) {
            text += fmt::format("| {} | {} |\n", cell(row.names, true), cell(row.text, false));
        }
    }
    for (const std::string& paragraph : page.notes) text += '\n' + paragraph + '\n';
    if (!page.examples.empty()) text += "\nExamples:\n\n";
    for (const std::string& example : page.examples) text += "    " + example + '\n';
    return text;
}

std::string hyphenated(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string man_page(const HelpPage& page, const std::vector<std::string>& others) {
    std::string text =
        fmt::format(".TH {} 1 \"\" \"Sikku {}\" \"Sikku\"\n.SH NAME\n{} \\- {}\n", upper(hyphenated(page.name)),
                    SIKKU_VERSION, roff(hyphenated(page.name)), roff(page.summary));
    text += ".SH SYNOPSIS\n.B " + roff(page.usage) + '\n';
    for (const HelpGroup& group : page.groups) {
        text += ".SH \"" + upper(group.heading) + "\"\n";
        for (const HelpRow& row : group.rows) {
            text += fmt::format(".TP\n.B {}\n{}\n", roff(row.names), roff(row.text));
        }
    }
    if (!page.notes.empty()) text += ".SH NOTES\n";
    for (const std::string& paragraph : page.notes) text += ".PP\n" + roff(paragraph) + '\n';
    if (!page.examples.empty()) text += ".SH EXAMPLES\n.nf\n";
    for (const std::string& example : page.examples) text += roff(example) + '\n';
    if (!page.examples.empty()) text += ".fi\n";
    text += ".SH \"SEE ALSO\"\n";
    for (std::size_t i = 0; i < others.size(); ++i) {
        text += fmt::format(".BR {} (1){}\n", roff(others[i]), i + 1 < others.size() ? "," : "");
    }
    return text;
}

}  // namespace sikku
