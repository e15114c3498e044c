// cli/manual.cpp: `sikku manual` prints the manual of the commands from the pages of --help. Help does not list it:
// the build and the tests use it.
#include "cli/command.h"
#include "cli/help.h"
#include "engine/base/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace sikku {
namespace {

/// Formats a cell of a Markdown table, as code if `is_code`.
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

std::string markdown(const HelpPage& page, const std::string& level) {
    std::string text = fmt::format("{} {}\n\n{}\n\n    {}\n", level, page.name, page.summary, page.usage);
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

std::string markdown_manual(const CLI::App& app) {
    std::string text =
        "# Commands\n\nThis page is printed by `sikku manual markdown`. `sikku COMMAND --help` prints each part of "
        "it.\n\n" +
        markdown(help_page(app), "##");
    for (const CLI::App* command : listed_commands(app)) text += '\n' + markdown(help_page(*command), "##");
    return text;
}

/// Escapes text for roff: hyphens, backslashes, and leading dots and quotes.
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

std::string hyphenated(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string upper(std::string text) {
    for (char& letter : text) {
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    }
    return text;
}

/// @param others  names of the other pages
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

/// Writes sikku.1 and a page for each command.
void write_man_pages(const CLI::App& app, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const auto write = [&](const HelpPage& page, const std::vector<std::string>& others) {
        const auto output = file_system().open(folder / (hyphenated(page.name) + ".1"));
        output->write(man_page(page, others));
        output->commit();
    };
    std::vector<std::string> names;
    for (const CLI::App* command : listed_commands(app)) names.push_back(hyphenated(help_page(*command).name));
    write(help_page(app), names);
    for (const CLI::App* command : listed_commands(app)) write(help_page(*command), {"sikku"});
}

}  // namespace

void add_manual(CLI::App& app) {
    auto* command = app.add_subcommand("manual", "print the manual as Markdown, or write man pages into a folder");
    command->group("");
    auto format = std::make_shared<std::string>();
    auto folder = std::make_shared<std::string>();
    command->add_option("FORMAT", *format, "markdown or man")->required()->check(CLI::IsMember({"markdown", "man"}));
    command->add_option("FOLDER", *folder, "folder for the man pages (the working directory)");
    command->callback([format, folder, &app] {
        if (*format == "man") return write_man_pages(app, folder->empty() ? "." : *folder);
        fmt::print("{}", markdown_manual(app));
    });
}

}  // namespace sikku
