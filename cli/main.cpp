// cli/main.cpp: the program: its commands, its errors, its signals.
#include "art/output_file.h"
#include "cli/command.h"
#include "engine/derivation.h"
#include "music/score.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <sstream>
#include <string_view>

namespace {
volatile std::sig_atomic_t signal_seen = 0;

/// The first ctrl-C lets the work end tidily, a second one ends it at once.
extern "C" void note_signal(int) {
    if (signal_seen != 0) {
        sikku::remove_unfinished_files();
        _exit(130);
    }
    signal_seen = 1;
}

/// Whoever read what is told has gone: the program ends, as usual, but leaves nothing behind.
extern "C" void pipe_signal(int) {
    sikku::remove_unfinished_files();
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

void catch_signals() {
    struct sigaction action = {};
    action.sa_handler = note_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);
    action.sa_handler = pipe_signal;
    sigaction(SIGPIPE, &action, nullptr);
    // A file that grows over the limit of the shell is an error like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
}

int fail(int status, std::string_view message) {
    if (message.ends_with('\n')) message.remove_suffix(1);
    sikku::tell("sikku: {}\n", sikku::printable(message, 2000));
    return status;
}

/// CLI11 alone would only say that a command is missing.
void require_command(const CLI::App& app, const std::string& wanted) {
    std::vector<std::string_view> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
        if (names.back() == wanted) return;
    }
    const std::string_view near = sikku::nearest(wanted, names);
    throw sikku::UsageError(
        fmt::format("there is no command '{}'{}", sikku::printable(wanted, 80),
                    near.empty() ? "; `sikku --help` lists them" : fmt::format("; did you mean '{}'?", near)));
}

/// Does what the command line asks for, tells what went wrong with it, and returns the exit status.
int run(int argc, char** argv) {
    using namespace sikku;
    CLI::App app("Kolams, tilings and fractal music from L-systems.", "sikku");
    app.set_version_flag("--version", "sikku " SIKKU_VERSION);
    bool quiet = false;
    app.add_flag("-q,--quiet", quiet, "No progress, no warnings");
    app.require_subcommand(1);
    app.fallthrough();
    app.get_formatter()->column_width(34);
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
    app.footer("`sikku COMMAND --help` tells more, with examples.");
    try {
        if (argc > 1 && argv[1][0] != '-') require_command(app, argv[1]);
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ParseError& error) {
        // CLI11 by itself prints without looking whether it can; what is lost here main() sees.
        std::ostringstream help;
        std::ostringstream mistake;
        const int status = app.exit(error, help, mistake) == 0 ? 0 : 2;
        std::fputs(help.str().c_str(), stdout);
        return status == 0 ? 0 : fail(status, mistake.str());
    } catch (const PatternError& error) {
        tell("{}\n", error.what());
        return 2;
    } catch (const WordError& error) {
        return fail(2, error.what());
    } catch (const ScoreError& error) {
        return fail(2, error.what());
    } catch (const UsageError& error) {
        return fail(2, error.what());
    } catch (const Interrupted& error) {
        fail(1, error.what());
        return 130;
    } catch (const std::bad_alloc&) {
        return fail(1, "there is not enough memory for this");
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

}  // namespace

bool sikku::interrupted() {
    return signal_seen != 0;
}

int main(int argc, char** argv) {
    catch_signals();
    const int status = run(argc, argv);
    // Output that is lost is a failure, also where it would have told mistakes; other failures were told already.
    const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    return lost && (status == 0 || status == 2) ? fail(1, "standard output cannot be written") : status;
}
