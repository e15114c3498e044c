// cli/studio.cpp: `sikku studio`, which opens the studio page or writes a copy with patterns in it.
#include "cli/command.h"
#include "cli/link_argument.h"
#include "cli/process.h"
#include "cli/studio_page.h"
#include "engine/base/input_file.h"
#include "engine/base/installation.h"
#include "engine/language/pattern.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

extern char** environ;  // NOLINT(readability-redundant-declaration): not every C library declares it

namespace sikku {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_page_bytes = std::size_t{256} << 20;
constexpr std::size_t longest_address = 8000;  // characters that terminals, shells and browsers support

struct StudioCommand {
    std::vector<std::string> patterns;
    std::string output;
};

/// Finds the studio page, in the build folder or as installed. @throws std::runtime_error if it is not there
fs::path find_page() {
    std::error_code error;
    fs::path page = installed_file("sikku-studio.html");
    if (fs::is_regular_file(page, error)) return page;
    if (const std::string refused = refused_data(); !refused.empty()) throw std::runtime_error(refused);
    throw std::runtime_error(
        "the studio page is not installed; install the package sikku-studio, or build it in a checkout with "
        "`./demo --studio`");
}

/// Reads a pattern as a work without values, or the work of a link. The studio reports errors in patterns.
SharedWork read_work(const std::string& pattern) {
    if (auto link = read_link_argument(pattern)) return std::move(*link);
    NamedText text = read_pattern_text(pattern);
    if (text.text.size() > most_pattern_bytes) throw UsageError(pattern + ": a pattern file can have at most 64 MB");
    if (const std::string foreign = foreign_message(pattern, text); !foreign.empty()) throw UsageError(foreign);
    SharedWork work;
    work.name = pattern == "-" ? "pattern.lsys" : fs::path(text.name).filename().string();
    work.text = std::move(text.text);
    return work;
}

void write_page(const fs::path& page, const std::vector<SharedWork>& works, const fs::path& target) {
    const std::string name = page.string();
    const std::string text = read_file(page, name, most_page_bytes, stop_monitor());
    std::string written;
    try {
        written = page_with(text, works);
    } catch (const PageError& error) {
        throw std::runtime_error(fmt::format("{}: {}", name, error.what()));
    } catch (const LinkError& error) {
        throw UsageError(error.what());
    }
    write_file(target, written);
}

/// Returns the user's cache folder for sikku, and creates it if necessary.
fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    fs::path folder;
    if (cache && *cache == '/') {
        folder = cache;
    } else if (home && *home == '/') {
        folder = fs::path(home) / ".cache";
    } else {
        throw std::runtime_error("no folder to write the page to: HOME is not set; use -o FILE");
    }
    folder /= "sikku";
    fs::create_directories(folder);
    return folder;
}

/// Writes a page that redirects to `address`, because programs that open files drop the fragment of an address.
/// Returns the address of the page that redirects.
std::string write_redirection(const std::string& address) {
    const fs::path target = cache_folder() / "link.html";
    write_file(target, fmt::format("<!doctype html><meta charset=\"utf-8\"><title>Sikku studio</title>"
                                   "<meta http-equiv=\"refresh\" content=\"0;url={}\">\n",
                                   xml_escaped(address)));
    return file_address(target.string());
}

bool has_display() {
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value != '\0';
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

/// Starts xdg-open in its own session. Returns false if it cannot be started or fails at once; it may run as long as
/// the browser does.
bool open_in_browser(const std::string& address) {
    constexpr auto longest_wait = std::chrono::seconds(3);
    constexpr auto pause = std::chrono::milliseconds(20);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0 || posix_spawnattr_init(&attributes) != 0) {
        throw std::bad_alloc();
    }
    for (const int descriptor : {0, 1, 2}) {
        posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_RDWR, 0);
    }
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    std::string program = "xdg-open";
    std::string argument = address;
    char* arguments[] = {program.data(), argument.data(), nullptr};
    pid_t process = -1;
    const int error = posix_spawnp(&process, program.c_str(), &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) return false;
    for (const auto end = std::chrono::steady_clock::now() + longest_wait; std::chrono::steady_clock::now() < end;) {
        int status = 0;
        const pid_t ended = ::waitpid(process, &status, WNOHANG);
        if (ended == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        if (interrupted()) throw Interrupted();
        std::this_thread::sleep_for(pause);
    }
    return true;
}

/// The address of the page, with a single work in its fragment; empty if it would be too long or for several works.
std::string address_with(const fs::path& page, const std::vector<SharedWork>& works) {
    if (works.empty()) return file_address(page.string());
    if (works.size() > 1) return {};
    try {
        std::string address = file_address(page.string()) + '#' + link_of(works.front());
        return address.size() <= longest_address ? address : std::string();
    } catch (const LinkError& error) {
        throw UsageError(error.what());
    }
}

void run(const StudioCommand& command, bool quiet) {
    std::vector<SharedWork> works;
    works.reserve(command.patterns.size());
    for (const std::string& pattern : command.patterns) works.push_back(read_work(pattern));
    const fs::path page = find_page();
    if (!command.output.empty()) {
        const std::string extension = extension_of(command.output);
        if (extension != ".html" && extension != ".htm") {
            throw UsageError(fmt::format("-o {}: the studio page needs the extension .html", command.output));
        }
        return write_page(page, works, command.output);
    }
    const bool opens = has_display() && is_in_path("xdg-open");
    const bool is_one_link = works.size() == 1 && is_link(command.patterns.front());
    std::string address = address_with(page, works);
    if (opens && is_one_link && !address.empty()) {
        address = write_redirection(address);
    } else if (address.empty() || (opens && !works.empty())) {
        const fs::path copy = cache_folder() / "sikku-studio.html";
        write_page(page, works, copy);
        address = file_address(copy.string());
    }
    if (opens && open_in_browser(address)) {
        tell_unless(quiet, "opened {}\n", address);
    } else {
        fmt::print("{}\n", address);
    }
}

}  // namespace

void add_studio(CLI::App& app, bool& quiet) {
    auto* command =
        app.add_subcommand("studio", "Open the studio, a page for seeing and hearing patterns while writing them");
    auto options = std::make_shared<StudioCommand>();
    command->add_option("PATTERN", options->patterns,
                        "pattern files, names of bundled patterns, studio links, or -, to open in the studio");
    command
        ->add_option("-o,--output", options->output,
                     "write a copy of the page that contains the patterns, instead of opening it")
        ->type_name("FILE.html");
    command->footer(
        "The studio is a single page that needs neither a server nor the internet; the package sikku-studio "
        "installs it, and `./demo --studio` builds it in a checkout. It is opened with xdg-open; without a display "
        "or xdg-open, its address is printed. The browser saves work in the studio; the pattern files do not "
        "change.\n\n"
        "Examples:\n"
        "  sikku studio\n"
        "  sikku studio snake-kolam my.lsys\n"
        "  sikku studio *.lsys -o my-patterns.html");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
