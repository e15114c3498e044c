// cli/help.h: help pages of the commands, for --help, docs/commands.md and the man pages.
#pragma once

#include "engine/base/help_page.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sikku {

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
