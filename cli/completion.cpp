// cli/completion.cpp: `sikku completion`: scripts for bash and zsh, made from the commands themselves.
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

}  // namespace

void add_completion(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand("completion", "Print a completion script for a shell");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash or zsh")->required()->check(one_of({"bash", "zsh"}));
    command->footer(
        "Examples:\n  sikku completion bash > ~/.local/share/bash-completion/completions/sikku\n"
        "  sikku completion zsh > ~/.zfunc/_sikku");
    command->callback([shell, &app] { fmt::print("{}", script(app, *shell == "zsh")); });
}

}  // namespace sikku
