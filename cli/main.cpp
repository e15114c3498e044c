// cli/main.cpp: the program: its commands and its errors.
#include "cli/command.h"
#include "cli/help.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "cli/version.h"
#include "engine/base/toml_file.h"
#include "engine/derivation/derivation.h"
#include "music/score/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace {
int fail(int status, std::string_view message) {
    // A signal while a pipe is opened.
    if (sikku::interrupted() && message.ends_with(std::generic_category().message(EINTR))) {
        sikku::tell("sikku: interrupted\n");
        return sikku::interruption_status();
    }
    if (message.ends_with('\n')) message.remove_suffix(1);
    sikku::tell("sikku: {}\n", sikku::printable_lines(message, 2000));
    return status;
}

struct CommandRow {
    std::string_view name;
    void (*add)(CLI::App& app, bool& quiet);
};

/// The commands, in the order of the help.
constexpr CommandRow commands[] = {
    {"draw", sikku::add_draw},
    {"sheet", sikku::add_sheet},
    {"workbook", sikku::add_workbook},
    {"kolam", sikku::add_kolam},
    {"tiling", sikku::add_tiling},
    {"play", sikku::add_play},
    {"gallery", sikku::add_gallery},
    {"derive", sikku::add_derive},
    {"measure", sikku::add_measure},
    {"patterns", sikku::add_patterns},
    {"plotters", sikku::add_plotters},
    {"ports", sikku::add_ports},
    {"import", sikku::add_import},
    {"scales", sikku::add_scales},
    {"show", sikku::add_show},
    {"check", sikku::add_check},
    {"studio", sikku::add_studio},
    {"lsp", sikku::add_lsp},
    {"completion", sikku::add_completion},
    {"manual", sikku::add_manual},
};

/// Adds the command that the arguments begin with. Adds all of them if it is unknown or if the command describes the
/// others: they have some 600 options, which take longer to set up than a small drawing.
void add_commands(CLI::App& app, bool& quiet, const std::vector<std::string>& arguments) {
    const std::string_view first = arguments.empty() ? "" : std::string_view(arguments.front());
    const bool describes_all = first == "completion" || first == "manual";
    const auto* const row = std::find_if(std::begin(commands), std::end(commands),
                                         [&](const CommandRow& command) { return command.name == first; });
    const bool is_alone = row != std::end(commands) && !describes_all;
    for (const CommandRow& command : commands) {
        if (!is_alone || &command == row) command.add(app, quiet);
    }
}

/// Executes the command line, reports errors, and returns the exit status.
int run(int argc, char** argv) {
    using namespace sikku;
    CLI::App app("Kolams, tilings and fractal music from L-systems.", "sikku");
    app.set_version_flag("--version", version_text(), "show the version");
    bool quiet = false;
    app.set_help_flag("-h,--help", "show this help");
    app.add_flag("-q,--quiet", quiet, "show no progress and no warnings");
    app.formatter(std::make_shared<HelpFormatter>());
    app.require_subcommand(1);
    app.fallthrough();
    app.footer(
        "`sikku COMMAND --help` shows the options of a command, with examples.\n\n"
        "Exit status: 0 on success; 2 for wrong usage, unknown names and faulty patterns; 1 for other failures; "
        "130, 143 and 129 after ctrl-C, SIGTERM and SIGHUP, which stop every command within half a second. A second "
        "signal ends it at once. Output files appear whole or not at all.");
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && arguments.front() == "help") {
        arguments.erase(arguments.begin());
        arguments.emplace_back("--help");
    }
    add_commands(app, quiet, arguments);
    if (arguments.empty()) {
        std::fputs(app.help().c_str(), stdout);
        return 2;
    }
    try {
        check_arguments(app, arguments);
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
        return 0;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ParseError& error) {
        // Help and the version are errors of CLI11, too; it prints them without checking for failure.
        if (error.get_exit_code() != 0) return fail(2, parse_message(app, error, arguments));
        std::ostringstream help;
        app.exit(error, help, help);
        std::fputs(help.str().c_str(), stdout);
        return 0;
    } catch (const PatternError& error) {
        tell("{}\n", pattern_message(error));
        return 2;
    } catch (const WordError& error) {
        return fail(2, error.what());
    } catch (const ScoreError& error) {
        return fail(2, error.what());
    } catch (const SettingError& error) {
        return fail(2, option_message(error));
    } catch (const UsageError& error) {
        return fail(2, error.what());
    } catch (const NotFound& error) {
        return fail(2, error.what());
    } catch (const FileError& error) {
        return fail(2, with_force(error.what()));
    } catch (const Stopped& stopped) {
        return fail(interruption_status(), stopped.what());
    } catch (const BudgetError& error) {
        return fail(1, with_dashes(error.what()));
    } catch (const std::bad_alloc&) {
        return fail(1, "not enough memory");
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(1, fmt::format("{}: {}", printable(error.path1().string(), 2000), error.code().message()));
    } catch (const std::system_error& error) {
        // Thrown by fmt::print, which does not say what it writes to.
        if (std::ferror(stdout) != 0) return fail(1, unwritten(error.code().message()));
        return fail(1, with_force(error.what()));
    } catch (const std::exception& error) {
        return fail(1, with_force(error.what()));
    }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only if memory is exhausted, before anything is done
int main(int argc, char** argv) {
    sikku::catch_signals();
    const int status = run(argc, argv);
    // Lost output is a failure, even if it was an error report; other failures were reported already.
    const int error = std::fflush(stdout) != 0 ? errno : 0;
    const bool lost = error != 0 || std::ferror(stdout) != 0;
    if (!lost || (status != 0 && status != 2)) return status;
    return fail(1, sikku::unwritten(error != 0 ? std::generic_category().message(error) : ""));
}
