// engine/base/help_page.h: a page of help as data, and as text for terminals, Markdown and man pages.
#pragma once

#include <string>
#include <vector>

namespace sikku {

/// One option, argument or command with its description.
struct HelpRow {
    std::string names;  ///< `-n, --steps N`
    std::string text;
};

/// Rows under a heading.
struct HelpGroup {
    std::string heading;
    std::vector<HelpRow> rows;
};

/// Contents of the help for a command, or for the program.
struct HelpPage {
    std::string name;  ///< `sikku draw`
    std::string summary;
    std::string usage;  ///< `sikku draw [OPTIONS] PATTERN -o FILE`
    std::vector<HelpGroup> groups;
    std::vector<std::string> notes;     ///< paragraphs
    std::vector<std::string> examples;  ///< command lines
};

/// Formats a page for a terminal: rows aligned and grouped, at most 100 columns wide, examples last.
std::string help_text(const HelpPage& page);

/// Formats a page as a section of Markdown under a heading of the second level.
std::string help_markdown(const HelpPage& page);

/// `sikku-draw` from `sikku draw`.
std::string hyphenated(std::string name);

/// Formats a page of section 1 for man, in roff.
/// @param others  names of further pages
std::string man_page(const HelpPage& page, const std::vector<std::string>& others);

}  // namespace sikku
