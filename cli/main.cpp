// cli/main.cpp: the program: its commands and its errors.
#include "art/gallery/values.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "engine/derivation/derivation.h"
#include "music/score/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {
int fail(int status, std::string_view message) {
    if (message.ends_with('\n')) message.remove_suffix(1);
    sikku::tell("sikku: {}\n", sikku::printable(message, 2000));
    return status;
}

/// An argument that no option or positional takes, with the nearest option.
std::string unexpected(const CLI::App& app, const std::string& argument) {
    const CLI::App* command = &app;
    for (const CLI::App* used : app.get_subcommands()) command = used;
    if (!argument.starts_with("-")) return "unexpected argument '" + sikku::printable(argument, 80) + "'";
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    const std::string given = argument.substr(0, argument.find('='));
    const std::string_view near = sikku::nearest(given, {names.begin(), names.end()});
    return fmt::format("unknown option '{}'{}", sikku::printable(given, 80),
                       near.empty() ? fmt::format("; `sikku {} --help` lists the options", command->get_name())
                                    : fmt::format("; did you mean '{}'?", near));
}

/// Reports an unknown command with the nearest one: CLI11 would only report a missing command.
void require_command(const CLI::App& app, const std::string& wanted) {
    std::vector<std::string_view> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
        if (names.back() == wanted) return;
    }
    const std::string_view near = sikku::nearest(wanted, names);
    throw sikku::UsageError(
        fmt::format("unknown command '{}'{}", sikku::printable(wanted, 80),
                    near.empty() ? "; `sikku --help` lists them" : fmt::format("; did you mean '{}'?", near)));
}

/// Executes the command line, reports errors, and returns the exit status.
int run(int argc, char** argv) {
    using namespace sikku;
    CLI::App app("Kolams, tilings and fractal music from L-systems.", "sikku");
    app.set_version_flag("--version", "sikku " SIKKU_VERSION, "show the version");
    bool quiet = false;
    app.set_help_flag("-h,--help", "show this help");
    app.add_flag("-q,--quiet", quiet, "show no progress and no warnings");
    app.formatter(std::make_shared<HelpFormatter>());
    app.require_subcommand(1);
    app.fallthrough();
    add_draw(app, quiet);
    add_kolam(app, quiet);
    add_play(app, quiet);
    add_gallery(app, quiet);
    add_derive(app, quiet);
    add_measure(app, quiet);
    add_patterns(app);
    add_import(app, quiet);
    add_scales(app);
    add_show(app, quiet);
    add_check(app);
    add_completion(app);
    add_manual(app);
    app.footer(
        "`sikku COMMAND --help` shows the options of a command, with examples.\n\n"
        "Exit status: 0 for success; 2 for errors in the command line or in patterns; 1 for other failures; 130, 143 "
        "and 129 "
        "after ctrl-C, SIGTERM and SIGHUP, which stop every command within half a second. A second signal ends it at "
        "once. Output files appear whole or not at all.");
    try {
        if (argc > 1 && argv[1][0] != '-') require_command(app, argv[1]);
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ExtrasError&) {
        const std::vector<std::string> extras = app.remaining(true);
        // In this list the value of an unknown option precedes its name.
        const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& text) {
            return text.starts_with("-") && text != "-";
        });
        return fail(2, unexpected(app, option == extras.end() ? extras.front() : *option));
    } catch (const CLI::ParseError& error) {
        // CLI11 would ignore failures of printing; main() checks standard output.
        std::ostringstream help;
        std::ostringstream mistake;
        const int status = app.exit(error, help, mistake) == 0 ? 0 : 2;
        std::fputs(help.str().c_str(), stdout);
        if (status == 0) return 0;
        const bool lacks_command = error.get_name() == "RequiredError" && app.get_subcommands().empty();
        return fail(status, lacks_command ? "expected a command; `sikku --help` lists them" : mistake.str());
    } catch (const PatternError& error) {
        tell("{}\n", error.what());
        return 2;
    } catch (const WordError& error) {
        return fail(2, error.what());
    } catch (const ScoreError& error) {
        return fail(2, error.what());
    } catch (const SettingError& error) {
        return fail(2, option_message(error));
    } catch (const UsageError& error) {
        return fail(2, error.what());
    } catch (const GalleryError& error) {
        return fail(2, error.what());
    } catch (const Stopped& stopped) {
        return fail(interruption_status(), stopped.what());
    } catch (const std::bad_alloc&) {
        return fail(1, "there is not enough memory for this");
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    sikku::catch_signals();
    const int status = run(argc, argv);
    // Lost output is a failure, even if it was an error report; other failures were reported already.
    const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    return lost && (status == 0 || status == 2) ? fail(1, "standard output cannot be written") : status;
}
