// cli/help.h: help pages of the commands, for --help, docs/commands.md and the man pages.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sikku {

/// One option, argument or command with its description.
struct HelpRow {
    std::string names;  ///< `-n, --steps N`
    std::string text;
};

/// The rows under a heading.
struct HelpGroup {
    std::string heading;
    std::vector<HelpRow> rows;
};

/// The help page of a command, or of the program.
struct HelpPage {
    std::string name;  ///< `sikku draw`
    std::string summary;
    std::string usage;  ///< `sikku draw [OPTIONS] PATTERN -o FILE`
    std::vector<HelpGroup> groups;
    std::vector<std::string> notes;     ///< paragraphs
    std::vector<std::string> examples;  ///< command lines
};

/// Collects the page of a command from its options.
HelpPage help_page(const CLI::App& command);

/// The listed commands, in the order of help.
std::vector<const CLI::App*> listed_commands(const CLI::App& app);

/// Formats --help: options aligned and grouped, at most 100 columns wide, examples last.
class HelpFormatter : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace sikku
