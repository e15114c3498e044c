// cli/main.cpp: the program: its commands and its errors.
#include "art/gallery/values.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "engine/derivation/derivation.h"
#include "music/score/score.h"

#include <fmt/format.h>

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
    add_sheet(app, quiet);
    add_kolam(app, quiet);
    add_tiling(app, quiet);
    add_play(app, quiet);
    add_gallery(app, quiet);
    add_derive(app, quiet);
    add_measure(app, quiet);
    add_patterns(app);
    add_plotters(app);
    add_ports(app);
    add_import(app, quiet);
    add_scales(app);
    add_show(app, quiet);
    add_check(app);
    add_studio(app, quiet);
    add_completion(app);
    add_manual(app, quiet);
    app.footer(
        "`sikku COMMAND --help` shows the options of a command, with examples.\n\n"
        "Exit status: 0 on success; 2 for wrong usage, unknown names and faulty patterns; 1 for other failures; 130, "
        "143 and 129 "
        "after ctrl-C, SIGTERM and SIGHUP, which stop every command within half a second. A second signal ends it at "
        "once. Output files appear whole or not at all.");
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty()) {
        std::fputs(app.help().c_str(), stdout);
        return 2;
    }
    if (arguments.front() == "help") {
        arguments.erase(arguments.begin());
        arguments.emplace_back("--help");
    }
    try {
        check_arguments(app, arguments);
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
        return 0;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ParseError& error) {
        // Help and the version are errors of CLI11, too; it prints them without looking whether it can.
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
    } catch (const GalleryError& error) {
        return fail(2, with_force(error.what()));
    } catch (const Stopped& stopped) {
        return fail(interruption_status(), stopped.what());
    } catch (const BudgetError& error) {
        return fail(1, with_dashes(error.what()));
    } catch (const std::bad_alloc&) {
        return fail(1, "not enough memory");
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only for want of memory, before anything is done
int main(int argc, char** argv) {
    sikku::catch_signals();
    const int status = run(argc, argv);
    // Lost output is a failure, even if it was an error report; other failures were reported already.
    const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    return lost && (status == 0 || status == 2) ? fail(1, "standard output cannot be written") : status;
}
