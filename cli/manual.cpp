// cli/manual.cpp: `sikku manual`: the manual of the commands, from the same pages as --help.
#include "cli/command.h"
#include "cli/help.h"
#include "cli/mistakes.h"
#include "engine/base/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace sikku {
namespace {

std::string markdown_manual(const CLI::App& app) {
    std::string text =
        "# Commands\n\nThis page is printed by `sikku manual markdown`. `sikku COMMAND --help` prints each part of "
        "it.\n\n" +
        help_markdown(help_page(app));
    for (const CLI::App* command : listed_commands(app)) text += '\n' + help_markdown(help_page(*command));
    return text;
}

/// Writes sikku.1 and a page for each command, and prints their names unless `quiet`.
void write_man_pages(const CLI::App& app, const std::filesystem::path& folder, bool quiet) {
    std::filesystem::create_directories(folder);
    const auto write = [&](const HelpPage& page, const std::vector<std::string>& others) {
        const auto output = file_system().open(folder / (hyphenated(page.name) + ".1"));
        output->write(man_page(page, others));
        output->commit();
        if (!quiet) fmt::print("{}\n", (folder / (hyphenated(page.name) + ".1")).string());
    };
    std::vector<std::string> names;
    for (const CLI::App* command : listed_commands(app)) names.push_back(hyphenated(help_page(*command).name));
    write(help_page(app), names);
    for (const CLI::App* command : listed_commands(app)) write(help_page(*command), {"sikku"});
}

}  // namespace

void add_manual(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("manual", "Print the manual as Markdown, or write man pages into a folder");
    auto format = std::make_shared<std::string>();
    auto folder = std::make_shared<std::string>();
    command->add_option("FORMAT", *format, "markdown or man")->required()->check(one_of({"markdown", "man"}));
    command->add_option("FOLDER", *folder, "where the man pages go (the working directory)");
    command->footer("Examples:\n  sikku manual markdown > commands.md\n  sikku manual man ~/.local/share/man/man1");
    command->callback([format, folder, &app, &quiet] {
        if (*format == "man") return write_man_pages(app, folder->empty() ? "." : *folder, quiet);
        fmt::print("{}", markdown_manual(app));
    });
}

}  // namespace sikku
