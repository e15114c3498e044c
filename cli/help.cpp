#include "cli/help.h"

#include <algorithm>
#include <string_view>

namespace sikku {
namespace {

/// The placeholder of an option's value: `LENGTH`, without the suffix of CLI11.
std::string value_name(const CLI::Option& option) {
    if (option.get_expected_max() == 0) return {};
    std::string type = option.get_type_name();
    // CLI11 appends descriptions of its checks: `:INT in [0 - 1024]`, `:{bash,zsh}`.
    for (std::size_t at = type.find(':'); at != std::string::npos; at = type.find(':', at + 1)) {
        if (type.compare(at, 2, ":{") == 0 || type.find(" in [", at) != std::string::npos) type.erase(at);
    }
    return type;
}

/// Formats the names of an option, `-n, --steps N`, `--dots[=SIZE COLOUR|only]`, or of an argument, `PATTERN...`.
std::string names_of(const CLI::Option& option) {
    if (option.get_positional()) {
        const std::string name = option.get_name(true, false);
        return option.get_expected_max() > 1 ? name + "..." : name;
    }
    std::string names;
    for (const std::string& letter : option.get_snames()) names += (names.empty() ? "-" : ", -") + letter;
    for (const std::string& word : option.get_lnames()) names += (names.empty() ? "--" : ", --") + word;
    const std::string value = value_name(option);
    if (value.empty()) return names;
    if (value.front() == '[') return names + "[=" + value.substr(1);
    return names + ' ' + value;
}

bool is_between(char letter, char first, char last) {
    return letter >= first && letter <= last;
}

/// The description in lower case, except for abbreviations, with the default value added if it is missing.
std::string text_of(const CLI::Option& option) {
    std::string text = option.get_description();
    if (text.size() > 1 && is_between(text[0], 'A', 'Z') && is_between(text[1], 'a', 'z')) {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    if (!option.get_default_str().empty() && !text.ends_with(')')) text += " (" + option.get_default_str() + ")";
    return text;
}

std::string usage_of(const CLI::App& command, const std::string& name) {
    if (!command.get_subcommands([](const CLI::App*) { return true; }).empty()) return name + " COMMAND ...";
    std::string usage = name + " [OPTIONS]";
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional()) continue;
        const std::string names = names_of(*option);
        usage += option->get_required() ? ' ' + names : " [" + names + ']';
    }
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional() || !option->get_required()) continue;
        const std::string names = names_of(*option);
        const std::size_t comma = names.find(", ");
        const std::size_t blank = names.rfind(' ');
        usage += ' ' + (comma == std::string::npos ? names : names.substr(0, comma) + names.substr(blank));
    }
    return usage;
}

/// Splits a footer into paragraphs and the lines below `Examples:`.
void read_footer(const std::string& footer, HelpPage& page) {
    constexpr std::string_view heading = "Examples:\n";
    const std::size_t at = std::min(footer.find(heading), footer.size());
    std::string_view notes = std::string_view(footer).substr(0, at);
    while (!notes.empty()) {
        const std::size_t end = std::min(notes.find("\n\n"), notes.size());
        std::string paragraph(notes.substr(0, end));
        std::replace(paragraph.begin(), paragraph.end(), '\n', ' ');
        if (paragraph.find_first_not_of(' ') != std::string::npos) page.notes.push_back(std::move(paragraph));
        notes.remove_prefix(std::min(end + 2, notes.size()));
    }
    std::string_view examples = std::string_view(footer).substr(std::min(at + heading.size(), footer.size()));
    while (!examples.empty()) {
        const std::size_t end = std::min(examples.find('\n'), examples.size());
        std::string_view line = examples.substr(0, end);
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        if (!line.empty()) page.examples.emplace_back(line);
        examples.remove_prefix(std::min(end + 1, examples.size()));
    }
}

}  // namespace

std::vector<const CLI::App*> listed_commands(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

HelpPage help_page(const CLI::App& command) {
    HelpPage page;
    const CLI::App* parent = command.get_parent();
    page.name = parent ? parent->get_name() + ' ' + command.get_name() : command.get_name();
    page.summary = command.get_description();
    page.usage = usage_of(command, page.name);
    HelpGroup arguments{"Arguments", {}};
    HelpGroup commands{"Commands", {}};
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) arguments.rows.push_back({names_of(*option), text_of(*option)});
    }
    for (const CLI::App* each : listed_commands(command)) {
        commands.rows.push_back({each->get_name(), each->get_description()});
    }
    if (!arguments.rows.empty()) page.groups.push_back(std::move(arguments));
    if (!commands.rows.empty()) page.groups.push_back(std::move(commands));
    for (const std::string& heading : command.get_groups()) {
        HelpGroup group{heading, {}};
        for (const CLI::Option* option : command.get_options()) {
            if (option->get_positional() || option->get_group() != heading || heading.empty()) continue;
            if (option != command.get_help_ptr()) group.rows.push_back({names_of(*option), text_of(*option)});
        }
        // Put the help option last in the first group.
        const CLI::Option* help = command.get_help_ptr();
        if (help && help->get_group() == heading) group.rows.push_back({names_of(*help), text_of(*help)});
        if (!group.rows.empty()) page.groups.push_back(std::move(group));
    }
    read_footer(command.get_footer(), page);
    return page;
}

std::string HelpFormatter::make_help(const CLI::App* command, std::string, CLI::AppFormatMode) const {
    return help_text(help_page(*command));
}

}  // namespace sikku
