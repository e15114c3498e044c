// cli/command.h: functions shared by the commands: finding and loading patterns, progress, errors.
#pragma once

#include "art/link/link.h"
#include "art/provenance/provenance.h"
#include "cli/signals.h"
#include "engine/base/text.h"
#include "engine/interpreter.h"
#include "engine/language/document.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// A usage error: exit status 2.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Prints to standard error. Ignores failures to write, which cannot be reported.
template <typename... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) noexcept {
    try {
        fmt::memory_buffer text;
        fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
        std::fwrite(text.data(), 1, text.size(), stderr);
    } catch (...) {
    }
}

/// The message for output that is lost. @param cause  may be empty
std::string unwritten(const std::string& cause);

/// Calls tell() unless `quiet`.
template <typename... Arguments>
void tell_unless(bool quiet, fmt::format_string<Arguments...> format, Arguments&&... arguments) noexcept {
    if (!quiet) tell(format, std::forward<Arguments>(arguments)...);
}

/// A text and its name in messages.
struct NamedText {
    std::string name;
    std::string text;
};
/// Finds the file of the argument PATTERN, a path or the name of a bundled pattern, and does not open it.
/// @throws UsageError for an unknown name
PatternFile find_named_pattern(const std::string& pattern);
/// Reads the text of the argument PATTERN: a path, the name of a bundled pattern, a link, or `-` for standard input.
/// @throws UsageError, Stopped
NamedText read_pattern_text(const std::string& pattern);

/// Refuses to overwrite an input file. @param option  `-o` or `--overlay`, for the message
/// @throws UsageError
void keep_input(std::string_view option, const std::string& output, const std::string& input);

/// The message for a text that was written for another program, with the command that imports it if there is one;
/// empty for patterns. @param pattern  the argument that names the text
std::string foreign_message(const std::string& pattern, const NamedText& text);

/// Options of every command that takes a pattern.
struct PatternOptions {
    std::string pattern;
    std::string steps;
    std::vector<std::string> settings;
    std::string variant;
    std::string seed;
    bool trusts_link = false;  ///< a link may name files and set commands for machines
};
void add_pattern_options(CLI::App& command, PatternOptions& options);
/// Adds `--trust-link`.
void add_trust_option(CLI::App& command, bool& trusts_link);
/// The value of `--seed`; 0 if it was not given. @throws UsageError
std::uint64_t seed_of(const PatternOptions& options);
/// Adds the options without PATTERN.
void add_override_options(CLI::App& command, PatternOptions& options);

/// Options of every command that examines a pattern.
struct ExaminationOptions : PatternOptions {
    bool as_json = false;
    double budget = 200e6;
};
/// Adds `--budget`, with its default of 200 million nodes.
void add_budget_option(CLI::App& command, double& budget);

/// The interpreters: prints, then scores.
std::span<const Interpreter* const> interpreters();

/// Reads, compiles and checks a pattern; warnings are printed unless `quiet`. The settings of a link apply, except
/// those that the options replace.
/// @throws PatternError; UsageError for an unknown name, a damaged link, and one that names files without being
/// trusted
Document load(const PatternOptions& options, bool quiet);
/// Loads a pattern in the same way. @param link  PATTERN if it was already read as a link; null if it is not one
Document load(const PatternOptions& options, const SharedWork* link, bool quiet);

/// Makes a work with a progress bar, then prints its remarks, unless `quiet`. @throws exceptions of Work::make()
void make(Work& work, const std::string& output, bool quiet);
/// Prints the remarks about a finished work.
void report(const Made& made);

/// Seconds of a monotonic clock.
double seconds_now();

/// A bar on standard error, if that is a terminal and the work takes longer than half a second; checks for ctrl-C.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// Begins another stage. @param symbols  total number of symbols, or 0 if unknown
    void expect(double symbols);
    void add(std::uint64_t symbols);
    /// A monitor that refers to this object.
    Monitor monitor();
    /// For DerivationOptions::watch; refers to this object.
    std::function<void(std::uint64_t)> watch() {
        return [this](std::uint64_t symbols) { add(symbols); };
    }

private:
    void show();
    double expected_ = 0;
    bool shown_;
    bool visible_ = false;
    double symbols_ = 0;
    std::uint64_t calls_ = 0;
    double started_;
    double last_;
};

/// Writes a text to a file, which appears whole or not at all, or to standard output if the path is empty.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Writes all bytes to a descriptor. @throws std::runtime_error that names the cause; Interrupted
void write_all(int descriptor, std::string_view text);

/// The extension of a file name in lower case, with its dot.
std::string extension_of(const std::string& file);

/// Runs `sikku check` on a MIDI file of up to 128 MB: prints its faults; returns true if there are none.
/// @throws UsageError if the file cannot be read or is larger
bool check_midi_file(const std::string& file);

void add_derive(CLI::App& app, bool& quiet);
void add_measure(CLI::App& app, bool& quiet);
void add_draw(CLI::App& app, bool& quiet);
void add_sheet(CLI::App& app, bool& quiet);
void add_workbook(CLI::App& app, bool& quiet);
void add_kolam(CLI::App& app, bool& quiet);
void add_tiling(CLI::App& app, bool& quiet);
void add_play(CLI::App& app, bool& quiet);
void add_gallery(CLI::App& app, bool& quiet);
void add_scales(CLI::App& app, bool& quiet);
void add_import(CLI::App& app, bool& quiet);
void add_patterns(CLI::App& app, bool& quiet);
void add_plotters(CLI::App& app, bool& quiet);
void add_ports(CLI::App& app, bool& quiet);
void add_show(CLI::App& app, bool& quiet);
void add_check(CLI::App& app, bool& quiet);
void add_studio(CLI::App& app, bool& quiet);
void add_lsp(CLI::App& app, bool& quiet);
void add_completion(CLI::App& app, bool& quiet);
void add_manual(CLI::App& app, bool& quiet);

}  // namespace sikku
