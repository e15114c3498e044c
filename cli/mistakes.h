// cli/mistakes.h: error messages for invalid command lines.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace sikku {

/// Finds errors that CLI11 would misinterpret, before it parses. @throws UsageError
/// - for an unknown command
/// - for an option that lacks its value, and would take the next option for it
/// @param arguments  without the name of the program
void check_arguments(const CLI::App& app, const std::vector<std::string>& arguments);

/// The message for a command line that CLI11 refused.
std::string parse_message(const CLI::App& app, const CLI::ParseError& error,
                          const std::vector<std::string>& arguments);

using Check = std::function<std::string(const std::string&)>;
/// Checks of values, for CLI::Option::check().
Check whole_number(std::int64_t least, std::int64_t most);
Check number_between(double least, double most);
Check one_of(std::vector<std::string> words);
std::string above_zero(const std::string& text);

}  // namespace sikku
