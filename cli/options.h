// cli/options.h: adds options to commands.
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

/// Adds options below a heading of the help; below the first one if it is empty.
struct OptionGroup {
    CLI::App& command;
    std::string heading{};

    /// @param type  the placeholder of the value
    template <typename Value>
    CLI::Option* add(const char* names, Value& value, const char* type, const std::string& help) const {
        return put(command.add_option(names, value, help)->type_name(type));
    }
    CLI::Option* flag(const char* names, bool& value, const std::string& help) const {
        return put(command.add_flag(names, value, help));
    }

private:
    CLI::Option* put(CLI::Option* option) const { return heading.empty() ? option : option->group(heading); }
};

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

/// Formats a SettingError for the command line: `--size 3x: expected …`. Quoted names of options in the message,
/// 'plotter', become `--plotter`.
std::string option_message(const SettingError& error);
/// Replaces quoted names of options by options in any text of a library.
std::string with_dashes(const std::string& text);
/// Replaces only 'force' and 'name' in messages of galleries, whose other quoted names are keys of files.
std::string with_force(std::string message);
/// Formats the errors of a pattern; those in values of options begin with the option: `--scale dorain: …`.
std::string pattern_message(const PatternError& error);
/// Formats one warning or error in the same way.
std::string diagnostic_message(const Diagnostic& diagnostic);

}  // namespace sikku
