// cli/options.h: adds the options of interpreters to commands.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/base/option.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// The options of a command that come from a table.
class TableOptions {
public:
    TableOptions() : given_(std::make_shared<Given>()) {}
    /// Adds `--name` for each row, unless the command has an option of that name.
    void add(CLI::App& command, std::span<const OptionInfo* const> table);
    /// The given values in the order of the table. Call after parsing.
    OptionValues values() const;

private:
    struct One {
        const OptionInfo* info = nullptr;
        CLI::Option* option = nullptr;
        std::vector<std::string> texts;
        bool flag = false;
    };
    using Given = std::vector<std::unique_ptr<One>>;
    std::shared_ptr<Given> given_;
};

/// Warns of a compression for a format that has none.
void report_compression(std::string_view format, const OptionValues& values, bool quiet);

/// Formats a SettingError for the command line: `--size 3x: expected …`. Quoted names of options in the message,
/// 'plotter', become `--plotter`.
std::string option_message(const SettingError& error);
/// The same of any text of a library: quoted names of options become options.
std::string with_dashes(const std::string& text);
/// The same of messages of galleries, whose other quoted names are keys of files.
std::string with_force(std::string message);
/// Errors of a pattern; those in values of options begin with the option: `--scale dorain: …`.
std::string pattern_message(const PatternError& error);
/// The same of one warning or error.
std::string diagnostic_message(const Diagnostic& diagnostic);

}  // namespace sikku
