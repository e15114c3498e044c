// cli/completion.cpp: `sikku completion`: scripts for bash, zsh and fish, made from the commands themselves.
#include "cli/command.h"
#include "cli/help.h"
#include "cli/mistakes.h"

#include <fmt/format.h>

namespace sikku {
namespace {

std::string options_of(const CLI::App& command) {
    std::string words;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) words += (words.empty() ? "--" : " --") + name;
        for (const std::string& name : option->get_snames()) words += " -" + name;
    }
    return words;
}

std::string script(const CLI::App& app, bool zsh) {
    std::string commands;
    std::string cases;
    for (const CLI::App* command : listed_commands(app)) {
        commands += (commands.empty() ? "" : " ") + command->get_name();
        cases += fmt::format("        {}) options=\"{}\" ;;\n", command->get_name(), options_of(*command));
    }
    // zsh reads the same function through its emulation of bash's completion.
    const std::string head = zsh ? "#compdef sikku\nautoload -U +X bashcompinit && bashcompinit\n" : "";
    return head + fmt::format(R"sh(_sikku() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" command="${{COMP_WORDS[1]}}" options="" word
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "{} --help --version" -- "$current"))
        return
    fi
    case "$command" in
{}    esac
    case "$current" in
        -*) COMPREPLY=($(compgen -W "$options" -- "$current")) ;;
        *) while IFS= read -r word; do COMPREPLY+=("$word"); done < <(
               compgen -W "$(sikku patterns --names 2>/dev/null)" -- "$current"
               compgen -f -- "$current") ;;
    esac
}}
complete -o filenames -F _sikku sikku
)sh",
                              commands, cases);
}

/// A text between single quotes, for fish.
std::string fish_quoted(std::string_view text) {
    std::string quoted = "'";
    for (const char each : text) {
        if (each == '\'' || each == '\\') quoted += '\\';
        quoted += each;
    }
    return quoted + "'";
}

/// fish shows what commands and options do, and completes files after options that take a value.
std::string fish_script(const CLI::App& app) {
    std::string text =
        "complete -c sikku -n __fish_use_subcommand -f -l help -d 'show help'\n"
        "complete -c sikku -n __fish_use_subcommand -f -l version -d 'show the version'\n";
    for (const CLI::App* command : listed_commands(app)) {
        text += fmt::format("complete -c sikku -n __fish_use_subcommand -f -a {} -d {}\n", command->get_name(),
                            fish_quoted(command->get_description()));
        for (const CLI::Option* option : command->get_options()) {
            std::string names;
            for (const std::string& name : option->get_snames()) names += " -s " + name;
            for (const std::string& name : option->get_lnames()) names += " -l " + name;
            if (names.empty()) continue;
            text += fmt::format("complete -c sikku -n '__fish_seen_subcommand_from {}'{}{} -d {}\n",
                                command->get_name(), names, option->get_items_expected_min() > 0 ? " -r" : "",
                                fish_quoted(option->get_description()));
        }
    }
    return text + "complete -c sikku -n 'not __fish_use_subcommand' -a '(sikku patterns --names 2>/dev/null)'\n";
}

}  // namespace

void add_completion(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand("completion", "Print a completion script for a shell");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
    command->footer(
        "Examples:\n  sikku completion bash > ~/.local/share/bash-completion/completions/sikku\n"
        "  sikku completion zsh > ~/.zfunc/_sikku\n"
        "  sikku completion fish > ~/.config/fish/completions/sikku.fish");
    command->callback(
        [shell, &app] { fmt::print("{}", *shell == "fish" ? fish_script(app) : script(app, *shell == "zsh")); });
}

}  // namespace sikku
